// Hairs: fibres that stand off their yarns. This file follows fabric.wgsl.
//
// Each gap between two rings has its own hairs. They come from a hash of the yarn's number, the
// ring's and the hair's. The hairs are the same however the fabric is cut into chunks, and in every
// shader.

// The most hairs of a gap, and the number of straight parts of each hair. In Rust these two numbers
// and the next two are in texere_render's hairs.rs.
const HAIRS_OF_GAP = 16u;
const HAIR_PARTS = 16u;

// Lengths are cut off at this many times the scale of their distribution.
const HAIR_LONGEST = 4.0;

// Lengths are distributed exponentially (Barella and Manich 1993, "The hair-length distribution of
// yarns, measured by means of the Zweigle G565 hairiness meter", for hairs up to 3 mm), with this
// scale, mm. The scale is chosen, not measured: without the cut-off a fifth of the hairs of 1 mm
// would reach 2 mm.
const HAIR_SCALE = 0.6;

// A fibre's width, mm. Cotton is a ribbon 12 to 20 micrometres wide, and thinner the other way
// (Morton and Hearle 2008, "Physical properties of textile fibres"). A fibre is seen from any side.
const HAIR_WIDTH = 0.012;

struct Hair {
    root: vec3<f32>,
    // The length of each of the hair's parts, mm.
    part: f32,
    // The normal of the surface at the root, and the direction of the surface's fibres there.
    normal: vec3<f32>,
    along: vec3<f32>,
    // At the hair's root, on its way and at its tip: the sine of its direction against the surface,
    // and its angle to the surface's fibres, in turns.
    rises: vec3<f32>,
    turns: vec3<f32>,
}

// A hash of `x`: the last steps of MurmurHash3 (Appleby 2011).
fn scrambled(x: u32) -> u32 {
    var mixed = (x ^ (x >> 16u)) * 2246822507u;
    mixed = (mixed ^ (mixed >> 13u)) * 3266489909u;
    return mixed ^ (mixed >> 16u);
}

// Random number `draw` of a hair, from 0 to just below 1.
fn drawn(seed: u32, draw: u32) -> f32 {
    return f32(scrambled(seed + draw * 2654435769u) >> 8u) / 16777216.0;
}

// The seed of a hair's random numbers. The hair's gap follows ring `ring` of the yarn.
fn seed_of(yarn: u32, ring: u32, hair: u32) -> u32 {
    return scrambled(scrambled(yarn * 2246822519u + ring) + hair * 3266489917u);
}

// The hair of a seed, between two rings. The hair starts on the drawn surface, and leaves it
// forward or backward along the direction of the surface's fibres, which follows the yarn's twist.
// Then it bends at random and lies down. It never leads back through the surface's tangent plane at
// its root.
fn hair_new(seed: u32, outline: u32, here: Stance, next: Stance) -> Hair {
    let side = min(u32(drawn(seed, 0u) * f32(params.sides)), params.sides - 1u);
    let beside = side_beside(side);
    let point = mix(outlines[outline + side], outlines[outline + beside], drawn(seed, 1u));
    let start = position_at(here, point);
    let end = position_at(next, point);
    let normal = normalize(normal_at(here, point));
    let facet = end - start;
    let level = facet - normal * dot(facet, normal);
    let along = level * inverseSqrt(max(dot(level, level), 1e-30));
    let scales = -log(1.0 - drawn(seed, 2u) * (1.0 - exp(-HAIR_LONGEST)));
    // Short hairs are stiff.
    let limp = min(scales, 1.0);
    let turn = 0.16 * (drawn(seed, 3u) - 0.5) + select(0.0, 0.5, drawn(seed, 4u) < 0.5);
    let turns = turn + limp * vec3(0.0, drawn(seed, 5u) - 0.5, 1.6 * (drawn(seed, 6u) - 0.5));
    let rise = mix(0.15, 0.85, drawn(seed, 7u));
    let rises = mix(vec3(rise), vec3(rise, 0.8 * drawn(seed, 8u), 0.4 * drawn(seed, 9u)), limp);
    return Hair(mix(start, end, drawn(seed, 10u)), HAIR_SCALE * scales / f32(HAIR_PARTS), normal, along, rises, turns);
}

// The direction of part number `part`. Rise and turn are quadratic Bezier curves along the way to
// the tip.
fn hair_direction(hair: Hair, part: u32) -> vec3<f32> {
    let share = (f32(part) + 0.5) / f32(HAIR_PARTS);
    let rest = 1.0 - share;
    let shares = vec3(rest * rest, 2.0 * share * rest, share * share);
    let rise = dot(hair.rises, shares);
    let angle = dot(hair.turns, shares) * FULL_TURN;
    let level = hair.along * cos(angle) + cross(hair.normal, hair.along) * sin(angle);
    return hair.normal * rise + level * sqrt(1.0 - rise * rise);
}

// The number of parts of hairs that a block of the table has numbers for.
fn hairs_of_block() -> u32 {
    return BLOCK_RINGS * HAIRS_OF_GAP * HAIR_PARTS;
}

// The number of the first part of a hair. Hairs are numbered after all triangles.
fn first_hair() -> u32 {
    return (params.blocks + params.caps) * numbers_of_block();
}
