//! Operations that make designs from arrays.

use std::ptr::{null, null_mut};

use texere_c::*;

use super::Operation;
use crate::caller::{Caller, Text};

/// Random materials and sections, which the `texere_looks` of `given` points to.
struct Looks {
    name: Text,
    materials: Vec<texere_material>,
    sections: Vec<texere_section>,
    corners: [[f32; 2]; 4],
}

impl Looks {
    fn new(caller: &mut Caller<'_>) -> Box<Self> {
        let name = caller.text(&["cotton", "", "laine d'été"]);
        let corners = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let mut looks = Box::new(Self { name, materials: Vec::new(), sections: Vec::new(), corners });
        // There is always a material with the name, because an invalid name is only refused if a
        // material has it.
        let text = &looks.name;
        looks.materials.push(texere_material {
            name: text.pointer(),
            name_length: text.length(),
            tex: caller.random.number(20.0) as f32,
            hairiness: caller.random.number(5.0) as f32,
            srgb: [1, 2, 3],
            reserved: 0,
        });
        let section = texere_section {
            shape: caller.random.choice(6),
            count: caller.random.pick(&[2, 3, 4, 4, 4]),
            aspect: caller.random.number(1.5) as f32,
            form: caller.random.number(0.5) as f32,
            corners: looks.corners.as_ptr().cast(),
        };
        looks.sections.push(section);
        looks
    }

    fn given(&self) -> texere_looks {
        texere_looks {
            materials: self.materials.as_ptr(),
            material_count: 1,
            sections: self.sections.as_ptr(),
            section_count: 1,
        }
    }
}

fn thread(caller: &mut Caller<'_>) -> texere_thread {
    texere_thread {
        spacing_mm: caller.random.number(0.5),
        diameter_mm: caller.random.number(0.2),
        flatness: caller.random.pick(&[0.0, 1.0, 2.0]),
        stiffness: caller.random.pick(&[0.0, 1.0, 3.0]),
        firmness: caller.random.pick(&[0.0, 0.1, 10.0]),
        twist: 0.0,
        material: caller.random.pick(&[0, 0, 0, 0, 0, 0, 0, 0, 0, 1]),
        section: 0,
        least_area: caller.random.pick(&[0.0, 0.6, 1.0]),
        reserved: 0,
    }
}

fn knit_yarn(caller: &mut Caller<'_>) -> texere_knit_yarn {
    let diameter_mm = caller.random.number(0.2);
    texere_knit_yarn { diameter_mm, twist: 0.5, material: 0, section: 0, reserved: 0 }
}

/// `count` lists of a draft. Either each list has one number, or each has none to three. Numbers go
/// from 0 to `most`, and are sometimes higher. `kept` holds the arrays.
fn lists(caller: &mut Caller<'_>, kept: &mut Kept, count: usize, most: u32) -> texere_lists {
    let is_single = caller.random.one_in(2);
    let mut offsets = vec![0_u64];
    for _ in 0..count {
        let length = if is_single { 1 } else { caller.random.below(4) as u64 };
        offsets.push(offsets[offsets.len() - 1] + length);
    }
    let total = offsets[count] as usize;
    let numbers: Vec<_> = (0..total).map(|_| caller.random.choice(most + 1)).collect();
    if !is_single && count > 1 && caller.random.one_in(20) {
        offsets.swap(0, 1);
    }
    let offsets_at = if is_single { null() } else { offsets.as_ptr() };
    let lists = texere_lists { numbers: numbers.as_ptr(), offsets: offsets_at };
    kept.0.push(numbers);
    kept.1.push(offsets);
    lists
}

/// Arrays that a draft refers to.
#[derive(Default)]
struct Kept(Vec<Vec<u32>>, Vec<Vec<u64>>);

/// A draft of so many ends and picks.
fn draft(caller: &mut Caller<'_>, kept: &mut Kept, ends: usize, picks: usize) -> texere_draft {
    let (shafts, treadles) = (1 + caller.random.below(4) as u32, caller.random.pick(&[0, 1, 4]));
    let picked = if treadles == 0 { shafts } else { treadles };
    texere_draft {
        sinking_shed: caller.random.choice(2),
        threading: lists(caller, kept, ends, shafts),
        tie_up: lists(caller, kept, treadles as usize, shafts),
        treadling: lists(caller, kept, picks, picked),
        shafts: caller.random.pick(&[shafts, shafts, shafts, 0]),
        treadles,
        ..caller.sized()
    }
}

pub(super) fn operations() -> Vec<Operation> {
    table! {
        texere_design_woven, 3, |caller| {
            let (looks, name) = (Looks::new(caller), caller.text(&["", "twill"]));
            let [ends, picks] = [(); 2].map(|()| 1 + caller.random.below(10));
            let mut bits: Vec<u8> = (0..2 * picks).map(|_| caller.random.next() as u8).collect();
            let size = caller.random.pick(&[bits.len() as u64, bits.len() as u64, 1]);
            let [warp, weft] =
                [ends, picks].map(|count| (0..count).map(|_| thread(caller)).collect::<Vec<_>>());
            let mut drawdown = texere_view { data: bits.as_mut_ptr().cast(), size, stride: 2 };
            let (mut kept, mut of_draft) = (Kept::default(), None);
            if caller.random.one_in(3) {
                of_draft = Some(draft(caller, &mut kept, ends, picks));
                drawdown.data = if caller.random.one_in(20) { drawdown.data } else { null_mut() };
            }
            let woven = texere_woven {
                draft: of_draft.as_ref().map_or(null(), std::ptr::from_ref),
                shape: caller.random.choice(2),
                relief: caller.random.choice(3),
                selvedge: caller.random.choice(2),
                crimp: caller.random.choice(2),
                warp_share: caller.random.number(0.5) as f32,
                name: name.pointer(),
                name_length: name.length(),
                ends: caller.random.pick(&[ends as u64, ends as u64, ends as u64, 0]),
                picks: picks as u64,
                drawdown,
                warp: warp.as_ptr(),
                weft: weft.as_ptr(),
                looks: looks.given(),
                ..caller.sized()
            };
            caller.out(|out| texere_design_woven(&woven, out))
        };
        texere_design_weft_knit, 2, |caller| {
            let (looks, name) = (Looks::new(caller), caller.text(&["", "rib"]));
            let [wales, courses] = [(); 2].map(|()| 1 + caller.random.below(3));
            let stitches: Vec<_> = (0..wales * courses)
                .map(|_| texere_stitch {
                    kind: caller.random.pick(&[0, 0, 0, 0, 0, 1, 1, 2, 3, 4, 5, 6, 7, 8]),
                    moved: caller.random.pick(&[0, 1, -1, 2, 257, i32::MIN]),
                })
                .collect();
            let turn = [caller.random.choice(2), 0, 1];
            let yarns = [knit_yarn(caller), knit_yarn(caller)];
            let picture: Vec<_> = (0..wales * courses).map(|_| caller.random.choice(2)).collect();
            let is_jacquard = caller.random.one_in(3);
            let beds = caller.random.pick(&[1, 1, 1, 1, 2, 2, 0, u32::MAX]);
            let knit = texere_weft_knit {
                beds: if is_jacquard { caller.random.pick(&[0, 0, 0, 1]) } else { beds },
                backing: if is_jacquard { caller.random.choice(3) } else { caller.random.pick(&[0, 0, 0, 1]) },
                jacquard: if is_jacquard { picture.as_ptr() } else { null() },
                cells: caller.random.choice(2),
                copies: [(); 2].map(|()| caller.random.pick(&[1, 1, 1, 2, 0, u32::MAX])),
                name: name.pointer(),
                name_length: name.length(),
                wales: wales as u64,
                courses: caller.random.pick(&[courses as u64, courses as u64, courses as u64, 0]),
                stitches: if is_jacquard { null() } else { stitches.as_ptr() },
                turn: turn.as_ptr(),
                turn_count: if is_jacquard { 0 } else { caller.random.below(4) as u64 },
                yarns: yarns.as_ptr(),
                yarn_count: caller.random.pick(&[2, 2, 2, 2, 1, 0]),
                wale_mm: caller.random.number(1.2),
                course_mm: caller.random.number(1.0),
                loop_length_mm: caller.random.pick(&[0.0, 0.0, 4.0, -1.0]),
                looks: looks.given(),
                ..caller.sized()
            };
            caller.out(|out| texere_design_weft_knit(&knit, out))
        };
        texere_design_warp_knit, 2, |caller| {
            let (looks, name) = (Looks::new(caller), caller.text(&["", "tricot"]));
            // By chance alone, a knit is sound once in several thousand calls.
            let is_sound = caller.random.one_in(4);
            let mut laps: Vec<_> = (0..2)
                .map(|_| {
                    let from = caller.random.pick(&[0, 1, 2, 3, 513, -1]);
                    texere_lap { from, to: caller.random.pick(&[from, from + 1, from - 1, from + 2, 9]) }
                })
                .collect();
            if is_sound {
                laps = vec![texere_lap { from: 1, to: 0 }, texere_lap { from: 1, to: 2 }];
            }
            let threading = [caller.random.choice(2), TEXERE_NO_YARN];
            let mut bar = texere_bar {
                laps: laps.as_ptr(),
                lap_count: caller.random.pick(&[2, 2, 2, 2, 1, 0]),
                threading: threading.as_ptr(),
                guide_count: caller.random.below(3) as u64,
                run_in_mm: caller.random.pick(&[0.0, 0.0, 1500.0, -1.0]),
                offset: caller.random.pick(&[0, 0, 1, -2, i32::MIN]),
                reserved: 0,
            };
            if is_sound {
                bar = texere_bar { lap_count: 2, guide_count: 2, run_in_mm: 0.0, offset: 0, ..bar };
            }
            let colors = [(); 4].map(|()| caller.random.choice(2) as u8);
            let shifts = [(); 8].map(|()| caller.random.pick(&[0, 0, 0, 1, 1, 2]));
            let jacquard = texere_jacquard {
                guides: caller.random.pick(&[0, 2, 2, u32::MAX]),
                rounds: caller.random.pick(&[1, 2, 2, 0]),
                colors: colors.as_ptr(),
                color_count: caller.random.pick(&[2, 2, 2, 1, 0, 257]),
                shifts: shifts.as_ptr(),
            };
            // These sizes would read past the end of `colors`, which is not allowed.
            let is_wide = jacquard.guides == u32::MAX && jacquard.rounds == 1;
            let jacquards = [jacquard; 2];
            let (bars, yarns) = ([bar; 2], [knit_yarn(caller), knit_yarn(caller)]);
            let mut knit = texere_warp_knit {
                jacquards: if is_wide || caller.random.one_in(2) { null() } else { jacquards.as_ptr() },
                cells: caller.random.choice(2),
                wales: caller.random.pick(&[2, 2, 2, 1, 0, u32::MAX]),
                courses: caller.random.pick(&[2, 2, 2, 1, 0, u32::MAX]),
                copies: [(); 2].map(|()| caller.random.pick(&[1, 1, 1, 2, 0, u32::MAX])),
                name: name.pointer(),
                name_length: name.length(),
                bars: bars.as_ptr(),
                bar_count: caller.random.pick(&[1, 2, 2, 0]),
                yarns: yarns.as_ptr(),
                yarn_count: caller.random.pick(&[2, 2, 2, 2, 1, 0]),
                wale_mm: caller.random.number(1.2),
                course_mm: caller.random.number(1.0),
                looks: looks.given(),
                ..caller.sized()
            };
            if is_sound {
                knit.jacquards = null();
                (knit.wales, knit.courses, knit.copies) = (2, 2, [1, 2]);
                (knit.bar_count, knit.yarn_count) = (1, 2);
                (knit.wale_mm, knit.course_mm) = (1.2, 1.0);
            }
            caller.out(|out| texere_design_warp_knit(&knit, out))
        };
    }
}
