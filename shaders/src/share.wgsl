// How the stores of a workgroup's rings are shared among its lanes. After common.wgsl.
//
// share.cl is the twin of this file.

// A lane's share of the stores of a workgroup's rings, which all have as many stores. A lane makes
// store number `store` of ring `ring` and of each `step`th ring after it. A lane thus fetches its
// part of the outline or of the pattern only once. Where a ring has more stores than the workgroup
// has lanes, a lane goes on `across` stores further.
struct Share {
    store: u32,
    across: u32,
    ring: u32,
    step: u32,
}

// The share of lane `lane` of `lanes` in rings of `stores`. Lanes that are left over get none.
fn share_of(lane: u32, lanes: u32, stores: u32) -> Share {
    let across = min(stores, lanes);
    let step = quotient(lanes, across);
    let ring = quotient(lane, across);
    return Share(select(stores, lane - ring * across, ring < step), across, ring, step);
}
