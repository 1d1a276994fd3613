//! The starts that every solver is tried on.

use super::{Chart, Gauge, Length, Start, Weave, weft_knit, weft_knit_piece, woven, woven_piece};

/// The fixed list.
#[must_use]
pub fn starts() -> Vec<Start> {
    weft_knits().into_iter().chain(weaves()).collect()
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
    add("lace", &[">kkk", "kkkk", "kk>k", "kkkk"], &[5.0], Length::Free);
    let jersey = Chart::new(&["kkkkkk"; 6]);
    list.push(weft_knit_piece("jersey-5-piece", &jersey, Gauge::new(5.0), Length::Held));
    list
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
