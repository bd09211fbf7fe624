// What is looked at in a flame, against flows whose numbers are known: mass flux between faces, stagnation plane,
// strain rates, thickness, heat release.
#include "flow/flame/flame_fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "tests/flow/flame/flame_fixture.hpp"

namespace lampblack::flow {
namespace {

// Cold nitrogen with rho u = m0 (1 - 2 z/L) on an uneven grid: a stagnation flow at constant density.
FlameProfile stagnationFlow(const Mechanism& mechanism, double length, double m0) {
  FlameProfile flow{{mechanism.numSpecies(), 0}, {}, {}};
  for (const double part : {0.0, 0.1, 0.15, 0.4, 0.6, 0.75, 1.0}) flow.z.push_back(part * length);
  flow.x.assign(flow.size(), 0.0);
  for (std::size_t i = 0; i < flow.points(); ++i) {
    const double face = i + 1 < flow.points() ? 0.5 * (flow.z[i] + flow.z[i + 1]) : length;
    flow.at(i, FlameLayout::massFlux) = m0 * (1 - 2 * face / length);
    flow.at(i, FlameLayout::temperature) = 300;
    flow.at(i, FlameLayout::firstSpecies + mechanism.speciesIndex("N2")) = 1;
  }
  flow.global(leftMassFlux) = m0;
  flow.global(load) = 1;
  return flow;
}

TEST(FlameFields, AStagnationFlowHasItsStrainRates) {
  const auto mechanism = hydrogenMechanism();
  const double length = 0.02, m0 = 0.5, lambda = -800;
  FlameProblem problem = hydrogenProblem(FlameType::Counterflow);
  FlameProfile flow = stagnationFlow(*mechanism, length, m0);
  flow.global(pressureGradient) = lambda;
  const FlameFields f = flameFields(*mechanism, problem, flow);
  const std::vector<double> Y(flow.massFractions(0).begin(), flow.massFractions(0).end());
  const double rho = Thermo(*mechanism).density(300, problem.pressure, Y);
  // A linear mass flux is met exactly between faces, however the points lie.
  for (std::size_t i = 0; i < f.z.size(); ++i) {
    EXPECT_NEAR(f.massFlux[i], m0 * (1 - 2 * f.z[i] / length), 1e-14) << i;
    EXPECT_DOUBLE_EQ(f.velocity[i], f.massFlux[i] / rho);
    EXPECT_EQ(f.heatRelease[i], 0) << "nitrogen does not react";
  }
  const FlameSummary s = flameSummary(problem, flow, f);
  const double u = m0 / rho;
  ASSERT_TRUE(s.stagnationPlane && s.strain && s.strain->global);
  EXPECT_NEAR(*s.stagnationPlane, 0.5 * length, 1e-12);
  EXPECT_NEAR(s.strain->mean, 2 * u / length, 1e-9);
  EXPECT_NEAR(s.strain->maximum, 2 * u / length, 1e-9);
  // Equal velocities and densities: 2 u/L (1 + 1).
  EXPECT_NEAR(*s.strain->global, 4 * u / length, 1e-9);
  EXPECT_NEAR(s.strain->right, std::sqrt(-lambda / rho), 1e-9);
  EXPECT_EQ(s.thermalThickness, 0);
}

// The left stream twice as hot: half as dense and twice as fast. Each side's strain rate has its own density, and that
// of the whole, 2/L (u_r + u_l (rho_l/rho_r)^1/2), both.
TEST(FlameFields, UnlikeStreamsHaveStrainRatesOfTheirOwn) {
  const auto mechanism = hydrogenMechanism();
  const double length = 0.02, m0 = 0.5, lambda = -800;
  FlameProblem problem = hydrogenProblem(FlameType::Counterflow);
  FlameProfile flow = stagnationFlow(*mechanism, length, m0);
  flow.global(pressureGradient) = lambda;
  for (std::size_t i = 0; i < 3; ++i) flow.at(i, FlameLayout::temperature) = 600;
  const FlameSummary s = flameSummary(problem, flow, flameFields(*mechanism, problem, flow));
  const std::vector<double> Y(flow.massFractions(0).begin(), flow.massFractions(0).end());
  const double rho = Thermo(*mechanism).density(300, problem.pressure, Y);
  ASSERT_TRUE(s.strain && s.strain->global);
  EXPECT_NEAR(s.strain->left, std::sqrt(-2 * lambda / rho), 1e-9);
  EXPECT_NEAR(s.strain->right, std::sqrt(-lambda / rho), 1e-9);
  EXPECT_NEAR(*s.strain->global, 2 / length * (m0 / rho + 2 * m0 / rho * std::sqrt(0.5)), 1e-9);
}

TEST(FlameFields, ARampOfTemperatureHasItsThickness) {
  const auto mechanism = hydrogenMechanism();
  const FlameProblem problem = hydrogenProblem(FlameType::Free);
  FlameProfile flame = stagnationFlow(*mechanism, 0.02, 0.5);
  // 300 K up to 0.4 L, 1500 K from 0.6 L on: 0.2 L = 4 mm thick.
  for (std::size_t i = 4; i < flame.points(); ++i) flame.at(i, FlameLayout::temperature) = 1500;
  const FlameSummary s = flameSummary(problem, flame, flameFields(*mechanism, problem, flame));
  EXPECT_NEAR(s.thermalThickness, 4e-3, 1e-15);
  EXPECT_EQ(s.maximumTemperature, 1500);
  EXPECT_FALSE(s.strain);
}

// The heat that reactions set free is the enthalpy they take from the species: -sum h_k W_k wdot_k. Near room
// temperature no reaction runs; in hot stoichiometric gas with radicals heat comes out, in dissociating products it
// goes in.
TEST(FlameFields, HeatReleaseHasItsSign) {
  const auto mechanism = hydrogenMechanism();
  const FlameProblem problem = hydrogenProblem(FlameType::Free);
  const auto releaseOf = [&](const std::string& composition, double T) {
    FlameProfile flame = stagnationFlow(*mechanism, 0.02, 0.5);
    const FlameStream stream = hydrogenStream(composition, T, 1.0);
    for (std::size_t i = 0; i < flame.points(); ++i) {
      flame.at(i, FlameLayout::temperature) = T;
      for (std::size_t k = 0; k < stream.Y.size(); ++k) flame.at(i, FlameLayout::firstSpecies + k) = stream.Y[k];
    }
    return flameFields(*mechanism, problem, flame).heatRelease[2];
  };
  EXPECT_GT(releaseOf("H: 0.02, OH: 0.02, H2O: 0.3, N2: 0.66", 1500), 0);  // radicals recombine
  EXPECT_LT(releaseOf("H2O: 1, N2: 1", 3000), 0);                          // water falls apart
}

}  // namespace
}  // namespace lampblack::flow
