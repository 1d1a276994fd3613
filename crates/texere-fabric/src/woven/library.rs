//! Weaves by name: reversed twills, and weaves that are given as drawings.

/// The honeycomb that is commonly woven on eight shafts: a ridge of warp and a ridge of weft round
/// each hollow, and plain weave at the bottom of the hollow. The last pick is on top, and `#` is
/// warp up.
///
/// **Source**: Encyclopædia Britannica, 11th edition, 1911, "Honeycomb", design A, the perfect
/// honeycomb. Its longest weft float passes over seven ends, and its longest warp float over five
/// picks.
pub(super) const HONEYCOMB: [&str; 8] =
    [".#.....#", "#.#...#.", "##.#.#.#", "###.#.##", "##.#.#.#", "#.#...#.", ".#.....#", "#......."];

/// Crepe (crape, oatmeal) on eight ends, without a line in any direction. The last pick is on top,
/// and `#` is warp up.
///
/// **Source**: John T. Taylor, "Cotton Weaving and Designing", 6th edition, 1909, makes crapes by
/// rearranging the ends of a twill, and gives the twill 2/2*1/1*1/1 for this purpose. Here the ends
/// of that twill are taken in steps of three, as in an eight-end satin.
pub(super) const CREPE: [&str; 8] =
    ["##...#.#", "..#.###.", ".###...#", "#...#.##", ".#.###..", "###...#.", "...#.###", "#.###..."];

/// Whether a drawing with the last pick on top has `#` where `end` and `pick`, both counted from 0,
/// cross.
pub(super) fn drawn(drawing: &[&str], end: usize, pick: usize) -> bool {
    let row = drawing.iter().rev().nth(pick).and_then(|row| row.as_bytes().get(end));
    row == Some(&b'#')
}

/// How a twill's line changes direction.
#[derive(Clone, Copy)]
pub(super) enum Reversal {
    /// Herringbone: the line is cut. The first end in the other direction is taken half a repeat of
    /// the twill further on, so that in a balanced twill warp floats lie beside weft floats.
    Cut,
    /// The line turns at a single end, the point.
    Point,
}

impl Reversal {
    /// The fewest ends in one direction with which all ends of a twill on `repeat` ends still
    /// occur.
    pub(super) const fn least(self, repeat: usize) -> usize {
        match self {
            Self::Cut => repeat.div_ceil(2),
            Self::Point => repeat,
        }
    }

    /// Number of ends of the whole repeat, with `way` ends in each direction. The end at a point
    /// belongs to both directions.
    pub(super) const fn ends(self, way: usize) -> usize {
        match self {
            Self::Cut => 2 * way,
            Self::Point => 2 * way - 2,
        }
    }

    /// The end of a twill on `repeat` ends that stands at the place `end`, counted from 0, of the
    /// whole repeat.
    pub(super) const fn origin(self, end: usize, way: usize, repeat: usize) -> usize {
        if end < way {
            return end;
        }
        let back = self.ends(way) - end;
        match self {
            Self::Cut => repeat / 2 + back - 1,
            Self::Point => back,
        }
    }
}
