//! Frames in f64: the upright frame, and the frame that is carried along without turning.

use glam::DVec3;

/// Side and up of the upright frame for the tangent t: side = z × t, which is level, and up = t ×
/// side. For tangents within 1e-6 of z the side is +y.
pub(super) fn upright(tangent: DVec3) -> (DVec3, DVec3) {
    let level = DVec3::Z.cross(tangent);
    let side = if level.length() < 1e-6 { DVec3::Y } else { level.normalize() };
    (side, tangent.cross(side))
}

/// `side` of the ring with `tangent`, carried over `chord` to the ring with `next` as tangent.
///
/// **Source**: double reflection, Wang, Jüttler, Zheng and Liu, ACM TOG 27(1), 2008. The first
/// reflection maps one centre to the other, the second the reflected tangent to the next tangent.
/// Rings that coincide have no chord, and the tangent is used in its place. If a yarn turns
/// straight back, tangents do not determine the second reflection. It is defined to keep the
/// upright side, because rolls are turns against the upright frame.
pub(super) fn transport(side: DVec3, tangent: DVec3, next: DVec3, chord: DVec3) -> DVec3 {
    let across = if chord.length_squared() <= 1e-30 { tangent } else { chord.normalize() };
    let (side, reflected) = (mirror(side, across), mirror(tangent, across));
    let between = next - reflected;
    let between = if between.length_squared() <= 1e-6 { upright(tangent).1 } else { between.normalize() };
    let side = mirror(side, between);
    // Rounding errors along the tangent must not add up over a million rings.
    (side - next * side.dot(next)).normalize()
}

/// Direction of a yarn's height at `t`, from 0 to 1 between two control points, each of which has
/// an up direction and a tangent. `tangent` is the tangent at `t`. The result is zero if the height
/// has no direction.
///
/// The smallest rotation that takes a control point's tangent to `tangent` turns its up; here it is
/// two reflections. The parts across the tangent are mixed. The second up counts with the sign that
/// brings it nearer to the first. At a right angle, up to rounding, it keeps its own sign.
pub(super) fn up_between(one: (DVec3, DVec3), other: (DVec3, DVec3), tangent: DVec3, t: f64) -> DVec3 {
    let across = |v: DVec3| {
        let part = v - tangent * v.dot(tangent);
        if part.length() > 1e-6 { part.normalize() } else { DVec3::ZERO }
    };
    let [one, other] = [one, other].map(|(up, from)| {
        let middle = from + tangent;
        // If the tangent turns straight back, there is no smallest rotation, and the up stays.
        let turns = middle.length() > 4e-5;
        across(if turns { mirror(mirror(up, from), middle.normalize()) } else { up })
    });
    let other = if one.dot(other) < -1e-9 { -other } else { other };
    let mixed = across(one.lerp(other, t));
    // An up along the yarn has no part across it.
    let left = if one == DVec3::ZERO { other } else { one };
    if mixed == DVec3::ZERO { left } else { mixed }
}

fn mirror(v: DVec3, normal: DVec3) -> DVec3 {
    v - normal * (2.0 * v.dot(normal))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn upright_frames_are_right_handed_and_level() {
        for tangent in [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::Z, DVec3::new(1.0, -2.0, 3.0).normalize()] {
            let (side, up) = upright(tangent);
            assert!((side.cross(up) - tangent).length() < 1e-12, "{tangent}");
            assert_eq!(side.z, 0.0, "{tangent}");
        }
    }

    /// Two ups that are equally steep stay so around an arc. Half way between two ups at a right
    /// angle the direction is their middle. Opposite ups are one direction.
    #[test]
    fn ups_go_over_into_one_another() {
        let at = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 0.0);
        let tangent = |angle: f64| DVec3::new(-angle.sin(), angle.cos(), 0.0);
        for angle in [1e-6, 0.1, 1.0, 3.0] {
            let tilted = |angle: f64| ((at(angle) + DVec3::Z).normalize(), tangent(angle));
            let up = up_between(tilted(0.0), tilted(angle), tangent(0.3 * angle), 0.3);
            assert!((up - tilted(0.3 * angle).0).length() < 1e-12, "{angle}: {up}");
        }
        let up = up_between((DVec3::Z, DVec3::X), (DVec3::Y, DVec3::X), DVec3::X, 0.5);
        assert!((up - DVec3::new(0.0, 1.0, 1.0).normalize()).length() < 1e-12, "{up}");
        // The direction of a height has no sign.
        let opposite = up_between((DVec3::Z, DVec3::X), (-DVec3::Z, DVec3::X), DVec3::X, 0.5);
        assert_eq!(opposite, DVec3::Z);
    }

    /// A vector that is carried along a circle without turning keeps its part across the circle's
    /// plane, and its part in the plane follows the radius.
    #[test]
    fn transport_round_an_arc_turns_with_the_radius() {
        let at = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 0.0);
        let tangent = |angle: f64| DVec3::new(-angle.sin(), angle.cos(), 0.0);
        for angle in [1e-6, 0.1, 1.0, 3.0] {
            let start = (at(0.0) + DVec3::Z * 2.0).normalize();
            let carried = transport(start, tangent(0.0), tangent(angle), at(angle) - at(0.0));
            assert!((carried - (at(angle) + DVec3::Z * 2.0).normalize()).length() < 1e-12, "{angle}");
        }
    }
}
