// In: the functions that work on vectors. Out: a table of them, one for each instruction set.
#pragma once
#include "../network/tape.h"
#include "../separate/distance_bound.h"
#include "../separate/loop.h"
#include "../segments/self_test.h"

static const nsvcd__kernels nsvcd__table = {
    nsvcd__self_test_lanes,
#ifndef NSVCD_NO_PROOF
    nsvcd__separate,        nsvcd__is_contained_at_start,
    nsvcd__bound_distance,  nsvcd__seek_positions,
#endif
#ifndef NSVCD_NO_NETWORK
    nsvcd__ask_network,
#endif
#ifndef NSVCD_NO_GRADIENT
    nsvcd__record,
#endif
};
