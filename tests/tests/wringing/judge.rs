//! The turn of a mesh from ring to ring, in f64, from its vertices and from the centres and
//! tangents of its rings. Nothing here uses texere's frames.

use glam::DVec3;
use texere_core::{Backend, Pipeline, Settings, Topology, Yarns};

/// Rings that are closer than this share of the radius count as cutting one another. The yarn folds
/// there, so the triangles between them do not count.
const CLEAR: f64 = 0.02;

/// The worst values of a mesh between neighbouring rings.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Drawn {
    /// The largest turn from a ring to the next, beyond the yarn's twist, degrees. The first ring
    /// is carried along the yarn to the second one, and compared with it there.
    pub(crate) turn: f64,
    /// The least distance of the tube from the axis half way between two rings, over its distance
    /// on the rings. Bends count as straightened. Twisted yarns do not count.
    pub(crate) width: f64,
    /// Number of triangles that face the axis, between rings that do not cut one another.
    pub(crate) inwards: usize,
}

pub(crate) fn drawn(device: &dyn Backend, yarns: &Yarns, settings: Settings) -> Drawn {
    let settings = Settings { topology: Topology::None, caps: false, ..settings };
    let mesh = Pipeline::new(yarns).settings(settings).mesh(device).unwrap();
    let trajectory = Pipeline::new(yarns).settings(settings).trajectory(device).unwrap();
    assert_eq!(mesh.chunks.len(), 1, "a small case");
    let sides = settings.sides as usize;
    let wide = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    let mut drawn = Drawn { turn: 0.0, width: f64::INFINITY, inwards: 0 };
    for (yarn, bounds) in trajectory.offsets.windows(2).enumerate() {
        let twist = f64::from(yarns.layout().yarns()[yarn].twist);
        for ring in bounds[0] as usize..bounds[1] as usize - 1 {
            let [here, next] = [ring, ring + 1].map(|ring| {
                let own = &trajectory.rings[ring];
                let (centre, tangent) = (wide(own.centre), wide(own.tangent));
                let vertices = &mesh.vertices[ring * sides..][..sides];
                let arms: Vec<_> = vertices.iter().map(|vertex| wide(vertex.position) - centre).collect();
                (centre, tangent, arms)
            });
            let chord = next.0 - here.0;
            let carry = carrier(here.1, next.1, chord);
            let (mut across, mut along) = (0.0, 0.0);
            for (arm, other) in here.2.iter().zip(&next.2) {
                let arm = carry(*arm);
                across += arm.cross(*other).dot(next.1);
                along += arm.dot(*other);
            }
            let turn = across.atan2(along) - twist * chord.length();
            let turn = turn - (turn / std::f64::consts::TAU).round() * std::f64::consts::TAU;
            drawn.turn = drawn.turn.max(turn.abs().to_degrees());
            for (arm, other) in here.2.iter().zip(&next.2) {
                let width = (carry(*arm) + *other).length() / (arm.length() + other.length());
                if twist == 0.0 {
                    drawn.width = drawn.width.min(width);
                }
            }
            let ahead = |arms: &[DVec3], way: DVec3, tangent: DVec3| {
                arms.iter().all(|arm| (way + *arm).dot(tangent) > CLEAR * arm.length())
            };
            let behind: Vec<_> = here.2.iter().map(|arm| -*arm).collect();
            if !ahead(&next.2, chord, here.1) || !ahead(&behind, chord, next.1) {
                continue;
            }
            for k in 0..sides {
                let (one, two) = (k, (k + 1) % sides);
                let place = |at: &(DVec3, DVec3, Vec<DVec3>), k: usize| at.0 + at.2[k];
                for [a, b, c] in
                    [[(&here, one), (&here, two), (&next, one)], [(&here, two), (&next, two), (&next, one)]]
                {
                    let [p, q, r] = [a, b, c].map(|(at, k)| place(at, k));
                    let outwards = a.0.2[a.1] + b.0.2[b.1] + c.0.2[c.1];
                    drawn.inwards += usize::from((q - p).cross(r - p).dot(outwards) < 0.0);
                }
            }
        }
    }
    drawn
}

/// Carries a vector across a yarn from one ring to the next, without turning it.
///
/// **Source**: double reflection, Wang, Jüttler, Zheng and Liu, ACM TOG 27(1), 2008, table I.
fn carrier(tangent: DVec3, next: DVec3, chord: DVec3) -> impl Fn(DVec3) -> DVec3 {
    let mirrored = |v: DVec3, normal: DVec3| v - normal * (2.0 * v.dot(normal) / normal.length_squared());
    let first = if chord.length_squared() > 1e-20 { chord } else { tangent };
    let second = next - mirrored(tangent, first);
    move |v| {
        let reflected = mirrored(v, first);
        // Where a yarn turns straight back, the second reflection is not defined.
        if second.length_squared() > 1e-6 { mirrored(reflected, second) } else { reflected }
    }
}
