//! The clearance of flat, flattened and plied yarns, which touch by their surfaces.

use texere_contact::clearance;
use texere_core::{ControlPoint, Material, Section, Settings, Yarn, Yarns};
use texere_fabric::{Shape, Thread, Weave, Woven};

use crate::contacts::yarns;
use crate::oracle::{ellipse, surface_clearance};

#[test]
fn flat_yarns_are_measured_by_their_surfaces() {
    // Straight yarns touch at the sum of their half heights if they cross, and of their half widths
    // if they lie side by side.
    let flat = ellipse(4.0);
    let crossing = |z: f32| {
        let along = vec![[-3.0, 0.0, 0.0, 0.25], [3.0, 0.0, 0.0, 0.25]];
        let across = vec![[0.4, -3.0, z, 0.25], [0.4, 3.0, z, 0.25]];
        clearance(&yarns(&flat, &[(false, along), (false, across)]), &Settings::default()).unwrap()
    };
    assert!((crossing(0.2625).min - 1.05).abs() < 1e-4);
    let beside = vec![[-3.0, 0.0, 0.0, 0.25], [3.0, 0.0, 0.0, 0.25]];
    let other = vec![[-3.0, 0.9, 0.0, 0.25], [3.0, 0.9, 0.0, 0.25]];
    let report = clearance(&yarns(&flat, &[(false, beside), (false, other)]), &Settings::default()).unwrap();
    assert!((report.min - 0.9).abs() < 1e-3, "{}", report.min);
}

/// Round sections that are flattened, also by different amounts along the yarn, are measured by
/// their surfaces as flat sections are.
#[test]
fn flattened_yarns_are_measured_by_their_surfaces() {
    let lay =
        |points: [[f32; 5]; 2]| points.map(|[x, y, z, a, b]| ControlPoint::new(x, y, z, a).flattened(a, b));
    let measured = |one: [[f32; 5]; 2], other: [[f32; 5]; 2]| {
        let mut yarns = Yarns::builder();
        yarns.yarn(Yarn::default(), &lay(one)).yarn(Yarn::default(), &lay(other));
        clearance(&yarns.build().unwrap(), &Settings::default()).unwrap().min
    };
    // If yarns cross, half heights add up. If they lie side by side, half widths do.
    let along = [[-3.0, 0.0, 0.0, 0.5, 0.125], [3.0, 0.0, 0.0, 0.5, 0.125]];
    let crossing = measured(along, [[0.4, -3.0, 0.2625, 0.5, 0.125], [0.4, 3.0, 0.2625, 0.5, 0.125]]);
    assert!((crossing - 1.05).abs() < 1e-4, "{crossing}");
    let beside = measured(along, [[-3.0, 0.9, 0.0, 0.5, 0.125], [3.0, 0.9, 0.0, 0.5, 0.125]]);
    assert!((beside - 0.9).abs() < 1e-3, "{beside}");
    // One yarn is flat at one end and round at the other. The other yarn crosses it half way, at
    // the mean of both sections.
    let changing = [[-3.0, 0.0, 0.0, 0.5, 0.125], [3.0, 0.0, 0.0, 0.25, 0.25]];
    let middle = measured(changing, [[0.0, -3.0, 0.25, 0.5, 0.125], [0.0, 3.0, 0.25, 0.5, 0.125]]);
    let slope = 0.125 / 6.0;
    assert!((middle - 0.25 / (0.1875 + 0.125)).abs() < slope, "{middle}");
}

/// Two equal ellipses touch if the distance of their centres is twice the reach of one in that
/// direction.
#[test]
fn flattened_yarns_beside_and_above_one_another() {
    let [half_width, half_height] = [0.25f32, 0.125];
    for across in [0.0f32, 0.1, 0.2, 0.3, 0.4] {
        for above in [0.0f32, 0.05, 0.1, 0.15, 0.2] {
            let expected = f64::from((across / (2.0 * half_width)).hypot(above / (2.0 * half_height)));
            if !(0.3..1.08).contains(&expected) {
                continue;
            }
            let lay = |y: f32, z: f32| {
                [-3.0, 3.0].map(|x| ControlPoint::new(x, y, z, 0.1).flattened(half_width, half_height))
            };
            let mut both = Yarns::builder();
            both.yarn(Yarn::default(), &lay(0.0, 0.0)).yarn(Yarn::default(), &lay(across, above));
            let found = clearance(&both.build().unwrap(), &Settings::default()).unwrap().min;
            assert!((found - expected).abs() < 1e-3, "{across}, {above}: {found} for {expected}");
        }
    }
}

/// A plied yarn that grows thicker, in a coil that comes near itself, has the same clearance if its
/// points are reversed.
#[test]
fn a_plied_yarn_meets_itself_from_either_end() {
    let coil = |reversed: bool| {
        let mut points: Vec<_> = (0..20)
            .map(|k| {
                let (sin, cos) = (k as f32 * 0.5).sin_cos();
                ControlPoint::new(0.6 * cos, 0.6 * sin, 0.032 * k as f32, 0.2 + 0.003 * k as f32)
            })
            .collect();
        if reversed {
            points.reverse();
        }
        let mut yarn = Yarns::builder();
        yarn.section(Section::plied(4));
        yarn.yarn(Yarn::default(), &points);
        clearance(&yarn.build().unwrap(), &Settings::default()).unwrap()
    };
    let [one, other] = [coil(false), coil(true)];
    assert!((0.5..1.05).contains(&one.min), "{one:?}");
    assert!((one.min - other.min).abs() < 3e-3, "{} and {}", one.min, other.min);
}

#[test]
fn a_cloth_of_flattened_threads_agrees_with_its_surfaces() {
    for (flatness, lower) in [(2.0, 1.0), (2.0, 0.85), (0.7, 1.0)] {
        let drawdown = Weave::parse("2/1").unwrap().drawdown(3, 3).unwrap();
        let set = vec![Thread { flatness, ..Thread::new(0.5, 0.1) }; 3];
        let cloth =
            Woven::new(drawdown, set.clone(), set, vec![Material::default()], vec![Section::Circle]).unwrap();
        let mut yarns = cloth.yarns().unwrap();
        for yarn in 0..yarns.layout().yarns().len() {
            let points = yarns.yarn_points(yarn).unwrap().to_vec();
            let points: Vec<_> = points.iter().map(|p| ControlPoint { z: p.z * lower, ..*p }).collect();
            yarns.set_points(yarn, &points).unwrap();
        }
        let found = clearance(&yarns, &Settings::default()).unwrap().min;
        let surface = surface_clearance(&yarns, 24, 96, [0.7, 1.1]);
        assert!((found - surface).abs() < 0.01, "flatness {flatness}: {found} and {surface}");
    }
}

#[test]
fn flat_cloth_agrees_with_its_surfaces() {
    for (aspect, flatten) in [(2.0, 1.0), (2.0, 0.85), (0.7, 1.0)] {
        let mut yarns = cloth_of(aspect);
        for yarn in 0..yarns.layout().yarns().len() {
            let points: Vec<_> = yarns.yarn_points(yarn).unwrap().to_vec();
            let points: Vec<_> = points.iter().map(|p| ControlPoint { z: p.z * flatten, ..*p }).collect();
            yarns.set_points(yarn, &points).unwrap();
        }
        let report = clearance(&yarns, &Settings::default()).unwrap();
        let surface = surface_clearance(&yarns, 24, 96, [0.7, 1.1]);
        assert!((report.min - surface).abs() < 0.01, "aspect {aspect}: {} and {surface}", report.min);
    }
}

fn cloth_of(aspect: f32) -> Yarns {
    let drawdown = Weave::parse("2/1").unwrap().drawdown(3, 3).unwrap();
    let set = vec![Thread::new(0.5, 0.1); 3];
    let mut cloth =
        Woven::new(drawdown, set.clone(), set, vec![Material::default()], vec![ellipse(aspect)]).unwrap();
    cloth.set_shape(Shape::Round);
    cloth.yarns().unwrap()
}
