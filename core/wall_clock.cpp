#include "core/wall_clock.hpp"

#include <chrono>

namespace lampblack {
namespace {

// Set before main() begins.
const std::chrono::steady_clock::time_point programStart = std::chrono::steady_clock::now();

}  // namespace

double secondsSinceStart() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - programStart).count();
}

}  // namespace lampblack
