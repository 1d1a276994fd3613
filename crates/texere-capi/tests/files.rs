//! The writers of designs, drafts, yarns and pictures give a callback the same bytes that they
//! write to a file, and end when the callback asks them to.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

#[path = "common/calls.rs"]
mod calls;
mod common;
#[path = "common/reading.rs"]
mod reading;

use std::ffi::{c_char, c_void};
use std::fs;
use std::ptr::{from_mut, null, null_mut};

use calls::{done, made};
use common::{message, sized};
use reading::read;
use texere_c::texere_status::*;
use texere_c::*;

const WOVEN: &str = "weave = { notation = \"2/1\", ends = 6, picks = 6 }\nfinish.settle = false\n\
    yarns.a = { diameter_mm = 0.3, color = \"#a03010\", twist_per_m = 300.0 }\n\
    warp = { yarns = [\"a\"], spacing_mm = 0.5 }\nweft = { yarns = [\"a\"], spacing_mm = 0.5 }\n";

const KNIT: &str = "knit = { chart = \"kp\", loop_length_mm = 3.2 }\nfinish.settle = false\n\
    yarns.a.diameter_mm = 0.2\n";

const PROGRAM: &str =
    ";!knitout-2\n;;Carriers: 1\nin 1\nknit + f0 1\nknit + f1 1\nknit - f1 1\nknit - f0 1\nout 1\n";

/// A call that writes a file to a path.
type Path<'a> = Box<dyn Fn(*const c_char, usize) -> texere_status + 'a>;
/// A call that gives the bytes of a file to a callback.
type Callback<'a> = Box<dyn Fn(texere_write_callback, *mut c_void) -> texere_status + 'a>;

/// Copies bytes to their place in the file, which is the vector that `user` points to.
unsafe extern "C" fn take(user: *mut c_void, offset: u64, data: *const u8, size: usize) -> i32 {
    // SAFETY: `user` is the test's vector, and the library lends the bytes.
    let (file, bytes) = unsafe { (&mut *user.cast::<Vec<u8>>(), std::slice::from_raw_parts(data, size)) };
    let end = offset as usize + size;
    file.resize(file.len().max(end), 0);
    file[offset as usize..end].copy_from_slice(bytes);
    0
}

unsafe extern "C" fn refuse(_: *mut c_void, _: u64, _: *const u8, _: usize) -> i32 {
    7
}

fn written(to: &Callback<'_>) -> Vec<u8> {
    let mut file: Vec<u8> = Vec::new();
    done(to(Some(take), from_mut(&mut file).cast()));
    file
}

#[test]
fn callbacks_are_handed_the_bytes_of_the_files() {
    let (design, knit) = (read(WOVEN), read(KNIT));
    // SAFETY: all pointers are those of values that live as long as the calls.
    let (program, yarns, renderer, picture) = unsafe {
        let (name, text) = ("a.k", PROGRAM);
        let (name, length) = (name.as_ptr().cast(), name.len());
        let program = made(|out| {
            texere_design_read_memory(name, length, text.as_ptr(), text.len(), None, null_mut(), out)
        });
        let cloth = made(|out| texere_cloth_placed(design, out));
        let yarns = made(|out| texere_cloth_yarns(cloth, out));
        let renderer = made(|out| texere_renderer_open(null(), 0, out));
        done(texere_renderer_show(renderer, yarns, null(), null()));
        let mut picture: texere_picture = sized();
        done(texere_picture_default(&mut picture));
        (program, yarns, renderer, texere_picture { width: 60, height: 40, ..picture })
    };
    let cut_out = texere_picture { background: TEXERE_BACKGROUND_NOTHING, ..picture };
    let mut writers: Vec<(&str, Path<'_>, Callback<'_>)> = Vec::new();
    macro_rules! writer {
        ($name:literal, $path:ident($($before:expr),*), $callback:ident($($first:expr),*)) => {
            writers.push((
                $name,
                // SAFETY: all pointers are those of values that live as long as the calls.
                Box::new(move |path, length| unsafe { $path($($before,)* path, length) }),
                // SAFETY: all pointers are those of values that live as long as the calls.
                Box::new(move |callback, user| unsafe { $callback($($first,)* callback, user) }),
            ))
        };
    }
    let toml = TEXERE_DESIGN_FORMAT_TOML;
    writer!("design.toml", texere_design_write(design), texere_design_write_to(design, toml));
    let wif = TEXERE_DESIGN_FORMAT_WIF;
    writer!("design.wif", texere_design_write(design), texere_design_write_to(design, wif));
    writer!("face.png", texere_design_draft(design, 0), texere_design_draft_to(design, 0));
    writer!("back.png", texere_design_draft(design, 1), texere_design_draft_to(design, 1));
    writer!("knit.png", texere_design_draft(knit, 0), texere_design_draft_to(knit, 0));
    let own = TEXERE_YARNS_FORMAT_YARNS;
    writer!("yarns.yarns", texere_yarns_write(yarns), texere_yarns_write_to(yarns, own));
    writer!("yarns.bcc", texere_yarns_write(yarns), texere_yarns_write_to(yarns, TEXERE_YARNS_FORMAT_BCC));
    writer!("yarns.usda", texere_yarns_write(yarns), texere_yarns_write_to(yarns, TEXERE_YARNS_FORMAT_USDA));
    writer!(
        "picture.png",
        texere_renderer_write(renderer, &picture, null()),
        texere_renderer_write_to(renderer, &picture, null())
    );
    writer!(
        "cut_out.png",
        texere_renderer_write(renderer, &cut_out, null()),
        texere_renderer_write_to(renderer, &cut_out, null())
    );
    let knitout = TEXERE_DESIGN_FORMAT_KNITOUT;
    writer!("design.k", texere_design_write(program), texere_design_write_to(program, knitout));
    let folder = tempfile::tempdir().unwrap();
    let mut seen = Vec::new();
    for (name, path, callback) in &writers {
        let place = folder.path().join(name);
        let text = place.to_str().unwrap();
        done(path(text.as_ptr().cast(), text.len()));
        let file = written(callback);
        assert!(file == fs::read(&place).unwrap(), "{name}: other bytes");
        assert!(!seen.contains(&file), "{name}: bytes of another file");
        seen.push(file);
        let refused = callback(Some(refuse), null_mut());
        assert_eq!(refused, TEXERE_CANCELLED, "{name}: {}", message());
        assert!(message().contains("the callback answered 7"), "{name}: {}", message());
    }
    // Curves that were written come back.
    let points = |yarns| {
        let mut counts: texere_yarn_counts = sized();
        // SAFETY: the variable lives as long as the call.
        done(unsafe { texere_yarns_counts(yarns, &mut counts) });
        counts.points
    };
    for (name, diameter) in [("yarns.bcc", 0.2), ("yarns.usda", 0.0)] {
        let place = folder.path().join(name);
        let text = place.to_str().unwrap();
        // SAFETY: the text lives as long as the call.
        let again = made(|out| unsafe {
            texere_yarns_read_curves(text.as_ptr().cast(), text.len(), 0.0, diameter, out)
        });
        assert_eq!(points(again), points(yarns), "{name}");
    }
    // Yarns that are read from the bytes of a `.yarns` file are written as the same bytes again.
    // A file that lacks its last byte is refused.
    let (name, file) = ("memory.yarns", &seen[5]);
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        let (text, length) = (name.as_ptr().cast(), name.len());
        let again = made(|out| texere_yarns_read_memory(text, length, file.as_ptr(), file.len(), out));
        let to: Callback<'_> =
            Box::new(move |callback, user| texere_yarns_write_to(again, own, callback, user));
        assert!(written(&to) == *file);
        let mut none = null_mut();
        let read = texere_yarns_read_memory(text, length, file.as_ptr(), file.len() - 1, &mut none);
        assert_eq!(read, TEXERE_DESIGN);
        assert!(none.is_null() && message().contains(name), "{}", message());
        let linear: Callback<'_> = Box::new(move |callback, user| {
            texere_yarns_write_to(yarns, TEXERE_YARNS_FORMAT_LINEAR_USDA, callback, user)
        });
        let linear = String::from_utf8(written(&linear)).unwrap();
        assert!(linear.contains("token type = \"linear\"") && linear.contains("physics:thicknesses"));
        let knitted = texere_design_write_to(knit, TEXERE_DESIGN_FORMAT_WIF, Some(refuse), null_mut());
        assert_eq!(knitted, TEXERE_UNSUPPORTED, "{}", message());
    }
}
