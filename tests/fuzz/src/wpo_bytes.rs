//! Mutations of WeavePoint drafts.

use fastrand::Rng;

use crate::yarn_bytes::change;

/// A small draft of a random kind, mutated.
pub(crate) fn mutated(random: &mut Rng) -> Vec<u8> {
    let mut bytes = seed(random);
    change(&mut bytes, random);
    bytes
}

fn seed(random: &mut Rng) -> Vec<u8> {
    let (kind, shafts, treadles) = (random.u8(100..103), random.u8(1..20), random.u8(1..12));
    let (ends, picks) = (random.u16(1..9), random.u16(1..9));
    let sinking = random.u8(..2);
    let mut bytes = vec![123, random.u8(2..8), kind, 10, shafts, treadles, 0, sinking, 1, 5, 25, 1, 134];
    bytes.extend([4, 176, 4, 176, random.u8(..2), 3, 6, 7, 7, 0, 0]);
    let mut list = |count: u16, most: u8, random: &mut Rng| {
        bytes.extend(count.to_be_bytes());
        bytes.extend((0..count).map(|_| random.u8(0..=most)));
    };
    list(ends, shafts, random);
    list(ends, 2, random);
    list(picks + 3, 2, random);
    let masks = |count: u16, bits: u8, random: &mut Rng| -> Vec<u8> {
        (0..count * u16::from(bits).div_ceil(8)).map(|_| random.u8(..)).collect()
    };
    if kind > 100 {
        bytes.extend(masks(treadles.into(), shafts, random));
    }
    bytes.extend(picks.to_be_bytes());
    bytes.extend(match kind {
        100 => masks(picks, shafts, random),
        101 => (0..picks).map(|_| random.u8(0..=treadles)).collect(),
        _ => masks(picks, treadles, random),
    });
    bytes.extend([0; 66]);
    bytes.extend([3, 255, 0, 9, 63, 62, 61, 100, 150, 200]);
    bytes.extend(b"\x09twill.wif");
    bytes
}
