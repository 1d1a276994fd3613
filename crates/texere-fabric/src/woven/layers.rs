//! The layers that a woven cloth falls apart into.

use std::cmp::Reverse;

use texere_core::Origin;

use super::{BySet, Drawdown};

impl Drawdown {
    /// The layers that the cloth falls apart into, from the face: the numbers of ends and picks of
    /// each layer. A cloth that hangs together is a single layer. A double cloth that nothing
    /// stitches together has two layers. Threads that lie loose on the face or the back are layers,
    /// too. The threads that lie on top most often are in the first layer.
    ///
    /// **Source**: C. R. J. Clapham, "When a fabric hangs together", Bulletin of the London
    /// Mathematical Society 12, 1980: some ends and picks can be lifted off the rest if the number
    /// of crossings at which one of them lies on top equals the number of crossings in which they
    /// take part.
    ///
    /// ```
    /// use texere_fabric::{BySet, Drawdown, Weave};
    /// assert_eq!(Weave::parse("2/2")?.drawdown(8, 8)?.layers(), [BySet { warp: 8, weft: 8 }]);
    /// // Every other end and pick makes a plain cloth over another one of the rest.
    /// let double = Drawdown::from_fn(8, 8, |end, pick| match (end % 2, pick % 2) {
    ///     (0, 0) | (1, 1) => (end / 2 + pick / 2) % 2 == 0,
    ///     (face, _) => face == 0,
    /// })?;
    /// assert_eq!(double.layers(), [BySet { warp: 4, weft: 4 }; 2]);
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    #[must_use]
    pub fn layers(&self) -> Vec<BySet<usize>> {
        let [ends, picks] = [self.ends(), self.picks()];
        // Counts of how often each thread lies on top, the highest first, and their running sums.
        let [over, under] = [self.ups_of_ends(), self.downs_of_picks()].map(|mut counts| {
            counts.sort_unstable_by_key(|count| Reverse(*count));
            counts
        });
        let [sums_over, sums_under] = [&over, &under].map(|counts| {
            let mut sum = 0;
            let add = |count: &u64| {
                sum += count;
                sum
            };
            [0].into_iter().chain(counts.iter().map(add)).collect::<Vec<u64>>()
        });
        let (mut layers, mut last) = (Vec::<[usize; 2]>::new(), [0, 0]);
        for (first, over) in sums_over.iter().enumerate() {
            // The first ends are taken. Picks are then taken one by one, the greatest count first.
            // Each pick adds its count to the number of crossings at which a taken thread lies on
            // top, and it adds the number of the other ends to the number of crossings of taken
            // threads. The first number less the second is therefore largest once all picks with a
            // count above the number of other ends are taken, and no pick with a count below it.
            // Both numbers can be equal only there.
            let others = (ends - first) as u64;
            let [fewest, most] = [
                under.partition_point(|count| *count > others),
                under.partition_point(|count| *count >= others),
            ];
            for (second, under) in (fewest..).zip(&sums_under[fewest..=most]) {
                let crossings = first as u64 * picks as u64 + second as u64 * others;
                if over + under != crossings || [first, second] == last {
                    continue;
                }
                let layer = [first - last[0], second - last[1]];
                match layers.last_mut() {
                    // Threads of one set do not lie on one another, so two layers of one set alone
                    // are joined.
                    Some(before) if [0, 1].iter().any(|&set| before[set] == 0 && layer[set] == 0) => {
                        *before = [before[0] + layer[0], before[1] + layer[1]];
                    }
                    _ => layers.push(layer),
                }
                last = [first, second];
            }
        }
        layers.into_iter().map(BySet::of).collect()
    }

    /// The loose threads, ends first: the threads of those `layers` of the cloth that have threads
    /// of one set alone.
    pub(crate) fn loose(&self, layers: &[BySet<usize>]) -> Vec<Origin> {
        let orders = [self.ups_of_ends(), self.downs_of_picks()].map(|counts| {
            let mut order: Vec<usize> = (0..counts.len()).collect();
            order.sort_by_key(|thread| Reverse(counts[*thread]));
            order
        });
        let origin = [Origin::End, Origin::Pick];
        let of = |set: usize| {
            let mut first = 0;
            let mut loose = Vec::new();
            for layer in layers.iter().map(|layer| layer.into_array()) {
                if layer[1 - set] == 0 {
                    loose.extend_from_slice(&orders[set][first..first + layer[set]]);
                }
                first += layer[set];
            }
            loose.sort_unstable();
            loose.into_iter().map(move |thread| origin[set](thread as u32 + 1))
        };
        of(0).chain(of(1)).collect()
    }
}
