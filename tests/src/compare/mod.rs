//! The comparison of one output with the oracle, or with another output.

mod assemble;
mod bounds;
mod report;

pub use assemble::{Assembled, AssembledCap, assemble};
pub use bounds::{
    COORDINATE_ULPS, DIRECTION, INTERVAL_TWIST, NEAR_VERTICAL, POSITION, ROLL_DRIFT, ROLL_FLOOR,
    SURELY_VERTICAL,
};
pub use report::{Fault, Mismatch, Quantity, Report, RingPlace, Worst};

use std::f64::consts::TAU;

use glam::DVec3;
use texere_core::backend::Plan;
use texere_core::definitions::{Ring, Turn};
use texere_core::{End, Frame, Vertex};

use crate::oracle::{Oracle, OracleRing};
use crate::poison::is_poison;

/// The errors that a ring is allowed.
struct Allowance {
    /// Error of a centre, mm.
    position: f64,
    /// Error of the turn about the tangent, rad.
    roll: f64,
    /// Whether the frame can be compared: see [`NEAR_VERTICAL`].
    framed: bool,
}

impl Allowance {
    fn new(ring: &OracleRing, number: usize) -> Self {
        let tilt = ring.tangent.x.hypot(ring.tangent.y);
        Self {
            position: POSITION * ring.thinnest() + COORDINATE_ULPS * ulp(ring.extent),
            roll: ROLL_FLOOR
                + ROLL_DRIFT * (number as f64 + ring.twist)
                + INTERVAL_TWIST * ring.interval_twist
                // The roll of a yarn that leans begins with the lean in a rotation-minimising
                // frame, and follows it all along in an upright one.
                + if ring.leans { DIRECTION } else { 0.0 },
            framed: !(SURELY_VERTICAL..NEAR_VERTICAL).contains(&tilt),
        }
    }
}

/// The distance from `value` to the next f32.
fn ulp(value: f64) -> f64 {
    let value = value as f32;
    f64::from(value.next_up()) - f64::from(value)
}

/// Whether two values are equal to the bit. Unlike with `==`, a NaN equals itself, and 0 differs
/// from -0.
pub(crate) fn same_bits<T: bytemuck::Pod>(a: &T, b: &T) -> bool {
    bytemuck::bytes_of(a) == bytemuck::bytes_of(b)
}

fn wide(value: [f32; 3]) -> DVec3 {
    DVec3::from_array(value.map(f64::from))
}

/// Compares the counts that a plan promises with those of the oracle.
pub fn compare_counts(oracle: &Oracle, plan: &Plan, report: &mut Report) {
    let (expected, actual) = (oracle.counts(), plan.counts());
    for (what, expected, actual) in [
        ("yarns", oracle.yarns.len() as u64, actual.yarns),
        ("rings", expected.rings, actual.rings),
        ("vertices", expected.vertices, actual.vertices),
        ("triangles", expected.triangles, actual.triangles),
        ("indices", expected.indices, actual.indices),
    ] {
        report.note_count(what, RingPlace::default(), expected, actual);
    }
}

/// The reference that an output is compared with.
trait Expected {
    fn ring(&self, yarn: usize, number: usize) -> OracleRing;
    /// Position and normal.
    fn vertex(&self, yarn: usize, number: usize, point: usize) -> (DVec3, DVec3);
}

impl Expected for Oracle {
    fn ring(&self, yarn: usize, number: usize) -> OracleRing {
        self.yarns[yarn].rings[number]
    }

    fn vertex(&self, yarn: usize, number: usize, point: usize) -> (DVec3, DVec3) {
        Self::vertex(self, yarn, number, point)
    }
}

/// The output of another backend as the reference. Values that no output has, such as the twist so
/// far, come from the oracle.
struct Gold<'a> {
    oracle: &'a Oracle,
    output: &'a Assembled,
}

impl Expected for Gold<'_> {
    fn ring(&self, yarn: usize, number: usize) -> OracleRing {
        let gold = &self.output.rings[self.output.offsets[yarn] + number];
        let (tangent, roll) = (wide(gold.tangent), turns(gold.roll));
        let [side, level] = [roll, turns(gold.lean)].map(|turn| side(tangent, turn));
        OracleRing {
            centre: wide(gold.centre),
            halves: [gold.half_width, gold.half_height].map(f64::from),
            growths: [gold.width_growth, gold.height_growth].map(f64::from),
            tangent,
            roll,
            upright: [level, tangent.cross(level)],
            side,
            up: tangent.cross(side),
            ..self.oracle.yarns[yarn].rings[number]
        }
    }

    fn vertex(&self, yarn: usize, number: usize, point: usize) -> (DVec3, DVec3) {
        let sides = self.oracle.settings.sides as usize;
        let gold = &self.output.vertices[(self.output.offsets[yarn] + number) * sides + point];
        (wide(gold.position), wide(gold.normal))
    }
}

/// Compares every ring, vertex and cap of `output` with the oracle.
pub fn compare_with_oracle(oracle: &Oracle, output: &Assembled, report: &mut Report) {
    compare(oracle, oracle, output, report);
}

/// Compares every ring and vertex of `output` with `gold` within the bounds for the oracle, and the
/// triangles of every cap to the bit.
pub fn compare_with_gold(oracle: &Oracle, gold: &Assembled, output: &Assembled, report: &mut Report) {
    compare(oracle, &Gold { oracle, output: gold }, output, report);
    for (old, new) in gold.caps.iter().zip(&output.caps) {
        if !same_triangles(old, new) {
            let place = RingPlace { yarn: old.yarn as u64, ..RingPlace::default() };
            report.note(Fault::Index, place, &old.triangles, &new.triangles);
        }
    }
}

fn compare(oracle: &Oracle, expected: &impl Expected, output: &Assembled, report: &mut Report) {
    let sides = oracle.settings.sides as usize;
    for yarn in 0..oracle.yarns.len() {
        for (number, at) in output.rings_of(yarn).enumerate() {
            let place = RingPlace { yarn: yarn as u64, ring: number as u64, point: None };
            let ring = expected.ring(yarn, number);
            let allowed = Allowance::new(&ring, number);
            compare_ring(oracle.yarns[yarn].frame, &ring, &output.rings[at], &allowed, place, report);
            for (point, vertex) in output.vertices[at * sides..(at + 1) * sides].iter().enumerate() {
                let (place, vertex_expected) =
                    (RingPlace { point: Some(point as u64), ..place }, expected.vertex(yarn, number, point));
                compare_vertex(&ring, vertex_expected, vertex, &allowed, place, report);
            }
        }
    }
    for cap in &output.caps {
        compare_cap(oracle, expected, cap, report);
    }
}

/// Reports NaN and infinity, and distinguishes memory that was never written from wrong results.
fn is_finite(values: &[f32], place: RingPlace, report: &mut Report) -> bool {
    let finite = values.iter().all(|value| value.is_finite());
    if !finite {
        let unwritten = values.iter().any(|&value| is_poison(value));
        report.note(if unwritten { Fault::Missing } else { Fault::NotFinite }, place, "numbers", values);
    }
    finite
}

fn compare_ring(
    frame: Frame,
    expected: &OracleRing,
    actual: &Ring,
    allowed: &Allowance,
    place: RingPlace,
    report: &mut Report,
) {
    let [x, y, z] = actual.centre;
    let [tx, ty, tz] = actual.tangent;
    let Ring { half_width, half_height, width_growth, height_growth, .. } = *actual;
    let sizes = [half_width, half_height, width_growth, height_growth];
    if !is_finite(&[x, y, z, tx, ty, tz], place, report) || !is_finite(&sizes, place, report) {
        return;
    }
    let (centre, tangent) = (wide(actual.centre), wide(actual.tangent));
    let error = [(centre - expected.centre).length(), allowed.position, expected.thinnest()];
    report.check(Quantity::Centre, place, error, (expected.centre, centre));
    for (half, expected) in [half_width, half_height].map(f64::from).into_iter().zip(expected.halves) {
        let error = [(half - expected).abs(), DIRECTION * expected, expected];
        report.check(Quantity::Half, place, error, (expected, half));
    }
    for (growth, expected) in [width_growth, height_growth].map(f64::from).into_iter().zip(expected.growths) {
        let room = 1.0 + expected.abs();
        report.check(
            Quantity::Growth,
            place,
            [(growth - expected).abs(), DIRECTION * room, room],
            (expected, growth),
        );
    }
    let error = [(tangent - expected.tangent).length(), DIRECTION, 1.0];
    if !report.check(Quantity::Tangent, place, error, (expected.tangent, tangent)) {
        // Rolls about different tangents can't be compared.
        return;
    }
    // Between two rings near the vertical, the upright frame may turn in either direction, and so
    // may a roll or a lean that is measured against it. Only the direction that frame and turn make
    // together is defined, and is compared. The roll of an upright yarn is compared by itself,
    // unless the yarn leans.
    let roll = turns(actual.roll);
    let off = |turn: f64, [level, rising]: [DVec3; 2]| {
        let side = side(tangent, turn);
        side.dot(rising).atan2(side.dot(level))
    };
    let turn = match frame {
        Frame::Upright if !expected.leans => (roll - expected.roll) * TAU,
        _ if allowed.framed => off(roll, [expected.side, expected.up]),
        _ => 0.0,
    };
    let turn = turn - (turn / TAU).round() * TAU;
    let values = ((expected.roll, expected.side), roll);
    report.check(Quantity::Roll, place, [turn.abs(), allowed.roll, 1.0], values);
    let lean = turns(actual.lean);
    if !expected.leans && lean != 0.0 {
        report.note(Fault::Lean, place, "none", lean);
    } else if expected.leans && allowed.framed {
        let error = [off(lean, expected.upright).abs(), DIRECTION, 1.0];
        report.check(Quantity::Lean, place, error, (expected.upright, lean));
    }
}

/// A roll or a lean, in turns.
fn turns(turn: Turn) -> f64 {
    f64::from(turn.0) / 4_294_967_296.0
}

/// The side of a ring: that of its tangent's upright frame, turned about the tangent by a roll in
/// turns.
fn side(tangent: DVec3, roll: f64) -> DVec3 {
    let level = DVec3::new(-tangent.y, tangent.x, 0.0);
    let side = if level.length() < 1e-6 { DVec3::Y } else { level.normalize() };
    side * (roll * TAU).cos() + tangent.cross(side) * (roll * TAU).sin()
}

fn compare_vertex(
    ring: &OracleRing,
    (position, normal): (DVec3, DVec3),
    actual: &Vertex,
    allowed: &Allowance,
    place: RingPlace,
    report: &mut Report,
) {
    let ([x, y, z], [nx, ny, nz]) = (actual.position, actual.normal);
    if !is_finite(&[x, y, z, nx, ny, nz], place, report) {
        return;
    }
    let (actual_position, actual_normal) = (wide(actual.position), wide(actual.normal));
    let (arm, actual_arm) = (position - ring.centre, actual_position - ring.centre);
    let room = allowed.position;
    if allowed.framed {
        let error = (actual_position - position).length();
        let room = [error, room + arm.length() * ring.flatness() * allowed.roll, ring.thinnest()];
        report.check(Quantity::Vertex, place, room, (position, actual_position));
        let room = DIRECTION + ring.flatness() * allowed.roll;
        let error = [(actual_normal - normal).length(), room, 1.0];
        report.check(Quantity::Normal, place, error, (normal, actual_normal));
    } else if !ring.is_round() {
        // The distance of a vertex from the centre depends on the frame, which is not defined here.
        // The vertex has to lie in the ring's plane, with a normal of length 1.
        let off_plane = actual_arm.dot(ring.tangent).abs();
        let error = [off_plane, room + arm.length() * ring.flatness() * DIRECTION, ring.thinnest()];
        report.check(Quantity::Vertex, place, error, (position, actual_position));
        let error = [(actual_normal.length() - 1.0).abs(), DIRECTION, 1.0];
        report.check(Quantity::Normal, place, error, (normal, actual_normal));
    } else {
        // Without a frame, the vertex has to lie in the ring's plane at the right distance from the
        // centre. Its normal has to have the right components outward and along the yarn.
        let off_plane = actual_arm.dot(ring.tangent).abs();
        let off_distance = (actual_arm.length() - arm.length()).abs();
        let error = [off_plane.max(off_distance), room + arm.length() * DIRECTION, ring.thinnest()];
        report.check(Quantity::Vertex, place, error, (position, actual_position));
        let lean = |normal: DVec3, arm: DVec3| {
            [normal.dot(ring.tangent), normal.dot(arm.normalize()), normal.length()]
        };
        let (expected, actual) = (lean(normal, arm), lean(actual_normal, actual_arm));
        let error = (0..3).map(|k| (expected[k] - actual[k]).abs()).fold(0.0, f64::max);
        report.check(Quantity::Normal, place, [error, DIRECTION, 1.0], (expected, actual));
    }
}

/// Checks that a cap lies on its yarn's end, and that its normals point straight out.
fn compare_cap(oracle: &Oracle, expected: &impl Expected, cap: &AssembledCap, report: &mut Report) {
    let last = oracle.yarns[cap.yarn].rings.len() - 1;
    let (number, sign) = if cap.end == End::Start { (0, -1.0) } else { (last, 1.0) };
    let ring = expected.ring(cap.yarn, number);
    let allowed = Allowance::new(&ring, number);
    for (point, vertex) in cap.vertices.iter().enumerate() {
        let place = RingPlace { yarn: cap.yarn as u64, ring: number as u64, point: Some(point as u64) };
        let (position, _) = expected.vertex(cap.yarn, number, point);
        compare_vertex(&ring, (position, ring.tangent * sign), vertex, &allowed, place, report);
    }
}

/// Whether two caps have the same triangles. True if `new` has none, because a cap that was never
/// written has been reported as missing.
fn same_triangles(old: &AssembledCap, new: &AssembledCap) -> bool {
    new.triangles.is_empty() || old.triangles == new.triangles
}

/// Checks that the first and the last ring of each closed yarn are equal to the bit, and that their
/// vertices are.
pub fn compare_closed_ends(oracle: &Oracle, output: &Assembled, report: &mut Report) {
    let sides = oracle.settings.sides as usize;
    for yarn in (0..oracle.yarns.len()).filter(|&yarn| oracle.yarns[yarn].closed) {
        let rings = output.rings_of(yarn);
        let (first, last) = (rings.start, rings.end - 1);
        let place = RingPlace { yarn: yarn as u64, ring: (last - first) as u64, point: None };
        let (old, new) = (&output.rings[first], &output.rings[last]);
        if !same_bits(old, new) {
            report.note(Fault::Bits, place, old, new);
        }
        for point in 0..sides {
            let (old, new) =
                (&output.vertices[first * sides + point], &output.vertices[last * sides + point]);
            if !same_bits(old, new) {
                report.note(Fault::Bits, RingPlace { point: Some(point as u64), ..place }, old, new);
            }
        }
    }
}

/// Compares two outputs that have to be equal to the bit: `actual` was made in other chunks, by
/// another way through the session, or by a backend that promises equal bits.
pub fn compare_bits(oracle: &Oracle, expected: &Assembled, actual: &Assembled, report: &mut Report) {
    let sides = oracle.settings.sides as usize;
    for yarn in 0..oracle.yarns.len() {
        let range = expected.rings_of(yarn);
        for (ring, at) in range.enumerate() {
            let place = RingPlace { yarn: yarn as u64, ring: ring as u64, point: None };
            let (old, new) = (&expected.rings[at], &actual.rings[at]);
            if !same_bits(old, new) {
                report.note(Fault::Bits, place, old, new);
            }
            for point in 0..sides {
                let (old, new) =
                    (&expected.vertices[at * sides + point], &actual.vertices[at * sides + point]);
                if !same_bits(old, new) {
                    report.note(Fault::Bits, RingPlace { point: Some(point as u64), ..place }, old, new);
                }
            }
        }
    }
    for (old, new) in expected.caps.iter().zip(&actual.caps) {
        let same = old.vertices.iter().zip(&new.vertices).all(|(old, new)| same_bits(old, new));
        if !same || !same_triangles(old, new) {
            report.note(Fault::Bits, RingPlace { yarn: old.yarn as u64, ..RingPlace::default() }, old, new);
        }
    }
}
