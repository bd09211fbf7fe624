// What the tests of first profiles share: gases, problems, and what has to hold whatever the flame.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/equilibrium.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "flow/flame/flame_problem.hpp"
#include "flow/flame/flame_profile.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flame/streams.hpp"

namespace lampblack::test {

struct Gas {
  explicit Gas(const std::string& file) : mechanism(shippedMechanism(file)), thermo(mechanism) {}
  static Gas& methane() {
    static Gas gas("methane_drm19_21.yaml");
    return gas;
  }
  static Gas& hydrogen() {
    static Gas gas("hydrogen_h2o2_10.yaml");
    return gas;
  }
  [[nodiscard]] FlameStream stream(std::string_view moles, double T, double speed = 0, double p = 101325) const {
    return streamAt(mechanism, moles, T, speed, p);
  }
  [[nodiscard]] double equilibriumTemperature(const FlameStream& s, double p = 101325) const {
    auto Y = s.Y;
    return Equilibrium(mechanism).atEnthalpyAndPressure(thermo.enthalpyMass(s.temperature, s.Y), p, Y);
  }
  // Mass fraction of an element.
  [[nodiscard]] double element(std::size_t e, std::span<const double> Y) const {
    double sum = 0;
    for (std::size_t k = 0; k < Y.size(); ++k)
      sum += mechanism.atoms(k, e) * mechanism.atomicWeight(e) * Y[k] / mechanism.molecularWeights()[k];
    return sum;
  }
  Mechanism mechanism;
  Thermo thermo;
};

inline constexpr const char* stoichiometric = "CH4: 1, O2: 2, N2: 7.52";
inline constexpr const char* air = "O2: 0.21, N2: 0.79";

inline FlameProblem counterflowProblem(const Gas& gas, const char* left = "CH4: 1", const char* right = air) {
  FlameProblem p;
  p.type = FlameType::Counterflow;
  p.left = gas.stream(left, 300, 0.3);
  p.right = gas.stream(right, 350, 0.25);
  return p;
}

inline FlameProblem oneStream(const Gas& gas, FlameType type, const char* moles = stoichiometric, double speed = 0.2) {
  FlameProblem p;
  p.type = type;
  p.left = gas.stream(moles, 300, speed);
  p.wallTemperature = 400;
  return p;
}

// Fractions between 0 and 1 that sum to 1, the streams at the ends, temperatures between `coldest` and `hottest`, and
// mass fluxes as finite volumes around the points have them.
inline void expectSound(const Gas& gas, const FlameProblem& problem, const FlameProfile& p, double coldest,
                        double hottest) {
  EXPECT_EQ(p.z.front(), 0.0);
  if (problem.type == FlameType::Free)
    EXPECT_GE(p.z.back(), problem.length);
  else
    EXPECT_EQ(p.z.back(), problem.length);
  double flux = p.global(leftMassFlux);
  double largest = std::abs(flux);
  for (std::size_t i = 0; i < p.points(); ++i) {
    double sum = 0;
    for (double Y : p.massFractions(i)) {
      sum += Y;
      EXPECT_GE(Y, 0.0);
      EXPECT_LE(Y, 1.0 + 1e-14);
    }
    EXPECT_NEAR(sum, 1.0, 1e-13) << i;
    EXPECT_GE(p.temperature(i), coldest * (1 - 1e-12)) << i;
    EXPECT_LE(p.temperature(i), hottest * (1 + 1e-9)) << i;
    EXPECT_GE(p.at(i, FlameLayout::spread), 0.0);
    const double low = i == 0 ? p.z[0] : 0.5 * (p.z[i - 1] + p.z[i]);
    const double high = i + 1 == p.points() ? p.z[i] : 0.5 * (p.z[i] + p.z[i + 1]);
    const double rho = gas.thermo.density(p.temperature(i), problem.pressure, p.massFractions(i));
    flux -= 2 * rho * p.at(i, FlameLayout::spread) * (high - low);
    largest = std::max(largest, std::abs(flux));
    EXPECT_NEAR(p.at(i, FlameLayout::massFlux), flux, 1e-12 * largest) << i;
    for (double s : p.scalars(i)) EXPECT_EQ(s, 0.0);
    if (i > 0) {
      EXPECT_GT(p.z[i], p.z[i - 1]);
    }
  }
  EXPECT_EQ(p.global(load), 1.0);
  for (std::size_t k = 0; k < p.layout.species; ++k) EXPECT_NEAR(p.massFractions(0)[k], problem.left.Y[k], 1e-14);
  if (!problem.given) {
    EXPECT_EQ(p.temperature(0), problem.left.temperature);
  }
  if (problem.right) {
    for (std::size_t k = 0; k < p.layout.species; ++k)
      EXPECT_NEAR(p.massFractions(p.points() - 1)[k], problem.right->Y[k], 1e-14);
    EXPECT_EQ(p.temperature(p.points() - 1), problem.right->temperature);
  }
}

// Largest difference of the elements from a straight line between those of the streams, over a share that falls.
inline void expectElementsMixed(const Gas& gas, const FlameProblem& problem, const FlameProfile& p) {
  const auto& left = problem.left.Y;
  const auto& right = problem.right ? problem.right->Y : problem.left.Y;
  // The element that differs most between the streams tells the share.
  std::size_t best = 0;
  for (std::size_t e = 1; e < gas.mechanism.numElements(); ++e)
    if (std::abs(gas.element(e, left) - gas.element(e, right)) >
        std::abs(gas.element(best, left) - gas.element(best, right)))
      best = e;
  double previous = 1;
  for (std::size_t i = 0; i < p.points(); ++i) {
    const auto Y = p.massFractions(i);
    const double difference = gas.element(best, left) - gas.element(best, right);
    const double share = difference == 0 ? 0 : (gas.element(best, Y) - gas.element(best, right)) / difference;
    EXPECT_LE(share, previous + 1e-9);
    previous = share;
    for (std::size_t e = 0; e < gas.mechanism.numElements(); ++e)
      // Equilibria keep their elements to about 1e-10.
      EXPECT_NEAR(gas.element(e, Y), share * gas.element(e, left) + (1 - share) * gas.element(e, right), 1e-9)
          << gas.mechanism.elementName(e) << " at point " << i;
  }
}

}  // namespace lampblack::test
