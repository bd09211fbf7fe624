// Mixtures of fuel and oxidizer by their equivalence ratio.
#pragma once

#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// Mole fractions of fuel and oxidizer (mole fractions each) mixed at an equivalence ratio: the fuel's need of oxygen
// atoms (2 C + H/2 + 2 S + 2 Si - O) over what the oxidizer has to give. InputError where there is no such ratio.
std::vector<double> mixByEquivalenceRatio(const Mechanism& mechanism, const std::vector<double>& fuel,
                                          const std::vector<double>& oxidizer, double ratio);

}  // namespace lampblack::chemistry
