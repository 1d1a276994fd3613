//! The mutants that the conformance suite has to catch. Each is a plausible mistake in a kernel
//! that makes rings or meshes, in the choice between programs, or in the prelude, the definitions
//! that stand before every kernel. Kernels for attributes, settling and pictures have no mutants.

/// A mutant: a part of a line of source code, and a broken replacement.
#[derive(Debug)]
pub(crate) struct Mutant {
    /// The backend's name, in `TEXERE_REQUIRE` and in the names of trials.
    pub(crate) backend: &'static str,
    /// The source, from the repository's root.
    pub(crate) file: &'static str,
    /// The kernel or the function that has the line, or `prelude`.
    pub(crate) kernel: &'static str,
    /// A part of a line that occurs once in the file.
    pub(crate) line: &'static str,
    /// The replacement of that part.
    pub(crate) broken: &'static str,
}

impl Mutant {
    /// The trials that run the kernel: those of the backend's first device, in the schedule that
    /// the file belongs to.
    pub(crate) fn trials(&self) -> Vec<String> {
        if self.file.contains("per_yarn") {
            vec![format!("{}:0/per-yarn", self.backend)]
        } else {
            vec![format!("{}:0", self.backend), "--skip".into(), "/per-yarn".into()]
        }
    }
}

const fn opencl(
    file: &'static str,
    kernel: &'static str,
    line: &'static str,
    broken: &'static str,
) -> Mutant {
    Mutant { backend: "opencl", file, kernel, line, broken }
}

const fn wgpu(file: &'static str, kernel: &'static str, line: &'static str, broken: &'static str) -> Mutant {
    Mutant { backend: "wgpu", file, kernel, line, broken }
}

/// All mutants. A kernel's OpenCL file and its WGSL file are twins, so they are broken in different
/// ways.
pub(crate) const MUTANTS: &[Mutant] = &[
    // The arctangent uses a wrong coefficient.
    opencl(
        "crates/texere-gpu/src/prelude.rs",
        "prelude",
        "float(\"ARCTANGENT_5\", ARCTANGENT[2]),",
        "float(\"ARCTANGENT_5\", ARCTANGENT[3]),",
    ),
    // The least radius between two control points is another share of their radii than in the core.
    wgpu(
        "crates/texere-gpu/src/prelude.rs",
        "prelude",
        "float(\"RADIUS_FLOOR\", RADIUS_FLOOR),",
        "float(\"RADIUS_FLOOR\", 0.9 * RADIUS_FLOOR),",
    ),
    // Flattened yarns get the program for round yarns.
    opencl("crates/texere-gpu/src/upload.rs", "runs", "!all_round(lent)", "lent.is_empty()"),
    // The yarn's last ring lies at the start of the last interval instead of at its end.
    opencl("kernels/src/common.cl", "ring_sample", "        t = 1.0f;", "        t = 0.0f;"),
    // The roll of a ring includes the turn from that ring to the next one.
    opencl("kernels/src/rings.cl", "block_rings", "start + sum - turn", "start + sum"),
    // Every block gets the roll of its yarn's first block. Yarns of one block don't show this.
    opencl(
        "kernels/src/rings.cl",
        "block_rings",
        "rolls[yarn->first_block + block->first_ring / BLOCK_RINGS]",
        "rolls[yarn->first_block]",
    ),
    // The step to the next block's first ring is left out.
    opencl("kernels/src/scan.cl", "block_turns", "lane < block.quads", "lane + 1u < block.quads"),
    // Only the sum of the tile before is added. Yarns of one or two tiles don't show this.
    opencl("kernels/src/scan.cl", "yarn_rolls", "before += sums", "before = sums"),
    // All rings of a block get the tangent of the first.
    opencl(
        "kernels/src/trajectory.cl",
        "trajectory",
        "float4 tangent = standing.tangent[ring];",
        "float4 tangent = standing.tangent[0];",
    ),
    // A store that begins with the end of a normal gets the normal of the next vertex.
    opencl(
        "kernels/src/mesh.cl",
        "mesh",
        "normal_point = outline[4u * store / 6u];",
        "normal_point = outline[(4u * store + 2u) / 6u];",
    ),
    // If a ring has more stores than a workgroup has lanes, no lane stores anything.
    opencl(
        "kernels/src/share.cl",
        "share_of",
        "share.across = min(stores, lanes);",
        "share.across = stores;",
    ),
    // The upper bits of a coordinate run into the next one.
    opencl(
        "kernels/src/packed.cl",
        "packed_coordinate",
        "as_uint(convert_int(rint(rest))) & ((1u << COORDINATE_BITS) - 1u);",
        "as_uint(convert_int(rint(rest)));",
    ),
    // The word of the normal belongs to the next vertex.
    opencl(
        "kernels/src/packed.cl",
        "two_words",
        "uint normal = packed_normal(normal_at(&stance, point));",
        "uint normal = packed_normal(normal_at(&stance, next));",
    ),
    // The lower half of the octahedron is folded the other way round.
    wgpu(
        "shaders/src/packed.wgsl",
        "packed_normal",
        "select(vec2(1.0), vec2(-1.0), level < vec2(0.0));",
        "select(vec2(-1.0), vec2(1.0), level < vec2(0.0));",
    ),
    // If the number of sides is odd, each word of a vertex lies in the place of the word before.
    wgpu(
        "shaders/src/packed.wgsl",
        "packed_odd",
        "one_word(ring, store % 3u, point);",
        "one_word(ring, (store + 1u) % 3u, point);",
    ),
    // A cap of packed vertices keeps its ring's normals.
    wgpu(
        "shaders/src/packed.wgsl",
        "packed_caps",
        "packed_words[own + 2u] = packed_normal(cap_normal(cap));",
        "packed_words[own + 2u] = packed_words[ring + 2u];",
    ),
    // The normals of caps point inwards.
    opencl(
        "kernels/src/common.cl",
        "cap_normal",
        "cap->end == 0u ? -1.0f : 1.0f",
        "cap->end == 0u ? 1.0f : -1.0f",
    ),
    // The width grows along the yarn, but normals are those of a constant width.
    opencl(
        "kernels/src/per_yarn.cl",
        "trajectory_per_yarn",
        "(float4)(sample.half_height, sample.width_growth, sample.height_growth, 0.0f)",
        "(float4)(sample.half_height, 0.0f, sample.height_growth, 0.0f)",
    ),
    // Every yarn gets the leans of the fabric's first yarn.
    opencl(
        "kernels/src/rings.cl",
        "lean_of",
        "rolls[params->leans + yarn->first_block * BLOCK_RINGS + ring];",
        "rolls[params->leans + ring];",
    ),
    // A flattened yarn's section does not turn.
    opencl(
        "kernels/src/rings.cl",
        "block_rings",
        "rings->sin_cos[lane] = turn_sin_cos(roll - lean);",
        "rings->sin_cos[lane] = turn_sin_cos(0u);",
    ),
    // A flattened section's normals are stretched as its points are.
    wgpu(
        "shaders/src/common.wgsl",
        "normal_at",
        "rolled(stance, point.zw) * vec2(stance.height.x, stance.centre.w);",
        "rolled(stance, point.zw) * vec2(stance.centre.w, stance.height.x);",
    ),
    // The lower limit of half heights is that of half widths.
    wgpu(
        "shaders/src/common.wgsl",
        "segment_sample",
        "segment.height.yzw, segment.height_floor, t, inverse);",
        "segment.height.yzw, segment.width_floor, t, inverse);",
    ),
    // The last quads of each part are missing.
    opencl("kernels/src/per_yarn.cl", "mesh_per_yarn", "ring < part.quads", "ring + 1u < part.quads"),
    // The sine of turns near half a turn has the wrong sign.
    wgpu(
        "shaders/src/common.wgsl",
        "turn_sin_cos",
        "case 2u: { return vec2(-sine, -cosine); }",
        "case 2u: { return vec2(sine, -cosine); }",
    ),
    // The rolls of each block start at 0. Yarns of one block don't show this.
    wgpu(
        "shaders/src/rings.wgsl",
        "block_rings",
        "let start = rolls[params.yarns + yarn.first_block + block.first_ring / BLOCK_RINGS];",
        "let start = 0u;",
    ),
    // Every ring gets the lean of the next ring.
    wgpu(
        "shaders/src/rings.wgsl",
        "lean_of",
        "yarn.first_block * BLOCK_RINGS + ring];",
        "yarn.first_block * BLOCK_RINGS + ring + 1u];",
    ),
    // The turn of a block is summed as if the block's first ring stood in the place of all.
    wgpu(
        "shaders/src/scan.wgsl",
        "block_turns",
        "ring_sample(yarn, block, lane);",
        "ring_sample(yarn, block, 0u);",
    ),
    // Each block gets the roll at which the next block starts.
    wgpu(
        "shaders/src/scan.wgsl",
        "yarn_rolls",
        "before + roll_sums[lane] - turn;",
        "before + roll_sums[lane];",
    ),
    // Every ring of a block gets the roll of the first.
    wgpu("shaders/src/trajectory.wgsl", "trajectory", "standing.roll[ring]);", "standing.roll[0]);"),
    // Two coordinates change places in one of three stores.
    wgpu(
        "shaders/src/mesh.wgsl",
        "mesh",
        "select(vec4(normal.yz, position.xy),",
        "select(vec4(normal.yz, position.yx),",
    ),
    // If the number of sides is odd, a block's indices are counted from the chunk's first vertex.
    wgpu(
        "shaders/src/mesh.wgsl",
        "mesh_odd",
        "let own = pattern_pairs[store] + block.first_vertex;",
        "let own = pattern_pairs[store];",
    ),
    // Every cap gets the triangles at the start of a yarn with the first section.
    wgpu("shaders/src/caps.wgsl", "caps", "cap_pattern[cap.first_corner + k];", "cap_pattern[k];"),
    // A part that starts inside an interval starts at its control point.
    wgpu(
        "shaders/src/per_yarn.wgsl",
        "trajectory_per_yarn",
        "var place = part.first_ring % per_interval;",
        "var place = 0u;",
    ),
    // All yarns get the first section.
    wgpu(
        "shaders/src/per_yarn.wgsl",
        "mesh_per_yarn",
        "let outline = yarns[part.yarn].section * sides;",
        "let outline = 0u;",
    ),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_there_once() {
        for mutant in MUTANTS {
            let source = std::fs::read_to_string(crate::steps::root().join(mutant.file)).unwrap();
            assert_eq!(source.matches(mutant.line).count(), 1, "{}: {}", mutant.file, mutant.line);
        }
    }
}
