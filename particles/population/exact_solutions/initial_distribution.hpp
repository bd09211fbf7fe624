// The population at time zero as a distribution over volume: numbers, moments of any order and integrals.
#pragma once

#include <functional>

#include "core/modules.hpp"
#include "particles/population/model/population_model.hpp"

namespace lampblack::particles {

// Sum of v^order (m^(3 order - 3)); an exponential distribution has those above -1 only (InputError).
[[nodiscard]] double initialMoment(const InitialPopulation& initial, double order);

// The same of one row of a table.
[[nodiscard]] double intervalMoment(const SizeInterval& interval, double order);

// Number (1/m3) with a volume in [lower, upper).
[[nodiscard]] double initialNumber(const InitialPopulation& initial, double lower, double upper);

// Integral of f(v) n(v) dv over [lower, upper) of a smooth f that grows no faster than v^3.
[[nodiscard]] double initialIntegral(const InitialPopulation& initial, double lower, double upper,
                                     const std::function<double(double)>& f);

}  // namespace lampblack::particles
