//! The Gauss linking integral of two polygons.

use std::f64::consts::TAU;

use glam::DVec3;

/// The linking integral of two polygons: the sum over all pairs of their chords.
///
/// The integral of two chords is 1/4π of the solid angle of the spherical quadrilateral whose
/// corners are the directions between their ends.
///
/// **Source**: Klenin and Langowski, "Computation of writhe in modeling of supercoiled DNA",
/// Biopolymers 54, 2000, method 1a. The solid angle is that of two triangles, each by van Oosterom
/// and Strackee, "The solid angle of a plane triangle", IEEE Transactions on Biomedical Engineering
/// 30, 1983. That needs one arctangent instead of four arcsines, and is exact even if chords are
/// nearly in one plane.
pub(super) fn integral(one: &[DVec3], other: &[DVec3]) -> f64 {
    let mut sum = 0.0;
    for ends in one.windows(2) {
        let [start, end] = [ends[0], ends[1]];
        let away = |corner: DVec3| [corner - start, corner - end].map(|way| (way, way.length()));
        let mut corners = other.iter().map(|corner| away(*corner));
        let Some(mut before) = corners.next() else { break };
        for after in corners {
            sum += half_angle(before, after);
            before = after;
        }
    }
    sum / TAU
}

/// Half the solid angle of two chords, rad. The arguments are vectors with their lengths: from the
/// first chord's start and end to the second chord's start, then to its end.
fn half_angle(
    [(p, p_long), (s, s_long)]: [(DVec3, f64); 2],
    [(q, q_long), (r, r_long)]: [(DVec3, f64); 2],
) -> f64 {
    // The tetrahedra of both triangles and the origin have the same volume: that of the chords'
    // tetrahedron.
    let volume = q.dot(p.cross(r));
    let (pr, pr_long) = (p.dot(r), p_long * r_long);
    let one = pr_long * q_long + p.dot(q) * r_long + q.dot(r) * p_long + pr * q_long;
    let other = pr_long * s_long + p.dot(s) * r_long + s.dot(r) * p_long + pr * s_long;
    let (over, under) = (volume * (one + other), one * other - volume * volume);
    // Chords in one plane have no solid angle.
    if volume == 0.0 { 0.0 } else { over.atan2(under) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ring of radius 1, in the plane of x and y, or `upright` in the plane of x and z.
    fn ring(centre: DVec3, upright: bool, count: usize) -> Vec<DVec3> {
        let point = |k: usize| {
            let (sine, cosine) = (k as f64 / count as f64 * TAU).sin_cos();
            centre + if upright { DVec3::new(cosine, 0.0, sine) } else { DVec3::new(cosine, sine, 0.0) }
        };
        (0..=count).map(|k| point(k % count)).collect()
    }

    /// The integral by its definition, as a sum over `steps` places of each chord.
    fn by_definition(one: &[DVec3], other: &[DVec3], steps: usize) -> f64 {
        let places = |line: &[DVec3]| -> Vec<(DVec3, DVec3)> {
            let chords = line.windows(2).map(|ends| (ends[0], (ends[1] - ends[0]) / steps as f64));
            chords
                .flat_map(|(start, step)| (0..steps).map(move |k| (start + step * (k as f64 + 0.5), step)))
                .collect()
        };
        let (one, other) = (places(one), places(other));
        let pairs = one.iter().flat_map(|one| other.iter().map(move |other| (one, other)));
        let parts = pairs.map(|((p, step), (q, other_step))| {
            let apart = *p - *q;
            apart.dot(step.cross(*other_step)) / apart.length().powi(3)
        });
        parts.sum::<f64>() / (2.0 * TAU)
    }

    #[test]
    fn rings_link_once_or_not_at_all() {
        for count in [3, 8, 40, 200] {
            let flat = ring(DVec3::ZERO, false, count);
            for (x, linked) in [(1.0, 1.0), (0.6, 1.0), (2.5, 0.0), (-0.9, -1.0), (40.0, 0.0)] {
                let mut upright = ring(DVec3::new(x, 0.1, 0.05), true, count);
                let sum = integral(&flat, &upright);
                assert!((sum.abs() - f64::abs(linked)).abs() < 1e-9, "{count} chords, {x}: {sum}");
                // The order of the two does not matter. Reversing one of them changes the sign.
                assert!((integral(&upright, &flat) - sum).abs() < 1e-9);
                upright.reverse();
                assert!((integral(&flat, &upright) + sum).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn windows_of_rings_add_up_to_their_linking() {
        let (flat, upright) = (ring(DVec3::ZERO, false, 48), ring(DVec3::new(1.0, 0.0, 0.0), true, 48));
        // Each window has six chords, and shares its ends with its neighbours.
        let windows = |line: &[DVec3]| -> Vec<Vec<DVec3>> {
            (0..8).map(|k| line[6 * k..=6 * k + 6].to_vec()).collect()
        };
        let (one, other) = (windows(&flat), windows(&upright));
        let sum: f64 = one.iter().flat_map(|one| other.iter().map(|other| integral(one, other))).sum();
        assert!((sum.abs() - 1.0).abs() < 1e-9, "{sum}");
        let away = other
            .iter()
            .map(|window| window.iter().map(|corner| *corner + DVec3::X * 1.5).collect::<Vec<_>>());
        let away: Vec<_> = away.collect();
        let sum: f64 = one.iter().flat_map(|one| away.iter().map(|other| integral(one, other))).sum();
        assert!(sum.abs() < 1e-9, "{sum}");
    }

    #[test]
    fn chords_have_the_integral_of_the_definition() {
        // Knuth's linear congruential generator.
        let mut state = 1_u64;
        let mut number = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        for _ in 0..50 {
            let mut place = |z: f64| DVec3::new(number(), number(), z + 0.3 * number());
            let (one, other) = ([place(0.0), place(0.0), place(0.0)], [place(0.5), place(0.5), place(0.5)]);
            let (sum, expected) = (integral(&one, &other), by_definition(&one, &other, 100));
            assert!((sum - expected).abs() < 1e-3, "{sum}, {expected}: {one:?}, {other:?}");
        }
    }

    #[test]
    fn long_lines_that_cross_have_half_of_the_whole() {
        let line = |along: DVec3, off: DVec3| [off - along, off, off + along];
        let under = line(DVec3::X * 1e4, DVec3::ZERO);
        for (height, expected) in [(-1.0, 0.5), (1.0, -0.5)] {
            let sum = integral(&under, &line(DVec3::Y * 1e4, DVec3::Z * height));
            assert!((sum - expected).abs() < 1e-3, "{height}: {sum}");
        }
    }

    #[test]
    fn chords_in_one_plane_sweep_nothing() {
        let flat = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0)];
        for other in [
            [DVec3::X, DVec3::Y],
            [DVec3::ZERO, DVec3::X],
            [DVec3::Y, DVec3::Y],
            [DVec3::NEG_Y, DVec3::Y * 3.0],
        ] {
            assert_eq!(integral(&flat, &other), 0.0, "{other:?}");
        }
    }
}
