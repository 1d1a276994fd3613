//! Calls about live cloth and pickers with wrong arguments.

use std::ptr::{null, null_mut};

use texere_c::*;

use crate::calls::done;
use crate::common::sized;
use crate::handles::Handles;
use crate::mesh::wrong_settings;
use crate::outputs::views;
use crate::tools::{Case, case, handles, no_handle, sizes, strange};

const MATERIAL: texere_material =
    texere_material { name: null(), name_length: 0, tex: 0.0, hairiness: 0.0, srgb: [0; 3], reserved: 0 };

pub(crate) fn cases(own: &'static Handles) -> Vec<Case> {
    [making(own), reading(own), edits(own), edits_of_yarns(own), picking(own)].into_iter().flatten().collect()
}

fn making(own: &'static Handles) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    case!(cases, texere_live_of_cloth(own.cloth, own.device, null(), null_mut()));
    case!(cases, texere_live_of_yarns(own.yarns, own.device, null(), null_mut()));
    case!(cases, texere_picker_new(own.yarns, null(), null_mut()));
    handles!(cases, own, texere_cloth, |it| texere_live_of_cloth(it, own.device, null(), &mut null_mut()));
    handles!(cases, own, texere_device, |it| texere_live_of_cloth(own.cloth, it, null(), &mut null_mut()));
    handles!(cases, own, texere_yarns, |it| texere_live_of_yarns(it, own.device, null(), &mut null_mut()));
    handles!(cases, own, texere_device, |it| texere_live_of_yarns(own.yarns, it, null(), &mut null_mut()));
    handles!(cases, own, texere_yarns, |it| texere_picker_new(it, null(), &mut null_mut()));
    sizes!(cases, texere_settings, |it| texere_live_of_cloth(own.cloth, own.device, &it, &mut null_mut()));
    sizes!(cases, texere_settings, |it| texere_live_of_yarns(own.yarns, own.device, &it, &mut null_mut()));
    sizes!(cases, texere_settings, |it| texere_picker_new(own.yarns, &it, &mut null_mut()));
    for settings in wrong_settings() {
        case!(cases, texere_live_of_cloth(own.cloth, own.device, &settings, &mut null_mut()));
        case!(cases, texere_live_of_yarns(own.yarns, own.device, &settings, &mut null_mut()));
        case!(cases, texere_picker_new(own.yarns, &settings, &mut null_mut()));
    }
    cases
}

fn reading(own: &'static Handles) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    let none = texere_change { first_vertex: 0, vertex_count: 0, first_index: 0, index_count: 0 };
    case!(cases, texere_live_update(own.live, null(), null_mut()));
    case!(cases, texere_live_counts(own.live, null_mut()));
    case!(cases, texere_live_draws(own.live, null_mut()));
    case!(cases, texere_live_yarns(own.live, null_mut()));
    case!(cases, texere_live_read(own.live, null(), null_mut(), 0, null_mut(), 0));
    handles!(cases, own, texere_live, |live| texere_live_update(live, null(), &mut sized()));
    handles!(cases, own, texere_live, |live| texere_live_counts(live, &mut sized()));
    handles!(cases, own, texere_live, |live| texere_live_draws(live, &mut null()));
    handles!(cases, own, texere_live, |live| texere_live_yarns(live, &mut null_mut()));
    handles!(cases, own, texere_live, |live| texere_live_mesh(live, null(), null_mut(), 0, null_mut(), 0));
    handles!(cases, own, texere_live, |live| texere_live_read(live, &none, null_mut(), 0, null_mut(), 0));
    sizes!(cases, texere_update, |update| texere_live_update(own.live, null(), &mut update));
    sizes!(cases, texere_counts, |counts| texere_live_counts(own.live, &mut counts));
    for view in views().iter().map(std::ptr::from_ref).chain([null()]) {
        case!(cases, texere_live_attributes(own.live, null(), view));
        case!(cases, texere_live_read_attributes(own.live, &none, view));
    }
    case!(cases, texere_live_read_attributes(own.live, null(), &views()[1]));
    handles!(cases, own, texere_live, |live| texere_live_keep_attributes(live));
    handles!(cases, own, texere_live, |live| texere_live_attributes(live, null(), &views()[1]));
    handles!(cases, own, texere_live, |live| texere_live_read_attributes(live, &none, &views()[1]));
    for run in strange() {
        no_handle!(cases, texere_live_attributes(own.live, run, &views()[1]));
        no_handle!(cases, texere_live_mesh(own.live, run, null_mut(), 0, null_mut(), 0));
    }
    // Counts that are not those of the mesh, ranges that do not lie within the mesh, and null
    // arrays.
    case!(cases, texere_live_mesh(own.live, null(), null_mut(), 1, null_mut(), 1));
    case!(cases, texere_live_read(own.live, &none, null_mut(), 1, null_mut(), 0));
    for (first_vertex, vertex_count, first_index, index_count) in [
        (u64::MAX, 1, 0, 0),
        (0, 0, u64::MAX - 1, 1),
        (0, 1 << 40, 0, 0),
        (1 << 40, 0, 0, 0),
        (0, 6, 0, 0),
        (0, 0, 0, 6),
    ] {
        let change = texere_change { first_vertex, vertex_count, first_index, index_count };
        case!(cases, texere_live_read(own.live, &change, null_mut(), vertex_count, null_mut(), index_count));
    }
    cases
}

fn edits(own: &'static Handles) -> Vec<Case> {
    static UP: [u8; 4] = [0, 1, 2, 1];
    let mut cases: Vec<Case> = Vec::new();
    handles!(cases, own, texere_live, |live| texere_live_set_lift(live, 0, 0, 1));
    handles!(cases, own, texere_live, |live| texere_live_lift(live, 0, 0, &mut 0));
    handles!(cases, own, texere_live, |live| texere_live_set_drawdown(live, 0, 2, 0, 1, UP.as_ptr()));
    handles!(cases, own, texere_live, |live| texere_live_set_tension(live, 0.5));
    handles!(cases, own, texere_live, |live| texere_live_set_structure(live, own.design));
    handles!(cases, own, texere_design, |design| texere_live_set_structure(own.live, design));
    case!(cases, texere_live_lift(own.live, 0, 0, null_mut()));
    case!(cases, texere_live_set_lift(own.live, 0, 0, 2));
    for [end, pick] in [[4, 0], [0, 4], [u64::MAX, 0], [0, u64::MAX]] {
        case!(cases, texere_live_set_lift(own.live, end, pick, 1));
        case!(cases, texere_live_lift(own.live, end, pick, &mut 0));
        case!(cases, texere_live_set_drawdown(own.live, end, 1, pick, 1, UP.as_ptr()));
    }
    case!(cases, texere_live_set_drawdown(own.live, 0, 2, 0, 2, UP.as_ptr())); // a 2 among them
    case!(cases, texere_live_set_drawdown(own.live, 0, 2, 0, 2, null()));
    case!(cases, texere_live_set_drawdown(own.live, 0, u64::MAX, 0, 2, UP.as_ptr()));
    for tension in [-0.1, 1.0, f32::NAN, f32::INFINITY] {
        case!(cases, texere_live_set_tension(own.live, tension));
    }
    cases
}

fn edits_of_yarns(own: &'static Handles) -> Vec<Case> {
    const POINT: texere_point = texere_point { x: 0.0, y: 0.0, z: 0.0, half_width: 0.1, half_height: 0.1 };
    static POINTS: [texere_point; 3] =
        [POINT, texere_point { x: 1.0, ..POINT }, texere_point { y: f32::NAN, ..POINT }];
    let mut cases: Vec<Case> = Vec::new();
    let what: texere_yarn = sized();
    case!(cases, texere_live_set_yarn(own.live, 0, null(), POINTS.as_ptr(), 2));
    case!(cases, texere_live_yarn(own.live, 0, null_mut()));
    case!(cases, texere_live_set_material(own.live, 0, null()));
    case!(cases, texere_live_material(own.live, 0, null_mut()));
    handles!(cases, own, texere_live, |it| texere_live_set_yarn(it, 0, &what, POINTS.as_ptr(), 2));
    handles!(cases, own, texere_live, |it| texere_live_set_points(it, 0, POINTS.as_ptr(), 2));
    handles!(cases, own, texere_live, |it| texere_live_yarn(it, 0, &mut sized()));
    handles!(cases, own, texere_live, |it| texere_live_set_material(it, 0, &MATERIAL));
    handles!(cases, own, texere_live, |it| texere_live_material(it, 0, &mut { MATERIAL }));
    handles!(cases, own, texere_live, |it| texere_live_set_yarns(it, own.yarns));
    handles!(cases, own, texere_live, |it| texere_live_set_rest(it, own.yarns));
    handles!(cases, own, texere_yarns, |it| texere_live_set_yarns(own.live, it));
    handles!(cases, own, texere_yarns, |it| texere_live_set_rest(own.live, it));
    sizes!(cases, texere_yarn, |what| texere_live_set_yarn(own.live, 0, &what, POINTS.as_ptr(), 2));
    sizes!(cases, texere_yarn, |what| texere_live_yarn(own.live, 0, &mut what));
    // Yarns and materials that do not exist, invalid values of them, and too few control points.
    for yarn in [8, u64::MAX] {
        case!(cases, texere_live_set_yarn(own.live, yarn, &what, POINTS.as_ptr(), 2));
        case!(cases, texere_live_set_points(own.live, yarn, POINTS.as_ptr(), 2));
        case!(cases, texere_live_yarn(own.live, yarn, &mut sized()));
        case!(cases, texere_live_set_material(own.live, yarn, &MATERIAL));
        case!(cases, texere_live_material(own.live, yarn, &mut { MATERIAL }));
    }
    for what in [
        texere_yarn { material: 9, ..what },
        texere_yarn { section: 9, ..what },
        texere_yarn { closed: 2, ..what },
        texere_yarn { closed: 1, ..what },
        texere_yarn { twist: f32::NAN, ..what },
    ] {
        case!(cases, texere_live_set_yarn(own.live, 0, &what, POINTS.as_ptr(), 2));
    }
    for count in [0, 1, 3] {
        case!(cases, texere_live_set_points(own.live, 0, POINTS.as_ptr(), count));
    }
    case!(cases, texere_live_set_points(own.live, 0, null(), 2));
    case!(cases, texere_live_set_points(own.live, 0, POINTS.as_ptr(), usize::MAX));
    for material in [
        texere_material { tex: -1.0, ..MATERIAL },
        texere_material { tex: f32::NAN, ..MATERIAL },
        texere_material { hairiness: 31.0, ..MATERIAL },
        texere_material { name_length: 3, ..MATERIAL },
        texere_material { name: b"\xff".as_ptr().cast(), name_length: 1, ..MATERIAL },
    ] {
        case!(cases, texere_live_set_material(own.live, 0, &material));
    }
    cases
}

/// What a ray down onto the crossing of end 2 and pick 2 hits.
fn hit(own: &Handles) -> texere_hit {
    let (ray, mut hit) =
        (texere_ray { origin: [0.75, 0.7, 9.0], direction: [0.0, 0.0, -1.0] }, texere_hit::default());
    // SAFETY: all pointers are those of values that live as long as the call.
    done(unsafe { texere_picker_pick(own.picker, &ray, &mut hit) });
    assert_eq!(hit.found, 1);
    hit
}

fn picking(own: &'static Handles) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    let ray = texere_ray { origin: [0.0; 3], direction: [0.0, 0.0, 1.0] };
    let right = hit(own);
    case!(cases, texere_live_pick(own.live, null(), &mut texere_hit::default()));
    case!(cases, texere_live_pick(own.live, &ray, null_mut()));
    case!(cases, texere_picker_pick(own.picker, null(), &mut texere_hit::default()));
    case!(cases, texere_picker_pick(own.picker, &ray, null_mut()));
    handles!(cases, own, texere_live, |it| texere_live_pick(it, &ray, &mut texere_hit::default()));
    handles!(cases, own, texere_picker, |it| texere_picker_pick(it, &ray, &mut texere_hit::default()));
    handles!(cases, own, texere_live, |it| texere_live_place(it, &right, null_mut(), 0, &mut 0));
    handles!(cases, own, texere_cloth, |it| texere_cloth_place(it, &right, null_mut(), 0, &mut 0));
    for hit in [
        texere_hit { found: 0, ..right },
        texere_hit { yarn: 8, ..right },
        texere_hit { interval: u32::MAX, ..right },
        texere_hit { t: f64::NAN, ..right },
        texere_hit { position: [9.0; 3], ..right },
        texere_hit { position: [f64::NAN; 3], ..right },
    ] {
        case!(cases, texere_live_place(own.live, &hit, null_mut(), 0, &mut 0));
        case!(cases, texere_cloth_place(own.cloth, &hit, null_mut(), 0, &mut 0));
    }
    // No hit, a null pointer for the text or for its length, and too little room for the text.
    case!(cases, texere_live_place(own.live, null(), null_mut(), 0, &mut 0));
    case!(cases, texere_cloth_place(own.cloth, null(), null_mut(), 0, &mut 0));
    for size in [1, 4] {
        case!(cases, texere_live_place(own.live, &right, [0; 4].as_mut_ptr(), size, &mut 0));
        case!(cases, texere_cloth_place(own.cloth, &right, [0; 4].as_mut_ptr(), size, &mut 0));
    }
    case!(cases, texere_live_place(own.live, &right, null_mut(), 100, &mut 0));
    case!(cases, texere_cloth_place(own.cloth, &right, null_mut(), 100, &mut 0));
    case!(cases, texere_live_place(own.live, &right, null_mut(), 0, null_mut()));
    case!(cases, texere_cloth_place(own.cloth, &right, null_mut(), 0, null_mut()));
    cases
}
