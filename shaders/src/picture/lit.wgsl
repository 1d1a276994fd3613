// The encoding of a lit sample: ten bits for the square root of each of red, green and blue, and
// two bits for alpha. With square roots, the steps between encoded values look roughly equal to the
// eye.

fn lit_of(color: vec4<f32>) -> u32 {
    let steps = vec4<u32>(round(vec4(sqrt(clamp(color.rgb, vec3(0.0), vec3(1.0))), color.a) * vec4(vec3(1023.0), 3.0)));
    return steps.r | steps.g << 10u | steps.b << 20u | steps.a << 30u;
}

fn color_of(lit: u32) -> vec4<f32> {
    let steps = vec4(lit, lit >> 10u, lit >> 20u, lit >> 30u) & vec4(vec3(1023u), 3u);
    let shares = vec4<f32>(steps) / vec4(vec3(1023.0), 3.0);
    return vec4(shares.rgb * shares.rgb, shares.a);
}
