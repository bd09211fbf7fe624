#include "particles/models/soot_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/modules.hpp"
#include "particles/models/two_equation/two_equation.hpp"

namespace lampblack::particles {
namespace {

constexpr double carbonWeight = 12.011e-3;  // kg/mol

double carbonEnthalpy(double T) {
  return sootCarbonEnthalpy(T).first * carbonWeight;  // J/mol
}

TEST(SootEnthalpy, OfCarbonIsThatOfGraphiteInTheTables) {
  EXPECT_NEAR(carbonEnthalpy(298.15), 0.0, 1.0);
  // JANAF: 11.795 kJ/mol above 298.15 K, heat capacity 21.610 J/mol/K at 1000 K.
  EXPECT_NEAR(carbonEnthalpy(1000.0), 11795.0, 60.0);
  for (double T : {998.0, 1002.0}) EXPECT_NEAR(sootCarbonEnthalpy(T).second * carbonWeight, 21.61, 0.2);
  // The two polynomials meet.
  EXPECT_NEAR(carbonEnthalpy(std::nextafter(1000.0, 0.0)), carbonEnthalpy(1000.0), 1.0);
}

TEST(SootEnthalpy, OfHydrogenIsThatOfHydrogenMoleculesInTheTables) {
  constexpr double W = 2.016e-3;
  EXPECT_NEAR(sootHydrogenEnthalpy(298.15).first * W, 0.0, 1.0);
  // JANAF: 20.680 kJ/mol above 298.15 K, heat capacity 30.205 J/mol/K at 1000 K.
  EXPECT_NEAR(sootHydrogenEnthalpy(1000.0).first * W, 20680.0, 40.0);
  EXPECT_NEAR(sootHydrogenEnthalpy(1000.0).second * W, 30.205, 0.1);
}

TEST(SootEnthalpy, SlopesAreTheDerivatives) {
  for (double T : {400.0, 900.0, 1500.0, 2400.0}) {
    for (const auto enthalpy : {sootCarbonEnthalpy, sootHydrogenEnthalpy}) {
      // Central differences: third derivative of h times 0.5^2 / 6, below 1e-6 J/kg/K.
      const double slope = enthalpy(T + 0.5).first - enthalpy(T - 0.5).first;
      EXPECT_NEAR(enthalpy(T).second / slope, 1, 1e-6);
    }
  }
}

// A model that is a formula: what the default Jacobian has to get right from empty to 1e20.
class Formula final : public SootModel {
 public:
  void addSpheres(double, double, std::span<double>) const override {}
  const std::vector<std::string>& gasSpecies() const override { return species_; }
  std::vector<std::size_t> precursors() const override { return {0}; }
  const std::vector<ParticleScalar>& scalars() const override { return scalars_; }
  void sources(const ParticleGas& gas, std::span<const double> x, std::span<double> rates,
               std::span<double> exchange) const override {
    const double N = std::max(x[0], 0.0), c = std::max(gas.concentrations[0], 0.0);
    rates[0] = 3 * c * c - 2e-16 * N * N + 5 * N;
    exchange[0] = -std::exp(-1e4 / gas.temperature) * N * c;
  }
  void diffusivities(const ParticleGas&, std::span<const double>, std::span<double>) const override {}
  ParticleProperties properties(const ParticleGas& gas, std::span<const double> x) const override {
    ParticleProperties out;
    out.volumeFraction = gas.concentrations.size() == 1 ? 1e-24 * x[0] : 0;
    return out;
  }
  ParticleProcesses processes(const ParticleGas&, std::span<const double>) const override { return {}; }

 private:
  std::vector<std::string> species_{"C2H2"};
  std::vector<ParticleScalar> scalars_{{"number", "1/m3", "", 1e16}};
};

TEST(SootModelDefaults, DifferencesHoldFromZeroToDense) {
  const Formula model;
  for (double N : {-1.0, 0.0, 1.0, 1e8, 1e16, 1e20}) {
    for (double concentration : {-1e-9, 0.0, 1e-12, 1.0}) {
      const std::vector<double> c{concentration}, x{N};
      ParticleGas gas;
      gas.temperature = 1600;
      gas.pressure = 101325;
      gas.density = 0.2;
      gas.concentrations = c;
      std::vector<double> J(6);
      model.jacobian(gas, x, J);
      const double n = std::max(N, 0.0), a = std::max(concentration, 0.0), k = std::exp(-1e4 / 1600.0);
      // One-sided steps of 1e-6 of the value or of 1e-5 of a typical one (N: 2e15, c: 7.6): half the second derivative
      // times the step, and the rounding of the value over the step.
      const auto tolerance = [](double second, double value, double step) {
        return 0.5 * second * step + 4 * 2.3e-16 * value / step;
      };
      const double hN = 1e-6 * std::max(n, 2e10), hc = 1e-6 * std::max(a, 7.6e-5), hT = 1.6e-4;
      const double rate = std::abs(3 * a * a) + 2e-16 * n * n + 5 * n, taken = k * n * a;
      EXPECT_NEAR(J[0], 5 - 4e-16 * n, tolerance(4e-16, rate, hN) + 1e-12 * (5 + 4e-16 * n));
      EXPECT_NEAR(J[1], 6 * a, tolerance(6, rate, hc) + 1e-12);
      EXPECT_NEAR(J[3], -k * a, tolerance(0, taken, hN) + 1e-8 * k * a);
      EXPECT_NEAR(J[4], -k * n, tolerance(0, taken, hc) + 1e-8 * k * n);
      EXPECT_NEAR(J[5], -taken * 1e4 / (1600.0 * 1600.0), tolerance(taken * 1.6e-5, taken, hT));
    }
  }
}

TEST(SootModelDefaults, VolumeFractionIsThatOfTheProperties) {
  const std::vector<double> x{1e18};
  EXPECT_DOUBLE_EQ(Formula().volumeFraction(x), 1e-6);
  EXPECT_TRUE(Formula().sizeDistribution(x).diameter.empty());
}

TEST(SootModelDefaults, ThermophoresisIsThatOfSmallParticles) {
  EXPECT_NEAR(Formula().thermophoresis(), 0.5385, 5e-5);  // Wang (2025), eq. 7-29, full accommodation
}

}  // namespace
}  // namespace lampblack::particles
