// A packed vertex (Rust: PackedVertex) as it was, for shaders of the caller's. It stands alone.

// The position, mm, of the first two words of a packed vertex: the one that lies within the
// quantum's reach of `near`, mm. Whatever place that is, the bits are the same. Places within 2^31
// quanta of the origin.
fn unpacked_position(words: vec2<u32>, near: vec3<f32>, quantum: f32) -> vec3<f32> {
    let wrapped = bitcast<vec3<i32>>(vec3(words.x, (words.x >> 21u) | (words.y << 11u), words.y >> 10u));
    let whole = vec3<i32>(round(near / quantum));
    // 21 bits count: the difference is the nearest that they may stand for.
    let steps = ((wrapped - whole) << vec3(11u)) >> vec3(11u);
    return vec3<f32>(whole + steps) * quantum;
}

// The unit normal of the last word, read as two numbers from -1 to 1: `unpack2x16snorm(word)`, or a
// vertex attribute Snorm16x2.
fn unpacked_normal(flat_normal: vec2<f32>) -> vec3<f32> {
    let z = 1.0 - abs(flat_normal.x) - abs(flat_normal.y);
    let fold = max(-z, 0.0);
    let level = flat_normal - select(vec2(fold), vec2(-fold), flat_normal < vec2(0.0));
    return normalize(vec3(level, z));
}
