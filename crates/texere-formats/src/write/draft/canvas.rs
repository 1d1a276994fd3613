//! Pixels that lines, dots and rings are drawn on.

use super::sheet::{PAPER, Rgb};

/// Half the width of a line, pixels.
const STROKE: f64 = 1.0;

/// The brightest yarn, as a sum of its channels, that is drawn in its own colour. Brighter yarns
/// are drawn darker, so that they show on paper.
const BRIGHT: u32 = 480;

/// The sum of the channels that brighter yarns are darkened to.
const SHOWN: u32 = 320;

/// A drawing as pixels, with (0, 0) at its top left. Parts beyond its edges are cut off.
#[derive(Debug)]
pub(super) struct Canvas {
    /// Width and height, pixels.
    pub(super) size: [usize; 2],
    pixels: Vec<Rgb>,
}

impl Canvas {
    pub(super) fn new(size: [usize; 2]) -> Self {
        Self { size, pixels: vec![PAPER; size[0] * size[1]] }
    }

    /// A pixel's colour.
    pub(super) fn pixel(&self, x: usize, y: usize) -> Rgb {
        self.pixels[y * self.size[0] + x]
    }

    pub(super) fn ring(&mut self, center: [f64; 2], radius: f64, color: Rgb) {
        self.near(center, radius + STROKE, color, |distance| (distance - radius).abs() < STROKE);
    }

    pub(super) fn dot(&mut self, center: [f64; 2], radius: f64, color: Rgb) {
        self.near(center, radius, color, |distance| distance < radius);
    }

    pub(super) fn line(&mut self, from: [f64; 2], to: [f64; 2], color: Rgb) {
        let steps = (to[0] - from[0]).abs().max((to[1] - from[1]).abs()).ceil().max(1.0);
        for step in 0..=steps as u32 {
            let share = f64::from(step) / steps;
            self.dot([0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis])), STROKE, color);
        }
    }

    /// Colours the pixels for whose distance from a point `inside` holds. Only pixels within
    /// `reach` of the point are looked at.
    fn near(&mut self, [x, y]: [f64; 2], reach: f64, color: Rgb, inside: impl Fn(f64) -> bool) {
        let range = |at: f64, side: usize| {
            let end = (at + reach + 1.0).clamp(0.0, side as f64) as usize;
            (at - reach).clamp(0.0, side as f64) as usize..end
        };
        for row in range(y, self.size[1]) {
            for column in range(x, self.size[0]) {
                if inside((column as f64 + 0.5 - x).hypot(row as f64 + 0.5 - y)) {
                    self.pixels[row * self.size[0] + column] = color;
                }
            }
        }
    }
}

/// A yarn's colour, dark enough for paper.
pub(super) fn on_paper(color: Rgb) -> Rgb {
    let bright = color.iter().map(|&channel| u32::from(channel)).sum::<u32>();
    if bright > BRIGHT { color.map(|channel| (u32::from(channel) * SHOWN / bright) as u8) } else { color }
}
