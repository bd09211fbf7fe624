// What the coupling of soot and gas keeps: mass, elements, enthalpy, and every bit of a cell without soot.
#include <cstring>
#include <sstream>

#include "core/constants.hpp"
#include "flow/budget.hpp"
#include "particles/soot/soot_model.hpp"
#include "tests/app/app_fixture.hpp"

namespace lampblack {
namespace {

using test::Flame;

// What a cell holds per volume, soot included.
struct Contents {
  double mass = 0.0, enthalpy = 0.0;
  std::vector<double> elements;
};

// The enthalpy of soot is that of graphite and H2 at the temperature `sootTemperature`.
Contents contentsOf(const Flame& flame, int cell, double sootTemperature) {
  const Mechanism& mechanism = *flame.flowCase.mechanism;
  const auto Y = flame.massFractions(cell);
  const auto c = static_cast<std::size_t>(cell);
  const double rho = flame.state.density[c];
  const double* soot = &flame.state.carried[3 * c];
  const double carbon = soot[SootOperator::carbon];
  const double hydrogen = soot[SootOperator::hydrogen];
  std::vector<double> h(mechanism.numSpecies());
  flame.thermo.speciesEnthalpies(sootTemperature, h);
  Contents contents;
  contents.mass = rho + carbon + hydrogen;
  contents.enthalpy = rho * flame.state.enthalpy[c] + carbon * sootCarbonEnthalpy(sootTemperature).first +
                      hydrogen * h[mechanism.speciesIndex("H2")];
  const auto scalarElements = SootOperator::elementMass(mechanism);
  for (std::size_t e = 0; e < mechanism.numElements(); ++e) {
    double mass = 0.0;
    for (std::size_t k = 0; k < mechanism.numSpecies(); ++k)
      mass += rho * Y[k] / mechanism.molecularWeights()[k] * mechanism.atoms(k, e) * mechanism.atomicWeight(e);
    for (std::size_t s = 0; s < 3; ++s) mass += soot[s] * scalarElements[s][e];
    contents.elements.push_back(mass);
  }
  return contents;
}

TEST(SootOperator, KeepsMassElementsAndEnthalpy) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas);
  SootOperator soot(flame.context, *flame.flowCase.soot);
  double worst = 0.0;
  for (int step = 0; step < 20; ++step) {
    const std::vector<double> temperature = flame.state.temperature;
    std::vector<Contents> before;
    for (int c = 0; c < flame.mesh.owned; ++c)
      before.push_back(contentsOf(flame, c, temperature[static_cast<std::size_t>(c)]));
    soot.advance(flame.state, step * 1e-4, 1e-4);
    for (int c = 0; c < flame.mesh.owned; ++c) {
      const auto cell = static_cast<std::size_t>(c);
      const Contents after = contentsOf(flame, c, temperature[cell]);
      const Contents& start = before[cell];
      worst = std::max(worst, std::abs(after.mass / start.mass - 1.0));
      for (std::size_t e = 0; e < start.elements.size(); ++e)
        if (start.elements[e] > 0.0) worst = std::max(worst, std::abs(after.elements[e] / start.elements[e] - 1.0));
      // Against the gas's sensible enthalpy, as that of formation may cancel it.
      worst = std::max(worst, std::abs(after.enthalpy - start.enthalpy) / (start.mass * 1e6));
      EXPECT_NEAR(flame.thermo.enthalpyMass(flame.state.temperature[cell], flame.massFractions(c)),
                  flame.state.enthalpy[cell], 1e-3);
    }
  }
  std::ostringstream number;
  number << worst;
  RecordProperty("worst_relative_change", number.str());
  EXPECT_LT(worst, 1e-13);
  // Something has happened: soot of the order of a ppm, made of carbon and hydrogen of the gas.
  for (int c = 0; c < flame.mesh.owned; ++c) {
    const auto population = soot.populationOf(flame.state, c);
    EXPECT_GT(soot.model().volumeFraction(population), 1e-9);
    EXPECT_GT(population.number, 1e12);
    EXPECT_GT(population.hydrogen, 0.0);
    EXPECT_GT(flame.state.carriedDiffusivity[3 * static_cast<std::size_t>(c)], 0.0);
  }
}

TEST(SootOperator, LeavesEveryBitOfACellWithoutSoot) {
  const auto gas = [](const std::array<double, 2>& x) {
    return x[1] < 4e-3 ? test::sootingGas(x) : test::Gas{300.0 + 1e4 * x[0], "C2H4: 0.3, N2: 0.5, O2: 0.2"};
  };
  Flame flame(MPI_COMM_WORLD, gas);
  SootOperator soot(flame.context, *flame.flowCase.soot);
  const State before = flame.state;
  soot.advance(flame.state, 0.0, 1e-4);
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b, int cell, int components) {
    const std::size_t start = static_cast<std::size_t>(cell) * static_cast<std::size_t>(components);
    return std::memcmp(&a[start], &b[start], sizeof(double) * static_cast<std::size_t>(components)) == 0;
  };
  for (int c = 0; c < flame.mesh.owned; ++c) {
    const bool cold = flame.mesh.centre[static_cast<std::size_t>(c)][1] > 4e-3;
    EXPECT_EQ(same(flame.state.Y, before.Y, c, before.species), cold);
    EXPECT_EQ(same(flame.state.density, before.density, c, 1), cold);
    EXPECT_EQ(same(flame.state.enthalpy, before.enthalpy, c, 1), cold);
    EXPECT_EQ(same(flame.state.temperature, before.temperature, c, 1), cold);
    EXPECT_EQ(same(flame.state.carried, before.carried, c, 3), cold);
  }
}

// Mole fractions times p / RT, of the species that the model asks for.
TEST(SootOperator, SeesTheGasOfItsCell) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas);
  const SootOperator soot(flame.context, *flame.flowCase.soot);
  const Mechanism& mechanism = *flame.flowCase.mechanism;
  std::vector<double> concentrations, X(mechanism.numSpecies());
  for (int c = 0; c < flame.mesh.owned; ++c) {
    const auto cell = static_cast<std::size_t>(c);
    const ParticleGas gas = soot.gasOf(flame.state, c, 5e-5, concentrations);
    const double p = flame.flowCase.pressure, T = flame.state.temperature[cell];
    flame.thermo.massToMole(flame.massFractions(c), X);
    const auto concentration = [&](const char* name) {
      return X[mechanism.speciesIndex(name)] * p / (constants::gasConstant * T);
    };
    const std::vector<const char*> names{"H", "H2", "OH", "H2O", "O2", "C2H2", "CO", "A2"};
    ASSERT_EQ(gas.concentrations.size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
      EXPECT_NEAR(gas.concentrations[i] / concentration(names[i]), 1, 1e-13) << names[i];
    EXPECT_EQ(gas.temperature, T);
    EXPECT_EQ(gas.pressure, p);
    EXPECT_EQ(gas.viscosity, 5e-5);
    // kg/mol, by the ideal gas law.
    EXPECT_NEAR(gas.meanMolecularWeight / (gas.density * constants::gasConstant * T / p), 1, 1e-13);
  }
}

// Per volume, over all of the step: what a cell makes is what the model makes of its gas.
TEST(SootOperator, DoesInEveryCellWhatTheModelDoes) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas);
  SootOperator soot(flame.context, *flame.flowCase.soot);
  const State before = flame.state;
  const double dt = 1e-4;
  soot.advance(flame.state, 0.0, dt);
  const std::size_t n = flame.flowCase.mechanism->numSpecies();
  std::vector<double> exchanged, later, X(n), D(n);
  for (int c = 0; c < flame.mesh.owned; ++c) {
    const auto cell = static_cast<std::size_t>(c);
    const auto viscosity = [&](const State& state) {
      flame.thermo.massToMole({&state.Y[cell * n], n}, X);
      return flame.transport.mixture(state.temperature[cell], state.thermodynamicPressure, X, D).viscosity;
    };
    const ParticleGas gas = soot.gasOf(before, c, viscosity(before), exchanged);
    TwoEquationSoot::Population expected = soot.populationOf(before, c);
    soot.model().advance(gas, dt, expected, exchanged);
    const TwoEquationSoot::Population found = soot.populationOf(flame.state, c);
    EXPECT_NEAR(found.number / expected.number, 1, 1e-12);
    EXPECT_NEAR(found.carbon / expected.carbon, 1, 1e-12);
    EXPECT_NEAR(found.hydrogen / expected.hydrogen, 1, 1e-12);
    // Diffusing with the size they have then, in a gas that is hardly another (its viscosity is that of the start).
    const ParticleGas end = soot.gasOf(flame.state, c, viscosity(before), later);
    for (std::size_t s = 0; s < 3; ++s)
      EXPECT_NEAR(flame.state.carriedDiffusivity[3 * cell + s] / soot.model().diffusivity(end, found), 1, 1e-12);
  }
}

// What the budgets of a run count of soot: nothing of number, carbon and hydrogen as mass and as themselves.
TEST(SootOperator, ItsAtomsStandInTheBudgets) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas);
  const Mechanism& mechanism = *flame.flowCase.mechanism;
  for (const ConservedQuantity& q : massAndElements(mechanism, SootOperator::elementMass(mechanism))) {
    ASSERT_EQ(q.perCarried.size(), 3U) << q.name;
    EXPECT_EQ(q.perCarried[SootOperator::number], 0.0) << q.name;
    EXPECT_EQ(q.perCarried[SootOperator::carbon], q.name == "mass" || q.name == "C" ? 1.0 : 0.0) << q.name;
    EXPECT_EQ(q.perCarried[SootOperator::hydrogen], q.name == "mass" || q.name == "H" ? 1.0 : 0.0) << q.name;
  }
}

// Towards the cold, all three alike (thesis eq. 7-29).
TEST(SootOperator, DriftsByThermophoresis) {
  for (const CarriedScalar& scalar : SootOperator::carriedScalars())
    EXPECT_NEAR(scalar.thermophoresis, 0.75 / (1 + constants::pi / 8), 1e-15) << scalar.name;
}

}  // namespace
}  // namespace lampblack
