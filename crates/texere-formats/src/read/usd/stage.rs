//! Parses a USD stage into prims, which are its named parts. Of each prim, curves and transforms
//! are kept. Other properties are skipped.

use texere_core::backend::room_for;

use super::place::Place;
use super::tokens::{Kind, Token, Tokens};
use super::values::unescaped;
use crate::read::ReadError;

/// A stage as parsed. Its values are those of the file, and no transform is applied yet.
#[derive(Debug)]
pub(super) struct Stage<'a> {
    /// The length of the unit, m.
    pub(super) unit_m: f64,
    /// The axis that is up: `X`, `Y` or `Z`.
    pub(super) up: &'a str,
    /// All prims. A prim comes after the prim that it is in.
    pub(super) prims: Vec<Prim<'a>>,
}

/// A prim.
#[derive(Debug)]
pub(super) struct Prim<'a> {
    /// The number of the prim that this one is in.
    pub(super) parent: Option<usize>,
    /// The type, such as `BasisCurves`. It is empty for a prim without one.
    pub(super) kind: Token<'a>,
    /// What people are shown: the prim's `displayName`, or else its name.
    pub(super) name: String,
    /// Whether the prim is to be read: defined, active, visible, and neither a guide nor a stand-in
    /// (`proxy`).
    pub(super) is_there: bool,
    /// The prim's transform relative to its parent.
    pub(super) place: Option<Box<Place<'a>>>,
    /// The curves of a prim of the type `BasisCurves`.
    pub(super) curves: Option<Box<Curves<'a>>>,
}

/// The curves of a prim.
#[derive(Debug, Default)]
pub(super) struct Curves<'a> {
    /// The number of points of each curve.
    pub(super) counts: Vec<u32>,
    pub(super) points: Vec<[f32; 3]>,
    /// The token `points.timeSamples`, for the message, if the points change with time.
    pub(super) moving: Option<Token<'a>>,
    /// Diameters.
    pub(super) widths: Values<'a, f32>,
    /// `primvars:widths`. It replaces `widths` unless it is empty.
    pub(super) primvar_widths: Values<'a, f32>,
    /// `primvars:yarn`: the number of each curve's yarn, in files that texere wrote.
    pub(super) yarns: Vec<u32>,
    /// Colours in linear light.
    pub(super) colors: Values<'a, [f32; 3]>,
    /// For each curve the number of its colour, if colours are numbered.
    pub(super) color_indices: Vec<u32>,
    /// `linear` or `cubic`.
    pub(super) form: Option<Token<'a>>,
    pub(super) basis: Option<Token<'a>>,
    pub(super) wrap: Option<Token<'a>>,
}

/// Values of a prim's curves.
#[derive(Debug)]
pub(super) struct Values<'a, T> {
    pub(super) values: Vec<T>,
    /// What the values belong to: all curves, each curve or each of their points.
    pub(super) interpolation: Option<Token<'a>>,
}

impl<T> Default for Values<'_, T> {
    fn default() -> Self {
        Self { values: Vec::new(), interpolation: None }
    }
}

/// The metadata in round brackets after the name of a property or of a prim.
#[derive(Debug, Default)]
struct Said<'a> {
    interpolation: Option<Token<'a>>,
    display_name: Option<String>,
    is_off: bool,
}

/// The fields that compose a stage from other files or from variants. A stage in which
/// one of them is not empty is refused.
const COMPOSED: [&str; 6] = ["subLayers", "references", "payload", "inherits", "specializes", "variants"];

/// The words before a property's type.
const QUALIFIERS: [&str; 9] =
    ["custom", "uniform", "varying", "config", "prepend", "append", "add", "delete", "reorder"];

/// Reads a stage.
pub(super) fn stage<'a>(tokens: &mut Tokens<'a>) -> Result<Stage<'a>, ReadError> {
    // USD's defaults: without `metersPerUnit` the unit is a centimetre. Without `upAxis` y is up.
    let mut stage = Stage { unit_m: 0.01, up: "Y", prims: Vec::new() };
    if tokens.took(b'(')? {
        said(tokens, |name, tokens| {
            match name {
                "metersPerUnit" => stage.unit_m = tokens.number()?,
                "upAxis" => {
                    let axis = tokens.text()?;
                    if !["X", "Y", "Z"].contains(&axis.text) {
                        return Err(tokens.refused(axis, "X, Y or Z"));
                    }
                    stage.up = axis.text;
                }
                _ => return Ok(false),
            }
            Ok(true)
        })?;
    }
    let mut open = None;
    loop {
        let token = tokens.next()?;
        match (token.kind, open) {
            (Kind::End, None) => return Ok(stage),
            (Kind::End, Some(_)) => return Err(tokens.refused(token, "the bracket that ends a prim")),
            (Kind::Sign(b'}'), Some(prim)) => open = parent(&stage, prim),
            (Kind::Sign(b';'), _) => {}
            (Kind::Word, _) if ["def", "over", "class"].contains(&token.text) => {
                let prim = prim(tokens, token, open)?;
                room_for(&mut stage.prims, 1, "prims")?;
                stage.prims.push(prim);
                open = Some(stage.prims.len() - 1);
            }
            (Kind::Word, Some(prim)) => property(tokens, token, &mut stage.prims[prim])?,
            (Kind::Word, None) if token.text == "reorder" => reorder(tokens)?,
            _ => return Err(tokens.refused(token, "def, over or class")),
        }
    }
}

fn parent(stage: &Stage<'_>, prim: usize) -> Option<usize> {
    stage.prims[prim].parent
}

/// Parses a prim's header after `def`, `over` or `class`, up to and including `{`.
fn prim<'a>(
    tokens: &mut Tokens<'a>,
    specifier: Token<'a>,
    parent: Option<usize>,
) -> Result<Prim<'a>, ReadError> {
    let is_typed = tokens.peek()?.kind == Kind::Word;
    let kind = if is_typed { tokens.next()? } else { Token { text: "", ..specifier } };
    let name = tokens.text()?;
    let said = if tokens.took(b'(')? { said(tokens, |_, _| Ok(false))? } else { Said::default() };
    tokens.sign(b'{')?;
    Ok(Prim {
        parent,
        kind,
        name: said.display_name.unwrap_or_else(|| unescaped(name.text)),
        is_there: specifier.text == "def" && !said.is_off,
        place: None,
        curves: (kind.text == "BasisCurves").then(Box::default),
    })
}

/// Parses metadata up to `)`. The caller has taken `(`. `own` reads the value of a name that it
/// knows, and returns whether it did.
fn said<'a>(
    tokens: &mut Tokens<'a>,
    mut own: impl FnMut(&str, &mut Tokens<'a>) -> Result<bool, ReadError>,
) -> Result<Said<'a>, ReadError> {
    let mut said = Said::default();
    loop {
        let mut token = tokens.next()?;
        match token.kind {
            Kind::Sign(b')') => return Ok(said),
            // Comments of the metadata, and separators.
            Kind::Text | Kind::Sign(b';' | b',') => continue,
            Kind::Word => {}
            _ => return Err(tokens.refused(token, "a name or a bracket )")),
        }
        let is_deleted = token.text == "delete";
        if QUALIFIERS.contains(&token.text) {
            token = tokens.next()?;
        }
        tokens.sign(b'=')?;
        if COMPOSED.contains(&token.text) && !is_deleted && !is_nothing(tokens)? {
            let what = "a stage without this, which `usdcat --flatten` makes if no prim is instanceable";
            return Err(tokens.refused(token, what));
        }
        match token.text {
            "interpolation" => said.interpolation = Some(tokens.text()?),
            "displayName" => said.display_name = Some(unescaped(tokens.text()?.text)),
            "active" => said.is_off = !tokens.truth()?,
            name if own(name, tokens)? => {}
            _ => tokens.pass_over_value()?,
        }
    }
}

/// Whether the next value is `None`, `[]` or `{}`. The value is not taken.
fn is_nothing(tokens: &Tokens<'_>) -> Result<bool, ReadError> {
    let mut ahead = *tokens;
    let first = ahead.next()?;
    Ok(match first.kind {
        Kind::Sign(b'[') => ahead.took(b']')?,
        Kind::Sign(b'{') => ahead.took(b'}')?,
        _ => first.is("None"),
    })
}

/// The rest of a statement `reorder nameChildren = ["a"]`.
fn reorder(tokens: &mut Tokens<'_>) -> Result<(), ReadError> {
    tokens.next()?;
    tokens.sign(b'=')?;
    tokens.pass_over_value()
}

/// The rest of a property, whose first word is `token`.
fn property<'a>(tokens: &mut Tokens<'a>, token: Token<'a>, prim: &mut Prim<'a>) -> Result<(), ReadError> {
    if token.text == "variantSet" {
        let what = "a stage without variants: `usdcat --flatten` makes one";
        return Err(tokens.refused(token, what));
    }
    let (mut kind, mut is_reordered) = (token, false);
    while kind.kind == Kind::Word && QUALIFIERS.contains(&kind.text) {
        is_reordered |= kind.text == "reorder";
        kind = tokens.next()?;
    }
    if is_reordered && ["nameChildren", "properties"].contains(&kind.text) {
        tokens.sign(b'=')?;
        return tokens.pass_over_value();
    }
    if kind.kind != Kind::Word {
        return Err(tokens.refused(kind, "the type of a property"));
    }
    if tokens.took(b'[')? {
        tokens.sign(b']')?;
    }
    let name = tokens.next()?;
    if name.kind != Kind::Word {
        return Err(tokens.refused(name, "the name of a property"));
    }
    if tokens.took(b'=')? {
        value(tokens, name, prim)?;
    } else if name.text.starts_with("xformOp:") {
        prim.place.get_or_insert_default().declare(name);
    }
    if tokens.took(b'(')? {
        let said = said(tokens, |_, _| Ok(false))?;
        if let Some(curves) = &mut prim.curves {
            match name.text {
                "widths" => curves.widths.interpolation = said.interpolation,
                "primvars:widths" => curves.primvar_widths.interpolation = said.interpolation,
                "primvars:displayColor" => curves.colors.interpolation = said.interpolation,
                _ => {}
            }
        }
    }
    Ok(())
}

/// The value of a property.
fn value<'a>(tokens: &mut Tokens<'a>, name: Token<'a>, prim: &mut Prim<'a>) -> Result<(), ReadError> {
    if tokens.peek()?.is("None") {
        tokens.next()?;
        return Ok(());
    }
    if name.text.starts_with("xformOp") {
        return prim.place.get_or_insert_default().read(tokens, name);
    }
    if ["visibility", "purpose"].contains(&name.text) {
        prim.is_there &= !["invisible", "guide", "proxy"].contains(&tokens.text()?.text);
        return Ok(());
    }
    let Some(curves) = &mut prim.curves else { return tokens.pass_over_value() };
    let triple = |tokens: &mut Tokens<'a>| tokens.tuple(Tokens::number);
    match name.text {
        "points" => curves.points = tokens.list("points of curves", triple)?,
        "points.timeSamples" => {
            curves.moving = Some(name);
            tokens.pass_over_value()?;
        }
        "curveVertexCounts" => curves.counts = tokens.list("curves", Tokens::count)?,
        "widths" => curves.widths.values = tokens.list("widths of curves", Tokens::number)?,
        "primvars:widths" => {
            curves.primvar_widths.values = tokens.list("widths of curves", Tokens::number)?;
        }
        "primvars:displayColor:indices" => curves.color_indices = tokens.list("curves", Tokens::count)?,
        "primvars:displayColor" => curves.colors.values = tokens.list("colours of curves", triple)?,
        // Other programs may store other data under this name. Then it is skipped.
        "primvars:yarn" => {
            let mut ahead = *tokens;
            if let Ok(yarns) = ahead.list("curves", Tokens::count) {
                curves.yarns = yarns;
            }
            tokens.pass_over_value()?;
        }
        "type" => curves.form = Some(tokens.text()?),
        "basis" => curves.basis = Some(tokens.text()?),
        "wrap" => curves.wrap = Some(tokens.text()?),
        _ => tokens.pass_over_value()?,
    }
    Ok(())
}
