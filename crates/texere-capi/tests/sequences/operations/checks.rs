//! Operations that measure and check cloth, and that find out what a ray hits.

use std::ptr::{null, null_mut};

use texere_c::*;

use super::{Operation, settings};
use crate::caller::Caller;
use crate::common::sized;

/// The number of a fault or a warning: a low number, or one that is too high.
fn number(caller: &mut Caller<'_>) -> u64 {
    caller.random.pick(&[0, 0, 0, 1, u64::MAX])
}

/// A ray down onto the cloth, or an invalid ray.
pub(super) fn ray(caller: &mut Caller<'_>) -> texere_ray {
    let [x, y] = [(); 2].map(|()| caller.random.number(0.6));
    texere_ray { origin: [x, y, 9.0], direction: [0.0, 0.0, -1.0] }
}

/// What a ray has hit, or a place that no yarn has.
pub(super) fn hit(caller: &mut Caller<'_>, pick: impl FnOnce(&texere_ray, *mut texere_hit)) -> texere_hit {
    let (ray, mut hit) = (ray(caller), texere_hit::default());
    pick(&ray, &mut hit);
    match caller.random.below(8) {
        0 => texere_hit { found: caller.random.pick(&[0, 1]), ..hit },
        1 => texere_hit { yarn: caller.random.pick(&[0, 1, 2, u32::MAX]), ..hit },
        2 => texere_hit { interval: caller.random.pick(&[0, 1, u32::MAX]), ..hit },
        3 => texere_hit { t: caller.random.number(0.5), ..hit },
        4 => texere_hit { position: [(); 3].map(|()| caller.random.number(0.6)), ..hit },
        _ => hit,
    }
}

pub(super) fn operations() -> Vec<Operation> {
    table! {
        texere_picker_new, 3, |caller| {
            let yarns = caller.handle();
            if caller.random.one_in(2) {
                return caller.out(|out| texere_picker_new(yarns, null(), out));
            }
            let settings = settings(caller);
            caller.out(|out| texere_picker_new(yarns, &settings, out))
        };
        texere_picker_pick, 3, |caller| {
            let (picker, ray) = (caller.handle(), ray(caller));
            caller.place(texere_hit::default(), |hit| texere_picker_pick(picker, &ray, hit))
        };
        texere_cloth_place, 3, |caller| {
            let (cloth, mut words): (*const texere_cloth, _) = (caller.handle(), [0; 200]);
            let hit = hit(caller, |ray, hit| {
                let (mut yarns, mut picker) = (null_mut(), null_mut());
                texere_cloth_yarns(cloth, &mut yarns);
                texere_picker_new(yarns, null(), &mut picker);
                texere_picker_pick(picker, ray, hit);
                texere_picker_free(picker);
                texere_yarns_free(yarns);
            });
            let size = caller.random.pick(&[0, 1, 200]);
            caller.place(0, |length| texere_cloth_place(cloth, &hit, words.as_mut_ptr(), size, length))
        };
        texere_cloth_measures, 3, |caller| {
            let (cloth, measures) = (caller.handle(), caller.sized());
            caller.place(measures, |measures| texere_cloth_measures(cloth, measures))
        };
        texere_cloth_lengths, 3, |caller| {
            let (cloth, mut measures): (_, texere_measures) = (caller.handle(), sized());
            texere_cloth_measures(cloth, &mut measures);
            let mut lengths = vec![0.0; measures.materials as usize];
            texere_cloth_lengths(cloth, lengths.as_mut_ptr(), caller.count(measures.materials.into()))
        };
        texere_check_new, 1, |caller| {
            let (cloth, run) = (caller.handle(), caller.handle_or_null());
            let accuracy = caller.random.pick(&[TEXERE_ACCURACY, 0.0, 0.5, 1.0, f64::NAN]);
            caller.out(|out| texere_check_new(cloth, null(), accuracy, run, out))
        };
        texere_check_diagnosis, 3, |caller| {
            let (check, diagnosis) = (caller.handle(), caller.sized());
            caller.place(diagnosis, |diagnosis| texere_check_diagnosis(check, diagnosis))
        };
        texere_check_fault, 3, |caller| {
            let (check, number, fault) = (caller.handle(), number(caller), caller.sized());
            caller.place(fault, |fault| texere_check_fault(check, number, fault))
        };
        texere_check_warning, 3, |caller| {
            let (check, number) = (caller.handle(), number(caller));
            caller.place(null(), |words| texere_check_warning(check, number, words))
        };
        texere_check_json, 2, |caller| {
            let check = caller.handle();
            caller.place(null(), |json| texere_check_json(check, json))
        };
        texere_check_measures_json, 2, |caller| {
            let check = caller.handle();
            caller.place(null(), |json| texere_check_measures_json(check, json))
        };
    }
}
