//! What the threads of a design share.

use std::collections::HashMap;

use texere_core::{Material, Section};
use texere_fabric::Thread;

/// The materials and sections that `threads` have, in their order and each section once, and the threads with their
/// numbers. What no thread has is left out.
pub(super) fn only_used(
    threads: [&mut [Thread]; 2],
    materials: &[Material],
    sections: &[Section],
) -> (Vec<Material>, Vec<Section>) {
    let [mut worn, mut shaped] = [materials.len(), sections.len()].map(|count| vec![false; count]);
    for thread in threads.iter().flat_map(|set| set.iter()) {
        worn[thread.material as usize] = true;
        shaped[thread.section as usize] = true;
    }
    let (mut kept, mut material) = (Vec::new(), vec![0; materials.len()]);
    for (number, _) in worn.iter().enumerate().filter(|(_, worn)| **worn) {
        material[number] = kept.len() as u32;
        kept.push(materials[number].clone());
    }
    let (mut unlike, mut section) = (Vec::new(), vec![0; sections.len()]);
    let mut numbers = HashMap::new();
    for (number, _) in shaped.iter().enumerate().filter(|(_, shaped)| **shaped) {
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
