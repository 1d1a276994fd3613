//! The axes and the aspect ratio of a picture.

use glam::Vec3;

/// The picture's right and up, for an eye in direction `toward`.
pub(crate) fn across(up: Vec3, toward: Vec3) -> [Vec3; 2] {
    let right = up.cross(toward).normalize();
    [right, toward.cross(right)]
}

/// The width of pictures of `size`, divided by their height.
pub(crate) fn aspect(size: [u32; 2]) -> f32 {
    // An empty picture is refused later, when it is drawn.
    size[0].max(1) as f32 / size[1].max(1) as f32
}
