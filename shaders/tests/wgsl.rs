//! Every shader parses and validates, and has the layouts, bindings and sizes of the Rust code that
//! launches it. No device is needed.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

use std::collections::BTreeMap;
use std::mem::offset_of;

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, ArraySize, Module, StorageAccess, TypeInner};
use texere_core::backend::Block;
use texere_core::crossings::{CrossingState, ThreadState};
use texere_core::definitions::Ring;
use texere_core::settling::Place;
use texere_core::{ArcLength, Attribute, ControlPoint, PackedVertex, SectionPoint, Vertex};
use texere_gpu::{
    BoundsRow, CapRow, ChordRow, CrossingSite, CrossingsParams, CrossingsSeenRow, ExtentRow, Language,
    Params, PlaceRow, SeenRow, SettledParams, SettledRow, SettlingParams, StrandRow, ThreadRow, YarnRow,
    prelude,
};
use texere_shaders::{ALL, Access, Shader, UNPACK, crossings, picture, settling};

/// The shaders of meshes and those that bring yarns and crossings to rest.
fn all() -> impl Iterator<Item = &'static Shader> {
    ALL.into_iter().chain(settling::ALL).chain(crossings::ALL)
}

fn parse(shader: &Shader) -> (Module, ModuleInfo) {
    parse_source(&(prelude(Language::Wgsl, true) + shader.source))
}

fn parse_source(source: &str) -> (Module, ModuleInfo) {
    // The shaders are core WGSL, and need no feature that a device may lack. All devices but those
    // of OpenGL read half floats.
    parse_with(source, Capabilities::SHADER_FLOAT16_IN_FLOAT32)
}

fn parse_with(source: &str, capabilities: Capabilities) -> (Module, ModuleInfo) {
    let module = naga::front::wgsl::parse_str(source)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
    let info = Validator::new(ValidationFlags::all(), capabilities)
        .validate(&module)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
    (module, info)
}

/// The vertices are laid out as in `PACKED_LAYOUT` of texere-wgpu.
#[test]
fn what_unpacks_stands_alone_in_a_vertex_shader() {
    let (module, _) = parse_source(&format!(
        "{UNPACK}
        @vertex fn draw(@location(0) words: vec2<u32>, @location(1) normal: vec2<f32>) -> @builtin(position) vec4<f32> {{
            return vec4(unpacked_position(words, vec3(0.0), 0.25) + unpacked_normal(normal), 1.0);
        }}"
    ));
    assert_eq!((module.entry_points.len(), module.global_variables.len()), (1, 0));
}

#[test]
fn picture_shaders_have_their_entry_points() {
    for (before, source, entries) in [
        ("", picture::KEPT, &[][..]),
        ("", picture::VISIBILITY, &["visibility"]),
        (picture::far(false), picture::SHADE, &["shade"]),
        (picture::far(true), picture::SHADE, &["shade"]),
        ("", picture::GATHER, &["gather"]),
    ] {
        let (module, _) = parse_source(&(before.to_owned() + source));
        let names: Vec<_> = module.entry_points.iter().map(|entry| entry.name.as_str()).collect();
        assert_eq!(names, entries);
    }
}

/// The shaders that draw without a mesh follow the prelude for round yarns alone and that for all
/// yarns, each without hairs and with hairs.
#[test]
fn drawing_shaders_have_their_entry_points() {
    let core = Capabilities::SHADER_FLOAT16_IN_FLOAT32;
    let long = core | Capabilities::SHADER_INT64 | Capabilities::SHADER_INT64_ATOMIC_MIN_MAX;
    for (source, capabilities, entries) in [
        (picture::CULL, core, &["cull", "list_all", "count_listed", "count_left"][..]),
        (picture::RASTER_IN_ROUNDS[0], core, &["raster", "raster_few", "raster_many", "raster_caps"]),
        (picture::RASTER_IN_ROUNDS[1], core, &["raster", "raster_few", "raster_many", "raster_caps"]),
        (picture::RASTER[0], long, &["raster", "raster_few", "raster_many", "raster_caps"]),
        (picture::RASTER[1], long, &["raster", "raster_few", "raster_many", "raster_caps"]),
        (picture::HAIRS_IN_ROUNDS, core, &["hairs"]),
        (picture::HAIRS, long, &["hairs"]),
        (picture::RESOLVE, core, &["resolve"]),
    ] {
        for (flattened, hairs) in [(false, false), (false, true), (true, false), (true, true)] {
            let before = prelude(Language::Wgsl, flattened) + picture::hairy(hairs);
            let (module, _) = parse_with(&(before + source), capabilities);
            let names: Vec<_> = module.entry_points.iter().map(|entry| entry.name.as_str()).collect();
            assert_eq!(names, entries);
        }
    }
}

/// The offset of each member of structure `name`, and the stride of the structure in an array.
fn layout(module: &Module, name: &str) -> (BTreeMap<String, usize>, usize) {
    let (_, ty) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).unwrap();
    let TypeInner::Struct { members, span } = &ty.inner else { panic!("{name} is no structure") };
    let members = members.iter().map(|member| (member.name.clone().unwrap(), member.offset as usize));
    (members.collect(), *span as usize)
}

macro_rules! same_layout {
    ($module:expr, $type:ident { $($field:ident),+ }) => {{
        let members = BTreeMap::from([$((stringify!($field).to_owned(), offset_of!($type, $field))),+]);
        assert_eq!(layout($module, stringify!($type)), (members, size_of::<$type>()), stringify!($type));
    }};
}

#[test]
fn tables_lie_as_in_rust() {
    for shader in ALL {
        let (module, _) = parse(shader);
        same_layout!(
            &module,
            Block { yarn, first_ring, rings, quads, first_point, chunk_ring, first_vertex, first_index }
        );
        same_layout!(&module, YarnRow { rings, first_block, section, closed, twist, frame });
        same_layout!(
            &module,
            CapRow { yarn, end, first_point, ring_vertex, first_vertex, first_index, first_corner, padding }
        );
        same_layout!(
            &module,
            Params {
                blocks,
                caps,
                first_yarn,
                yarns,
                sides,
                subdivisions,
                leans,
                indexed,
                rolled,
                s,
                step,
                quanta_per_mm
            }
        );
    }
}

#[test]
fn tables_of_settling_lie_as_in_rust() {
    // The scan needs none of these structures.
    for shader in settling::ALL.into_iter().filter(|shader| shader.source.contains("struct SettlingParams")) {
        let (module, _) = parse(shader);
        same_layout!(&module, PlaceRow { tags, yarn, first_chord, start_length });
        same_layout!(&module, StrandRow { first, points, goes_on, shift_x, shift_y, length, padding });
        same_layout!(&module, ExtentRow { low_x, low_y, high_x, high_y, longest, padding });
        same_layout!(&module, SeenRow { clearance, radius, length, step });
        same_layout!(
            &module,
            SettlingParams {
                places,
                chords,
                yarns,
                flags,
                unit,
                per_mm,
                s,
                growth,
                ease,
                momentum,
                half_gap,
                tension,
                period_x,
                period_y,
                frequency_x,
                frequency_y,
                diameter,
                along,
                low_x,
                low_y,
                size_x,
                size_y,
                count_x,
                count_y
            }
        );
    }
}

#[test]
fn tables_of_crossings_lie_as_in_rust() {
    let (module, _) = parse(&crossings::MOVE);
    same_layout!(&module, ThreadRow { gap, radius, stiffness, aspect, shape, least_area, freedom, height });
    same_layout!(
        &module,
        CrossingsParams {
            crossings,
            ends,
            picks,
            flags,
            tension_warp,
            tension_weft,
            press,
            penalty,
            area,
            pass_number,
            padding
        }
    );
    // Shaders read these as vectors, so the order of the fields matters.
    assert_eq!((offset_of!(CrossingState, warp), offset_of!(CrossingState, weft)), (0, 16));
    assert_eq!([offset_of!(ThreadState, shift), offset_of!(ThreadState, height)], [0, 4]);
    assert_eq!([offset_of!(ThreadState, half_width), offset_of!(ThreadState, half_height)], [8, 12]);
    assert_eq!([offset_of!(CrossingsSeenRow, step), offset_of!(CrossingsSeenRow, clearance)], [0, 4]);
}

/// For each binding, the bytes of an element of each runtime array that the shader binds there.
fn elements(module: &Module) -> BTreeMap<u32, Vec<usize>> {
    let mut elements = BTreeMap::<u32, Vec<usize>>::new();
    for (_, global) in module.global_variables.iter() {
        let Some(binding) = global.binding else { continue };
        if let TypeInner::Array { size: ArraySize::Dynamic, stride, .. } = module.types[global.ty].inner {
            elements.entry(binding.binding).or_default().push(stride as usize);
        }
    }
    elements
}

#[test]
fn tables_of_points_at_rest_lie_as_in_rust() {
    let (module, _) = parse(&settling::POINTS);
    same_layout!(&module, SettledParams { origin, unit, places, padding, more_padding });
    same_layout!(
        &module,
        SettledRow { first_place, points, first_point, closed, start_halves, end_halves, padding }
    );
    same_layout!(&module, BoundsRow { low, padding, high, more_padding });
}

#[test]
fn untyped_tables_have_elements_that_divide_the_rust_type() {
    // The bytes of the Rust type that each binding holds. A shader may read it in smaller pieces.
    let rust = [
        (1, size_of::<ControlPoint>()),
        (2, size_of::<YarnRow>()),
        (3, size_of::<Block>()),
        (4, size_of::<u32>()),
        (5, size_of::<SectionPoint>()),
        // An even number of sides has an even number of vertices and of quads, so shaders may read
        // two of them at a time.
        (6, 12 * size_of::<u32>()),
        (7, 2 * size_of::<Vertex>()),
        (8, 12 * size_of::<u32>()),
        (9, size_of::<Ring>()),
        (10, size_of::<CapRow>()),
        (11, size_of::<u32>()),
        (13, size_of::<PlaceRow>()),
        (14, size_of::<StrandRow>()),
        (15, size_of::<Place>()),
        (16, size_of::<ChordRow>()),
        // A chord is two vectors.
        (17, 32),
        (18, size_of::<u32>()),
        (19, size_of::<u32>()),
        (20, size_of::<u32>()),
        (21, size_of::<u32>()),
        (22, size_of::<f32>()),
        (23, size_of::<f32>()),
        (24, size_of::<SeenRow>()),
        (25, size_of::<ExtentRow>()),
        (26, size_of::<u32>()),
        (27, size_of::<u32>()),
        // A step is one vector.
        (28, 16),
        (29, size_of::<Place>()),
        (30, size_of::<SeenRow>()),
        (32, size_of::<SettledRow>()),
        (33, size_of::<BoundsRow>()),
        (35, size_of::<ThreadRow>()),
        (36, size_of::<CrossingSite>()),
        (37, size_of::<CrossingState>()),
        (38, size_of::<CrossingState>()),
        (39, size_of::<CrossingState>()),
        (40, size_of::<CrossingsSeenRow>()),
        (41, size_of::<CrossingsSeenRow>()),
        (42, size_of::<ArcLength>()),
        (43, size_of::<Attribute>()),
        // With an even number of sides shaders may write two at a time.
        (44, 2 * size_of::<PackedVertex>()),
    ];
    let rust = BTreeMap::from(rust);
    for shader in all() {
        for (binding, strides) in elements(&parse(shader).0) {
            for stride in strides {
                assert_eq!(rust[&binding] % stride, 0, "binding {binding} of {}", shader.entry_point);
            }
        }
    }
    let offsets = [offset_of!(ChordRow, from), offset_of!(ChordRow, to), offset_of!(ChordRow, thickest)];
    assert_eq!((offset_of!(Place, halves), offsets), (12, [4, 8, 12]));
    // Shaders read these as four components, so the order of the fields matters. The lower half
    // float comes first.
    assert_eq!((offset_of!(ControlPoint, x), offset_of!(ControlPoint, z)), (0, 8));
    let point: [u32; 4] = bytemuck::cast(ControlPoint::default().flattened(1.0, 2.0));
    assert_eq!(point[3], 0x4000_3c00);
    assert_eq!((offset_of!(SectionPoint, y), offset_of!(SectionPoint, normal_x)), (4, 8));
    assert_eq!(
        (offset_of!(Ring, half_width), offset_of!(Ring, tangent), offset_of!(Ring, roll)),
        (12, 16, 28)
    );
    let sizes =
        [offset_of!(Ring, half_height), offset_of!(Ring, width_growth), offset_of!(Ring, height_growth)];
    assert_eq!(sizes, [32, 36, 40]);
    assert_eq!((offset_of!(Vertex, position), offset_of!(Vertex, normal)), (0, 12));
    // Shaders write this word by word.
    assert_eq!((offset_of!(PackedVertex, position), offset_of!(PackedVertex, normal)), (0, 8));
    // Shaders write this as three pairs.
    let attribute =
        [offset_of!(Attribute, angle), offset_of!(Attribute, along), offset_of!(Attribute, tangent)];
    assert_eq!((offset_of!(Attribute, yarn), attribute), (0, [4, 8, 12]));
}

#[test]
fn entry_points_use_what_is_declared() {
    for shader in all() {
        let (module, info) = parse(shader);
        let index = module
            .entry_points
            .iter()
            .position(|entry| entry.name == shader.entry_point)
            .unwrap_or_else(|| panic!("no entry point {}", shader.entry_point));
        assert_eq!(
            module.entry_points[index].workgroup_size,
            [shader.workgroup, 1, 1],
            "{}",
            shader.entry_point
        );

        let mut used = BTreeMap::new();
        for (handle, global) in module.global_variables.iter() {
            let usage = info.get_entry_point(index)[handle];
            let Some(binding) = global.binding.filter(|_| !usage.is_empty()) else { continue };
            assert_eq!(binding.group, 0);
            let access = match global.space {
                AddressSpace::Uniform => Access::Uniform,
                AddressSpace::Storage { access } if access.contains(StorageAccess::STORE) => Access::Write,
                AddressSpace::Storage { .. } => Access::Read,
                space => panic!("{space:?}"),
            };
            assert_eq!(used.insert(binding.binding, access), None, "one type a binding");
        }
        let declared: BTreeMap<_, _> =
            shader.bindings.iter().map(|binding| (binding.resource as u32, binding.access)).collect();
        assert_eq!(used, declared, "{}", shader.entry_point);
        let storage = used.values().filter(|access| **access != Access::Uniform).count();
        assert!(storage <= 8, "{storage} storage buffers in {}", shader.entry_point);
    }
}

/// The workgroup memory that every device has, bytes.
const WORKGROUP_BYTES: u32 = 16_384;

#[test]
fn workgroup_memory_is_what_every_device_has() {
    for shader in all() {
        let (module, info) = parse(shader);
        let index = module.entry_points.iter().position(|entry| entry.name == shader.entry_point).unwrap();
        let used = module.global_variables.iter().filter(|(handle, global)| {
            global.space == AddressSpace::WorkGroup && !info.get_entry_point(index)[*handle].is_empty()
        });
        let bytes: u32 = used.map(|(_, global)| module.types[global.ty].inner.size(module.to_ctx())).sum();
        assert!(bytes <= WORKGROUP_BYTES, "{bytes} bytes in {}", shader.entry_point);
    }
}
