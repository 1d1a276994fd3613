//! Calls about measures and checks with one wrong argument each.

use std::ptr::{null, null_mut};

use texere_c::*;

use crate::common::sized;
use crate::handles::Handles;
use crate::mesh::wrong_settings;
use crate::tools::{Case, case, handles, no_handle, sizes, strange};

pub(crate) fn cases(own: &'static Handles) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    // A null pointer for the result.
    case!(cases, texere_cloth_measures(own.cloth, null_mut()));
    case!(cases, texere_cloth_lengths(own.cloth, null_mut(), 1));
    case!(cases, texere_check_new(own.cloth, null(), TEXERE_ACCURACY, null(), null_mut()));
    case!(cases, texere_check_diagnosis(own.check, null_mut()));
    case!(cases, texere_check_fault(own.check, 0, null_mut()));
    case!(cases, texere_check_warning(own.check, 0, null_mut()));
    case!(cases, texere_check_json(own.check, null_mut()));
    case!(cases, texere_check_measures_json(own.check, null_mut()));
    handles!(cases, own, texere_cloth, |it| texere_cloth_measures(it, &mut sized()));
    handles!(cases, own, texere_cloth, |it| texere_cloth_lengths(it, &mut 0.0, 1));
    handles!(cases, own, texere_cloth, |it| texere_check_new(it, null(), 0.0, null(), &mut null_mut()));
    handles!(cases, own, texere_check, |it| texere_check_diagnosis(it, &mut sized()));
    handles!(cases, own, texere_check, |it| texere_check_fault(it, 0, &mut sized()));
    handles!(cases, own, texere_check, |it| texere_check_warning(it, 0, &mut null()));
    handles!(cases, own, texere_check, |it| texere_check_json(it, &mut null()));
    handles!(cases, own, texere_check, |it| texere_check_measures_json(it, &mut null()));
    for run in strange() {
        no_handle!(cases, texere_check_new(own.cloth, null(), 0.0, run, &mut null_mut()));
    }
    sizes!(cases, texere_measures, |it| texere_cloth_measures(own.cloth, &mut it));
    sizes!(cases, texere_settings, |it| texere_check_new(own.cloth, &it, 0.0, null(), &mut null_mut()));
    sizes!(cases, texere_diagnosis, |it| texere_check_diagnosis(own.check, &mut it));
    sizes!(cases, texere_fault, |it| texere_check_fault(own.check, 0, &mut it));
    for settings in wrong_settings() {
        case!(cases, texere_check_new(own.cloth, &settings, 0.0, null(), &mut null_mut()));
    }
    for accuracy in [-0.1, 1.0, f64::NAN, f64::INFINITY] {
        case!(cases, texere_check_new(own.cloth, null(), accuracy, null(), &mut null_mut()));
    }
    // Faults and warnings that do not exist, and a wrong number of materials.
    case!(cases, texere_check_fault(own.check, u64::MAX, &mut sized()));
    case!(cases, texere_check_warning(own.check, u64::MAX, &mut null()));
    case!(cases, texere_cloth_lengths(own.cloth, [0.0; 2].as_mut_ptr(), 2));
    cases
}
