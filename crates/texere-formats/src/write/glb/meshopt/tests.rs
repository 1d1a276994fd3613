//! Streams, decoded by meshoptimizer.

use glam::Vec3;
use meshopt::{decode_filter_oct, decode_index_buffer, decode_vertex_buffer};
use proptest::prelude::*;

use super::{AttributeEncoder, Differences, Meshopt, TriangleEncoder, octahedral};

/// All kinds of streams.
const KINDS: [(Meshopt, Differences); 3] = [
    (Meshopt::Ext, Differences::Bytes),
    (Meshopt::Khr, Differences::Bytes),
    (Meshopt::Khr, Differences::Words),
];

/// The stream of `elements` that come `piece` at a time.
fn encoded<const N: usize>(
    (extension, differences): (Meshopt, Differences),
    elements: &[[u8; N]],
    piece: usize,
) -> Vec<u8> {
    let (mut encoder, mut stream) = (AttributeEncoder::new(N, extension, differences), Vec::new());
    elements.chunks(piece).for_each(|elements| encoder.add(elements.as_flattened(), &mut stream).unwrap());
    encoder.finish(&mut stream).unwrap();
    stream
}

/// Elements that each differ from the one before in one place, by some step.
fn near(steps: &[(u8, u8)]) -> Vec<[u8; 48]> {
    let mut element = [0; 48];
    let next = |&(place, step): &(u8, u8)| {
        let place = usize::from(place) % element.len();
        element[place] = step.wrapping_add(element[place]);
        element
    };
    steps.iter().map(next).collect()
}

fn triangles(corners: &[[u32; 3]]) -> Vec<u8> {
    let (mut encoder, mut codes, mut further) =
        (TriangleEncoder::new(), TriangleEncoder::START.to_vec(), Vec::new());
    corners.iter().for_each(|triangle| encoder.add(*triangle, &mut codes, &mut further).unwrap());
    [&codes[..], &further, &TriangleEncoder::END].concat()
}

/// Whichever of the three turns of a triangle is the smallest list of corners.
fn turned([a, b, c]: [u32; 3]) -> [u32; 3] {
    [a, b, c].min([b, c, a]).min([c, a, b])
}

fn assert_triangles(corners: &[[u32; 3]]) {
    let decoded: Vec<u32> = decode_index_buffer(&triangles(corners), 3 * corners.len()).unwrap();
    let decoded: Vec<_> = decoded.as_chunks().0.iter().copied().map(turned).collect();
    assert_eq!(decoded, corners.iter().copied().map(turned).collect::<Vec<_>>());
}

proptest! {
    #[test]
    fn elements_are_decoded(elements in prop::collection::vec(any::<[u8; 4]>(), 1..1000), piece in 1..300_usize) {
        for kind in KINDS {
            let stream = encoded(kind, &elements, piece);
            // Noise takes no more than its own bytes, two bits for each group of a byte, and a
            // header for each block.
            let most = 4 * elements.len() + 4 * elements.len().div_ceil(64) + elements.len().div_ceil(256) + 100;
            prop_assert!(stream.len() <= most, "{kind:?}: {} bytes", stream.len());
            prop_assert!(decode_vertex_buffer::<[u8; 4]>(&stream, elements.len()).unwrap() == elements, "{kind:?}");
        }
    }

    #[test]
    fn elements_of_many_bytes_are_decoded(
        steps in prop::collection::vec((any::<u8>(), prop_oneof![-1..2_i8, -3..4_i8, -9..10_i8, any::<i8>()]), 1..600),
        piece in 1..200_usize,
    ) {
        let elements = near(&steps.into_iter().map(|(place, step)| (place, step as u8)).collect::<Vec<_>>());
        for kind in KINDS {
            let stream = encoded(kind, &elements, piece);
            let decoded = decode_vertex_buffer::<Bytes48>(&stream, elements.len()).unwrap();
            prop_assert!(decoded.into_iter().map(|Bytes48(bytes)| bytes).eq(elements.iter().copied()), "{kind:?}");
        }
    }

    /// Corners numbered below 60 meet in every way. Corners with arbitrary numbers are written out.
    #[test]
    fn triangles_are_decoded(
        corners in prop_oneof![
            prop::collection::vec(prop::array::uniform3(0..9_u32), 0..200),
            prop::collection::vec(prop::array::uniform3(0..60_u32), 0..200),
            prop::collection::vec(prop::array::uniform3(0..u32::MAX), 0..50),
        ],
    ) {
        assert_triangles(&corners);
    }

    /// A tube takes less than two bytes for each triangle, and 40 bytes besides.
    #[test]
    fn tubes_are_decoded(sides in 3..40_u32, gaps in 1..20_u32) {
        let quads = texere_core::definitions::index_pattern(sides);
        let tube = (0..gaps).flat_map(|gap| quads.iter().map(move |corner| gap * sides + corner));
        let corners: Vec<u32> = tube.collect();
        assert_triangles(corners.as_chunks().0);
        let bytes = triangles(corners.as_chunks().0).len();
        prop_assert!(bytes < corners.len() / 3 * 2 + 40, "{bytes} bytes for {} triangles", corners.len() / 3);
    }
}

/// A coordinate along a wave takes fewer bytes as a word: its lower byte passes 255 often, and its
/// higher byte then differs, too. Zeros take no bytes in version 1.
#[test]
fn later_streams_are_shorter() {
    let wave = |step: u32| ((f64::from(step) * 0.02).sin() * 5000.0) as i16;
    let places: Vec<_> = (0..1000)
        .map(|step| {
            let [low, high] = wave(step).to_le_bytes();
            [low, high, 0, 0]
        })
        .collect();
    let [ext, khr, words] = KINDS.map(|kind| encoded(kind, &places, 300).len());
    assert!(khr < ext && 10 * words < 9 * khr, "{ext}, {khr}, {words} bytes");
}

/// An element of 48 bytes, since arrays of so many have no default.
#[derive(Clone, Copy)]
struct Bytes48([u8; 48]);

impl Default for Bytes48 {
    fn default() -> Self {
        Self([0; 48])
    }
}

/// Places on a spiral over the sphere, and the axes, where the octahedron folds.
fn directions() -> Vec<Vec3> {
    let spiral = (0..200_000).map(|step| {
        let z = 1.0 - (step as f32 + 0.5) / 100_000.0;
        let (sine, cosine) = (step as f32 * 2.399_963).sin_cos();
        Vec3::new(cosine * (1.0 - z * z).sqrt(), sine * (1.0 - z * z).sqrt(), z)
    });
    let axes = [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
    spiral.chain(axes).collect()
}

#[test]
fn directions_are_decoded() {
    let directions = directions();
    let mut decoded: Vec<[i8; 4]> =
        directions.iter().map(|each| octahedral(each.to_array(), -9).map(|byte| byte as i8)).collect();
    decode_filter_oct(&mut decoded);
    let mut most = 0.0_f32;
    for (direction, [x, y, z, fourth]) in directions.iter().zip(decoded) {
        let read = Vec3::from_array([x, y, z].map(f32::from)) / 127.0;
        most = most.max(read.angle_between(*direction).to_degrees());
        // Khronos' validator complains about lengths that are off by more.
        assert!((read.length() - 1.0).abs() < 0.00674, "{direction} has the length {}", read.length());
        assert_eq!(fourth, -9);
    }
    // A direction is rounded when it is written, by half a step along both sides of the octahedron,
    // and when it is read, by half a step along each axis. The decoder's root is an approximation
    // that differs from processor to processor: up to 0.95 degrees were seen.
    assert!(most < 1.0, "{most} degrees");
}

#[test]
fn no_direction_is_some_direction() {
    let mut decoded = [octahedral([0.0; 3], 0).map(|byte| byte as i8)];
    decode_filter_oct(&mut decoded);
    assert_ne!(decoded[0][..3], [0; 3]);
}
