// Noise with a memory: steps of an autoregressive process of the first order, of mean zero and deviation one.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/constants.hpp"
#include "core/random.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

class Noise {
 public:
  // `memory`: the correlation of a value with the next.
  Noise(std::uint64_t seed, double memory) : random_(seed, 1, 1), memory_(memory), value_(normal()) {}

  double next() {
    value_ = memory_ * value_ + std::sqrt(1.0 - memory_ * memory_) * normal();
    return value_;
  }

 private:
  double normal() {
    return std::sqrt(2.0 * random_.exponential(1.0)) * std::cos(2.0 * constants::pi * random_.uniform());
  }

  RandomStream random_;
  double memory_, value_;
};

}  // namespace lampblack::test
