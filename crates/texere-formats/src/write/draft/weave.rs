//! Draws a weave: its shaft draft if there is one, its drawdown, and its yarns.

use std::io::Write;

use texere_fabric::{Draft, Shedding, Thread, Woven};

use super::limits::{BAR_MIN, SHAFTS_MAX, SIDE_AIM, SIDE_MAX, SQUARE_MAX};
use super::sheet::{Block, INK, PAPER, Rgb, Sheet};
use super::side::Side;
use crate::write::picture::png;
use crate::write::{Output, WriteError};

/// Draws a cloth to a PNG file, with its shaft `draft` if there is one. Returns the picture's width
/// and height in pixels.
///
/// **Errors**: [`WriteError::NotPng`] if `output` does not end in `.png`,
/// [`WriteError::DraftTooLarge`] for cloth that needs more pixels than pictures have,
/// [`WriteError::Spared`], [`WriteError::Io`].
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::{Thread, Weave, Woven};
/// use texere_formats::write::{Side, draft};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("twill.png");
/// let thread = Thread::new(0.5, 0.1);
/// let twill = Weave::parse("2/2")?.drawdown(24, 16)?;
/// let cloth = Woven::new(twill, vec![thread; 24], vec![thread; 16], vec![Material::default()], vec![Section::Circle])?;
/// let [width, height] = draft(&cloth, None, Side::Face, &path)?;
/// assert!(width > 24 * 16 && height > 16 * 16);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn draft(
    cloth: &Woven,
    draft: Option<&Draft>,
    side: Side,
    output: impl Into<Output>,
) -> Result<[u32; 2], WriteError> {
    let output = png(output.into())?;
    drawn(cloth, draft, side, |sheet| sheet.save(output))
}

/// Draws a cloth to `out`: the bytes that [`draft`](fn@draft) writes to a file. Returns the
/// picture's width and height in pixels.
///
/// **Errors**: [`WriteError::DraftTooLarge`], [`WriteError::Writer`] if `out` refuses bytes.
pub fn draft_to(
    cloth: &Woven,
    draft: Option<&Draft>,
    side: Side,
    out: impl Write,
) -> Result<[u32; 2], WriteError> {
    drawn(cloth, draft, side, |sheet| sheet.save_to(out))
}

/// Draws a cloth on a sheet, and saves it as `save` does.
fn drawn(
    cloth: &Woven,
    draft: Option<&Draft>,
    side: Side,
    save: impl FnOnce(&Sheet<'_>) -> Result<[u32; 2], WriteError>,
) -> Result<[u32; 2], WriteError> {
    let loom = draft.filter(|_| side == Side::Face).map(Loom::new).filter(Loom::fits);
    let sheet = lay_out(cloth, loom.as_ref(), side);
    let [width, height] = sheet.size;
    if width.max(height) > SIDE_MAX {
        let (ends, picks) = (cloth.drawdown().ends(), cloth.drawdown().picks());
        return Err(WriteError::DraftTooLarge { ends, picks, width, height, limit: SIDE_MAX });
    }
    save(&sheet)
}

/// A draft, with the number of shafts and treadles that it uses.
struct Loom<'a> {
    draft: &'a Draft,
    shafts: usize,
    treadles: usize,
}

impl<'a> Loom<'a> {
    fn new(draft: &'a Draft) -> Self {
        let highest = |lists: &[Vec<u32>]| lists.iter().flatten().max().map_or(0, |&number| number as usize);
        let (shafts, treadles) = match &draft.shedding {
            Shedding::LiftPlan(lifts) => (highest(lifts), 0),
            Shedding::TieUp { tie_up, treadling } => {
                let tied = tie_up.iter().rposition(|shafts| !shafts.is_empty()).map_or(0, |last| last + 1);
                (highest(tie_up), tied.max(highest(treadling)))
            }
        };
        Self { draft, shafts: shafts.max(highest(&draft.threading)), treadles }
    }

    /// Whether there are shafts to draw, and no more shafts or treadles than fit.
    fn fits(&self) -> bool {
        (1..=SHAFTS_MAX).contains(&self.shafts) && self.treadles <= SHAFTS_MAX
    }

    /// Number of columns of the block on the right: treadles, or shafts of a lift plan.
    fn columns(&self) -> usize {
        match self.draft.shedding {
            Shedding::LiftPlan(_) => self.shafts,
            Shedding::TieUp { .. } => self.treadles,
        }
    }

    /// The treadles, or shafts of a lift plan, of each pick.
    fn uses(&self) -> &'a [Vec<u32>] {
        match &self.draft.shedding {
            Shedding::LiftPlan(lifts) => lifts,
            Shedding::TieUp { treadling, .. } => treadling,
        }
    }
}

/// Ink if the list of `thread` holds the shaft or treadle `number`, else paper. `thread` and
/// `number` are counted from 0.
fn mark(lists: &[Vec<u32>], thread: usize, number: usize) -> Rgb {
    let marked = lists.get(thread).is_some_and(|list| list.contains(&(number as u32 + 1)));
    if marked { INK } else { PAPER }
}

/// The colour of a thread's yarn.
fn yarn(cloth: &Woven, thread: &Thread) -> Rgb {
    cloth.materials().get(thread.material as usize).map_or(PAPER, |material| material.srgb)
}

/// The sheet with all blocks in their places.
fn lay_out<'a>(cloth: &'a Woven, loom: Option<&'a Loom<'a>>, side: Side) -> Sheet<'a> {
    let drawdown = cloth.drawdown();
    let (ends, picks) = (drawdown.ends(), drawdown.picks());
    let (shafts, columns) = loom.map_or((0, 0), |loom| (loom.shafts, loom.columns()));
    let square = (SIDE_AIM / (ends + columns).max(picks + shafts)).clamp(1, SQUARE_MAX);
    let bar = square.max(BAR_MIN);
    let end_of = move |column: usize| match side {
        Side::Face => column,
        Side::Back => ends - 1 - column,
    };

    let mut sheet = Sheet::new(bar, side == Side::Back);
    let place @ [left, _] = Sheet::ORIGIN;
    let [mut right, mut top] = sheet.put(Block {
        place,
        squares: [ends, 1],
        square: [square, bar],
        color: Box::new(move |column, _, _| yarn(cloth, &cloth.warp()[end_of(column)])),
    });
    let mut squares = |place, squares, color| sheet.put(Block { place, squares, square: [square; 2], color });
    if let Some(loom) = loom {
        let beside = [right, top];
        let threading = &loom.draft.threading;
        [right, top] = squares(
            [left, top],
            [ends, shafts],
            Box::new(move |end, row, _| mark(threading, end, shafts - 1 - row)),
        );
        if let Shedding::TieUp { tie_up, .. } = &loom.draft.shedding {
            let color = Box::new(move |treadle, row, _| mark(tie_up, treadle, shafts - 1 - row));
            squares(beside, [columns, shafts], color);
        }
        let uses = loom.uses();
        let color = Box::new(move |column, row, _| mark(uses, picks - 1 - row, column));
        [right, _] = squares([right, top], [columns, picks], color);
    }
    let color = Box::new(move |column, row: usize, _| {
        let up = drawdown.up(end_of(column), picks - 1 - row);
        if up == (side == Side::Face) { INK } else { PAPER }
    });
    squares([left, top], [ends, picks], color);
    sheet.put(Block {
        place: [right, top],
        squares: [1, picks],
        square: [bar, square],
        color: Box::new(move |_, row, _| yarn(cloth, &cloth.weft()[picks - 1 - row])),
    });
    sheet.close(legend(cloth, loom, side));
    sheet
}

/// The legend below the drawing.
fn legend(cloth: &Woven, loom: Option<&Loom<'_>>, side: Side) -> Vec<String> {
    let (side, left) = match side {
        Side::Face => ("FACE", "LEFT"),
        Side::Back => ("BACK", "RIGHT"),
    };
    let (ends, picks) = (cloth.drawdown().ends(), cloth.drawdown().picks());
    let mut lines = vec![
        format!("{side}. BLACK: WARP ON TOP"),
        format!("END 1 {left}, PICK 1 BOTTOM"),
        format!("{ends} ENDS, {picks} PICKS"),
    ];
    if let Some(loom) = loom {
        let shed = if loom.draft.rising_shed { "RISING" } else { "SINKING" };
        lines.push(format!("{} SHAFTS, {shed} SHED", loom.shafts));
    }
    lines
}
