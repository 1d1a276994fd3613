//! Copies of a Jacquard's repeat are cut so that nothing touches at the edges.

use std::ops::ControlFlow;

use texere_core::{Material, Section};
use texere_cpu::ParallelBackend;
use texere_fabric::Finish;
use texere_fabric::weft::{Backing, Chart, Gauge, KnitYarn, Knitted, Machine};

#[test]
fn copies_of_a_jacquard_are_clear_up_to_their_cut_edges() {
    for (backing, diameter) in [(None, 0.14), (Some(Backing::Birdseye), 0.118)] {
        // Areas of three wales and two courses in each colour.
        let color = |x: usize, y: usize| (((x / 3 + 7 * (y / 2) + 1) * 2_654_435_761) >> 7 & 1) as u32;
        let program = Chart::jacquard(12, 8, backing, color).unwrap().program().unwrap();
        let stitches = Machine::default().knit(&program).unwrap().stitches;
        let (gauge, yarns) = (Gauge::new(1.11, 0.77), vec![KnitYarn::new(diameter / 2.0); 2]);
        let knit =
            Knitted::new(stitches, gauge, yarns, vec![Material::default()], vec![Section::Circle], [2, 1])
                .unwrap();
        let device = ParallelBackend::open().unwrap();
        let settled = knit.settle(&Finish::default(), 0.0, &device, |_| ControlFlow::Continue(())).unwrap();
        assert!(settled.rest.at_rest && settled.is_linked(), "{backing:?}: {:?}", settled.rest);
        assert!(settled.clearance.min > 0.99, "{backing:?}: {:?}", settled.clearance.worst[0]);
    }
}
