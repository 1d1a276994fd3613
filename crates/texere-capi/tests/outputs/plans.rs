//! Plans of the library, devices, and yarns to try them with.

use std::ffi::CStr;
use std::path::Path;
use std::ptr::{from_mut, null, null_mut};
use std::slice::from_raw_parts;

use texere::mesh::Topology;
use texere::{Settings, Yarns};
use texere_c::texere_status::*;
use texere_c::*;

pub(crate) fn message() -> String {
    // SAFETY: the library ends it with a zero byte.
    unsafe { CStr::from_ptr(texere_error_message()) }.to_str().unwrap().to_owned()
}

pub(crate) fn ok(status: texere_status) {
    assert_eq!(status, TEXERE_OK, "{}", message());
}

/// The names of the devices that open on this machine. The test fails if one that `TEXERE_REQUIRE`
/// names does not open.
pub(crate) fn devices() -> Vec<&'static str> {
    let required = std::env::var("TEXERE_REQUIRE").unwrap_or_default();
    let mut all = vec!["cpu", "opencl", "wgpu"];
    all.retain(|name| match texere::open(name) {
        Ok(_) => true,
        Err(error) => {
            assert!(!required.split(',').any(|wanted| wanted == *name), "{name}: {error}");
            false
        }
    });
    all
}

/// A weave, a weft knit and a warp knit with their yarns as placed, and yarns whose mesh needs
/// several chunks.
pub(crate) fn subjects() -> Vec<(&'static str, Yarns)> {
    let designs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../designs");
    let placed = |name: &'static str| {
        (name, texere::read(designs.join(name)).unwrap().placed(0.0).unwrap().yarns().clone())
    };
    // Each yarn has 20,000 control points for each 8 MiB of a chunk's largest buffer.
    let points = 20_000 * (crate::limits().binding_bytes >> 23) as u32;
    let mut several = Yarns::builder();
    for number in 0..3_u32 {
        let wave = |place: u32| {
            let along = place as f32 * 0.2;
            texere::ControlPoint::new(along, number as f32 + (along * 0.7).sin(), (along * 0.3).cos(), 0.1)
        };
        let yarn = texere::Yarn { twist: number as f32, ..texere::Yarn::default() };
        several.yarn(yarn, &(0..points).map(wave).collect::<Vec<_>>());
    }
    let several = ("several chunks", several.build().unwrap());
    vec![placed("denim.toml"), placed("jersey.toml"), placed("tricot.toml"), several]
}

/// A plan of the library, with its counts.
pub(crate) struct Plan {
    pub(crate) handle: *mut texere_plan,
    device: *mut texere_device,
    pub(crate) counts: texere_counts,
}

impl Plan {
    /// The plan of `yarns` with these settings. The yarns get to the library through a file.
    pub(crate) fn new(yarns: &Yarns, device: &str, settings: &Settings) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("all.yarns");
        texere::write::yarns(yarns, &file).unwrap();
        let path = file.to_str().unwrap();
        let mut plan = Self { handle: null_mut(), device: null_mut(), counts: sized() };
        let mut own = null_mut();
        // SAFETY: all pointers are those of values that live as long as the calls.
        unsafe {
            ok(texere_device_open(device.as_ptr().cast(), device.len(), &mut plan.device));
            ok(texere_yarns_read(path.as_ptr().cast(), path.len(), &mut own));
            let chosen = texere_settings {
                subdivisions: settings.subdivisions,
                sides: settings.sides,
                topology: match settings.topology {
                    Topology::Indexed => TEXERE_TOPOLOGY_INDEXED,
                    Topology::Shared => TEXERE_TOPOLOGY_SHARED,
                    Topology::None => TEXERE_TOPOLOGY_NONE,
                },
                caps: u32::from(settings.caps),
                quantum_mm: settings.quantum.mm(),
                ..sized()
            };
            ok(texere_plan_new(own, plan.device, &chosen, &mut plan.handle));
            ok(texere_plan_counts(plan.handle, &mut plan.counts));
            texere_yarns_free(own);
        }
        plan
    }

    pub(crate) fn mesh(&self) -> (Vec<texere_vertex>, Vec<u32>) {
        let mut vertices = vec![VERTEX; self.counts.vertices as usize];
        let mut indices = vec![7; self.counts.indices as usize];
        let (count, index_count) = (self.counts.vertices, self.counts.indices);
        // SAFETY: the arrays have the lengths that the counts say.
        ok(unsafe {
            texere_plan_mesh(
                self.handle,
                null(),
                vertices.as_mut_ptr(),
                count,
                indices.as_mut_ptr(),
                index_count,
            )
        });
        (vertices, indices)
    }
}

impl Drop for Plan {
    fn drop(&mut self) {
        // SAFETY: the library looks handles up.
        unsafe {
            texere_plan_free(self.handle);
            texere_device_free(self.device);
        }
    }
}

pub(crate) const VERTEX: texere_vertex = texere_vertex { position: [9.0; 3], normal: [9.0; 3] };

/// A struct of zeros with its size set.
pub(crate) fn sized<T>() -> T {
    // SAFETY: the tests call it only for structs of the library. Zeros are a valid value of each,
    // and each begins with a `u32`.
    unsafe {
        let mut zeros: T = std::mem::zeroed();
        from_mut(&mut zeros).cast::<u32>().write(size_of::<T>() as u32);
        zeros
    }
}

/// A view of all values of an array.
pub(crate) fn whole<T>(values: &mut [T]) -> texere_view {
    let (size, stride) = (size_of_val(values) as u64, size_of::<T>() as u64);
    texere_view { data: values.as_mut_ptr().cast(), size, stride }
}

/// The bytes of values of a plain type.
pub(crate) fn bytes<T>(values: &[T]) -> &[u8] {
    // SAFETY: the tests call this only for types without padding between their members.
    unsafe { from_raw_parts(values.as_ptr().cast(), size_of_val(values)) }
}
