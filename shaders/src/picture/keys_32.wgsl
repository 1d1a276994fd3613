// The nearest triangle in each sample, in two numbers of 32 bits. Sweep 0 finds the nearness, and
// sweep 1 the triangle. This file comes before cover.wgsl. In memory both numbers together equal
// the number of keys_64.wgsl.

struct Key {
    triangle: atomic<u32>,
    nearness: atomic<u32>,
}

@group(1) @binding(4) var<storage, read_write> keys: array<Key>;

fn offer(sample: u32, nearness: u32, triangle: u32) {
    let nearest = atomicLoad(&keys[sample].nearness);
    if sweep.number == 0u {
        if nearest < nearness {
            atomicMax(&keys[sample].nearness, nearness);
        }
    } else if nearest == nearness && atomicLoad(&keys[sample].triangle) < triangle {
        atomicMax(&keys[sample].triangle, triangle);
    }
}
