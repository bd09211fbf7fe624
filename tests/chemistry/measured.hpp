// Prints and records what a test measured, for the table in docs/theory/chemistry.md.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "tests/every_module.hpp"

namespace lampblack::test {

inline void measured(const std::string& what, double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  ::testing::Test::RecordProperty(what, std::string(text));
  std::printf("  measured %s: %s\n", what.c_str(), text);
}

// The larger of `worst` and |value|; NaN counts as infinite.
inline void raise(double& worst, double value) {
  worst = std::isnan(value) ? INFINITY : std::max(worst, std::abs(value));
}

}  // namespace lampblack::test
