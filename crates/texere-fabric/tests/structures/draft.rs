//! Drafts against their definition, in plain and slow code.

use proptest::prelude::*;
use texere_fabric::{Draft, FabricError, Shedding, WovenError};

/// Whether the warp is up, by the draft's definition: with a rising shed one of the end's shafts is
/// lifted, with a sinking shed none is.
fn up(draft: &Draft, end: usize, pick: usize) -> bool {
    let lifted: Vec<u32> = match &draft.shedding {
        Shedding::LiftPlan(lifts) => lifts[pick].clone(),
        Shedding::TieUp { tie_up, treadling } => treadling[pick]
            .iter()
            .filter(|&&treadle| treadle > 0 && treadle as usize <= tie_up.len())
            .flat_map(|&treadle| tie_up[treadle as usize - 1].clone())
            .collect(),
    };
    let meets = draft.threading[end].iter().any(|shaft| *shaft > 0 && lifted.contains(shaft));
    meets == draft.rising_shed
}

/// Lists of numbers from 0 to `most`, where 0 stands for none.
fn lists(most: u32, threads: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Vec<u32>>> {
    prop::collection::vec(prop::collection::vec(0..=most, 0..4), threads)
}

fn shedding() -> impl Strategy<Value = Shedding> {
    prop_oneof![
        (lists(6, 0..6), lists(8, 1..40))
            .prop_map(|(tie_up, treadling)| Shedding::TieUp { tie_up, treadling }),
        lists(6, 1..40).prop_map(Shedding::LiftPlan),
    ]
}

proptest! {
    #[test]
    fn drawdown_follows_the_definition(
        // Enough ends for shafts with many ends and shafts with few.
        threading in lists(6, 1..200),
        shedding in shedding(),
        rising_shed: bool,
    ) {
        let draft = Draft { threading, shedding, rising_shed };
        let drawdown = draft.drawdown().unwrap();
        prop_assert_eq!((drawdown.ends(), drawdown.picks()), (draft.ends(), draft.picks()));
        for pick in 0..draft.picks() {
            for end in 0..draft.ends() {
                prop_assert_eq!(drawdown.up(end, pick), up(&draft, end, pick), "end {}, pick {}", end, pick);
            }
        }
    }
}

#[test]
fn numbers_may_be_as_large_as_they_like() {
    let draft = Draft {
        threading: vec![vec![u32::MAX], vec![1], vec![]],
        shedding: Shedding::LiftPlan(vec![vec![u32::MAX], vec![u32::MAX - 1, 1], vec![]]),
        rising_shed: true,
    };
    let drawdown = draft.drawdown().unwrap();
    let up: Vec<_> = (0..9).filter(|at| drawdown.up(at % 3, at / 3)).collect();
    assert_eq!(up, [0, 4]);
}

#[test]
fn empty_and_oversized_drafts_are_refused() {
    let draft = |ends: usize, shedding| Draft { threading: vec![vec![1]; ends], shedding, rising_shed: true };
    let none = draft(0, Shedding::LiftPlan(vec![vec![1]]));
    assert!(matches!(none.drawdown(), Err(FabricError::Woven(WovenError::Size { ends: 0, picks: 1, .. }))));
    let none = draft(1, Shedding::TieUp { tie_up: vec![], treadling: vec![] });
    assert!(matches!(none.drawdown(), Err(FabricError::Woven(WovenError::Size { ends: 1, picks: 0, .. }))));
    let wide = draft(1_000_000, Shedding::TieUp { tie_up: vec![vec![1]; 5000], treadling: vec![vec![1]; 4] });
    assert!(matches!(wide.drawdown(), Err(FabricError::Woven(WovenError::TieUp { treadles: 5000, .. }))));
}
