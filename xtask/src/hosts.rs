//! Builds and runs programs in C, C++ and C# that link the installed C library, as the programs of
//! its users do.

use std::fs;
use std::path::Path;

use crate::build::Build;
use crate::install::install;
use crate::steps::{Steps, root};

/// Debian's packages that build and run the programs in C, C++ and C#.
pub(crate) const PACKAGES: [&str; 7] =
    ["cmake", "g++", "make", "mono-mcs", "mono-runtime", "pkg-config", "valgrind"];

/// Installs the library to a folder outside the repository, builds the examples against it, runs
/// them, and compares their meshes with those that the program writes.
pub(crate) fn check(steps: &mut Steps, build: Build) {
    if !cfg!(target_os = "linux") {
        println!("\nprograms that link the C library: left out, this is not Linux");
        return;
    }
    let folder = std::env::temp_dir().join(format!("texere-hosts-{}", std::process::id()));
    let prefix = folder.join("prefix");
    install(steps, &prefix, build);
    let program = root().join(build.folder()).join("texere");
    let places = [("PREFIX", prefix), ("OUT", folder.clone()), ("TEXERE", program)];
    let places = places.each_ref().map(|(name, place)| (*name, place.to_string_lossy()));
    let places = places.each_ref().map(|(name, place)| (*name, &**place));
    steps.run("programs that link the C library", &["sh", "xtask/src/hosts/run.sh"], &places);
    if steps.succeed()
        && let Err(difference) = compare(&folder)
    {
        steps.fail(format!("programs that link the C library: {difference}"));
    }
    let _ = fs::remove_dir_all(folder);
}

/// Compares the OBJ file of C++ and the arrays of C and C# with PLY files of the `texere` program.
/// `run.sh` compares the PLY files of C.
fn compare(folder: &Path) -> Result<(), String> {
    let read = |name: &str| fs::read(folder.join(name)).map_err(|error| format!("{name}: {error}"));
    let ply = |name: &str| Mesh::of_ply(&read(name)?).ok_or_else(|| format!("{name} is no mesh"));
    let same = |known: &Mesh, made: &Mesh, name: &str| {
        let same = known.corners().eq(made.corners());
        if same { Ok(()) } else { Err(format!("{name} is another mesh")) }
    };
    let obj = Mesh::of_obj(&String::from_utf8_lossy(&read("tricot.obj")?));
    same(&ply("tricot.ply")?, &obj, "tricot.obj")?;
    for (known, arrays) in [("herringbone.ply", "herringbone.bin"), ("placed.ply", "undone.bin")] {
        let known = ply(known)?;
        same(&known, &Mesh::of_arrays(&read(arrays)?, known.triangles.len()), arrays)?;
    }
    Ok(())
}

/// A mesh. Each vertex holds the bits of six `f32` values, its position and its normal.
#[derive(Debug, Default)]
struct Mesh {
    vertices: Vec<[u32; 6]>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The mesh of a binary PLY file, with three bytes of colour behind each vertex.
    fn of_ply(file: &[u8]) -> Option<Self> {
        let end = b"end_header\n";
        let body = file.windows(end.len()).position(|window| window == end)? + end.len();
        let header = str::from_utf8(&file[..body]).ok()?;
        let count = |element: &str| {
            header.lines().find_map(|line| line.strip_prefix(element)?.trim().parse::<usize>().ok())
        };
        let (vertices, triangles) = file[body..].split_at_checked(count("element vertex")? * 27)?;
        let vertices = vertices.chunks(27).map(|vertex| words(&vertex[..24])).collect();
        let triangles = triangles.chunks(13).map(|face| words(&face[1..])).collect();
        let mesh = Self { vertices, triangles };
        (mesh.triangles.len() == count("element face")?).then_some(mesh)
    }

    /// The mesh of an OBJ file, in which a normal follows each position.
    fn of_obj(file: &str) -> Self {
        let mut mesh = Self::default();
        for line in file.lines() {
            let mut words = line.split_whitespace();
            let kind = words.next();
            let mut float = || words.next().and_then(|word| word.parse::<f32>().ok()).map_or(0, f32::to_bits);
            match kind {
                Some("v") => mesh.vertices.push([float(), float(), float(), 0, 0, 0]),
                Some("vn") => {
                    if let Some(vertex) = mesh.vertices.last_mut() {
                        vertex[3..].fill_with(float);
                    }
                }
                Some("f") => {
                    let mut corner = || words.next()?.split('/').next()?.parse::<u32>().ok()?.checked_sub(1);
                    mesh.triangles.push(std::array::from_fn(|_| corner().unwrap_or(u32::MAX)));
                }
                _ => {}
            }
        }
        mesh
    }

    /// The mesh in a file that holds an array of vertices, and behind it an array of indices.
    fn of_arrays(file: &[u8], triangles: usize) -> Self {
        let (vertices, triangles) = file.split_at(file.len().saturating_sub(triangles * 12));
        let [vertices, triangles] = [vertices.chunks(24), triangles.chunks(12)];
        Self { vertices: vertices.map(words).collect(), triangles: triangles.map(words).collect() }
    }

    /// The corners of all triangles in turn. A mesh that is made in parts has some vertices twice,
    /// where two parts meet. Its triangles have the same corners as those of a whole mesh.
    fn corners(&self) -> impl Iterator<Item = Option<&[u32; 6]>> {
        self.triangles.as_flattened().iter().map(|corner| self.vertices.get(*corner as usize))
    }
}

/// Numbers of four bytes each, the lowest byte first. Numbers for which there are too few bytes are
/// 0.
fn words<const COUNT: usize>(bytes: &[u8]) -> [u32; COUNT] {
    let mut words = bytes.chunks(4).map(|word| word.try_into().map_or(0, u32::from_le_bytes));
    std::array::from_fn(|_| words.next().unwrap_or(0))
}
