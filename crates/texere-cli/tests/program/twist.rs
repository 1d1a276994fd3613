//! Rings of meshes follow the twist of yarns, or there is a warning.

use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::{inspect, stderr, stdout, texere};

/// A cloth of ten ends and ten picks, 3 mm apart. `yarn` has the lines of the yarn's section and
/// twist.
fn cloth(folder: &Path, yarn: &str) -> PathBuf {
    let path = folder.join("cloth.toml");
    let text = format!(
        "[weave]\nnotation = \"3/1\"\nends = 10\npicks = 10\n[finish]\nsettle = false\n[yarns.a]\ndiameter_mm = 0.8\n\
         {yarn}\n[warp]\nyarns = [\"a\"]\nspacing_mm = 3.0\n[weft]\nyarns = [\"a\"]\nspacing_mm = 3.0\n"
    );
    std::fs::write(&path, text).unwrap();
    path
}

/// The bytes of a design's mesh, and the text on standard output.
fn mesh(design: &Path, more: &[&str]) -> (Vec<u8>, String) {
    let out = design.with_extension("ply");
    let own = ["mesh", design.to_str().unwrap(), "-o", out.to_str().unwrap(), "--device", "cpu"];
    let output = texere(&[&own, more].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    (std::fs::read(out).unwrap(), stdout(&output))
}

/// The corners of the rings of a PLY file, yarn after yarn. Tubes have six sides. A yarn ends where
/// the next ring is far away.
fn tubes(file: &[u8]) -> Vec<Vec<[[f64; 3]; 6]>> {
    let end = b"end_header\n";
    let start = file.windows(end.len()).position(|bytes| bytes == end).unwrap() + end.len();
    let header = std::str::from_utf8(&file[..start]).unwrap();
    let vertices: usize =
        header.lines().find_map(|line| line.strip_prefix("element vertex ")).unwrap().parse().unwrap();
    let properties =
        |of: &str| header.lines().filter(|line| line.starts_with(&format!("property {of}"))).count();
    let stride = 4 * properties("float") + properties("uchar");
    let corners = file[start..].chunks_exact(stride).take(vertices).map(|vertex| {
        [0, 4, 8].map(|at| f64::from(f32::from_le_bytes(vertex[at..at + 4].try_into().unwrap())))
    });
    let corners: Vec<_> = corners.collect();
    let mut tubes: Vec<Vec<[[f64; 3]; 6]>> = Vec::new();
    for ring in corners.chunks_exact(6) {
        let ring: [[f64; 3]; 6] = ring.try_into().unwrap();
        match tubes.last_mut() {
            Some(tube) if length(between(centre(tube.last().unwrap()), centre(&ring))) < 5.0 => {
                tube.push(ring)
            }
            _ => tubes.push(vec![ring]),
        }
    }
    tubes
}

fn centre(ring: &[[f64; 3]; 6]) -> [f64; 3] {
    [0, 1, 2].map(|axis| ring.iter().map(|corner| corner[axis]).sum::<f64>() / 6.0)
}

fn between(from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| to[axis] - from[axis])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// The turn of the ring `other` against the ring `one` before it, in degrees, right-handed along
/// the yarn. The directions to the first corner of each ring are compared as seen along the chord
/// between the rings. For short steps this angle is nearly the turn of `other` against a copy of
/// `one` that is carried to `other` without turning.
fn turn(one: &[[f64; 3]; 6], other: &[[f64; 3]; 6]) -> f64 {
    let chord = between(centre(one), centre(other));
    let along = chord.map(|each| each / length(chord));
    let [here, next] = [one, other].map(|ring| {
        let arm = between(centre(ring), ring[0]);
        let share = dot(arm, along);
        [0, 1, 2].map(|axis| arm[axis] - share * along[axis])
    });
    let across = [
        here[1] * next[2] - here[2] * next[1],
        here[2] * next[0] - here[0] * next[2],
        here[0] * next[1] - here[1] * next[0],
    ];
    dot(across, along).atan2(dot(here, next)).to_degrees()
}

#[test]
fn plies_turn_by_thirty_degrees_a_ring_at_most_and_the_right_way() {
    let folder = TempDir::new().unwrap();
    for (yarn, turns_per_mm) in [
        ("plies = 2\ntwist_per_m = 300", 0.3),
        ("plies = 3\ntwist_per_m = -450", -0.45),
        ("section = { shape = \"ellipse\", aspect = 1.6 }\ntwist_per_m = 250", 0.25),
    ] {
        let path = cloth(folder.path(), yarn);
        let (file, said) = mesh(&path, &[]);
        assert!(!said.contains("warning"), "{said}");
        let tubes = tubes(&file);
        assert_eq!(tubes.len(), 20, "{yarn}");
        for tube in &tubes {
            let turns: Vec<_> = tube.windows(2).map(|pair| turn(&pair[0], &pair[1])).collect();
            let most = turns.iter().fold(0.0_f64, |most, turn| most.max(turn.abs()));
            assert!(most < 31.0, "{yarn}: {most}");
            let way: f64 =
                tube.windows(2).map(|pair| length(between(centre(&pair[0]), centre(&pair[1])))).sum();
            let (all, asked) = (turns.iter().sum::<f64>(), 360.0 * turns_per_mm * way);
            assert!((all / asked - 1.0).abs() < 0.02, "{yarn}: {all} degrees for {asked}");
        }
    }
}

#[test]
fn fixed_subdivisions_are_warned_of_by_the_step_and_by_what_helps() {
    let folder = TempDir::new().unwrap();
    let path = cloth(folder.path(), "plies = 2\ntwist_per_m = 300");
    let warning = |subdivisions: &str| {
        let fixed = ["--subdivisions", subdivisions];
        let (_, said) = mesh(&path, &fixed);
        let said = said
            .lines()
            .find_map(|line| line.strip_prefix("warning: undersampled twist: ").map(str::to_owned));
        let report = inspect(&[&[path.to_str().unwrap()], &fixed[..]].concat());
        let listed = report["warnings"]
            .as_array()
            .unwrap()
            .iter()
            .any(|each| each.as_str().unwrap().contains("undersampled"));
        assert_eq!(listed, said.is_some(), "{subdivisions}");
        said
    };
    let said = warning("1").unwrap();
    assert!(said.contains("degrees from ring to ring"), "{said}");
    let needed: u32 = said.split("; ").last().unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!(warning(&(needed - 1).to_string()).is_some());
    assert_eq!(warning(&needed.to_string()), None);
}

#[test]
fn hostile_twist_ends_in_a_bound_and_a_warning() {
    let folder = TempDir::new().unwrap();
    let path = cloth(folder.path(), "plies = 2\ntwist_per_m = 100000");
    let small = inspect(&["--counts", path.to_str().unwrap()]);
    let text = std::fs::read_to_string(&path)
        .unwrap()
        .replace("ends = 10", "ends = 400")
        .replace("picks = 10", "picks = 400");
    std::fs::write(&path, text).unwrap();
    let large = inspect(&["--counts", path.to_str().unwrap()]);
    for report in [small, large] {
        let [rings, points, bytes] =
            ["rings", "control_points", "bytes"].map(|key| report[key].as_u64().unwrap());
        assert!(rings <= 64 * points && bytes < 1 << 30, "{report}");
        assert!(report["warnings"][0].as_str().unwrap().starts_with("undersampled twist"), "{report}");
    }
}

#[test]
fn yarns_that_show_no_twist_have_the_mesh_of_one_subdivision() {
    let folder = TempDir::new().unwrap();
    for yarn in ["", "plies = 2", "section = { shape = \"ellipse\", aspect = 1.6 }"] {
        let path = cloth(folder.path(), yarn);
        assert!(mesh(&path, &[]) == mesh(&path, &["--subdivisions", "1"]), "{yarn}");
    }
}
