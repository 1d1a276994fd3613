//! Tests that kernels find each value of Rust's tables under the right name: the name of the field,
//! or the component or number that stands for the field. The kernels are compiled and run on the
//! device.

#![allow(
    clippy::undocumented_unsafe_blocks,
    reason = "every call of OpenCL is unsafe; handles live to the test's end"
)]

use crate::own_queue::{context, queue};
use opencl3::command_queue::CommandQueue;
use opencl3::context::Context;
use opencl3::kernel::{ExecuteKernel, Kernel};
use opencl3::memory::{Buffer, CL_MEM_READ_WRITE};
use opencl3::program::Program;
use std::mem::offset_of;
use std::ptr;
use texere_core::backend::Block;
use texere_core::definitions::Ring;
use texere_core::{ControlPoint, SectionPoint, Vertex};
use texere_gpu::{CapRow, Language, Params, YarnRow, prelude};
use texere_kernels::PER_RING;

/// A table as kernels read it, and the offset of each of its values in Rust's type, which has
/// `bytes` bytes.
struct Table {
    /// The type that the kernels' pointer points to.
    element: &'static str,
    bytes: usize,
    /// How kernels read a value of the table's second row, and its offset in Rust.
    values: Vec<(String, usize)>,
}

/// A structure with the same name and the same fields in both languages.
macro_rules! structure {
    ($type:ident { $($field:ident),+ $(,)? }) => {
        Table {
            element: stringify!($type),
            bytes: size_of::<$type>(),
            values: vec![$((concat!("values[1].", stringify!($field)).into(), offset_of!($type, $field))),+],
        }
    };
}

/// A structure of Rust that kernels read as vectors or as single numbers: each component or number,
/// and the field that it stands for.
macro_rules! vectors {
    ($element:literal, $type:ident { $($value:literal = $field:ident $(+ $axis:literal)?),+ $(,)? }) => {
        Table {
            element: $element,
            bytes: size_of::<$type>(),
            values: vec![$(($value.into(), offset_of!($type, $field) $(+ 4 * $axis)?)),+],
        }
    };
}

fn tables() -> Vec<Table> {
    vec![
        structure!(Block {
            yarn,
            first_ring,
            rings,
            quads,
            first_point,
            chunk_ring,
            first_vertex,
            first_index
        }),
        structure!(YarnRow { rings, first_block, section, closed, twist, frame }),
        structure!(CapRow {
            yarn,
            end,
            first_point,
            ring_vertex,
            first_vertex,
            first_index,
            first_corner,
            padding
        }),
        structure!(Params {
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
        }),
        vectors!("uint4", ControlPoint {
            "values[1].x" = x,
            "values[1].y" = y,
            "values[1].z" = z,
            "values[1].w" = halves
        }),
        vectors!("float4", SectionPoint {
            "values[1].x" = x,
            "values[1].y" = y,
            "values[1].z" = normal_x,
            "values[1].w" = normal_y
        }),
        vectors!("uint4", Ring {
            "values[3].x" = centre,
            "values[3].y" = centre + 1,
            "values[3].z" = centre + 2,
            "values[3].w" = half_width,
            "values[4].x" = tangent,
            "values[4].y" = tangent + 1,
            "values[4].z" = tangent + 2,
            "values[4].w" = roll,
            "values[5].x" = half_height,
            "values[5].y" = width_growth,
            "values[5].z" = height_growth,
            "values[5].w" = lean
        }),
        vectors!("float", Vertex {
            "values[6]" = position,
            "values[7]" = position + 1,
            "values[8]" = position + 2,
            "values[9]" = normal,
            "values[10]" = normal + 1,
            "values[11]" = normal + 2
        }),
    ]
}

/// The bits of value number `number` of a table. All are distinct, and each is a finite float, too.
fn bits(number: usize) -> u32 {
    0x3f80_0000 + number as u32
}

/// The values `names`, in order, that a kernel reads from its parameter `values`. `parameter`
/// declares it, and `set` sets it.
fn probe(
    context: &Context,
    queue: &CommandQueue,
    parameter: &str,
    names: &[String],
    set: impl Fn(&mut ExecuteKernel<'_>),
) -> Vec<u32> {
    let reads = names.iter().enumerate().map(|(at, name)| format!("found[{at}] = as_uint({name});\n"));
    let body: String = reads.collect();
    let probe = format!("__kernel void probe({parameter} values, __global uint *found) {{\n{body}}}\n");
    let source = prelude(Language::OpenClC, true) + &PER_RING.sources.concat() + &probe;
    let program = Program::create_and_build_from_source(context, &source, "-cl-std=CL1.2").unwrap();
    let kernel = Kernel::create(&program, "probe").unwrap();
    let mut found = vec![0; names.len()];
    unsafe {
        let out = Buffer::<u32>::create(context, CL_MEM_READ_WRITE, found.len(), ptr::null_mut()).unwrap();
        let mut launch = ExecuteKernel::new(&kernel);
        set(&mut launch);
        launch.set_arg(&out).set_global_work_size(1).enqueue_nd_range(queue).unwrap();
        queue.enqueue_read_buffer(&out, 1, 0, &mut found, &[]).unwrap();
    }
    found
}

#[test]
fn every_field_of_a_tables_second_row_is_read_under_its_name() {
    let (context, _) = context();
    let queue = queue(&context, 0);
    for Table { element, bytes, values } in tables() {
        let (names, offsets): (Vec<_>, Vec<_>) = values.into_iter().unzip();
        let words: Vec<u32> = (0..2 * bytes / 4).map(bits).collect();
        let expected: Vec<_> = offsets.iter().map(|offset| bits((bytes + offset) / 4)).collect();
        assert_eq!(names.len() * 4, bytes, "{element}: a value has no name");
        let mut table = unsafe {
            Buffer::<u32>::create(&context, CL_MEM_READ_WRITE, words.len(), ptr::null_mut()).unwrap()
        };
        unsafe { queue.enqueue_write_buffer(&mut table, 1, 0, &words, &[]).unwrap() };
        let parameter = format!("__global const {element} *");
        let found = probe(&context, &queue, &parameter, &names, |launch| unsafe {
            launch.set_arg(&table);
        });
        assert_eq!(found, expected, "{element}");
    }
}

/// Tests parameters that are passed as an argument, as launches do, and not through memory.
#[test]
fn parameters_arrive_as_they_are_set() {
    let words: [u32; size_of::<Params>() / 4] = std::array::from_fn(bits);
    let params: Params = bytemuck::cast(words);
    let Table { values, .. } = tables().into_iter().find(|table| table.element == "Params").unwrap();
    let (names, offsets): (Vec<_>, Vec<_>) = values.into_iter().unzip();
    let names: Vec<_> = names.iter().map(|name: &String| name.replace("values[1]", "values")).collect();
    let (context, _) = context();
    let queue = queue(&context, 0);
    let found = probe(&context, &queue, "const Params", &names, |launch| unsafe {
        launch.set_arg(&params);
    });
    let expected: Vec<_> = offsets.iter().map(|offset| words[offset / 4]).collect();
    assert_eq!(found, expected);
}
