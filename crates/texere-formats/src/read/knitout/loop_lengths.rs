//! How long the loops of each stitch size are.

use std::collections::BTreeMap;

/// The length of a loop, mm, for each stitch size of a file. Sizes are written as [`size`] writes
/// them.
pub(crate) type LoopLengths = BTreeMap<String, f64>;

/// A stitch size in one spelling, however its numbers are written: the number behind
/// `x-stitch-number`, or both numbers behind `stitch`. None if `text` is not one or two numbers.
pub(crate) fn size(text: &str) -> Option<String> {
    let numbers =
        text.split_whitespace().map(|word| word.parse().ok().filter(|number: &f64| number.is_finite()));
    let numbers: Vec<f64> = numbers.collect::<Option<_>>()?;
    (1..=2).contains(&numbers.len()).then(|| size_of_numbers(&numbers))
}

/// A stitch size of these numbers, as [`size`] writes it.
pub(super) fn size_of_numbers(numbers: &[f64]) -> String {
    // Adding 0 turns -0 into 0.
    let words: Vec<_> = numbers.iter().map(|number| (number + 0.0).to_string()).collect();
    words.join(" ")
}
