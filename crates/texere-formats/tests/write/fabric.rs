//! A small fabric with every case that files have to get right, and its expected mesh, which is
//! made without files.

use std::collections::BTreeMap;

use texere_core::{
    Bounds, ControlPoint, Limits, Material, Mesh, Origin, Pipeline, Section, Settings, Topology, Vertex,
    Yarn, Yarns,
};
use texere_cpu::SerialBackend;

/// A triangle: three vertices, each as the bits of six floats.
pub(crate) type Triangle = [[u32; 6]; 3];

/// Two ends of equal length, a closed yarn, a lobed yarn of unknown origin, and a pick. With one
/// subdivision of each interval the pick has 65 rings, one more than a block.
pub(crate) fn fabric() -> Yarns {
    let mut yarns = Yarns::builder();
    let materials: Vec<u32> = ["cotton \"raw\"\n", "Wolle, grün"]
        .map(String::from)
        .into_iter()
        .zip([[236, 229, 212], [10, 0, 255]])
        .map(|(name, srgb)| yarns.material(Material { name, srgb, ..Material::default() }))
        .collect();
    let (round, lobed) = (yarns.section(Section::Circle), yarns.section(Section::plied(3)));
    let wave = |points: u32, height: f32, along_x: bool| -> Vec<ControlPoint> {
        (0..points)
            .map(|step| {
                let (along, rise) = (step as f32 * 0.7, (step as f32 * 0.9).sin() * height);
                let [x, y] = if along_x { [along, 0.3] } else { [0.1, along] };
                ControlPoint::new(x, y, rise, 0.2 + 0.05 * (step % 3) as f32)
            })
            .collect()
    };
    let end = Yarn { material: materials[0], section: round, origin: Origin::End(1), ..Yarn::default() };
    yarns.yarn(end, &wave(40, 0.3, false));
    yarns.yarn(Yarn { origin: Origin::End(2), ..end }, &wave(40, -0.3, false));
    let ring: Vec<_> = (0..130)
        .map(|step| {
            let (sin, cos) = (step as f32 / 130.0 * std::f32::consts::TAU).sin_cos();
            ControlPoint::new(10.0 * cos, 10.0 * sin, 0.0, 0.3)
        })
        .collect();
    yarns.yarn(Yarn { closed: true, origin: Origin::Course(7), ..end }, &ring);
    yarns.yarn(Yarn { section: lobed, origin: Origin::Unknown, ..end }, &wave(2, 0.4, true));
    yarns.yarn(Yarn { material: materials[1], origin: Origin::Pick(1), ..end }, &wave(33, 0.2, true));
    yarns.build().unwrap()
}

/// One yarn with more gaps between rings than the index pattern of [`Topology::Shared`] covers.
pub(crate) fn long_yarn() -> Yarns {
    let mut yarns = Yarns::builder();
    let points: Vec<_> = (0..4200)
        .map(|step| ControlPoint::new(0.1 * step as f32, 0.1 * (step % 5) as f32, 0.0, 0.2))
        .collect();
    yarns.yarn(Yarn { origin: Origin::Carrier(3), ..Yarn::default() }, &points);
    yarns.build().unwrap()
}

/// Limits of buffers that hold a full block of 64 rings, a repeated ring and a cap, all with five
/// sides (7,920 bytes), and hardly more. Chunks therefore cut through yarns.
pub(crate) const TINY: Limits = Limits { binding_bytes: 8000, ..Limits::NONE };

/// Pairs of a topology and limits, which should make no difference to a file. Limits only decide
/// how the mesh is cut into chunks.
pub(crate) fn ways() -> Vec<(Topology, Limits)> {
    [Topology::Indexed, Topology::Shared, Topology::None]
        .into_iter()
        .flat_map(|topology| {
            [Limits::NONE, Limits { blocks: 3, ..Limits::NONE }, TINY].map(|limits| (topology, limits))
        })
        .collect()
}

pub(crate) fn settings(caps: bool) -> Settings {
    Settings { sides: 5, caps, ..Settings::default() }
}

pub(crate) fn pipeline(yarns: &Yarns, caps: bool, way: (Topology, Limits)) -> Pipeline<'_> {
    Pipeline::new(yarns).settings(settings(caps)).topology(way.0).limits(way.1)
}

/// The mesh in one piece, with the device's own indices.
pub(crate) fn whole(yarns: &Yarns, caps: bool) -> Mesh {
    pipeline(yarns, caps, (Topology::Indexed, Limits::NONE)).mesh(&SerialBackend::new()).unwrap()
}

/// Calls `each` with meshes of both fabrics, with caps and without, whole and cut in all ways, and
/// with words that name the mesh.
pub(crate) fn each_mesh(each: impl Fn(&Mesh, &str)) {
    for yarns in [fabric(), long_yarn()] {
        for caps in [false, true] {
            each(&whole(&yarns, caps), &format!("caps {caps}"));
            for way in ways() {
                let mesh = pipeline(&yarns, caps, way).mesh(&SerialBackend::new()).unwrap();
                each(&mesh, &format!("caps {caps}, {way:?}"));
            }
        }
    }
}

/// The triangles of each yarn, sorted, because chunks change their order.
pub(crate) fn triangles(mesh: &Mesh) -> BTreeMap<u32, Vec<Triangle>> {
    let mut triangles: BTreeMap<u32, Vec<Triangle>> = BTreeMap::new();
    for draw in mesh.draws() {
        let indices = &mesh.indices[draw.indices.start as usize..draw.indices.end as usize];
        let corner = |index: u32| bits(&mesh.vertices[(draw.base_vertex + u64::from(index)) as usize]);
        let all = indices.chunks_exact(3).map(|corners| [0, 1, 2].map(|k| corner(corners[k])));
        triangles.entry(draw.yarn).or_default().extend(all);
    }
    triangles.values_mut().for_each(|each| each.sort_unstable());
    triangles
}

fn bits(vertex: &Vertex) -> [u32; 6] {
    bytemuck::cast(*vertex)
}

#[test]
fn tiny_chunks_cut_where_it_hurts() {
    let yarns = fabric();
    let plan = pipeline(&yarns, true, (Topology::Shared, TINY)).plan().unwrap();
    let chunks: Vec<_> = plan.chunks(&TINY).unwrap().collect();
    let parts = || chunks.iter().flat_map(|chunk| chunk.parts());
    assert!(chunks.iter().any(|chunk| chunk.repeats_ring()), "a yarn goes on in the next chunk");
    assert!(parts().any(|part| part.rings == 1), "a lone ring, which no triangle has");
    assert!(chunks.iter().any(|chunk| chunk.parts().len() > 1), "two yarns share a chunk");
    assert!(chunks.iter().any(|chunk| chunk.caps().len() == 1), "one end of a yarn without the other");
}

/// A box in the fabric, which touches some blocks of the closed yarn and the first block of each of
/// the two ends.
pub(crate) fn region() -> Bounds {
    Bounds::rectangle([-12.0, 5.0], [0.4, 12.0])
}
