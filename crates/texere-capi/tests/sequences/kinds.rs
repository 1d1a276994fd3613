//! The kinds of handles: how a handle of each kind is made, and how it is freed.

use std::ptr::{null, null_mut, without_provenance_mut};

use texere_c::*;

use crate::caller::Caller;
use crate::operations::{DESIGNS, read};

/// A kind of handle.
pub(crate) trait Kind: Sized {
    /// The number of the kind among all kinds.
    const NUMBER: usize;
    /// Makes a handle from small live objects. It is null if that fails.
    fn make(caller: &mut Caller<'_>) -> *mut Self;
}

macro_rules! kinds {
    ($($number:literal $kind:ident, freed by $free:ident, made by $make:expr;)*) => {
        /// How many kinds there are.
        pub(crate) const KINDS: usize = [$($number),*].len();

        $(impl Kind for $kind {
            const NUMBER: usize = $number;
            fn make(caller: &mut Caller<'_>) -> *mut Self {
                let mut made = null_mut();
                // SAFETY: the place lives as long as the call; handles are looked up.
                let _: texere_status = unsafe { ($make)(caller, &mut made) };
                made
            }
        })*

        /// Frees a handle with the function of this kind, whatever kind it is of.
        pub(crate) fn free(kind: usize, handle: usize) {
            match kind {
                // SAFETY: handles are looked up.
                $($number => unsafe { $free(without_provenance_mut(handle)) },)*
                _ => unreachable!(),
            }
        }
    };
}

kinds! {
    0 texere_device, freed by texere_device_free, made by |_: &mut Caller<'_>, out| {
        texere_device_open(c"cpu-serial".as_ptr(), 10, out)
    };
    1 texere_design, freed by texere_design_free, made by |caller: &mut Caller<'_>, out| {
        read(caller.random.pick(&DESIGNS[..3]), out)
    };
    2 texere_run, freed by texere_run_free, made by |_: &mut Caller<'_>, out| texere_run_new(out);
    3 texere_cloth, freed by texere_cloth_free, made by |caller: &mut Caller<'_>, out| {
        texere_cloth_placed(caller.live(), out)
    };
    4 texere_yarns, freed by texere_yarns_free, made by |caller: &mut Caller<'_>, out| {
        texere_cloth_yarns(caller.live(), out)
    };
    5 texere_plan, freed by texere_plan_free, made by |caller: &mut Caller<'_>, out| {
        texere_plan_new(caller.live(), caller.live(), null(), out)
    };
    6 texere_session, freed by texere_session_free, made by |caller: &mut Caller<'_>, out| {
        let (mut device, mut plan) = (null_mut(), null_mut());
        texere_device_open(c"wgpu".as_ptr(), 4, &mut device);
        texere_plan_new(caller.live(), device, null(), &mut plan);
        let made = texere_session_new(plan, null(), out);
        texere_plan_free(plan);
        texere_device_free(device);
        made
    };
    7 texere_renderer, freed by texere_renderer_free, made by |_: &mut Caller<'_>, out| {
        texere_renderer_open(null(), 0, out)
    };
    8 texere_live, freed by texere_live_free, made by |caller: &mut Caller<'_>, out| {
        texere_live_of_cloth(caller.live(), caller.live(), null(), out)
    };
    9 texere_picker, freed by texere_picker_free, made by |caller: &mut Caller<'_>, out| {
        texere_picker_new(caller.live(), null(), out)
    };
    10 texere_check, freed by texere_check_free, made by |caller: &mut Caller<'_>, out| {
        texere_check_new(caller.live(), null(), TEXERE_ACCURACY, null(), out)
    };
}
