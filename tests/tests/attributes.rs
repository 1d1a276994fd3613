//! Attributes of vertices on every backend, against the oracle and lengths that the test measures.

use std::ops::ControlFlow;
use std::sync::Arc;

use rayon::prelude::*;
use texere_conformance::cases::{self, Case};
use texere_conformance::near_devices;
use texere_conformance::oracle::Oracle;
use texere_core::backend::{Chunk, Plan, Session, SessionError};
use texere_core::{Attribute, Backend, End, Frame, Settings, Yarns};
use texere_cpu::{ParallelBackend, SerialBackend};

/// The test measures lengths along about this many parts of each control interval, and also along
/// half as many.
const PARTS: u32 = 256;

/// The length of each yarn from its start to each of its rings, mm. It is the sum of the chords of
/// a much finer spline of the oracle. Richardson's extrapolation, with a spline half as fine,
/// removes most of the error.
fn lengths(yarns: &Yarns, settings: &Settings) -> Vec<Vec<f64>> {
    let per_interval = settings.subdivisions + 1;
    let per_ring = (PARTS / per_interval).max(2) / 2 * 2;
    let fine = Settings { subdivisions: per_interval * per_ring - 1, ..*settings };
    let oracle = Oracle::new(yarns, &fine);
    let along = |centres: &[glam::DVec3], step: usize| {
        let mut sum = 0.0;
        let mut lengths = vec![0.0];
        for ring in centres.windows(per_ring as usize + 1).step_by(per_ring as usize) {
            sum += (0..per_ring as usize)
                .step_by(step)
                .map(|at| ring[at].distance(ring[at + step]))
                .sum::<f64>();
            lengths.push(sum);
        }
        lengths
    };
    let of_yarn = |yarn: &texere_conformance::oracle::OracleYarn| {
        let centres: Vec<_> = yarn.rings.iter().map(|ring| ring.centre).collect();
        let (fine, coarse) = (along(&centres, 1), along(&centres, 2));
        fine.iter().zip(&coarse).map(|(fine, coarse)| fine + (fine - coarse) / 3.0).collect()
    };
    oracle.yarns.iter().map(of_yarn).collect()
}

/// The cases with upright frames, because attributes do not depend on the frame. The few with too
/// many points for the fine spline are left out.
fn small() -> Vec<Case> {
    let is_small = |case: &Case| case.settings.frame == Frame::Upright && case.yarns().points().len() <= 500;
    cases::all().into_iter().filter(is_small).collect()
}

/// The attributes of all vertices of `chunks`, in order.
fn made(device: &dyn Backend, plan: &Arc<Plan>, yarns: &Yarns, chunks: &[Chunk]) -> Vec<Vec<Attribute>> {
    let mut session = Session::new(device, plan.clone()).unwrap();
    session.upload(0, yarns.points()).unwrap();
    session.measure().unwrap();
    let read = |chunk: &Chunk| {
        let mut attributes = vec![Attribute::default(); chunk.vertices() as usize];
        session.attributes(chunk).unwrap();
        let _ = session
            .read_attributes(chunk, &mut |first, piece| {
                attributes[first as usize..][..piece.len()].copy_from_slice(piece);
                ControlFlow::Continue(())
            })
            .unwrap();
        attributes
    };
    chunks.iter().map(read).collect()
}

/// Compares the attributes of chunks with the expected ones.
fn check(
    name: &str,
    plan: &Plan,
    chunks: &[Chunk],
    all: &[Vec<Attribute>],
    oracle: &Oracle,
    lengths: &[Vec<f64>],
) {
    let sides = plan.settings().sides;
    for (chunk, attributes) in chunks.iter().zip(all) {
        let tubes = chunk.parts().iter().flat_map(|part| {
            (0..part.rings).map(|k| (part.yarn, part.first_ring + k, part.first_vertex + k * sides))
        });
        let caps = chunk.caps().iter().map(|cap| {
            let ring = if cap.end == End::Start { 0 } else { plan.rings(cap.yarn as usize) - 1 };
            (cap.yarn, ring, cap.first_vertex)
        });
        let mut seen = 0;
        for (yarn, ring, first) in tubes.chain(caps) {
            let (lengths, ring) = (&lengths[yarn as usize], ring as usize);
            let (along, whole) = (lengths[ring], lengths[lengths.len() - 1]);
            let tangent = oracle.yarns[yarn as usize].rings[ring].tangent;
            for (corner, attribute) in attributes[first as usize..][..sides as usize].iter().enumerate() {
                let at = format!("{name}: yarn {yarn}, ring {ring}, corner {corner}: {attribute:?}");
                assert_eq!(attribute.yarn, yarn, "{at}");
                let angle = std::f64::consts::TAU * corner as f64 / f64::from(sides);
                assert!((f64::from(attribute.angle) - angle).abs() < 1e-6, "{at}, not {angle}");
                let off = (f64::from(attribute.along) - along).abs();
                assert!(off <= 1e-5 * whole, "{at}, not {along} of {whole}");
                let own = glam::DVec3::from_array(attribute.tangent.map(f64::from));
                assert!(own.distance(tangent) < 2e-4, "{at}, not {tangent}");
                seen += 1;
            }
        }
        assert_eq!(seen, attributes.len(), "{name}: every vertex is of a ring or of a cap");
    }
}

#[test]
fn attributes_agree_with_the_oracle_on_every_backend_and_however_it_is_cut() {
    let serial = SerialBackend::new();
    let exact = ParallelBackend::each();
    let cases = small();
    let in_chunks = |case: &Case| {
        let (yarns, settings) = (case.yarns(), case.settings);
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap());
        let (oracle, lengths) = (Oracle::new(&yarns, &settings), lengths(&yarns, &settings));
        let limits = case.tight.limits(&plan, 1);
        let chunks: Vec<_> = plan.chunks(&limits).unwrap().collect();
        let reference = made(&serial, &plan, &yarns, &chunks);
        check(&case.name, &plan, &chunks, &reference, &oracle, &lengths);
        for device in &exact {
            assert!(
                made(device, &plan, &yarns, &chunks) == reference,
                "{}: {}",
                case.name,
                device.info().name
            );
        }
        for device in near_devices() {
            let name = format!("{}: {}", case.name, device.info().name);
            let limits = limits.min(&device.info().limits);
            let chunks: Vec<_> = plan.chunks(&limits).unwrap().collect();
            check(&name, &plan, &chunks, &made(&**device, &plan, &yarns, &chunks), &oracle, &lengths);
        }
        chunks.len() > 1
    };
    let cut = cases.par_iter().filter(|case| in_chunks(case)).count();
    assert!(cases.len() > 50 && cut > 10, "{} cases, {cut} of them in several chunks", cases.len());
}

/// After an upload, the lengths that were measured along the old points are out of date.
#[test]
fn yarns_are_measured_before_attributes_and_again_after_uploads() {
    let device = SerialBackend::new();
    let yarns = cases::all()[0].yarns();
    let plan = Arc::new(Plan::new(yarns.layout().clone(), Settings::default()).unwrap());
    let chunk = plan.chunks(&device.info().limits).unwrap().next().unwrap();
    let mut session = Session::new(&device, plan).unwrap();
    let refused = |session: &mut Session| {
        let refused = session.attributes(&chunk);
        matches!(refused, Err(SessionError::OutOfOrder { call: "attributes", needed: "measure" }))
    };
    session.upload(0, yarns.points()).unwrap();
    assert!(refused(&mut session));
    session.measure().unwrap();
    assert!(!refused(&mut session));
    session.upload(0, &yarns.points()[..1]).unwrap();
    assert!(refused(&mut session));
    let read = session.read_attributes(&chunk, &mut |_, _| ControlFlow::Continue(()));
    assert!(matches!(read, Err(SessionError::NotInFlight { .. })), "{read:?}");
}
