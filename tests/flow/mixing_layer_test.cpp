// Starting fields of diffusion flames.
#include "flow/mixing_layer.hpp"

#include <gtest/gtest.h>

#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class Layer : public testing::Test {
 protected:
  static Gas& ethylene() {
    static Gas gas("ethylene_bisetti2012_47.yaml");
    return gas;
  }
  static Box box(Gas& gas) {
    const auto n2 = gas.massFractions("N2: 1");
    return {Geometry::Planar,
            {uniformAxis(0.002, 2), uniformAxis(0.01, 40)},
            {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
             opening(BoundaryKind::Inlet, 1, false, 0.1, 300.0, n2),
             opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, n2)},
            gas};
  }
  static MixingLayer layer(Gas& gas, const char* fuel) {
    MixingLayer l;
    l.axis = 1;
    l.position = 0.005;
    l.width = 0.002;
    l.low = {350.0, gas.massFractions(fuel)};
    l.high = {300.0, gas.massFractions("O2: 0.21, N2: 0.79")};
    return l;
  }
  static State fill(Box& b, const MixingLayer& l) {
    State state(b.mesh, b.gas.mechanism.numSpecies(), {});
    setMixingLayer(b.context, l, state);
    return state;
  }
  // Share of the low stream by the definition of the layer.
  static double share(const Box& b, const MixingLayer& l, int c) {
    return 0.5 * (1.0 - std::tanh(2.0 * (b.mesh.centre[at(c)][1] - l.position) / l.width));
  }
};

TEST_F(Layer, BurntLayerHasTheElementsAsMixedAndAtMostTheirEnthalpy) {
  Gas& gas = ethylene();
  Box b = box(gas);
  MixingLayer l = layer(gas, "C2H4: 0.35, N2: 0.65");
  l.temperature = 2000.0;
  const State state = fill(b, l);
  const auto n = gas.mechanism.numSpecies();
  int limited = 0;
  int adiabatic = 0;
  for (int c = 0; c < b.mesh.owned; ++c) {
    const double z = share(b, l, c);
    for (std::size_t e = 0; e < gas.mechanism.numElements(); ++e) {
      double found = 0.0;
      double mixed = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        const double atoms = gas.mechanism.atoms(k, e) / gas.mechanism.molecularWeights()[k];
        found += atoms * state.Y[at(c) * n + k];
        mixed += atoms * (z * l.low.Y[k] + (1.0 - z) * l.high.Y[k]);
      }
      EXPECT_NEAR(found, mixed, 100.0 * epsilon * mixed + 1e-300) << gas.mechanism.elementName(e);
    }
    const double h = z * gas.thermo.enthalpyMass(l.low.temperature, l.low.Y) +
                     (1.0 - z) * gas.thermo.enthalpyMass(l.high.temperature, l.high.Y);
    // Enthalpy of the mixture by its largest contribution, 4e6 J/kg, to round-off of the inversion.
    EXPECT_LE(state.enthalpy[at(c)], h + 100.0 * epsilon * 4e6);
    EXPECT_LE(state.temperature[at(c)], l.temperature * (1.0 + 4.0 * epsilon));
    limited += state.enthalpy[at(c)] < h - 1e3;
    adiabatic += std::abs(state.enthalpy[at(c)] - h) < 1.0;
    const std::span<const double> Y(&state.Y[at(c) * n], n);
    EXPECT_EQ(state.density[at(c)], gas.thermo.density(state.temperature[at(c)], state.thermodynamicPressure, Y));
  }
  EXPECT_GT(sumOverRanks(limited), 0.0);
  EXPECT_GT(sumOverRanks(adiabatic), 0.0);
}

TEST_F(Layer, UnburntLayerIsMixedAndHeatedOnlyInTheHotLayer) {
  Gas& gas = Gas::hydrogen();
  Box b = box(gas);
  MixingLayer l = layer(gas, "H2: 0.4, N2: 0.6");
  l.burnt = false;
  l.temperature = 1400.0;
  l.hotPosition = 0.006;
  l.hotWidth = 0.0005;
  const State state = fill(b, l);
  const auto n = gas.mechanism.numSpecies();
  for (int c = 0; c < b.mesh.owned; ++c) {
    const double z = share(b, l, c);
    for (std::size_t k = 0; k < n; ++k)
      EXPECT_NEAR(state.Y[at(c) * n + k], z * l.low.Y[k] + (1.0 - z) * l.high.Y[k], 4.0 * epsilon);
    const double away = std::abs(b.mesh.centre[at(c)][1] - l.hotPosition);
    // exp(-100) of the heating is left ten widths away; between 300 and 350 K is what mixes cold.
    if (away > 10.0 * l.hotWidth - 1e-9) {
      EXPECT_LT(state.temperature[at(c)], 350.0 + 1e-9);
    }
    if (away < 0.3 * l.hotWidth) {
      EXPECT_GT(state.temperature[at(c)], 300.0 + std::exp(-0.09) * 1100.0);
    }
  }
}

// Hydrogen needs neither CO nor CO2: where the streams meet there is as much water as oxygen allows.
TEST_F(Layer, BurntLayerWithoutCarbonIsInEquilibrium) {
  Gas& gas = Gas::hydrogen();
  Box b = box(gas);
  MixingLayer l = layer(gas, "H2: 0.4, N2: 0.6");
  l.temperature = 1500.0;
  const State state = fill(b, l);
  const auto n = gas.mechanism.numSpecies();
  const auto water = gas.mechanism.speciesIndex("H2O"), oxygen = gas.mechanism.speciesIndex("O2"),
             fuel = gas.mechanism.speciesIndex("H2");
  int hot = 0;
  for (int c = 0; c < b.mesh.owned; ++c) {
    const double* Y = &state.Y[at(c) * n];
    const double z = share(b, l, c);
    const double fuelMoles = z * l.low.Y[fuel] / gas.mechanism.molecularWeights()[fuel];
    const double oxygenMoles = (1.0 - z) * l.high.Y[oxygen] / gas.mechanism.molecularWeights()[oxygen];
    const double most = std::min(fuelMoles, 2.0 * oxygenMoles) * gas.mechanism.molecularWeights()[water];
    // At 1500 K and 1 atm less than 0.1 % of the water of a stoichiometric mixture dissociates.
    EXPECT_LE(Y[water], most * (1.0 + 1e-12));
    EXPECT_GE(Y[water], 0.999 * most);
    EXPECT_LE(state.temperature[at(c)], l.temperature * (1.0 + 4.0 * epsilon));
    hot += state.temperature[at(c)] == l.temperature;
  }
  EXPECT_GT(sumOverRanks(hot), 0.0);
}

}  // namespace
}  // namespace lampblack::test
