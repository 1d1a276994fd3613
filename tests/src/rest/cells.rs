//! A grid of cells by which places near one another are found, in all copies of a repeat.

use std::collections::BTreeMap;

use glam::DVec3;

/// Places, sorted into cells in x and y. Cloth is thin, so a cell holds its places at every height
/// z.
pub(super) struct Cells {
    /// The number of cells in a repeat along each axis; 0 if nothing repeats along it.
    count: [i64; 2],
    /// Places in each cell of the first repeat, with the number of repeats by which they lie beyond
    /// it.
    members: BTreeMap<[i64; 2], Vec<(usize, [i64; 2])>>,
    /// The greatest distance, in cells, of two cells that may hold near places.
    range: [i64; 2],
}

impl Cells {
    /// A grid that finds places which are at most `reach` mm apart.
    pub(super) fn new(places: &[DVec3], repeat: [f64; 2], reach: f64) -> Self {
        let count = repeat.map(|repeat| if repeat > 0.0 { ((repeat / reach) as i64).max(1) } else { 0 });
        let size = [0, 1].map(|axis| if count[axis] > 0 { repeat[axis] / count[axis] as f64 } else { reach });
        let mut members = BTreeMap::<_, Vec<_>>::new();
        for (number, place) in places.iter().enumerate() {
            let at = [(place.x / size[0]).floor() as i64, (place.y / size[1]).floor() as i64];
            let (cell, beyond) = wrapped(at, count);
            members.entry(cell).or_default().push((number, beyond));
        }
        Self { count, members, range: size.map(|size| (reach / size).ceil() as i64) }
    }

    /// Calls `visit` once with every two places that may be near, and with the image of the second
    /// one: the repeats by which it is moved in x and y. A place may be near its own image.
    pub(super) fn each_pair(&self, mut visit: impl FnMut(usize, usize, [i32; 2])) {
        for (&[x, y], places) in &self.members {
            for along in -self.range[0]..=self.range[0] {
                for up in -self.range[1]..=self.range[1] {
                    let (cell, image) = wrapped([x + along, y + up], self.count);
                    for &(other, other_beyond) in self.members.get(&cell).map_or(&[][..], Vec::as_slice) {
                        for &(one, beyond) in places {
                            let image =
                                [0, 1].map(|axis| (image[axis] + beyond[axis] - other_beyond[axis]) as i32);
                            if (other, image) > (one, [0; 2]) {
                                visit(one, other, image);
                            }
                        }
                    }
                }
            }
        }
    }
}

/// `cell`, moved into the first repeat, and the number of repeats by which it has been moved back
/// along each axis.
fn wrapped(cell: [i64; 2], count: [i64; 2]) -> ([i64; 2], [i64; 2]) {
    let split = [0, 1].map(|axis| match count[axis] {
        0 => (cell[axis], 0),
        count => (cell[axis].rem_euclid(count), cell[axis].div_euclid(count)),
    });
    (split.map(|part| part.0), split.map(|part| part.1))
}
