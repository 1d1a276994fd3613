//! Operations on pictures.

use std::ptr::{null, null_mut};

use texere_c::texere_status::TEXERE_OK;
use texere_c::*;

use super::files::taking;
use super::{FILES, Operation, settings};
use crate::caller::Caller;
use crate::common::sized;

/// A random picture of few pixels.
fn picture(caller: &mut Caller<'_>) -> texere_picture {
    let mut usual = sized();
    // SAFETY: the place lives as long as the call.
    assert_eq!(unsafe { texere_picture_default(&mut usual) }, TEXERE_OK);
    texere_picture {
        struct_size: caller.sized::<texere_picture>().struct_size,
        width: caller.random.pick(&[8, 9, 16, 0, u32::MAX]),
        height: caller.random.pick(&[8, 7, 16, 16]),
        supersampling: caller.random.pick(&[1, 1, 2, 0, u32::MAX]),
        hairs: caller.random.choice(2),
        background: caller.random.choice(3),
        view: caller.random.choice(7),
        turned_over: caller.random.choice(2),
        turn: caller.random.number(1.0) as f32,
        at: [(); 2].map(|()| caller.random.number(0.5) as f32),
        width_mm: caller.random.number(1.0) as f32,
        eye: [1.0, 2.0, 3.0].map(|usual| caller.random.number(usual) as f32),
        field_of_view: caller.random.number(0.5) as f32,
        height_mm: caller.random.number(1.0) as f32,
        ..usual
    }
}

pub(super) fn operations() -> Vec<Operation> {
    table! {
        texere_picture_default, 1, |caller| {
            let picture = caller.sized();
            caller.place(picture, |picture| texere_picture_default(picture))
        };
        texere_renderer_open, 1, |caller| {
            let name = caller.text(&["auto", "wgpu", "cpu"]);
            let renderer: *mut texere_renderer = caller.live();
            // A device takes long to open, so a caller that has one seldom opens another.
            if !renderer.is_null() && caller.random.below(4) > 0 {
                return texere_renderer_open(name.pointer(), name.length(), null_mut());
            }
            caller.out(|out| texere_renderer_open(name.pointer(), name.length(), out))
        };
        texere_renderer_show, 5, |caller| {
            let (renderer, yarns, run) = (caller.handle(), caller.handle(), caller.handle_or_null());
            // Random settings may have a wrong size, so they are drawn only if the call gets them.
            if caller.random.one_in(2) {
                return texere_renderer_show(renderer, yarns, null(), run);
            }
            texere_renderer_show(renderer, yarns, &settings(caller), run)
        };
        texere_renderer_extent, 2, |caller| {
            let renderer = caller.handle();
            caller.place(texere_extent::default(), |extent| texere_renderer_extent(renderer, extent))
        };
        texere_renderer_picture, 4, |caller| {
            let (renderer, run, picture) = (caller.handle(), caller.handle_or_null(), picture(caller));
            let mut pixels = [0_u8; 1024];
            let view = texere_view {
                data: pixels.as_mut_ptr().cast(),
                size: caller.random.pick(&[1024, 1024, 900]),
                stride: caller.random.pick(&[64, 64, 64, 31, 0, u64::MAX]),
            };
            texere_renderer_picture(renderer, &picture, run, &view)
        };
        texere_renderer_write, 2, |caller| {
            let (renderer, run, path) = (caller.handle(), caller.handle_or_null(), caller.path(&FILES));
            let picture = picture(caller);
            texere_renderer_write(renderer, &picture, run, path.pointer(), path.length())
        };
        texere_renderer_write_to, 2, |caller| {
            let (renderer, run) = (caller.handle(), caller.handle_or_null());
            let (picture, (callback, user)) = (picture(caller), taking(caller));
            texere_renderer_write_to(renderer, &picture, run, callback, user)
        };
        texere_renderer_seen, 3, |caller| {
            let renderer = caller.handle();
            let [x, y] = [(); 2].map(|()| caller.random.number(8.0) as f32);
            caller.place(texere_seen::default(), |seen| texere_renderer_seen(renderer, x, y, seen))
        };
    }
}
