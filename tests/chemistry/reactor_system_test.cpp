#include "chemistry/reactor/reactor_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/constants.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::ethylene;
using lampblack::test::measured;
using lampblack::test::raise;
using lampblack::test::Table;
using Held = ReactorSystem::Held;
using Energy = ReactorSystem::Energy;
using Conditions = ReactorSystem::Conditions;

// (Y, T) of a state along the counterflow flame.
std::vector<double> flameState(std::size_t row) {
  static const Table table("counterflow_c2h4_states.csv");
  const std::size_t n = ethylene().numSpecies();
  std::vector<double> y(n + 1);
  Thermo(ethylene()).moleToMass(table.moleFractions(row, ethylene()), {y.data(), n});
  y[n] = table.number(row, "T");
  return y;
}

struct Case {
  Held held;
  Energy energy;
  bool open;
};

std::string name(const ::testing::TestParamInfo<Case>& info) {
  return std::string(info.param.held == Held::Pressure ? "ConstantPressure" : "ConstantDensity") +
         (info.param.energy == Energy::Conserved ? "" : "GivenTemperature") + (info.param.open ? "Open" : "Closed");
}

class EveryReactor : public ::testing::TestWithParam<Case> {
 protected:
  // An open reactor is fed with oxygen-rich air through a residence time of 10 us and heated.
  Conditions conditions(const std::vector<double>& y) {
    const auto& mechanism = ethylene();
    const std::size_t n = mechanism.numSpecies();
    Conditions result;
    result.held = GetParam().held;
    result.value = constants::oneAtmosphere;
    if (result.held == Held::Density)
      result.value = Thermo(mechanism).density(y[n], 2.5 * constants::oneAtmosphere, {y.data(), n});
    result.energy = GetParam().energy;
    result.temperatureRate = 1e6;
    source_.assign(n, 0.0);
    if (GetParam().open) {
      result.removal = 1e5;
      result.heating = 3e10;
      source_[mechanism.speciesIndex("O2")] = 3e4;
      source_[mechanism.speciesIndex("N2")] = 7e4;
    } else {
      source_[mechanism.speciesIndex("O2")] = 30;
      source_[mechanism.speciesIndex("CO2")] = -30;
    }
    result.source = source_;
    return result;
  }
  std::vector<double> source_;
};

// Central differences of fourth order with a relative step h have an error of about h^4 + eps/h, 1e-11 at h = 1e-3
// for rates that are polynomials of low degree; through the fall-off curves a little more. A given temperature slope
// shows nothing but the round-off of the difference.
TEST_P(EveryReactor, JacobianAgreesWithDifferences) {
  ReactorSystem system(ethylene());
  const std::size_t size = system.size(), n = size - 1;
  double worst = 0;
  for (const std::size_t row : {8UL, 14UL, 18UL}) {
    const auto y = flameState(row);
    system.setConditions(conditions(y));
    std::vector<double> f(size), J(size * size), rates(size);
    ASSERT_TRUE(system.jacobian(y.data(), f.data(), J.data(), size));
    ASSERT_TRUE(system.rates(y.data(), rates.data()));
    for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(f[i], rates[i], 1e-12 * std::abs(rates[n]));
    for (std::size_t j = 0; j < size; ++j) {
      const double step = j == n ? 0.1 : std::max(1e-5, 1e-3 * y[j]);
      std::vector<double> slope(size, 0.0), at(size);
      const double weights[4][2] = {{-2, 1}, {-1, -8}, {1, 8}, {2, -1}};
      for (const auto& [offset, weight] : weights) {
        auto changed = y;
        changed[j] += offset * step;
        ASSERT_TRUE(system.rates(changed.data(), at.data()));
        for (std::size_t k = 0; k < size; ++k) slope[k] += weight * at[k] / (12 * step);
      }
      double largest = 0;
      for (const double v : slope) largest = std::max(largest, std::abs(v));
      for (std::size_t k = 0; k < size; ++k) {
        raise(worst, (J[j * size + k] - slope[k]) / largest);
        EXPECT_NEAR(J[j * size + k], slope[k], 1e-7 * largest + 4e-16 * std::abs(rates[k]) / step) << k << " by " << j;
      }
    }
  }
  measured("of the column's largest", worst);
}

// The two forms of the Jacobian are the same sums in another order.
TEST_P(EveryReactor, SparseJacobianIsTheDenseOne) {
  ReactorSystem system(ethylene());
  const std::size_t size = system.size(), n = size - 1;
  double worst = 0;
  for (const std::size_t row : {8UL, 14UL, 18UL}) {
    const auto y = flameState(row);
    system.setConditions(conditions(y));
    std::vector<double> f(size), J(size * size), rates(size), sum(size * size, 0.0);
    ReactorSystem::SparseJacobian parts;
    ASSERT_TRUE(system.jacobian(y.data(), f.data(), J.data(), size));
    ASSERT_TRUE(system.sparseJacobian(y.data(), rates.data(), parts));
    for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(f[i], rates[i], 1e-14 * std::abs(f[i]));
    const auto& pattern = system.pattern();
    for (std::size_t j = 0; j < n; ++j) {
      for (auto e = pattern.columnStart[j]; e < pattern.columnStart[j + 1]; ++e)
        sum[j * size + pattern.row[e]] += parts.species[e];
      sum[j * size + n] = parts.temperatureRow[j];
      for (std::size_t i = 0; i < size; ++i) sum[j * size + i] += parts.product[i] * system.inverseWeights()[j];
    }
    for (std::size_t i = 0; i < size; ++i) sum[n * size + i] = parts.temperatureColumn[i];
    for (std::size_t j = 0; j < size; ++j) {
      double largest = 0;
      for (std::size_t i = 0; i < size; ++i) largest = std::max(largest, std::abs(J[j * size + i]));
      for (std::size_t i = 0; i < size; ++i) {
        raise(worst, (sum[j * size + i] - J[j * size + i]) / largest);
        EXPECT_NEAR(sum[j * size + i], J[j * size + i], 1e-12 * largest) << i << " by " << j;
      }
    }
  }
  measured("of the column's largest", worst);
}

// What the energy equation says, from the thermodynamics of the mixture instead: the enthalpy (internal energy) along
// the direction of f changes at the rate q - r h (q - r u). Differences of fourth order over a small time.
class ConservingReactor : public EveryReactor {};

TEST_P(ConservingReactor, EnergyChangesByHeatingAndRemovalAlone) {
  ReactorSystem system(ethylene());
  const Thermo thermo(ethylene());
  const std::size_t size = system.size(), n = size - 1;
  double worst = 0;
  for (const std::size_t row : {8UL, 14UL, 18UL}) {
    const auto y = flameState(row);
    const auto c = conditions(y);
    system.setConditions(c);
    std::vector<double> f(size);
    ASSERT_TRUE(system.rates(y.data(), f.data()));
    const auto energy = [&](double t) {
      auto moved = y;
      for (std::size_t i = 0; i < size; ++i) moved[i] += t * f[i];
      const std::span<const double> Y(moved.data(), n);
      double value = thermo.enthalpyMass(moved[n], Y);
      if (GetParam().held == Held::Density)
        for (std::size_t k = 0; k < n; ++k)
          value -= Y[k] * constants::gasConstant * moved[n] / thermo.molecularWeights()[k];
      return value;
    };
    const double t = 1.0 / std::abs(f[n]);  // 1 K
    const double rate = (energy(-2 * t) - 8 * energy(-t) + 8 * energy(t) - energy(2 * t)) / (12 * t);
    const double expected = c.heating - c.removal * energy(0);
    const double scale = thermo.cpMass(y[n], {y.data(), n}) * std::abs(f[n]) + std::abs(expected);
    raise(worst, (rate - expected) / scale);
    EXPECT_NEAR(rate, expected, 1e-8 * scale) << row;
  }
  measured("of the sum of magnitudes", worst);
}

// The equations hold whichever quantity is held: at the density of the constant-pressure state, dY/dt is the same and
// the other temperature slope is larger by what expansion work takes, (cp - R/Wbar) dT/dt|v = cp dT/dt|p + R T dn/dt.
TEST(ReactorSystem, ConstantDensityAndPressureDifferByTheExpansionWork) {
  ReactorSystem system(ethylene());
  const Thermo thermo(ethylene());
  const std::size_t size = system.size(), n = size - 1;
  const auto y = flameState(14);
  std::vector<double> atPressure(size), atDensity(size);
  Conditions conditions{.held = Held::Pressure, .value = 3e5, .source = {}};
  system.setConditions(conditions);
  ASSERT_TRUE(system.rates(y.data(), atPressure.data()));
  const double density = system.density();
  EXPECT_NEAR(density, thermo.density(y[n], 3e5, {y.data(), n}), 1e-14 * density);
  conditions = {.held = Held::Density, .value = density, .source = {}};
  system.setConditions(conditions);
  ASSERT_TRUE(system.rates(y.data(), atDensity.data()));
  EXPECT_NEAR(system.pressure(), 3e5, 1e-8);
  double moles = 0;
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_NEAR(atPressure[k], atDensity[k], 1e-12 * std::abs(atPressure[k]));
    moles += atDensity[k] / thermo.molecularWeights()[k];
  }
  const std::span<const double> Y(y.data(), n);
  const double cp = thermo.cpMass(y[n], Y), R = constants::gasConstant, specific = R / thermo.meanMolecularWeight(Y);
  EXPECT_NEAR((cp - specific) * atDensity[n], cp * atPressure[n] + R * y[n] * moles,
              1e-11 * std::abs(cp * atDensity[n]));
}

constexpr Case kConserving[] = {{Held::Pressure, Energy::Conserved, false},
                                {Held::Pressure, Energy::Conserved, true},
                                {Held::Density, Energy::Conserved, false},
                                {Held::Density, Energy::Conserved, true}};
constexpr Case kGivenTemperature[] = {{Held::Pressure, Energy::GivenTemperature, true},
                                      {Held::Density, Energy::GivenTemperature, false}};

INSTANTIATE_TEST_SUITE_P(Adiabatic, EveryReactor, ::testing::ValuesIn(kConserving), name);
INSTANTIATE_TEST_SUITE_P(Given, EveryReactor, ::testing::ValuesIn(kGivenTemperature), name);
INSTANTIATE_TEST_SUITE_P(Adiabatic, ConservingReactor, ::testing::ValuesIn(kConserving), name);

}  // namespace
