//! Measures against cases worked by hand.

use texere_contact::lengths_mm;
use texere_core::{ControlPoint, Material, Section, Yarn, Yarns};
use texere_fabric::{
    BySet, Crimp, Drawdown, FabricError, Measures, Shape, Thread, Weave, Woven, WovenError,
    lengths_by_material, thickness_mm, weight_g,
};

fn material(tex: Option<f32>) -> Material {
    Material { tex, ..Material::default() }
}

/// 100 × 80 threads, 25 ends and 20 picks a cm.
fn cloth(tex: [Option<f32>; 2]) -> Woven {
    open_cloth(tex, 0.4)
}

/// The cloth of [`cloth`] with other spacings of its ends.
fn open_cloth(tex: [Option<f32>; 2], spacing_mm: f64) -> Woven {
    let (warp, weft) = (Thread::new(spacing_mm, 0.1), Thread { material: 1, ..Thread::new(0.5, 0.12) });
    let drawdown = Weave::parse("plain").unwrap().drawdown(100, 80).unwrap();
    let materials = tex.map(material).to_vec();
    let mut cloth =
        Woven::new(drawdown, vec![warp; 100], vec![weft; 80], materials, vec![Section::Circle]).unwrap();
    cloth.set_shape(Shape::Round);
    cloth
}

fn measures(cloth: &Woven) -> Measures {
    Measures::new(cloth, &cloth.yarns().unwrap()).unwrap()
}

#[test]
fn straight_ends_have_no_crimp_and_the_weft_has_it_all() {
    let mut cloth = open_cloth([Some(20.0), Some(30.0)], 1.0);
    cloth.set_crimp(Crimp::WarpShare(0.0)).unwrap();
    let BySet { warp, weft } = measures(&cloth).crimp.unwrap();
    assert!(warp.abs() < 1e-6, "{warp}");
    // Peirce has h = 4/3 p √c. The wave is 0.44 mm high over half its length, 1 mm, so that c =
    // (0.75 × 0.44)² = 0.109.
    assert!((weft / 0.109 - 1.0).abs() < 0.1, "{weft}");
}

#[test]
fn weight_is_length_times_tex_over_area() {
    let cloth = cloth([Some(20.0), Some(30.0)]);
    let measures = measures(&cloth);
    // The weight is 0.1 × [25 × (1 + c₁) × 20 + 20 × (1 + c₂) × 30] g/m².
    let BySet { warp, weft } = measures.crimp.unwrap();
    let by_hand = 0.1 * (25.0 * (1.0 + warp) * 20.0 + 20.0 * (1.0 + weft) * 30.0);
    assert!((measures.areal_weight.unwrap() / by_hand - 1.0).abs() < 1e-9);
    // There are 100 ends of 40 mm and 80 picks of 40 mm.
    assert!((measures.length_mm[0] / (4000.0 * (1.0 + warp)) - 1.0).abs() < 1e-9);
    assert!((measures.length_mm[1] / (3200.0 * (1.0 + weft)) - 1.0).abs() < 1e-9);
}

#[test]
fn weight_needs_the_tex_of_what_is_used() {
    assert_eq!(measures(&cloth([Some(20.0), None])).areal_weight, None);
    assert_eq!(measures(&cloth([Some(20.0), None])).cover.unwrap().factor, None);
    // A kilometre of 30 tex weighs 30 g. Materials that are not used need no tex.
    assert_eq!(weight_g(&[1e6, 0.0], &[material(Some(30.0)), material(None)]), Some(30.0));
    assert_eq!(weight_g(&[1e6, 1.0], &[material(Some(30.0)), material(None)]), None);
}

#[test]
fn cover_is_peirces() {
    let measures = measures(&cloth([Some(19.6836), Some(29.5253)]));
    // Widths are half floats, good to 2.5e-4. Diameters over spacings: 0.2/0.4 and 0.24/0.5,
    // together 0.5 + 0.48 - 0.24.
    let cover = measures.cover.unwrap();
    assert!(
        (cover.fraction.warp / 0.5 - 1.0).abs() < 2.5e-4 && (cover.fraction.weft / 0.48 - 1.0).abs() < 2.5e-4
    );
    assert!((cover.cloth / 0.74 - 1.0).abs() < 2.5e-4);
    // 63.5 ends to the inch of Ne 30 give 63.5/√30 = 11.593. 50.8 picks to the inch of Ne 20 give
    // 50.8/√20 = 11.359.
    let BySet { warp, weft } = cover.factor.unwrap();
    assert!((warp - 11.593).abs() < 1e-3 && (weft - 11.359).abs() < 1e-3, "{warp}, {weft}");
    // 11.593 + 11.359 - 11.593 × 11.359 / 28 = 18.249.
    assert!((cover.cloth_factor.unwrap() - 18.249).abs() < 2e-3);
}

#[test]
fn threads_wider_than_their_spacing_cover_everything() {
    let thread = Thread::new(0.4, 0.3);
    let drawdown = Drawdown::new(4, 4).unwrap();
    let sections = vec![Section::Ellipse { aspect: 4.0 }];
    let cloth = Woven::new(drawdown, vec![thread; 4], vec![thread; 4], vec![material(None)], sections);
    let cover = measures(&cloth.unwrap()).cover.unwrap();
    assert_eq!((cover.fraction, cover.cloth), (BySet { warp: 1.0, weft: 1.0 }, 1.0));
}

#[test]
fn thickness_is_from_surface_to_surface() {
    // Plain cloth of threads 0.2 and 0.24 mm thick, with half the crimp each. Centrelines lie at
    // ±0.11 mm, and the picks reach 0.12 mm further.
    let mut cloth = cloth([None; 2]);
    cloth.set_crimp(Crimp::WarpShare(0.5)).unwrap();
    assert!((measures(&cloth).thickness_mm - 2.0 * (0.11 + 0.12)).abs() < 2e-3);
    // Ends are straight and lie in the middle of the cloth. Only the picks swing out, by 0.22 mm to
    // each side.
    let mut cloth = open_cloth([None; 2], 1.0);
    cloth.set_crimp(Crimp::WarpShare(0.0)).unwrap();
    let thickness = measures(&cloth).thickness_mm;
    assert!((thickness - 2.0 * (0.22 + 0.12)).abs() < 0.01, "{thickness}");
}

#[test]
fn flat_and_leaning_sections_count_with_their_own_height() {
    let yarn = |section: Section, up: [f32; 3]| {
        let mut yarns = Yarns::builder();
        yarns.section(section);
        let points = [0.0f32, 1.0, 2.0].map(|t| ControlPoint::new(t * up[0], t * up[1], t * up[2], 0.5));
        yarns.yarn(Yarn::default(), &points);
        yarns.build().unwrap()
    };
    // Sections half as high as the circle, and twice as wide.
    let flat = thickness_mm(&yarn(Section::Ellipse { aspect: 4.0 }, [1.0, 0.0, 0.0]));
    assert!((flat - 0.5).abs() < 1e-5, "{flat}");
    // An upright yarn is as high as its length. At 45 degrees 1/√2 of the section's height is
    // added.
    assert!((thickness_mm(&yarn(Section::Circle, [0.0, 0.0, 1.0])) - 2.0).abs() < 1e-5);
    let leaning = thickness_mm(&yarn(Section::Circle, [1.0, 0.0, 1.0]));
    assert!((leaning - (2.0 + 0.5f64.sqrt())).abs() < 1e-5, "{leaning}");
}

#[test]
fn a_selvedge_costs_yarn() {
    let mut cloth = cloth([Some(20.0), Some(30.0)]);
    let cut = measures(&cloth);
    cloth.set_selvedge(true);
    let turning = measures(&cloth);
    assert_eq!(turning.crimp.unwrap().warp, cut.crimp.unwrap().warp);
    // There are 79 turns, each a half circle with a radius of 0.25 mm.
    let more = turning.length_mm[1] - cut.length_mm[1];
    assert!((more / (79.0 * 0.25 * std::f64::consts::PI) - 1.0).abs() < 0.2, "{more}");
}

#[test]
fn lengths_go_to_their_materials() {
    let cloth = cloth([None; 2]);
    let yarns = cloth.yarns().unwrap();
    let lengths = lengths_mm(&yarns);
    let [warp, weft] = [lengths[..100].iter().sum::<f64>(), lengths[100..].iter().sum::<f64>()];
    assert_eq!(lengths_by_material(&yarns, &lengths), [warp, weft]);
}

#[test]
fn yarns_of_another_cloth_are_refused() {
    let cloth = cloth([None; 2]);
    let mut other = cloth.clone();
    other.set_selvedge(true);
    let error = Measures::new(&cloth, &other.yarns().unwrap()).unwrap_err();
    assert!(matches!(error, FabricError::Woven(WovenError::OtherCloth { yarn: 101 })), "{error}");
}
