//! Covering arrays: rows with a value for each factor, in which every two values of two factors
//! occur together.

use std::collections::BTreeSet;

/// The number of a factor, and the number of one of its values.
type Level = (usize, usize);

/// The rows that a greedy search finds for factors of `sizes` values. They are the same on every
/// run.
///
/// Each row starts with a pair that no row has yet. For each further factor it takes the value that
/// adds the most new pairs (Cohen, Dalal, Fredman and Patton 1997, without their random choices).
pub(super) fn covering(sizes: &[usize]) -> Vec<Vec<usize>> {
    let mut open = pairs(sizes);
    let mut rows = Vec::new();
    while let Some(&(one, other)) = open.first() {
        let mut levels: Vec<Level> = vec![one, other];
        for factor in (0..sizes.len()).filter(|factor| ![one.0, other.0].contains(factor)) {
            let gain = |value: &usize| {
                levels.iter().filter(|&&level| open.contains(&pair(level, (factor, *value)))).count()
            };
            // Each row prefers another one of equally good values, so that values are used evenly.
            let values = (0..sizes[factor]).map(|value| (value + rows.len()) % sizes[factor]);
            let best = values.max_by_key(gain).unwrap_or_default();
            levels.push((factor, best));
        }
        levels.sort_unstable();
        for (number, &level) in levels.iter().enumerate() {
            for &later in &levels[number + 1..] {
                open.remove(&(level, later));
            }
        }
        rows.push(levels.into_iter().map(|(_, value)| value).collect());
    }
    rows
}

/// The pair in the order of its factors.
fn pair(one: Level, other: Level) -> (Level, Level) {
    if one < other { (one, other) } else { (other, one) }
}

fn pairs(sizes: &[usize]) -> BTreeSet<(Level, Level)> {
    let mut pairs = BTreeSet::new();
    for factor in 0..sizes.len() {
        for later in factor + 1..sizes.len() {
            for value in 0..sizes[factor] {
                pairs.extend((0..sizes[later]).map(|other| ((factor, value), (later, other))));
            }
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three factors of two values need exactly four rows, and a single factor, which has no pairs,
    /// needs none. Nine factors of very different sizes need about as many rows as the two largest
    /// have pairs.
    #[test]
    fn few_rows_are_enough() {
        assert_eq!(covering(&[2, 2, 2]).len(), 4);
        assert_eq!(covering(&[4]).len(), 0);
        let rows = covering(&[9, 62, 2, 6, 2, 2, 3, 3, 4]).len();
        assert!((558..=570).contains(&rows), "{rows}");
    }
}
