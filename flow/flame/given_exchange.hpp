// What is exchanged with the gas of a flame by something that is not part of it: stochastic particles that were
// computed along it.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::flow {

// At points, linear between them, zero outside.
struct GivenExchange {
  std::vector<double> z;           // m, rising
  std::vector<double> species;     // production, kg/m3/s, point-major, all species of the mechanism
  std::vector<double> absorption;  // by particles, 1/m
  std::vector<double> enthalpy;    // J/m3/s given to the gas by what it exchanges, apart from the species' own

  class Sample {
   public:
    Sample(const GivenExchange& exchange, double z);
    [[nodiscard]] double species(std::size_t k) const;
    [[nodiscard]] double absorption() const;
    [[nodiscard]] double enthalpy() const;

   private:
    [[nodiscard]] double between(const std::vector<double>& values, std::size_t stride, std::size_t k) const;

    const GivenExchange* exchange_;
    std::size_t upper_ = 0;                   // 0: outside
    double lowerShare_ = 0, upperShare_ = 0;  // of the point before it, and of it
  };
  [[nodiscard]] Sample at(double height) const { return {*this, height}; }
};

}  // namespace lampblack::flow
