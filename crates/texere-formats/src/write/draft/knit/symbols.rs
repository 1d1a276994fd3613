//! Symbols of a stitch chart, as knitters draw them.

use super::grid::Symbol;

/// Whether a pixel of a square is inked. `side` is the length of the square's sides, pixels.
pub(super) fn inked(symbol: Symbol, [x, y]: [usize; 2], side: usize) -> bool {
    // Coordinates in the square go from -1 at the left and at the bottom to 1.
    let unit = |at: usize| (2.0 * at as f32 + 1.0) / side as f32 - 1.0;
    let (u, v) = (unit(x), -unit(y));
    let stroke = (2.5 / side as f32).max(0.16);
    let ring = |radius: f32, up: f32| (u.hypot(v - up) - radius).abs() < stroke;
    let arch = |v: f32| {
        if v > 0.0 { (u.hypot(v) - 0.5).abs() < stroke } else { (u.abs() - 0.5).abs() < stroke && v > -0.7 }
    };
    match symbol {
        Symbol::Knit => false,
        Symbol::Purl => u.hypot(v) < 0.3,
        Symbol::Both => u.abs() < stroke && v.abs() < 0.7,
        Symbol::YarnOver => ring(0.5, 0.0),
        Symbol::Tuck => arch(v),
        Symbol::BackTuck => arch(-v),
        Symbol::Miss => v.abs() < stroke && u.abs() < 0.7,
        Symbol::Moved { right, behind } => {
            let along = if right { u + v } else { u - v };
            let across = if right { u - v } else { u + v };
            let hidden = behind == Some(true) && along.abs() < 0.7;
            let wide = if behind == Some(false) { 2.0 * stroke } else { stroke };
            across.abs() < wide && along.abs() < 1.6 && !hidden
        }
    }
}
