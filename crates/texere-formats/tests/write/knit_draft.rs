//! Stitch charts, read back.

use image::Rgb;
use texere_core::{Material, Section};
use texere_fabric::weft::{Beds, Chart, Gauge, KnitYarn, Knitted, Machine};
use texere_formats::WriteError;
use texere_formats::write::{Side, knit_draft, knit_rows};

const YARN: [u8; 3] = [200, 40, 90];

fn knitted(chart: &str, beds: Beds) -> Knitted {
    let program = Chart::parse(chart, beds).unwrap().program().unwrap();
    let stitches = Machine::default().knit(&program).unwrap().stitches;
    let material = Material { srgb: YARN, ..Material::default() };
    let (gauge, yarn) = (Gauge::new(1.0, 0.75), KnitYarn::new(0.1));
    Knitted::new(stitches, gauge, vec![yarn], vec![material], vec![Section::Circle], [1, 1]).unwrap()
}

fn rows(chart: &str, beds: Beds, side: Side) -> String {
    knit_rows(&knitted(chart, beds), side).unwrap().collect::<Vec<_>>().join("\n")
}

#[test]
fn a_chart_is_drawn_as_it_was_written() {
    for chart in
        ["kp", "kkkk\ntkkm\nkkkk\nkmkt", "kkkkk\nkkk>k\nkkkkk\nk<kkk", "kkkkkkk\nRRrkkkk\nkkkkkkk\nkkkkllL"]
    {
        assert_eq!(rows(chart, Beds::One, Side::Face), chart);
    }
    for chart in ["kk\nbb", "bb\nku\nbb\ntp"] {
        assert_eq!(rows(chart, Beds::Two, Side::Face), chart);
    }
    // In interlock neither yarn is drawn through the other's loops, so both lie in one course.
    assert_eq!(rows("kp\npk", Beds::Two, Side::Face), "bb");
}

#[test]
fn the_back_shows_each_stitch_from_behind_the_last_wale_first() {
    assert_eq!(rows("kkkkk\npkkkt\nkkkkk", Beds::One, Side::Back), "ppppp\nupppk\nppppp");
    // The half of a cable that goes to the right in front goes to the left, and behind, as seen
    // from the back.
    assert_eq!(rows("kkkkk\nRRrkk", Beds::One, Side::Back), "ppppp\nppRrr");
}

#[test]
fn squares_have_the_yarns_colour_and_a_dot_where_it_purls() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("chart.png");
    let cloth = knitted("kk\nkp", Beds::One);
    let size = knit_draft(&cloth, Side::Face, &path).unwrap();
    let picture = image::open(&path).unwrap().to_rgb8();
    assert_eq!(size, [picture.width(), picture.height()]);
    // Squares have 16 pixels, after a margin of 12.
    let middle = |column: u32, row: u32| *picture.get_pixel(12 + 16 * column + 8, 12 + 16 * row + 8);
    assert_eq!([middle(0, 0), middle(1, 0), middle(0, 1)], [Rgb(YARN); 3]);
    assert_eq!(middle(1, 1), Rgb([0, 0, 0]));
    // The needle diagram makes the picture higher. The back has none.
    let back = knit_draft(&cloth, Side::Back, &path).unwrap();
    assert!(back[1] < size[1], "{size:?} and {back:?}");
}

#[test]
fn only_png_files_are_written() {
    let cloth = knitted("k", Beds::One);
    let refused = knit_draft(&cloth, Side::Face, std::path::Path::new("chart.jpg"));
    assert!(matches!(refused, Err(WriteError::NotPng { .. })));
}
