//! The structs that shaders read: the view, and the look of each yarn.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use texere_core::{Yarn, Yarns};

use crate::camera::Projection;
use crate::{Background, Camera};

/// The reach of ambient occlusion, radii of a yarn: across to the next yarn but one in a close
/// cloth.
const REACH_RADII: f32 = 5.0;

/// The reach of shadows, radii of a yarn.
const SHADOW_RADII: f32 = 9.0;

/// The thickness that is assumed of everything that casts a shadow, radii of a yarn: that of two
/// yarns, one on the other.
const THICKNESS_RADII: f32 = 4.0;

/// The least reach of ambient occlusion, pixels. If everything that could take light from a place
/// lies closer to the place than this, the screen does not show it, and visibility is not worked
/// out.
const LEAST_REACH: f32 = 1.5;

/// `View` of `view.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct ViewUniform {
    clip_from_local: [f32; 16],
    local_from_clip: [f32; 16],
    target_point: [f32; 3],
    reach: f32,
    eye: [f32; 4],
    light: [f32; 3],
    shadow: f32,
    ground: [f32; 4],
    size: [f32; 2],
    supersampling: u32,
    reach_pixels: f32,
    thickness: f32,
    has_ground: u32,
    sees_inside: u32,
    background_kind: u32,
    background: [f32; 3],
    pub(crate) spread: f32,
    has_hairs: u32,
    padding: [u32; 3],
}

const _: () = assert!(size_of::<ViewUniform>() == 256);

impl ViewUniform {
    /// `may_have_hairs` is whether fibres stand off the yarns and are wanted. They are shown if
    /// threads are four pixels wide or more; on finer threads no fibre could be seen. Cuts show
    /// none, because the hairs of the whole cloth would lie one before another.
    pub(crate) fn new(
        camera: &Camera,
        background: Background,
        supersampling: u32,
        may_have_hairs: bool,
    ) -> Self {
        let radius = camera.extent.radius;
        let size = camera.size().map(|pixels| (pixels * supersampling) as f32);
        let clip_from_local = camera.clip_from_local();
        let (background, background_kind) = background.encoded();
        let spread = spread(2.0 * radius * camera.size()[1] as f32 / camera.height_at_target());
        let up = if camera.is_over { Vec3::NEG_Z } else { Vec3::Z };
        let lowest = if camera.is_over { -camera.extent.high[2] } else { camera.extent.low[2] };
        let eye = match camera.projection {
            Projection::Orthographic { .. } => camera.toward.extend(0.0),
            Projection::Perspective { distance, .. } => (camera.toward * distance).extend(1.0),
        };
        Self {
            clip_from_local: clip_from_local.as_mat4().to_cols_array(),
            local_from_clip: clip_from_local.inverse().as_mat4().to_cols_array(),
            target_point: camera.target.to_array(),
            reach: radius * REACH_RADII,
            eye: eye.to_array(),
            light: key_light(camera, up).to_array(),
            shadow: radius * SHADOW_RADII,
            ground: up.extend(lowest - camera.target.dot(up)).to_array(),
            size,
            supersampling,
            reach_pixels: radius * REACH_RADII * size[1] / camera.height_at_target(),
            thickness: radius * THICKNESS_RADII,
            has_ground: u32::from(!camera.cuts),
            sees_inside: u32::from(camera.sees_inside()),
            background_kind,
            background,
            spread,
            has_hairs: (may_have_hairs && spread == 0.0 && !camera.cuts).into(),
            padding: [0; 3],
        }
    }

    /// Whether fibres that stand off yarns are shown.
    pub(crate) const fn has_hairs(&self) -> bool {
        self.has_hairs != 0
    }

    /// Whether visibility is left out because its reach is below [`LEAST_REACH`].
    pub(crate) fn is_far(&self) -> bool {
        self.reach_pixels < LEAST_REACH
    }
}

/// How far a pixel reaches for its samples, pixels, if threads are `thickness` pixels wide. Below
/// two pixels the pattern of the threads themselves is finer than pixels can show, and the reach is
/// a whole pixel. From there to four pixels the reach falls to 0.
fn spread(thickness: f32) -> f32 {
    (2.0 - 0.5 * thickness).clamp(0.0, 1.0)
}

/// The direction to the key light. It stands high on the left and a little beyond the cloth, so
/// that threads across and along shine by turns. In a cut, which the eye sees from the side, it
/// stands above and on the eye's side.
fn key_light(camera: &Camera, up: Vec3) -> Vec3 {
    let [right, above] = camera.across();
    let (height, beyond) = if camera.cuts {
        (camera.toward, above)
    } else {
        (up, (above - up * above.dot(up)).normalize_or(above))
    };
    (right * -0.58 + beyond * 0.3 + height * 0.76).normalize()
}

/// The width of the highlight on a yarn, radians: the standard deviation of the directions in which
/// its fibres lie along the surface. A yarn without twist counts as filament, which is smooth as
/// silk. A twisted yarn counts as spun from staple fibre.
///
/// **Source**: widths are of the order that Sadeghi et al. 2013 measured on silk and on linen.
#[must_use]
pub fn surface_width(yarn: &Yarn) -> f32 {
    if yarn.twist == 0.0 { 9.0_f32 } else { 16.0 }.to_radians()
}

/// `YarnLook` of `shade.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct YarnLook {
    color: [f32; 3],
    surface_width: f32,
    volume_width: f32,
    grain: f32,
    diffuse: f32,
    ring_length: f32,
}

const _: () = assert!(size_of::<YarnLook>() == 32);

impl YarnLook {
    /// The looks of all yarns of a fabric. `ring_lengths` has the mean distance from ring to ring
    /// of each yarn, mm.
    pub(crate) fn all(yarns: &Yarns, ring_lengths: &[f32]) -> Vec<Self> {
        let look = |(yarn, &ring_length): (&Yarn, &f32)| {
            let color = yarns.materials()[yarn.material as usize].linear_rgb();
            let (volume, grain, diffuse) =
                if yarn.twist == 0.0 { (16.0_f32, 0.35, 0.35) } else { (28.0, 0.6, 0.5) };
            Self {
                color,
                surface_width: surface_width(yarn),
                volume_width: volume.to_radians(),
                grain,
                diffuse,
                ring_length,
            }
        };
        yarns.layout().yarns().iter().zip(ring_lengths).map(look).collect()
    }
}
