//! Weaves by name: reversed twills, and weaves that are drawn.

/// The honeycomb that is commonly woven on eight shafts: a ridge of warp and a ridge of weft round
/// each hollow, and plain weave at its bottom. Last pick on top, `#` warp up.
///
/// **Source**: Encyclopædia Britannica, 11th edition, 1911, "Honeycomb", design A, the perfect
/// honeycomb: seven of weft and five of warp in its longest floats.
pub(super) const HONEYCOMB: [&str; 8] =
    [".#.....#", "#.#...#.", "##.#.#.#", "###.#.##", "##.#.#.#", "#.#...#.", ".#.....#", "#......."];

/// Crepe (crape, oatmeal) on eight ends, without a line in any direction. Last pick on top, `#`
/// warp up.
///
/// **Source**: John T. Taylor, "Cotton Weaving and Designing", 6th edition, 1909, makes crapes of
/// the ends of a twill in another order, and gives the twill 2/2*1/1*1/1 for it. Here every third
/// of its ends follows, as in an eight-end satin.
pub(super) const CREPE: [&str; 8] =
    ["##...#.#", "..#.###.", ".###...#", "#...#.##", ".#.###..", "###...#.", "...#.###", "#.###..."];

/// Whether `#` stands where `end` and `pick`, both from 0, cross in a drawing with the last pick on
/// top.
pub(super) fn drawn(drawing: &[&str], end: usize, pick: usize) -> bool {
    let row = drawing.iter().rev().nth(pick).and_then(|row| row.as_bytes().get(end));
    row == Some(&b'#')
}

/// How a twill's line changes direction.
#[derive(Clone, Copy)]
pub(super) enum Reversal {
    /// Herringbone: the line is cut, and the other direction starts half a repeat further on, so
    /// that floats of warp meet floats of weft.
    Cut,
    /// The line turns at a single end, the point.
    Point,
}

impl Reversal {
    /// The fewest ends in one direction with which each pick of a twill on `repeat` ends still
    /// meets all of them.
    pub(super) const fn least(self, repeat: usize) -> usize {
        match self {
            Self::Cut => repeat.div_ceil(2),
            Self::Point => repeat,
        }
    }

    /// Ends of the whole repeat, with `way` ends in each direction. A point counts for both.
    pub(super) const fn ends(self, way: usize) -> usize {
        match self {
            Self::Cut => 2 * way,
            Self::Point => 2 * way - 2,
        }
    }

    /// The end of a twill on `repeat` ends that stands at `end`, from 0, of a whole repeat.
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
