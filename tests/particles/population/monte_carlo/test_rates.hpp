// Rates for tests of the stores: the entry is a volume; kernels in closed form, so that the rates of all pairs can be
// enumerated.
#pragma once

#include <cmath>

#include "particles/population/monte_carlo/store.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// Additive kernel u + v (rank 1), or with rank 2 the shape of the free-molecular one,
// (u^2/3 + v^2/3) (u^-1/2 + v^-1/2), of which (u^1/3 + v^1/3)^2 sqrt(1/u + 1/v) is the kernel, halved.
struct TestRates {
  struct Entry {
    double volume = 0;
  };
  static constexpr bool weighted = false;
  std::size_t kernelRank = 1;
  bool singles = true;
  double scale = 1;  // of all rates of pairs

  [[nodiscard]] double volume(const Entry& e) const { return e.volume; }
  [[nodiscard]] double weight(const Entry&) const { return 1; }
  [[nodiscard]] std::size_t rank() const { return kernelRank; }
  [[nodiscard]] CollisionKernel::Terms terms(const Entry& e) const {
    CollisionKernel::Terms terms;
    const double v = e.volume;
    if (kernelRank == 1) {
      terms.p[0] = scale * v;
      terms.q[0] = 1;
    } else {
      terms.p = {scale * std::pow(v, 1.0 / 6), scale * std::pow(v, 2.0 / 3), 0};
      terms.q = {1, std::pow(v, -0.5), 0};
    }
    return terms;
  }
  [[nodiscard]] double weightFactor() const { return 1; }
  [[nodiscard]] double pair(const Entry& a, const Entry& b) const {
    if (kernelRank == 1) return scale * (a.volume + b.volume);
    const double reach = std::cbrt(a.volume) + std::cbrt(b.volume);
    return scale * 0.5 * reach * reach * std::sqrt(1 / a.volume + 1 / b.volume);
  }
  [[nodiscard]] double single(SingleProcess process, const Entry& e) const {
    if (process == SingleProcess::breakage) return std::pow(e.volume, 1.8);
    return process == SingleProcess::deposition ? 3.0 : 0.0;
  }
  [[nodiscard]] bool active(SingleProcess process) const { return singles && process != SingleProcess::condensation; }
};

}  // namespace lampblack::test
