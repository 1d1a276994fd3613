//! Calls with wrong arguments: calls that make designs of arrays, read and set finishes, and write
//! designs and drafts.

use std::ptr::{null, null_mut};

use texere_c::texere_status::TEXERE_OK;
use texere_c::*;

use crate::common::sized;
use crate::handles::Handles;
use crate::outputs::take_bytes;
use crate::tools::{Case, case, strange};

pub(crate) fn cases(own: &'static Handles) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    let (toml, length) = (c"none.toml".as_ptr(), 9);
    let (png, png_length) = (c"none.png".as_ptr(), 8);
    case!(cases, texere_design_woven(null(), &mut null_mut()));
    case!(cases, texere_design_weft_knit(null(), &mut null_mut()));
    case!(cases, texere_design_warp_knit(null(), &mut null_mut()));
    case!(cases, texere_design_woven(&sized(), null_mut()));
    case!(cases, texere_design_weft_knit(&sized(), null_mut()));
    case!(cases, texere_design_warp_knit(&sized(), null_mut()));
    case!(cases, texere_design_finish(own.design, null_mut()));
    case!(cases, texere_design_finished(own.design, null(), &mut null_mut()));
    case!(cases, texere_design_finished(own.design, &finish(own), null_mut()));
    case!(cases, texere_diameter(20.0, 0.9, null_mut()));
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        case!(cases, texere_diameter(wrong, 0.9, &mut 0.0));
        case!(cases, texere_diameter(20.0, wrong, &mut 0.0));
    }
    for size in [0, 4, u32::MAX] {
        case!(cases, texere_design_woven(&texere_woven { struct_size: size, ..sized() }, &mut null_mut()));
        case!(
            cases,
            texere_design_weft_knit(&texere_weft_knit { struct_size: size, ..sized() }, &mut null_mut())
        );
        case!(
            cases,
            texere_design_warp_knit(&texere_warp_knit { struct_size: size, ..sized() }, &mut null_mut())
        );
        case!(
            cases,
            texere_design_finish(own.design, &mut texere_finish { struct_size: size, ..finish(own) })
        );
        let finish = texere_finish { struct_size: size, ..finish(own) };
        case!(cases, texere_design_finished(own.design, &finish, &mut null_mut()));
    }
    let own_of_another_kind = own.run.cast();
    for design in [null_mut(), strange()[0], strange()[1], own_of_another_kind] {
        case!(cases, texere_design_finish(design, &mut sized()));
        case!(cases, texere_design_finished(design, &finish(own), &mut null_mut()));
        case!(cases, texere_design_write(design, toml, length));
        case!(cases, texere_design_draft(design, 0, png, png_length));
        case!(cases, texere_design_write_to(design, 0, Some(take_bytes), null_mut()));
        case!(cases, texere_design_draft_to(design, 0, Some(take_bytes), null_mut()));
    }
    for (text, length) in [(null(), 4), (b"\xff\xfe".as_ptr().cast(), 2), (c"none".as_ptr(), 4)] {
        case!(cases, texere_design_write(own.design, text, length));
        case!(cases, texere_design_draft(own.design, 0, text, length));
    }
    case!(cases, texere_design_draft(own.design, 2, png, png_length));
    case!(cases, texere_design_draft_to(own.design, 2, Some(take_bytes), null_mut()));
    case!(cases, texere_design_draft_to(own.design, 0, None, null_mut()));
    case!(cases, texere_design_write_to(own.design, 3, Some(take_bytes), null_mut()));
    case!(cases, texere_design_write_to(own.design, 0, None, null_mut()));
    for finish in [
        texere_finish { settle: 2, ..finish(own) },
        texere_finish { length_kind: 1, ..finish(own) },
        texere_finish { press_mm: 1.0, ..finish(own) },
        texere_finish { warp_tension: 11.0, ..finish(own) },
        texere_finish { weft_tension: f32::NAN, ..finish(own) },
        texere_finish { calender: -1.0, ..finish(own) },
        texere_finish { stretch: 3, ..finish(own) },
        texere_finish { stretch: TEXERE_STRETCH_WEFT, stretch_by: 2.5, ..finish(own) },
        texere_finish { passes: 0, ..finish(own) },
    ] {
        case!(cases, texere_design_finished(own.design, &finish, &mut null_mut()));
    }
    cases
}

pub(crate) fn finish(own: &Handles) -> texere_finish {
    let mut finish = sized();
    // SAFETY: the place lives as long as the call.
    assert_eq!(unsafe { texere_design_finish(own.design, &mut finish) }, TEXERE_OK);
    finish
}
