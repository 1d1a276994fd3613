//! Structs that say their size may come from programs that were built with an earlier or a later
//! header. The library accepts such structs.

use std::collections::BTreeSet;
use std::ffi::c_void;
use std::path::Path;
use std::ptr::{null, null_mut};

use texere_c::texere_status::*;
use texere_c::*;

use crate::calls::{devices, made, opened};
use crate::common::{message, sized};
use crate::handles::{DESIGN, Handles};
use crate::mesh::settings;
use crate::outputs::take_bytes;
use crate::pictures::picture;
use crate::reading::read;
use crate::structures::finish;

/// A function of the library that takes a struct which says its size, and a call of it.
struct Call {
    function: &'static str,
    kind: &'static str,
    /// Whether the library writes the struct. If not, it reads the struct.
    writes: bool,
    /// The struct's bytes. How many there are is a multiple of `align`.
    bytes: Vec<u8>,
    align: usize,
    call: Box<dyn Fn(*mut c_void) -> texere_status>,
}

/// How many words of memory follow the bytes that this library's struct has. The rest of a longer
/// struct lies there, and the tests see what is written there.
const BEHIND: usize = 4;
/// The byte that fills memory before a call, to show which bytes the call has written.
const FILL: u8 = 0x5a;

impl Call {
    fn new<T>(
        names: [&'static str; 2],
        writes: bool,
        value: T,
        call: impl Fn(*mut T) -> texere_status + 'static,
    ) -> Self {
        // SAFETY: the bytes are those of the value; sized structs have no padding.
        let bytes = unsafe { std::slice::from_raw_parts((&raw const value).cast(), size_of::<T>()) };
        let [kind, function] = names;
        let call = Box::new(move |pointer: *mut c_void| call(pointer.cast()));
        Self { function, kind, writes, bytes: bytes.to_vec(), align: align_of::<T>(), call }
    }

    /// Calls the function with a struct that says `size`. If the library reads the struct, bytes of
    /// the value `tail` follow the members that this library knows. Returns the status, the error
    /// message, and what the memory holds after the call.
    fn with(&self, size: usize, tail: u8) -> (texere_status, String, Vec<u8>) {
        let own = self.bytes.len();
        let mut words = vec![0_u64; own.div_ceil(8) + BEHIND];
        let all = words.len() * 8;
        // SAFETY: the bytes are those of the words, which live as long as the call.
        unsafe {
            let memory = std::slice::from_raw_parts_mut(words.as_mut_ptr().cast::<u8>(), all);
            memory.fill(if self.writes { FILL } else { tail });
            if !self.writes {
                memory[..own].copy_from_slice(&self.bytes);
            }
            memory[..4].copy_from_slice(&(size as u32).to_ne_bytes());
            let status = (self.call)(memory.as_mut_ptr().cast());
            let words = if status == TEXERE_OK { String::new() } else { message() };
            (status, words, memory.to_vec())
        }
    }

    /// Checks that a longer struct is taken like this library's own if the rest of it is 0, and is
    /// refused if the rest is not 0.
    fn reads_longer(&self) {
        let (name, own) = (self.function, self.bytes.len());
        let (status, words, _) = self.with(own, FILL);
        for size in [own + self.align, own + 16] {
            let (longer, also, _) = self.with(size, 0);
            assert_eq!((longer, also), (status, words.clone()), "{name}, {size} bytes");
            let (refused, also, _) = self.with(size, 1);
            assert_eq!(refused, TEXERE_UNSUPPORTED, "{name}, {size} bytes: {also}");
            assert!(also.contains("member at byte"), "{name}: {also}");
        }
    }

    /// Checks that nothing is written behind a struct, whatever its size. Members that the library
    /// does not have become 0.
    fn writes_within(&self) {
        let (name, own) = (self.function, self.bytes.len());
        let (status, words, usual) = self.with(own, 0);
        assert_eq!(status, TEXERE_OK, "{name}: {words}");
        for size in (0..=own + 16).step_by(self.align) {
            let (status, words, memory) = self.with(size, 0);
            assert_eq!(memory[..4], (size as u32).to_ne_bytes(), "{name}, {size} bytes: its size");
            let filled = |bytes: &[u8]| bytes.iter().all(|byte| *byte == FILL);
            if status != TEXERE_OK {
                assert!(size < own && status == TEXERE_ARGUMENT, "{name}, {size} bytes: {words}");
                assert!(filled(&memory[4..]), "{name}, {size} bytes: nothing was written");
                continue;
            }
            assert!(filled(&memory[size..]), "{name}, {size} bytes: what lies behind is as it was");
            assert!(memory[own.min(size)..size].iter().all(|byte| *byte == 0), "{name}, {size} bytes");
            // Each call makes anew what these two structs lend, so their values may differ.
            if !["texere_update", "texere_device_mesh"].contains(&self.kind) {
                let known = own.min(size);
                assert_eq!(memory[4..known], usual[4..known], "{name}, {size} bytes");
            }
        }
    }
}

macro_rules! call {
    ($calls:ident, reads $kind:ident = $value:expr, |$given:ident| $name:ident($($argument:expr),* $(,)?)) => {
        // SAFETY: the struct and all other arguments are valid.
        $calls.push(Call::new([stringify!($kind), stringify!($name)], false, $value, move |$given: *mut $kind| unsafe {
            $name($($argument),*)
        }))
    };
    ($calls:ident, writes $kind:ident, |$given:ident| $name:ident($($argument:expr),* $(,)?)) => {
        // SAFETY: the struct and all other arguments are valid.
        $calls.push(Call::new([stringify!($kind), stringify!($name)], true, sized::<$kind>(), move |$given| unsafe {
            $name($($argument),*)
        }))
    };
}

/// Calls whose struct the library reads. The structs of zeros describe designs without threads or
/// stitches. The library refuses these designs with an error message that does not depend on the
/// struct's size.
fn reading(own: &'static Handles, png: &'static str) -> Vec<Call> {
    static POINTS: [texere_point; 2] = [
        texere_point { x: 0.0, y: 0.0, z: 0.0, half_width: 0.1, half_height: 0.1 },
        texere_point { x: 1.0, y: 0.0, z: 0.0, half_width: 0.1, half_height: 0.1 },
    ];
    let (Handles { cloth, yarns, device, plan, live, renderer, .. }, mut calls) = (own, Vec::new());
    let pixels = view(&mut Box::leak(Box::new([0_u8; 256]))[..], 32);
    let positions = view(&mut Box::leak(Box::new([0_f32; 1 << 16]))[..], 12);
    let (what, points) = (sized(), POINTS.as_ptr());
    call!(calls, reads texere_settings = settings(), |it| texere_plan_new(*yarns, *device, it, &mut null_mut()));
    call!(calls, reads texere_settings = settings(), |it| texere_live_of_cloth(*cloth, *device, it, &mut null_mut()));
    call!(calls, reads texere_settings = settings(), |it| texere_live_of_yarns(*yarns, *device, it, &mut null_mut()));
    call!(calls, reads texere_settings = settings(), |it| texere_picker_new(*yarns, it, &mut null_mut()));
    call!(calls, reads texere_settings = settings(), |it| texere_renderer_show(*renderer, *yarns, it, null()));
    call!(calls, reads texere_settings = settings(), |it| texere_check_new(*cloth, it, TEXERE_ACCURACY, null(), &mut null_mut()));
    call!(calls, reads texere_picture = picture(), |it| texere_renderer_picture(*renderer, it, null(), pixels));
    call!(calls, reads texere_picture = picture(), |it| texere_renderer_write(*renderer, it, null(), png.as_ptr().cast(), png.len()));
    call!(calls, reads texere_picture = picture(), |it| texere_renderer_write_to(*renderer, it, null(), Some(take_bytes), null_mut()));
    call!(calls, reads texere_mesh_arrays = texere_mesh_arrays { positions: *positions, ..sized() }, |it| texere_plan_mesh_arrays(*plan, null(), it));
    call!(calls, reads texere_yarn = what, |it| texere_live_set_yarn(*live, 0, it, points, 2));
    call!(calls, reads texere_yarn_arrays = sized(), |it| texere_yarns_new(it, &mut null_mut()));
    call!(calls, reads texere_finish = finish(own), |it| texere_design_finished(own.design, it, &mut null_mut()));
    call!(calls, reads texere_woven = sized(), |it| texere_design_woven(it, &mut null_mut()));
    call!(calls, reads texere_weft_knit = sized(), |it| texere_design_weft_knit(it, &mut null_mut()));
    call!(calls, reads texere_warp_knit = sized(), |it| texere_design_warp_knit(it, &mut null_mut()));
    calls
}

/// A view of an array, in the form that the library takes.
fn view<T>(array: &mut [T], stride: u64) -> &'static texere_view {
    let (data, size) = (array.as_mut_ptr().cast(), size_of_val(array) as u64);
    Box::leak(Box::new(texere_view { data, size, stride }))
}

/// A check that has found faults. The threads of its cloth are three times as wide as their
/// spacing.
fn faulty() -> *mut texere_check {
    let design = read(&DESIGN.replace("diameter_mm = 0.2", "diameter_mm = 1.5"));
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        let cloth = made(|out| texere_cloth_placed(design, out));
        made(|out| texere_check_new(cloth, null(), TEXERE_ACCURACY, null(), out))
    }
}

/// Calls whose struct the library writes.
fn writing(own: &'static Handles) -> Vec<Call> {
    let (Handles { cloth, plan, live, .. }, mut calls) = (own, Vec::new());
    let check = faulty();
    call!(calls, writes texere_settings, |it| texere_settings_default(own.yarns, it));
    call!(calls, writes texere_picture, |it| texere_picture_default(it));
    call!(calls, writes texere_finish, |it| texere_design_finish(own.design, it));
    call!(calls, writes texere_device_info, |it| texere_device_describe(own.device, it));
    call!(calls, writes texere_report, |it| texere_cloth_report(*cloth, it));
    call!(calls, writes texere_measures, |it| texere_cloth_measures(*cloth, it));
    call!(calls, writes texere_yarn_counts, |it| texere_yarns_counts(own.yarns, it));
    call!(calls, writes texere_counts, |it| texere_plan_counts(*plan, it));
    call!(calls, writes texere_chunk, |it| texere_plan_chunk(*plan, 0, it));
    call!(calls, writes texere_counts, |it| texere_live_counts(*live, it));
    call!(calls, writes texere_yarn, |it| texere_live_yarn(*live, 0, it));
    call!(calls, writes texere_update, |it| texere_live_update(*live, null(), it));
    call!(calls, writes texere_diagnosis, |it| texere_check_diagnosis(check, it));
    call!(calls, writes texere_fault, |it| texere_check_fault(check, 0, it));
    calls
}

/// Calls of sessions. Only devices that lend their buffers have sessions. Returns the names of the
/// structs and functions, and the calls on the devices of this kind that the machine has.
fn of_sessions(own: &'static Handles) -> (Vec<[&'static str; 2]>, Vec<Call>) {
    let names =
        vec![["texere_native", "texere_session_native"], ["texere_device_mesh", "texere_session_mesh"]];
    let mut calls = Vec::new();
    for name in devices().into_iter().filter(|name| *name != "cpu") {
        let device = opened(name).0;
        // SAFETY: all pointers are those of values that live as long as the calls.
        let session = unsafe {
            let plan = made(|out| texere_plan_new(own.yarns, device, null(), out));
            made(|out| texere_session_new(plan, null(), out))
        };
        call!(calls, writes texere_native, |it| texere_session_native(session, it));
        call!(calls, writes texere_device_mesh, |it| texere_session_mesh(session, 0, it));
    }
    (names, calls)
}

/// Each function of the header that takes a struct which says its size. The struct's name comes
/// first, then the function's name.
fn declared() -> BTreeSet<[String; 2]> {
    let header =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("include/texere.h")).unwrap();
    let code: String = header.lines().map(|line| line.split("//").next().unwrap().to_owned() + " ").collect();
    let structs = code.split("typedef struct ").filter_map(|rest| {
        let (name, body) = rest.split_once(" {")?;
        body.trim_start().starts_with("uint32_t struct_size;").then_some(name)
    });
    let structs: BTreeSet<&str> = structs.collect();
    let mut found = BTreeSet::new();
    for declaration in code.split(';') {
        let Some((head, parameters)) = declaration.split_once('(') else { continue };
        let function = head.rsplit([' ', '*']).next().unwrap();
        for word in parameters.split_whitespace().filter(|word| structs.contains(word)) {
            if function.starts_with("texere_") {
                found.insert([word.to_owned(), function.to_owned()]);
            }
        }
    }
    found
}

#[test]
fn structs_may_be_shorter_and_longer_than_those_of_this_library() {
    let own: &'static Handles = Box::leak(Box::new(Handles::new()));
    let folder = tempfile::tempdir().unwrap();
    let png: &'static str = folder.path().join("picture.png").to_str().unwrap().to_owned().leak();
    let (mut names, sessions) = of_sessions(own);
    let calls: Vec<_> = reading(own, png).into_iter().chain(writing(own)).chain(sessions).collect();
    for call in &calls {
        if call.writes {
            call.writes_within()
        } else {
            call.reads_longer()
        }
        names.push([call.kind, call.function]);
    }
    // The header names all of these functions. The test compares with it so that none is forgotten.
    let declared = declared();
    let names: BTreeSet<_> = names.into_iter().map(|pair| pair.map(str::to_owned)).collect();
    assert_eq!(names, declared);
    assert!(declared.len() > 25, "only {} functions were found in the header", declared.len());
}
