// Breakage of equal particles into b equal pieces: sizes v_k = b^-k, rates B_k = b^(-k p), and
//
//   dN_k/dt = b B_(k-1) N_(k-1) - B_k N_k,   N_0(0) = 1.
//
// N_k / b^k is the probability that a piece has broken k times. The sum is over a Poisson process of rate B_0 that
// breaks a piece of generation k with probability B_k / B_0 (uniformisation; Jensen 1953): only positive terms, so that
// every N_k comes out to round-off relative to itself.
#pragma once

#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles::exact {

// N_k, up to where nothing is left that would count in the number. `exponent` p >= 0. Throws InputError where tau, the
// time in units of 1/B_0, is so large that the sum would take more than about a minute.
[[nodiscard]] std::vector<double> breakageChain(int pieces, double exponent, double tau);

}  // namespace lampblack::particles::exact
