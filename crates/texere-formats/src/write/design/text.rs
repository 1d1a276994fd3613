//! Text files of a limited size, the numbers in them, and lists of what they leave out.

use std::io::Write;

use super::super::WriteError;
use super::super::target::Target;

/// A text file that is being written. It is refused if it becomes larger than its readers allow.
pub(super) struct Text<W: Write> {
    target: Target<W>,
    format: &'static str,
    bytes: u64,
    limit: u64,
}

impl<W: Write> Text<W> {
    pub(super) fn new(target: Target<W>, format: &'static str, limit: u64) -> Self {
        Self { target, format, bytes: 0, limit }
    }

    /// Writes a line and its end.
    pub(super) fn line(&mut self, line: &str) -> Result<(), WriteError> {
        self.put(line)?;
        self.put("\n")
    }

    /// Writes `text` as it is.
    pub(super) fn put(&mut self, text: &str) -> Result<(), WriteError> {
        self.bytes += text.len() as u64;
        if self.bytes > self.limit {
            return Err(WriteError::TextTooLarge {
                format: self.format,
                bytes: self.bytes,
                limit: self.limit,
            });
        }
        self.target.write(text.as_bytes())
    }

    /// Ends the text, and returns the target.
    pub(super) fn end(self) -> Target<W> {
        self.target
    }
}

/// Number of significant digits with which any two `f64` are written differently.
pub(super) const DIGITS: usize = 17;

/// The number near `value` with the fewest digits, at most `digits`, for which `reads` holds.
/// `reads` says whether a reader gets the value that is meant.
pub(super) fn shortest(value: f64, digits: usize, reads: impl Fn(f64) -> bool) -> Option<f64> {
    let near = (0..digits.min(DIGITS)).find_map(|behind| {
        let rounded: f64 = format!("{value:.behind$e}").parse().ok()?;
        reads(rounded).then_some(rounded)
    });
    // If `value` is a quotient, it may be off by one bit from the number that the reader has to
    // multiply to get the exact value.
    near.or_else(|| {
        let beside = [value.next_down(), value.next_up()];
        beside.into_iter().find(|near| digits >= DIGITS && reads(*near))
    })
}

/// The number near `value` with the fewest digits for which `reads` holds, and `true`; or else
/// `value` itself, and `false`.
pub(super) fn nearest(value: f64, reads: impl Fn(f64) -> bool) -> (f64, bool) {
    shortest(value, DIGITS, reads).map_or((value, false), |near| (near, true))
}

/// Returns `value` if it is from `low` to `high`. Any other value is an error.
pub(super) fn within(
    format: &'static str,
    field: impl FnOnce() -> String,
    value: f64,
    [low, high]: [f64; 2],
) -> Result<f64, WriteError> {
    if (low..=high).contains(&value) {
        Ok(value)
    } else {
        Err(WriteError::OutOfRange { format, field: field(), value, low, high })
    }
}

/// The texts whose condition holds.
pub(super) fn named(said: &[(bool, &str)]) -> Vec<String> {
    said.iter().filter(|(so, _)| *so).map(|(_, what)| (*what).to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_digits_than_it_takes() {
        assert_eq!(shortest(f64::from(0.1_f32), DIGITS, |value| value as f32 == 0.1), Some(0.1));
        assert_eq!(shortest(1.0 / 3.0, DIGITS, |value| value == 1.0 / 3.0), Some(1.0 / 3.0));
        assert_eq!(shortest(1.0 / 3.0, 6, |value| value == 1.0 / 3.0), None);
        assert_eq!(shortest(12.0, 1, |value| (11.5..12.5).contains(&value)), None);
        assert_eq!(nearest(12.0, |value| value > 12.0), (12.0_f64.next_up(), true));
        assert_eq!(nearest(12.0, |_| false), (12.0, false));
    }
}
