//! What is said of clearance and bends: the worst places, by the names that a weaver gives them.

use std::fmt;

use serde::Serialize;
use texere::{
    CLEARANCE_ACCURACY, CLEARANCE_BESIDE, CLEARANCE_BIN, Clearance, Contact, Crowd, NO_CROSSING, Origin,
    Thread, Woven, YarnPlace, Yarns,
};

/// How near yarns come to one another.
#[derive(Debug, Serialize)]
pub(crate) struct ClearanceReport {
    /// The least ratio of all contacts, 1 where yarns just touch; null where none comes within 1.1. Where it is crowded it is
    /// no more than this.
    pub(crate) min: f64,
    pub(crate) contacts: u64,
    pub(crate) below_one: u64,
    pub(crate) worst: Vec<ContactReport>,
    histogram: Histogram,
    pub(crate) crowd: Option<CrowdReport>,
}

/// Yarns that lie in one another many times over, or too many of them together: they are not measured pair by pair.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct CrowdReport {
    /// The volume of the yarns over the room that they have.
    fill: f64,
    /// Control intervals that lie there.
    intervals: usize,
    /// The thickest thread there.
    yarn: String,
    thickness_mm: f64,
    /// Its distance to the thread before.
    pitch_mm: Option<f64>,
    place_mm: [f64; 3],
    pub(crate) crossing: Option<Crossing>,
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
            crowd: found.crowd.as_ref().map(|crowd| self.crowd(crowd)),
        }
    }

    fn crowd(&self, crowd: &Crowd) -> CrowdReport {
        let thread = self.thread(&crowd.place);
        let spaced = match thread {
            Origin::End(number) => self.cloth.warp().get((number as usize).wrapping_sub(1)),
            Origin::Pick(number) => self.cloth.weft().get((number as usize).wrapping_sub(1)),
            _ => None,
        };
        CrowdReport {
            fill: crowd.fill,
            intervals: crowd.intervals,
            yarn: thread.to_string(),
            thickness_mm: crowd.thickness_mm,
            pitch_mm: spaced.map(|thread| thread.spacing_mm),
            place_mm: crowd.place.position,
            crossing: self.crossing(&crowd.place),
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
        let Some(worst) = self.worst.first() else {
            return match &self.crowd {
                None => write!(f, "no yarns come near one another"),
                Some(_) if self.min.is_finite() => write!(f, "{:.4} of touching at the most", self.min),
                Some(_) => write!(f, "not measured"),
            };
        };
        let [one, other] = &worst.yarns;
        let at = place(worst.place_mm);
        write!(f, "{:.4} of touching at the least: {one} and {other} at {at}; ", worst.ratio)?;
        write!(f, "{} of {} contacts below {}", self.below_one, self.contacts, 1.0 - CLEARANCE_ACCURACY)?;
        if self.crowd.is_some() { write!(f, " beside the crowd") } else { Ok(()) }
    }
}

impl fmt::Display for CrowdReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { fill, intervals, yarn, thickness_mm, .. } = self;
        if *fill > 1.0 {
            write!(f, "{fill:.1} times as much yarn as there is room for: ")?;
        } else {
            write!(f, "{intervals} parts of yarns lie together, with over {CLEARANCE_BESIDE} beside one: ")?;
        }
        write!(f, "{yarn} is {thickness_mm:.4} mm thick")?;
        if let Some(pitch) = self.pitch_mm {
            write!(f, " and {pitch:.4} mm from the one before")?;
        }
        write!(f, ", at {}", place(self.place_mm))
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
