//! Uploads write the bits that `PaddedPoints` keeps, and large ones arrive on every device.

use std::ops::{ControlFlow, Range};
use std::sync::Arc;

use proptest::prelude::*;
use texere_conformance::cases;
use texere_core::backend::{PaddedPoints, Plan, Session};
use texere_core::{ControlPoint, Limits, Settings, Yarn, Yarns};
use texere_gpu::YarnEnds;

/// Yarns, each as its number of points and whether it is closed.
type Counts = Vec<(usize, bool)>;

/// The number of the first point that is written, and the points.
type Upload = (usize, Vec<ControlPoint>);

/// Most yarns are tiny.
fn yarns() -> impl Strategy<Value = Counts> {
    let yarn = (prop_oneof![4 => 2usize..5, 2 => 5usize..12, 1 => 50usize..90], any::<bool>());
    prop::collection::vec(yarn.prop_map(|(count, closed)| (count.max(2 + usize::from(closed)), closed)), 1..9)
}

fn plan(yarns: &[(usize, bool)]) -> Plan {
    let mut all = Yarns::builder();
    for &(count, closed) in yarns {
        let points: Vec<_> = (0..count).map(|at| ControlPoint::new(at as f32, 0.0, 0.0, 0.1)).collect();
        all.yarn(Yarn { closed, ..Yarn::default() }, &points);
    }
    Plan::new(all.build().unwrap().layout().clone(), Settings::default()).unwrap()
}

fn point() -> impl Strategy<Value = ControlPoint> {
    let number = -1e6f32..1e6;
    // proptest 1.12 may fail an assertion of its own where the lower bound of a range has finer
    // binary digits than the upper one. The range therefore starts at 0.
    let radius = (0.0f32..1e3).prop_map(|radius| radius.max(1e-3));
    let flatness = prop_oneof![9 => Just(1.0f32), 1 => (0.0f32..10.0).prop_map(|flatness| flatness.max(0.1))];
    (number.clone(), number.clone(), number, radius, flatness).prop_map(|(x, y, z, r, flatness)| {
        ControlPoint::new(x, y, z, r).flattened(r * flatness, r / flatness)
    })
}

/// Ranges of `total` points: single points, a few, and any number.
fn range(total: usize) -> impl Strategy<Value = Range<usize>> {
    let length = prop_oneof![2 => Just(1usize), 2 => 1usize..4, 2 => 0usize..=total];
    (0..total, length).prop_map(move |(first, length)| first..total.min(first + length))
}

/// A fabric, and writes of points.
fn uploads() -> impl Strategy<Value = (Counts, Vec<Upload>)> {
    yarns().prop_flat_map(|yarns| {
        let total = yarns.iter().map(|(count, _)| count).sum();
        let upload = range(total).prop_flat_map(|range| {
            prop::collection::vec(point(), range.len()).prop_map(move |points| (range.start, points))
        });
        (Just(yarns), prop::collection::vec(upload, 1..12))
    })
}

fn bits(points: &[ControlPoint]) -> &[u32] {
    bytemuck::cast_slice(points)
}

proptest! {
    /// For pieces of any size, memory that starts as zeros equals `PaddedPoints` after each upload.
    /// Only virtual ends that depend on the sent points are written beside these. A point that is
    /// not round is noticed. Forgotten ends come back from the points that were written.
    #[test]
    fn uploads_write_what_padded_points_keep(
        (yarns, uploads) in uploads(),
        piece in 1u64..20,
        forgets in prop::collection::vec(any::<bool>(), 12),
    ) {
        let plan = plan(&yarns);
        let mut expected = PaddedPoints::new(&plan).unwrap();
        let mut written = vec![ControlPoint::default(); expected.points().len()];
        let mut ends = YarnEnds::new(&plan).unwrap();
        let mut flattened = false;
        for ((first, points), forgets) in uploads.into_iter().zip(forgets) {
            let first = first as u64;
            if forgets {
                ends.forget(flattened);
            }
            if ends.are_missing(&plan, first, points.len()) {
                ends.renew(&plan, &written);
            }
            let touched = expected.upload(&plan, first, &points);
            let upload = ends.upload(&plan, first, &points);
            let mut sent = 0;
            let mut before = 0;
            for range in upload.ranges() {
                prop_assert!(range.is_empty() || before <= range.start, "in order, and none twice");
                before = before.max(range.end);
                sent += range.end - range.start;
                // The last piece comes first, and no piece waits for another.
                for start in range.clone().step_by(piece as usize).collect::<Vec<_>>().into_iter().rev() {
                    let end = range.end.min(start + piece);
                    let mut at = start as usize;
                    upload.runs(start..end, |run| {
                        written[at..at + run.len()].copy_from_slice(run);
                        at += run.len();
                    });
                    prop_assert_eq!(at as u64, end);
                }
            }
            ends.keep(&upload);
            prop_assert_eq!(bits(&written), bits(expected.points()));
            flattened |= points.iter().any(|point| point.half_width() != point.half_height());
            prop_assert_eq!(ends.flattened(), flattened);
            prop_assert!(sent <= touched.end - touched.start);
            prop_assert!(points.len() != 1 || sent <= 5, "one point and both ends of a closed yarn");
        }
    }
}

#[test]
fn a_point_in_the_middle_goes_alone() {
    let (plan, points) = (plan(&[(9, false), (9, true)]), [ControlPoint::new(1.0, 2.0, 3.0, 4.0)]);
    let ends = YarnEnds::new(&plan).unwrap();
    let sent = |first| {
        let ranges = ends.upload(&plan, first, &points).ranges();
        ranges
            .map(|range| (range.start, range.end))
            .into_iter()
            .filter(|(start, end)| start < end)
            .collect::<Vec<_>>()
    };
    // The open yarn is padded to 0..11, the closed one to 11..24.
    assert_eq!(sent(4), [(5, 6)]);
    assert_eq!(sent(0), [(0, 2)]);
    assert_eq!(sent(1), [(0, 1), (2, 3)]);
    assert_eq!(sent(7), [(8, 9), (10, 11)]);
    assert_eq!(sent(8), [(9, 11)]);
    assert_eq!(sent(9), [(11, 13), (21, 24)]);
    assert_eq!(sent(13), [(16, 17)]);
    assert_eq!(sent(17), [(11, 12), (20, 24)]);
}

/// Asserts that the only chunk has one ring for each control point, at the place of that point, as
/// wide and as high.
fn assert_holds(session: &mut Session, plan: &Plan, points: &[ControlPoint], device: &str) {
    let chunk = plan.chunks(&Limits::NONE).unwrap().next().unwrap();
    session.trajectory(&chunk).unwrap();
    let mut seen = 0;
    let flow = session.read_trajectory(&chunk, &mut |rings| {
        for (number, (ring, point)) in (seen..).zip(rings.iter().zip(&points[seen..])) {
            let off = (glam::Vec3::from(ring.centre) - point.position()).length();
            assert!(off < 1e-3, "{device}, ring {number}: {ring:?} for {point:?}");
            let (ring_halves, halves) =
                ([ring.half_width, ring.half_height], [point.half_width(), point.half_height()]);
            let wrong = ring_halves.iter().zip(halves).any(|(ring, half)| (ring - half).abs() > 1e-5 * half);
            assert!(!wrong, "{device}, ring {number}: {ring:?} for {point:?}");
        }
        seen += rings.len();
        ControlFlow::Continue(())
    });
    assert_eq!((flow.unwrap(), seen), (ControlFlow::Continue(()), points.len()), "{device}");
}

#[test]
fn a_large_cloth_arrives_on_every_device_and_arrives_again() {
    // 20 MB: more pieces than a GPU session has room for at once.
    let yarns = cases::design("paper/815x750.toml").yarns().unwrap();
    let settings = Settings { subdivisions: 0, ..Settings::default() };
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap());
    let mut points = yarns.points().to_vec();
    for device in texere::devices().found {
        let mut session = Session::new(&*texere::open(&device.name).unwrap(), plan.clone()).unwrap();
        session.upload(0, &points).unwrap();
        assert_holds(&mut session, &plan, &points, &device.name);
        // A range from within one yarn to within another. The points are not round any more.
        let end = points.len() - 7;
        for point in &mut points[5..end] {
            *point = ControlPoint { z: point.z + 1.0, ..point.flattened(0.11, 0.07) };
        }
        session.upload(5, &points[5..end]).unwrap();
        assert_holds(&mut session, &plan, &points, &device.name);
    }
}
