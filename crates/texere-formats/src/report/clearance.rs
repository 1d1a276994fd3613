//! The report of clearance and bends.

use std::fmt;

use serde::{Serialize, Serializer};
use texere_contact::{CLEAR, CLEARANCE_BESIDE, CLEARANCE_BIN, CLEARANCE_NEAR};
use texere_core::counted;
use texere_fabric::{ClothClearance, ThreadBend, ThreadContact, ThreadCrowd, ThreadDrawn, ThreadPlace};

/// How near yarns come to one another.
#[derive(Debug, Serialize)]
pub(crate) struct ClearanceReport {
    /// The least ratio of all contacts, 1 if yarns just touch. It is an upper bound if some places
    /// are crowded, and null if all are.
    #[serde(serialize_with = "as_near_as_looked")]
    min: f64,
    contacts: u64,
    below_one: u64,
    piercing: u64,
    pub(crate) worst: Vec<ContactReport>,
    histogram: Histogram,
    pub(crate) crowd: Option<CrowdReport>,
    pub(crate) drawn: DrawnReport,
}

/// How a mesh is drawn between neighbouring rings.
#[derive(Debug, Serialize)]
pub(crate) struct DrawnReport {
    /// The least width of a tube half way between two rings, as a share of its width on them.
    pub(crate) width: f64,
    width_at: Option<DrawnPlace>,
    /// Triangles that face inwards.
    pub(crate) inwards: u64,
    inwards_at: Option<DrawnPlace>,
}

/// A place of a mesh.
#[derive(Debug, Serialize)]
struct DrawnPlace {
    yarn: String,
    place_mm: [f64; 3],
    crossing: Option<Crossing>,
}

/// A crowded place: yarns that overlap many times over, or too many control intervals together. It
/// is not measured pair by pair.
#[derive(Debug, Serialize)]
pub(crate) struct CrowdReport {
    /// The volume of the yarns over the room that they have.
    fill: f64,
    /// Number of control intervals at the place.
    intervals: usize,
    /// The thickest thread at the place.
    yarn: String,
    thickness_mm: f64,
    /// The distance of that thread from the thread before it, or of the first thread from the
    /// second.
    pitch_mm: Option<f64>,
    place_mm: [f64; 3],
    crossing: Option<Crossing>,
}

/// Numbers of contacts by ratio, in bins of width `bin`, of which the first begins at 0.
#[derive(Debug, Serialize)]
struct Histogram {
    bin: f64,
    counts: Vec<u64>,
}

/// Two yarns that come near one another.
#[derive(Debug, Serialize)]
pub(crate) struct ContactReport {
    pub(crate) ratio: f64,
    pub(crate) yarns: [String; 2],
    /// Half way between the two centrelines, mm.
    pub(crate) place_mm: [f64; 3],
    /// The crossing next to which each of the two yarns lies. Null in knits, at a yarn's end, and
    /// in a turn of the weft.
    crossings: [Option<Crossing>; 2],
}

/// The tightest bend: radius of curvature over how far the section reaches into the bend.
#[derive(Debug, Serialize)]
pub(crate) struct CurvatureReport {
    /// Null if all yarns are straight.
    pub(crate) min: f64,
    yarn: Option<String>,
    place_mm: Option<[f64; 3]>,
    crossing: Option<Crossing>,
}

/// A crossing, its threads counted from 1.
#[derive(Debug, Serialize)]
struct Crossing {
    end: u32,
    pick: u32,
}

impl Crossing {
    fn of(place: &ThreadPlace) -> Option<Self> {
        place.crossing.map(|texere_fabric::Crossing { end, pick }| Self { end, pick })
    }
}

/// Writes a least clearance to JSON. If there is no contact, `least` is infinite, and the limit of
/// the search is written.
pub(crate) fn as_near_as_looked<S: Serializer>(least: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(if *least == f64::INFINITY { CLEARANCE_NEAR } else { *least })
}

impl From<&ClothClearance> for ClearanceReport {
    fn from(found: &ClothClearance) -> Self {
        Self {
            min: found.least(),
            contacts: found.contacts,
            below_one: found.below_one,
            piercing: found.piercing,
            worst: found.worst.iter().map(ContactReport::from).collect(),
            histogram: Histogram { bin: CLEARANCE_BIN, counts: found.histogram.clone() },
            crowd: found.crowd.as_ref().map(CrowdReport::from),
            drawn: DrawnReport::from(&found.drawn),
        }
    }
}

impl From<&ThreadDrawn> for DrawnReport {
    fn from(drawn: &ThreadDrawn) -> Self {
        let at = |place: Option<ThreadPlace>| {
            place.map(|place| DrawnPlace {
                yarn: place.thread_name(),
                place_mm: place.position_mm,
                crossing: Crossing::of(&place),
            })
        };
        let ThreadDrawn { width, inwards, .. } = *drawn;
        Self { width, width_at: at(drawn.width_at), inwards, inwards_at: at(drawn.inwards_at) }
    }
}

impl From<&ThreadCrowd> for CrowdReport {
    fn from(crowd: &ThreadCrowd) -> Self {
        Self {
            fill: crowd.fill,
            intervals: crowd.intervals,
            yarn: crowd.place.thread_name(),
            thickness_mm: crowd.thickness_mm,
            pitch_mm: crowd.pitch_mm,
            place_mm: crowd.place.position_mm,
            crossing: Crossing::of(&crowd.place),
        }
    }
}

impl From<&ThreadContact> for ContactReport {
    fn from(contact: &ThreadContact) -> Self {
        Self {
            ratio: contact.ratio,
            yarns: contact.places.map(|place| place.thread_name()),
            place_mm: contact.middle_mm(),
            crossings: contact.places.map(|place| Crossing::of(&place)),
        }
    }
}

impl From<&ThreadBend> for CurvatureReport {
    fn from(bend: &ThreadBend) -> Self {
        let place = bend.place.as_ref();
        Self {
            min: bend.radii,
            yarn: place.map(ThreadPlace::thread_name),
            place_mm: place.map(|place| place.position_mm),
            crossing: place.and_then(Crossing::of),
        }
    }
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
        write!(f, "{} of {} below {CLEAR}", self.piercing, counted(self.contacts, "contact"))?;
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

impl DrawnReport {
    /// The least width of the tube and its place:
    /// `0.149 of the rings' width half way between two rings: course 3 at x 3, y 1, z 0 mm`.
    pub(crate) fn narrowest(&self) -> String {
        let width = format!("{:.3} of the rings' width half way between two rings", self.width);
        self.width_at.as_ref().map_or(width.clone(), |at| format!("{width}: {at}"))
    }

    /// The number of triangles that face inwards, and the place of the first.
    pub(crate) fn turned(&self) -> String {
        let face = if self.inwards == 1 { "faces" } else { "face" };
        let count = format!("{} {face} inwards", counted(self.inwards, "triangle"));
        self.inwards_at.as_ref().map_or(count.clone(), |at| format!("{count}, the first on {at}"))
    }
}

impl fmt::Display for DrawnPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at {}", self.yarn, place(self.place_mm))
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

#[cfg(test)]
mod tests {
    use serde_json::{Value, json, to_value};
    use texere_core::Origin;

    use super::*;

    /// The `min` in the JSON of a cloth whose least clearance is `min`, with a crowded place or
    /// without.
    fn min(min: f64, crowd: Option<ThreadCrowd>) -> Value {
        let found = ClothClearance {
            min,
            contacts: 0,
            below_one: 0,
            piercing: 0,
            worst: Vec::new(),
            histogram: vec![0; 110],
            crowd,
            bend: ThreadBend { radii: f64::INFINITY, place: None },
            drawn: ThreadDrawn { width: 1.0, width_at: None, inwards: 0, inwards_at: None },
        };
        to_value(ClearanceReport::from(&found)).unwrap()["min"].clone()
    }

    #[test]
    fn cloth_whose_yarns_do_not_meet_is_as_clear_as_is_looked() {
        assert_eq!(min(f64::INFINITY, None), json!(CLEARANCE_NEAR));
        assert_eq!(min(0.5, None), json!(0.5));
        let place = ThreadPlace {
            yarn: 0,
            thread: Origin::End(1),
            position_mm: [0.0; 3],
            crossing: None,
            stitch: None,
        };
        let crowd = ThreadCrowd { place, thickness_mm: 1.0, pitch_mm: None, intervals: 2000, fill: 0.5 };
        assert_eq!(min(f64::INFINITY, Some(crowd)), Value::Null);
        assert_eq!(min(0.7, Some(crowd)), json!(0.7));
    }
}
