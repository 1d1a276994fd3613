//! Writes maps as PNG and EXR files.

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec, WritableImage,
};
use png::BitDepth;

use texere_core::Material;

use crate::{BakeError, Maps};

/// A map: its name, which is part of the names of its files, and its values.
pub(crate) struct Map<'a> {
    pub(crate) name: &'static str,
    /// Bits of each channel of a PNG.
    depth: BitDepth,
    values: Values<'a>,
}

enum Values<'a> {
    /// Linear colours from 0 to 1.
    Color(&'a [[f32; 3]]),
    /// Directions of length 1.
    Directions(&'a [[f32; 3]]),
    /// Numbers, and the two numbers that a PNG shows as black and as white.
    Scalar(&'a [f32], [f32; 2]),
    /// Numbers of yarns.
    Yarns(&'a [u32]),
    /// Places on yarns, two numbers each, and for each of the two the number that a PNG shows as
    /// white.
    Places(&'a [[f32; 2]], [f32; 2]),
}

impl<'a> Map<'a> {
    /// All maps of a side. `heights` are the two heights that a PNG of displacement shows as black
    /// and as white, mm. `longest` is the distance along a yarn that a PNG shows as white, mm.
    pub(crate) fn all(maps: &'a Maps, heights: [f32; 2], longest: f32) -> [Self; 8] {
        let map = |name, depth, values| Map { name, depth, values };
        let (eight, sixteen) = (BitDepth::Eight, BitDepth::Sixteen);
        [
            map("basecolor", eight, Values::Color(&maps.color)),
            map("alpha", eight, Values::Scalar(&maps.alpha, [0.0, 1.0])),
            map("normal", sixteen, Values::Directions(&maps.normal)),
            map("displacement", sixteen, Values::Scalar(&maps.height, heights)),
            map("roughness", eight, Values::Scalar(&maps.roughness, [0.0, 1.0])),
            map("occlusion", eight, Values::Scalar(&maps.occlusion, [0.0, 1.0])),
            map("yarn", eight, Values::Yarns(&maps.yarn)),
            map("uv", sixteen, Values::Places(&maps.uv, [1.0, longest])),
        ]
    }

    /// Writes the map as a PNG of red, green and blue, the kind that every reader of U3M knows.
    /// `texel_mm` is the size of a texel.
    pub(crate) fn png(&self, path: &Path, size: [u32; 2], texel_mm: [f64; 2]) -> Result<(), BakeError> {
        let failed =
            |source: Box<dyn Error + Send + Sync>| BakeError::Image { path: path.to_owned(), source };
        let write = || {
            let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), size[0], size[1]);
            encoder.set_color(png::ColorType::Rgb);
            encoder.set_depth(self.depth);
            if matches!(self.values, Values::Color(_)) {
                encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
            }
            let [xppu, yppu] = texel_mm.map(|mm| (1000.0 / mm).round().min(f64::from(u32::MAX)) as u32);
            encoder.set_pixel_dims(Some(png::PixelDimensions { xppu, yppu, unit: png::Unit::Meter }));
            let mut writer = encoder.write_header()?;
            writer.write_image_data(&self.bytes())?;
            writer.finish()?;
            Ok::<(), Box<dyn Error + Send + Sync>>(())
        };
        write().map_err(failed)
    }

    /// Red, green and blue of all texels, one or two bytes a channel.
    fn bytes(&self) -> Vec<u8> {
        let is_deep = self.depth == BitDepth::Sixteen;
        let level = |share: f32| {
            let share = f64::from(share.clamp(0.0, 1.0));
            if is_deep { (share * 65_535.0).round() as u16 } else { (share * 255.0).round() as u16 }
        };
        let all: Vec<[u16; 3]> = match &self.values {
            Values::Color(colors) => {
                colors.iter().map(|color| color.map(|linear| level(Material::encoded(linear)))).collect()
            }
            Values::Directions(directions) => {
                directions.iter().map(|direction| direction.map(|axis| level(axis * 0.5 + 0.5))).collect()
            }
            Values::Scalar(numbers, [low, high]) => {
                let range = (high - low).max(f32::MIN_POSITIVE);
                numbers.iter().map(|number| [level((number - low) / range); 3]).collect()
            }
            // The number plus 1 in 24 bits, the lowest ones in red. 0 stands for no yarn.
            Values::Yarns(numbers) => numbers
                .iter()
                .map(|number| {
                    let [red, green, blue, _] = number.wrapping_add(1).to_le_bytes();
                    [red, green, blue].map(u16::from)
                })
                .collect(),
            Values::Places(places, most) => places
                .iter()
                .map(|place| {
                    let share = |axis: usize| level(place[axis] / most[axis].max(f32::MIN_POSITIVE));
                    [share(0), share(1), 0]
                })
                .collect(),
        };
        let bytes = |level: u16| level.to_be_bytes().into_iter().skip(usize::from(!is_deep));
        all.as_flattened().iter().copied().flat_map(bytes).collect()
    }

    /// Writes the map as an EXR of floats, or of whole numbers for yarns.
    pub(crate) fn exr(&self, path: &Path, size: [u32; 2]) -> Result<(), BakeError> {
        let channel = |name: &str, values: FlatSamples| AnyChannel::new(name, values);
        let part = |values: &[[f32; 3]], axis: usize| {
            FlatSamples::F32(values.iter().map(|value| value[axis]).collect())
        };
        let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = match &self.values {
            Values::Color(values) | Values::Directions(values) => ["R", "G", "B"]
                .into_iter()
                .enumerate()
                .map(|(axis, name)| channel(name, part(values, axis)))
                .collect(),
            Values::Scalar(values, _) => {
                [channel("Y", FlatSamples::F32(values.to_vec()))].into_iter().collect()
            }
            Values::Yarns(values) => [channel("Y", FlatSamples::U32(values.to_vec()))].into_iter().collect(),
            Values::Places(values, _) => ["U", "V"]
                .into_iter()
                .enumerate()
                .map(|(axis, name)| {
                    channel(name, FlatSamples::F32(values.iter().map(|value| value[axis]).collect()))
                })
                .collect(),
        };
        let size = (size[0] as usize, size[1] as usize);
        let layer = Layer::new(
            size,
            LayerAttributes::named(self.name),
            Encoding::SMALL_LOSSLESS,
            AnyChannels::sort(channels),
        );
        let written = Image::from_layer(layer).write().to_file(path);
        written.map_err(|source| BakeError::Image { path: path.to_owned(), source: source.into() })
    }
}
