//! The clearance report against brute force, and against yarns whose clearance is known.

use std::f64::consts::TAU;

use proptest::prelude::*;
use texere_contact::{CLEARANCE_ACCURACY, CLEARANCE_NEAR, CONTACTS_LISTED, ContactError, clearance};
use texere_core::definitions::Segment;
use texere_core::{ControlPoint, Material, PlanError, Section, Settings, Yarn, YarnPlace, Yarns};
use texere_fabric::{NO_CROSSING, Shape, Thread, Weave, Woven};

use crate::downhill::{bend, downhill, four, place};
use crate::oracle::{refined_clearance, round_clearance};

pub(crate) fn yarns(section: &Section, each: &[(bool, Vec<[f32; 4]>)]) -> Yarns {
    let mut yarns = Yarns::builder();
    yarns.section(section.clone());
    for (closed, points) in each {
        let points: Vec<_> = points.iter().map(|[x, y, z, r]| ControlPoint::new(*x, *y, *z, *r)).collect();
        yarns.yarn(Yarn { closed: *closed, ..Yarn::default() }, &points);
    }
    yarns.build().unwrap()
}

fn cloth(section: Section) -> Yarns {
    let drawdown = Weave::parse("2/2").unwrap().drawdown(12, 12).unwrap();
    let thread = Thread::new(0.5, 0.1);
    let set = vec![thread; 12];
    let mut cloth = Woven::new(drawdown, set.clone(), set, vec![Material::default()], vec![section]).unwrap();
    cloth.set_shape(Shape::Round);
    cloth.yarns().unwrap()
}

/// Yarns of random points in a box of 4 mm. They are of even thickness, or each point has its own.
/// They come near one another, pierce, and bend sharply.
fn tangles() -> impl Strategy<Value = Yarns> {
    // The lower bound is a power of two. With a lower bound of finer digits than the upper one,
    // proptest 1.12 rarely fails an assertion of its own.
    let point = [0.0..4.0f32, 0.0..4.0f32, 0.0..4.0f32, 0.125..0.25f32];
    let yarn = (any::<bool>(), any::<bool>(), prop::collection::vec(point, 3..7));
    prop::collection::vec(yarn, 2..6).prop_map(|each| {
        let yarn = |(closed, even, mut points): (bool, bool, Vec<[f32; 4]>)| {
            if even {
                let radius = points[0][3];
                points.iter_mut().for_each(|point| point[3] = radius);
            }
            (closed, points)
        };
        yarns(&Section::Circle, &each.into_iter().map(yarn).collect::<Vec<_>>())
    })
}

/// Yarns of even thickness and many points, each a few radii from the one before. Most intervals
/// that come near one another pass by without a contact.
fn even_tangles() -> impl Strategy<Value = Yarns> {
    let step = [-0.4..0.4f32, -0.4..0.4f32, -0.4..0.4f32];
    let yarn = (any::<bool>(), [0.0..1.0f32, 0.0..1.0f32, 0.0..1.0f32], prop::collection::vec(step, 8..20));
    prop::collection::vec(yarn, 2..4).prop_map(|each| {
        let yarn = |(closed, mut at, steps): (bool, [f32; 3], Vec<[f32; 3]>)| {
            let walk = steps.into_iter().map(|step| {
                at = std::array::from_fn(|k| at[k] + step[k]);
                [at[0], at[1], at[2], 0.1]
            });
            (closed, walk.collect())
        };
        yarns(&Section::Circle, &each.into_iter().map(yarn).collect::<Vec<_>>())
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn it_agrees_with_brute_force(tangle in tangles()) {
        let report = clearance(&tangle, &Settings::default()).unwrap();
        let between = report.worst.iter().find(|contact| contact.places[0].yarn != contact.places[1].yarn);
        let brute = refined_clearance(&tangle, 60);
        match between {
            Some(contact) => {
                // Brute force finds nothing nearer than the contact that is reported, and the
                // contact has its ratio at the places of the report.
                prop_assert!(contact.ratio < brute + CLEARANCE_ACCURACY, "{} but {brute}", contact.ratio);
                let there = contact.places.map(|place| {
                    let points = tangle.yarn_points(place.yarn).unwrap();
                    let closed = tangle.layout().yarns()[place.yarn].closed;
                    Segment::new(&four(points, closed, place.interval), 0.5).sample(place.t as f32)
                });
                let [a, b] = [there[0], there[1]].map(|sample| (sample.centre.as_dvec3(), f64::from(sample.half_width)));
                let ratio = a.0.distance(b.0) / (a.1 + b.1);
                prop_assert!((contact.ratio - ratio).abs() < 1e-4, "{} but {ratio} there", contact.ratio);
            }
            None => prop_assert!(report.worst.len() == 100 || brute > CLEARANCE_NEAR - 1e-6, "nothing, but {brute}"),
        }
    }

    #[test]
    fn no_contact_is_lost_where_even_yarns_pass_by(tangle in even_tangles()) {
        // A thousandth is about the smallest step between two sizes. It makes a yarn uneven, so
        // that no pair of intervals is left out beforehand.
        let mut uneven = tangle.clone();
        for yarn in 0..tangle.layout().yarns().len() {
            let mut points = tangle.yarn_points(yarn).unwrap().to_vec();
            let thicker = |point: &ControlPoint| 1.001 * point.half_width();
            points.iter_mut().step_by(2).for_each(|point| *point = point.flattened(thicker(point), thicker(point)));
            uneven.set_points(yarn, &points).unwrap();
        }
        let [left_out, whole] = [&tangle, &uneven].map(|yarns| clearance(yarns, &Settings::default()).unwrap());
        // For each pair of yarns, the worst contact is compared with the ends of the ways downhill
        // from the contacts of the other tangle.
        for (tangle, own, others) in [(&tangle, &left_out, &whole), (&uneven, &whole, &left_out)] {
            if own.worst.len().max(others.worst.len()) == CONTACTS_LISTED {
                continue;
            }
            for contact in &others.worst {
                let pair = contact.places.map(|place| place.yarn);
                let alike = own.worst.iter().filter(|contact| contact.places.map(|place| place.yarn) == pair);
                let worst = alike.map(|contact| contact.ratio).fold(CLEARANCE_NEAR, f64::min);
                let Some(there) = downhill(tangle, contact) else { continue };
                prop_assert!(worst < there + CLEARANCE_ACCURACY, "{contact:?}: {worst} but {there}");
            }
        }
    }

    #[test]
    fn the_tightest_bend_agrees_with_brute_force(tangle in tangles()) {
        let report = clearance(&tangle, &Settings::default()).unwrap();
        let place = report.curvature_at.unwrap();
        let points = |yarn| (tangle.yarn_points(yarn).unwrap(), tangle.layout().yarns()[yarn].closed);
        let (own, closed) = points(place.yarn);
        let there = bend(own, closed, place.interval, place.t);
        prop_assert!((report.curvature_min - there).abs() < 1e-4 * there + 1e-6, "{report:?} but {there}");
        for yarn in 0..tangle.layout().yarns().len() {
            let (points, closed) = points(yarn);
            for interval in 0..points.len() - usize::from(!closed) {
                for k in 0..=500 {
                    let sampled = bend(points, closed, interval, f64::from(k) / 500.0);
                    prop_assert!(report.curvature_min <= 1.002 * sampled, "{report:?} but {sampled}");
                }
            }
        }
    }
}

#[test]
fn every_crossing_of_a_cloth_is_a_contact() {
    let thread = Thread::new(0.75, 0.125);
    let drawdown = Weave::parse("3/1").unwrap().drawdown(20, 16).unwrap();
    let (warp, weft) = (vec![thread; 20], vec![thread; 16]);
    let mut cloth =
        Woven::new(drawdown, warp, weft, vec![Material::default()], vec![Section::Circle]).unwrap();
    // With this shape, threads that are steep between their crossings come near the crossing
    // threads a second time.
    cloth.set_shape(Shape::Crossing);
    let yarns = cloth.yarns().unwrap();
    let report = clearance(&yarns, &Settings::default()).unwrap();
    assert_eq!(report.contacts, 320);
    assert_eq!(report.histogram.iter().sum::<u64>(), 320);
    assert!((report.min - round_clearance(&yarns, 64)).abs() < 1e-3);
    assert!(report.worst.is_sorted_by(|a, b| a.ratio <= b.ratio));
}

#[test]
fn a_planted_piercing_is_found_at_its_place() {
    let mut yarns = cloth(Section::Circle);
    assert!(clearance(&yarns, &Settings::default()).unwrap().min > 0.99);
    // Pick 5 is pressed down where it lies over an end.
    let pick = 12 + 4;
    let mut points = yarns.yarn_points(pick).unwrap().to_vec();
    let sources = &yarns.sources().unwrap()[yarns.range(pick).unwrap()];
    let at = (8..points.len()).find(|&k| points[k].z == 0.1 && sources[k] != NO_CROSSING).unwrap();
    let source = sources[at];
    points[at].z = 0.05;
    let place = points[at];
    yarns.set_points(pick, &points).unwrap();
    let report = clearance(&yarns, &Settings::default()).unwrap();
    let worst = &report.worst[0];
    assert!((worst.ratio - 0.75).abs() < 0.01 && report.min == worst.ratio, "{worst:?}");
    assert_eq!(worst.places.map(|place| place.yarn), [source as usize % 12, pick]);
    assert_eq!(worst.places.map(|place| place.source), [Some(source); 2]);
    for (found, planted) in worst.places[1].position.iter().zip([place.x, place.y]) {
        assert!((found - f64::from(planted)).abs() < 0.05, "{worst:?}");
    }
    assert!(report.below_one >= 1);
}

#[test]
fn a_yarn_that_comes_back_to_itself_is_found() {
    // A hairpin 1 mm wide whose legs are 0.15 mm apart at their ends. The radius of the yarn is 0.1
    // mm.
    let points = vec![
        [0.0, 0.0, 0.0, 0.1],
        [3.0, -0.5, 0.0, 0.1],
        [4.0, 0.075, 0.0, 0.1],
        [3.0, 0.65, 0.0, 0.1],
        [0.0, 0.15, 0.0, 0.1],
    ];
    let report = clearance(&yarns(&Section::Circle, &[(false, points)]), &Settings::default()).unwrap();
    let worst = &report.worst[0];
    assert!((worst.ratio - 0.75).abs() < 1e-3, "{worst:?}");
    assert_eq!(worst.places.map(|place| (place.yarn, place.interval, place.t)), [(0, 0, 0.0), (0, 3, 1.0)]);
}

#[test]
fn a_ring_is_clear_of_itself_and_its_bend_is_its_own() {
    // A circle of 96 points with a radius of 2 mm, and a yarn with a radius of 0.5 mm. The radius
    // of curvature is four times the radius of the yarn.
    let ring = |radius: f32| -> Vec<[f32; 4]> {
        let angle = |k: usize| (k as f64 / 96.0 * TAU) as f32;
        (0..96).map(|k| [2.0 * angle(k).cos(), 2.0 * angle(k).sin(), 0.0, radius]).collect()
    };
    let report = clearance(&yarns(&Section::Circle, &[(true, ring(0.5))]), &Settings::default()).unwrap();
    assert_eq!((report.contacts, report.below_one), (0, 0));
    assert!(report.min.is_infinite());
    assert!((report.curvature_min / 4.0 - 1.0).abs() < 0.02, "{}", report.curvature_min);
    // A yarn whose radius is nearly that of the ring nearly folds.
    let thick = clearance(&yarns(&Section::Circle, &[(true, ring(1.9))]), &Settings::default()).unwrap();
    assert!((1.0..1.06).contains(&thick.curvature_min));
}

/// A yarn doubles back in a fold. Its end comes near an earlier interval at a ratio of 0.6758. On
/// the way from there down to the fold, the ratio rises by no more than 0.002 before it falls.
#[test]
fn a_shallow_contact_on_the_way_to_a_fold_is_found() {
    let points = vec![
        [0.0, 0.0, 0.0, 0.1],
        [0.0, -0.33831468, -0.26932493, 0.1],
        [-0.20541026, -0.6097548, -0.40491402, 0.1],
        [-0.47379136, -0.3197749, -0.06693044, 0.1],
        [-0.2057943, -0.5475621, -0.2920958, 0.1],
    ];
    let report = clearance(&yarns(&Section::Circle, &[(false, points)]), &Settings::default()).unwrap();
    let worst = &report.worst[0];
    assert!((worst.ratio - 0.6758).abs() < CLEARANCE_ACCURACY, "{worst:?}");
    assert_eq!(worst.places.map(|place| place.interval), [1, 3]);
}

/// A section beside its axis folds only if it reaches into the bend. In a counter-clockwise ring
/// the section's side points to the middle.
#[test]
fn a_polygon_on_the_outer_side_of_a_bend_does_not_fold() {
    let angle = |k: usize| (k as f64 / 96.0 * TAU) as f32;
    let ring = || (0..96).map(|k| [2.0 * angle(k).cos(), 2.0 * angle(k).sin(), 0.0, 0.5]).collect();
    let radii = |corners: [[f32; 2]; 3]| {
        let yarns = yarns(&Section::Polygon(corners.to_vec()), &[(true, ring())]);
        clearance(&yarns, &Settings { sides: 3, ..Settings::default() }).unwrap().curvature_min
    };
    assert!((radii([[0.0, -1.0], [1.0, 0.0], [0.0, 1.0]]) / 4.0 - 1.0).abs() < 0.02);
    assert!((radii([[1.0, -0.5], [2.0, 0.0], [1.0, 0.5]]) / 2.0 - 1.0).abs() < 0.02);
    for outer in [[[-1.0, 0.0], [0.0, -1.0], [0.0, 1.0]], [[-2.0, 0.0], [-1.0, -0.5], [-1.0, 0.5]]] {
        assert!(radii(outer).is_infinite(), "{outer:?}: {}", radii(outer));
    }
}

#[test]
fn a_fold_is_reported_with_its_place() {
    let mut yarns = cloth(Section::Circle);
    assert!(clearance(&yarns, &Settings::default()).unwrap().curvature_min > 1.0);
    // A kink: one point of end 4 is drawn sideways by a diameter.
    let mut points = yarns.yarn_points(3).unwrap().to_vec();
    points[9].x += 0.2;
    let place = [points[9].x, points[9].y].map(f64::from);
    yarns.set_points(3, &points).unwrap();
    let report = clearance(&yarns, &Settings::default()).unwrap();
    let at = report.curvature_at.unwrap();
    assert!(report.curvature_min < 0.6 && at.yarn == 3, "{report:?}");
    assert!((at.position[1] - place[1]).abs() < 0.2, "{at:?} is not near {place:?}");
}

#[test]
fn a_yarn_that_turns_straight_back_has_no_bend_left() {
    let points = vec![[0.0, 0.0, 0.0, 0.1], [1.0, 0.0, 0.0, 0.1], [0.5, 0.0, 0.0, 0.1], [3.0, 0.0, 0.0, 0.1]];
    let report = clearance(&yarns(&Section::Circle, &[(false, points)]), &Settings::default()).unwrap();
    assert_eq!(report.curvature_min, 0.0);
    // A yarn that goes straight on has no bend, however uneven its points are.
    let points = vec![[0.0, 0.0, 0.0, 0.1], [1.0, 0.0, 0.0, 0.1], [1.5, 0.0, 0.0, 0.1], [3.0, 0.0, 0.0, 0.1]];
    let report = clearance(&yarns(&Section::Circle, &[(false, points)]), &Settings::default()).unwrap();
    assert_eq!((report.curvature_min, report.curvature_at), (f64::INFINITY, None));
}

/// A yarn whose roll has to be worked out at each ring, and that has more rings than a mesh may
/// have.
#[test]
fn a_yarn_of_too_many_rings_is_refused() {
    let points: Vec<_> = (0..5_000_000).map(|k| ControlPoint::new(k as f32, 0.0, 0.0, 0.1)).collect();
    let mut yarns = Yarns::builder();
    yarns.section(Section::plied(2));
    yarns.yarn(Yarn { twist: 1.0, ..Yarn::default() }, &points);
    let settings = Settings { subdivisions: 1023, ..Settings::default() };
    let refused = clearance(&yarns.build().unwrap(), &settings);
    assert!(
        matches!(refused, Err(ContactError::Settings(PlanError::YarnRings { yarn: 0, .. }))),
        "{refused:?}"
    );
}

#[test]
fn yarns_of_one_place_and_of_all_sizes_are_measured() {
    // One yarn has equal points, two are very long, and radii are at both limits.
    let still = vec![[1.0, 1.0, 1.0, 0.1]; 4];
    let far = vec![[-1e9, 0.0, 0.0, 1e-4], [1e9, 0.0, 0.0, 1e-4]];
    let thick = vec![[0.0, 0.0, 0.0, 3e4], [0.0, 1e9, 0.0, 3e4]];
    let all = yarns(&Section::Circle, &[(false, still), (false, far), (false, thick)]);
    let report = clearance(&all.with_tension(0.5).unwrap(), &Settings::default()).unwrap();
    assert!(report.min < 1e-3 && !report.min.is_nan());
}

/// Two neighbouring ends bend around different picks. Straight tubes along their tangents would
/// touch at more than one place, but the yarns are far apart.
#[test]
fn neighbours_that_wave_otherwise_do_not_touch() {
    let ends: [&[[f32; 5]]; 2] = [
        &[
            [12.3897, 0.0039, -0.0342, 0.1011, 0.0619],
            [12.3924, 0.0569, -0.0069, 0.0991, 0.0614],
            [12.3933, 0.1017, 0.0052, 0.097, 0.0609],
            [12.3953, 0.1599, 0.0065, 0.0948, 0.0604],
            [12.3941, 0.2244, 0.0185, 0.0974, 0.0605],
            [12.3939, 0.2745, -0.0188, 0.0999, 0.0606],
        ],
        &[
            [12.6192, 0.0041, -0.0063, 0.0995, 0.0651],
            [12.6178, 0.0537, 0.0038, 0.0972, 0.0651],
            [12.6171, 0.1182, 0.0071, 0.0949, 0.065],
            [12.6158, 0.1628, 0.0548, 0.093, 0.0649],
            [12.6161, 0.2543, 0.0646, 0.0974, 0.0638],
            [12.6176, 0.3731, 0.0849, 0.1034, 0.0624],
        ],
    ];
    let mut yarns = Yarns::builder();
    for end in ends {
        let points: Vec<_> = end
            .iter()
            .map(|[x, y, z, width, height]| ControlPoint::new(*x, *y, *z, *width).flattened(*width, *height))
            .collect();
        yarns.yarn(Yarn::default(), &points);
    }
    // Their middles are 0.22 mm apart, and their half widths are at most 0.10 mm.
    let found = clearance(&yarns.build().unwrap(), &Settings::default()).unwrap();
    assert!(found.min > 1.05, "{:?}", found.worst);
}

/// A pick touches an end beside one of its control points. Straight tubes along the tangents touch
/// on one side of the point, the surfaces on the other.
#[test]
fn a_touch_beside_a_control_point_is_found() {
    let threads: [&[[f32; 5]]; 2] = [
        &[
            [0.005222, 0.379208, -0.099220, 0.095337, 0.055542],
            [0.002369, 0.465515, -0.105892, 0.095886, 0.054016],
            [0.000904, 0.527977, -0.096839, 0.095581, 0.054230],
            [-0.000404, 0.583800, -0.068083, 0.095276, 0.054413],
            [-0.001232, 0.619090, -0.016716, 0.095154, 0.054535],
            [-0.002052, 0.653908, 0.035028, 0.094971, 0.054657],
            [-0.003349, 0.709255, 0.064744, 0.094666, 0.054840],
            [-0.004814, 0.771645, 0.074250, 0.094360, 0.055054],
        ],
        &[
            [-0.193501, 0.465626, -0.043467, 0.099731, 0.060211],
            [-0.159607, 0.465607, -0.039945, 0.100037, 0.059784],
            [-0.126751, 0.465588, -0.030959, 0.100342, 0.059418],
            [-0.095928, 0.465572, -0.016422, 0.100586, 0.059052],
            [-0.064751, 0.465553, -0.002705, 0.100891, 0.058685],
            [-0.031612, 0.465534, 0.005179, 0.101196, 0.058289],
            [0.002369, 0.465515, 0.007750, 0.101501, 0.057892],
            [0.047852, 0.465960, 0.002493, 0.101807, 0.057800],
            [0.092133, 0.466400, -0.009483, 0.102051, 0.057739],
            [0.136391, 0.466835, -0.021565, 0.102356, 0.057648],
            [0.180675, 0.467270, -0.033539, 0.102661, 0.057587],
            [0.225063, 0.467705, -0.045097, 0.102966, 0.057526],
        ],
    ];
    let mut yarns = Yarns::builder();
    for thread in threads {
        let points: Vec<_> = thread
            .iter()
            .map(|[x, y, z, width, height]| ControlPoint::new(*x, *y, *z, *width).flattened(*width, *height))
            .collect();
        yarns.yarn(Yarn::default(), &points);
    }
    // By dense sampling, the ratio of the surfaces is 0.9846.
    let found = clearance(&yarns.build().unwrap(), &Settings::default()).unwrap();
    assert!((found.min - 0.9846).abs() < 2e-3, "{:?}", found.worst);
}

/// The nearest approach of two yarns lies beside another approach that is less near. Both are
/// minima of the distance in the same long valley.
#[test]
fn the_nearer_of_two_approaches_in_a_valley_is_found() {
    let one = vec![
        [0.0, 2.3517048, 0.0, 0.125],
        [0.0, 0.0, 0.0, 0.125],
        [1.8888093, 0.11496627, 3.366947, 0.125],
        [0.79879105, 0.5346934, 0.09397201, 0.125],
        [0.83858615, 0.25770766, 0.15666804, 0.125],
    ];
    let other = vec![
        [0.0, 0.0, 0.69882846, 0.125],
        [0.18038261, 3.1720212, 0.5004042, 0.1854248],
        [0.7896479, 0.18636507, 0.19232945, 0.125],
        [0.7601446, 1.954824, 2.0737004, 0.125],
    ];
    let both = yarns(&Section::Circle, &[(false, one), (false, other)]);
    let found = clearance(&both, &Settings::default()).unwrap();
    assert!((found.min - 0.26994).abs() < CLEARANCE_ACCURACY, "{}", found.min);
}

/// A yarn of equal points has no length. The nearest place of the other yarn to it is found.
#[test]
fn a_yarn_without_length_is_met_where_it_lies() {
    let point = vec![[0.0, 0.0, 0.0, 0.1]; 8];
    let mut other = vec![[0.0976, 0.0, 0.0, 0.1], [0.08, 0.0, 0.0, 0.1]];
    other.extend([[-0.292, 0.248, 0.247, 0.1]; 6]);
    let both = yarns(&Section::Circle, &[(false, point), (false, other)]);
    let nearest = (0..=700).map(|k| place(&both, 1, f64::from(k) / 100.0).0.length() / 0.2);
    let nearest = nearest.fold(f64::INFINITY, f64::min);
    let found = clearance(&both, &Settings::default()).unwrap();
    assert!((found.min - nearest).abs() < CLEARANCE_ACCURACY, "{} but {nearest}", found.min);
}

/// A yarn comes nearest to itself within a millionth of an interval before a control point, where
/// the yarn turns back sharply.
#[test]
fn a_contact_just_before_a_knot_is_found() {
    let points = [
        [0.0, 0.0, 0.26276064],
        [0.0, 0.0, 0.26276064],
        [0.0, 0.0, 0.26276064],
        [0.21330486, 0.0, 0.26276064],
        [0.21330486, 0.0, 0.26276064],
        [0.5607571, -0.00043049874, 0.28608167],
        [0.64452356, -0.11893173, 0.17898071],
        [0.4163052, 0.07942412, 0.022324488],
        [0.5045059, 0.19441035, 0.35228908],
        [0.692189, 0.07691879, 0.28418237],
        [0.95663226, 0.16121648, 0.6214221],
        [0.6321706, -0.00845255, 0.2718671],
        [0.9972811, 0.12682347, 0.5440812],
    ];
    let points = points.map(|[x, y, z]| [x, y, z, 0.1]).to_vec();
    let found = clearance(&yarns(&Section::Circle, &[(false, points)]), &Settings::default()).unwrap();
    assert!(found.min < 0.162, "{}", found.min);
}

/// Two yarns cross where each has a control point, and are symmetric about this point. Exactly one
/// of the four pairs of intervals there has the contact, however numbers are rounded.
#[test]
fn a_crossing_on_a_control_point_is_one_contact() {
    let mut state = 1_u64;
    let mut random = |low: f32, high: f32| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((state >> 40) as f32 / (1 << 24) as f32)
    };
    let mut least = 0;
    for number in 0..3000 {
        let out = |point: [f32; 3]| {
            [[-point[0], -point[1], point[2], 0.125], [point[0], point[1], point[2], 0.125]]
        };
        // The first yarn falls to both sides of the crossing. The other one rises or falls. The
        // angle between both is not small.
        let turn = random(0.6, 2.5);
        let [near, far] = [random(0.3, 0.7), random(0.8, 1.5)];
        let height = random(0.1, 0.24);
        let one = [[near, 0.0, -random(0.02, 0.2)], [far, 0.0, -random(0.3, 0.8)]].map(out);
        let other = [[near, height + random(-0.01, 0.3)], [far, height + random(0.0, 0.6)]];
        let other = other.map(|[along, z]| out([along * turn.cos(), along * turn.sin(), z]));
        let lay = |[near, far]: [[[f32; 4]; 2]; 2], z: f32| {
            vec![far[0], near[0], [0.0, 0.0, z, 0.125], near[1], far[1]]
        };
        let both = yarns(&Section::Circle, &[(false, lay(one, 0.0)), (false, lay(other, height))]);
        let found = clearance(&both, &Settings::default()).unwrap();
        let middle = f64::from(height) / 0.25;
        let is_there = |place: &YarnPlace| place.position[0].hypot(place.position[1]) < 1e-4;
        let at_knot = found.worst.iter().filter(|contact| contact.places.iter().all(is_there)).count();
        // If the yarns are nearer to one another beside the control points, their contact lies
        // elsewhere.
        let round_about = (0..64).map(|k| {
            let (sin, cos) = (TAU * f64::from(k) / 64.0).sin_cos();
            place(&both, 0, 2.0 + 0.05 * cos).0.distance(place(&both, 1, 2.0 + 0.05 * sin).0) / 0.25
        });
        let is_least = round_about.fold(f64::INFINITY, f64::min) > middle + 1e-5;
        least += usize::from(is_least);
        let is_found = !is_least || found.min < middle + CLEARANCE_ACCURACY;
        assert!(is_found && at_knot <= 1, "{number}: {:?} for {middle}", found.worst);
    }
    assert!(least > 1000, "{least} that meet at their control points");
}
