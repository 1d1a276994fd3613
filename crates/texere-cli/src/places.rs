//! What is said of clearance and bends: the worst places, by the names that a weaver gives them.

use std::fmt;

use serde::Serialize;
use texere::{
    CLEARANCE_ACCURACY, CLEARANCE_BIN, Clearance, Contact, NO_CROSSING, Origin, Thread, Woven, YarnPlace,
    Yarns,
};

/// How near yarns come to one another.
#[derive(Debug, Serialize)]
pub(crate) struct ClearanceReport {
    /// The least ratio of all contacts, 1 where yarns just touch; null where none comes within 1.1.
    pub(crate) min: f64,
    pub(crate) contacts: u64,
    pub(crate) below_one: u64,
    pub(crate) worst: Vec<ContactReport>,
    histogram: Histogram,
}

/// How many contacts have a ratio from 0 on, in bins of this width.
#[derive(Debug, Serialize)]
struct Histogram {
    bin: f64,
    counts: Vec<u64>,
}

/// Two yarns that come near one another.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct ContactReport {
    pub(crate) ratio: f64,
    pub(crate) yarns: [String; 2],
    /// Half way between the two centrelines, mm.
    pub(crate) place_mm: [f64; 3],
    /// The crossing next to which each of the two lies; null at a yarn's end and in a turn of the weft.
    pub(crate) crossings: [Option<Crossing>; 2],
}

/// The tightest bend: radius of curvature over how far the section reaches into the bend.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct CurvatureReport {
    /// Null where all yarns are straight.
    pub(crate) min: f64,
    pub(crate) yarn: Option<String>,
    pub(crate) place_mm: Option<[f64; 3]>,
    pub(crate) crossing: Option<Crossing>,
}

/// A crossing, its threads counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub(crate) struct Crossing {
    pub(crate) end: usize,
    pub(crate) pick: usize,
}

/// A cloth and its yarns, to name places by.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Names<'a> {
    pub(crate) cloth: &'a Woven,
    pub(crate) yarns: &'a Yarns,
}

impl Names<'_> {
    pub(crate) fn clearance(&self, found: &Clearance) -> ClearanceReport {
        ClearanceReport {
            min: found.min,
            contacts: found.contacts,
            below_one: found.below_one,
            worst: found.worst.iter().map(|contact| self.contact(contact)).collect(),
            histogram: Histogram { bin: CLEARANCE_BIN, counts: found.histogram.clone() },
        }
    }

    fn contact(&self, contact: &Contact) -> ContactReport {
        let [one, other] = contact.places.map(|place| place.position);
        ContactReport {
            ratio: contact.ratio,
            yarns: contact.places.map(|place| self.thread(&place).to_string()),
            place_mm: std::array::from_fn(|axis| f64::midpoint(one[axis], other[axis])),
            crossings: contact.places.map(|place| self.crossing(&place)),
        }
    }

    pub(crate) fn curvature(&self, found: &Clearance) -> CurvatureReport {
        let at = found.curvature_at.as_ref();
        CurvatureReport {
            min: found.curvature_min,
            yarn: at.map(|place| self.thread(place).to_string()),
            place_mm: at.map(|place| place.position),
            crossing: at.and_then(|place| self.crossing(place)),
        }
    }

    fn crossing(&self, place: &YarnPlace) -> Option<Crossing> {
        let number = place.source.filter(|source| *source != NO_CROSSING)? as usize;
        let ends = self.cloth.warp().len();
        Some(Crossing { end: number % ends + 1, pick: number / ends + 1 })
    }

    /// The thread that a yarn is at a place: a weft that turns round is many picks.
    fn thread(&self, place: &YarnPlace) -> Origin {
        let origin = self.yarns.layout().yarns()[place.yarn].origin;
        match (origin, self.crossing(place)) {
            (Origin::Pick(_), Some(crossing)) => Origin::Pick(crossing.pick as u32),
            (Origin::Pick(_), None) if self.cloth.selvedge() => Origin::Pick(self.pick_at(place.position[1])),
            _ => origin,
        }
    }

    /// The pick nearest to height `y` of the cloth, mm.
    fn pick_at(&self, y: f64) -> u32 {
        let distances = middles(self.cloth.weft()).map(|middle| (middle - y).abs());
        (1..).zip(distances).min_by(|a, b| a.1.total_cmp(&b.1)).map_or(1, |(pick, _)| pick)
    }
}

/// The middles of threads, mm from the cloth's edge: the first lies half its spacing in, each further one its own spacing
/// from the one before.
pub(crate) fn middles(threads: &[Thread]) -> impl Iterator<Item = f64> {
    let mut at = -threads.first().map_or(0.0, |first| first.spacing_mm / 2.0);
    threads.iter().map(move |thread| {
        at += thread.spacing_mm;
        at
    })
}

impl fmt::Display for ClearanceReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(worst) = self.worst.first() else { return write!(f, "no yarns come near one another") };
        let [one, other] = &worst.yarns;
        let at = place(worst.place_mm);
        write!(f, "{:.4} of touching at the least: {one} and {other} at {at}; ", self.min)?;
        write!(f, "{} of {} contacts below {}", self.below_one, self.contacts, 1.0 - CLEARANCE_ACCURACY)
    }
}

impl fmt::Display for CurvatureReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Some(yarn), Some(at)) = (&self.yarn, self.place_mm) else {
            return write!(f, "all yarns are straight");
        };
        write!(f, "{:.3} yarn radii at the tightest: {yarn} at {}", self.min, place(at))
    }
}

/// `x 3.250, y 1.000, z -0.125 mm`
pub(crate) fn place([x, y, z]: [f64; 3]) -> String {
    format!("x {x:.3}, y {y:.3}, z {z:.3} mm")
}
