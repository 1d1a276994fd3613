//! Textile designs to yarn-level 3D geometry.
//!
//! ```text
//! Design ──> Cloth ──> Pipeline on a device ──> Mesh ──> file
//! read       rest      open                              write
//! ```
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let folder = std::env::temp_dir().join(format!("texere-doc-{}", std::process::id()));
//! # std::fs::create_dir_all(&folder)?;
//! # let design_path = folder.join("plain.toml");
//! # std::fs::write(&design_path, "[weave]\nnotation = \"plain\"\nends = 8\npicks = 8\n[yarns.ecru]\ntex = 50.0\n\
//! # [warp]\nyarns = [\"ecru\"]\nper_cm = 12.0\n[weft]\nyarns = [\"ecru\"]\nper_cm = 12.0\n")?;
//! # let mesh_path = folder.join("plain.glb");
//! let design = texere::read(&design_path)?; // .wif, .toml or .k
//! let device = texere::open("auto")?;
//! let cloth = design.rest(&*device).run()?; // its yarns come to rest
//! let mesh = texere::Pipeline::new(cloth.yarns()).mesh(&*device)?;
//! texere::write(&mesh, &mesh_path)?; // .glb or .ply
//! # std::fs::remove_dir_all(&folder)?;
//! # Ok(())
//! # }
//! ```
//!
//! [`Design::yarns`] gives the yarns as the structure places them. They may pierce one another
//! there. [`Design::rest`] lets them come to rest, as the design's [`Finish`](rest::Finish) says:
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let folder = std::env::temp_dir().join(format!("texere-doc-poplin-{}", std::process::id()));
//! # std::fs::create_dir_all(&folder)?;
//! # let design_path = folder.join("poplin.toml");
//! // Poplin: round yarns would pierce one another at this sett.
//! std::fs::write(&design_path, "weave = { notation = \"plain\", ends = 6, picks = 6 }\n\
//!     yarns.white.diameter_mm = 0.143\n\
//!     warp = { yarns = [\"white\"], spacing_mm = 0.19 }\n\
//!     weft = { yarns = [\"white\"], spacing_mm = 0.35 }\n")?;
//! let design = texere::read(&design_path)?;
//! assert!(texere::check::clearance(&design.yarns()?, &texere::Settings::default())?.min < 0.9);
//! let device = texere::open("cpu")?;
//! let cloth = design.rest(&*device).run()?;
//! assert_eq!(cloth.report().to_string(), "at rest");
//! assert!(texere::check::clearance(cloth.yarns(), &texere::Settings::default())?.min > 0.98);
//! let mesh = texere::Pipeline::new(cloth.yarns()).mesh(&*device)?;
//! # assert!(!mesh.vertices.is_empty());
//! # std::fs::remove_dir_all(&folder)?;
//! # Ok(())
//! # }
//! ```
//!
//! A WIF draft read by itself has no finish, so [`Design::rest`] leaves its yarns as placed unless
//! [`Design::settle`] is set to true. [`run`](rest::Resting::run) is `Ok` even if yarns don't come
//! to rest: [`Cloth::report`] then says so.
//!
//! # What to use
//!
//! | to | use |
//! |---|---|
//! | read a design from a file, or from memory with the files that it names | [`read()`], [`read_from`] |
//! | make a design in code | [`woven`], [`weft`], [`warp`], [`Design::of`] |
//! | build yarns of any other origin | [`Yarns::builder`], [`Yarns::placed`], [`Yarns::merged`]; [`yarn`] |
//! | let cloth come to rest | [`Design::rest`]; [`rest`] |
//! | make a whole mesh in memory, and write it | [`Pipeline::mesh`], [`write()`] |
//! | save yarns, such as cloth at rest, and read them again without settling | [`write::yarns`], [`read::yarns`] |
//! | write a mesh larger than memory, or a format of your own | [`write::stream`], [`Pipeline::stream`] |
//! | make a mesh of only the part of the cloth in a rectangle | [`Pipeline::within`] |
//! | edit a cloth and keep its mesh on a device | [`Live`] |
//! | draw with a pipeline of your own, on your own device | [`Live`]; `gpu` (feature `wgpu`) |
//! | know which yarn lies under the mouse | [`Live::pick`] or [`Picker`]; for the place in a weaver's words [`YarnPlace::at`], then [`Design::named`] |
//! | make vertices of 12 bytes, half the usual size | [`Pipeline::packed`], [`Session::packed`], [`Quantum`] |
//! | know yarn, angle and length along the yarn of each vertex | [`Pipeline::attributes`], [`Live::keep_attributes`] |
//! | make pictures | `picture` (feature `render`) |
//! | bake cloth to maps that tile, for programs that show it on a plane | `picture::bake` (feature `bake`) |
//! | know how many rings the twist of yarns needs | [`Settings::of`], [`Pipeline::undersampled`] |
//! | know what is wrong with a cloth | [`check`] |
//! | write a backend | [`mod@backend`] |
//!
//! [`YarnPlace::at`]: yarn::YarnPlace::at
//! [`Session::packed`]: backend::Session::packed
//! [`Quantum`]: mesh::Quantum
//!
//! # Modules
//!
//! The root of the crate has what every program needs. All other names are in modules, each in one.
//!
//! | module | holds |
//! |---|---|
//! | [`mod@read`] | saved yarns, and what readers report beside the design |
//! | [`mod@write`] | files of meshes, yarns, pictures, drafts and designs |
//! | [`woven`], [`weft`], [`warp`] | weaves, weft knits and warp knits in code |
//! | [`yarn`] | materials, sections, sizes, lengths |
//! | [`rest`] | finishing and settling |
//! | [`check`] | faults and measures |
//! | [`mesh`] | settings of a mesh, its pieces, its edits, rays |
//! | `picture` | rendering (feature `render`); in `picture::bake` maps of cloth (feature `bake`) |
//! | [`mod@backend`] | what a backend implements and uses |
//! | `gpu` | devices and buffers of OpenCL and `wgpu` (features `opencl`, `wgpu`) |
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `toml` | texere's own design files; brings `wif` |
//! | `wif` | drafts: WIF, Fiberworks PCW and WeavePoint |
//! | `knitout` | programs of knitting machines, alone and in design files |
//! | `glb`, `ply` | meshes as glTF 2.0 binary and as binary PLY |
//! | `obj`, `stl` | meshes as OBJ, with a file of materials, and as binary STL |
//! | `texgen` | yarns of TexGen (`.tg3`), read as curves |
//! | `opencl`, `wgpu` | GPU backends |
//! | `render` | pictures of cloth; brings `wgpu` and `pictures` |
//! | `bake` | maps of cloth that tile, as PNG, EXR, U3M and MaterialX; brings `render` |
//! | `pictures` | PNG files of drafts and pictures |
//! | `images` | point paper in design files |
//! | `serde` | reports of a cloth, which serialize |
//!
//! `toml`, `glb` and `ply` are default features. If a build leaves out the format of a file, the
//! error names the missing feature: [`ReadError::Feature`], [`WriteError::Feature`].
//!
//! # Threads
//!
//! texere works in the [rayon](https://docs.rs/rayon) pool of the calling thread, and starts no
//! threads of its own. The pool is the global one, or a pool of yours if you call from inside that
//! pool. All calls work in the pool, uploads to a GPU too. Open devices inside the pool as well:
//! the device `cpu` counts its threads when it is opened. Closures that report progress run on
//! threads of the pool.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
//! # let mut yarns = texere::Yarns::builder();
//! # yarns.yarn(texere::Yarn::default(), &[0.0, 1.0].map(|x| texere::ControlPoint::new(x, 0.0, 0.0, 0.1)));
//! # let yarns = yarns.build()?;
//! let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build()?;
//! let mesh = pool.install(|| {
//!     let device = texere::open("cpu")?;
//!     assert!(device.info().device.contains("2 threads"));
//!     Ok::<_, Box<dyn std::error::Error + Send + Sync>>(texere::Pipeline::new(&yarns).mesh(&*device)?)
//! })?;
//! assert!(!mesh.vertices.is_empty());
//! # Ok(())
//! # }
//! ```
//!
//! # Units and words
//!
//! Lengths are in mm, angles in radians, twist in rad/mm
//! ([`twist_from_turns_per_m`](yarn::twist_from_turns_per_m)). x runs along the weft or course, y
//! along the warp or wale, z out of the technical face; right-handed. Triangles are
//! counter-clockwise as seen from outside. Yarns, control points, ends and picks are counted from 0
//! in calls, and from 1 in texts for weavers.
//!
//! - *Control point*: a place of a yarn's centreline with its half width and half height.
//!   *Interval* j of the spline runs from point j to the next.
//! - *Ring*: a cross-section of the mesh. An interval has K + 1 rings: [`Settings::subdivisions`]
//!   is K. A ring has as many corners as [`Settings::sides`] says.
//! - *Roll*: how far a ring is turned about the centreline. A *scan* adds up the rolls of the steps
//!   from ring to ring along yarns.
//! - *Block*: up to 64 rings of one yarn.
//! - *Chunk*: blocks that are worked on, read and drawn together, few enough for the device's
//!   memory.
//! - *Slot*: a place for a chunk in a device's memory. A chunk is *in flight* from its first stage
//!   until another chunk takes its slot.
//! - *Room*: memory between the yarns of a [`Live`] mesh, so that a yarn may get longer without
//!   moving the other yarns.
//!
//! An error's message is one line. The message of a driver or a file system is the error's
//! [`source`](std::error::Error::source).

pub mod backend;
pub mod check;
mod device;
#[cfg(test)]
mod formats;
#[cfg(any(feature = "opencl", feature = "wgpu"))]
pub mod gpu;
mod live;
pub mod mesh;
#[cfg(feature = "render")]
pub mod picture;
pub mod read;
pub mod rest;
pub mod warp;
pub mod weft;
pub mod woven;
pub mod write;
pub mod yarn;

pub use device::{Devices, devices, open};
pub use live::Live;
pub use texere_core::{
    Backend, BackendError, Capabilities, ControlPoint, DeviceInfo, DeviceKind, Mesh, Pipeline, PipelineError,
    Settings, Vertex, Yarn, Yarns,
};
pub use texere_cpu::{Hit, Picker};
pub use texere_fabric::{FabricError, Structure};
pub use texere_formats::read::{read, read_from};
pub use texere_formats::write::mesh as write;
pub use texere_formats::{Cloth, Design, ReadError, WriteError};
