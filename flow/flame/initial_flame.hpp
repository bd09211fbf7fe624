// A first profile of a flame, from its streams alone, good enough for the solver to start from.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_problem.hpp"
#include "flow/flame/flame_profile.hpp"

namespace lampblack::flow {

struct InitialFlameOptions {
  std::size_t points = 40;
  bool cold = false;  // nothing has burnt: streams that only flow and mix, on purpose (not free)
};

// Free and burner: unburnt to equilibrium products over a thin zone; wall: the same ahead of the wall; counterflow: the
// streams mix across a layer where they meet, and have burnt there. Sums of mass fractions and elements are those of
// the streams, the mass flux is that which the spreading leaves (discretely, with finite volumes around the points).
// Scalars are zero. Streams that cannot burn only flow and mix; of a free flame that is an InputError.
[[nodiscard]] FlameProfile initialFlame(const Mechanism& mechanism, const FlameProblem& problem, std::size_t scalars,
                                        const InitialFlameOptions& options = {});

// The same and, of a free flame whose speed is not given, others for the solver to fall back on: faster and thinner,
// slower and thicker.
[[nodiscard]] std::vector<FlameProfile> initialFlames(const Mechanism& mechanism, const FlameProblem& problem,
                                                      std::size_t scalars, const InitialFlameOptions& options = {});

// A profile with the names that a file has.
struct NamedFlameProfile {
  FlameProfile profile;
  std::vector<std::string> species, scalars;
};

// A profile of any flame of the same type as the start of another one: on the new length, on another mechanism (species
// by name; those the old one does not have start at zero and fractions are scaled to sum to one), with the streams of
// the new problem. Scalars are taken over by name and in the units of the profile, others are zero. InputError where no
// species is left.
[[nodiscard]] FlameProfile startFrom(const NamedFlameProfile& other, const Mechanism& mechanism,
                                     const FlameProblem& problem, std::span<const std::string> scalars);

}  // namespace lampblack::flow
