//! Writes an STL file piece by piece, with a writer of the program's own:
//! `cargo run --example stl`.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::ops::ControlFlow;

use texere::Pipeline;
use texere::mesh::MeshPiece;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let design = texere::read("designs/herringbone.wif")?;
    let yarns = design.yarns()?;
    let pipeline = Pipeline::new(&yarns).caps(true); // closed tubes, which 3D printers need
    let triangles = pipeline.plan()?.counts().triangles;
    let mut file = BufWriter::new(File::create(std::env::temp_dir().join("herringbone.stl"))?);
    file.write_all(&[0; 80])?;
    file.write_all(&u32::try_from(triangles)?.to_le_bytes())?;
    let mut places: Vec<[f32; 3]> = Vec::new();
    let flow = pipeline.stream(&*texere::open("cpu")?, |_, piece| {
        match piece {
            // All vertices of a chunk come before its indices.
            MeshPiece::Vertices { first, vertices } => {
                places.truncate(first as usize);
                places.extend(vertices.iter().map(|vertex| vertex.position));
            }
            MeshPiece::Indices { indices, .. } => {
                for corners in indices.chunks_exact(3) {
                    // A normal of zero tells readers of STL to compute it.
                    let mut facet = [0; 50];
                    let at = corners.iter().flat_map(|corner| places[*corner as usize]);
                    for (bytes, value) in facet[12..48].chunks_exact_mut(4).zip(at) {
                        bytes.copy_from_slice(&value.to_le_bytes());
                    }
                    if let Err(error) = file.write_all(&facet) {
                        return ControlFlow::Break(error);
                    }
                }
            }
            _ => {}
        }
        ControlFlow::Continue(())
    })?;
    if let ControlFlow::Break(error) = flow {
        return Err(error.into());
    }
    file.flush()?;
    Ok(())
}
