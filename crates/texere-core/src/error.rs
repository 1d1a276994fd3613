//! Errors: one enum for each boundary.

use crate::{OutOfMemory, counted};
use thiserror::Error;

/// A section with invalid parameters.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SectionError {
    /// A number outside its limits, or not a number.
    #[error("{field} is {value}, outside {low} to {high}")]
    OutOfRange {
        /// Which number.
        field: &'static str,
        /// What it is.
        value: f32,
        /// Least allowed.
        low: f32,
        /// Most allowed.
        high: f32,
    },
    /// A polygon with too few or too many corners.
    #[error("polygon has {corners}, outside {low} to {high}", corners = counted(*.corners, "corner"))]
    Corners {
        /// How many it has.
        corners: usize,
        /// Least allowed.
        low: u32,
        /// Most allowed.
        high: u32,
    },
    /// Two neighbouring corners coincide.
    #[error("corners {corner} and the next of the polygon coincide")]
    RepeatedCorner {
        /// The first of the two, from 0.
        corner: usize,
    },
    /// The outline crosses, touches or folds onto itself.
    #[error("edges {first} and {second} of the polygon meet")]
    SelfIntersecting {
        /// One edge, from 0.
        first: usize,
        /// The other.
        second: usize,
    },
    /// The corners run clockwise: the tube would be inside out. Reverse them.
    #[error("polygon runs clockwise; give its corners counter-clockwise")]
    Clockwise,
}

/// Invalid yarns. Yarns and points are counted from 0, as in the slices they came from.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum YarnError {
    /// There is no yarn at all.
    #[error("no yarns")]
    NoYarns,
    /// Offsets must be one more than yarns.
    #[error("{offsets} for {yarns}, which need one more than yarns", offsets = counted(*.offsets, "offset"), yarns = counted(*.yarns, "yarn"))]
    OffsetCount {
        /// Offsets given.
        offsets: usize,
        /// Yarns given.
        yarns: usize,
    },
    /// Offsets must start at 0 and never fall.
    #[error("offsets of yarn {yarn} run from {start} to {end}")]
    OffsetOrder {
        /// The yarn.
        yarn: usize,
        /// Its first offset.
        start: u64,
        /// Its second offset.
        end: u64,
    },
    /// An open yarn needs two control points, a closed one three.
    #[error("yarn {yarn} has {points}, needs {least}{}", if *.closed { " since it is closed" } else { "" }, points = counted(*.points, "control point"))]
    TooFewPoints {
        /// The yarn.
        yarn: usize,
        /// Control points it has.
        points: u64,
        /// Control points it needs.
        least: u64,
        /// Whether it is closed.
        closed: bool,
    },
    /// The control points don't match the offsets.
    #[error("{points} where {planned} were planned", points = counted(*.points, "control point"))]
    PointCount {
        /// Given.
        points: u64,
        /// Planned.
        planned: u64,
    },
    /// Sources must be one per control point.
    #[error("{sources} for {points}", sources = counted(*.sources, "source"), points = counted(*.points, "control point"))]
    SourceCount {
        /// Given.
        sources: usize,
        /// Needed.
        points: usize,
    },
    /// Up directions must be one per control point.
    #[error("{ups} for {points}", ups = counted(*.ups, "up direction"), points = counted(*.points, "control point"))]
    UpCount {
        /// Given.
        ups: usize,
        /// Needed.
        points: usize,
    },
    /// An up direction must have one.
    #[error("the up direction of point {point} of yarn {yarn} is {up:?}, which points nowhere")]
    Up {
        /// The yarn, from 0.
        yarn: usize,
        /// The point of the yarn, from 0.
        point: usize,
        /// Given.
        up: [f32; 3],
    },
    /// There is no such yarn.
    #[error("no yarn {yarn}; there are {yarns}")]
    UnknownYarn {
        /// Asked for.
        yarn: usize,
        /// How many there are.
        yarns: usize,
    },
    /// A yarn refers to a material that is missing.
    #[error("yarn {yarn} is of material {material}, but there are {materials}")]
    UnknownMaterial {
        /// The yarn.
        yarn: usize,
        /// Its material.
        material: u32,
        /// How many there are.
        materials: usize,
    },
    /// A yarn refers to a section that is missing.
    #[error("yarn {yarn} has section {section}, but there are {sections}")]
    UnknownSection {
        /// The yarn.
        yarn: usize,
        /// Its section.
        section: u32,
        /// How many there are.
        sections: usize,
    },
    /// A section with invalid parameters.
    #[error("section {section} is not sound")]
    Section {
        /// Which one.
        section: usize,
        /// Why.
        source: SectionError,
    },
    /// A twist that is not finite or too steep.
    #[error("yarn {yarn} has a twist of {twist} rad/mm, beyond ±{limit}")]
    Twist {
        /// The yarn.
        yarn: usize,
        /// Its twist, rad/mm.
        twist: f32,
        /// The steepest taken.
        limit: f32,
    },
    /// A hairiness that is not a number, below 0 or beyond what is taken.
    #[error("material {material} has a hairiness of {hairiness}, which is not between 0 and {limit}")]
    Hairiness {
        /// The material.
        material: usize,
        /// Its hairiness, Uster's H.
        hairiness: f32,
        /// The most taken.
        limit: f32,
    },
    /// A control point with NaN or infinity in it.
    #[error("{field} of point {point} of yarn {yarn} is {value}")]
    NotFinite {
        /// The yarn.
        yarn: usize,
        /// The point.
        point: usize,
        /// Which component.
        field: &'static str,
        /// Its value.
        value: f32,
    },
    /// A control point too far from the origin.
    #[error("{field} of point {point} of yarn {yarn} is {value} mm, beyond ±{limit} mm")]
    TooFar {
        /// The yarn.
        yarn: usize,
        /// The point.
        point: usize,
        /// Which component.
        field: &'static str,
        /// Its value, mm.
        value: f32,
        /// The furthest taken, mm.
        limit: f32,
    },
    /// A half width or half height that is zero, negative, or no yarn's.
    #[error("{field} of point {point} of yarn {yarn} is {size} mm, outside {low} to {high} mm")]
    Size {
        /// The yarn.
        yarn: usize,
        /// The point.
        point: usize,
        /// Which of the two.
        field: &'static str,
        /// What it is, mm; infinite for more than a half float holds.
        size: f32,
        /// Thinnest taken, mm.
        low: f32,
        /// Thickest taken, mm.
        high: f32,
    },
}

/// A boundary that is not one of these yarns. Yarns are counted from 0.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum BoundaryError {
    /// A repeat that is negative, too long, or not a number.
    #[error("the repeat along {axis} is {length} mm, outside 0 to {limit} mm")]
    Repeat {
        /// `x` or `y`.
        axis: char,
        /// Its length, mm.
        length: f32,
        /// The longest taken, mm.
        limit: f32,
    },
    /// Ends must be one per yarn.
    #[error("ends of {ends} where there are {yarns}", ends = counted(*.ends, "yarn"))]
    EndsCount {
        /// Given.
        ends: usize,
        /// Needed.
        yarns: usize,
    },
    /// A closed yarn must be closed here too, and no other.
    #[error("yarn {yarn} is {}closed, unlike its ends", if *.closed { "" } else { "not " })]
    Closed {
        /// The yarn.
        yarn: usize,
        /// Whether its layout says that it is closed.
        closed: bool,
    },
    /// A yarn goes on along an axis that has no period.
    #[error("yarn {yarn} goes on along {axis}, where there is no repeat")]
    NoRepeat {
        /// The yarn.
        yarn: usize,
        /// `x` or `y`.
        axis: char,
    },
    /// A yarn that repeats must go on by a repeat at least; one that ends where it began is closed.
    #[error("yarn {yarn} goes on by no repeat")]
    NoWayOn {
        /// The yarn.
        yarn: usize,
    },
}

/// Settings that can't be planned for, or a plan that does not fit.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// Tension must lie in [0, 1).
    #[error("tension is {tension}, outside 0 to below 1")]
    Tension {
        /// Given.
        tension: f32,
    },
    /// Too many inserted points.
    #[error("{subdivisions}, more than {limit}", subdivisions = counted(*.subdivisions, "subdivision"))]
    Subdivisions {
        /// Given.
        subdivisions: u32,
        /// Most allowed.
        limit: u32,
    },
    /// Too few or too many sides.
    #[error("{sides}, outside {low} to {high}", sides = counted(*.sides, "side"))]
    Sides {
        /// Given.
        sides: u32,
        /// Least allowed.
        low: u32,
        /// Most allowed.
        high: u32,
    },
    /// A polygon section needs as many sides as it has corners.
    #[error(
        "section {section} is a polygon of {corners}, but tubes have {sides}; set sides to {}", .corners, corners = counted(*.corners, "corner"), sides = counted(*.sides, "side"))]
    PolygonSides {
        /// The section.
        section: usize,
        /// Its corners.
        corners: usize,
        /// The plan's sides.
        sides: u32,
    },
    /// One yarn has more rings than a `u32` counts.
    #[error("yarn {yarn} has {rings}, more than {limit}", rings = counted(*.rings, "ring"))]
    YarnRings {
        /// The yarn, from 0.
        yarn: usize,
        /// Its rings.
        rings: u64,
        /// Most allowed.
        limit: u64,
    },
    /// All yarns together have more rings than any machine holds.
    #[error("{rings}, more than {limit}", rings = counted(*.rings, "ring"))]
    Rings {
        /// All rings.
        rings: u64,
        /// Most allowed.
        limit: u64,
    },
    /// A yarn is to have more control points than the plan has room for.
    #[error("yarn {yarn} of {points}, but the plan has room for {room}", points = counted(*.points, "control point"))]
    NoRoom {
        /// The yarn, from 0.
        yarn: usize,
        /// Its control points.
        points: u64,
        /// Most that it may have.
        room: u64,
    },
    /// A yarn is to have too few control points.
    #[error("yarn {yarn} of {points}, fewer than {least}", points = counted(*.points, "control point"))]
    TooFewPoints {
        /// The yarn, from 0.
        yarn: usize,
        /// Its control points.
        points: u64,
        /// Least allowed.
        least: u64,
    },
    /// A yarn is to become what takes a new plan.
    #[error("yarn {yarn} can't be {what}: that takes a new plan")]
    OtherPlan {
        /// The yarn, from 0.
        yarn: usize,
        /// What it would be.
        what: &'static str,
    },
    /// Not even one block fits the limits of memory.
    #[error("one block of {rings} needs {needed} for {what}, but the limit is {limit}", rings = counted(*.rings, "ring"), needed = counted(*.needed, "byte"), limit = counted(*.limit, "byte"))]
    BlockTooLarge {
        /// Rings in the block.
        rings: u32,
        /// For which buffer.
        what: &'static str,
        /// Bytes that it needs.
        needed: u64,
        /// Bytes allowed.
        limit: u64,
    },
    /// Not even one block fits what a launch may count: see [`Limits::blocks`](crate::Limits::blocks).
    #[error("one block of {rings} takes {needed} {what}, but the limit is {limit}", rings = counted(*.rings, "ring"))]
    BlockOverCount {
        /// Rings in the block.
        rings: u32,
        /// What is counted: blocks, vertices or indices.
        what: &'static str,
        /// How many it takes.
        needed: u64,
        /// How many are allowed.
        limit: u64,
    },
}

/// A failure of a backend. Whatever the core can check beforehand is not among these.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BackendError {
    /// No device answers to the name.
    #[error("no device \"{wanted}\"; there are: {}", if .found.is_empty() { "none".into() } else { .found.join(", ") })]
    NoDevice {
        /// The name asked for.
        wanted: String,
        /// Names that would have worked.
        found: Vec<String>,
    },
    /// The name is that of a device which this build of texere can't open.
    #[error("no device \"{wanted}\" in this build; texere opens it with its feature \"{feature}\"")]
    NoFeature {
        /// The name asked for.
        wanted: String,
        /// The feature of the crate `texere`.
        feature: &'static str,
    },
    /// An environment variable names vector instructions that the processor does not have, or that texere does not know.
    #[error("{variable} is \"{wanted}\"; this processor has: {}", .found.join(", "))]
    NoInstructionSet {
        /// The variable.
        variable: &'static str,
        /// What it says.
        wanted: String,
        /// Names that would have worked.
        found: Vec<&'static str>,
    },
    /// The device, or its schedule, makes no attributes.
    #[error("no attributes are made on this device, or not in its schedule")]
    NoAttributes,
    /// The device, or its schedule, packs no vertices.
    #[error("no vertices are packed on this device, or not in its schedule")]
    NoPacking,
    /// The device, or its schedule, can't make a mesh that is edited.
    #[error("yarns can't be edited on this device, or not in its schedule")]
    NoEditing,
    /// The backend can't settle yarns.
    #[error("{name} can't settle yarns")]
    NoSettling {
        /// The backend's name.
        name: String,
    },
    /// The backend can't settle crossings.
    #[error("{name} can't settle crossings of woven cloth")]
    NoCrossings {
        /// The backend's name.
        name: String,
    },
    /// Memory could not be had.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    /// Yarns that lie so thick over one another that a settling would have to look at too many pairs of them.
    #[error(
        "more than {limit} pairs of neighbours among {chords}: too many yarns lie in one place to settle", chords = counted(*.chords, "chord"))]
    Crowded {
        /// Chords of all yarns.
        chords: u64,
        /// Pairs that are listed at most for so many.
        limit: u64,
    },
    /// The device is lost, and the session with it. A new session on a healthy device works.
    #[error("device {device} is lost")]
    DeviceLost {
        /// Its name.
        device: String,
        /// What the driver said.
        source: Option<Box<dyn std::error::Error + Send + Sync>>,
    },
    /// The backend or its schedule does not do this.
    #[error("{schedule} does not do {what}")]
    Unsupported {
        /// Backend and schedule.
        schedule: String,
        /// What was asked for.
        what: String,
    },
    /// A kernel that the driver would not compile.
    #[error("kernel {kernel} does not compile:\n{log}")]
    Compile {
        /// The kernel.
        kernel: &'static str,
        /// The driver's whole log.
        log: String,
    },
    /// An engine was asked to work on a chunk that is not loaded, or belongs to another plan. A session never does this.
    #[error("chunk {chunk} is not loaded")]
    NotLoaded {
        /// The chunk's index.
        chunk: u64,
    },
    /// A driver call that failed.
    #[error("{call} failed")]
    Driver {
        /// The call.
        call: &'static str,
        /// What the driver said.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

/// A session's call that failed: misuse, reported alike on every backend, or a failure of the backend.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SessionError {
    /// A plan of only a [region](crate::Plan::within), of which nothing can be edited.
    #[error("a mesh that is edited is of the whole cloth, and the plan is of a region of it")]
    Region,
    /// A yarn that there is not.
    #[error("yarn {yarn}, but there are {yarns}, counted from 0")]
    NoYarn {
        /// The yarn.
        yarn: usize,
        /// How many there are.
        yarns: usize,
    },
    /// Control points that no yarn can have.
    #[error(transparent)]
    Yarns(#[from] YarnError),
    /// An upload past the last control point.
    #[error("upload of points {first} to {end}, but there are {points}")]
    UploadRange {
        /// First point.
        first: u64,
        /// One past the last.
        end: u64,
        /// How many there are.
        points: u64,
    },
    /// A stage was called before the one that it depends on.
    #[error("{call} was called before {needed}")]
    OutOfOrder {
        /// The call.
        call: &'static str,
        /// What has to come first.
        needed: &'static str,
    },
    /// A settler of other yarns than the session's: their numbers of control points differ.
    #[error("the settler's yarns have other numbers of control points than the session's")]
    OtherYarns,
    /// A chunk that is not of the session's plan.
    #[error("chunk {chunk} is of another plan than the session's")]
    ForeignChunk {
        /// The chunk's index.
        chunk: u64,
    },
    /// A chunk was read that no stage has run for, or whose memory has been reused since.
    #[error("chunk {chunk} is not in flight")]
    NotInFlight {
        /// The chunk's index.
        chunk: u64,
    },
    /// A chunk that there is not.
    #[error("chunk {chunk}, but there are {chunks}, counted from 0")]
    NoChunk {
        /// The chunk.
        chunk: usize,
        /// How many there are.
        chunks: usize,
    },
    /// An output slice that is not exactly as long as planned.
    #[error("{what} has room for {given}, but the chunk has {planned}")]
    OutputLength {
        /// Which slice.
        what: &'static str,
        /// Its length.
        given: u64,
        /// What the plan says.
        planned: u64,
    },
    /// The plan can't be made, or not even one block of it fits the device.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The backend failed.
    #[error(transparent)]
    Backend(#[from] BackendError),
}

impl From<OutOfMemory> for SessionError {
    fn from(error: OutOfMemory) -> Self {
        Self::Backend(error.into())
    }
}

/// What can end a run of the whole pipeline.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PipelineError {
    /// The settings can't be planned for.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The backend failed.
    #[error(transparent)]
    Backend(#[from] BackendError),
    /// A call of the session that the pipeline should not have made.
    #[error(transparent)]
    Session(SessionError),
    /// The progress callback asked to stop.
    #[error("cancelled")]
    Cancelled,
}

impl From<SessionError> for PipelineError {
    fn from(error: SessionError) -> Self {
        match error {
            SessionError::Backend(error) => Self::Backend(error),
            SessionError::Plan(error) => Self::Plan(error),
            misuse => Self::Session(misuse),
        }
    }
}

impl From<OutOfMemory> for PipelineError {
    fn from(error: OutOfMemory) -> Self {
        Self::Backend(error.into())
    }
}
