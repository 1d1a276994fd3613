//! Checks the guarantees of every device and session besides meshes: times are plausible, an edit
//! moves only its own bytes, the device can do what it claims, packed vertices lie on the mesh, and
//! settled yarns stay on their device.

use std::ops::{ControlFlow, Range};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use glam::Vec3;
use libtest_mimic::{Failed, Trial};
use texere_core::backend::{Chunk, Plan, Schedule, Session, SessionError, StageTimings};
use texere_core::settling::{Form, Pass, settled};
use texere_core::{Backend, ControlPoint, Frame, Limits, Settings, Vertex, Yarn, Yarns};

use crate::claims::claims_hold;
use crate::drive::Lent;
use crate::packed::check_packed;
use crate::schedule::beyond;
use crate::{cases, rest};

/// The name of a guarantee, and its check on a device.
type Promise = (&'static str, fn(&dyn Backend) -> Result<(), Failed>);

const PROMISES: [Promise; 6] = [
    ("every-stage-is-timed", every_stage_is_timed),
    ("a-second-scan-is-no-work", a_second_scan_is_no_work),
    ("an-edit-moves-one-yarn", an_edit_moves_one_yarn),
    ("what-it-can-is-what-it-does", claims_hold),
    ("packed-vertices-are-the-meshs", packed_vertices_are_the_meshs),
    ("settled-yarns-stay-on-their-device", settled_yarns_stay_on_their_device),
];

/// One trial for each promise.
pub(crate) fn trials(device: &Arc<dyn Backend>) -> Vec<Trial> {
    let trial = |(name, kept): Promise| {
        let device = device.clone();
        Trial::test(format!("session::{name}::{}", device.info().name), move || kept(&*device))
    };
    PROMISES.into_iter().map(trial).collect()
}

/// Settings and a yarn that use all stages, with scan and caps unless the device's schedule has
/// neither.
fn all_of(device: &dyn Backend) -> (Settings, Yarn) {
    if device.info().schedule == Schedule::PerYarn {
        return (Settings::default(), Yarn::default());
    }
    let settings = Settings { frame: Frame::RotationMinimizing, caps: true, ..Settings::default() };
    (settings, Yarn { twist: 1.0, ..Yarn::default() })
}

/// Each stage takes time. All of them together take no more than the host's clock measured.
fn every_stage_is_timed(device: &dyn Backend) -> Result<(), Failed> {
    let (settings, yarn) = all_of(device);
    let yarns = cases::winding(2_500, yarn);
    let settings = Settings { subdivisions: 7, sides: 8, ..settings };
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
    let mut session = Session::new(device, plan.clone())?;
    let started = Instant::now();
    session.upload(0, yarns.points())?;
    session.scan()?;
    for chunk in plan.chunks(&device.info().limits)? {
        session.trajectory(&chunk)?;
        // The call waits for the stage, so that reading does not wait for it.
        session.timings();
        let _ = session.read_trajectory(&chunk, &mut |_| ControlFlow::Continue(()))?;
        session.mesh(&chunk)?;
        session.timings();
        let _ = session.read_mesh(&chunk, &mut |_| ControlFlow::Continue(()))?;
    }
    let times = session.timings();
    let there_was = started.elapsed();

    let StageTimings { upload, scan, trajectory, mesh, readback } = times;
    let idle = [
        ("upload", upload, true),
        ("scan", scan, plan.needs_scan()),
        ("trajectory", trajectory, true),
        ("mesh", mesh, true),
        // A device in the host's memory reads nothing back.
        ("readback", readback, device.info().timed_by_device),
    ];
    for (stage, time, takes_time) in idle {
        if takes_time && time == Duration::ZERO {
            return Err(format!("{stage} took no time: {times:?}").into());
        }
    }
    if upload + scan + trajectory + mesh + readback > there_was {
        return Err(format!("more time than there was, {there_was:?}: {times:?}").into());
    }
    Ok(())
}

/// A second scan takes no time if nothing was uploaded since the first one, and takes time after an
/// upload.
fn a_second_scan_is_no_work(device: &dyn Backend) -> Result<(), Failed> {
    let (settings, yarn) = all_of(device);
    let yarns = cases::winding(2_500, yarn);
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
    let mut session = Session::new(device, plan.clone())?;
    session.upload(0, yarns.points())?;
    session.scan()?;
    let once = session.timings().scan;
    session.scan()?;
    let twice = session.timings().scan;
    if twice != once {
        return Err(format!("a second scan took {:?}", twice - once).into());
    }
    session.upload(0, &yarns.points()[..1])?;
    session.scan()?;
    if plan.needs_scan() && session.timings().scan == once {
        return Err("no scan after an upload".into());
    }
    Ok(())
}

/// The cloth of 815 ends by 750 picks, read once.
fn cloth() -> &'static Yarns {
    static CLOTH: OnceLock<Yarns> = OnceLock::new();
    CLOTH.get_or_init(|| cases::design("paper/815x750.toml").yarns().unwrap())
}

/// Blocks per chunk of the cloth of 815 ends. A chunk has a few yarns, and some yarns lie in two
/// chunks.
const EDIT_LIMITS: Limits = Limits { blocks: 64, ..Limits::NONE };

/// The edited yarn, a pick in the middle.
const EDITED: usize = 815 + 375;

/// A yarn that is uploaded again moves its own bytes and no others. Reading its chunks moves their
/// bytes and no others. The chunks equal those of a new session with the edited cloth. They differ
/// from those before the edit in exactly the yarn's own vertices.
fn an_edit_moves_one_yarn(device: &dyn Backend) -> Result<(), Failed> {
    let mut yarns = cloth().clone();
    let plan = Arc::new(Plan::new(yarns.layout().clone(), all_of(device).0)?);
    let of_edited = |chunk: &Chunk| chunk.parts().iter().any(|part| part.yarn as usize == EDITED);
    let chunks: Vec<_> = plan.chunks(&EDIT_LIMITS.min(&device.info().limits))?.filter(of_edited).collect();
    let mut session = Session::new(device, plan.clone())?;
    session.upload(0, yarns.points())?;
    moved("the whole cloth", session.traffic().uploaded, plan.resident_bytes())?;
    session.scan()?;
    let before = meshes(&mut session, &chunks)?;

    let raised: Vec<_> = yarns
        .yarn_points(EDITED)
        .into_iter()
        .flatten()
        .map(|point| ControlPoint { z: point.z + 1.0, ..*point })
        .collect();
    yarns.set_points(EDITED, &raised)?;
    let first = yarns.layout().offsets()[EDITED];
    let sent = session.traffic();
    session.upload(first, &raised)?;
    session.scan()?;
    let after = meshes(&mut session, &chunks)?;
    let own = plan.padded_offsets()[EDITED + 1] - plan.padded_offsets()[EDITED];
    let traffic = session.traffic();
    moved("the edited yarn", traffic.uploaded - sent.uploaded, own * size_of::<ControlPoint>() as u64)?;
    if device.info().timed_by_device || traffic.read > 0 {
        let bytes = |chunk: &Chunk| {
            u64::from(chunk.vertices()) * size_of::<Vertex>() as u64
                + u64::from(chunk.indices()) * size_of::<u32>() as u64
        };
        moved("its chunks", traffic.read - sent.read, chunks.iter().map(bytes).sum())?;
    }

    let mut fresh = Session::new(device, plan.clone())?;
    fresh.upload(0, yarns.points())?;
    fresh.scan()?;
    if meshes(&mut fresh, &chunks)? != after {
        return Err("a new session makes another mesh of the edited cloth".into());
    }
    let sides = plan.settings().sides;
    for ((chunk, before), after) in chunks.iter().zip(&before).zip(&after) {
        let own = own_vertices(chunk, sides);
        let changed = before.vertices.iter().zip(&after.vertices).map(|(before, after)| before != after);
        let wrong =
            (0..).zip(changed).find(|(at, changed)| own.iter().any(|own| own.contains(at)) != *changed);
        if let Some((vertex, _)) = wrong {
            return Err(format!("vertex {vertex} of chunk {}: the yarn's own {own:?}", chunk.index()).into());
        }
    }
    Ok(())
}

fn moved(what: &str, bytes: u64, expected: u64) -> Result<(), Failed> {
    if bytes == expected { Ok(()) } else { Err(format!("{what}: {bytes} bytes, not {expected}").into()) }
}

fn meshes(session: &mut Session, chunks: &[Chunk]) -> Result<Vec<Lent>, SessionError> {
    let read = |chunk| {
        session.mesh(chunk)?;
        Lent::read(session, chunk)
    };
    chunks.iter().map(read).collect()
}

/// Packed vertices lie where the mesh's vertices do, in chunks and in the whole.
fn packed_vertices_are_the_meshs(device: &dyn Backend) -> Result<(), Failed> {
    if !device.info().can.pack {
        return Ok(());
    }
    let limits = Limits { blocks: 3, ..Limits::NONE };
    for (sides, closed) in [(6, false), (5, false), (8, true), (7, true)] {
        let (settings, yarn) = all_of(device);
        let yarns = cases::winding(150, Yarn { closed, ..yarn });
        check_packed(&yarns, Settings { sides, ..settings }, &limits, device, false)?;
    }
    Ok(())
}

/// Yarns that a settler has moved are meshed where they lie after settling. Up to rounding, the
/// mesh equals that of the same yarns read back and uploaded again. This also holds after one of
/// their points is edited. No byte goes through the host, unless the host's memory is the device's
/// own.
fn settled_yarns_stay_on_their_device(device: &dyn Backend) -> Result<(), Failed> {
    if !device.info().can.settle {
        return Ok(());
    }
    let settings = all_of(device).0;
    let names = ["tuck-5", "jersey-5-piece", "plain-1.8"];
    for start in rest::starts().iter().filter(|start| names.contains(&start.name.as_str())) {
        let (yarns, settling) = (rest::yarns(start), rest::settling_plan(start));
        if beyond(device.info(), &yarns, &settings) {
            continue;
        }
        let mut settler = device.settler(settling.clone())?;
        settler.upload(
            yarns.points().iter().map(|point| settling.scale().place(point)).collect::<Vec<_>>().as_slice(),
        )?;
        settler.list(1.0)?;
        for _ in 0..4 {
            settler.pass(&Pass { form: Form::Weighted, growth: 1.0, ease: 1.0, momentum: 0.8 })?;
        }
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
        let chunks: Vec<_> = plan.chunks(&device.info().limits)?.collect();
        let mut session = Session::new(device, plan.clone())?;
        session.take_settled(&mut *settler)?;
        let traffic = session.traffic();
        if !session.engine().lends_its_own() {
            moved("points at rest", traffic.uploaded + traffic.read, 0)?;
        }
        session.scan()?;
        let taken = meshes(&mut session, &chunks)?;

        let points = settled(&settling, &mut *settler, yarns.points())?;
        let mut sent = Session::new(device, plan.clone())?;
        sent.upload(0, &points)?;
        sent.scan()?;
        let sent = meshes(&mut sent, &chunks)?;
        // The bound is four units of settling positions, plus 2e-6 mm for the rounding of `f32`
        // coordinates.
        let most = 4.0 * settling.scale().unit() + 2e-6;
        let vertices = |meshes: Vec<Lent>| meshes.into_iter().flat_map(|mesh| mesh.vertices);
        let mut count = 0;
        for (taken, sent) in vertices(taken).zip(vertices(sent)) {
            let apart = Vec3::from(taken.position).distance(Vec3::from(sent.position));
            if apart.is_nan() || apart > most {
                return Err(
                    format!("{}: vertex {count} is {apart} mm from where it was sent", start.name).into()
                );
            }
            count += 1;
        }
        // One point is edited. Virtual ends depend on points that this edit does not send.
        let raised = [ControlPoint { z: points[1].z + 1.0, ..points[1] }];
        session.upload(1, &raised)?;
        session.scan()?;
        let edited = meshes(&mut session, &chunks)?;
        let mut all = points.clone();
        all[1] = raised[0];
        let mut whole = Session::new(device, plan.clone())?;
        whole.upload(0, &all)?;
        whole.scan()?;
        for (edited, whole) in vertices(edited).zip(vertices(meshes(&mut whole, &chunks)?)) {
            let apart = Vec3::from(edited.position).distance(Vec3::from(whole.position));
            if apart.is_nan() || apart > most {
                return Err(format!("{}: an edit leaves a vertex {apart} mm off", start.name).into());
            }
        }
        let planned = chunks.iter().map(|chunk| u64::from(chunk.vertices())).sum();
        moved("vertices", count, planned)?;
    }
    Ok(())
}

/// The ranges of a chunk's vertices that belong to the edited yarn: its tube and its caps.
fn own_vertices(chunk: &Chunk, sides: u32) -> Vec<Range<u32>> {
    let parts = chunk.parts().iter().filter(|part| part.yarn as usize == EDITED);
    let caps = chunk.caps().iter().filter(|cap| cap.yarn as usize == EDITED);
    parts
        .map(|part| part.first_vertex..part.first_vertex + part.rings * sides)
        .chain(caps.map(|cap| cap.first_vertex..cap.first_vertex + sides))
        .collect()
}
