//! Finding devices, and opening them by name.

use texere_core::backend::Schedule;
use texere_core::{Backend, BackendError, DeviceInfo, DeviceKind};
use texere_cpu::{ParallelBackend, SerialBackend};
use texere_fabric::RestBy;

/// A family of devices behind one programming interface.
struct Family {
    /// The start of the names of the family's devices.
    name: &'static str,
    list: fn() -> Result<Vec<DeviceInfo>, BackendError>,
    open: fn(index: usize, schedule: Schedule) -> Result<Box<dyn Backend>, BackendError>,
}

/// The families of this build, in the order of preference.
const FAMILIES: &[Family] = &[
    #[cfg(feature = "wgpu")]
    Family {
        name: "wgpu",
        list: texere_wgpu::WgpuBackend::devices,
        open: |index, schedule| Ok(Box::new(texere_wgpu::WgpuBackend::open(index, schedule)?)),
    },
    #[cfg(feature = "opencl")]
    Family {
        name: "opencl",
        list: texere_opencl::OpenClBackend::devices,
        open: |index, schedule| Ok(Box::new(texere_opencl::OpenClBackend::open(index, schedule)?)),
    },
];

/// Families that a build may leave out. The feature that adds a family has the name of the family.
const FEATURES: [&str; 2] = ["wgpu", "opencl"];

/// The end of a name that asks for the schedule of the paper in README.md: one thread of the device
/// for each yarn.
const PER_YARN: &str = "/per-yarn";

/// The devices of this machine, and the families without one.
#[derive(Debug)]
pub struct Devices {
    /// All devices that can be opened. texere's own CPU devices, `cpu` and `cpu-serial`, come last.
    pub found: Vec<DeviceInfo>,
    /// Families without a device, each with the reason.
    pub missing: Vec<(&'static str, BackendError)>,
}

impl Devices {
    /// The name of the device that `auto` stands for, and the reason in words. A discrete GPU comes
    /// before an integrated one, and an integrated one before the CPU.
    ///
    /// A GPU interface that runs on the CPU is never chosen, because texere's own CPU backend is
    /// faster.
    #[must_use]
    pub fn auto(&self) -> (&str, &'static str) {
        let first =
            |kind| self.found.iter().find(|device| device.kind == kind).map(|device| device.name.as_str());
        if let Some(name) = first(DeviceKind::DiscreteGpu) {
            (name, "the first discrete GPU")
        } else if let Some(name) = first(DeviceKind::IntegratedGpu) {
            (name, "the first integrated GPU, since there is no discrete one")
        } else {
            ("cpu", "all cores, since no GPU was found")
        }
    }
}

/// Finds all devices that this build can use.
///
/// ```
/// let devices = texere::devices();
/// assert!(devices.found.iter().any(|device| device.name == "cpu-serial"));
/// let (name, why) = devices.auto();
/// println!("auto is {name}: {why}");
/// ```
#[must_use]
pub fn devices() -> Devices {
    let mut devices = Devices { found: Vec::new(), missing: Vec::new() };
    for family in FAMILIES {
        match (family.list)() {
            Ok(list) => devices.found.extend(list),
            Err(error) => devices.missing.push((family.name, error)),
        }
    }
    match ParallelBackend::open() {
        Ok(cpu) => devices.found.push(cpu.info().clone()),
        Err(error) => devices.missing.push(("cpu", error)),
    }
    devices.found.push(SerialBackend::new().info().clone());
    devices
}

/// Opens a device by its name.
///
/// | name | device |
/// |---|---|
/// | `auto` | a discrete GPU, else an integrated one, else the CPU, as [`Devices::auto`] says. A GPU that does not open is skipped |
/// | `cpu` | all cores; the environment variable `TEXERE_SIMD` may name the vector instructions to use |
/// | `cpu-serial` | one core: the reference to which other devices are compared |
/// | `wgpu`, `wgpu:1`, `wgpu:nvidia` | the first device of `wgpu`, the second, the first whose name contains "nvidia" (feature `wgpu`) |
/// | `opencl`, `opencl:1`, `opencl:nvidia` | the first device of OpenCL, the second, the first whose name contains "nvidia" (feature `opencl`) |
/// | `opencl:0/per-yarn` | the first device of OpenCL, with the paper's mapping of one thread to each yarn; `wgpu` devices have it, too |
///
/// ```
/// let device = texere::open("cpu")?;
/// assert_eq!(device.info().name, "cpu");
/// assert!(texere::open("abacus").unwrap_err().to_string().contains("cpu-serial"));
/// # Ok::<(), texere::BackendError>(())
/// ```
///
/// **Errors**: [`BackendError::NoDevice`], which lists the names that would have worked;
/// [`BackendError::NoFeature`] for a family that this build lacks;
/// [`BackendError::NoInstructionSet`] if this processor lacks what `TEXERE_SIMD` names;
/// and [`BackendError::Driver`], [`BackendError::Compile`], [`BackendError::Unsupported`] or
/// [`BackendError::DeviceLost`] for a device that can't be opened.
pub fn open(name: &str) -> Result<Box<dyn Backend>, BackendError> {
    match name {
        "auto" => open_gpu().map_or_else(open_cpu, Ok),
        "cpu" => open_cpu(),
        "cpu-serial" => Ok(Box::new(SerialBackend::new())),
        _ => open_in_family(name),
    }
}

/// The device on which yarns come to rest as `rest` says if `device` can't do that: all cores of
/// the CPU. None if `device` can.
///
/// ```
/// use texere::rest::{RestBy, stand_in};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let design = b"[knit]\nchart = 'k'\nrepeat = [4, 4]\nloop_length_mm = 3.2\n\
///     [yarns.cotton]\ntex = 20.0\n[finish]\nrest = 'energy'\n";
/// let design = texere::read_from("jersey.toml", design, |_| Ok(Vec::new()))?;
/// assert_eq!(design.finish.by, RestBy::Energy);
/// let device = texere::open("auto")?;
/// let cpu = stand_in(design.finish.by, &*device)?;
/// let cloth = design.rest(cpu.as_deref().unwrap_or(&*device)).run()?;
/// assert!(cloth.warnings().is_empty());
/// # Ok(())
/// # }
/// ```
///
/// **Errors**: [`BackendError::NoInstructionSet`] as for [`open`].
pub fn stand_in(rest: RestBy, device: &dyn Backend) -> Result<Option<Box<dyn Backend>>, BackendError> {
    let lacks = rest == RestBy::Energy && !device.info().can.relax;
    lacks.then(open_cpu).transpose()
}

fn open_cpu() -> Result<Box<dyn Backend>, BackendError> {
    Ok(Box::new(ParallelBackend::open()?))
}

/// The GPU that `auto` stands for, if one opens. After a discrete GPU no further family is asked
/// for its devices, since that would load its drivers.
fn open_gpu() -> Option<Box<dyn Backend>> {
    let mut integrated = Vec::new();
    for family in FAMILIES {
        let Ok(devices) = (family.list)() else { continue };
        for (index, device) in devices.into_iter().enumerate() {
            let open = move || (family.open)(index, Schedule::PerRing).ok();
            match device.kind {
                DeviceKind::DiscreteGpu => match open() {
                    None => {}
                    opened => return opened,
                },
                DeviceKind::IntegratedGpu => integrated.push(open),
                _ => {}
            }
        }
    }
    integrated.into_iter().find_map(|open| open())
}

fn open_in_family(name: &str) -> Result<Box<dyn Backend>, BackendError> {
    let (device, schedule) =
        name.strip_suffix(PER_YARN).map_or((name, Schedule::PerRing), |device| (device, Schedule::PerYarn));
    let (family, which) = device.split_once(':').unwrap_or((device, "0"));
    let Some(family) = FAMILIES.iter().find(|known| known.name == family) else {
        let lacking = FEATURES.into_iter().find(|feature| *feature == family);
        return Err(lacking.map_or_else(
            || no_device(name),
            |feature| BackendError::NoFeature { wanted: name.into(), feature },
        ));
    };
    match find(&(family.list)()?, which) {
        Some(index) => (family.open)(index, schedule),
        None => Err(no_device(name)),
    }
}

/// Index in `list` of the device that has the number `which`, or of the first whose
/// [`DeviceInfo::device`] holds the text `which`.
fn find(list: &[DeviceInfo], which: &str) -> Option<usize> {
    if which.bytes().all(|byte| byte.is_ascii_digit()) {
        // An empty `which` comes here, too, and does not parse as a number.
        return which.parse().ok().filter(|index| *index < list.len());
    }
    let which = which.to_lowercase();
    list.iter().position(|device| device.device.to_lowercase().contains(&which))
}

/// Opens a device for pictures by its name: `wgpu`, `wgpu:1`, `wgpu:nvidia` or `auto`.
///
/// `auto` is a discrete GPU, else an integrated one, else any device of `wgpu`: pictures need that
/// interface, even if it runs on a CPU.
///
/// ```no_run
/// let design = texere::read("designs/herringbone.wif")?;
/// let renderer = texere::picture::open_renderer("auto")?;
/// let mut scene = renderer.scene(&design.yarns()?, &texere::Settings::default())?;
/// let camera = texere::picture::Camera::face(scene.extent(), [1600, 1200]);
/// let picture = scene.picture(&camera, texere::picture::Quality::default())?;
/// texere::write::picture(picture.size, &picture.rgb, "herringbone.png")?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// **Errors**: [`BackendError::NoDevice`], and [`BackendError::Driver`], [`BackendError::Compile`]
/// or [`BackendError::DeviceLost`] for a device that can't be opened.
#[cfg(feature = "render")]
pub fn open_renderer(name: &str) -> Result<texere_render::Renderer, BackendError> {
    let index = picture_device(name, &texere_wgpu::WgpuBackend::devices()?)?;
    texere_render::Renderer::new(texere_wgpu::WgpuBackend::open(index, Schedule::PerRing)?)
}

/// Index in `list` of the device that [`open_renderer`] opens for `name`.
///
/// A program that opens devices itself, such as one that draws into its own window, chooses a
/// device by this index.
///
/// **Errors**: [`BackendError::NoDevice`], also if the list is empty.
#[cfg(feature = "render")]
pub fn picture_device(name: &str, list: &[DeviceInfo]) -> Result<usize, BackendError> {
    let first = |kind| list.iter().position(|device| device.kind == kind);
    let any = || (!list.is_empty()).then_some(0);
    let index = match name.split_once(':') {
        None if name == "auto" => {
            first(DeviceKind::DiscreteGpu).or_else(|| first(DeviceKind::IntegratedGpu)).or_else(any)
        }
        None if name == "wgpu" => any(),
        Some(("wgpu", which)) => find(list, which),
        _ => None,
    };
    index.ok_or_else(|| BackendError::NoDevice {
        wanted: name.into(),
        found: list.iter().map(|device| device.name.clone()).chain(["auto".into()]).collect(),
    })
}

fn no_device(wanted: &str) -> BackendError {
    let names = devices().found.into_iter().map(|device| device.name);
    BackendError::NoDevice { wanted: wanted.into(), found: names.chain(["auto".into()]).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cpu_stands_in_where_a_device_does_not_relax() {
        for found in devices().found {
            let device = open(&found.name).unwrap();
            let cpu = stand_in(RestBy::Energy, &*device).unwrap();
            assert_eq!(cpu.map(|cpu| cpu.info().name.clone()), (!found.can.relax).then(|| "cpu".to_owned()));
            assert!(stand_in(RestBy::Contact, &*device).unwrap().is_none());
        }
    }

    fn device(name: &str) -> DeviceInfo {
        DeviceInfo { device: name.into(), ..SerialBackend::new().info().clone() }
    }

    #[test]
    fn a_device_is_found_by_its_number_or_a_part_of_its_name() {
        let list = [device("llvmpipe (LLVM 15)"), device("NVIDIA H200")];
        for (which, found) in [("0", Some(0)), ("1", Some(1)), ("nvidia", Some(1)), ("LLVM", Some(0))] {
            assert_eq!(find(&list, which), found, "{which}");
        }
        for which in ["", "2", "-1", "+1", "0x1", "99999999999999999999999", "radeon"] {
            assert_eq!(find(&list, which), None, "{which}");
        }
    }

    #[test]
    fn names_that_say_too_much_or_too_little_are_refused() {
        for name in ["", "auto:", "auto:7", "cpu:0", "wgpu:", "opencl:", "wgpu:/per-yarn", "vulkan:0"] {
            let Err(error) = open(name) else { panic!("{name} opened") };
            let refused = matches!(error, BackendError::NoDevice { .. } | BackendError::NoFeature { .. });
            assert!(refused, "{name}: {error}");
        }
    }

    #[test]
    fn a_family_that_this_build_lacks_is_said_to_need_its_feature() {
        for (name, is_there) in
            [("wgpu:0", cfg!(feature = "wgpu")), ("opencl:0/per-yarn", cfg!(feature = "opencl"))]
        {
            let lacks = matches!(open(name), Err(BackendError::NoFeature { .. }));
            assert_eq!(lacks, !is_there, "{name}");
        }
    }

    /// A device opens for pictures if, and only if, its capabilities have `draw`.
    #[cfg(feature = "render")]
    #[test]
    fn the_devices_that_draw_are_those_that_open_for_pictures() {
        for device in devices().found {
            match open_renderer(&device.name) {
                Ok(_) => assert!(device.can.draw, "{}", device.name),
                Err(BackendError::NoDevice { .. }) => assert!(!device.can.draw, "{}", device.name),
                Err(error) => panic!("{}: {error}", device.name),
            }
        }
    }

    #[cfg(feature = "render")]
    #[test]
    fn a_renderer_is_as_particular() {
        for name in ["", "auto:", "auto:7", "wgpu:", "opencl:0", "cpu"] {
            assert!(matches!(open_renderer(name), Err(BackendError::NoDevice { .. })), "{name}");
        }
    }
}
