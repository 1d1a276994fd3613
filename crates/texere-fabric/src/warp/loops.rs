//! Loops that share a needle, and their order.

use std::cmp::Reverse;

use texere_core::OutOfMemory;
use texere_core::backend::room_for;

use super::{Bar, Lap, LapKind, PlacedLap};

/// The rank of a loop among the loops on its needle. Loops are ordered by bar from the front, and
/// within a bar by guide.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Share {
    /// Number of loops on the needle before this one.
    rank: u16,
    /// Number of all loops on the needle.
    all: u16,
    /// Number of loops of the same bar on the needle before this one.
    pub(super) own_rank: u16,
    /// Number of all loops of the same bar on the needle.
    own: u16,
}

impl Share {
    /// How far the loop lies in front of the middle of all loops on the needle, in loops.
    pub(super) fn front_most(self) -> f64 {
        0.5 * (f64::from(self.all) - 1.0) - f64::from(self.rank)
    }

    /// How far the loop lies to the right of the middle of its own bar's loops, in loops. Guides of
    /// one bar do not pass one another.
    pub(super) fn own_middle(self) -> f64 {
        f64::from(self.own_rank) - 0.5 * (f64::from(self.own) - 1.0)
    }
}

/// The laps of a repeat, and the ranks of their loops on the needles.
pub(super) struct Loops {
    /// All laps, bar by bar, guide by guide, course by course.
    pub(super) placed: Vec<PlacedLap>,
    /// For each lap, the ranks of its loops; a lap makes two at most.
    shares: Vec<[Share; 2]>,
    /// The most loops on one needle in a course.
    pub(super) most: u16,
    /// For each bar, whether another bar makes the same loops.
    pub(super) alike: Vec<bool>,
    /// For each bar, whether all its laps are open and on one needle or on two neighbours, in a
    /// repeat with at most one loop on each needle.
    pub(super) steep: Vec<bool>,
}

impl Loops {
    /// Ranks the loops of `placed`, all laps of a repeat in order. `size` is the number of wales
    /// and of courses.
    pub(super) fn new(placed: Vec<PlacedLap>, bars: &[Bar], size: [u32; 2]) -> Result<Self, OutOfMemory> {
        let needles = size[0] as usize * size[1] as usize;
        let (mut shares, mut all, mut own) = (Vec::new(), Vec::new(), Vec::new());
        room_for(&mut shares, placed.len(), "loops")?;
        room_for(&mut all, needles, "needles")?;
        room_for(&mut own, needles, "needles")?;
        let longest =
            placed.chunk_by(|one, other| one.bar == other.bar).map(<[PlacedLap]>::len).max().unwrap_or(0);
        let mut order: Vec<(Reverse<i32>, usize, usize, usize)> = Vec::new();
        room_for(&mut order, 2 * longest, "loops")?;
        shares.resize(placed.len(), [Share::default(); 2]);
        all.resize(needles, 0_u16);
        own.resize(needles, 0_u16);
        let place = |placed: &PlacedLap, needle: i32| {
            needle.rem_euclid(size[0] as i32) as usize + placed.course as usize * size[0] as usize
        };
        let mut start = 0;
        for bar in placed.chunk_by(|one, other| one.bar == other.bar) {
            let shares = &mut shares[start..start + bar.len()];
            own.fill(0);
            order.clear();
            let parts = |lap: &PlacedLap| lap.lap.needles().enumerate();
            for (number, placed) in bar.iter().enumerate() {
                // A loop beyond the right edge of the repeat stands for a loop of the repeat to the
                // left, whose guide is further left than all guides of this repeat. It comes first
                // on its needle. A loop beyond the left edge comes last.
                let round = |needle: i32| Reverse(needle.div_euclid(size[0] as i32));
                order.extend(
                    parts(placed).map(|(part, needle)| (round(needle), number, part, place(placed, needle))),
                );
            }
            order.sort_unstable();
            for &(_, number, part, at) in &order {
                shares[number][part] = Share { rank: all[at], own_rank: own[at], ..Share::default() };
                all[at] = all[at].saturating_add(1);
                own[at] = own[at].saturating_add(1);
            }
            for &(_, number, part, at) in &order {
                shares[number][part].own = own[at];
            }
            start += bar.len();
        }
        for (placed, shares) in placed.iter().zip(&mut shares) {
            for (needle, share) in placed.lap.needles().zip(shares) {
                share.all = all[place(placed, needle)];
            }
        }
        let most = all.into_iter().max().unwrap_or(1).max(1);
        let steep = bars.iter().map(|bar| most == 1 && is_steep(bar)).collect();
        let alike = bars.iter().enumerate().map(|(number, bar)| {
            let others = bars.iter().enumerate().filter(|(other, _)| *other != number);
            others.into_iter().any(|(_, other)| laps_alike(bar, other))
        });
        Ok(Self { alike: alike.collect(), placed, shares, most, steep })
    }

    /// The rank of a loop of the lap `lap`. `part` is 0, or 1 for the second loop of a lap round
    /// two needles.
    pub(super) fn share(&self, lap: usize, part: usize) -> Share {
        self.shares[lap][part]
    }
}

/// Whether all laps of a bar are open, and on one needle or on two neighbours. False for a Jacquard
/// bar.
fn is_steep(bar: &Bar) -> bool {
    let needles = || bar.chain.laps().iter().map(|lap| lap.needle());
    let near = needles().max().zip(needles().min()).is_some_and(|(high, low)| high - low <= 1);
    let open = |course| bar.chain.lap(course).kind() == LapKind::Overlap && bar.chain.is_open(course);
    bar.jacquard.is_none() && near && (0..bar.chain.courses()).all(open)
}

/// Whether the guides of two bars make the same loops.
fn laps_alike(one: &Bar, other: &Bar) -> bool {
    let lap = |bar: &Bar, lap: &Lap| [lap.from + bar.offset, lap.to + bar.offset];
    let [mut first, mut second] =
        [one, other].map(|bar| bar.chain.laps().iter().map(move |each| lap(bar, each)));
    one.chain.courses() == other.chain.courses()
        && one.chain.laps().iter().any(|lap| lap.kind() != LapKind::Inlay)
        && first.by_ref().zip(second.by_ref()).all(|(one, other)| one == other)
}
