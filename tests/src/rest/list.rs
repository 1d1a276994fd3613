//! The list of starts on which every solver is tested.

use super::{
    Chart, Gauge, Lapping, Length, Start, Weave, warp_knit, weft_knit, weft_knit_piece, woven, woven_piece,
};

/// The list of starts, which is the same in every run.
#[must_use]
pub fn starts() -> Vec<Start> {
    weft_knits().into_iter().chain(warp_knits()).chain(weaves()).collect()
}

fn weft_knits() -> Vec<Start> {
    let mut list = Vec::new();
    let mut add = |name: &str, courses: &[&str], wales: &[f64], length| {
        for &wale in wales {
            let name = format!("{name}-{wale}");
            list.push(weft_knit(&name, &Chart::new(courses), Gauge::new(wale), length));
        }
    };
    add("jersey", &["kkkk"; 4], &[4.2, 5.0, 6.0, 8.0], Length::Held);
    add("jersey", &["kkkk"; 4], &[3.6], Length::Given(1.05));
    add("rib", &["kpkp"; 4], &[4.4, 5.0, 6.0], Length::Free);
    add("garter", &["kkkk", "pppp", "kkkk", "pppp"], &[4.4, 5.0], Length::Held);
    add("tuck", &["kkkk", "ktkt", "kkkk", "tktk"], &[5.0], Length::Free);
    add("miss", &["kkkk", "kmkm", "kkkk", "mkmk"], &[5.0], Length::Free);
    list.push(lace(1));
    list.push(random_misses(12, 1));
    let jersey = Chart::new(&["kkkkkk"; 6]);
    list.push(weft_knit_piece("jersey-5-piece", &jersey, Gauge::new(5.0), Length::Held));
    list
}

/// A knit with eyelets, in repeats of four wales and four courses. In every other course, the loop
/// of every fourth needle is moved to the next needle on the right. From one of these courses to
/// the next, the needles are two wales further on. The yarn goes over the empty needle.
#[must_use]
pub fn lace(repeats: usize) -> Start {
    let courses = vec![[">kkk", "kkkk", "kk>k", "kkkk"].map(|course| course.repeat(repeats)); repeats];
    let chart = Chart::new(&courses.concat());
    weft_knit(&format!("lace-{0}x{0}", 4 * repeats), &chart, Gauge::new(5.0), Length::Free)
}

/// A knit of `size` wales and `size` courses, in which about every fifth stitch is missed. At most
/// two missed stitches lie side by side or one above the other.
#[must_use]
pub fn random_misses(size: usize, seed: u64) -> Start {
    let mut missed = vec![vec![false; size]; size];
    let mut state = seed;
    for course in 0..size {
        for wale in 0..size {
            // SplitMix64 (Steele, Lea and Flood 2014).
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            let run = |cell: &dyn Fn(usize) -> bool| {
                let count = |step: usize| (1..size).take_while(|far| cell(far * step % size)).count();
                count(1) + count(size - 1)
            };
            let beside = run(&|far| missed[course][(wale + far) % size]);
            let above = run(&|far| missed[(course + far) % size][wale]);
            missed[course][wale] = mixed.is_multiple_of(4) && beside < 2 && above < 2;
        }
    }
    let letters = |course: &Vec<bool>| course.iter().map(|missed| if *missed { 'm' } else { 'k' }).collect();
    let courses: Vec<String> = missed.iter().map(letters).collect();
    weft_knit(&format!("random-{size}x{size}"), &Chart::new(&courses), Gauge::new(5.0), Length::Free)
}

fn warp_knits() -> Vec<Start> {
    let plain = Lapping { bars: &[], diameter: 0.13, bulge: 0.9, slant: 0.15 };
    let one_bar: [(&str, &[&str], f64, f64); 6] = [
        ("tricot", &["1-0/1-2"], 0.9, 0.15),
        ("open-tricot", &["0-1/2-1"], 0.9, 0.05),
        ("pillar", &["0-1/1-0"], 0.9, 0.05),
        ("cord", &["1-0/2-3"], 0.9, 0.15),
        ("open-atlas", &["0-1/1-2/3-2/2-1"], 0.9, 0.15),
        ("one-bar-satin", &["1-0/3-4"], 0.7, 0.15),
    ];
    let two_bars: [(&str, &[&str], &[f64]); 7] = [
        ("counter-tricot", &["1-0/1-2", "1-2/1-0"], &[0.08, 0.1, 0.13]),
        ("locknit", &["1-0/2-3", "1-2/1-0"], &[0.08, 0.1]),
        ("reverse-locknit", &["1-0/1-2", "2-3/1-0"], &[0.08, 0.1]),
        ("sharkskin", &["1-0/1-2", "3-4/1-0"], &[0.08, 0.1]),
        ("satin", &["1-0/3-4", "1-2/1-0"], &[0.08, 0.1]),
        ("queenscord", &["1-0/0-1", "3-4/1-0"], &[0.08, 0.1]),
        ("parallel-tricot", &["1-0/1-2", "1-0/1-2"], &[0.08, 0.1]),
    ];
    let singles = one_bar.map(|(name, bars, bulge, slant)| {
        warp_knit(&format!("{name}-{}", plain.diameter), Lapping { bars, bulge, slant, ..plain })
    });
    let doubles = two_bars.into_iter().flat_map(|(name, bars, diameters)| {
        diameters.iter().map(move |&diameter| {
            warp_knit(&format!("{name}-{diameter}"), Lapping { bars, diameter, ..plain })
        })
    });
    singles.into_iter().chain(doubles).collect()
}

fn weaves() -> Vec<Start> {
    let plain = Weave { size: 4, step: 1, order: 2, pitch: 1.8 };
    let satin = Weave { size: 8, step: 3, order: 8, pitch: 1.3 };
    vec![
        woven("plain-1.8", plain, Length::Free),
        woven_piece("plain-1.8-piece", Weave { size: 6, ..plain }, Length::Held),
        woven("satin-8-1.3", satin, Length::Free),
    ]
}
