//! The `[cloth]` table: how threads lie in the cloth.

use texere_fabric::{Crimp, Relief, Shape, Woven};
use toml::Spanned;

use super::any::Any;
use super::schema::ClothTable;
use super::source::Source;
use crate::read::ReadError;

/// The settings of `[cloth]`.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Cloth {
    shape: Shape,
    crimp: Crimp,
    selvedge: bool,
    pub(super) relief: Relief,
}

impl Cloth {
    /// `rests` says whether the cloth comes to rest. Threads of cloth at rest flatten as far as
    /// they must, so `cloth.jam` may then only be `"report"`.
    pub(super) fn new(source: &Source<'_>, table: &ClothTable, rests: bool) -> Result<Self, ReadError> {
        let mut cloth = Self::default();
        if let Some(shape) = &table.shape {
            let known = [("round", Shape::Round), ("crossing", Shape::Crossing)];
            cloth.shape = choice(source, "cloth.shape", shape, &known)?;
        }
        if let Some(share) = &table.warp_crimp {
            let field = "cloth.warp_crimp";
            let share = source.float(field, share, "the warp's share of the crimp, a number from 0 to 1")?;
            cloth.crimp = Crimp::WarpShare(source.number(field, &share, [0.0, 1.0])? as f32);
        }
        if let Some(selvedge) = &table.selvedge {
            let given = selvedge.as_ref().truth();
            cloth.selvedge = given.ok_or_else(|| source.odd("cloth.selvedge", selvedge, "true or false"))?;
        }
        if let Some(jam) = &table.jam {
            let known =
                [("report", Relief::Report), ("flatten", Relief::Flatten), ("shrink", Relief::Shrink)];
            cloth.relief = choice(source, "cloth.jam", jam, &known)?;
            if rests && cloth.relief != Relief::Report {
                let expected = "\"report\": in cloth at rest threads give way by themselves; with finish.settle = false, which leaves cloth as it is woven, also \"flatten\" or \"shrink\"";
                return Err(source.odd("cloth.jam", jam, expected));
            }
        }
        Ok(cloth)
    }

    /// Gives `woven` its shape, its crimp and its selvedge.
    pub(super) fn apply(&self, source: &Source<'_>, woven: &mut Woven) -> Result<(), ReadError> {
        woven.set_shape(self.shape);
        woven.set_selvedge(self.selvedge);
        woven.set_crimp(self.crimp).map_err(|error| source.fabric(error.into()))
    }
}

/// The value that a word stands for, one of `known`.
fn choice<T: Copy>(
    source: &Source<'_>,
    field: &str,
    value: &Spanned<Any>,
    known: &[(&str, T)],
) -> Result<T, ReadError> {
    let found = known.iter().find(|(name, _)| value.as_ref().text() == Some(name));
    found.map(|(_, choice)| *choice).ok_or_else(|| {
        let names: Vec<_> = known.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        source.odd(field, value, &names.join(" or "))
    })
}
