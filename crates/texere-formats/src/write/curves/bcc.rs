//! Binary Curve Collection: a header of 64 bytes, then for each curve the number of its control
//! points and their coordinates.
//!
//! **Source**: Cem Yuksel, "Yarn-level Cloth Models", cemyuksel.com/research/yarnmodels.

use std::io::Write;

use texere_core::Yarns;

use super::super::WriteError;
use super::super::target::Target;
use crate::bcc_file::{HEADER_BYTES, INFO, INFO_BYTES, SIGN, Spline, Z_UP};

/// The format's name in errors.
const FORMAT: &str = "BCC";

/// The most control points of a curve. Their number is an `i32`, and is negative for closed curves.
const POINTS_MAX: usize = i32::MAX as usize;

/// Checks that the format can hold the yarns.
pub(super) fn check(yarns: &Yarns) -> Result<(), WriteError> {
    let unheld = |what| Err(WriteError::Unheld { format: FORMAT, what });
    if yarns.tension() != 0.0 {
        return unheld(format!("splines of tension {}, only those of tension 0", yarns.tension()));
    }
    let mut counts =
        (0..yarns.layout().yarns().len()).map(|yarn| yarns.yarn_points(yarn).map_or(0, <[_]>::len));
    match counts.position(|count| count > POINTS_MAX) {
        Some(yarn) => unheld(format!("yarn {yarn}, whose control points are more than {POINTS_MAX}")),
        None => Ok(()),
    }
}

/// Writes yarns that [`check`] has passed.
pub(super) fn write<W: Write>(yarns: &Yarns, mut target: Target<W>) -> Result<Target<W>, WriteError> {
    let layout = yarns.layout();
    let mut header = [0; HEADER_BYTES];
    header[..4].copy_from_slice(&SIGN);
    header[4..6].copy_from_slice(&Spline::CatmullRom.letters());
    header[6..8].copy_from_slice(&[3, Z_UP]);
    header[8..16].copy_from_slice(&(layout.yarns().len() as u64).to_le_bytes());
    header[16..24].copy_from_slice(&layout.point_count().to_le_bytes());
    header[24..24 + INFO.len().min(INFO_BYTES)].copy_from_slice(INFO.as_bytes());
    target.write(&header)?;
    for (number, yarn) in layout.yarns().iter().enumerate() {
        let points = yarns.yarn_points(number).unwrap_or_default();
        let count = points.len() as i32;
        target.write(&(if yarn.closed { -count } else { count }).to_le_bytes())?;
        for point in points {
            for axis in [point.x, point.y, point.z] {
                target.write(&axis.to_le_bytes())?;
            }
        }
    }
    Ok(target)
}
