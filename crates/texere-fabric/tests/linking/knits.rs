//! Small knits that are made from the control points of one loop.

use texere_core::{ControlPoint, Origin, Yarn, Yarns};

/// The diameter of all yarns, mm.
pub(crate) const D: f32 = 0.2;

/// A knit of equal loops. Each yarn runs along x from loop to loop, one course above the yarn
/// before.
#[derive(Debug, Clone)]
pub(crate) struct Knit {
    /// Control points of one loop, mm. The first lies half way between this loop and the loop
    /// before.
    loop_points: Vec<[f32; 3]>,
    /// Distance from one loop to the next, mm.
    pub(crate) wale: f32,
    /// Distance from one course to the next, mm.
    pub(crate) course: f32,
    pub(crate) wales: usize,
    pub(crate) courses: usize,
}

/// A whole loop from its first half, whose last point is the head. The second half is the mirror
/// image of the first.
fn whole(half: &[[f32; 3]], wale: f32) -> Vec<[f32; 3]> {
    let mirrored = half[1..half.len() - 1].iter().rev().map(|[x, y, z]| [wale - x, *y, *z]);
    half.iter().copied().chain(mirrored).collect()
}

impl Knit {
    /// Plain jersey with 12 points for each loop, whose wales are `pitch` diameters wide.
    pub(crate) fn jersey(pitch: f32, wales: usize, courses: usize) -> Self {
        let (wale, course, deep) = (pitch * D, 0.75 * pitch * D, 0.66 * D);
        let (height, neck) = (1.76 * course, (0.53 * D).max(0.09 * wale));
        let half = [
            [0.0, 0.0, -0.84],
            [0.31 * wale, 0.083, -0.48],
            [wale / 2.0 - neck, 0.285, 0.41],
            [0.25 * wale, 0.5, 0.98],
            [neck, 0.715, 0.41],
            [0.19 * wale, 0.917, -0.48],
            [wale / 2.0, 1.0, -0.84],
        ];
        let half = half.map(|[x, y, z]| [x, y * height, z * deep]);
        Self { loop_points: whole(&half, wale), wale, course, wales, courses }
    }

    /// Plain jersey with 8 points for each loop, whose wales are `pitch` diameters wide.
    pub(crate) fn coarse_jersey(pitch: f32, wales: usize, courses: usize) -> Self {
        let (wale, course) = (pitch * D, 0.75 * pitch * D);
        let (height, half_gap, deep) = (1.7 * course, (0.9 * D).min(wale / 4.0 - 0.55 * D), 0.8 * D);
        let half = [
            [0.0, 0.0, -deep],
            [wale / 4.0 + half_gap, (height - course) / 2.0, 0.0],
            [wale / 4.0, height / 2.0, deep],
            [wale / 4.0 - half_gap, (height + course) / 2.0, 0.0],
            [wale / 2.0, height, -deep],
        ];
        Self { loop_points: whole(&half, wale), wale, course, wales, courses }
    }

    /// Number of control points of a loop.
    pub(crate) fn points(&self) -> usize {
        self.loop_points.len()
    }

    /// Points of all courses, moved by `to`. `to` gets the course and the wale, the number of the
    /// point in its loop, and the position of the point relative to the loop's start. Unless yarns
    /// repeat (`repeats`), each ends with the first point of the loop that would follow.
    fn lines(
        &self,
        repeats: bool,
        to: impl Fn([usize; 2], usize, [f32; 3]) -> [f32; 3],
    ) -> Vec<Vec<[f32; 3]>> {
        let line = |course: usize| {
            let count = self.wales * self.points() + usize::from(!repeats);
            let point = |number: usize| {
                let (wale, point) = (number / self.points(), number % self.points());
                let [x, y, z] = to([course, wale], point, self.loop_points[point]);
                [x + wale as f32 * self.wale, y + course as f32 * self.course, z]
            };
            (0..count).map(point).collect()
        };
        (0..self.courses).map(line).collect()
    }

    /// The yarns, moved by `to`, with `finer` times as many control points on the same curves.
    pub(crate) fn yarns(&self, finer: usize, to: impl Fn([usize; 2], usize, [f32; 3]) -> [f32; 3]) -> Yarns {
        courses(self.lines(false, to).iter().map(|line| refined(line, finer)))
    }

    /// The yarns of a repeat, moved by `to`. Each yarn goes on in the next repeat along x.
    pub(crate) fn repeat(&self, to: impl Fn([usize; 2], usize, [f32; 3]) -> [f32; 3]) -> Yarns {
        courses(self.lines(true, to))
    }

    /// Moves the head of one loop in front of the loop that holds it, so that the head is free.
    pub(crate) fn dropped(&self, at: [usize; 2]) -> impl Fn([usize; 2], usize, [f32; 3]) -> [f32; 3] {
        let head = self.points() / 2;
        move |place, point, [x, y, z]| {
            let moves = place == at && point.abs_diff(head) <= 1;
            [x, y, if moves { 1.5 * D } else { z }]
        }
    }

    /// Pulls one loop straight: out of the loop that it was drawn through, and out of the loop that
    /// was drawn through it.
    pub(crate) fn pulled(&self, at: [usize; 2]) -> impl Fn([usize; 2], usize, [f32; 3]) -> [f32; 3] {
        let foot = self.loop_points[0][2];
        move |place, point, [x, y, z]| if place == at && point > 0 { [x, 0.1 * y, foot] } else { [x, y, z] }
    }
}

fn courses(lines: impl IntoIterator<Item = Vec<[f32; 3]>>) -> Yarns {
    let mut yarns = Yarns::builder();
    for (course, line) in lines.into_iter().enumerate() {
        let points: Vec<_> = line.iter().map(|[x, y, z]| ControlPoint::new(*x, *y, *z, D / 2.0)).collect();
        yarns.yarn(Yarn { origin: Origin::Course(course as u32 + 1), ..Yarn::default() }, &points);
    }
    yarns.build().unwrap()
}

/// A line with further points on the spline through its points.
fn refined(line: &[[f32; 3]], finer: usize) -> Vec<[f32; 3]> {
    let at = |index: isize| line[index.clamp(0, line.len() as isize - 1) as usize];
    let mut points: Vec<_> = (0..(line.len() - 1) * finer)
        .map(|number| {
            let (interval, t) = ((number / finer) as isize, (number % finer) as f32 / finer as f32);
            let [before, start, end, after] = [-1, 0, 1, 2].map(|step| at(interval + step));
            std::array::from_fn(|axis| {
                let (leaving, arriving) =
                    ((end[axis] - before[axis]) / 2.0, (after[axis] - start[axis]) / 2.0);
                let span = end[axis] - start[axis];
                let bend = 3.0 * span - 2.0 * leaving - arriving;
                start[axis] + (leaving + (bend + (leaving + arriving - 2.0 * span) * t) * t) * t
            })
        })
        .collect();
    points.extend(line.last());
    points
}

/// Closed tricot with 9 points for each course. Each guide laps over one needle, then over the
/// needle beside it, and so on: 1-0/1-2. `to` moves points as in [`Knit::yarns`], by guide and
/// course.
pub(crate) fn tricot(
    guides: usize,
    courses: usize,
    to: impl Fn([usize; 2], usize, [f32; 3]) -> [f32; 3],
) -> Yarns {
    let (wale, course) = (D / 0.1, 0.75 * D / 0.1);
    let (height, gap, deep, under) = (1.6 * course, 0.9 * D, 0.9 * D, 2.2 * D);
    let mut yarns = Yarns::builder();
    for guide in 0..guides {
        let mut points = Vec::new();
        for row in 0..courses {
            let side = if row % 2 == 0 { -1.0 } else { 1.0 };
            let half = [
                [-0.14 * wale, -0.05 * course, -under],
                [-(wale / 4.0 - gap), (height - course) / 2.0, 0.0],
                [-wale / 4.0, height / 2.0, deep],
                [-(wale / 4.0 + gap), (height + course) / 2.0, 0.0],
                [0.0, height, -deep],
            ];
            let mirrored = half[..4].iter().rev().map(|[x, y, z]| [-x, *y, *z]);
            let needle = guide as f32 + if row % 2 == 0 { 0.0 } else { 1.0 };
            for (number, [x, y, z]) in half.into_iter().chain(mirrored).enumerate() {
                let [x, y, z] = to([guide, row], number, [side * x, y, z]);
                points.push(ControlPoint::new(x + needle * wale, y + row as f32 * course, z, D / 2.0));
            }
        }
        let origin = Origin::Guide { bar: 1, guide: guide as u32 + 1 };
        yarns.yarn(Yarn { origin, ..Yarn::default() }, &points);
    }
    yarns.build().unwrap()
}

/// A movement that leaves every point where it is.
pub(crate) fn as_it_is(_: [usize; 2], _: usize, at: [f32; 3]) -> [f32; 3] {
    at
}
