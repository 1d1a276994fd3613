//! The settings of a pass: the growth of threads, and the hardness of penalties.

/// Number of passes in which threads grow and penalties harden. With half the value,
/// `turns_do_not_fold` is red; with twice, `crimp_and_thickness_follow_the_sett`.
pub(super) const GROWING: u32 = 50;

/// The share of their full area that threads have at first. With twice the value,
/// `mirrored_cloth_rests_mirrored` is red.
const THIN: f64 = 0.4;

/// The weight of penalties at first, and in the end. With half the values,
/// `far_from_its_edges_a_piece_rests_as_a_repeat` is red; with twice, `layers_change_places`.
const PENALTIES: [f64; 2] = [30.0, 1000.0];

/// The settings of one pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossingsPass {
    /// The weight of the terms that keep threads apart.
    pub penalty: f32,
    /// The area that a thread tends to, as a share of its full area.
    pub area: f32,
}

impl CrossingsPass {
    /// The settings of pass number `number`, counted from 0.
    ///
    /// ```
    /// use texere_core::crossings::CrossingsPass;
    /// assert_eq!(CrossingsPass::of(200), CrossingsPass { penalty: 1000.0, area: 1.0 });
    /// ```
    #[must_use]
    pub fn of(number: u32) -> Self {
        let grown = (f64::from(number) / f64::from(GROWING)).min(1.0);
        let [soft, hard] = PENALTIES;
        Self {
            penalty: (soft * (hard / soft).powf(grown)) as f32,
            area: (THIN + (1.0 - THIN) * grown) as f32,
        }
    }
}
