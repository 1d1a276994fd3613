//! Reads polylines of OBJ files: yarns that other programs made.
//!
//! An OBJ file is text with a statement on each line. Two kinds of statements count here: `v x y z`
//! is a vertex, and `l 1 2 3` is a polyline through vertices, which are numbered in the order of
//! the file (Wavefront, Advanced Visualizer manual, appendix B1). All other statements are passed
//! over: faces, normals, groups and materials.

use std::path::Path;

use texere_core::backend::room_for;
use texere_core::{ControlPoint, Layout, Material, Section, Yarn, Yarns};

use super::ReadError;
use super::curve_scale::CurveScale;

/// Reads the polylines of an OBJ file. Each yarn is round.
pub(super) fn polylines(file: &Path, bytes: &[u8], scale: CurveScale) -> Result<Yarns, ReadError> {
    let mut words = Words { bytes, at: 0 };
    let mut lines = Polylines { offsets: vec![0], ..Polylines::default() };
    loop {
        match words.next().map(|word| word.text) {
            Some(b"v") => lines.vertex(file, &mut words)?,
            Some(b"l") => lines.polyline(file, &mut words)?,
            _ => {}
        }
        if !words.end_statement() {
            break;
        }
    }
    lines.yarns(file, scale)
}

/// What has been read of a file.
#[derive(Debug, Default)]
struct Polylines {
    vertices: Vec<[f32; 3]>,
    /// The vertices of all yarns, counted from 0.
    corners: Vec<u32>,
    /// The place of each yarn's first vertex in `corners`, and at the end the length of `corners`.
    offsets: Vec<u64>,
    yarns: Vec<Yarn>,
}

impl Polylines {
    /// The rest of a statement `v x y z`. Weights and colours may follow, and are passed over.
    fn vertex(&mut self, file: &Path, words: &mut Words<'_>) -> Result<(), ReadError> {
        let mut axes = [0.0; 3];
        for axis in &mut axes {
            let word = words.next();
            let number = word.and_then(Word::number).filter(|number: &f32| number.is_finite());
            *axis = number.ok_or_else(|| words.refused(file, word, "a coordinate"))?;
        }
        room_for(&mut self.vertices, 1, "vertices")?;
        self.vertices.push(axes);
        Ok(())
    }

    /// The rest of a statement `l 1 2 3`. A polyline that begins where the one before it ended
    /// continues the same yarn, because some programs write an edge at a time. A yarn that comes
    /// back to its first vertex is closed.
    fn polyline(&mut self, file: &Path, words: &mut Words<'_>) -> Result<(), ReadError> {
        let mut count = 0;
        while let Some(word) = words.next() {
            let corner = self.corner(word).ok_or_else(|| {
                let all = self.vertices.len();
                words.refused(file, Some(word), &format!("a vertex from 1 to {all}, or from -{all} to -1"))
            })?;
            if count == 0 && !self.goes_on_from(corner) {
                room_for(&mut self.yarns, 1, "yarns")?;
                room_for(&mut self.offsets, 1, "yarns")?;
                self.yarns.push(Yarn::default());
                self.offsets.push(self.corners.len() as u64);
                self.push(corner)?;
            } else if count > 0 {
                self.push(corner)?;
            }
            count += 1;
        }
        if count < 2 {
            return Err(words.refused(file, None, "two vertices or more"));
        }
        let first = self.offsets[self.offsets.len() - 2] as usize;
        let (own, yarn) = (&self.corners[first..], self.yarns.last_mut());
        if let Some(yarn) = yarn.filter(|_| own.len() > 3 && own.first() == own.last()) {
            yarn.closed = true;
            self.corners.pop();
        }
        if let Some(end) = self.offsets.last_mut() {
            *end = self.corners.len() as u64;
        }
        Ok(())
    }

    /// The vertex that a word such as `3`, `-1` or `3/7` names, counted from 0.
    fn corner(&self, word: Word<'_>) -> Option<u32> {
        let number = Word { text: word.text.split(|&byte| byte == b'/').next()?, ..word }.number::<i64>()?;
        let all = self.vertices.len() as i64;
        let corner = if number < 0 { all.checked_add(number)? } else { number - 1 };
        (0..all).contains(&corner).then(|| u32::try_from(corner).ok())?
    }

    fn goes_on_from(&self, corner: u32) -> bool {
        self.corners.last() == Some(&corner) && self.yarns.last().is_some_and(|yarn| !yarn.closed)
    }

    fn push(&mut self, corner: u32) -> Result<(), ReadError> {
        room_for(&mut self.corners, 1, "control points")?;
        self.corners.push(corner);
        Ok(())
    }

    fn yarns(self, file: &Path, scale: CurveScale) -> Result<Yarns, ReadError> {
        if self.yarns.is_empty() {
            let needed_for = "each yarn is a polyline";
            return Err(ReadError::MissingKey {
                file: file.into(),
                field: "the statement l".into(),
                needed_for,
            });
        }
        let [unit, diameter] = scale.given(file)?;
        let mut points = Vec::new();
        room_for(&mut points, self.corners.len(), "control points")?;
        points.extend(self.corners.iter().map(|&corner| {
            let [x, y, z] = self.vertices[corner as usize].map(|axis| axis * unit);
            ControlPoint::new(x, y, z, diameter / 2.0)
        }));
        let unsound = |source| ReadError::Yarns { file: file.into(), source };
        let layout = Layout::new(self.yarns, self.offsets, vec![Section::Circle]).map_err(unsound)?;
        Yarns::new(layout, vec![Material::default()], points).map_err(unsound)
    }
}

/// A word of a statement.
#[derive(Debug, Clone, Copy)]
struct Word<'a> {
    text: &'a [u8],
    /// The place of its first byte in the file.
    at: usize,
}

impl Word<'_> {
    fn number<T: std::str::FromStr>(self) -> Option<T> {
        std::str::from_utf8(self.text).ok()?.parse().ok()
    }
}

/// The words of a file's statements. A backslash at the end of a line joins the line to the next
/// one, and `#` begins a comment.
#[derive(Debug)]
struct Words<'a> {
    bytes: &'a [u8],
    /// The place of the next byte in the file.
    at: usize,
}

impl<'a> Words<'a> {
    /// The next word of the statement.
    fn next(&mut self) -> Option<Word<'a>> {
        loop {
            let left = &self.bytes[self.at..];
            if let Some(end) = joint(left) {
                self.at += end;
            } else {
                match left.first()? {
                    b'\n' => return None,
                    b'#' => self.at += left.iter().position(|&byte| byte == b'\n').unwrap_or(left.len()),
                    byte if byte.is_ascii_whitespace() => self.at += 1,
                    _ => break,
                }
            }
        }
        let (left, at) = (&self.bytes[self.at..], self.at);
        let ends = |at: &usize| {
            left[*at].is_ascii_whitespace() || left[*at] == b'#' || joint(&left[*at..]).is_some()
        };
        let length = (0..left.len()).find(ends).unwrap_or(left.len());
        self.at += length;
        Some(Word { text: &left[..length], at })
    }

    /// Passes over the rest of the statement. Returns whether there is another line.
    fn end_statement(&mut self) -> bool {
        while self.next().is_some() {}
        if self.at == self.bytes.len() {
            return false;
        }
        self.at += 1;
        true
    }

    /// The refusal of a word, or of a statement that ends too early.
    fn refused(&self, file: &Path, word: Option<Word<'_>>, expected: &str) -> ReadError {
        let Word { text, at } = word.unwrap_or(Word { text: &[], at: self.at });
        ReadError::word(file, self.bytes, at, &String::from_utf8_lossy(text), expected.into())
    }
}

/// The number of bytes of a backslash and the end of the line after it, if `bytes` begin with
/// these.
fn joint(bytes: &[u8]) -> Option<usize> {
    match bytes {
        [b'\\', b'\n', ..] => Some(2),
        [b'\\', b'\r', b'\n', ..] => Some(3),
        _ => None,
    }
}
