// A first profile of a flame, from its streams alone, good enough for the solver to start from.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "flow/flame/flame_problem.hpp"
#include "flow/flame/flame_profile.hpp"

namespace lampblack {

struct InitialFlameOptions {
  std::size_t points = 40;
};

// Free and burner: unburnt to equilibrium products over a thin zone; wall: the same ahead of the wall; counterflow: the
// streams mix across a layer where they meet, and are at equilibrium there. Scalars are zero. InputError for a problem
// that cannot burn.
[[nodiscard]] FlameProfile initialFlame(const Mechanism& mechanism, const FlameProblem& problem, std::size_t scalars,
                                        const InitialFlameOptions& options = {});

// A profile with the names that a file has.
struct NamedFlameProfile {
  FlameProfile profile;
  std::vector<std::string> species, scalars;
};

// A profile of any flame as the start of another one: on the new length, on another mechanism (species by name; those
// the old one does not have start at zero and fractions are scaled to sum to one), with the streams of the new problem.
[[nodiscard]] FlameProfile startFrom(const NamedFlameProfile& other, const Mechanism& mechanism,
                                     const FlameProblem& problem, std::size_t scalars);

}  // namespace lampblack
