//! A binary tree over boxes in a row, without pointers.

use texere_core::Bounds;

use super::beam::Beam;

/// A row of boxes in a tree. Each two neighbours of the row have a box round them, each two
/// neighbours among these boxes have a box round them, and so on, up to one box round all.
///
/// Node 1 is the root, nodes 2i and 2i + 1 lie below node i, and the last half of all nodes are
/// leaves. The leaves in the lowest level hold the first boxes of the row. Each node thus holds
/// consecutive boxes, and at least a third of its parent's.
#[derive(Debug)]
pub(super) struct BoxTree {
    /// Node 0 is unused.
    nodes: Vec<Bounds>,
}

impl BoxTree {
    /// A tree over `boxes`, at least one.
    pub(super) fn new(boxes: &[Bounds]) -> Self {
        let mut tree = Self { nodes: vec![Bounds::NOTHING; 2 * boxes.len()] };
        for (position, bounds) in boxes.iter().enumerate() {
            let node = tree.node(position);
            tree.nodes[node] = *bounds;
        }
        for node in (1..boxes.len()).rev() {
            tree.nodes[node] = tree.below(node);
        }
        tree
    }

    /// The number of the row's first boxes that lie under the root's first child.
    pub(super) fn first_half(boxes: usize) -> usize {
        let lowest_row = boxes.next_power_of_two();
        let in_lowest = 2 * boxes - lowest_row;
        // The first child has half of the room in the lowest level, of which `filled` places are
        // taken. Each two places that are not taken are one leaf in the level above.
        let filled = in_lowest.min(lowest_row / 2);
        (lowest_row / 2 - filled) / 2 + filled
    }

    /// The box round all boxes.
    pub(super) fn root(&self) -> &Bounds {
        &self.nodes[1]
    }

    /// Replaces the box at `position`.
    pub(super) fn set(&mut self, position: usize, bounds: Bounds) {
        let mut node = self.node(position);
        self.nodes[node] = bounds;
        while node > 1 {
            node /= 2;
            self.nodes[node] = self.below(node);
        }
    }

    /// Calls `leaf` with the position of each box that `beam` meets within the distance `most`,
    /// roughly the nearest first. `leaf` returns the new `most`.
    pub(super) fn visit(&self, beam: &Beam, most: &mut f64, leaf: &mut impl FnMut(usize) -> f64) {
        if beam.enters(self.root(), *most).is_some() {
            self.descend(1, beam, most, leaf);
        }
    }

    fn descend(&self, node: usize, beam: &Beam, most: &mut f64, leaf: &mut impl FnMut(usize) -> f64) {
        if node >= self.leaves() {
            *most = leaf(self.position(node));
            return;
        }
        let mut next = [2 * node, 2 * node + 1].map(|node| (node, beam.enters(&self.nodes[node], *most)));
        if next[1].1.is_some_and(|second| next[0].1.is_none_or(|first| second < first)) {
            next.swap(0, 1);
        }
        for (node, entry) in next {
            if entry.is_some_and(|entry| entry <= *most) {
                self.descend(node, beam, most, leaf);
            }
        }
    }

    fn below(&self, node: usize) -> Bounds {
        self.nodes[2 * node].joined(&self.nodes[2 * node + 1])
    }

    const fn leaves(&self) -> usize {
        self.nodes.len() / 2
    }

    /// The node of a box. The lowest level begins at a power of two.
    const fn node(&self, position: usize) -> usize {
        let node = self.leaves().next_power_of_two() + position;
        if node < self.nodes.len() { node } else { node - self.leaves() }
    }

    const fn position(&self, node: usize) -> usize {
        let lowest = self.leaves().next_power_of_two();
        if node >= lowest { node - lowest } else { node + self.leaves() - lowest }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may panic")]
mod tests {
    use super::*;
    use texere_core::Ray;

    fn boxes(count: usize) -> Vec<Bounds> {
        (0..count).map(|k| Bounds { low: [k as f32, 0.0, 0.0], high: [k as f32 + 0.5, 1.0, 1.0] }).collect()
    }

    /// The boxes below a node.
    fn under(tree: &BoxTree, node: usize) -> Vec<usize> {
        if node >= tree.leaves() {
            return vec![tree.position(node)];
        }
        [2 * node, 2 * node + 1].into_iter().flat_map(|node| under(tree, node)).collect()
    }

    #[test]
    fn every_node_holds_a_run_of_boxes_and_halves_are_told() {
        for count in 1..200 {
            let tree = BoxTree::new(&boxes(count));
            assert_eq!(under(&tree, 1), (0..count).collect::<Vec<_>>());
            for node in 1..2 * count {
                let own = under(&tree, node);
                assert!(own.is_sorted() && own[own.len() - 1] - own[0] + 1 == own.len());
                assert_eq!(tree.nodes[node].low[0], own[0] as f32);
                if own.len() > 1 {
                    assert_eq!(under(&tree, 2 * node).len(), BoxTree::first_half(own.len()), "of {own:?}");
                }
            }
        }
    }

    #[test]
    fn a_box_that_is_set_is_as_if_it_had_been_there() {
        for count in [1, 2, 7, 64, 65] {
            let (mut tree, mut all) = (BoxTree::new(&boxes(count)), boxes(count));
            for position in [0, count / 2, count - 1] {
                all[position].high[2] = 7.0 + position as f32;
                tree.set(position, all[position]);
                assert_eq!(tree.nodes, BoxTree::new(&all).nodes);
            }
        }
    }

    #[test]
    fn only_boxes_on_the_way_are_visited_nearest_first() {
        let tree = BoxTree::new(&boxes(100));
        let visited = |origin: [f64; 3], direction: [f64; 3], stop: usize| {
            let (mut seen, mut most) = (Vec::new(), f64::INFINITY);
            let beam = Beam::new(&Ray { origin, direction }).unwrap();
            tree.visit(&beam, &mut most, &mut |position| {
                seen.push(position);
                if seen.len() == stop { 0.0 } else { f64::INFINITY }
            });
            seen
        };
        assert_eq!(visited([41.25, 0.5, 9.0], [0.0, 0.0, -1.0], 99), [41]);
        assert_eq!(visited([41.75, 0.5, 9.0], [0.0, 0.0, -1.0], 99), []);
        assert_eq!(visited([-1.0, 0.5, 0.5], [1.0, 0.0, 0.0], 3), [0, 1, 2]);
        assert_eq!(visited([200.0, 0.5, 0.5], [-1.0, 0.0, 0.0], 2), [99, 98]);
        assert_eq!(visited([50.75, 0.5, 0.5], [-1.0, 0.0, 0.0], 1), [50]);
    }
}
