//! Textile designs to yarn-level 3D geometry.
//!
//! ```text
//! Design ──> Yarns ──> Pipeline on a device ──> Mesh ──> file
//! read       yarns     open                              write
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
//! let design = texere::read(&design_path)?; // .wif or .toml
//! let yarns = design.yarns()?;
//! let device = texere::open("auto")?;
//! let mesh = texere::Pipeline::new(&yarns).subdivisions(1).sides(6).mesh(&*device)?;
//! texere::write(&mesh, &mesh_path)?; // .glb or .ply
//! # std::fs::remove_dir_all(&folder)?;
//! # Ok(())
//! # }
//! ```
//!
//! Yarns are about where they belong. They come to rest with [`Structure::settle`], as the design's [`Finish`] says:
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let folder = std::env::temp_dir().join(format!("texere-doc-poplin-{}", std::process::id()));
//! # std::fs::create_dir_all(&folder)?;
//! # let design_path = folder.join("poplin.toml");
//! use std::ops::ControlFlow;
//! // Poplin: as round yarns its ends would pierce one another.
//! std::fs::write(&design_path, "weave = { notation = \"plain\", ends = 6, picks = 6 }\n\
//!     yarns.white.diameter_mm = 0.143\n\
//!     warp = { yarns = [\"white\"], spacing_mm = 0.19 }\n\
//!     weft = { yarns = [\"white\"], spacing_mm = 0.35 }\n")?;
//! let design = texere::read(&design_path)?;
//! let device = texere::open("cpu")?;
//! let finished = design.structure.settle(&design.finish, 0.0, &*device, |_| ControlFlow::Continue(()))?;
//! assert!(design.settle && finished.is_at_rest());
//! assert!(texere::clearance(&design.yarns()?, &texere::Settings::default())?.min < 0.9);
//! assert!(texere::clearance(finished.yarns(), &texere::Settings::default())?.min > 0.98);
//! let mesh = texere::Pipeline::new(finished.yarns()).mesh(&*device)?;
//! # assert!(!mesh.vertices.is_empty());
//! # std::fs::remove_dir_all(&folder)?;
//! # Ok(())
//! # }
//! ```
//!
//! Features: `opencl` and `wgpu` add GPU backends; without them the CPU does the work alone. `render` adds pictures.
//!
//! A cloth too large for memory is written piece by piece with [`stream`]. Yarns of any other origin come from
//! [`Yarns::builder`].

mod device;

#[cfg(feature = "render")]
pub use device::open_renderer;
pub use device::{Devices, devices, open};
pub use texere_core::{
    Backend, BackendError, Boundary, BoundaryError, Chunk, ControlPoint, Counts, DeviceInfo, DeviceKind,
    Ends, Frame, Limits, Material, Mesh, MeshPiece, Origin, Pipeline, PipelineError, Plan, PlanError,
    Progress, Ring, Schedule, Section, SectionError, Settings, SettlingError, Topology, Trajectory, Vertex,
    Yarn, YarnError, Yarns, YarnsBuilder,
};
pub use texere_core::{crossings, settling};
pub use texere_fabric::{
    CLEARANCE_ACCURACY, CLEARANCE_BESIDE, CLEARANCE_BIN, CLEARANCE_NEAR, CLEARANCE_PAIRS, Clearance,
    ClothClearance, Contact, Cover, Crimp, Crossing, Crowd, Cure, Diagnosis, Draft, Drawdown, FabricError,
    FabricWarning, FaultKind, Faults, Finish, FinishError, Finished, JamReport, Jams, KnitMeasures,
    LINKING_CHANGE, Linking, Measures, NO_CROSSING, Passage, Piece, Pitch, Relief, Remedy, Repeat, Sett,
    Settled, Shape, Shedding, Stretch, Structure, Thread, ThreadBend, ThreadContact, ThreadCrowd,
    ThreadPlace, Tightness, Weave, Woven, WovenDesign, WovenRest, YarnPlace, clearance,
    clearance_with_progress, length_mm, lengths_mm, linking, linking_with_progress, settle, warp, weft,
    yarns_under,
};
pub use texere_formats::write::{
    Format, Output, Side, Written, abandon, draft as write_draft, file as write_file,
    knit_draft as write_knit_draft, knit_rows, mesh as write, picture as write_picture, stream,
    warp_draft as write_warp_draft, warp_rows,
};
pub use texere_formats::{Design, MachineFault, Place, ReadError, Told, WriteError, read};
#[cfg(feature = "render")]
pub use texere_render::{
    Camera, Cut, Extent, Picture, PictureTimings, Quality, RenderError, Renderer, Scene, chunk_limits,
};
