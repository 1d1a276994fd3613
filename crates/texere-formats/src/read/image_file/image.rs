//! An image in memory.

/// An image as its decoder gives it, and how it is turned. Its size is within the limits that
/// `limits.rs` sets.
pub(crate) struct Image {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Channels of a pixel: grey, or red, green and blue, and perhaps opacity.
    pub(super) channels: usize,
    /// The stored pixels, row by row from the top, each channel in the machine's order of bytes.
    pub(super) bytes: Vec<u8>,
    pub(super) orientation: Orientation,
}

/// The turn of an image before it is shown, as TIFF and Exif number it: 1 no turn, 2 mirrored left
/// to right, 3 half a turn, 4 mirrored top to bottom, 5 mirrored at the diagonal from top left to
/// bottom right, 6 a quarter turn clockwise, 7 mirrored at the diagonal from bottom left to top
/// right, 8 a quarter turn counter-clockwise. Other numbers turn nothing.
///
/// **Source**: TIFF revision 6.0, Adobe 1992, page 36.
#[derive(Debug, Clone, Copy)]
pub(super) struct Orientation(pub(super) u16);

impl Orientation {
    /// Whether stored rows are shown as columns.
    fn swaps(self) -> bool {
        (5..=8).contains(&self.0)
    }

    /// The column and the row, in a stored image of this size, of the pixel that is shown at
    /// `column` and `row`.
    fn stored(self, [width, height]: [usize; 2], [column, row]: [usize; 2]) -> [usize; 2] {
        let [across, down] = if self.swaps() { [row, column] } else { [column, row] };
        let across = if [2, 3, 7, 8].contains(&self.0) { width - 1 - across } else { across };
        let down = if [3, 4, 6, 7].contains(&self.0) { height - 1 - down } else { down };
        [across, down]
    }
}

impl Image {
    /// Width and height of the image as it is shown.
    pub(crate) fn size(&self) -> [usize; 2] {
        let size = [self.width, self.height];
        if self.orientation.swaps() { [size[1], size[0]] } else { size }
    }

    /// Red, green, blue and opacity of each pixel of the image as it is shown, row by row from the
    /// top.
    pub(crate) fn pixels(&self) -> impl Iterator<Item = [u8; 4]> {
        let channels = self.channels;
        let width = self.bytes.len() / (self.width * self.height * channels);
        let shown = self.size();
        (0..self.width * self.height).map(move |place| {
            let place = [place % shown[0], place / shown[0]];
            let [column, row] = self.orientation.stored([self.width, self.height], place);
            let pixel = &self.bytes[(row * self.width + column) * width * channels..];
            let channel = |number: usize| match pixel[number * width..][..width] {
                [byte] => byte,
                // From a range of 65,535 to a range of 255, rounded.
                [low, high] => ((u32::from(u16::from_ne_bytes([low, high])) + 128) / 257) as u8,
                [a, b, c, d] => (f32::from_ne_bytes([a, b, c, d]).clamp(0.0, 1.0) * 255.0).round() as u8,
                _ => 0,
            };
            match channels {
                1 => [channel(0), channel(0), channel(0), u8::MAX],
                2 => [channel(0), channel(0), channel(0), channel(1)],
                3 => [channel(0), channel(1), channel(2), u8::MAX],
                _ => [channel(0), channel(1), channel(2), channel(3)],
            }
        })
    }
}
