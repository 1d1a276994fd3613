//! Which loops share a needle, and in what order.

use std::cmp::Reverse;

use texere_core::OutOfMemory;
use texere_core::backend::room_for;

use super::{Bar, Laid, Lap, LapKind};

/// The place of a loop among those on its needle: bar by bar from the front, and in each bar guide
/// by guide.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Share {
    /// How many come before it.
    rank: u16,
    /// How many there are.
    all: u16,
    /// How many come before it that its own bar makes.
    pub(super) own_rank: u16,
    /// How many there are that its own bar makes.
    own: u16,
}

impl Share {
    /// How much further to the front it lies than the middle of all, in loops.
    pub(super) fn front_most(self) -> f64 {
        0.5 * (f64::from(self.all) - 1.0) - f64::from(self.rank)
    }

    /// How much further to the right it lies than the middle of those that its own bar makes, in
    /// loops: guides don't pass one another.
    pub(super) fn own_middle(self) -> f64 {
        f64::from(self.own_rank) - 0.5 * (f64::from(self.own) - 1.0)
    }
}

/// The laps of a repeat, and how their loops share needles.
pub(super) struct Loops {
    /// All laps, bar by bar, guide by guide, course by course.
    pub(super) laid: Vec<Laid>,
    /// Of each lap, those of its loops.
    shares: Vec<[Share; 2]>,
    /// The most loops on one needle at a course.
    pub(super) most: u16,
    /// Bars that lap just as another one does.
    pub(super) alike: Vec<bool>,
    /// Bars alone on their needles whose laps are open and that stay on one or two of them.
    pub(super) steep: Vec<bool>,
}

impl Loops {
    /// `laid` are all laps of a repeat of so many wales and courses, in their order.
    pub(super) fn new(laid: Vec<Laid>, bars: &[Bar], size: [u32; 2]) -> Result<Self, OutOfMemory> {
        let needles = size[0] as usize * size[1] as usize;
        let (mut shares, mut all, mut own) = (Vec::new(), Vec::new(), Vec::new());
        room_for(&mut shares, laid.len(), "loops")?;
        room_for(&mut all, needles, "needles")?;
        room_for(&mut own, needles, "needles")?;
        let longest = laid.chunk_by(|one, other| one.bar == other.bar).map(<[Laid]>::len).max().unwrap_or(0);
        let mut order: Vec<(Reverse<i32>, usize, usize, usize)> = Vec::new();
        room_for(&mut order, 2 * longest, "loops")?;
        shares.resize(laid.len(), [Share::default(); 2]);
        all.resize(needles, 0_u16);
        own.resize(needles, 0_u16);
        let place = |laid: &Laid, needle: i32| {
            needle.rem_euclid(size[0] as i32) as usize + laid.course as usize * size[0] as usize
        };
        let mut start = 0;
        for bar in laid.chunk_by(|one, other| one.bar == other.bar) {
            let shares = &mut shares[start..start + bar.len()];
            own.fill(0);
            order.clear();
            let parts = |lap: &Laid| lap.lap.needles().enumerate();
            for (number, laid) in bar.iter().enumerate() {
                // What goes round the repeat comes from the left of all that lies in it.
                let round = |needle: i32| Reverse(needle.div_euclid(size[0] as i32));
                order.extend(
                    parts(laid).map(|(part, needle)| (round(needle), number, part, place(laid, needle))),
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
        for (laid, shares) in laid.iter().zip(&mut shares) {
            for (needle, share) in laid.lap.needles().zip(shares) {
                share.all = all[place(laid, needle)];
            }
        }
        let most = all.into_iter().max().unwrap_or(1).max(1);
        let steep = bars.iter().map(|bar| most == 1 && is_steep(bar)).collect();
        let alike = bars.iter().enumerate().map(|(number, bar)| {
            let others = bars.iter().enumerate().filter(|(other, _)| *other != number);
            others.into_iter().any(|(_, other)| laps_alike(bar, other))
        });
        Ok(Self { alike: alike.collect(), laid, shares, most, steep })
    }

    /// The place of a loop of the lap with that number: of its only one, or of one of two.
    pub(super) fn share(&self, lap: usize, part: usize) -> Share {
        self.shares[lap][part]
    }
}

/// Whether all laps are open, on one needle or two that are neighbours.
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
