// How the stores of a workgroup's rings are shared among its lanes. After common.cl.
//
// share.wgsl is the twin of this file.

// A lane's share of the stores of a workgroup's rings, which all have as many stores. A lane makes
// store number `store` of ring `ring` and of each `step`th ring after it. A lane thus fetches its
// part of the outline or of the pattern only once. Where a ring has more stores than the workgroup
// has lanes, a lane goes on `across` stores further.
typedef struct {
    uint store;
    uint across;
    uint ring;
    uint step;
} Share;

// The share of lane `lane` of `lanes` in rings of `stores`. Lanes that are left over get none.
Share share_of(uint lane, uint lanes, uint stores) {
    Share share;
    share.across = min(stores, lanes);
    share.step = quotient(lanes, share.across);
    share.ring = quotient(lane, share.across);
    share.store = share.ring < share.step ? lane - share.ring * share.across : stores;
    return share;
}
