//! Compares pictures with goldens, and with what they must show by geometry.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod hairs;
mod kept;
mod layers;
mod mesh_path;
mod scenes;
mod spectrum;

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock};

use image::RgbImage;
use texere_core::backend::Traffic;
use texere_core::settling::{Form, Pass, Settling, SettlingPlan, settled};
use texere_core::{Backend, ControlPoint, Frame, Limits, Material, Origin, Section, Settings, Yarn, Yarns};
use texere_shaders::picture;
use texere_wgpu::{Schedule, WgpuBackend};

use crate::rasteriser::{Keys, Rasteriser};
use crate::{Camera, Cut, Extent, Quality, RenderError, Renderer};

/// The device of lavapipe, which drew the goldens.
const DEVICE: &str = "llvmpipe";

/// The most that a picture may differ from its golden, by the mean of FLIP (Andersson et al. 2020),
/// a measure of the visible difference. It is not 0, because other versions of LLVM round some
/// pixels differently.
const TOLERANCE: f32 = 0.02;

const SIZE: [u32; 2] = [240, 180];
const SETTINGS: Settings = Settings {
    subdivisions: 3,
    sides: 12,
    frame: Frame::Upright,
    topology: texere_core::Topology::Indexed,
    caps: false,
    quantum: texere_core::Quantum::USUAL,
};

const ENDS: usize = 10;
const PICKS: usize = 8;

fn open(rasteriser: Rasteriser) -> Renderer {
    let device = WgpuBackend::open_named(DEVICE, Schedule::PerRing)
        .expect("lavapipe; on Debian and Ubuntu install mesa-vulkan-drivers");
    Renderer::with_rasteriser(device, rasteriser).unwrap()
}

/// One device for most tests. Pictures are drawn one at a time, so that lavapipe has all cores to
/// itself.
fn renderer() -> &'static Mutex<Renderer> {
    static RENDERER: OnceLock<Mutex<Renderer>> = OnceLock::new();
    RENDERER.get_or_init(|| Mutex::new(open(Rasteriser::new(Keys::Whole))))
}

/// A cloth of the test's own, so that goldens do not change when weaves do. [`TWILL`] is a 2/2
/// twill, with a millimetre from thread to thread, a twisted warp in two colours and a flat weft.
struct Cloth {
    up: fn(usize, usize) -> bool,
    end_color: fn(usize) -> u32,
    left_out: Option<Origin>,
}

const TWILL: Cloth = Cloth {
    up: |end, pick| (end + 4 * PICKS - pick) % 4 < 2,
    end_color: |end| u32::from(end % 5 == 4),
    left_out: None,
};

impl Cloth {
    fn yarns(&self) -> Yarns {
        let mut yarns = Yarns::builder();
        for (name, srgb) in [("navy", [38, 56, 110]), ("madder", [176, 54, 40]), ("linen", [222, 210, 184])] {
            yarns.material(Material { name: name.into(), srgb, ..Material::default() });
        }
        yarns.section(Section::Circle);
        yarns.section(Section::Ellipse { aspect: 1.6 });
        let mut add = |yarn: Yarn, points: Vec<ControlPoint>| {
            if self.left_out != Some(yarn.origin) {
                yarns.yarn(yarn, &points);
            }
        };
        let height = |up: bool| if up { 0.3 } else { -0.3 };
        for end in 0..ENDS {
            let x = end as f32 + 0.5;
            let points = (0..PICKS)
                .map(|pick| ControlPoint::new(x, pick as f32 + 0.5, height((self.up)(end, pick)), 0.3));
            let origin = Origin::End(end as u32 + 1);
            let yarn = Yarn { material: (self.end_color)(end), twist: 1.8, origin, ..Yarn::default() };
            add(yarn, points.collect());
        }
        for pick in 0..PICKS {
            let y = pick as f32 + 0.5;
            let points = (0..ENDS)
                .map(|end| ControlPoint::new(end as f32 + 0.5, y, height(!(self.up)(end, pick)), 0.28));
            let origin = Origin::Pick(pick as u32 + 1);
            add(Yarn { material: 2, section: 1, origin, ..Yarn::default() }, points.collect());
        }
        yarns.build().unwrap()
    }
}

/// The views that have goldens.
fn cameras(extent: &Extent) -> [(&'static str, Camera); 5] {
    let at = [5.0, 3.5];
    [
        ("face", Camera::face(extent, SIZE)),
        ("back", Camera::face(extent, SIZE).turned_over()),
        ("oblique", Camera::oblique(extent, -0.5, SIZE).unwrap()),
        ("close-up", Camera::close_up(extent, at, 5.0, SIZE).unwrap()),
        ("cut", Camera::cut(extent, Cut::Warp, at, 8.0, SIZE).unwrap()),
    ]
}

/// The view that has a golden of hairs.
fn near(yarns: &Yarns) -> Camera {
    Camera::close_up(&Extent::of(yarns), [5.0, 3.5], 2.5, SIZE).unwrap()
}

fn draw(renderer: &Renderer, yarns: &Yarns, camera: &Camera, limits: &Limits) -> RgbImage {
    let mut scene = renderer.scene(yarns, &SETTINGS).unwrap().with_limits(limits);
    let picture = scene.picture(camera, Quality { supersampling: 1, ..Quality::default() }).unwrap();
    image_of(picture.size, picture.rgb)
}

fn image_of(size: [u32; 2], rgb: Vec<u8>) -> RgbImage {
    RgbImage::from_raw(size[0], size[1], rgb).unwrap()
}

fn picture(yarns: &Yarns, camera: &Camera) -> RgbImage {
    draw(&renderer().lock().unwrap(), yarns, camera, &Limits::NONE)
}

/// The visible difference of two pictures: 0 for equal pictures, 1 for black against white.
fn difference(one: &RgbImage, other: &RgbImage) -> f32 {
    assert_eq!(one.dimensions(), other.dimensions());
    let [one, other] = [one, other]
        .map(|image| nv_flip::FlipImageRgb8::with_data(image.width(), image.height(), image.as_raw()));
    let map = nv_flip::flip(one, other, nv_flip::DEFAULT_PIXELS_PER_DEGREE);
    nv_flip::FlipPool::from_image(&map).mean()
}

fn golden_path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("goldens").join(name).with_extension("png")
}

fn golden(name: &str) -> RgbImage {
    image::open(golden_path(name)).unwrap_or_else(|error| panic!("golden {name}: {error}")).into_rgb8()
}

#[test]
fn pictures_are_their_goldens() {
    let yarns = TWILL.yarns();
    let mut wrong = Vec::new();
    let mut check = |name: &str, drawn: RgbImage| {
        let off = image::open(golden_path(name)).map(|golden| difference(&drawn, &golden.into_rgb8()));
        if !off.as_ref().is_ok_and(|off| *off <= TOLERANCE) {
            let kept = std::env::temp_dir().join(format!("texere-{name}.png"));
            drawn.save(&kept).unwrap();
            wrong.push(format!("{name}: {off:?}; what was drawn is {}", kept.display()));
        }
    };
    for (name, camera) in cameras(&Extent::of(&yarns)) {
        check(name, picture(&yarns, &camera));
    }
    check("hairs", picture(&hairs::hairy(&yarns, 8.0), &near(&yarns)));
    assert!(wrong.is_empty(), "look at these, and where they are right put them into goldens/: {wrong:#?}");
}

/// Tests that a wrong picture is found to differ from its golden.
fn assert_seen(what: &str, name: &str, drawn: &RgbImage) {
    let off = difference(drawn, &golden(name));
    assert!(off > TOLERANCE, "{what} is off by {off} only");
}

#[test]
fn broken_cloths_are_not_the_golden() {
    let camera = Camera::face(&Extent::of(&TWILL.yarns()), SIZE);
    let broken = [
        (
            "a pick shifted by one end",
            Cloth { up: |end, pick| (end + 4 * PICKS - pick + usize::from(pick == 3)) % 4 < 2, ..TWILL },
        ),
        ("a lost end", Cloth { left_out: Some(Origin::End(6)), ..TWILL }),
        ("a lost pick", Cloth { left_out: Some(Origin::Pick(3)), ..TWILL }),
        ("two ends of swapped colours", Cloth { end_color: |end| u32::from(end == 3 || end == 9), ..TWILL }),
    ];
    for (what, cloth) in broken {
        assert_seen(what, "face", &picture(&cloth.yarns(), &camera));
    }
    let yarns = TWILL.yarns();
    assert_seen("bald yarns", "hairs", &picture(&yarns, &near(&yarns)));
}

#[test]
fn a_flipped_normal_is_not_the_golden() {
    let source = picture::RESOLVE
        .replace("kept_of(normal, fibre,", "kept_of(select(normal, -normal, block.yarn == 13u), fibre,");
    assert_ne!(source, picture::RESOLVE);
    let yarns = TWILL.yarns();
    let camera = Camera::face(&Extent::of(&yarns), SIZE);
    assert_seen(
        "a yarn of flipped normals",
        "face",
        &draw(&open(Rasteriser::new(Keys::Whole).with_resolve(source)), &yarns, &camera, &Limits::NONE),
    );
}

#[test]
fn a_missing_golden_fails() {
    assert!(std::panic::catch_unwind(|| golden("never-drawn")).is_err());
}

#[test]
fn chunks_draw_the_same_picture() {
    let yarns = TWILL.yarns();
    let extent = Extent::of(&yarns);
    // A chunk has one block and the ring that it repeats, so every yarn of more than 64 rings is
    // cut.
    let long = Settings { subdivisions: 11, ..SETTINGS };
    let renderer = renderer().lock().unwrap();
    for (name, camera) in cameras(&extent) {
        let draw = |limits: &Limits| {
            let mut scene = renderer.scene(&yarns, &long).unwrap().with_limits(limits);
            assert!(scene.plan().rings(0) > 64);
            scene.picture(&camera, Quality { supersampling: 1, ..Quality::default() }).unwrap().rgb
        };
        assert!(draw(&Limits::NONE) == draw(&Limits { blocks: 2, ..Limits::NONE }), "{name}");
    }
}

/// The keys of the screen's samples do not fit one binding, so the picture is drawn in bands.
#[test]
fn bands_draw_the_same_picture() {
    let yarns = TWILL.yarns();
    let whole = renderer().lock().unwrap();
    // These limits allow eight rows of the screen at a time.
    let limits = Limits { binding_bytes: 1 << 16, ..Limits::NONE };
    let device = whole.backend().clone().with_limits(limits);
    let in_bands = Renderer::with_rasteriser(device, Rasteriser::new(Keys::Whole)).unwrap();
    for (name, camera) in cameras(&Extent::of(&yarns)) {
        let [one, other] =
            [&*whole, &in_bands].map(|renderer| draw(renderer, &yarns, &camera, &Limits::NONE));
        assert!(one == other, "{name}");
    }
}

/// Tests that settled yarns are drawn without a byte of them going through the host. The picture is
/// that of the same yarns sent from the host, and the box round them is hardly larger.
#[test]
fn settled_yarns_are_drawn_where_they_rest() {
    let yarns = TWILL.yarns();
    let renderer = renderer().lock().unwrap();
    let plan = Arc::new(SettlingPlan::new(&Settling::new(&yarns)).unwrap());
    let mut settler = renderer.backend().settler(Arc::clone(&plan)).unwrap();
    let places: Vec<_> = yarns.points().iter().map(|point| plan.scale().place(point)).collect();
    settler.upload(&places).unwrap();
    settler.list(1.0).unwrap();
    for _ in 0..8 {
        settler.pass(&Pass { form: Form::Weighted, growth: 1.0, ease: 1.0, momentum: 0.8 }).unwrap();
    }
    // In a rotation minimising frame a yarn is drawn in the same way, whether it was steep at the
    // start or is so at rest.
    let settings = Settings { frame: Frame::RotationMinimizing, ..SETTINGS };
    let mut scene = renderer.settled_scene(&yarns, &settings, settler.as_mut()).unwrap();
    assert_eq!(scene.traffic(), Traffic::default());
    let camera = Camera::oblique(scene.extent(), -0.5, SIZE).unwrap();
    let picture = scene.picture(&camera, Quality { supersampling: 1, ..Quality::default() }).unwrap();
    let drawn = RgbImage::from_raw(picture.size[0], picture.size[1], picture.rgb).unwrap();

    let points = settled(&plan, settler.as_mut(), yarns.points()).unwrap();
    let mut moved = yarns.clone();
    for (yarn, pair) in yarns.layout().offsets().windows(2).enumerate() {
        moved.set_points(yarn, &points[pair[0] as usize..pair[1] as usize]).unwrap();
    }
    let (here, there) = (scene.extent(), Extent::of(&moved));
    for axis in 0..3 {
        // All yarns count as wide as the widest.
        let widest = plan.spans().thickest;
        assert!(
            (0.0..2.0 * widest).contains(&(there.low[axis] - here.low[axis] + 1e-4)),
            "{here:?} {there:?}"
        );
        assert!(
            (0.0..2.0 * widest).contains(&(here.high[axis] - there.high[axis] + 1e-4)),
            "{here:?} {there:?}"
        );
    }
    let drawn_at = |yarns: &Yarns| {
        let mut scene = renderer.scene(yarns, &settings).unwrap();
        let picture = scene.picture(&camera, Quality { supersampling: 1, ..Quality::default() }).unwrap();
        image_of(picture.size, picture.rgb)
    };
    let sent = drawn_at(&moved);
    assert!(difference(&drawn, &sent) < 1e-3, "{}", difference(&drawn, &sent));
    // The yarns have moved so far that the picture shows it.
    let start = drawn_at(&yarns);
    assert!(difference(&start, &sent) > 5e-3, "{}", difference(&start, &sent));
}

/// A picture that is drawn from control points shows what the mesh shows on the device's own
/// rasteriser.
#[test]
fn pictures_are_those_of_the_mesh() {
    let renderer = renderer().lock().unwrap();
    let flat = flattened(&TWILL.yarns());
    // The cloth is bent down to either side, as over an arm.
    let bent = flat.mapped(|[x, y, z]| {
        let (sin, cos) = ((x - 5.0) / 6.0).sin_cos();
        [5.0 + (6.0 + z) * sin, y, (6.0 + z) * cos - 6.0]
    });
    for (cloth, yarns) in [("twill", TWILL.yarns()), ("flattened", flat), ("bent", bent.unwrap())] {
        let extent = Extent::of(&yarns);
        // In small pictures threads are one and a half pixels wide and less, with a dozen triangles
        // for each sample. The near view has triangles of many pixels.
        let small = [0.6, 1.1].map(|scale| ("small", Camera::true_scale(&extent, scale).unwrap()));
        let near = [("near", Camera::close_up(&extent, [5.0, 3.5], 0.4, SIZE).unwrap())];
        for (name, camera) in cameras(&extent).into_iter().chain(small).chain(near) {
            let mut scene = renderer.scene(&yarns, &SETTINGS).unwrap();
            let judged = mesh_path::judge(&mut scene, &camera);
            let off = difference(&judged.pictures[0], &judged.pictures[1]);
            // Samples on an edge may fall to either side of it. Small pictures have edges
            // everywhere. Their pixels' middles often lie outside of triangles, where rasterisers
            // extrapolate all kinds of normals.
            println!("{cloth} {name}: samples {:.5}, picture {off:.4}", judged.off);
            let (most, tolerance) = if name == "small" { (0.01, 0.15) } else { (0.001, TOLERANCE) };
            assert!(judged.off <= most && off <= tolerance, "{cloth} {name}: {} {off}", judged.off);
        }
    }
}

/// A copy whose yarns are three quarters as high as wide.
fn flattened(yarns: &Yarns) -> Yarns {
    let mut flat = yarns.clone();
    for yarn in 0..yarns.layout().yarns().len() {
        let points: Vec<_> =
            yarns.yarn_points(yarn).unwrap().iter().map(|point| point.flattened(0.32, 0.24)).collect();
        flat.set_points(yarn, &points).unwrap();
    }
    flat
}

/// Either kind of atomics gives the same bytes.
#[test]
fn either_kind_of_atomics_gives_the_same_picture() {
    let yarns = TWILL.yarns();
    let in_rounds = open(Rasteriser::new(Keys::InRounds));
    let whole = renderer().lock().unwrap();
    for (name, camera) in cameras(&Extent::of(&yarns)) {
        let [one, other] =
            [&*whole, &in_rounds].map(|renderer| draw(renderer, &yarns, &camera, &Limits::NONE));
        assert!(one == other, "{name}");
    }
}

/// Whether a pixel shows red yarn and not the grey ground.
fn is_red(image: &RgbImage, x: u32, y: u32) -> bool {
    let [red, green, blue] = image.get_pixel(x, y).0.map(i32::from);
    red > green + 25 && red > blue + 25
}

/// Two red yarns of radius 0.5 mm along y, at x = 1 and x = 6 mm. The second is half as long.
fn two_yarns() -> Yarns {
    let mut yarns = Yarns::builder();
    yarns.material(Material { srgb: [200, 30, 30], ..Material::default() });
    for (x, length) in [(1.0, 8.0), (6.0, 4.0)] {
        yarns.yarn(Yarn::default(), &[0.0, length].map(|y| ControlPoint::new(x, y, 0.0, 0.5)));
    }
    yarns.build().unwrap()
}

#[test]
fn true_scale_is_true() {
    let yarns = two_yarns();
    // The box goes from 0.5 to 6.5 mm in x and from -0.5 to 8.5 mm in y, because each point counts
    // as wide as its yarn.
    let camera = Camera::true_scale(&Extent::of(&yarns), 0.05).unwrap();
    assert_eq!(camera.size(), [120, 180]);
    let drawn = picture(&yarns, &camera);
    let red_in = |xs: std::ops::Range<u32>, y| xs.filter(|&x| is_red(&drawn, x, y)).count();
    // A millimetre is twenty pixels, and a tube of twelve sides is as wide as its circle.
    for y in [100, 150] {
        assert!(red_in(0..60, y).abs_diff(20) <= 1, "{}", red_in(0..60, y));
        assert!(red_in(60..120, y).abs_diff(20) <= 1, "{}", red_in(60..120, y));
    }
    // The first yarn ends 0.5 mm below the top of the picture (y = 8), the second 4.5 mm (y = 4).
    let top = |x| (0..180).find(|&y| is_red(&drawn, x, y)).unwrap();
    assert!(top(10).abs_diff(10) <= 1 && top(110).abs_diff(90) <= 1, "{} {}", top(10), top(110));
}

/// The yarns are straight tubes. If they were hollow, one would see through them to the other side.
#[test]
fn a_cut_shows_solid_yarns() {
    let yarns = two_yarns();
    let extent = Extent::of(&yarns);
    // The cut goes across both yarns at y = 3. A millimetre is twenty pixels, and x = 3.5 mm and z
    // = 0 are in the middle.
    let drawn = picture(&yarns, &Camera::cut(&extent, Cut::Warp, [3.5, 3.0], 7.0, [140, 40]).unwrap());
    for x in [20, 120] {
        let section: Vec<_> = (x - 6..=x + 6).flat_map(|x| (14..=26).map(move |y| (x, y))).collect();
        assert!(section.iter().all(|&(x, y)| is_red(&drawn, x, y)), "{x}");
        // The section is one plane in one light.
        let colors: std::collections::HashSet<_> =
            section.iter().map(|&(x, y)| drawn.get_pixel(x, y).0).collect();
        assert_eq!(colors.len(), 1, "{colors:?}");
        assert!(!is_red(&drawn, x, 4) && !is_red(&drawn, 70, 20));
    }
}

#[test]
fn the_back_is_turned_over_sideways() {
    let yarns = two_yarns();
    let extent = Extent::of(&yarns);
    let shorter_is_left = |camera: Camera| {
        let drawn = picture(&yarns, &camera);
        let [wide, high] = camera.size();
        let reds = |xs: std::ops::Range<u32>| {
            xs.flat_map(|x| (0..high).map(move |y| (x, y))).filter(|&(x, y)| is_red(&drawn, x, y)).count()
        };
        reds(0..wide / 2) < reds(wide / 2..wide)
    };
    assert!(!shorter_is_left(Camera::true_scale(&extent, 0.05).unwrap()));
    assert!(shorter_is_left(Camera::true_scale(&extent, 0.05).unwrap().turned_over()));
}

#[test]
fn sizes_that_no_texture_has_and_views_of_nothing_are_refused() {
    let yarns = two_yarns();
    let extent = Extent::of(&yarns);
    let renderer = renderer().lock().unwrap();
    let mut scene = renderer.scene(&yarns, &SETTINGS).unwrap();
    for (size, supersampling) in [([0, 10], 1), ([1 << 20, 10], 1), ([1 << 31, 1], 2), ([0, 1], 0)] {
        let refused =
            scene.picture(&Camera::face(&extent, size), Quality { supersampling, ..Quality::default() });
        assert!(matches!(refused, Err(RenderError::Size { .. })), "{size:?}");
    }
    // A picture that fits without supersampling is refused because of the supersampling.
    let limit = renderer.side_limit();
    for (size, given, most) in [([10, 10], 0, limit / 10), ([limit, 1], 2, 1), ([1, limit / 2], 3, 2)] {
        match scene
            .picture(&Camera::face(&extent, size), Quality { supersampling: given, ..Quality::default() })
        {
            Err(RenderError::Supersampling { supersampling, most: allowed, .. }) => {
                assert_eq!((supersampling, allowed), (given, most), "{size:?}");
            }
            other => panic!("{size:?}: {other:?}"),
        }
    }
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let refused = [
            Camera::oblique(&extent, value, SIZE),
            Camera::close_up(&extent, [value, 1.0], 1.0, SIZE),
            Camera::close_up(&extent, [1.0, value], 1.0, SIZE),
            Camera::cut(&extent, Cut::Warp, [value, 1.0], 1.0, SIZE),
            Camera::cut(&extent, Cut::Weft, [1.0, value], 1.0, SIZE),
        ];
        assert!(refused.iter().all(|camera| matches!(camera, Err(RenderError::Camera { .. }))), "{value}");
    }
    for value in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let refused = [
            Camera::true_scale(&extent, value),
            Camera::close_up(&extent, [1.0, 1.0], value, SIZE),
            Camera::cut(&extent, Cut::Weft, [1.0, 1.0], value, SIZE),
        ];
        assert!(refused.iter().all(|camera| matches!(camera, Err(RenderError::Camera { .. }))), "{value}");
    }
}
