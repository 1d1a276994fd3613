//! Operations that make, read and edit live cloth.

use std::ptr::null;

use texere_c::*;

use super::checks::{hit, ray};
use super::outputs::viewed;
use super::{Operation, settings};
use crate::caller::Caller;
use crate::common::sized;

/// The number of an end, a pick, a yarn or a material, or a number that is too high.
fn number(caller: &mut Caller<'_>) -> u64 {
    caller.random.pick(&[0, 0, 1, 1, 2, u64::MAX])
}

/// Two to 60 random control points, or none, which is too few for a yarn.
fn points(caller: &mut Caller<'_>) -> Vec<texere_point> {
    let count = caller.random.pick(&[0, 2, 5, 9, 60]);
    let point = |number| {
        let mut near = |usual: f64| caller.random.number(usual) as f32;
        let (x, y, z) = (near(f64::from(number)), near(1.0), near(0.2));
        texere_point { x, y, z, half_width: near(0.1), half_height: near(0.1) }
    };
    (0..count).map(point).collect()
}

pub(super) fn operations() -> Vec<Operation> {
    [meshes(), edits(), of_yarns()].concat()
}

fn meshes() -> Vec<Operation> {
    table! {
        texere_live_of_cloth, 3, |caller| {
            let (cloth, device) = (caller.handle(), caller.handle());
            if caller.random.one_in(2) {
                return caller.out(|out| texere_live_of_cloth(cloth, device, null(), out));
            }
            let settings = settings(caller);
            caller.out(|out| texere_live_of_cloth(cloth, device, &settings, out))
        };
        texere_live_of_yarns, 3, |caller| {
            let (yarns, device) = (caller.handle(), caller.handle());
            caller.out(|out| texere_live_of_yarns(yarns, device, null(), out))
        };
        texere_live_update, 5, |caller| {
            let (live, run, update) = (caller.handle(), caller.handle_or_null(), caller.sized());
            caller.place(update, |update| texere_live_update(live, run, update))
        };
        texere_live_counts, 3, |caller| {
            let (live, counts) = (caller.handle(), caller.sized());
            caller.place(counts, |counts| texere_live_counts(live, counts))
        };
        texere_live_draws, 3, |caller| {
            let live = caller.handle();
            caller.place(null(), |draws| texere_live_draws(live, draws))
        };
        texere_live_mesh, 4, |caller| {
            let (live, run, mut counts): (_, _, texere_counts) =
                (caller.handle(), caller.handle_or_null(), sized());
            texere_live_counts(live, &mut counts);
            let vertex = texere_vertex { position: [0.0; 3], normal: [0.0; 3] };
            let (mut vertices, mut indices) =
                (vec![vertex; counts.vertices as usize], vec![0; counts.indices as usize]);
            let (vertex_count, index_count) = (caller.count(counts.vertices), caller.count(counts.indices));
            texere_live_mesh(live, run, vertices.as_mut_ptr(), vertex_count, indices.as_mut_ptr(), index_count)
        };
        texere_live_read, 4, |caller| {
            let (live, mut vertices, mut indices) = (
                caller.handle(),
                [texere_vertex { position: [0.0; 3], normal: [0.0; 3] }; 6],
                [0; 6],
            );
            let (first_vertex, first_index) = (number(caller), number(caller));
            let change = texere_change { first_vertex, vertex_count: 6, first_index, index_count: 6 };
            let (vertex_count, index_count) = (caller.count(6), caller.count(6));
            texere_live_read(
                live, &change, vertices.as_mut_ptr(), vertex_count, indices.as_mut_ptr(), index_count
            )
        };
        texere_live_keep_attributes, 2, |caller| texere_live_keep_attributes(caller.handle());
        texere_live_attributes, 3, |caller| {
            let (live, run, mut counts): (_, _, texere_counts) =
                (caller.handle(), caller.handle_or_null(), sized());
            if caller.random.one_in(2) {
                texere_live_keep_attributes(live);
                texere_live_update(live, null(), &mut sized());
            }
            texere_live_counts(live, &mut counts);
            viewed::<texere_attribute>(caller, counts.vertices, |view| texere_live_attributes(live, run, view))
        };
        texere_live_read_attributes, 3, |caller| {
            let (live, first_vertex) = (caller.handle(), number(caller));
            if caller.random.one_in(2) {
                texere_live_keep_attributes(live);
                texere_live_update(live, null(), &mut sized());
            }
            let change = texere_change { first_vertex, vertex_count: 6, first_index: 0, index_count: 0 };
            viewed::<texere_attribute>(caller, 6, |view| texere_live_read_attributes(live, &change, view))
        };
        texere_live_yarns, 3, |caller| {
            let live = caller.handle();
            caller.out(|out| texere_live_yarns(live, out))
        };
        texere_live_pick, 3, |caller| {
            let (live, ray) = (caller.handle(), ray(caller));
            caller.place(texere_hit::default(), |hit| texere_live_pick(live, &ray, hit))
        };
        texere_live_place, 3, |caller| {
            let (live, mut words): (*const texere_live, _) = (caller.handle(), [0; 200]);
            let hit = hit(caller, |ray, hit| {
                texere_live_pick(live, ray, hit);
            });
            let size = caller.random.pick(&[0, 1, 200]);
            caller.place(0, |length| texere_live_place(live, &hit, words.as_mut_ptr(), size, length))
        };
    }
}

fn edits() -> Vec<Operation> {
    table! {
        texere_live_set_lift, 5, |caller| {
            let (live, end, pick) = (caller.handle(), number(caller), number(caller));
            texere_live_set_lift(live, end, pick, caller.random.choice(2))
        };
        texere_live_lift, 3, |caller| {
            let (live, end, pick) = (caller.handle(), number(caller), number(caller));
            caller.place(0, |up| texere_live_lift(live, end, pick, up))
        };
        texere_live_set_drawdown, 4, |caller| {
            let (live, end, pick) = (caller.handle(), number(caller), number(caller));
            let up = [(); 4].map(|()| caller.random.choice(2) as u8);
            let ends = caller.random.pick(&[0, 1, 2, 2]);
            texere_live_set_drawdown(live, end, ends, pick, 2, up.as_ptr())
        };
        texere_live_set_tension, 2, |caller| {
            let live = caller.handle();
            texere_live_set_tension(live, caller.random.pick(&[0.0, 0.0, 0.5, 1.0, f32::NAN]))
        };
        texere_live_set_structure, 2, |caller| texere_live_set_structure(caller.handle(), caller.handle());
        texere_live_set_yarns, 2, |caller| texere_live_set_yarns(caller.handle(), caller.handle());
        texere_live_set_rest, 3, |caller| texere_live_set_rest(caller.handle(), caller.handle());
    }
}

fn of_yarns() -> Vec<Operation> {
    table! {
        texere_live_set_yarn, 5, |caller| {
            let (live, yarn, points) = (caller.handle(), number(caller), points(caller));
            let what = texere_yarn {
                material: caller.random.pick(&[0, 0, 0, u32::MAX]),
                section: caller.random.pick(&[0, 0, 0, u32::MAX]),
                closed: caller.random.choice(2),
                twist: caller.random.number(1.0) as f32,
                ..caller.sized()
            };
            texere_live_set_yarn(live, yarn, &what, points.as_ptr(), points.len())
        };
        texere_live_set_points, 5, |caller| {
            let (live, yarn, points) = (caller.handle(), number(caller), points(caller));
            texere_live_set_points(live, yarn, points.as_ptr(), points.len())
        };
        texere_live_yarn, 3, |caller| {
            let (live, yarn, what) = (caller.handle(), number(caller), caller.sized());
            caller.place(what, |what| texere_live_yarn(live, yarn, what))
        };
        texere_live_set_material, 3, |caller| {
            let (live, number, name) = (caller.handle(), number(caller), caller.text(&["silk", ""]));
            let material = texere_material {
                name: name.pointer(),
                name_length: name.length(),
                tex: caller.random.number(20.0) as f32,
                hairiness: caller.random.number(5.0) as f32,
                srgb: [1, 2, 3],
                reserved: 0,
            };
            texere_live_set_material(live, number, &material)
        };
        texere_live_material, 3, |caller| {
            let (live, number) = (caller.handle(), number(caller));
            let none = texere_material {
                name: null(), name_length: 0, tex: 0.0, hairiness: 0.0, srgb: [0; 3], reserved: 0
            };
            caller.place(none, |material| texere_live_material(live, number, material))
        };
    }
}
