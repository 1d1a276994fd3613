//! A chart of weft-knit stitches, and which loop is drawn through which.

/// What a needle does in a course.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stitch {
    /// Knits on the front bed: draws a new loop to the face through all that hangs on the needle.
    Face,
    /// Knits on the back bed: draws it to the back.
    Back,
    /// Takes the yarn and keeps what it has.
    Tuck,
    /// Takes no yarn: it floats past.
    Miss,
}

/// A repeat of stitches, one yarn a course.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chart {
    wales: usize,
    courses: usize,
    /// Course by course, each with how many needles to the right its loop is moved afterwards.
    cells: Vec<(Stitch, i64)>,
}

/// A loop that hangs on a needle, as the stitch that is drawn through it sees it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Hanging {
    course: i64,
    wale: i64,
}

/// What happens to a loop after it was made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fate {
    /// How many wales to the right its head is moved.
    pub(super) moved: i64,
    /// For how many courses its needle does not knit.
    pub(super) held: i64,
    /// Whether the loop that is drawn through it comes to the face (1) or to the back (-1).
    pub(super) side: f64,
    /// How many loops of the same needle lie between it and the side that the yarn is drawn to.
    pub(super) layer: usize,
}

impl Chart {
    /// A chart from its courses, the first first, a letter for each wale from left to right: `k`
    /// and `p` knit to the face and to the back, `t` tucks, `m` misses; `>` and `<` knit to the
    /// face and then move the loop to the next needle.
    ///
    /// # Panics
    ///
    /// If courses differ in length, for other letters, and where a needle never knits.
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

    /// How many wales a repeat has.
    #[must_use]
    pub fn wales(&self) -> usize {
        self.wales
    }

    /// How many courses a repeat has.
    #[must_use]
    pub fn courses(&self) -> usize {
        self.courses
    }

    fn cell(&self, course: i64, wale: i64) -> (Stitch, i64) {
        let course = course.rem_euclid(self.courses as i64) as usize;
        self.cells[course * self.wales + wale.rem_euclid(self.wales as i64) as usize]
    }

    /// What the needle of `wale` does in `course`.
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

    /// To which side a loop is drawn that the needle of `wale` makes after `course`: 1 to the face,
    /// -1 to the back.
    pub(super) fn next_side(&self, course: i64, wale: i64) -> f64 {
        match self.stitch(self.next_knit(course, wale), wale) {
            Stitch::Back => -1.0,
            Stitch::Face | Stitch::Tuck | Stitch::Miss => 1.0,
        }
    }

    /// How many loops hang on the needle of `wale` when `course` is knitted: 0 after its loop was
    /// moved away.
    pub(super) fn hanging(&self, course: i64, wale: i64) -> usize {
        self.loops(course, wale).len()
    }

    /// What hangs on the needle of `wale` when `course` is knitted, in the order in which it came
    /// to the needle: a needle's own loop is there before a neighbour's is moved onto it.
    ///
    /// Later loops lie nearer the tip of the hook, so further from the side that the next loop is
    /// drawn to.
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
