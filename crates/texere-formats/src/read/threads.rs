//! The materials and sections that the threads of a design share.

use std::collections::HashMap;

use texere_core::{Material, Section};
use texere_fabric::Thread;

/// Leaves out the materials and sections that no thread has, and gives `threads` the new numbers.
/// Materials and sections keep their order. Equal sections become one.
pub(super) fn only_used(
    threads: [&mut [Thread]; 2],
    materials: &[Material],
    sections: &[Section],
) -> (Vec<Material>, Vec<Section>) {
    let [mut used_materials, mut used_sections] =
        [materials.len(), sections.len()].map(|count| vec![false; count]);
    for thread in threads.iter().flat_map(|set| set.iter()) {
        used_materials[thread.material as usize] = true;
        used_sections[thread.section as usize] = true;
    }
    let (mut kept, mut material) = (Vec::new(), vec![0; materials.len()]);
    for (number, _) in used_materials.iter().enumerate().filter(|(_, used)| **used) {
        material[number] = kept.len() as u32;
        kept.push(materials[number].clone());
    }
    let (mut unlike, mut section) = (Vec::new(), vec![0; sections.len()]);
    let mut numbers = HashMap::new();
    for (number, _) in used_sections.iter().enumerate().filter(|(_, used)| **used) {
        section[number] = *numbers.entry(format!("{:?}", sections[number])).or_insert_with(|| {
            unlike.push(sections[number].clone());
            unlike.len() as u32 - 1
        });
    }
    for thread in threads.into_iter().flatten() {
        thread.material = material[thread.material as usize];
        thread.section = section[thread.section as usize];
    }
    (kept, unlike)
}
