//! The mode `TRIANGLES`: most triangles take one byte. The byte names an edge that came shortly
//! before. It also says that the third corner is new, or names a corner that came before.

use std::io::{self, Write};

use super::zigzag;

/// The number of edges that a code can name.
const EDGES: usize = 15;

/// The code of a triangle with a named edge can name a corner by its age, which has to be less than
/// this number: 1 for the second newest corner, 2 for the third newest, and so on. The newest
/// corner can't be named so, because the code 0 stands for a new corner.
const CORNERS_BESIDE_EDGE: usize = 13;

/// The number of corners that the code of a triangle without a named edge can name.
const CORNERS_ALONE: usize = 14;

/// The code of a new corner. New corners have the numbers 0, 1, 2 and so on, as they come.
const NEW: u8 = 0;
/// The code of a corner whose number is one less than the encoder's `last` number.
const ONE_LESS: u8 = 13;
/// The code of a corner whose number is one more than the encoder's `last` number.
const ONE_MORE: u8 = 14;
/// The code of a corner whose number is written out.
const WRITTEN_OUT: u8 = 15;

/// An encoder of lists of triangles. The stream is the [start](Self::START), the codes of all
/// triangles, the further bytes of all triangles, and the [end](Self::END).
#[derive(Debug)]
pub(in crate::write::glb) struct TriangleEncoder {
    edges: Newest<[u32; 2]>,
    corners: Newest<u32>,
    /// The number of the next new corner.
    next: u32,
    /// The number of the last corner with one of the codes [`ONE_LESS`], [`ONE_MORE`] and
    /// [`WRITTEN_OUT`].
    last: u32,
}

impl TriangleEncoder {
    pub(in crate::write::glb) fn new() -> Self {
        // No corner has the largest number, with which glTF restarts strips.
        Self { edges: Newest::of([u32::MAX; 2]), corners: Newest::of(u32::MAX), next: 0, last: 0 }
    }

    /// The bytes before all codes.
    pub(in crate::write::glb) const START: [u8; 1] = [0xe1];

    /// The bytes after all further bytes: a table of codes for triangles that share no edge with
    /// those before. Its first entry, the only one in use, stands for three new corners.
    pub(in crate::write::glb) const END: [u8; 16] = [0; 16];

    /// Takes a triangle. Writes its code and its further bytes. A reader may get the corners turned
    /// round, in the same cyclic order.
    pub(in crate::write::glb) fn add(
        &mut self,
        triangle: [u32; 3],
        codes: &mut impl Write,
        further: &mut impl Write,
    ) -> io::Result<()> {
        let turned = [0, 1, 2].map(|first| [0, 1, 2].map(|corner| triangle[(first + corner) % 3]));
        let edge = (0..EDGES).find_map(|age| {
            let edge = self.edges.aged(age);
            turned.iter().find(|[a, b, _]| edge == [*a, *b]).map(|turned| (age as u8, *turned))
        });
        if let Some((age, [a, b, c])) = edge {
            let corner = self.corner_beside_edge(c);
            codes.write_all(&[age << 4 | corner])?;
            if corner == WRITTEN_OUT {
                self.write_out(c, further)?;
            }
            if corner == NEW || corner >= ONE_LESS {
                self.corners.push(c);
            }
            self.edges.push([c, b]);
            self.edges.push([a, c]);
            return Ok(());
        }
        // A triangle with a new corner is turned so that the next new corner comes first.
        let new = turned.into_iter().find(|[first, ..]| *first == self.next);
        let [a, b, c] = new.unwrap_or(triangle);
        self.next += u32::from(new.is_some());
        let others = [b, c].map(|corner| self.corner_alone(corner));
        match (new, others) {
            (Some(_), [NEW, NEW]) => codes.write_all(&[0xf0])?,
            // If the first corner is not new, no other corner is. The byte of both codes is then
            // not 0. With 0, a reader would count new corners from 0 again.
            _ => {
                codes.write_all(&[if new.is_some() { 0xfe } else { 0xff }])?;
                further.write_all(&[others[0] << 4 | others[1]])?;
            }
        }
        for (corner, code) in
            [a, b, c].into_iter().zip([if new.is_some() { NEW } else { WRITTEN_OUT }, others[0], others[1]])
        {
            if code == WRITTEN_OUT {
                self.write_out(corner, further)?;
            }
            if code == NEW || code == WRITTEN_OUT {
                self.corners.push(corner);
            }
        }
        for edge in [[b, a], [c, b], [a, c]] {
            self.edges.push(edge);
        }
        Ok(())
    }

    /// The code of a triangle's third corner. The other two are the ends of a named edge.
    fn corner_beside_edge(&mut self, corner: u32) -> u8 {
        // The code 0 would name the newest corner, but stands for new corners.
        if let Some(age) = (1..CORNERS_BESIDE_EDGE).find(|&age| self.corners.aged(age) == corner) {
            return age as u8;
        }
        if corner == self.next {
            self.next += 1;
            return NEW;
        }
        let code = match corner.wrapping_sub(self.last) {
            u32::MAX => ONE_LESS,
            1 => ONE_MORE,
            _ => return WRITTEN_OUT,
        };
        self.last = corner;
        code
    }

    /// The code of the second or the third corner of a triangle without a named edge.
    fn corner_alone(&mut self, corner: u32) -> u8 {
        if let Some(age) = (0..CORNERS_ALONE).find(|&age| self.corners.aged(age) == corner) {
            return age as u8 + 1;
        }
        if corner == self.next {
            self.next += 1;
            return NEW;
        }
        WRITTEN_OUT
    }

    /// Writes the number of a corner as its difference from the `last` number, seven bits a byte,
    /// the lowest first.
    fn write_out(&mut self, corner: u32, further: &mut impl Write) -> io::Result<()> {
        let mut left = zigzag(corner.wrapping_sub(self.last) as i32);
        self.last = corner;
        while left > 0x7f {
            further.write_all(&[left as u8 | 0x80])?;
            left >>= 7;
        }
        further.write_all(&[left as u8])
    }
}

/// The sixteen items that came last.
#[derive(Debug)]
struct Newest<T> {
    items: [T; 16],
    /// The place of the next item.
    at: usize,
}

impl<T: Copy> Newest<T> {
    /// Sixteen times `item`, which no later item equals.
    fn of(item: T) -> Self {
        Self { items: [item; 16], at: 0 }
    }

    /// The item of this age: 0 for the newest item, 1 for the item before it, and so on.
    fn aged(&self, age: usize) -> T {
        self.items[self.at.wrapping_sub(age + 1) % 16]
    }

    fn push(&mut self, item: T) {
        self.items[self.at] = item;
        self.at = (self.at + 1) % 16;
    }
}
