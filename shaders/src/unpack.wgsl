// Unpacks packed vertices (Rust: PackedVertex) in a caller's shaders. It needs no other file.

// The position, mm, from the first two words of a packed vertex. `near`, mm, is any place at most
// 2^20 - 2 quanta away from the position along each axis. All such places give the same bits.
// `quantum` is the size of a quantum, mm. Places lie within 2^31 quanta of the origin.
fn unpacked_position(words: vec2<u32>, near: vec3<f32>, quantum: f32) -> vec3<f32> {
    let wrapped = bitcast<vec3<i32>>(vec3(words.x, (words.x >> 21u) | (words.y << 11u), words.y >> 10u));
    let whole = vec3<i32>(round(near / quantum));
    // Only 21 bits are stored. They stand for the smallest difference that has these bits.
    let steps = ((wrapped - whole) << vec3(11u)) >> vec3(11u);
    return vec3<f32>(whole + steps) * quantum;
}

// The unit normal from the last word, read as two numbers from -1 to 1: by `unpack2x16snorm(word)`,
// or as a vertex attribute Snorm16x2.
fn unpacked_normal(flat_normal: vec2<f32>) -> vec3<f32> {
    let z = 1.0 - abs(flat_normal.x) - abs(flat_normal.y);
    let fold = max(-z, 0.0);
    let level = flat_normal - select(vec2(fold), vec2(-fold), flat_normal < vec2(0.0));
    return normalize(vec3(level, z));
}
