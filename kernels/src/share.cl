// How the stores of a workgroup's rings are shared among its lanes. This file follows common.cl.
//
// share.wgsl is the twin of this file.

// The stores (writes to memory) that one lane makes for the rings of a workgroup. Each ring takes
// equally many stores. A lane makes store number `store` of ring `ring` and of each `step`th ring
// after it. It thus fetches its part of the outline or of the pattern only once. If a ring has more
// stores than the workgroup has lanes, the lane then goes on `across` stores further.
typedef struct {
    uint store;
    uint across;
    uint ring;
    uint step;
} Share;

// The share of lane `lane`, of `lanes` lanes, in rings of `stores` stores. Lanes that are left over
// get no stores.
Share share_of(uint lane, uint lanes, uint stores) {
    Share share;
    share.across = min(stores, lanes);
    share.step = quotient(lanes, share.across);
    share.ring = quotient(lane, share.across);
    share.store = share.ring < share.step ? lane - share.ring * share.across : stores;
    return share;
}
