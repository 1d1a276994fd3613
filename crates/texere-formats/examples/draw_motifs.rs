//! Draws the point papers in `designs/`: an ogee lattice with a pomegranate in each of its fields,
//! lozenges and an ornament for knits, rings for Jacquard bars, a stitched double cloth, and a
//! double cloth with discs.
//!
//! `cargo run -p texere-formats --example draw_motifs` writes them to that folder. They are
//! computed from sums, products and square roots alone, so that every machine draws the same
//! pictures. Shapes, widths and radii are by eye. The test below compares the files with what is
//! drawn here.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

/// A point in the units of [`REPEAT`]. The origin is the middle of the pomegranate. y points up.
type Point = [f64; 2];

/// Width and height of a repeat, in the units of [`Point`]. [`Paper::disc`] scales them to pixels.
const REPEAT: [f64; 2] = [240.0, 320.0];

/// Steps along a stroke. They are finer than pixels at every size drawn here.
const STEPS: usize = 600;

/// The part of the motif that a pixel belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Tone {
    Ground,
    Figure,
    Shade,
}

/// How the width of a stroke changes along it, t from 0 to 1.
#[derive(Clone, Copy)]
enum Profile {
    /// Widest at a third, pointed at its end.
    Leaf,
    /// A leaf with this number of teeth.
    Acanthus(f64),
    /// An oval.
    Fruit,
    /// Thin at both ends.
    Vine,
    /// Thick at its start and thin at its end, where it is still several threads wide.
    Vein,
}

impl Profile {
    fn at(self, t: f64) -> f64 {
        let leaf = 2.6 * t.sqrt() * (1.0 - t);
        match self {
            Self::Leaf => leaf,
            Self::Acanthus(teeth) => leaf * (1.0 - 0.42 * (1.0 - t) * (t * teeth).fract()),
            Self::Fruit => (4.0 * t * (1.0 - t)).sqrt(),
            Self::Vine => 0.45 + 0.55 * 4.0 * t * (1.0 - t),
            Self::Vein => 1.0 - 0.6 * t,
        }
    }
}

/// A repeat on paper. A shape that leaves the paper on one side comes in on the other.
struct Paper {
    size: [usize; 2],
    pixels: Vec<Tone>,
}

impl Paper {
    fn new(size: [usize; 2]) -> Self {
        Self { size, pixels: vec![Tone::Ground; size[0] * size[1]] }
    }

    /// Paints a disc of `radius` round `centre` twice, in a half-drop repeat: with the origin at
    /// the middle of the paper, and shifted by half the paper in both directions.
    fn disc(&mut self, centre: Point, radius: f64, tone: Tone) {
        let scale = [self.size[0] as f64 / REPEAT[0], self.size[1] as f64 / REPEAT[1]];
        let radius = radius * scale[0];
        for half in [0.5, 1.0] {
            let x = centre[0] * scale[0] + half * self.size[0] as f64;
            let y = half * self.size[1] as f64 - centre[1] * scale[1];
            for row in (y - radius).floor() as i64..=(y + radius).ceil() as i64 {
                for column in (x - radius).floor() as i64..=(x + radius).ceil() as i64 {
                    let (dx, dy) = (column as f64 + 0.5 - x, row as f64 + 0.5 - y);
                    if dx * dx + dy * dy <= radius * radius {
                        let column = column.rem_euclid(self.size[0] as i64) as usize;
                        let row = row.rem_euclid(self.size[1] as i64) as usize;
                        self.pixels[row * self.size[0] + column] = tone;
                    }
                }
            }
        }
    }

    /// Paints a stroke along a Bézier curve, and the stroke's mirror image about x = 0. `profile`
    /// scales `width`, half the width of the stroke.
    fn stroke(&mut self, spine: [Point; 4], width: f64, profile: Profile, tone: Tone) {
        for step in 0..=STEPS {
            let t = step as f64 / STEPS as f64;
            let [x, y] = bezier(spine, t);
            let radius = width * profile.at(t);
            self.disc([x, y], radius, tone);
            self.disc([-x, y], radius, tone);
        }
    }

    /// Paints a leaf with a rim of ground and a midrib.
    fn leaf(&mut self, spine: [Point; 4], width: f64, profile: Profile, rib: Tone) {
        self.stroke(spine, width + 2.6, Profile::Leaf, Tone::Ground);
        self.stroke(spine, width, profile, Tone::Figure);
        self.stroke(part(spine, 0.06, 0.86), width * 0.16 + 0.5, Profile::Vein, rib);
    }

    fn rosette(&mut self, centre: Point, radius: f64) {
        // Five petals: the cosines and sines of 90, 18 and -54 degrees, and their mirror images.
        let petals = [[0.0, 1.0], [0.951_056_5, 0.309_017], [0.587_785_3, -0.809_017]];
        for (grown, tone) in [(2.4, Tone::Ground), (0.0, Tone::Figure)] {
            for [x, y] in petals {
                for side in [-1.0, 1.0] {
                    let at = [centre[0] + side * x * radius * 0.62, centre[1] + y * radius * 0.62];
                    self.disc(at, radius * 0.44 + grown, tone);
                }
            }
        }
        self.disc(centre, radius * 0.36, Tone::Shade);
        self.disc(centre, radius * 0.17, Tone::Figure);
    }
}

/// The point at `t` of a cubic Bézier curve.
fn bezier(spine: [Point; 4], t: f64) -> Point {
    let s = 1.0 - t;
    let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    [0, 1].map(|axis| (0..4).map(|k| weights[k] * spine[k][axis]).sum())
}

/// The part of a Bézier curve between two of its parameters.
fn part(spine: [Point; 4], from: f64, to: f64) -> [Point; 4] {
    let mix = |a: Point, b: Point, t: f64| [0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * t);
    // The blossom of the curve (its polar form): each step of de Casteljau's construction uses a
    // parameter of its own, u, then v, then w.
    let blossom = |u: f64, v: f64, w: f64| {
        let [a, b, c] = [0, 1, 2].map(|k| mix(spine[k], spine[k + 1], u));
        mix(mix(a, b, v), mix(b, c, v), w)
    };
    [blossom(from, from, from), blossom(from, from, to), blossom(from, to, to), blossom(to, to, to)]
}

/// The ornament. Parts that lie behind are painted first.
fn ornament(size: [usize; 2]) -> Paper {
    use Profile::{Acanthus, Fruit, Leaf, Vine};
    use Tone::{Figure, Ground, Shade};
    let mut paper = Paper::new(size);

    // The lattice: two vines start at the bottom of a field and curve outwards. At each side a vine
    // meets that of the next field, in a rosette.
    let vine = [[0.0, -160.0], [12.0, -108.0], [108.0, -52.0], [120.0, 0.0]];
    for t in [0.24, 0.42, 0.60] {
        let [x, y] = bezier(vine, t);
        let spine = [[x, y], [x + 6.0, y - 9.0], [x + 17.0, y - 9.0], [x + 22.0, y + 2.0]];
        paper.leaf(spine, 5.0, Leaf, Figure);
    }
    paper.stroke(vine, 5.4, Vine, Ground);
    paper.stroke(vine, 3.4, Vine, Figure);
    paper.rosette([120.0, 0.0], 16.0);

    // The stem with its great leaves.
    paper.leaf([[0.0, -120.0], [10.0, -124.0], [25.0, -114.0], [25.0, -97.0]], 5.0, Leaf, Figure);
    paper.stroke([[0.0, -146.0], [0.0, -120.0], [0.0, -80.0], [0.0, -40.0]], 3.4, Vine, Figure);
    paper.leaf([[0.0, -76.0], [34.0, -90.0], [76.0, -50.0], [90.0, 8.0]], 14.0, Acanthus(8.0), Shade);
    paper.leaf([[0.0, -58.0], [34.0, -60.0], [62.0, -24.0], [60.0, 18.0]], 11.0, Acanthus(7.0), Ground);

    // The petals round the fruit.
    paper.leaf([[0.0, -30.0], [46.0, -26.0], [70.0, 14.0], [60.0, 48.0]], 13.0, Leaf, Shade);
    paper.leaf([[0.0, -24.0], [40.0, -16.0], [56.0, 36.0], [36.0, 78.0]], 13.0, Leaf, Shade);
    paper.leaf([[0.0, 20.0], [12.0, 50.0], [16.0, 84.0], [9.0, 116.0]], 9.0, Leaf, Figure);
    paper.leaf([[0.0, 30.0], [0.0, 70.0], [0.0, 100.0], [0.0, 134.0]], 9.0, Leaf, Shade);

    // The fruit, with a net of seeds, in its husk.
    let fruit = [[0.0, -40.0], [0.0, -14.0], [0.0, 30.0], [0.0, 62.0]];
    paper.stroke(fruit, 32.5, Fruit, Ground);
    paper.stroke(fruit, 30.0, Fruit, Figure);
    paper.stroke(part(fruit, 0.07, 0.93), 24.0, Fruit, Shade);
    for row in 0..7 {
        let y = -20.0 + 10.0 * f64::from(row);
        let across: &[f64] = if row % 2 == 0 { &[0.0, 11.5] } else { &[5.75, 17.25] };
        for &x in across.iter().filter(|&&x| x < 12.0 || (1..6).contains(&row)) {
            for side in [-1.0, 1.0] {
                paper.disc([side * x, y], 3.5, Figure);
            }
        }
    }
    paper.leaf([[0.0, -58.0], [18.0, -56.0], [40.0, -34.0], [33.0, -2.0]], 8.0, Leaf, Figure);
    paper.leaf([[0.0, -58.0], [4.0, -46.0], [8.0, -30.0], [0.0, -12.0]], 7.0, Leaf, Ground);

    paper
}

/// Nested lozenges for a knitted Jacquard. Each row has both colours, and no colour runs on for
/// more than five wales.
fn lozenges([width, height]: [usize; 2]) -> Paper {
    let mut paper = Paper::new([width, height]);
    for (place, tone) in paper.pixels.iter_mut().enumerate() {
        let [across, along] =
            [(place % width, width), (place / width, height)].map(|(at, side)| at.min(side - at));
        if (across + along) % 6 < 3 {
            *tone = Tone::Figure;
        }
    }
    paper
}

/// A figure for a Jacquard bar: open places in the middle, a ring of thick places round them, and a
/// ground of thin places.
fn rings([width, height]: [usize; 2]) -> Paper {
    let mut paper = Paper::new([width, height]);
    for (place, tone) in paper.pixels.iter_mut().enumerate() {
        let [across, along] = [(place % width, width), (place / width, height)]
            .map(|(at, side)| (at as f32 + 0.5) / side as f32 * 2.0 - 1.0);
        *tone = match (across * across + along * along).sqrt() {
            away if away < 0.45 => Tone::Shade,
            away if away < 0.85 => Tone::Figure,
            _ => Tone::Ground,
        };
    }
    paper
}

/// The ornament for a knitted Jacquard. In figure and ground each fifth wale has the other colour,
/// shifted from row to row, so that floats stay short.
fn bound_ornament(size: [usize; 2]) -> Paper {
    let mut paper = ornament(size);
    for (place, tone) in paper.pixels.iter_mut().enumerate() {
        let binds = (place % size[0] + 2 * (place / size[0])).is_multiple_of(5);
        *tone = if (*tone == Tone::Figure) == binds { Tone::Ground } else { Tone::Figure };
    }
    paper
}

/// A stitched double cloth with a pixel for each crossing. Both layers are 2/2 twills. Ends and
/// picks alternate between face and back, beginning with the face.
///
/// A stitch lifts an end of the back over a pick of the face. Stitches hardly show, because they
/// lie where the neighbouring ends of the face float over that pick, and where the end of the back
/// floats over the picks of the back before and after.
fn double_twill([width, height]: [usize; 2]) -> Paper {
    let mut paper = Paper::new([width, height]);
    for (place, tone) in paper.pixels.iter_mut().enumerate() {
        let [end, pick] = [place % width, height - 1 - place / width];
        let step = (end / 2 + height - pick / 2) % 8;
        let up = match [end % 2, pick % 2] {
            [0, 0] | [1, 1] => step % 4 < 2,
            [0, _] => true,
            _ => step == 0 && (end / 2).is_multiple_of(4),
        };
        if up {
            *tone = Tone::Figure;
        }
    }
    paper
}

/// Every crossing of a double cloth of two plain layers, which change places in a disc. Ends and
/// picks belong to the two layers in turn.
fn figured_double([width, height]: [usize; 2]) -> Paper {
    let mut paper = Paper::new([width, height]);
    for (place, tone) in paper.pixels.iter_mut().enumerate() {
        let [end, pick] = [place % width, height - 1 - place / width];
        let [across, along] =
            [(end, width), (pick, height)].map(|(at, side)| (at as f32 + 0.5) / side as f32 * 2.0 - 1.0);
        let face = usize::from((across * across + along * along).sqrt() < 0.6);
        let up = if end % 2 == pick % 2 { (end / 2 + pick / 2).is_multiple_of(2) } else { end % 2 == face };
        if up {
            *tone = Tone::Figure;
        }
    }
    paper
}

/// A point paper that the repository holds.
struct Drawing {
    file: &'static str,
    size: [usize; 2],
    draw: fn([usize; 2]) -> Paper,
    /// Colours of ground, figure and shade. If only two are given, shade has the colour of ground.
    palette: &'static [[u8; 3]],
}

const DRAWINGS: [Drawing; 8] = [
    Drawing {
        file: "damask.png",
        size: [240, 320],
        draw: ornament,
        palette: &[[0xf4, 0xec, 0xdc], [0x6e, 0x1a, 0x2c], [0xc8, 0x8a, 0x5a]],
    },
    Drawing {
        file: "paper/figure-7a.png",
        size: [720, 920],
        draw: ornament,
        palette: &[[0xff, 0xff, 0xff], [0x1f, 0x4e, 0x79]],
    },
    Drawing {
        file: "paper/figure-7b.png",
        size: [400, 720],
        draw: bound_ornament,
        palette: &[[0xec, 0xe4, 0xd2], [0x8c, 0x2f, 0x39]],
    },
    Drawing {
        file: "double-cloth.png",
        size: [16, 16],
        draw: double_twill,
        palette: &[[0xff, 0xff, 0xff], [0x00, 0x00, 0x00]],
    },
    Drawing {
        file: "figured-double.png",
        size: [72, 72],
        draw: figured_double,
        palette: &[[0xff, 0xff, 0xff], [0x00, 0x00, 0x00]],
    },
    Drawing {
        file: "jacquard.png",
        size: [20, 24],
        draw: lozenges,
        palette: &[[0xec, 0xe4, 0xd2], [0x8c, 0x2f, 0x39]],
    },
    Drawing {
        file: "warp-jacquard.png",
        size: [24, 24],
        draw: rings,
        palette: &[[0xec, 0xe4, 0xd2], [0x8c, 0x2f, 0x39], [0x26, 0x40, 0x6e]],
    },
    Drawing {
        file: "paper/figure-7c.png",
        size: [315, 137],
        draw: ornament,
        palette: &[[0xec, 0xe4, 0xd2], [0x8c, 0x2f, 0x39], [0x26, 0x40, 0x6e]],
    },
];

impl Drawing {
    fn path(&self) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../designs").join(self.file)
    }

    /// The place of each pixel's colour in the palette, row by row from the top.
    fn pixels(&self) -> Vec<u8> {
        let tones = (self.draw)(self.size).pixels;
        tones.iter().map(|&tone| tone as u8 % self.palette.len() as u8).collect()
    }

    fn write(&self) -> Result<(), Box<dyn std::error::Error>> {
        let [width, height] = self.size;
        let (bits, depth) = match self.palette.len() {
            2 => (1, png::BitDepth::One),
            _ => (2, png::BitDepth::Two),
        };
        let file = BufWriter::new(File::create(self.path())?);
        let mut encoder = png::Encoder::new(file, width as u32, height as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(depth);
        encoder.set_palette(self.palette.concat());
        encoder.set_compression(png::Compression::High);
        let packed = self.pixels().chunks(width).flat_map(|row| pack(row, bits)).collect::<Vec<_>>();
        encoder.write_header()?.write_image_data(&packed)?;
        Ok(())
    }
}

/// Packs a row of numbers of `bits` bits each into bytes. The first number of a byte is in its
/// highest bits.
fn pack(row: &[u8], bits: usize) -> Vec<u8> {
    let byte = |numbers: &[u8]| {
        numbers.iter().enumerate().fold(0, |byte, (place, number)| byte | number << (8 - bits * (place + 1)))
    };
    row.chunks(8 / bits).map(byte).collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for drawing in DRAWINGS {
        drawing.write()?;
        println!("{}", drawing.path().display());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_repository_holds_what_is_drawn() {
        for drawing in DRAWINGS {
            let image = image::open(drawing.path()).unwrap().to_rgb8();
            assert_eq!([image.width() as usize, image.height() as usize], drawing.size);
            let drawn = drawing.pixels();
            for (place, (pixel, number)) in image.pixels().zip(drawn).enumerate() {
                assert_eq!(pixel.0, drawing.palette[number as usize], "{}, pixel {place}", drawing.file);
            }
        }
    }
}
