// What is mixed and cold is lit.
#include "flow/steady/lighting.hpp"

#include <gtest/gtest.h>

#include <array>

#include "flow/burnt_mixture.hpp"
#include "flow_fixture.hpp"
#include "scalar_toy.hpp"

namespace lampblack::test {
namespace {

// A row of five cells: hydrogen, as much as the oxygen of air burns, a twentieth of that, air, and burnt gas.
class Lighting : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  const std::vector<double> stoichiometric = gas.massFractions("H2: 2, O2: 1, N2: 3.76");
  const std::array<std::vector<double>, 5> mixtures{
      gas.massFractions("H2: 1"), stoichiometric, gas.massFractions("H2: 0.1, O2: 1, N2: 3.76"),
      gas.massFractions("O2: 1, N2: 3.76"), gas.massFractions("H2O: 2, N2: 3.76")};
  Box box{Geometry::Planar,
          {uniformAxis(1.0, 5), uniformAxis(1.0, 1)},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)}};
  State state = box.state([&](const auto& place) {
    const auto i = static_cast<std::size_t>(place[0] / 0.2);
    return Box::Local{{0.3, 0.0}, i == 4 ? 2300.0 : 300.0, mixtures.at(i)};
  });
};

TEST_F(Lighting, BurnsWhatBurnsAndNothingElse) {
  const State before = state;
  EXPECT_EQ(lightMixture(box.context, state), 1);
  const std::size_t n = stoichiometric.size(), water = gas.mechanism.speciesIndex("H2O");
  for (std::int64_t natural = 0; natural < 5; ++natural) {
    const int c = box.mesh.findOwned(natural);
    if (c < 0) continue;
    const std::span<const double> Y(&state.Y[at(c) * n], n), was(&before.Y[at(c) * n], n);
    if (natural != 1) {
      EXPECT_EQ(state.temperature[at(c)], before.temperature[at(c)]) << natural;
      EXPECT_TRUE(std::ranges::equal(Y, was)) << natural;
      continue;
    }
    EXPECT_DOUBLE_EQ(state.temperature[at(c)], 2200.0) << "the equilibrium is hotter";
    EXPECT_GT(Y[water], 0.2);
    EXPECT_NEAR(state.density[at(c)], gas.thermo.density(2200.0, state.thermodynamicPressure, Y), 1e-12);
    EXPECT_NEAR(state.enthalpy[at(c)], gas.thermo.enthalpyMass(2200.0, Y), 1e-6);
    for (std::size_t e = 0; e < gas.mechanism.numElements(); ++e) {
      double atoms = 0.0;  // mol per kg, more than before
      for (std::size_t k = 0; k < n; ++k)
        atoms += gas.mechanism.atoms(k, e) * (Y[k] - was[k]) / gas.mechanism.molecularWeights()[k];
      EXPECT_NEAR(atoms, 0.0, 1e-9) << gas.mechanism.elementName(e);
    }
  }
  EXPECT_EQ(state.velocity, before.velocity);
  EXPECT_EQ(lightMixture(box.context, state), 0) << "it burns already";
}

// What eddies have per kg of the gas stays as the gas becomes thinner.
TEST_F(Lighting, LeavesWhatIsCarriedPerMass) {
  ScalarToy toy;
  State carrying = box.stateWith({toy.block(box.context)}, [&](const auto& place) {
    return Box::Local{{0.3, 0.0}, 300.0, mixtures.at(static_cast<std::size_t>(place[0] / 0.2))};
  });
  for (std::size_t c = 0; c < carrying.density.size(); ++c) carrying.carried[c] = 7.0 * carrying.density[c];
  const State before = carrying;
  EXPECT_EQ(lightMixture(box.context, carrying), 1);
  for (int c = 0; c < box.mesh.owned; ++c) {
    EXPECT_NEAR(carrying.carried[at(c)], 7.0 * carrying.density[at(c)], 1e-12);
    if (box.mesh.naturalCell[at(c)] != 1) continue;
    EXPECT_LT(carrying.density[at(c)], 0.2 * before.density[at(c)]);
  }
}

TEST_F(Lighting, KnowsWhatCouldBurn) {
  const std::vector<double> air = gas.massFractions("O2: 1, N2: 3.76"), fuel = gas.massFractions("H2: 1");
  for (BoundaryCondition& boundary : box.context.boundaries) boundary.Y.clear();
  EXPECT_TRUE(couldBurn(box.context, state)) << "the mean of its cells";
  const auto fillWith = [&](const std::vector<double>& Y) {
    for (int c = 0; c < box.mesh.owned; ++c) std::ranges::copy(Y, &state.Y[at(c) * Y.size()]);
  };
  fillWith(air);
  EXPECT_FALSE(couldBurn(box.context, state));
  box.context.boundaries[0].Y = air;
  EXPECT_FALSE(couldBurn(box.context, state));
  box.context.boundaries[0].Y = gas.massFractions("H2: 0.05, N2: 1");
  EXPECT_FALSE(couldBurn(box.context, state)) << "too little of it";
  box.context.boundaries[0].Y = fuel;
  EXPECT_TRUE(couldBurn(box.context, state));
  fillWith(gas.massFractions("H2O: 1, N2: 2"));
  EXPECT_FALSE(couldBurn(box.context, state)) << "fuel alone";
  box.context.boundaries[1].Y = air;
  EXPECT_TRUE(couldBurn(box.context, state)) << "two boundaries";
}

TEST_F(Lighting, KeepsTheEnthalpyBelowTheLimit) {
  const std::vector<double> lean = gas.massFractions("H2: 1, O2: 1, N2: 3.76");
  for (int c = 0; c < box.mesh.owned; ++c) {
    std::ranges::copy(lean, &state.Y[at(c) * lean.size()]);
    state.Y[at(c) * lean.size() + gas.mechanism.speciesIndex("OH")] = -1e-8;  // what a step may leave
    state.temperature[at(c)] = 300.0;
    state.enthalpy[at(c)] = gas.thermo.enthalpyMass(300.0, lean);
  }
  EXPECT_EQ(lightMixture(box.context, state), 5);
  for (int c = 0; c < box.mesh.cells; ++c) {  // beside other ranks, too
    EXPECT_NEAR(state.temperature[at(c)], 1643.0, 60.0);
    EXPECT_NEAR(state.enthalpy[at(c)], gas.thermo.enthalpyMass(300.0, lean), 1.0);
  }
}

// In mol for each of methane: with all the oxygen it could need, with what burns half of the CO, and with half of what
// CO and H2O take.
TEST(BurntMixture, MakesWaterThenCarbonMonoxideThenDioxide) {
  const Mechanism mechanism = Mechanism::fromFile(sourcePath("cases/mechanisms/methane_drm19_21.yaml"));
  const Thermo thermo(mechanism);
  BurntMixture burnt(mechanism, thermo);
  struct Expected {
    double oxygen, fuel, water, monoxide, dioxide, left;
  };
  for (const Expected& e : {Expected{3.0, 0.0, 2.0, 0.0, 1.0, 1.0}, Expected{1.75, 0.0, 2.0, 0.5, 0.5, 0.0},
                            Expected{0.75, 0.5, 1.0, 0.5, 0.0, 0.0}}) {
    std::vector<double> Y(mechanism.numSpecies());
    const auto X = parseComposition(mechanism, fmt::format("CH4: 1, O2: {}, N2: 20", e.oxygen));
    thermo.moleToMass(X, Y);
    const double enthalpy = thermo.enthalpyMass(300.0, Y);
    const double perMethane =
        Y[mechanism.speciesIndex("CH4")] / mechanism.molecularWeights()[mechanism.speciesIndex("CH4")];
    const double T = burnt.burn(enthalpy, 101325.0, 3000.0, Y);
    const auto amount = [&](const char* name) {
      const std::size_t k = mechanism.speciesIndex(name);
      return Y[k] / mechanism.molecularWeights()[k] / perMethane;
    };
    EXPECT_NEAR(amount("CH4"), e.fuel, 1e-9);
    EXPECT_NEAR(amount("H2O"), 0.97 * e.water, 1e-9);
    EXPECT_NEAR(amount("H"), 0.03 * e.water, 1e-9);
    EXPECT_NEAR(amount("OH"), 0.03 * e.water, 1e-9);
    EXPECT_NEAR(amount("CO"), e.monoxide, 1e-9);
    EXPECT_NEAR(amount("CO2"), e.dioxide, 1e-9);
    EXPECT_NEAR(amount("O2"), e.left, 1e-9);
    EXPECT_NEAR(amount("N2"), 20.0, 1e-6);
    EXPECT_NEAR(thermo.enthalpyMass(T, Y), enthalpy, 1e-3);
    EXPECT_EQ(burnt.burn(enthalpy, 101325.0, 600.0, Y), 600.0) << "no hotter than that";
  }
}

}  // namespace
}  // namespace lampblack::test
