//! The oracle: the whole pipeline in f64, slow and plain.
//!
//! The oracle is written from the definitions: the paper's equations and the documents of the
//! core's types. It works out rings and vertices without the core's geometry, so that it and the
//! core share no error. It takes from the layout which yarns are steep, and the up directions of
//! yarns that lean. Control points count as exact.
//!
//! The oracle uses other methods than the core where it can. The spline is the paper's basis
//! instead of powers of t. The rotation-minimising frame is a vector that is carried along instead
//! of a sum of turns. Areas of sections are closed forms, or an integral, instead of polygons.

mod frame;
mod section;
mod spline;
mod triangles;

pub use section::{OutlinePoint, outline};
pub use triangles::{Flaw, cap_flaw, quad_indices};

use glam::{DVec3, Vec3};
use texere_core::{Frame, Settings, Topology, Yarn, Yarns};

use frame::{transport, up_between, upright};
use spline::Curve;

/// An exact ring.
#[derive(Debug, Clone, Copy)]
pub struct OracleRing {
    /// Centre, mm.
    pub centre: DVec3,
    /// Half width and half height, along [`OracleRing::upright`], mm.
    pub halves: [f64; 2],
    /// Unit tangent.
    pub tangent: DVec3,
    /// Growth of the half width and of the half height along the yarn, mm per mm.
    pub growths: [f64; 2],
    /// Turn against the upright frame, in turns. The part from twist is not reduced to one turn.
    pub roll: f64,
    /// Twist from the yarn's start up to here, rad, without sign. The allowed drift grows with it.
    pub twist: f64,
    /// Twist over the whole control interval of the ring, rad, without sign.
    pub interval_twist: f64,
    /// The largest coordinate of the ring's four control points, mm, without sign. The rounding of
    /// f32 depends on it.
    pub extent: f64,
    /// Side and up of the frame in which the section is flattened: the upright frame, or for a yarn
    /// with up directions the frame that they give.
    pub upright: [DVec3; 2],
    /// Whether the yarn has up directions that it follows.
    pub leans: bool,
    /// Direction of the section's x axis before it is flattened.
    pub side: DVec3,
    /// Direction of the section's y axis before it is flattened.
    pub up: DVec3,
}

impl OracleRing {
    /// Whether the section is as wide as high here. The direction of the upright frame then does
    /// not matter.
    #[must_use]
    pub fn is_round(&self) -> bool {
        self.halves[0] == self.halves[1] && self.growths[0] == self.growths[1]
    }

    /// The smaller of the two halves, mm. Tolerances of positions are shares of it.
    #[must_use]
    pub fn thinnest(&self) -> f64 {
        self.halves[0].min(self.halves[1])
    }

    /// The larger of the two halves, divided by the smaller. If the roll is off by an angle, a
    /// normal may be off by up to this factor times the angle.
    #[must_use]
    pub fn flatness(&self) -> f64 {
        self.halves[0].max(self.halves[1]) / self.thinnest()
    }
}

/// An exact yarn.
#[derive(Debug, Clone)]
pub struct OracleYarn {
    /// The rings of the yarn. The last ring of a closed yarn is a copy of the first.
    pub rings: Vec<OracleRing>,
    /// The number of the yarn's outline.
    pub section: usize,
    /// Whether the yarn's ends join.
    pub closed: bool,
    /// The frame of the yarn's sections.
    pub frame: Frame,
    /// The total turn of a closed yarn less the nearest whole number of turns, in \[-1/2, 1/2).
    /// Near either end of that range, rounding decides in which direction the rest is spread.
    pub excess: f64,
}

/// An exact fabric.
///
/// ```
/// use texere_conformance::oracle::Oracle;
/// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 2.0, 4.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.5)));
/// let oracle = Oracle::new(&yarns.build()?, &Settings::default());
/// // Five rings. The first vertex of the fourth one lies towards +y, a radius off the yarn's axis.
/// assert_eq!(oracle.counts().rings, 5);
/// assert_eq!(oracle.vertex(0, 3, 0).0.to_array(), [3.0, 0.5, 0.0]);
/// # Ok::<(), texere_core::YarnError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Oracle {
    /// The yarns.
    pub yarns: Vec<OracleYarn>,
    /// The outline of each section, in radii.
    pub outlines: Vec<Vec<OutlinePoint>>,
    /// The settings.
    pub settings: Settings,
}

/// The counts that an output should have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OracleCounts {
    /// The number of rings of all yarns.
    pub rings: u64,
    /// The number of vertices, caps included.
    pub vertices: u64,
    /// The number of triangles, caps included.
    pub triangles: u64,
    /// The number of stored indices: three for each triangle, those of the shared pattern, or none.
    pub indices: u64,
}

impl Oracle {
    /// The oracle for `yarns` under `settings`.
    #[must_use]
    pub fn new(yarns: &Yarns, settings: &Settings) -> Self {
        let layout = yarns.layout();
        let ranges = layout.offsets().windows(2).map(|bounds| bounds[0] as usize..bounds[1] as usize);
        Self {
            yarns: layout
                .yarns()
                .iter()
                .zip(ranges)
                .enumerate()
                .map(|(number, (yarn, own))| {
                    let frame = settings.frame.of(layout.is_steep(number));
                    let points = &yarns.points()[own];
                    let curve = Curve::new(points, yarn.closed, layout.tension(), settings.subdivisions);
                    follow(yarn, &curve, layout.ups(number), settings, frame)
                })
                .collect(),
            outlines: layout.sections().iter().map(|section| outline(section, settings.sides)).collect(),
            settings: *settings,
        }
    }

    /// The counts that an output should have.
    #[must_use]
    pub fn counts(&self) -> OracleCounts {
        let sides = u64::from(self.settings.sides);
        let mut counts = OracleCounts { rings: 0, vertices: 0, triangles: 0, indices: 0 };
        let mut most_gaps = 0;
        for yarn in &self.yarns {
            let rings = yarn.rings.len() as u64;
            let caps = if self.settings.caps && !yarn.closed { 2 } else { 0 };
            counts.rings += rings;
            counts.vertices += (rings + caps) * sides;
            counts.triangles += (rings - 1) * sides * 2 + caps * (sides - 2);
            most_gaps = most_gaps.max(rings - 1);
        }
        counts.indices = match self.settings.topology {
            Topology::Indexed => 3 * counts.triangles,
            // The pattern has the quads of the longest yarn, but of 8,192 gaps at most, and both
            // caps of each section.
            Topology::Shared => {
                let caps = if self.settings.caps { 2 * self.outlines.len() as u64 } else { 0 };
                most_gaps.min(8192) * sides * 6 + caps * (sides - 2) * 3
            }
            Topology::None => 0,
        };
        counts
    }

    /// Position (mm) and unit normal of vertex `point` of `ring` of `yarn`.
    #[must_use]
    pub fn vertex(&self, yarn: usize, ring: usize, point: usize) -> (DVec3, DVec3) {
        let OracleYarn { rings, section, .. } = &self.yarns[yarn];
        let (ring, at) = (&rings[ring], &self.outlines[*section][point]);
        let [level, rising] = ring.upright;
        let [a, b] = ring.halves;
        let flatten = |v: DVec3, a: f64, b: f64| level * (v.dot(level) * a) + rising * (v.dot(rising) * b);
        let arm = ring.side * at.x + ring.up * at.y;
        // The normal is at right angles to the flattened outline, and to the direction in which a
        // point of the outline moves along the yarn. The parts of that direction which come from
        // bends and twist are left out.
        let along_outline = flatten(ring.up * at.normal_x - ring.side * at.normal_y, a, b);
        let along_yarn = ring.tangent + flatten(arm, ring.growths[0], ring.growths[1]);
        (ring.centre + flatten(arm, a, b), along_outline.cross(along_yarn).normalize())
    }
}

/// All rings of a yarn.
fn follow(
    yarn: &Yarn,
    curve: &Curve<'_>,
    ups: Option<&[Vec3]>,
    settings: &Settings,
    frame: Frame,
) -> OracleYarn {
    // The side and the up of the frame in which a ring is flattened.
    let stance = |ring: usize, tangent: DVec3| {
        let (side, up) = upright(tangent);
        let Some(ups) = ups else { return [side, up] };
        let (ends, t) = curve.ends(ring as u64);
        let [one, other] = ends.map(|(point, tangent)| (ups[point].as_dvec3(), tangent));
        let own = up_between(one, other, tangent, t);
        if own == DVec3::ZERO { [side, up] } else { [own.cross(tangent), own] }
    };
    let places: Vec<_> = (0..curve.ring_count()).map(|ring| curve.at(ring)).collect();
    let (mut carried, mut turned, mut twisted) = (stance(0, places[0].tangent)[0], 0.0, 0.0);
    let mut rings = Vec::with_capacity(places.len());
    for (number, place) in places.iter().enumerate() {
        let (side, up) = upright(place.tangent);
        let leaning = stance(number, place.tangent);
        let against_upright = |v: DVec3| v.dot(up).atan2(v.dot(side)) / std::f64::consts::TAU;
        let own = match frame {
            Frame::Upright if ups.is_none() => 0.0,
            Frame::Upright => against_upright(leaning[0]),
            Frame::RotationMinimizing => against_upright(carried),
        };
        rings.push(OracleRing {
            centre: place.centre,
            halves: place.halves,
            tangent: place.tangent,
            growths: place.growths,
            roll: own + turned,
            twist: twisted,
            interval_twist: 0.0,
            extent: place.extent,
            upright: leaning,
            leans: ups.is_some(),
            side,
            up,
        });
        if let Some(next) = places.get(number + 1) {
            let chord = curve.chord(number as u64);
            carried = transport(carried, place.tangent, next.tangent, chord);
            let twist = f64::from(yarn.twist) * chord.length();
            turned += twist / std::f64::consts::TAU;
            twisted += twist.abs();
        }
    }
    note_interval_twist(&mut rings, settings.subdivisions as usize + 1);
    let excess = if yarn.closed { close(&mut rings) } else { 0.0 };
    for ring in &mut rings {
        let (sin, cos) = (ring.roll * std::f64::consts::TAU).sin_cos();
        (ring.side, ring.up) = (ring.side * cos + ring.up * sin, ring.up * cos - ring.side * sin);
    }
    OracleYarn { rings, section: yarn.section as usize, closed: yarn.closed, frame, excess }
}

/// Records the twist of each control interval at all of its rings.
fn note_interval_twist(rings: &mut [OracleRing], per_interval: usize) {
    let starts: Vec<_> = rings.iter().step_by(per_interval).map(|ring| ring.twist).collect();
    for (interval, bounds) in starts.windows(2).enumerate() {
        let first = interval * per_interval;
        // The ring at the end of an interval belongs to the next interval, except at the end of the
        // yarn.
        for ring in &mut rings[first..=first + per_interval] {
            ring.interval_twist = bounds[1] - bounds[0];
        }
    }
}

/// Returns the excess of a closed yarn: its total turn less the nearest whole number of turns.
/// Takes the excess off the rolls, evenly along the yarn. Closes the yarn with a copy of its first
/// ring.
fn close(rings: &mut [OracleRing]) -> f64 {
    let gaps = rings.len() - 1;
    let whole = rings[gaps].roll - rings[0].roll;
    let excess = whole - (whole + 0.5).floor();
    for (number, ring) in rings.iter_mut().enumerate() {
        ring.roll -= excess * number as f64 / gaps as f64;
    }
    let twist = rings[gaps].twist;
    rings[gaps] = OracleRing { twist, ..rings[0] };
    excess
}
