//! Cloths whose yarns nearly touch.

use texere_core::{Material, Section, Yarn, Yarns};
use texere_fabric::{Shape, Thread, Weave, Woven};

use crate::outline::Outline;

/// Radius of every yarn, mm.
pub(crate) const RADIUS: f32 = 0.125;

/// `size` threads, by turns `setts` diameters from the one before; `twist` in turns a metre.
pub(crate) fn set(size: usize, setts: [f64; 2], radius: f32, twist: f32) -> Vec<Thread> {
    let twist = radians_a_mm(twist);
    let thread = |sett| Thread { twist, ..Thread::new(sett * 2.0 * f64::from(radius), radius) };
    setts.into_iter().cycle().map(thread).take(size).collect()
}

/// As many ends as picks, alike.
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

/// A cloth so close that its yarns touch or pierce a little; `twist` in turns a metre.
///
/// [`Woven`] leaves room for sections as they lie untwisted. Flat ones that stand on edge where they cross would pierce half
/// of one another: their yarns follow the paths of round ones that nearly hold them.
pub(crate) fn close(weave: &str, section: &Section, twist: f32) -> Yarns {
    let (size, sett) = match weave {
        "plain" => (4, 1.75),
        "2/2" => (4, 2.1),
        _ => (5, 1.9),
    };
    let flat = matches!(section, Section::Ellipse { .. } | Section::Lobed { plies: 2 });
    if !flat || twist == 0.0 {
        return woven(weave, set(size, [sett; 2], RADIUS, twist), section.clone());
    }
    let share = if twist < 500.0 { 0.85 } else { 1.0 };
    let round = share * RADIUS * Outline::of(section).greatest as f32;
    let paths = woven(weave, set(size, [sett; 2], round, 0.0), Section::Circle);
    let mut yarns = Yarns::builder();
    yarns.section(section.clone());
    for (number, yarn) in paths.layout().yarns().iter().enumerate() {
        let points = paths.yarn_points(number).unwrap().iter();
        let points: Vec<_> = points.map(|point| point.flattened(RADIUS, RADIUS)).collect();
        yarns.yarn(Yarn { twist: radians_a_mm(twist), ..*yarn }, &points);
    }
    yarns.build().unwrap()
}
