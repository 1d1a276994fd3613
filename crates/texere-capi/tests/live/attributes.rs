//! Attributes of live cloth equal those that a plan of its yarns makes, on every device.

use std::ptr::null;

use texere_c::texere_status::*;
use texere_c::*;

use crate::calls::{devices, done, made, opened};
use crate::common::{message, sized};
use crate::read::{Mesh, counts, read, update};
use crate::{TWILL, c, live_cloth, settings};

const NOTHING: texere_attribute = texere_attribute { yarn: 99, angle: 9.0, along: 9.0, tangent: [9.0; 3] };

const VERTEX: texere_vertex = texere_vertex { position: [0.0; 3], normal: [0.0; 3] };

fn view(attributes: &mut [texere_attribute]) -> texere_view {
    let size = size_of_val(attributes) as u64;
    texere_view { data: attributes.as_mut_ptr().cast(), size, stride: size_of::<texere_attribute>() as u64 }
}

/// The attributes at the corners of all triangles that are drawn, draw by draw.
fn drawn(draws: &[texere_draw], indices: &[u32], attributes: &[texere_attribute]) -> Vec<Vec<[u32; 6]>> {
    let bits = |of: &texere_attribute| {
        let [x, y, z] = of.tangent.map(f32::to_bits);
        [of.yarn, of.angle.to_bits(), of.along.to_bits(), x, y, z]
    };
    let corners = |draw: &texere_draw| {
        let own = &indices[draw.first_index as usize..][..draw.index_count as usize];
        own.iter().map(|index| bits(&attributes[(draw.base_vertex + u64::from(*index)) as usize])).collect()
    };
    draws.iter().map(corners).collect()
}

/// The attributes that a plan of the live cloth's yarns, as they are now, makes.
fn planned(live: *const texere_live, device: *const texere_device) -> Vec<Vec<[u32; 6]>> {
    let (mut counts, mut draws): (texere_counts, _) = (sized(), null());
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        let yarns = made(|out| texere_live_yarns(live, out));
        let plan = made(|out| texere_plan_new(yarns, device, &settings(), out));
        done(texere_plan_counts(plan, &mut counts));
        done(texere_plan_draws(plan, &mut draws));
        let mut attributes = vec![NOTHING; counts.vertices as usize];
        let mut vertices = vec![VERTEX; counts.vertices as usize];
        let mut indices = vec![0; counts.indices as usize];
        done(texere_plan_attributes(plan, null(), &view(&mut attributes)));
        let (to, also) = (vertices.as_mut_ptr(), indices.as_mut_ptr());
        done(texere_plan_mesh(plan, null(), to, counts.vertices, also, counts.indices));
        drawn(std::slice::from_raw_parts(draws, counts.draws as usize), &indices, &attributes)
    }
}

/// The attributes at the corners of all triangles that the live cloth draws, draw by draw.
/// `attributes` are those of the cloth's vertices.
fn lived(live: *const texere_live, attributes: &[texere_attribute]) -> Vec<Vec<[u32; 6]>> {
    let mut mesh = Mesh::default();
    read(live, &mut mesh);
    drawn(live_draws(live), &mesh.indices, attributes)
}

fn live_draws<'a>(live: *const texere_live) -> &'a [texere_draw] {
    let mut draws = null();
    // SAFETY: as above.
    unsafe {
        done(texere_live_draws(live, &mut draws));
        std::slice::from_raw_parts(draws, counts(live).draws as usize)
    }
}

#[test]
fn attributes_of_live_cloth_are_those_of_a_plan_of_its_yarns() {
    for name in devices() {
        let (live, _, _) = live_cloth(TWILL, name);
        let device = opened(name).0;
        update(live);
        let mut all = vec![NOTHING; counts(live).vertices as usize];
        let early = c!(texere_live_attributes(live, null(), &view(&mut all)));
        assert_eq!(early, TEXERE_ARGUMENT, "{name}");
        assert!(message().contains("texere_live_keep_attributes"), "{}", message());
        done(c!(texere_live_keep_attributes(live)));
        let (changes, _) = update(live);
        let made: u64 = changes.iter().map(|change| change.vertex_count).sum();
        assert!(made > 0, "{name}: the whole mesh is made again");
        all = vec![NOTHING; counts(live).vertices as usize];
        done(c!(texere_live_attributes(live, null(), &view(&mut all))));
        assert!(lived(live, &all) == planned(live, device), "{name}: other attributes");

        // After an edit, only the attributes in the ranges that the update reports are read again.
        // All attributes then equal those of the edited yarns.
        done(c!(texere_live_set_lift(live, 7, 3, 0)));
        let (changes, anew) = update(live);
        assert!(!anew && !changes.is_empty(), "{name}");
        let (before, edited) = (lived(live, &all), planned(live, device));
        assert!(before != edited, "{name}: the edit changes attributes");
        for change in &changes {
            let place = &mut all[change.first_vertex as usize..][..change.vertex_count as usize];
            done(c!(texere_live_read_attributes(live, change, &view(place))));
        }
        assert!(lived(live, &all) == edited, "{name}: other attributes after an edit");
    }
}
