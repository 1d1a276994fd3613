//! Writes the centrelines of the paper's cloth for other tools, which make meshes of them.
//!
//! `polylines ENDS PICKS FOLDER` writes `points.f32` (x, y, z of each ring) and `offsets.u64` (the
//! number of each yarn's first ring, and the number of all rings), both little-endian.

use std::error::Error;
use std::path::Path;

use texere::Pipeline;
use texere_bench::paper_cloth;
use texere_cpu::ParallelBackend;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let [ends, picks, folder] = arguments.as_slice() else {
        return Err("usage: polylines ENDS PICKS FOLDER".into());
    };
    let yarns = paper_cloth(ends.parse()?, picks.parse()?)?.yarns()?;
    let trajectory = Pipeline::new(&yarns).trajectory(&ParallelBackend::open()?)?;
    let points: Vec<u8> =
        trajectory.rings.iter().flat_map(|ring| ring.centre).flat_map(f32::to_le_bytes).collect();
    let offsets: Vec<u8> = trajectory.offsets.iter().flat_map(|offset| offset.to_le_bytes()).collect();
    std::fs::write(Path::new(folder).join("points.f32"), points)?;
    std::fs::write(Path::new(folder).join("offsets.u64"), offsets)?;
    Ok(())
}
