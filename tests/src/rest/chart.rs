//! Charts of weft-knit stitches, and the loops that are drawn through one another.

/// The stitch of a needle in a course.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stitch {
    /// Knits on the front bed: draws a new loop to the face, through all loops on the needle.
    Face,
    /// Knits on the back bed: draws the new loop to the back.
    Back,
    /// Lays the yarn on the needle and keeps the needle's loops.
    Tuck,
    /// Does not catch the yarn, which floats past.
    Miss,
}

/// A repeat of stitches, with one yarn for each course.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chart {
    wales: usize,
    courses: usize,
    /// Stitches course by course, each with the needles by which its loop is moved to the right
    /// afterwards.
    cells: Vec<(Stitch, i64)>,
}

/// A loop on a needle, by the course and the wale in which it was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Hanging {
    course: i64,
    wale: i64,
}

/// What happens to a loop after it was made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fate {
    /// Number of wales by which the loop's head is moved to the right.
    pub(super) moved: i64,
    /// Number of courses in which the loop's needle does not knit.
    pub(super) held: i64,
    /// Whether the next loop is drawn through this one to the face (1) or to the back (-1).
    pub(super) side: f64,
    /// Number of loops on the same needle between this loop and the side to which the yarn is
    /// drawn.
    pub(super) layer: usize,
}

impl Chart {
    /// A chart from its courses, the first one first, with a letter for each wale from left to
    /// right. `k` knits to the face and `p` to the back, `t` tucks and `m` misses. `>` and `<` knit
    /// to the face and then move the loop to the next needle.
    ///
    /// # Panics
    ///
    /// Without courses, if courses differ in length, for other letters, and if a needle never
    /// knits.
    #[must_use]
    pub fn new<Course: AsRef<str>>(courses: &[Course]) -> Self {
        let cell = |letter| match letter {
            'k' => (Stitch::Face, 0),
            'p' => (Stitch::Back, 0),
            't' => (Stitch::Tuck, 0),
            'm' => (Stitch::Miss, 0),
            '>' => (Stitch::Face, 1),
            '<' => (Stitch::Face, -1),
            other => panic!("no stitch: {other}"),
        };
        let cells: Vec<_> = courses.iter().flat_map(|course| course.as_ref().chars().map(cell)).collect();
        let chart = Self { wales: cells.len() / courses.len(), courses: courses.len(), cells };
        assert!(
            courses.iter().all(|course| course.as_ref().len() == chart.wales),
            "courses differ in length"
        );
        for wale in 0..chart.wales as i64 {
            assert!((0..chart.courses as i64).any(|course| chart.knits(course, wale)), "{wale} never knits");
        }
        chart
    }

    /// Number of wales of the repeat.
    #[must_use]
    pub fn wales(&self) -> usize {
        self.wales
    }

    /// Number of courses of the repeat.
    #[must_use]
    pub fn courses(&self) -> usize {
        self.courses
    }

    fn cell(&self, course: i64, wale: i64) -> (Stitch, i64) {
        let course = course.rem_euclid(self.courses as i64) as usize;
        self.cells[course * self.wales + wale.rem_euclid(self.wales as i64) as usize]
    }

    /// The stitch of the needle of `wale` in `course`.
    pub(super) fn stitch(&self, course: i64, wale: i64) -> Stitch {
        self.cell(course, wale).0
    }

    fn knits(&self, course: i64, wale: i64) -> bool {
        matches!(self.stitch(course, wale), Stitch::Face | Stitch::Back)
    }

    /// The course after `course` in which the needle of `wale` next knits.
    fn next_knit(&self, course: i64, wale: i64) -> i64 {
        (course + 1..).find(|&later| self.knits(later, wale)).unwrap_or(course)
    }

    /// The side to which the needle of `wale` draws its next loop after `course`: 1 for the face,
    /// -1 for the back.
    pub(super) fn next_side(&self, course: i64, wale: i64) -> f64 {
        match self.stitch(self.next_knit(course, wale), wale) {
            Stitch::Back => -1.0,
            Stitch::Face | Stitch::Tuck | Stitch::Miss => 1.0,
        }
    }

    /// Number of loops on the needle of `wale` when `course` is knitted: 0 after its loop was moved
    /// away.
    pub(super) fn hanging(&self, course: i64, wale: i64) -> usize {
        self.loops(course, wale).len()
    }

    /// The loops on the needle of `wale` when `course` is knitted, in the order in which they came.
    /// The needle's own loop is there before a neighbour's loop is moved onto it.
    ///
    /// Later loops lie nearer to the tip of the hook, and thus further from the side to which the
    /// next loop is drawn.
    fn loops(&self, course: i64, wale: i64) -> Vec<Hanging> {
        let last_knit = (1..).map(|back| course - back).find(|&earlier| self.knits(earlier, wale));
        let mut loops = Vec::new();
        for earlier in last_knit.unwrap_or(course)..course {
            for from in [0, -1, 1] {
                let (stitch, moved) = self.cell(earlier, wale + from);
                if stitch != Stitch::Miss && moved == -from {
                    loops.push(Hanging { course: earlier, wale: wale + from });
                }
            }
        }
        loops
    }

    /// What happens to the loop that is made in `course` on the needle of `wale`.
    pub(super) fn fate(&self, course: i64, wale: i64) -> Fate {
        let moved = self.cell(course, wale).1;
        let next = self.next_knit(course, wale + moved);
        let layer =
            self.loops(next, wale + moved).iter().position(|&hanging| hanging == Hanging { course, wale });
        Fate {
            moved,
            held: next - course - 1,
            side: self.next_side(course, wale + moved),
            layer: layer.unwrap_or(0),
        }
    }
}
