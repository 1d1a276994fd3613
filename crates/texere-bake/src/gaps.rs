//! Fills the gaps of maps with what lies round them.

/// Fills the texels that are not `seen`, from the edges of the gaps inwards. Each of them gets the
/// mean of its neighbours that are seen or already filled. If the map `tiles`, texels at opposite
/// edges are neighbours.
pub(crate) fn fill(texels: &mut [[[f32; 3]; 3]], seen: &[bool], size: [u32; 2], tiles: bool) {
    let [width, height] = size.map(i64::from);
    let neighbours = |at: usize| {
        let (x, y) = (at as i64 % width, at as i64 / width);
        [[-1, 0], [1, 0], [0, -1], [0, 1]].into_iter().filter_map(move |[right, down]| {
            let [x, y] = [x + right, y + down];
            if tiles {
                return Some((y.rem_euclid(height) * width + x.rem_euclid(width)) as usize);
            }
            ((0..width).contains(&x) && (0..height).contains(&y)).then(|| (y * width + x) as usize)
        })
    };
    let mut filled = seen.to_vec();
    let mut edge: Vec<usize> =
        (0..seen.len()).filter(|&at| !seen[at] && neighbours(at).any(|other| seen[other])).collect();
    let mut is_listed = vec![false; seen.len()];
    edge.iter().for_each(|&at| is_listed[at] = true);
    while !edge.is_empty() {
        let means: Vec<_> =
            edge.iter().map(|&at| mean(texels, neighbours(at).filter(|&other| filled[other]))).collect();
        for (&at, mean) in edge.iter().zip(means) {
            texels[at] = mean;
            filled[at] = true;
        }
        let mut next = Vec::new();
        for other in edge.iter().flat_map(|&at| neighbours(at)) {
            if !filled[other] && !is_listed[other] {
                is_listed[other] = true;
                next.push(other);
            }
        }
        edge = next;
    }
}

fn mean(texels: &[[[f32; 3]; 3]], all: impl Iterator<Item = usize>) -> [[f32; 3]; 3] {
    let (mut sum, mut count) = ([[0.0; 3]; 3], 0);
    for at in all {
        count += 1;
        for (sum, own) in sum.as_flattened_mut().iter_mut().zip(texels[at].as_flattened()) {
            *sum += own;
        }
    }
    sum.map(|three| three.map(|one| one / count.max(1) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(values: &[f32]) -> Vec<[[f32; 3]; 3]> {
        values.iter().map(|value| [[*value; 3]; 3]).collect()
    }

    #[test]
    fn gaps_take_on_what_lies_round_them() {
        let seen = [true, false, false, false, true, true];
        let mut texels = row(&[1.0, 9.0, 9.0, 9.0, 3.0, 5.0]);
        fill(&mut texels, &seen, [6, 1], false);
        assert_eq!(texels, row(&[1.0, 1.0, 2.0, 3.0, 3.0, 5.0]));
        // The last texel of a tile lies beside the first one.
        let seen = [false, false, true, false];
        let mut texels = row(&[0.0, 0.0, 4.0, 0.0]);
        fill(&mut texels, &seen, [4, 1], true);
        assert_eq!(texels, row(&[4.0; 4]));
    }
}
