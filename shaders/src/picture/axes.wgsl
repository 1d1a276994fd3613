// Rings in screen space. This file follows fabric.wgsl and cover.wgsl.

// The roll and the lean of each ring of the chunk, for `resolve`.
@group(1) @binding(5) var<storage, read_write> ring_rolls: array<vec2<u32>>;

// A section in screen space: its centre, and the directions of its x and its y.
struct Axes {
    centre: vec4<f32>,
    x: vec4<f32>,
    y: vec4<f32>,
}

fn axes_of(stance: Stance) -> Axes {
    var x_axis = stance.side * stance.centre.w;
    var y_axis = stance.up * stance.centre.w;
    if !stance.round {
        let upward = stance.up * stance.height.x;
        y_axis = upward * stance.sin_cos.y - x_axis * stance.sin_cos.x;
        x_axis = x_axis * stance.sin_cos.y + upward * stance.sin_cos.x;
    }
    return Axes(screen_of(clip_of(stance.centre.xyz)), screen_of(view.clip_from_local * vec4(x_axis, 0.0)),
                screen_of(view.clip_from_local * vec4(y_axis, 0.0)));
}
