//! A pipeline that owns its yarns has their control points in memory once. The system counts the
//! memory of the whole process, so this is the only test here.
#![cfg(target_os = "linux")]

use std::ops::ControlFlow;

use texere_core::{
    ControlPoint, Layout, Limits, Material, Pipeline, Section, Settings, Topology, Yarn, Yarns,
};

const POINTS: usize = 6 << 20;

/// The most bytes of memory that the process has had so far.
fn peak() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").expect("the process's status");
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("the peak");
    line.trim().trim_end_matches(" kB").parse::<usize>().expect("kilobytes") << 10
}

#[test]
fn control_points_are_in_memory_once() {
    let device = texere::open("cpu").expect("the CPU");
    let bytes = POINTS * size_of::<ControlPoint>();
    let place = |point: usize| ControlPoint::new(point as f32, 0.0, (point % 2) as f32, 0.2);
    let mut points = Vec::with_capacity(POINTS);
    points.extend((0..POINTS).map(place));
    let layout = Layout::new(vec![Yarn::default()], vec![0, POINTS as u64], vec![Section::Circle]);
    let yarns = Yarns::new(layout.expect("a layout"), vec![Material::default()], points).expect("yarns");
    let before = peak();
    assert!(before < 2 * bytes, "{before} bytes before, of them {bytes} of points");
    let settings = Settings { sides: 3, subdivisions: 0, topology: Topology::Shared, ..Settings::default() };
    let limits = Limits { binding_bytes: 1 << 20, ..Limits::default() };
    let mut rings = 0;
    let answer = Pipeline::new(yarns).settings(settings).limits(limits).stream(&*device, |chunk, _| {
        rings += u64::from(chunk.rings()) - u64::from(chunk.repeats_ring());
        ControlFlow::<()>::Continue(())
    });
    assert!(answer.expect("a mesh").is_continue());
    assert_eq!(rings, POINTS as u64);
    // One upload has points twice: those that are sent are freed afterwards.
    let grown = peak() - before;
    assert!(grown < bytes / 2, "{grown} bytes more, of them {bytes} of points");
}
