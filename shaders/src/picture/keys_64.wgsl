// The nearest triangle in each sample, in one number of 64 bits. This file comes before cover.wgsl.

// The nearness is in the high 32 bits of a key, the triangle in the low ones.
@group(1) @binding(4) var<storage, read_write> keys: array<atomic<u64>>;

fn offer(sample: u32, nearness: u32, triangle: u32) {
    atomicMax(&keys[sample], (u64(nearness) << 32u) | u64(triangle));
}
