//! Meshes of polygonal tubes turn inside out where a tube bends more tightly than its section
//! reaches inwards, for sections of any shape.

use texere_contact::{Drawn, drawn};
use texere_core::{ControlPoint, Section, Settings, Yarn, Yarns};

/// Half the width of the yarn, mm.
const RADIUS: f32 = 0.1;

/// An L whose notch contains the axis.
const L: &[[f32; 2]] = &[[-1.0, -1.0], [1.0, -1.0], [1.0, -0.5], [-0.5, -0.5], [-0.5, 1.0], [-1.0, 1.0]];
/// A triangle beside the axis.
const ASIDE: &[[f32; 2]] = &[[2.0, -0.5], [3.0, -0.5], [2.5, 0.5]];
/// A T, whose outline goes back beneath its head.
const T: &[[f32; 2]] =
    &[[-0.2, -1.0], [0.2, -1.0], [0.2, 0.6], [1.0, 0.6], [1.0, 1.0], [-1.0, 1.0], [-1.0, 0.6], [-0.2, 0.6]];

/// A star of five points, whose inner corners lie at this share of the outer ones.
fn star(inner: f32) -> Vec<[f32; 2]> {
    let corner = |number: u8| {
        let (turn, reach) =
            (f32::from(number) * 36.0_f32, if number.is_multiple_of(2) { 1.0 } else { inner });
        [reach * turn.to_radians().cos(), reach * turn.to_radians().sin()]
    };
    (0..10).map(corner).collect()
}

fn moved(outline: &[[f32; 2]], by: [f32; 2]) -> Vec<[f32; 2]> {
    outline.iter().map(|corner| [corner[0] + by[0], corner[1] + by[1]]).collect()
}

/// The quality of the mesh of a yarn with this section. The yarn bends to the left or to the right,
/// along a third of a circle with the radius `bend_mm` in the plane of x and y.
fn bent(outline: &[[f32; 2]], bend_mm: f32, left: bool, twist: f32) -> Drawn {
    let side = if left { 1.0 } else { -1.0 };
    let point = |number: u8| {
        let turn = (f32::from(number) * 10.0).to_radians();
        ControlPoint::new(bend_mm * turn.sin(), side * bend_mm * (1.0 - turn.cos()), 0.0, RADIUS)
    };
    let points: Vec<_> = (0..=12).map(point).collect();
    let mut yarns = Yarns::builder();
    let section = yarns.section(Section::Polygon(outline.to_vec()));
    yarns.yarn(Yarn { section, twist, ..Yarn::default() }, &points);
    drawn(&yarns.build().unwrap(), &Settings::default()).unwrap()
}

#[test]
fn sound_polygons_of_a_gently_bent_yarn_face_outwards() {
    for outline in [
        L.to_vec(),
        ASIDE.to_vec(),
        T.to_vec(),
        star(0.3),
        star(0.6),
        moved(L, [0.5, 0.5]),
        moved(&star(0.4), [-1.5, 1.0]),
        moved(T, [0.0, 2.0]),
    ] {
        for left in [true, false] {
            for twist in [0.0, 0.5] {
                let found = bent(&outline, 4.0, left, twist);
                assert!(found.is_sound(), "{outline:?}, left {left}, twist {twist}: {found:?}");
            }
        }
    }
}

/// A section that reaches to one side of the axis only. Bent to that side, the tube turns inside
/// out if the section reaches beyond the centre of the bend. Bent to the other side, it never does.
#[test]
fn a_bend_tighter_than_the_section_reaches_is_inside_out() {
    // Triangles from 2 to 3 radii beside the axis.
    for (bend_mm, inside_out) in [(0.5, 0), (0.18, 1)] {
        let found = [true, false].map(|left| bent(ASIDE, bend_mm, left, 0.0));
        let told = found.iter().filter(|found| found.inwards > 0).count();
        assert_eq!(told, inside_out, "{bend_mm} mm: {found:?}");
    }
    // Sections that reach one radius to every side.
    for outline in [L.to_vec(), T.to_vec(), star(0.3), star(0.6)] {
        for left in [true, false] {
            let found = bent(&outline, 0.05, left, 0.0);
            assert!(found.inwards > 0 && found.inwards_at.is_some(), "{outline:?}: {found:?}");
        }
    }
}
