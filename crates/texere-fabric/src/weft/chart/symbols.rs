//! Reading and writing one row of a chart's symbols.

use super::{Cell, ChartError};

/// All symbols, for messages.
const KNOWN: &str = "k, p, b, t, u, m, <, > and cables such as RRrr or llLL";

/// The most symbols that a message shows.
const SHOWN: usize = 20;

/// Reads row `row`, counted from 0 at the top, and appends its cells. `symbol` gives the symbol at
/// a column and a row.
pub(super) fn read(
    wales: usize,
    row: usize,
    symbol: &impl Fn(usize, usize) -> char,
    cells: &mut Vec<Cell>,
) -> Result<(), ChartError> {
    let mut column = 0;
    while column < wales {
        let letter = symbol(column, row);
        let cell = match letter {
            'k' => Cell::Knit,
            'p' => Cell::Purl,
            'b' => Cell::Both,
            't' => Cell::Tuck,
            'u' => Cell::BackTuck,
            'm' => Cell::Miss,
            '<' => Cell::Moved { by: -1, behind: false },
            '>' => Cell::Moved { by: 1, behind: false },
            'R' | 'r' | 'L' | 'l' => {
                let run = |from: usize, letter: char| {
                    (from..wales).take_while(|&column| symbol(column, row) == letter).count()
                };
                // The half of a cable that is written in capitals goes in front.
                let right_half = if letter == 'R' { 'r' } else { 'L' };
                let left = run(column, letter);
                let right = run(column + left, right_half);
                if right == 0 || matches!(letter, 'r' | 'L') {
                    let symbols =
                        (column..column + left.min(SHOWN)).map(|column| symbol(column, row)).collect();
                    return Err(ChartError::HalfCable { row: row + 1, column: column + 1, symbols });
                }
                let behind = letter == 'l';
                let goes_right = Cell::Moved { by: right as i32, behind };
                let goes_left = Cell::Moved { by: -(left as i32), behind: !behind };
                cells.extend(std::iter::repeat_n(goes_right, left));
                cells.extend(std::iter::repeat_n(goes_left, right));
                column += left + right;
                continue;
            }
            symbol => {
                return Err(ChartError::Symbol { row: row + 1, column: column + 1, symbol, known: KNOWN });
            }
        };
        cells.push(cell);
        column += 1;
    }
    Ok(())
}

/// The symbols of `cells`, which are a row from left to right. None if a loop moves in a way that
/// no symbol stands for.
pub(super) fn written(cells: &[Cell]) -> Option<String> {
    let (mut text, mut rest) = (String::new(), cells);
    while let Some(&cell) = rest.first() {
        // Cells that are alike are taken together, so that a long row of moved loops takes no more
        // time for each of them than a short one.
        let alike = rest.iter().take_while(|other| **other == cell).count();
        let (before, after) = rest.split_at(alike);
        rest = after;
        let symbol = match cell {
            Cell::Knit => 'k',
            Cell::Purl => 'p',
            Cell::Both => 'b',
            Cell::Tuck => 't',
            Cell::BackTuck => 'u',
            Cell::Miss => 'm',
            Cell::Moved { by, behind } => {
                let [left, right] = cable(before.len(), by, behind, after).unwrap_or([0, 0]);
                let single = match (by, behind) {
                    (-1, false) => Some('<'),
                    (1, false) => Some('>'),
                    _ => None,
                };
                if left < alike {
                    text.extend(std::iter::repeat_n(single?, alike - left));
                }
                let [one, other] = if behind { ['l', 'L'] } else { ['R', 'r'] };
                text.extend(std::iter::repeat_n(one, left));
                text.extend(std::iter::repeat_n(other, right));
                rest = &after[right..];
                continue;
            }
        };
        text.extend(std::iter::repeat_n(symbol, alike));
    }
    Some(text)
}

/// The numbers of loops in both halves of a cable. `alike` cells in a row hold loops that move by
/// `by` needles, and the last of these cells are the left half. The first cells of `after` are the
/// right half. None if they are no cable.
fn cable(alike: usize, by: i32, behind: bool, after: &[Cell]) -> Option<[usize; 2]> {
    let Some(&Cell::Moved { by: back, behind: other }) = after.first() else { return None };
    let (left, right) = (usize::try_from(-back).ok()?, usize::try_from(by).ok()?);
    let half = after.get(..right)?;
    let is_cable = (1..=alike).contains(&left)
        && right > 0
        && other != behind
        && half.iter().all(|cell| *cell == half[0]);
    is_cable.then_some([left, right])
}
