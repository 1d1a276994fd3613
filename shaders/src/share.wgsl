// How the stores of a workgroup's rings are shared among its lanes. This file follows common.wgsl.
//
// share.cl is the twin of this file.

// The stores (writes to memory) that one lane makes for the rings of a workgroup. Each ring takes
// equally many stores. A lane makes store number `store` of ring `ring` and of each `step`th ring
// after it. It thus fetches its part of the outline or of the pattern only once. If a ring has more
// stores than the workgroup has lanes, the lane then goes on `across` stores further.
struct Share {
    store: u32,
    across: u32,
    ring: u32,
    step: u32,
}

// The share of lane `lane`, of `lanes` lanes, in rings of `stores` stores. Lanes that are left over
// get no stores.
fn share_of(lane: u32, lanes: u32, stores: u32) -> Share {
    let across = min(stores, lanes);
    let step = quotient(lanes, across);
    let ring = quotient(lane, across);
    return Share(select(stores, lane - ring * across, ring < step), across, ring, step);
}
