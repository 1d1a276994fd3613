//! Calls about pictures with one wrong argument each.

use std::ptr::{null, null_mut};

use texere_c::texere_status::TEXERE_OK;
use texere_c::*;

use crate::common::sized;
use crate::handles::Handles;
use crate::mesh::settings;
use crate::outputs::take_bytes;
use crate::tools::{Case, case, no_handle, strange};

pub(crate) fn cases(own: &'static Handles) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    static mut PIXELS: [u8; 256] = [0; 256];
    let pixels = texere_view { data: (&raw mut PIXELS).cast(), size: 256, stride: 32 };
    let (png, length) = (c"none.png".as_ptr(), 8);
    case!(cases, texere_picture_default(null_mut()));
    case!(cases, texere_renderer_open(null(), 0, null_mut()));
    case!(cases, texere_renderer_show(own.renderer, own.run.cast(), null(), null()));
    case!(
        cases,
        texere_renderer_show(own.renderer, own.yarns, &texere_settings { sides: 2, ..settings() }, null())
    );
    case!(cases, texere_renderer_extent(own.renderer, null_mut()));
    case!(cases, texere_renderer_seen(own.renderer, 0.0, 0.0, null_mut()));
    case!(cases, texere_renderer_picture(own.renderer, null(), null(), &pixels));
    case!(cases, texere_renderer_picture(own.renderer, &picture(), null(), null()));
    case!(cases, texere_renderer_write(own.renderer, null(), null(), png, length));
    case!(cases, texere_renderer_write_to(own.renderer, null(), null(), Some(take_bytes), null_mut()));
    case!(cases, texere_renderer_write_to(own.renderer, &picture(), null(), None, null_mut()));
    let own_of_another_kind = own.run.cast();
    for renderer in [null_mut(), strange()[0], strange()[1], own_of_another_kind] {
        case!(cases, texere_renderer_show(renderer, own.yarns, null(), null()));
        case!(cases, texere_renderer_extent(renderer, &mut texere_extent::default()));
        case!(cases, texere_renderer_seen(renderer, 0.0, 0.0, &mut texere_seen::default()));
        case!(cases, texere_renderer_picture(renderer, &picture(), null(), &pixels));
        case!(cases, texere_renderer_write(renderer, &picture(), null(), png, length));
        case!(cases, texere_renderer_write_to(renderer, &picture(), null(), Some(take_bytes), null_mut()));
    }
    for run in strange() {
        no_handle!(cases, texere_renderer_show(own.renderer, own.yarns, null(), run));
        no_handle!(cases, texere_renderer_picture(own.renderer, &picture(), run, &pixels));
        no_handle!(cases, texere_renderer_write(own.renderer, &picture(), run, png, length));
        no_handle!(
            cases,
            texere_renderer_write_to(own.renderer, &picture(), run, Some(take_bytes), null_mut())
        );
    }
    for (text, length) in [(null(), 4), (b"\xff\xfe".as_ptr().cast(), 2)] {
        case!(cases, texere_renderer_open(text, length, &mut null_mut()));
        case!(cases, texere_renderer_write(own.renderer, &picture(), null(), text, length));
    }
    case!(cases, texere_renderer_write(own.renderer, &picture(), null(), c"none.jpg".as_ptr(), 8));
    for size in [0, 4, u32::MAX] {
        let picture = texere_picture { struct_size: size, ..picture() };
        case!(cases, texere_picture_default(&mut { picture }));
        case!(cases, texere_renderer_picture(own.renderer, &picture, null(), &pixels));
        case!(cases, texere_renderer_write(own.renderer, &picture, null(), png, length));
    }
    for wrong in [
        texere_view { data: null_mut(), ..pixels },
        texere_view { size: 255, ..pixels },
        texere_view { stride: 31, ..pixels },
        texere_view { stride: u64::MAX, ..pixels },
    ] {
        case!(cases, texere_renderer_picture(own.renderer, &picture(), null(), &wrong));
    }
    for wrong in [
        texere_picture { width: 0, ..picture() },
        texere_picture { supersampling: 0, ..picture() },
        texere_picture { supersampling: u32::MAX, ..picture() },
        texere_picture { hairs: 2, ..picture() },
        texere_picture { background: 3, ..picture() },
        texere_picture { view: 7, ..picture() },
        texere_picture { turned_over: 2, ..picture() },
        texere_picture { view: TEXERE_VIEW_OBLIQUE, turn: f32::NAN, ..picture() },
        texere_picture { view: TEXERE_VIEW_CLOSE_UP, width_mm: 0.0, ..picture() },
        texere_picture { view: TEXERE_VIEW_EYE, field_of_view: 4.0, ..picture() },
        texere_picture { view: TEXERE_VIEW_EYE, eye: [0.0; 3], ..picture() },
        texere_picture { view: TEXERE_VIEW_PARALLEL, height_mm: -1.0, ..picture() },
    ] {
        case!(cases, texere_renderer_picture(own.renderer, &wrong, null(), &pixels));
    }
    let wide = texere_picture { width: u32::MAX, ..picture() };
    case!(cases, texere_renderer_write(own.renderer, &wide, null(), png, length));
    cases
}

pub(crate) fn picture() -> texere_picture {
    let mut picture = sized();
    // SAFETY: the place lives as long as the call.
    assert_eq!(unsafe { texere_picture_default(&mut picture) }, TEXERE_OK);
    texere_picture { width: 8, height: 8, ..picture }
}
