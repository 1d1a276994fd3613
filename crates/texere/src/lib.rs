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
//! [`Design::yarns`] are where the structure places them, about where they belong. [`Design::rest`]
//! lets them come to rest, as the design's [`Finish`](rest::Finish) says:
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let folder = std::env::temp_dir().join(format!("texere-doc-poplin-{}", std::process::id()));
//! # std::fs::create_dir_all(&folder)?;
//! # let design_path = folder.join("poplin.toml");
//! // Poplin: as round yarns its ends would pierce one another.
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
//! # What for what
//!
//! | to | take |
//! |---|---|
//! | read a design from a file, or from memory with whatever it names | [`read()`], [`read_from`] |
//! | make a design in code | [`woven`], [`weft`], [`warp`], [`Design::of`] |
//! | build yarns of any other origin | [`Yarns::builder`], [`Yarns::placed`], [`Yarns::merged`]; [`yarn`] |
//! | let cloth come to rest | [`Design::rest`]; [`rest`] |
//! | have a whole mesh in memory, write it | [`Pipeline::mesh`], [`write()`] |
//! | save cloth at rest, and have it again without settling | [`write::yarns`], [`read::yarns`] |
//! | write a mesh larger than memory, or a format of your own | [`write::stream`], [`Pipeline::stream`] |
//! | have only what lies in a rectangle | [`Pipeline::within`] |
//! | edit a cloth and keep its mesh on a device | [`Live`] |
//! | draw with a pipeline of your own, on your own device | [`Live`]; `gpu` (feature `wgpu`) |
//! | know what lies under the mouse | [`Live::pick`] or [`Picker`]; [`YarnPlace::at`], [`Structure::place`] and [`Design::named`] say it in words |
//! | have vertices in half the memory, 12 bytes each | [`Pipeline::packed`], [`Session::packed`], [`Quantum`] |
//! | know yarn, angle and length along the yarn of each vertex | [`Pipeline::attributes`], [`Live::keep_attributes`] |
//! | make pictures | `picture` (feature `render`) |
//! | know how many rings twist needs | [`Settings::of`], [`Pipeline::undersampled`] |
//! | say what is wrong with a cloth | [`check`] |
//! | write a backend | [`mod@backend`] |
//!
//! [`YarnPlace::at`]: yarn::YarnPlace::at
//! [`Session::packed`]: backend::Session::packed
//! [`Quantum`]: mesh::Quantum
//!
//! # Rooms
//!
//! What every program needs is here; the rest is in modules, each name in one of them.
//!
//! | module | holds |
//! |---|---|
//! | [`mod@read`], [`mod@write`] | what readers say beside the design; files of meshes, pictures, drafts and designs |
//! | [`woven`], [`weft`], [`warp`] | weaves, weft knits and warp knits in code |
//! | [`yarn`] | materials, sections, sizes, lengths |
//! | [`rest`] | finishing and settling |
//! | [`check`] | faults and measures |
//! | [`mesh`] | choices of a mesh, its pieces, its edits, rays |
//! | `picture` | rendering (feature `render`) |
//! | [`mod@backend`] | what a backend is written with |
//! | `gpu` | devices and buffers of OpenCL and `wgpu` (features `opencl`, `wgpu`) |
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `toml`, `wif`, `knitout` | texere's own design files, which brings `wif`; WIF drafts; programs of knitting machines, alone and in design files |
//! | `glb`, `ply` | meshes as glTF 2.0 binary and as binary PLY |
//! | `opencl`, `wgpu` | GPU backends; without them the CPU does the work alone |
//! | `render` | pictures of cloth; brings `wgpu` and `pictures` |
//! | `pictures` | PNG files of drafts and pictures |
//! | `images` | point paper in design files |
//!
//! `toml`, `glb` and `ply` are there unless `default-features = false`. What a build leaves out it
//! refuses by name: [`ReadError::Feature`], [`WriteError::Feature`].
//!
//! # Threads
//!
//! What texere does on the CPU it does in the [rayon](https://docs.rs/rayon) pool of the thread
//! that calls it, and it starts no thread of its own: in the global pool, or in one of yours where
//! you call it from there. That holds for all calls, also for uploads to a GPU. Open devices there,
//! too: `cpu` tells how many threads it has found. Closures that report progress are called from
//! threads of that pool.
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
//! # Words
//!
//! Lengths are in mm, angles in radians, twist in rad/mm
//! ([`twist_from_turns_per_m`](yarn::twist_from_turns_per_m)). x runs along the weft or course, y
//! along the warp or wale, z out of the technical face; right-handed. Triangles are
//! counter-clockwise seen from outside. Yarns, control points, ends and picks count from 0 in
//! calls, and from 1 where a weaver reads them.
//!
//! - *Control point*: a place of a yarn's centreline with its half width and half height.
//!   *Interval* j of the spline runs from point j to the next.
//! - *Ring*: a cross-section of the mesh; there are K + 1 of them an interval
//!   ([`Settings::subdivisions`] is the paper's K). Its corners are its *sides*
//!   ([`Settings::sides`], the paper's nc).
//! - *Roll*: how far a ring is turned about the centreline. A *scan* works out rolls along yarns.
//! - *Block*: up to 64 rings of one yarn. *Chunk*: blocks that are worked on, read and drawn
//!   together, cut to what a device can hold. *Slot*: a place for a chunk in a device's memory. A
//!   chunk is *in flight* from its first stage until another takes its slot.
//! - *Room*: memory between the yarns of a [`Live`] mesh, so that one may get longer without the
//!   others moving.
//!
//! Errors say what happened in one line; where a driver or a file system has more to say it is
//! their [`source`](std::error::Error::source).

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
