//! Meshes have enough rings for the twist of their yarns, or there is a warning.
#![cfg(feature = "toml")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::f32::consts::TAU;
use std::path::Path;

use texere::mesh::{TWIST_STEP, Undersampled};
use texere::yarn::Section;
use texere::{ControlPoint, Mesh, Pipeline, Settings, Yarn, Yarns};

/// An open cloth of woollen yarn of two plies, which turns about once between two crossings.
const TWEED: &str = "[weave]\nnotation = \"2/2\"\nends = 8\npicks = 8\n[finish]\nsettle = false\n\
    [yarns.wool]\ndiameter_mm = 0.9\nplies = 2\ntwist_per_m = 340\n[warp]\nyarns = [\"wool\"]\nspacing_mm = 3.1\n\
    [weft]\nyarns = [\"wool\"]\nspacing_mm = 2.3\n";
/// A knit of hard-twisted yarn of three plies, with S twist.
const JERSEY: &str = "knit = { chart = \"k\", repeat = [4, 4], loop_length_mm = 7.0 }\nfinish.settle = false\n\
    yarns.worsted = { diameter_mm = 0.4, plies = 3, twist_per_m = -1500 }\n";

fn yarns_of(design: &str, name: &str) -> Yarns {
    let folder = std::env::temp_dir().join(format!("texere-twist-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("design.toml");
    std::fs::write(&path, design).unwrap();
    let yarns = texere::read(Path::new(&path)).unwrap().yarns().unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    yarns
}

fn mesh(pipeline: Pipeline<'_>) -> Mesh {
    pipeline.mesh(&*texere::open("cpu").unwrap()).unwrap()
}

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn sum(a: Vector, b: Vector, share: f64) -> Vector {
    [0, 1, 2].map(|axis| a[axis] + share * b[axis])
}

fn unit(a: Vector) -> Vector {
    a.map(|each| each / dot(a, a).sqrt())
}

/// The signed turns of the mesh from each ring of a yarn to the next, in degrees, and the length
/// from first ring to last, mm. The first corner of one ring is carried to the next by the smallest
/// turn from plane to plane.
fn turns(mesh: &Mesh, yarn: usize) -> (Vec<f64>, f64) {
    let sides = mesh.plan.settings().sides as usize;
    let offsets = mesh.plan.ring_offsets();
    let own = offsets[yarn] as usize * sides..offsets[yarn + 1] as usize * sides;
    let rings = mesh.vertices[own].chunks_exact(sides).map(|ring| {
        let corners: Vec<Vector> = ring.iter().map(|vertex| vertex.position.map(f64::from)).collect();
        let centre = corners.iter().fold([0.0; 3], |all, corner| sum(all, *corner, 1.0 / sides as f64));
        let arms: Vec<Vector> = corners.iter().map(|corner| sum(*corner, centre, -1.0)).collect();
        let round = (0..sides).map(|k| cross(arms[k], arms[(k + 1) % sides]));
        (centre, unit(round.fold([0.0; 3], |all, each| sum(all, each, 1.0))), arms[0])
    });
    let rings: Vec<_> = rings.collect();
    let mut length = 0.0;
    let turns = rings.windows(2).map(|pair| {
        let ((here, normal, arm), (next, next_normal, next_arm)) = (pair[0], pair[1]);
        let chord = sum(next, here, -1.0);
        length += dot(chord, chord).sqrt();
        // The turn that takes one normal to the other, by Rodrigues' formula.
        let axis = cross(normal, next_normal);
        let carried = sum(
            sum(arm.map(|each| each * dot(normal, next_normal)), cross(axis, arm), 1.0),
            axis,
            dot(axis, arm) / (1.0 + dot(normal, next_normal)),
        );
        dot(cross(carried, next_arm), next_normal).atan2(dot(carried, next_arm)).to_degrees()
    });
    (turns.collect(), length)
}

/// Asserts that no ring of the mesh is turned by more than 30 degrees against the ring before, and
/// that all turns together are those of the twist.
fn follows(mesh: &Mesh, what: &str) {
    for (number, yarn) in mesh.plan.layout().yarns().iter().enumerate() {
        let (turns, length) = turns(mesh, number);
        assert!(turns.iter().all(|turn| turn.abs() < 30.1), "{what}, yarn {number}: {turns:?}");
        let (all, asked) = (turns.iter().sum::<f64>(), f64::from(yarn.twist).to_degrees() * length);
        // A closed yarn loses up to half a turn, which is shared out over its rings. Frames of
        // crimped yarns turn a little even without twist.
        let off = if yarn.closed { 181.0 } else { 2.0 + 0.002 * asked.abs() };
        assert!((all - asked).abs() < off, "{what}, yarn {number}: {all} for {asked}");
    }
}

#[test]
fn rings_follow_the_twist_of_cloth() {
    for (name, design) in [("tweed", TWEED), ("jersey", JERSEY)] {
        let yarns = yarns_of(design, name);
        follows(&mesh(Pipeline::new(&yarns)), name);
        assert_eq!(Pipeline::new(&yarns).undersampled(), None, "{name}");
    }
}

/// Yarns of every section whose outline is no circle, with points near and far apart, bent and
/// closed, at two tensions.
#[test]
fn rings_follow_the_twist_of_every_section_and_way() {
    let sections = [
        Section::plied(2),
        Section::Ellipse { aspect: 1.5 },
        Section::Lenticular { aspect: 2.0, distortion: 0.0 },
        Section::PowerEllipse { aspect: 1.2, exponent: 0.7 },
        Section::Polygon(
            [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|k| [(k * TAU / 6.0).cos(), (k * TAU / 6.0).sin()]).to_vec(),
        ),
    ];
    let uneven = [0.0, 0.6, 1.1, 3.1, 3.7, 6.0, 7.1].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.2));
    let bent = [[0.0, 0.0], [2.0, 0.2], [2.5, 2.0], [0.4, 2.6], [0.0, 5.0]]
        .map(|[x, y]| ControlPoint::new(x, y, 0.0, 0.05));
    let ring = [0.0, 1.0, 2.0, 3.0, 4.0]
        .map(|k| ControlPoint::new(2.0 * (k * TAU / 5.0).cos(), 2.0 * (k * TAU / 5.0).sin(), 0.0, 0.1));
    for section in sections {
        for tension in [0.0, 0.4] {
            let mut yarns = Yarns::builder();
            yarns.section(section.clone());
            for (closed, twist, points) in
                [(false, 2.9, &uneven[..]), (false, -3.7, &bent[..]), (true, 2.2, &ring[..])]
            {
                yarns.yarn(Yarn { closed, twist, ..Yarn::default() }, points);
            }
            yarns.tension(tension);
            let yarns = yarns.build().unwrap();
            follows(&mesh(Pipeline::new(&yarns)), &format!("{section:?}"));
            let settings = Settings::default().following(&yarns);
            follows(&mesh(Pipeline::new(&yarns).settings(settings)), &format!("{section:?}"));
        }
    }
}

/// The warning names a number of subdivisions that helps. That number shows the twist, and one less
/// does not. The step in the warning is that of the mesh.
#[test]
fn subdivisions_that_are_fixed_are_warned_of() {
    let yarns = yarns_of(TWEED, "fixed");
    let found = Pipeline::new(&yarns).subdivisions(1).undersampled().unwrap();
    assert!(found.step > TWIST_STEP && found.to_string().starts_with("undersampled twist: "), "{found}");
    let needed = u32::try_from(found.needed).unwrap();
    assert!(found.to_string().ends_with(&format!("{needed} subdivisions do")), "{found}");
    assert!(Pipeline::new(&yarns).subdivisions(needed - 1).undersampled().is_some());
    assert_eq!(Pipeline::new(&yarns).subdivisions(needed).undersampled(), None);
    // The warning's step is that of the mesh, within the half turn that a mesh can show.
    let few = Pipeline::new(&yarns).subdivisions(needed - 2);
    let said = few.undersampled().unwrap().step.to_degrees();
    let (turns, _) = turns(&mesh(few), found.yarn);
    let most = turns.iter().fold(0.0_f64, |most, turn| most.max(turn.abs()));
    assert!((said - most).abs() < 0.05 * said, "{said} for {most}");
}

/// Twist that no mesh of usual size shows ends in a bound and a warning, for one yarn and for a
/// whole cloth.
#[test]
fn hostile_twist_makes_no_giant() {
    for (threads, rings_max) in [(1, 64 * 1_000), (100, 1 << 21), (3_000, 1 << 21)] {
        let mut yarns = Yarns::builder();
        yarns.section(Section::plied(2));
        for y in 0..threads {
            let points: Vec<_> =
                (0..1_000).map(|x| ControlPoint::new(x as f32, y as f32, 0.0, 0.2)).collect();
            yarns.yarn(Yarn { twist: 1e3, ..Yarn::default() }, &points);
        }
        let yarns = yarns.build().unwrap();
        let pipeline = Pipeline::new(&yarns);
        let plain = Pipeline::new(&yarns).subdivisions(1).plan().unwrap().counts().rings;
        let rings = pipeline.plan().unwrap().counts().rings;
        assert!(rings <= plain.max(rings_max), "{rings} for {plain}");
        let said = pipeline.undersampled().unwrap().to_string();
        assert!(said.contains("degrees") && said.contains("1023"), "{said}");
        assert!(Settings::of(&yarns).following_fibres(&yarns).subdivisions <= 63);
    }
}

/// Two-ply yarns without twist, and round yarns of little twist, have the rings of one subdivision,
/// as the paper has.
#[test]
fn what_shows_no_twist_has_no_more_rings() {
    let plain = TWEED.replace("twist_per_m = 340\n", "");
    let round = TWEED.replace("plies = 2\n", "").replace("340", "100");
    for (name, design) in [("untwisted", &plain), ("round", &round)] {
        let yarns = yarns_of(design, name);
        let [usual, fixed] = [Pipeline::new(&yarns), Pipeline::new(&yarns).subdivisions(1)].map(mesh);
        assert!(usual.vertices == fixed.vertices && usual.indices == fixed.indices, "{name}");
        assert_eq!(Undersampled::of(&yarns, &Settings::default()), None, "{name}");
    }
    // In a picture the fibres show the twist of a round yarn, too.
    let yarns = yarns_of(&round.replace("= 100", "= 300"), "fibres");
    assert!(Settings::default().following_fibres(&yarns).subdivisions > Settings::of(&yarns).subdivisions);
}
