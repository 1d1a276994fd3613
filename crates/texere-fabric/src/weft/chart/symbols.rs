//! Reading one row of a chart's symbols.

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
