//! The place of a prim within the prim that it is in: translations, rotations and scales, in the
//! order that the prim says.
//!
//! **Source**: Pixar, "UsdGeomXformable", openusd.org. USD multiplies a row by a matrix, glam a
//! matrix by a column, so a file's rows are columns here.

use std::collections::BTreeMap;

use glam::{DMat4, DQuat, DVec3};

use super::tokens::{Token, Tokens};
use crate::read::ReadError;

/// Operations of a prim.
#[derive(Debug, Default)]
pub(super) struct Place<'a> {
    /// The operations by their names. `None` stands for an operation that can't be read.
    operations: BTreeMap<&'a str, Option<DMat4>>,
    /// The names of the operations that count. The last one acts first.
    order: Vec<Token<'a>>,
}

/// The name of the operation that ends the inheritance of places.
const RESET: &str = "!resetXformStack!";

/// What stands before the name of an operation that is to be undone.
const INVERSE: &str = "!invert!";

impl<'a> Place<'a> {
    /// Reads the value of a property `xformOp:…` or `xformOpOrder`.
    pub(super) fn read(&mut self, tokens: &mut Tokens<'a>, name: Token<'a>) -> Result<(), ReadError> {
        if name.text == "xformOpOrder" {
            self.order = tokens.list("operations", Tokens::text)?;
            return Ok(());
        }
        if let Some(name) = name.text.strip_suffix(".timeSamples") {
            self.operations.entry(name).or_insert(None);
            return tokens.pass_over_value();
        }
        let three = |tokens: &mut Tokens<'a>| tokens.tuple(Tokens::number).map(DVec3::from_array);
        let kind = name.text.split(':').nth(1).unwrap_or_default();
        let operation = match kind {
            "translate" => DMat4::from_translation(three(tokens)?),
            "translateX" => DMat4::from_translation(tokens.number::<f64>()? * DVec3::X),
            "translateY" => DMat4::from_translation(tokens.number::<f64>()? * DVec3::Y),
            "translateZ" => DMat4::from_translation(tokens.number::<f64>()? * DVec3::Z),
            "scale" => DMat4::from_scale(three(tokens)?),
            "scaleX" => DMat4::from_scale(DVec3::ONE.with_x(tokens.number()?)),
            "scaleY" => DMat4::from_scale(DVec3::ONE.with_y(tokens.number()?)),
            "scaleZ" => DMat4::from_scale(DVec3::ONE.with_z(tokens.number()?)),
            "transform" => {
                let rows: [[f64; 4]; 4] = tokens.tuple(|tokens| tokens.tuple(Tokens::number))?;
                DMat4::from_cols_array_2d(&rows)
            }
            "orient" => {
                let [w, x, y, z] = tokens.tuple(Tokens::number)?;
                let turn = DQuat::from_xyzw(x, y, z, w);
                DMat4::from_quat(if turn.length_squared() > 0.0 { turn.normalize() } else { DQuat::IDENTITY })
            }
            _ => {
                let Some(axes) = kind.strip_prefix("rotate").filter(|axes| is_turn(axes)) else {
                    self.operations.insert(name.text, None);
                    return tokens.pass_over_value();
                };
                let degrees =
                    if axes.len() == 1 { vec![tokens.number()?] } else { about(axes, three(tokens)?) };
                turned(axes, &degrees)
            }
        };
        self.operations.insert(name.text, Some(operation));
        Ok(())
    }

    /// Takes a property that has no value. It changes nothing.
    pub(super) fn declare(&mut self, name: Token<'a>) {
        self.operations.entry(name.text).or_insert(Some(DMat4::IDENTITY));
    }

    /// The place within the prim that this one is in, and whether that prim counts.
    ///
    /// **Errors**: an operation that the prim lacks, or that can't be read or undone, with what was
    /// expected.
    pub(super) fn matrix(&self) -> Result<(DMat4, bool), (Token<'a>, &'static str)> {
        let (mut matrix, mut inherits) = (DMat4::IDENTITY, true);
        for &name in &self.order {
            if name.text == RESET {
                (matrix, inherits) = (DMat4::IDENTITY, false);
                continue;
            }
            let inverse = name.text.strip_prefix(INVERSE);
            let found = self.operations.get(inverse.unwrap_or(name.text));
            let operation = found.ok_or((name, "an operation of the same prim"))?;
            let operation =
                operation.ok_or((name, "an operation that texere knows and that does not move"))?;
            if inverse.is_some() && operation.determinant() == 0.0 {
                return Err((name, "an operation that can be undone"));
            }
            matrix *= if inverse.is_some() { operation.inverse() } else { operation };
        }
        Ok((matrix, inherits))
    }
}

/// Whether axes such as `X` or `ZYX` are those of a rotation.
fn is_turn(axes: &str) -> bool {
    ["X", "Y", "Z", "XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"].contains(&axes)
}

/// The angles about `axes`, in the order of the axes. A file has them in the order X, Y, Z.
fn about(axes: &str, degrees: DVec3) -> Vec<f64> {
    axes.bytes().map(|axis| degrees[usize::from(axis - b'X')]).collect()
}

/// Rotations about `axes`, of which the first acts first.
fn turned(axes: &str, degrees: &[f64]) -> DMat4 {
    axes.bytes().zip(degrees).fold(DMat4::IDENTITY, |before, (axis, degrees)| {
        let turn = match axis {
            b'X' => DMat4::from_rotation_x,
            b'Y' => DMat4::from_rotation_y,
            _ => DMat4::from_rotation_z,
        };
        turn(degrees.to_radians()) * before
    })
}
