// A convergence study of Monte Carlo methods: the error against the number of numerical particles N at a constant
// product N L, L being the number of repeats (Shekar, Smith, Kraft, Wagner 2011, section 3.2).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::app {

struct ConvergenceOptions {
  std::filesystem::path deck;
  std::vector<std::string> overrides;  // of the deck
  std::vector<std::string> methods;    // by their name in the deck; empty: all that have particles
  std::vector<std::int64_t> particles;
  std::int64_t product = 131072;
  bool exact = true;  // the reference is the exact solution; otherwise a run of `referenceMethod`
  std::string referenceMethod;
  std::int64_t referenceParticles = 0, referenceRepeats = 0;
};

}  // namespace lampblack::app
