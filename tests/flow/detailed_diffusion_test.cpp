// Species diffusion by the detailed models: multicomponent, Soret effect, Lewis numbers.
#include <gtest/gtest.h>

#include <cmath>

#include "chemistry/transport/multicomponent_transport.hpp"
#include "core/constants.hpp"
#include "flow/equations/species_diffusion.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class DetailedFluxes : public testing::Test {
 protected:
  DetailedFluxes() { box.context.boundaries[0].fixedComposition = true; }

  Gas& gas = Gas::hydrogen();
  std::size_t n = gas.mechanism.numSpecies();
  std::vector<double> fuel = gas.massFractions("H2: 1, H2O: 0.2, H: 0.01, N2: 0.3");
  std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79, OH: 0.02");
  Box box{Geometry::Planar,
          {gradedAxis(0.0, {{4e-3, 6, 2.0}}), uniformAxis(3e-3, 4)},
          {opening(BoundaryKind::Inlet, 0, false, 0.1, 350.0, fuel), side(BoundaryKind::Wall, 0, true),
           side(BoundaryKind::Symmetry, 1, false), opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)}};
  State state = box.state([&](const Vector3& x) {
    const double share = 0.5 + 0.45 * std::sin(700.0 * x[0]) * std::cos(300.0 * x[1]);
    Box::Local local{{0.0, 0.0}, 500.0 + 1.5e5 * x[0] + 2e5 * x[1], {}};
    for (std::size_t k = 0; k < n; ++k) local.Y.push_back(share * fuel[k] + (1.0 - share) * air[k]);
    return local;
  });

  std::vector<double> fluxes(const SpeciesDiffusion& diffusion) const {
    std::vector<double> flux(at(box.mesh.faces) * n);
    for (int face = 0; face < box.mesh.faces; ++face) diffusion.flux(face, state.Y, {&flux[at(face) * n], n});
    return flux;
  }
  std::vector<double> fluxes(const FlowContext& context) const {
    GasProperties properties;
    properties.update(context, state);
    ImplicitDiffusion solver(box.mesh, context.halo);
    SpeciesDiffusion diffusion(context, solver);
    diffusion.prepare(state, properties);
    return fluxes(diffusion);
  }
  std::vector<double> fluxes(TransportModel model) {
    box.context.transportModel = std::move(model);
    return fluxes(box.context);
  }
  std::vector<double> moleFractions(std::span<const double> Y) const {
    std::vector<double> X(n);
    gas.thermo.massToMole(Y, X);
    return X;
  }
  struct Gases {
    std::vector<double> low, high;
    double lowTemperature, highTemperature, weight;
  };
  // What lies on both sides of a face; false where nothing diffuses.
  bool sidesOf(int face, Gases& sides) const {
    const Mesh& m = box.mesh;
    const auto of = [&](int cell) { return std::vector(&state.Y[at(cell) * n], &state.Y[at(cell + 1) * n]); };
    sides.low = of(m.low[at(face)]);
    sides.lowTemperature = state.temperature[at(m.low[at(face)])];
    if (m.high[at(face)] >= 0) {
      sides.high = of(m.high[at(face)]);
      sides.highTemperature = state.temperature[at(m.high[at(face)])];
      sides.weight = m.lowWeight[at(face)];
      return true;
    }
    sides.high = fuel;
    sides.highTemperature = 350.0;
    sides.weight = 0.0;
    return box.context.boundaryOf(face).kind == BoundaryKind::Inlet;  // of given composition
  }
};

TEST_F(DetailedFluxes, AreThoseOfTheStefanMaxwellEquationsAtTheFace) {
  const auto found = fluxes({.diffusion = TransportModel::Diffusion::Multicomponent, .lewisNumbers = {}});
  const auto averaged = fluxes(TransportModel{});
  MulticomponentTransport transport(gas.mechanism);
  std::vector<double> X(n), gradient(n), expected(n);
  Gases sides;
  double away = 0.0, scale = 0.0;
  for (int face = 0; face < box.mesh.faces; ++face) {
    const double* flux = &found[at(face) * n];
    if (!sidesOf(face, sides)) {
      for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(flux[k], 0.0);
      continue;
    }
    const auto low = moleFractions(sides.low), high = moleFractions(sides.high);
    for (std::size_t k = 0; k < n; ++k) {
      X[k] = sides.weight * low[k] + (1.0 - sides.weight) * high[k];
      gradient[k] = (high[k] - low[k]) / box.mesh.distance[at(face)];
    }
    const double T = sides.weight * sides.lowTemperature + (1.0 - sides.weight) * sides.highTemperature;
    transport.diffusionFluxes(T, state.thermodynamicPressure, X, gradient, expected);
    double largest = 0.0;
    for (double& j : expected) largest = std::max(largest, std::abs(j *= box.mesh.area[at(face)]));
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_NEAR(flux[k], expected[k], 1e-12 * largest) << face << " " << gas.mechanism.speciesName(k);
      away = std::max(away, std::abs(flux[k] - averaged[at(face) * n + k]));
    }
    scale = std::max(scale, largest);
  }
  EXPECT_GT(maxOverRanks(away), 0.02 * scale);  // it makes a difference
}

TEST_F(DetailedFluxes, SoretAddsWhatThermalDiffusionCarries) {
  using Diffusion = TransportModel::Diffusion;
  MulticomponentTransport multicomponent(gas.mechanism);
  const auto coefficients = [&](Diffusion diffusion, double T, std::span<const double> Y) {
    std::vector<double> DT(n);
    if (diffusion == Diffusion::Multicomponent)
      multicomponent.mixture(T, state.thermodynamicPressure, moleFractions(Y), DT);
    else
      gas.transport.thermalDiffusion(T, state.thermodynamicPressure, moleFractions(Y), DT);
    return DT;
  };
  for (const auto diffusion : {Diffusion::MixtureAveraged, Diffusion::Multicomponent}) {
    const auto without = fluxes({.diffusion = diffusion, .lewisNumbers = {}});
    const auto with = fluxes({.diffusion = diffusion, .soret = true, .lewisNumbers = {}});
    Gases sides;
    for (int face = 0; face < box.mesh.faces; ++face) {
      if (!sidesOf(face, sides)) continue;
      const auto low = coefficients(diffusion, sides.lowTemperature, sides.low);
      const auto high = box.mesh.high[at(face)] >= 0 ? coefficients(diffusion, sides.highTemperature, sides.high) : low;
      const double warming = std::log(sides.highTemperature / sides.lowTemperature) / box.mesh.distance[at(face)] *
                             box.mesh.area[at(face)];
      double largest = 0.0;
      for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, std::abs(without[at(face) * n + k]));
      for (std::size_t k = 0; k < n; ++k)
        EXPECT_NEAR(with[at(face) * n + k] - without[at(face) * n + k],
                    -warming * (sides.weight * low[k] + (1.0 - sides.weight) * high[k]), 1e-11 * largest);
    }
  }
}

// A step so short that nothing happens has the fluxes of the state, which the implicit solution knows nothing of.
TEST_F(DetailedFluxes, AreThereInAStep) {
  box.context.transportModel = {
      .diffusion = TransportModel::Diffusion::Multicomponent, .soret = true, .lewisNumbers = {}};
  GasProperties properties;
  properties.update(box.context, state);
  ImplicitDiffusion solver(box.mesh, box.halo);
  SpeciesDiffusion diffusion(box.context, solver);
  diffusion.prepare(state, properties);
  const Mesh& m = box.mesh;
  std::vector<double> content(at(m.owned) * n), mass(at(m.owned));
  for (std::size_t c = 0; c < mass.size(); ++c) {
    mass[c] = m.volume[c] * state.density[c];
    for (std::size_t k = 0; k < n; ++k) content[c * n + k] = mass[c] * state.Y[c * n + k];
  }
  const std::vector<double> present = fluxes(diffusion);
  std::vector<double> ofStep(present.size(), 0.0);
  std::vector<double> solution(state.Y.size());
  diffusion.advance({state.Y, solution, mass, content}, 1e-13, [&](int face, std::span<const double> row) {
    std::copy(row.begin(), row.end(), ofStep.begin() + static_cast<std::ptrdiff_t>(at(face) * n));
  });
  double largest = 0.0;
  for (const double j : present) largest = std::max(largest, std::abs(j));
  for (std::size_t i = 0; i < present.size(); ++i) EXPECT_NEAR(ofStep[i], present[i], 1e-7 * largest);
}

// Along gradients of mass fractions, whatever the mixture's weight does.
TEST_F(DetailedFluxes, OfLewisNumbersGoAlongMassFractions) {
  TransportModel model{.diffusion = TransportModel::Diffusion::ConstantLewis,
                       .lewisNumbers = std::vector<double>(n, 1.0)};
  model.lewisNumbers[gas.mechanism.speciesIndex("H2")] = 0.3;
  Transport transport(gas.mechanism, model.averaged());
  FlowContext context{box.mesh, box.halo, gas.mechanism, gas.thermo, transport, box.context.boundaries};
  context.transportModel = model;
  GasProperties properties;
  properties.update(context, state);
  const auto found = fluxes(context);
  Gases sides;
  std::vector<double> expected(n);
  for (int face = 0; face < box.mesh.interiorFaces; ++face) {
    sidesOf(face, sides);
    double net = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const double D = sides.weight * properties.massDiffusivity[at(box.mesh.low[at(face)]) * n + k] +
                       (1.0 - sides.weight) * properties.massDiffusivity[at(box.mesh.high[at(face)]) * n + k];
      net += expected[k] = -D * (sides.high[k] - sides.low[k]) / box.mesh.distance[at(face)] * box.mesh.area[at(face)];
    }
    for (std::size_t k = 0; k < n; ++k) {
      expected[k] -= (sides.weight * sides.low[k] + (1.0 - sides.weight) * sides.high[k]) * net;
      largest = std::max(largest, std::abs(expected[k]));
    }
    for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(found[at(face) * n + k], expected[k], 1e-13 * largest);
  }
}

}  // namespace
}  // namespace lampblack::test
