//! Clearance and bends, with the names of their places. In woven cloth a place is named by thread
//! and crossing, as weavers do. In a knit, [`Structure::place`](crate::Structure::place) names a
//! place by thread and stitch, but places of the clearance are named by thread alone.

use std::fmt;
use std::ops::ControlFlow;

use texere_contact::{Contact, Crowd, clearance_with_progress, drawn};
use texere_core::{Origin, Settings, YarnPlace, Yarns};

use crate::{FabricError, NO_CROSSING, Woven};

/// A crossing of a woven cloth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Crossing {
    /// The end, counted from 1.
    pub end: u32,
    /// The pick, counted from 1.
    pub pick: u32,
}

/// A stitch of a knit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct StitchPlace {
    /// The wale, counted from 1 at the left.
    pub wale: u32,
    /// The course, counted from 1 at the bottom.
    pub course: u32,
}

/// A place on a thread. It displays as `end 12 at pick 7`, as `carrier 1, wale 3, course 5`, as
/// `wale 3, course 5`, or as the thread alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThreadPlace {
    /// The number of the yarn among all yarns, counted from 0.
    pub yarn: usize,
    /// The thread. If the weft turns at selvedges, one yarn makes many picks, and the thread is the
    /// pick.
    pub thread: Origin,
    /// The point of the centreline, mm.
    pub position_mm: [f64; 3],
    /// The nearest crossing. `None` at a yarn's end, in a turn of the weft, and in a knit.
    pub crossing: Option<Crossing>,
    /// The stitch of a knit that the yarn makes at this place, counted in the whole cloth. `None`
    /// if the yarn floats, and in cloth that is not knitted.
    pub stitch: Option<StitchPlace>,
}

impl fmt::Display for ThreadPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.thread, self.crossing, self.stitch) {
            (thread @ Origin::End(_), Some(crossing), _) => write!(f, "{thread} at pick {}", crossing.pick),
            (thread @ Origin::Pick(_), Some(crossing), _) => write!(f, "{thread} at end {}", crossing.end),
            // `Origin::Course` of a copied yarn counts courses within the repeat, and is left out.
            (Origin::Course(_), _, Some(stitch)) => {
                write!(f, "wale {}, course {}", stitch.wale, stitch.course)
            }
            (_, _, Some(stitch)) => {
                write!(f, "{}, wale {}, course {}", self.thread_name(), stitch.wale, stitch.course)
            }
            _ => f.write_str(&self.thread_name()),
        }
    }
}

/// Two threads that come near one another: a [`Contact`] with the names of its threads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThreadContact {
    /// The [`Contact::ratio`]: 1 if both just touch, less if they pierce.
    pub ratio: f64,
    /// The place on each of the two threads.
    pub places: [ThreadPlace; 2],
}

impl ThreadContact {
    /// The point half way between the two centrelines, mm.
    #[must_use]
    pub fn middle_mm(&self) -> [f64; 3] {
        let [one, other] = self.places.map(|place| place.position_mm);
        std::array::from_fn(|axis| f64::midpoint(one[axis], other[axis]))
    }
}

/// A place with too much yarn for contacts to be measured pair by pair: a [`Crowd`] with the name
/// of its thickest thread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThreadCrowd {
    /// A place on the thickest thread of the crowd.
    pub place: ThreadPlace,
    /// The diameter of the thickest thread, or the larger of its width and its height, mm.
    pub thickness_mm: f64,
    /// Distance from the thickest thread to the thread before it, or from the first thread to the
    /// second, mm. `None` in a knit.
    pub pitch_mm: Option<f64>,
    /// Number of control intervals in the crowd.
    pub intervals: usize,
    /// Volume of the crowd's yarns over the room that they have: see [`Crowd::fill`].
    pub fill: f64,
}

/// The tightest bend of a cloth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThreadBend {
    /// Radius of curvature, over the distance by which the section reaches into the bend: see
    /// [`Clearance::curvature_min`](texere_contact::Clearance::curvature_min). Infinite if all
    /// threads are straight.
    pub radii: f64,
    /// The place of the tightest bend. `None` if all threads are straight.
    pub place: Option<ThreadPlace>,
}

/// Faults of a cloth's mesh, with places: see [`Drawn`](texere_contact::Drawn).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThreadDrawn {
    /// See [`Drawn::width`](texere_contact::Drawn::width).
    pub width: f64,
    /// The place of the least width.
    pub width_at: Option<ThreadPlace>,
    /// See [`Drawn::inwards`](texere_contact::Drawn::inwards).
    pub inwards: u64,
    /// The place of the first triangle that faces inwards.
    pub inwards_at: Option<ThreadPlace>,
}

/// [`Clearance`](texere_contact::Clearance), with places named by thread, and in woven cloth by
/// crossing, too. It also has the faults of the mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct ClothClearance {
    /// See [`Clearance::min`](texere_contact::Clearance::min).
    pub min: f64,
    /// See [`Clearance::contacts`](texere_contact::Clearance::contacts).
    pub contacts: u64,
    /// See [`Clearance::below_one`](texere_contact::Clearance::below_one).
    pub below_one: u64,
    /// See [`Clearance::piercing`](texere_contact::Clearance::piercing).
    pub piercing: u64,
    /// See [`Clearance::worst`](texere_contact::Clearance::worst).
    pub worst: Vec<ThreadContact>,
    /// See [`Clearance::histogram`](texere_contact::Clearance::histogram).
    pub histogram: Vec<u64>,
    /// See [`Clearance::crowd`](texere_contact::Clearance::crowd).
    pub crowd: Option<ThreadCrowd>,
    /// The tightest bend.
    pub bend: ThreadBend,
    /// Faults of a mesh with the settings of the measurement.
    pub drawn: ThreadDrawn,
}

impl Woven {
    /// Measures how near the cloth's threads come to one another and how tightly they bend, and
    /// looks for faults of their mesh. `yarns` are the yarns of this cloth, and are measured as
    /// drawn with `settings`. `progress` gets the share that is done, as in
    /// [`clearance_with_progress`].
    ///
    /// **Errors**: the errors of [`clearance_with_progress`] and of [`drawn()`].
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use texere_core::{Material, Origin, Section, Settings};
    /// use texere_fabric::{Thread, Weave, Woven};
    /// let plain = Weave::parse("plain")?.drawdown(8, 6)?;
    /// let (warp, weft) = (vec![Thread::new(0.5, 0.15); 8], vec![Thread::new(0.5, 0.15); 6]);
    /// let cloth = Woven::new(plain, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// let clearance = cloth.clearance(&cloth.yarns()?, &Settings::default(), |_| ControlFlow::Continue(()))?;
    /// let [one, other] = clearance.worst[0].places;
    /// assert!(matches!((one.thread, other.thread), (Origin::End(_), Origin::Pick(_))));
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    pub fn clearance(
        &self,
        yarns: &Yarns,
        settings: &Settings,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<ClothClearance, FabricError> {
        Names { cloth: Some(self), yarns }.clearance(settings, progress)
    }

    /// A place on one of the cloth's `yarns`, named by thread and crossing.
    ///
    /// **Panics** for a place on a yarn past the last one.
    #[must_use]
    pub fn place(&self, yarns: &Yarns, place: &YarnPlace) -> ThreadPlace {
        Names { cloth: Some(self), yarns }.place(place)
    }
}

impl ThreadPlace {
    /// The thread in a designer's words: `end 12`. A yarn of no structure has its number, counted
    /// from 1: `yarn 3`.
    #[must_use]
    pub fn thread_name(&self) -> String {
        match self.thread {
            Origin::Unknown => format!("{} {}", self.thread, self.yarn + 1),
            thread => thread.to_string(),
        }
    }

    /// A place on one of `yarns`, named by the yarn alone.
    pub(crate) fn on(yarns: &Yarns, place: &YarnPlace) -> Self {
        Names { cloth: None, yarns }.place(place)
    }
}

impl ClothClearance {
    /// The least clearance. It is infinite if no yarns come near one another, and NaN if all places
    /// where they do are crowded, since crowded places are not measured.
    #[must_use]
    pub const fn least(&self) -> f64 {
        if self.crowd.is_some() && self.min.is_infinite() { f64::NAN } else { self.min }
    }

    /// Measures the clearance of `yarns`. Places are named by the yarn alone.
    pub(crate) fn of(
        yarns: &Yarns,
        settings: &Settings,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Self, FabricError> {
        Names { cloth: None, yarns }.clearance(settings, progress)
    }
}

/// Yarns, and the cloth that they are woven into, by which places are named.
struct Names<'a> {
    cloth: Option<&'a Woven>,
    yarns: &'a Yarns,
}

impl Names<'_> {
    fn clearance(
        &self,
        settings: &Settings,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<ClothClearance, FabricError> {
        let found = clearance_with_progress(self.yarns, settings, progress)?;
        let drawn = drawn(self.yarns, settings)?;
        Ok(ClothClearance {
            min: found.min,
            contacts: found.contacts,
            below_one: found.below_one,
            piercing: found.piercing,
            worst: found.worst.iter().map(|contact| self.contact(contact)).collect(),
            crowd: found.crowd.as_ref().map(|crowd| self.crowd(crowd)),
            bend: ThreadBend {
                radii: found.curvature_min,
                place: found.curvature_at.as_ref().map(|place| self.place(place)),
            },
            drawn: ThreadDrawn {
                width: drawn.width,
                width_at: drawn.width_at.map(|place| self.place(&place)),
                inwards: drawn.inwards,
                inwards_at: drawn.inwards_at.map(|place| self.place(&place)),
            },
            histogram: found.histogram,
        })
    }

    fn contact(&self, contact: &Contact) -> ThreadContact {
        ThreadContact { ratio: contact.ratio, places: contact.places.map(|place| self.place(&place)) }
    }

    fn crowd(&self, crowd: &Crowd) -> ThreadCrowd {
        let place = self.place(&crowd.place);
        ThreadCrowd {
            place,
            thickness_mm: crowd.thickness_mm,
            pitch_mm: self.cloth.and_then(|cloth| cloth.pitch_mm(place.thread)),
            intervals: crowd.intervals,
            fill: crowd.fill,
        }
    }

    fn place(&self, place: &YarnPlace) -> ThreadPlace {
        let crossing = self.crossing(place);
        let thread = self.thread(place, crossing);
        ThreadPlace { yarn: place.yarn, thread, position_mm: place.position, crossing, stitch: None }
    }

    fn crossing(&self, place: &YarnPlace) -> Option<Crossing> {
        let number = place.source.filter(|source| *source != NO_CROSSING)?;
        let ends = self.cloth?.warp().len() as u32;
        Some(Crossing { end: number % ends + 1, pick: number / ends + 1 })
    }

    /// The thread at a place. A weft that turns at selvedges is one yarn of many picks.
    fn thread(&self, place: &YarnPlace, crossing: Option<Crossing>) -> Origin {
        let origin = self.yarns.layout().yarns()[place.yarn].origin;
        match (origin, crossing, self.cloth) {
            (Origin::Pick(_), Some(crossing), _) => Origin::Pick(crossing.pick),
            (Origin::Pick(_), None, Some(cloth)) if cloth.selvedge() => {
                Origin::Pick(pick_at(cloth, place.position[1]))
            }
            _ => origin,
        }
    }
}

/// The pick of `cloth` that lies nearest to the coordinate `y`, mm.
fn pick_at(cloth: &Woven, y: f64) -> u32 {
    let middles = cloth.middles_mm().weft;
    let distances = middles.into_iter().map(|middle| (middle - y).abs());
    (1..).zip(distances).min_by(|a, b| a.1.total_cmp(&b.1)).map_or(1, |(pick, _)| pick)
}
