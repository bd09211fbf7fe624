// How much a run of the tests computes: little in the fast tier (scripts/test), all of it in the long one (scripts/test
// --long).
#pragma once

#include <cstdlib>

#include "tests/every_module.hpp"

namespace lampblack::test {

// True in ctest entries that lampblack_test(... LONG) makes: LAMPBLACK_LONG_TESTS is set there.
inline bool isLongRun() {
  return std::getenv("LAMPBLACK_LONG_TESTS") != nullptr;
}

// Meshes, steps, seeds, repeats: `few` in the fast tier, `many` in a long run.
template <class Number>
Number fewOrMany(Number few, Number many) {
  return isLongRun() ? many : few;
}

}  // namespace lampblack::test
