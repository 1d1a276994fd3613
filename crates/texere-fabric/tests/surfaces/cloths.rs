//! Cloths whose yarns nearly touch.

use texere_core::{ControlPoint, Material, Section, Yarn, Yarns};
use texere_fabric::{Shape, Thread, Weave, Woven};

use crate::outline::Outline;

/// Radius of every yarn, mm.
pub(crate) const RADIUS: f32 = 0.125;

/// `size` threads with spacings of `setts` diameters in turn. `twist` is in turns per metre.
pub(crate) fn set(size: usize, setts: [f64; 2], radius: f32, twist: f32) -> Vec<Thread> {
    let twist = radians_a_mm(twist);
    let thread = |sett| Thread { twist, ..Thread::new(sett * 2.0 * f64::from(radius), radius) };
    setts.into_iter().cycle().map(thread).take(size).collect()
}

/// Cloth in which `threads` are both the ends and the picks.
pub(crate) fn woven(weave: &str, threads: Vec<Thread>, section: Section) -> Yarns {
    let size = threads.len();
    let drawdown = Weave::parse(weave).unwrap().drawdown(size, size).unwrap();
    let mut cloth =
        Woven::new(drawdown, threads.clone(), threads, vec![Material::default()], vec![section]).unwrap();
    cloth.set_shape(Shape::Round);
    cloth.yarns().unwrap()
}

fn radians_a_mm(turns_a_metre: f32) -> f32 {
    turns_a_metre * 1e-3 * std::f32::consts::TAU
}

/// A cloth whose yarns touch or pierce a little. `twist` is in turns per metre.
///
/// Untwisted yarns lie in the room that [`Woven`] makes, pressed to nine tenths of its height.
/// Twisted yarns follow the paths of round yarns, which contain them or almost contain them.
pub(crate) fn close(weave: &str, section: &Section, twist: f32) -> Yarns {
    let (size, sett) = match weave {
        "plain" => (4, 1.75),
        "2/2" => (4, 2.1),
        _ => (5, 1.9),
    };
    let greatest = Outline::of(section).greatest as f32;
    let (round, press, path) = match twist {
        0.0 => (RADIUS, 0.9, section.clone()),
        300.0 => (0.85 * RADIUS * greatest, 1.0, Section::Circle),
        _ => (RADIUS * greatest, 1.0, Section::Circle),
    };
    let paths = woven(weave, set(size, [sett; 2], round, 0.0), path);
    let mut yarns = Yarns::builder();
    yarns.section(section.clone());
    for (number, yarn) in paths.layout().yarns().iter().enumerate() {
        let points = paths.yarn_points(number).unwrap().iter();
        let points: Vec<_> = points
            .map(|point| ControlPoint { z: point.z * press, ..point.flattened(RADIUS, RADIUS) })
            .collect();
        yarns.yarn(Yarn { twist: radians_a_mm(twist), ..*yarn }, &points);
    }
    yarns.build().unwrap()
}

/// A plain weave of flattened threads, 1.5 times as wide as high, pressed to nine tenths of its
/// height.
pub(crate) fn flattened(section: &Section, twist: f32) -> Yarns {
    let threads: Vec<_> = set(4, [2.5; 2], RADIUS, twist)
        .into_iter()
        .map(|thread| Thread { flatness: 1.5, ..thread })
        .collect();
    let mut yarns = woven("plain", threads, section.clone());
    for yarn in 0..yarns.layout().yarns().len() {
        let points = yarns.yarn_points(yarn).unwrap().iter();
        let points: Vec<_> = points.map(|point| ControlPoint { z: point.z * 0.9, ..*point }).collect();
        yarns.set_points(yarn, &points).unwrap();
    }
    yarns
}
