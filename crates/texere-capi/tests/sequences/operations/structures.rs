//! Operations that make designs from arrays.

use texere_c::*;

use super::Operation;
use crate::caller::{Caller, Text};

/// Random materials and sections, which `looks` refers to.
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
        twist: 0.0,
        material: caller.random.pick(&[0, 0, 0, 0, 0, 0, 0, 0, 0, 1]),
        section: 0,
        reserved: 0,
    }
}

fn knit_yarn(caller: &mut Caller<'_>) -> texere_knit_yarn {
    let diameter_mm = caller.random.number(0.2);
    texere_knit_yarn { diameter_mm, twist: 0.5, material: 0, section: 0, reserved: 0 }
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
            let woven = texere_woven {
                shape: caller.random.choice(2),
                relief: caller.random.choice(3),
                selvedge: caller.random.choice(2),
                crimp: caller.random.choice(2),
                warp_share: caller.random.number(0.5) as f32,
                name: name.pointer(),
                name_length: name.length(),
                ends: caller.random.pick(&[ends as u64, ends as u64, ends as u64, 0]),
                picks: picks as u64,
                drawdown: texere_view { data: bits.as_mut_ptr().cast(), size, stride: 2 },
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
            let knit = texere_weft_knit {
                beds: caller.random.pick(&[1, 1, 1, 1, 2, 2, 0, u32::MAX]),
                cells: caller.random.choice(2),
                copies: [(); 2].map(|()| caller.random.pick(&[1, 1, 1, 2, 0, u32::MAX])),
                name: name.pointer(),
                name_length: name.length(),
                wales: wales as u64,
                courses: caller.random.pick(&[courses as u64, courses as u64, courses as u64, 0]),
                stitches: stitches.as_ptr(),
                turn: turn.as_ptr(),
                turn_count: caller.random.below(4) as u64,
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
            let laps: Vec<_> = (0..2)
                .map(|_| {
                    let from = caller.random.pick(&[0, 1, 2, 3, 513, -1]);
                    texere_lap { from, to: caller.random.pick(&[from, from + 1, from - 1, from + 2, 9]) }
                })
                .collect();
            let threading = [caller.random.choice(2), TEXERE_NO_YARN];
            let bar = texere_bar {
                laps: laps.as_ptr(),
                lap_count: caller.random.pick(&[2, 2, 2, 2, 1, 0]),
                threading: threading.as_ptr(),
                guide_count: caller.random.below(3) as u64,
                run_in_mm: caller.random.pick(&[0.0, 0.0, 1500.0, -1.0]),
                offset: caller.random.pick(&[0, 0, 1, -2, i32::MIN]),
                reserved: 0,
            };
            let (bars, yarns) = ([bar; 2], [knit_yarn(caller), knit_yarn(caller)]);
            let knit = texere_warp_knit {
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
            caller.out(|out| texere_design_warp_knit(&knit, out))
        };
    }
}
