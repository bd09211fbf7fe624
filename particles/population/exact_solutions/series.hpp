// Series behind the size distributions, each arranged so that it neither overflows nor loses digits.
#pragma once

#include "core/modules.hpp"

namespace lampblack::particles::exact {

// exp(-z) I1(z), z >= 0: modified Bessel function of the first kind, scaled.
[[nodiscard]] double scaledBesselI1(double z);

// -ln(1-e) - e for 0 <= e <= 1.
[[nodiscard]] double logarithmicExcess(double e);

// ln k! - [ln sqrt(2 pi k) + k ln k - k], for whole k >= 1.
[[nodiscard]] double stirlingRest(double k);

// exp(-(1+tau) x) sum over k of tau^k x^(3k) / ((k+1)! (2k+1)!): coagulation with the kernel u v from an exponential
// distribution.
[[nodiscard]] double multiplicativeDensity(double tau, double x);

}  // namespace lampblack::particles::exact
