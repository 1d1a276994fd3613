// The nearest triangle in each sample, in one number of 64 bits. Before cover.wgsl.

// Nearness, then the triangle.
@group(1) @binding(4) var<storage, read_write> keys: array<atomic<u64>>;

fn offer(sample: u32, nearness: u32, triangle: u32) {
    atomicMax(&keys[sample], (u64(nearness) << 32u) | u64(triangle));
}
