//! Weaves whose threads every shape has to keep clear, and cloths in these weaves.

#![allow(dead_code, reason = "no test needs all of it")]
#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

use texere_core::{Material, Section};
use texere_fabric::{Drawdown, Shape, Thread, Weave, Woven};

/// Random bits, by Knuth's linear congruential generator. Its high bits are random enough for a
/// weave.
pub(crate) fn random_bits(seed: u64) -> impl FnMut() -> bool {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        state >> 63 == 1
    }
}

pub(crate) fn weave(notation: &str) -> Drawdown {
    Weave::parse(notation).unwrap().drawdown(10, 10).unwrap()
}

pub(crate) fn random_weave(seed: u64) -> Drawdown {
    let mut bits = random_bits(seed);
    Drawdown::from_fn(10, 10, |_, _| bits()).unwrap()
}

/// Warp satin beside weft satin, with boundaries along ends and along picks, as at the edge of a
/// damask's figure.
fn damask() -> Drawdown {
    let (satin, sateen) = (weave("satin 5"), weave("sateen 5"));
    Drawdown::from_fn(10, 10, |end, pick| if end + pick / 3 < 6 { &satin } else { &sateen }.up(end, pick))
        .unwrap()
}

pub(crate) fn weaves() -> Vec<(String, Drawdown)> {
    let named = ["plain", "3/1", "2/2", "2/2(2+2)", "satin 5", "satin 8(3)", "sateen 8(3)"];
    let named = named.into_iter().map(|name| (name.to_owned(), weave(name)));
    let random = (1..=4).map(|seed| (format!("random weave {seed}"), random_weave(seed)));
    named.chain([("damask".to_owned(), damask())]).chain(random).collect()
}

/// A cloth whose ends are all alike, and whose picks are all alike.
pub(crate) fn cloth(shape: Shape, drawdown: Drawdown, [end, pick]: [Thread; 2], section: Section) -> Woven {
    let (warp, weft) = (vec![end; drawdown.ends()], vec![pick; drawdown.picks()]);
    let mut cloth = Woven::new(drawdown, warp, weft, vec![Material::default()], vec![section]).unwrap();
    cloth.set_shape(shape);
    cloth
}

/// The least pitch at which a thread with this share of the crimp has a straight piece between two
/// bends, over the width of a crossed thread plus the height of the thread itself.
pub(crate) fn jam(share: f32) -> f64 {
    f64::from((share * (2.0 - share)).sqrt())
}
