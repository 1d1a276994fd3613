//! The file of the herringbone in `designs/` equals the one that its example writes, and shows a
//! herringbone.

#[allow(dead_code, reason = "its main is not called here")]
#[path = "../../examples/herringbone_wif.rs"]
mod herringbone_wif;

#[test]
fn committed_file_is_what_the_example_draws() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../designs/herringbone.wif");
    let committed = std::fs::read_to_string(path).unwrap().replace("\r\n", "\n");
    assert!(
        committed == herringbone_wif::wif().unwrap(),
        "draw {path} again with the example herringbone_wif"
    );
}

#[test]
fn twill_runs_right_then_left_with_a_clean_cut_between() {
    let drawdown = herringbone_wif::draft().drawdown().unwrap();
    for pick in 0..drawdown.picks() - 1 {
        for end in 0..drawdown.ends() - 1 {
            let (here, right) = (drawdown.up(end, pick), drawdown.up(end + 1, pick));
            let stripe = end / 16;
            if (end + 1) / 16 != stripe {
                assert_ne!(here, right, "end {end} floats on into the next stripe");
            } else if stripe % 2 == 0 {
                assert_eq!(here, drawdown.up(end + 1, pick + 1), "end {end}, pick {pick}");
            } else {
                assert_eq!(right, drawdown.up(end, pick + 1), "end {end}, pick {pick}");
            }
        }
    }
}
