//! Yarns that float past too many needles.

use super::super::Step;
use super::FaultKind;
use super::run::Run;

/// Notes floats past more needles than they should. A repeat is `width` needles wide.
pub(super) fn long(run: &mut Run<'_>, width: Option<i32>, limit: u32) {
    let mut found = Vec::new();
    for strand in &run.carriers.strands {
        let loops = strand.steps.iter().filter_map(|step| match *step {
            Step::Loop { number, .. } => Some(&run.loops[number as usize]),
            Step::Float { .. } => None,
        });
        let seam = strand.onward.zip(width).and_then(|([right, _], width)| {
            let first = loops.clone().next()?;
            Some((first.at + (right * width) as f32, first.source))
        });
        let places: Vec<_> = loops.map(|stitch| (stitch.at, stitch.source)).chain(seam).collect();
        for pair in places.windows(2) {
            let needles = ((pair[1].0 - pair[0].0).abs().ceil() as u32).saturating_sub(1);
            if needles > limit {
                found.push((needles, pair[1].1, strand.carrier));
            }
        }
    }
    for (needles, source, carrier) in found {
        run.at_source(source);
        run.fault(FaultKind::LongFloat { needles, limit }, None, Some(carrier));
    }
}
