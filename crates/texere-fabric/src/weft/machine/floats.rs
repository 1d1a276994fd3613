//! Long floats: yarns that float past too many needles.

use super::super::Step;
use super::FaultKind;
use super::run::Run;

/// Records floats past more than `limit` needles. A repeat is `width` needles wide.
///
/// A yarn may be caught further out than its next loop. It then floats past all needles up to the
/// place where it is caught.
pub(super) fn long(run: &mut Run<'_>, width: Option<i32>, limit: u32) {
    let mut found = Vec::new();
    for strand in &run.carriers.strands {
        // The leftmost and the rightmost place of the yarn since its last loop.
        let mut reach: Option<[f32; 2]> = None;
        let mut first = None;
        let grown = |[low, high]: [f32; 2], at: f32| [low.min(at), high.max(at)];
        let mut end = |reach: Option<[f32; 2]>, at: f32, source: u32| {
            let needles =
                reach.map(|reach| grown(reach, at)).map_or(0, |[low, high]| (high - low).ceil() as u32);
            if needles.saturating_sub(1) > limit {
                found.push((needles - 1, source, strand.carrier));
            }
        };
        for step in &strand.steps {
            match *step {
                Step::Float { at, .. } => reach = reach.map(|reach| grown(reach, at)),
                Step::Loop { number, .. } => {
                    let stitch = &run.loops[number as usize];
                    end(reach, stitch.at, stitch.source);
                    first.get_or_insert((stitch.at, stitch.source));
                    reach = Some([stitch.at; 2]);
                }
            }
        }
        if let (Some([right, _]), Some(width), Some((at, source))) = (strand.onward, width, first) {
            end(reach, at + (right * width) as f32, source);
        }
    }
    for (needles, source, carrier) in found {
        run.at_source(source);
        run.fault(FaultKind::LongFloat { needles, limit }, None, Some(carrier));
    }
}
