//! A piece of cloth that is to settle.

use texere_contact::{lengths_mm, round_length_mm};
use texere_core::settling::Settling;
use texere_core::{Boundary, ControlPoint, Ends, YarnError, Yarns};

use super::Finish;

/// A piece of cloth that is to settle: its yarns, how the yarns go on at its edges, and the control
/// points that are held.
#[derive(Debug, Clone)]
pub struct Piece {
    /// The yarns, about where they lie in the cloth.
    pub yarns: Yarns,
    /// Which yarns end, are closed, or go on in the next repeat, and the size of the repeat.
    pub boundary: Boundary,
    /// The numbers of the control points that stay where they are, counted through all yarns.
    pub pinned: Vec<u64>,
}

impl Piece {
    /// A piece that nothing holds: one repeat of a cloth, or a piece that lies free.
    #[must_use]
    pub const fn new(yarns: Yarns, boundary: Boundary) -> Self {
        Self { yarns, boundary, pinned: Vec::new() }
    }

    /// A piece cut out of a cloth. Every yarn that is not closed ends at its first and its last
    /// control point, and is held there.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, Yarns};
    /// use texere_fabric::Piece;
    /// let mut yarns = Yarns::builder();
    /// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// assert_eq!(Piece::cut(yarns.build()?).pinned, [0, 2]);
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    #[must_use]
    pub fn cut(yarns: Yarns) -> Self {
        let layout = yarns.layout();
        let open = layout.yarns().iter().zip(layout.offsets().windows(2)).filter(|(yarn, _)| !yarn.closed);
        let pinned = open.flat_map(|(_, bounds)| [bounds[0], bounds[1] - 1]).collect();
        Self { boundary: Boundary::without_repeat(layout), pinned, yarns }
    }

    /// Length of all yarns of the piece, mm. A yarn that goes on in the next repeat counts up to
    /// the start of its next round.
    #[must_use]
    pub fn length_mm(&self) -> f64 {
        let lengths = lengths_mm(&self.yarns);
        let yarns = lengths.into_iter().enumerate().map(|(yarn, length)| match self.boundary.ends()[yarn] {
            Ends::Open | Ends::Closed => length,
            Ends::Repeats(_) => {
                let points = self.yarns.yarn_points(yarn).unwrap_or(&[]);
                round_length_mm(points, self.boundary.onward_mm(yarn), self.yarns.tension())
            }
        });
        yarns.sum()
    }

    /// The piece's yarns with other control points, in the same order.
    ///
    /// **Errors**: [`YarnError`] for another number of points, or for an invalid point.
    pub fn moved(&self, points: &[ControlPoint]) -> Result<Yarns, YarnError> {
        let planned = self.yarns.layout().point_count();
        if points.len() as u64 != planned {
            return Err(YarnError::PointCount { points: points.len() as u64, planned });
        }
        let mut moved = self.yarns.clone();
        for (yarn, bounds) in self.yarns.layout().offsets().windows(2).enumerate() {
            moved.set_points(yarn, &points[bounds[0] as usize..bounds[1] as usize])?;
        }
        Ok(moved)
    }

    /// The settling problem that `finish` makes of the piece. Callers that run a settler themselves
    /// can leave the result on its device.
    #[must_use]
    pub fn settling(&self, finish: &Finish) -> Settling<'_> {
        let settling = Settling::new(&self.yarns)
            .boundary(self.boundary.clone())
            .pinned(self.pinned.clone())
            .length(finish.length())
            .passes(finish.passes);
        match finish.press_mm {
            Some(gap) => settling.plates(gap),
            None => settling,
        }
    }
}
