//! Pieces of an endless cloth: yarns of one repeat that hold one another, within the repeat or
//! across its edges.
//!
//! The method is union-find. Each yarn points to another yarn of its piece. A walk along these
//! pointers ends at the root of the piece. A pointer also keeps the copy of the repeat in which the
//! other yarn lies. A piece may come back to its own yarn in another copy of the repeat. The root
//! keeps the ways to all such copies. The ways form a lattice, from which the pieces in any number
//! of copies are counted.

/// Number of copies along x and y from one yarn to another.
type Shift = [i64; 2];

/// The yarns of one repeat of an endless cloth, joined to one another.
#[derive(Debug)]
pub(crate) struct Joined {
    /// For each yarn, the yarn that it points to, and the copy in which the other yarn lies
    /// relative to the first. A root points to itself.
    parents: Vec<(usize, Shift)>,
    /// For each root, the copies in which the same piece comes back.
    returns: Vec<Lattice>,
    held: Vec<bool>,
}

/// A piece: yarns of a repeat that hang together, and the other copies in which the same piece
/// comes back.
#[derive(Debug)]
pub(crate) struct Part {
    pub(crate) yarns: Vec<usize>,
    /// The lowest and the highest copy in which the piece's yarns lie, along x and y.
    spread: [[i64; 2]; 2],
    returns: Lattice,
}

/// A lattice of copies: all sums of multiples of (a, b) and (0, d).
#[derive(Debug, Clone, Copy, Default)]
struct Lattice {
    a: i64,
    b: i64,
    d: i64,
}

impl Joined {
    pub(crate) fn new(yarns: usize) -> Self {
        Self {
            parents: (0..yarns).map(|yarn| (yarn, [0, 0])).collect(),
            returns: vec![Lattice::default(); yarns],
            held: vec![false; yarns],
        }
    }

    /// Records that the yarn `one` and the yarn `other`, which lies `shift` copies further, hold
    /// one another. Both may be the same yarn.
    pub(crate) fn hold(&mut self, one: usize, other: usize, shift: Shift) {
        (self.held[one], self.held[other]) = (true, true);
        self.join(one, other, shift);
    }

    /// Records that the yarn `one` and the yarn `other`, which lies `shift` copies further, are of
    /// one piece.
    pub(crate) fn join(&mut self, one: usize, other: usize, shift: Shift) {
        let ((one, first), (other, second)) = (self.root(one), self.root(other));
        // The number of copies from the first root to the second.
        let way = [0, 1].map(|axis| shift[axis] + second[axis] - first[axis]);
        if one == other {
            self.returns[one].insert(way);
            return;
        }
        self.parents[other] = (one, way.map(|copies| -copies));
        let Lattice { a, b, d } = self.returns[other];
        self.returns[one].insert([a, b]);
        self.returns[one].insert([0, d]);
    }

    /// Whether anything holds a yarn.
    pub(crate) fn is_held(&self, yarn: usize) -> bool {
        self.held[yarn]
    }

    /// The root of a yarn, and the copy in which the root lies relative to the yarn.
    fn root(&mut self, yarn: usize) -> (usize, Shift) {
        let (mut at, mut way, mut path) = (yarn, [0, 0], Vec::new());
        while self.parents[at].0 != at {
            let (next, shift) = self.parents[at];
            path.push((at, way));
            way = [0, 1].map(|axis| way[axis] + shift[axis]);
            at = next;
        }
        for (passed, before) in path {
            self.parents[passed] = (at, [0, 1].map(|axis| way[axis] - before[axis]));
        }
        (at, way)
    }

    /// The pieces, in the order of their first yarns.
    pub(crate) fn parts(&mut self) -> Vec<Part> {
        let mut numbers = vec![usize::MAX; self.parents.len()];
        let mut parts: Vec<Part> = Vec::new();
        for yarn in 0..self.parents.len() {
            let (root, way) = self.root(yarn);
            if numbers[root] == usize::MAX {
                numbers[root] = parts.len();
                parts.push(Part { yarns: Vec::new(), spread: [way; 2], returns: self.returns[root] });
            }
            let Part { yarns, spread: [low, high], .. } = &mut parts[numbers[root]];
            yarns.push(yarn);
            for axis in 0..2 {
                (low[axis], high[axis]) = (low[axis].min(way[axis]), high[axis].max(way[axis]));
            }
        }
        parts
    }
}

impl Part {
    /// Number of pieces of this kind in `copies` copies of the repeat. A piece at an edge lacks the
    /// yarns that would lie beyond the edge.
    pub(crate) fn count(&self, copies: [u32; 2]) -> u64 {
        let yarns = copies.map(u64::from).iter().product::<u64>().saturating_mul(self.yarns.len() as u64);
        let copies =
            [0, 1].map(|axis| u64::from(copies[axis]) + self.spread[0][axis].abs_diff(self.spread[1][axis]));
        let all = copies[0].saturating_mul(copies[1]);
        let Lattice { a, b, d } = self.returns;
        let pieces = if a != 0 && d != 0 {
            a.unsigned_abs().saturating_mul(d.unsigned_abs()).min(all)
        } else if (a, b, d) == (0, 0, 0) {
            all
        } else {
            // All ways back are multiples of one way. A piece begins in each copy from which this
            // way leads out of the cloth.
            let back = if a != 0 { [a, b] } else { [0, d] };
            let inner = [0, 1].map(|axis| copies[axis].saturating_sub(back[axis].unsigned_abs()));
            all - inner[0].saturating_mul(inner[1]).min(all)
        };
        pieces.min(yarns)
    }
}

impl Lattice {
    fn insert(&mut self, [mut x, mut y]: Shift) {
        while x != 0 {
            let times = self.a / x;
            (self.a, self.b, x, y) = (x, y, self.a - times * x, self.b - times * y);
        }
        let (mut greatest, mut rest) = (self.d.abs(), y.abs());
        while rest != 0 {
            (greatest, rest) = (rest, greatest % rest);
        }
        self.d = greatest;
        if greatest != 0 {
            self.b = self.b.rem_euclid(greatest);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Joined;

    fn count(returns: &[[i64; 2]], copies: [u32; 2]) -> u64 {
        let mut joined = Joined::new(1);
        returns.iter().for_each(|way| joined.hold(0, 0, *way));
        joined.parts()[0].count(copies)
    }

    #[test]
    fn pieces_are_counted_as_copy_by_copy() {
        let ways = [[1, 0], [0, 1], [2, 0], [-3, 1], [1, 2], [2, 2], [0, -2]];
        for one in ways {
            for other in ways {
                for copies in [[4_u32, 3], [7, 7], [12, 9]] {
                    // The oracle paints connected copies, in a cloth that is 20 copies wider on
                    // each side, because copies may be connected by way of copies beyond the edges.
                    let (wide, edge) = (copies.map(|copies| copies + 40), 20);
                    let mut paint: Vec<usize> = (0..(wide[0] * wide[1]) as usize).collect();
                    let number = |x: i64, y: i64| {
                        let within =
                            (0..i64::from(wide[0])).contains(&x) && (0..i64::from(wide[1])).contains(&y);
                        within.then(|| (y * i64::from(wide[0]) + x) as usize)
                    };
                    let cells =
                        || (0..i64::from(wide[1])).flat_map(|y| (0..i64::from(wide[0])).map(move |x| [x, y]));
                    for _ in 0..80 {
                        for [x, y] in cells() {
                            for way in [one, other] {
                                if let (Some(a), Some(b)) = (number(x, y), number(x + way[0], y + way[1])) {
                                    let least = paint[a].min(paint[b]);
                                    (paint[a], paint[b]) = (least, least);
                                }
                            }
                        }
                    }
                    let seen: std::collections::BTreeSet<usize> = cells()
                        .filter(|[x, y]| {
                            (edge..edge + i64::from(copies[0])).contains(x)
                                && (edge..edge + i64::from(copies[1])).contains(y)
                        })
                        .filter_map(|[x, y]| number(x, y).map(|cell| paint[cell]))
                        .collect();
                    assert_eq!(
                        count(&[one, other], copies),
                        seen.len() as u64,
                        "{one:?} {other:?} {copies:?}"
                    );
                }
            }
        }
    }
}
