// How much each corner of a triangle counts at a place on the screen. This file follows
// fabric.wgsl.

// Weights that are right in perspective, up to a factor: for corners in clip space, and a place in
// units of 1/256 pixel from the screen's middle.
fn weights_at(p: vec4<f32>, q: vec4<f32>, r: vec4<f32>, place: vec2<i32>) -> vec3<f32> {
    let ndc = vec2<f32>(place) * vec2(2.0, -2.0) / (256.0 * view.size);
    let to_p = p.xy - ndc * p.w;
    let to_q = q.xy - ndc * q.w;
    let to_r = r.xy - ndc * r.w;
    return vec3(to_q.x * to_r.y - to_q.y * to_r.x, to_r.x * to_p.y - to_r.y * to_p.x, to_p.x * to_q.y - to_p.y * to_q.x);
}
