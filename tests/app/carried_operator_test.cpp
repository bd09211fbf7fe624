// What the coupling of particles and gas keeps in the cells of a flow, with every model: mass, elements, enthalpy, and
// every bit of a cell without soot.
#include "flow/models/carried_operator.hpp"

#include <cmath>
#include <cstring>
#include <map>
#include <memory>

#include "app/deck/soot_deck.hpp"
#include "core/constants.hpp"
#include "core/modules.hpp"
#include "coupling/carried_particles.hpp"
#include "flow/stepping/budget.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/models/two_equation/dimer_soot.hpp"
#include "tests/app/app_fixture.hpp"

namespace lampblack::app {
namespace {

using test::Flame;

// At the beginning of a step without transport.
CarriedOperator operatorOf(Flame& flame, MixingModel* mixing = nullptr) {
  CarriedOperator particles(flame.context, *flame.flowCase.carried, 0, flame.flowCase.carriedOptions);
  if (mixing != nullptr) particles.mixBy(*mixing);
  particles.endStep(flame.state);
  particles.endSweep(flame.state);
  return particles;
}

// What a cell holds per volume, particles included.
struct Contents {
  double mass = 0.0, enthalpy = 0.0;
  std::vector<double> elements;
};

// The particles being as warm as `temperature`.
Contents contentsOf(const Flame& flame, int cell, double temperature) {
  const Mechanism& mechanism = *flame.flowCase.mechanism;
  CarriedModel& model = *flame.flowCase.carried;
  const auto Y = flame.massFractions(cell);
  const auto c = static_cast<std::size_t>(cell);
  const std::size_t n = model.scalars().size();
  const double rho = flame.state.density[c];
  const std::span<const double> carried{&flame.state.carried[n * c], n};
  std::vector<double> h(n), slope(n);
  model.enthalpies(temperature, h, slope);
  Contents contents{rho, rho * flame.state.enthalpy[c], {}};
  for (std::size_t e = 0; e < mechanism.numElements(); ++e) {
    double mass = 0.0;
    for (std::size_t k = 0; k < mechanism.numSpecies(); ++k)
      mass += rho * Y[k] / mechanism.molecularWeights()[k] * mechanism.atoms(k, e) * mechanism.atomicWeight(e);
    for (std::size_t s = 0; s < n; ++s) {
      mass += carried[s] * model.scalars()[s].elements[e];
      contents.mass += carried[s] * model.scalars()[s].elements[e];
    }
    contents.elements.push_back(mass);
  }
  for (std::size_t s = 0; s < n; ++s) contents.enthalpy += carried[s] * h[s];
  return contents;
}

std::vector<std::string> modelNames() {
  std::vector<std::string> names;
  for (const SootModelEntry& model : sootModels()) names.push_back(model.name);
  return names;
}

class EveryModel : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] static std::vector<std::string> deckLines() { return {"particles.description=" + GetParam()}; }
};

TEST_P(EveryModel, KeepsMassElementsAndEnthalpy) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas, deckLines());
  double worst = 0.0;
  for (int step = 0; step < 5; ++step) {
    CarriedOperator particles = operatorOf(flame);
    const std::vector<double> temperature = flame.state.temperature;
    std::vector<Contents> before;
    for (int c = 0; c < flame.mesh.owned; ++c)
      before.push_back(contentsOf(flame, c, temperature[static_cast<std::size_t>(c)]));
    particles.advance(flame.state, step * 1e-4, 1e-4);
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
  EXPECT_LT(worst, 1e-12);  // of some 5 to 50 linear solves
  // Something has happened: there is soot, and it diffuses.
  const CarriedModel& model = *flame.flowCase.carried;
  const CarriedOperator particles = operatorOf(flame);
  for (int c = 0; c < flame.mesh.owned; ++c) {
    EXPECT_GT(model.volumeFraction(particles.densities(std::as_const(flame.state), c)), 1e-13);
    EXPECT_GT(flame.state.carriedDiffusivity[model.scalars().size() * static_cast<std::size_t>(c)], 0.0);
  }
}

// The same share of the reactions everywhere.
class EvenMixing final : public MixingModel {
 public:
  EvenMixing(const Mesh& mesh, double share) : cells_(static_cast<std::size_t>(mesh.owned), {share, 0.0}) {}
  [[nodiscard]] std::span<const CellMixing> present() const override { return cells_; }
  std::span<const CellMixing> of(const State&) override { return cells_; }

 private:
  std::vector<CellMixing> cells_;
};

// At a share of their rates particles do in a step what they do in as much less time, take as much less from the gas,
// and keep what they keep; rates and their slopes have the share, too.
TEST(MixedParticles, ChangeAtTheReactingShare) {
  const std::vector<std::string> deck{"particles.description=two_equation_dimer"};
  const double share = 0.3, dt = 1e-4;
  Flame slow(MPI_COMM_SELF, test::sootingGas, deck), brief(MPI_COMM_SELF, test::sootingGas, deck);
  for (Flame* flame : {&slow, &brief}) operatorOf(*flame).advance(flame->state, 0.0, dt);  // soot to begin with
  EvenMixing mixing(slow.mesh, share), none(slow.mesh, 0.0);
  CarriedOperator mixed = operatorOf(slow, &mixing), plain = operatorOf(brief);
  const State start = slow.state;
  const auto ratesOf = [&](CarriedOperator& particles) {
    State::Balance rates = start.balance;
    std::ranges::fill(rates.reactions, 0.0);
    rates.clear();
    particles.addRates(start, rates);
    rates.exchanged.insert(rates.exchanged.end(), rates.carried.begin(), rates.carried.end());
    rates.exchanged.insert(rates.exchanged.end(), rates.enthalpy.begin(), rates.enthalpy.end());
    return rates.exchanged;
  };
  const auto some = ratesOf(mixed), all = ratesOf(plain);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NEAR(some[i], share * all[i], 1e-12 * std::abs(all[i])) << i;
  const std::size_t width = static_cast<std::size_t>(start.species) + 1, scalars = start.scalars.size(),
                    cells = static_cast<std::size_t>(slow.mesh.owned);
  std::vector<double> gasSome(cells * width * width), gasAll(gasSome), some2(cells * scalars * scalars), all2(some2);
  mixed.addSlopes(start, {gasSome, some2});
  plain.addSlopes(start, {gasAll, all2});
  for (std::size_t i = 0; i < gasAll.size(); ++i)
    EXPECT_NEAR(gasSome[i], share * gasAll[i], 1e-12 * std::abs(gasAll[i]));
  for (std::size_t i = 0; i < all2.size(); ++i) EXPECT_NEAR(some2[i], share * all2[i], 1e-12 * std::abs(all2[i]));
  // All that the flow brings while they do is in either.
  const auto bring = [](State& state) {
    for (double& carried : state.carried) carried *= 1.2;
  };
  for (Flame* flame : {&slow, &brief}) bring(flame->state);
  const State brought = slow.state;
  std::vector<Contents> before;
  for (int c = 0; c < slow.mesh.owned; ++c)
    before.push_back(contentsOf(slow, c, start.temperature[static_cast<std::size_t>(c)]));
  mixed.advance(slow.state, 0.0, dt);
  plain.advance(brief.state, 0.0, share * dt);
  double worst = 0.0, changed = 0.0;
  for (std::size_t i = 0; i < start.carried.size(); ++i) {
    changed = std::max(changed, std::abs(slow.state.carried[i] / brought.carried[i] - 1.0));
    EXPECT_NEAR(slow.state.carried[i], brief.state.carried[i], 1e-9 * std::abs(brief.state.carried[i]));
  }
  EXPECT_GT(changed, 1e-3);
  for (std::size_t i = 0; i < start.Y.size(); ++i) EXPECT_NEAR(slow.state.Y[i], brief.state.Y[i], 1e-12);
  for (int c = 0; c < slow.mesh.owned; ++c) {
    const auto cell = static_cast<std::size_t>(c);
    const Contents after = contentsOf(slow, c, start.temperature[cell]);
    worst = std::max(worst, std::abs(after.mass / before[cell].mass - 1.0));
    for (std::size_t e = 0; e < after.elements.size(); ++e)
      if (after.elements[e] > 0.0)
        worst = std::max(worst, std::abs(after.elements[e] / before[cell].elements[e] - 1.0));
    worst = std::max(worst, std::abs(after.enthalpy - before[cell].enthalpy) / (after.mass * 1e6));
  }
  EXPECT_LT(worst, 1e-12);
  // Of nothing they stay as they are, with what the flow brings.
  CarriedOperator resting = operatorOf(slow, &none);
  bring(slow.state);
  const State still = slow.state;
  resting.advance(slow.state, 0.0, dt);
  for (std::size_t i = 0; i < still.carried.size(); ++i)
    EXPECT_NEAR(slow.state.carried[i], still.carried[i], 1e-14 * std::abs(still.carried[i]));
}

TEST_P(EveryModel, HasTheRatesByWhichAShortStepChangesTheCells) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas, deckLines());
  operatorOf(flame).advance(flame.state, 0.0, 1e-4);  // from there on there is soot
  CarriedOperator particles = operatorOf(flame);
  State::Balance rates = flame.state.balance;
  std::ranges::fill(rates.reactions, 0.0);
  rates.clear();
  particles.addRates(flame.state, rates);
  const State before = flame.state;
  const double dt = 1e-10;
  particles.advance(flame.state, 1e-4, dt);
  const std::size_t scalars = before.scalars.size(), n = static_cast<std::size_t>(before.species);
  std::vector<double> most(scalars + 2, 0.0), differs(most), gained(n);
  const auto compare = [&](std::size_t i, double rate, double change) {
    most[i] = std::max(most[i], std::abs(rate));
    differs[i] = std::max(differs[i], std::abs(change / dt - rate));
  };
  for (std::size_t c = 0; c < static_cast<std::size_t>(flame.mesh.owned); ++c) {
    for (std::size_t s = 0; s < scalars; ++s)
      compare(s, rates.carried[c * scalars + s],
              flame.state.carried[c * scalars + s] - before.carried[c * scalars + s]);
    rates.ofSpecies(c, gained);
    for (std::size_t k = 0; k < n; ++k)
      compare(scalars, gained[k],
              flame.state.density[c] * flame.state.Y[c * n + k] - before.density[c] * before.Y[c * n + k]);
    compare(scalars + 1, rates.enthalpy[c],
            flame.state.density[c] * flame.state.enthalpy[c] - before.density[c] * before.enthalpy[c]);
  }
  EXPECT_GT(most.back(), 0.0);
  for (std::size_t i = 0; i < most.size(); ++i) EXPECT_LE(differs[i], 2e-3 * most[i]) << i;  // sections may be empty
}

// Along a change of all scalars, in which each has another share.
TEST_P(EveryModel, TellsHowItsRatesDependOnWhatIsCarried) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas, deckLines());
  operatorOf(flame).advance(flame.state, 0.0, 1e-4);
  CarriedOperator particles = operatorOf(flame);
  ASSERT_TRUE(particles.actsOnCarried());
  const std::size_t n = flame.state.scalars.size(), width = static_cast<std::size_t>(flame.state.species) + 1,
                    owned = static_cast<std::size_t>(flame.mesh.owned);
  std::vector<double> alone(owned * n * n), beside(alone), ofGas(owned * width * width), gasAlone(ofGas);
  particles.addSlopes(flame.state, {{}, alone});
  particles.addSlopes(flame.state, {gasAlone, {}});
  particles.addSlopes(flame.state, {ofGas, beside});
  EXPECT_EQ(alone, beside);
  // In one cell by itself as in all.
  State::Balance made = flame.state.balance;
  made.clear();
  particles.addRates(flame.state, made);
  std::vector<double> rates(owned * n), slopes(owned * n * n);
  const std::unique_ptr<Operator::CarriedInCells> inCells = particles.carriedInCells(flame.state);
  for (std::size_t c = 0; c < owned; ++c)
    inCells->add(static_cast<int>(c), std::span(flame.state.carried).subspan(c * n, n),
                 std::span(rates).subspan(c * n, n), std::span(slopes).subspan(c * n * n, n * n));
  EXPECT_EQ(rates, std::vector<double>(made.carried.begin(), made.carried.begin() + static_cast<long>(owned * n)));
  EXPECT_EQ(slopes, alone);
  EXPECT_EQ(gasAlone, ofGas);
  const auto share = [n](std::size_t i) { return 1e-4 * std::cos(static_cast<double>(i % n)); };
  const auto ratesAt = [&](double sign) {
    State state = flame.state;
    for (std::size_t i = 0; i < owned * n; ++i) state.carried[i] *= 1.0 + sign * share(i);
    State::Balance rates = state.balance;
    rates.clear();
    particles.addRates(state, rates);
    return rates.carried;
  };
  const std::vector<double> less = ratesAt(-1.0), more = ratesAt(1.0);
  std::map<std::string, double> most;  // of a unit: sections may be empty
  std::vector<double> differs(n, 0.0);
  for (std::size_t i = 0; i < owned * n; ++i) {
    const std::size_t s = i % n, first = i - s;
    double slope = 0.0;
    for (std::size_t by = 0; by < n; ++by)
      slope += alone[(first + by) * n + s] * 2.0 * share(by) * flame.state.carried[first + by];
    double& ofUnit = most[flame.state.scalars[s].unit];
    ofUnit = std::max(ofUnit, std::abs(slope));
    differs[s] = std::max(differs[s], std::abs(more[i] - less[i] - slope));
  }
  for (std::size_t s = 0; s < n; ++s) EXPECT_LE(differs[s], 1e-3 * most.at(flame.state.scalars[s].unit)) << s;
}

TEST_P(EveryModel, LeavesEveryBitOfACellWithoutSoot) {
  const auto gas = [](const Vector3& x) {
    return x[1] < 4e-3 ? test::sootingGas(x) : test::Gas{300.0 + 1e4 * x[0], "C2H4: 0.3, N2: 0.5, O2: 0.2"};
  };
  Flame flame(MPI_COMM_WORLD, gas, deckLines());
  CarriedOperator particles = operatorOf(flame);
  const State before = flame.state;
  particles.advance(flame.state, 0.0, 1e-4);
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
    EXPECT_EQ(same(flame.state.carried, before.carried, c, before.carriedCount()), cold);
  }
}

// Shared between the ranks or not: the same bits, as a cell depends on what was sent of it alone.
TEST_P(EveryModel, DoesNotDependOnWhichRankAdvancesACell) {
  std::vector<State> states;
  for (const bool share : {true, false}) {
    Flame flame(MPI_COMM_WORLD, test::sootingGas, deckLines());
    flame.flowCase.carriedOptions.shareWork = share;
    CarriedOperator particles = operatorOf(flame);
    // More and more work on one rank.
    for (int step = 0; step < 3; ++step) {
      particles.advance(flame.state, 0.0, 5e-5);
      flame.state.balance.clear();
      particles.endStep(flame.state);
      particles.endSweep(flame.state);
    }
    states.push_back(flame.state);
  }
  EXPECT_EQ(states[0].carried, states[1].carried);
  EXPECT_EQ(states[0].Y, states[1].Y);
}

// What the particles did in a step is a source of the next one's transport, and taken back after it: mass and elements
// of both together change by what crosses the boundary.
TEST_P(EveryModel, KeepsTheBudgetsWithTransportWhichSeesItsRates) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas, deckLines());
  CarriedOperator particles(flame.context, *flame.flowCase.carried, 0, flame.flowCase.carriedOptions);
  TransportOperator transport(flame.context, flame.state);
  transport.initialise(flame.state, 1e-5);
  particles.endStep(flame.state);
  particles.endSweep(flame.state);
  std::vector<std::vector<double>> elements;
  for (const CarriedModel::Scalar& scalar : flame.flowCase.carried->scalars()) elements.push_back(scalar.elements);
  Budget budget(flame.context, massAndElements(*flame.flowCase.mechanism, elements), flame.state);
  transport.watchBoundary([&](const TransportOperator::BoundaryAmounts& amounts) { budget.addStep(amounts); });
  double source = 0.0;
  for (int step = 0; step < 10; ++step) {
    transport.advance(flame.state, step * 1e-5, 1e-5);
    particles.advance(flame.state, step * 1e-5, 1e-5);
    transport.endStep(flame.state);
    transport.endSweep(flame.state);
    particles.endStep(flame.state);
    particles.endSweep(flame.state);
    for (const double rate : flame.state.balance.carried) source = std::max(source, std::abs(rate));
  }
  EXPECT_GT(source, 0.0);
  // Jacobians by differences leave some 1e-9 of what is exchanged, itself 1e-5 of the gas here.
  for (const Budget::Line& line : budget.lines(flame.state)) EXPECT_LT(line.error, 1e-13) << line.name;
}

INSTANTIATE_TEST_SUITE_P(CarriedOperator, EveryModel, testing::ValuesIn(modelNames()),
                         [](const auto& given) { return given.param; });

// Mole fractions times p / RT, of the species that are asked for.
TEST(CarriedOperator, SeesTheGasOfItsCell) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas);
  const Mechanism& mechanism = *flame.flowCase.mechanism;
  std::vector<double> concentrations, X(mechanism.numSpecies());
  for (int c = 0; c < flame.mesh.owned; ++c) {
    const auto cell = static_cast<std::size_t>(c);
    const std::vector<std::size_t>& species = flame.flowCase.carried->exchanged();
    const ParticleGas gas = gasOfCell(flame.context, flame.state, c, 5e-5, species, concentrations);
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
TEST(CarriedOperator, DoesInEveryCellWhatTheModelDoes) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas);
  CarriedOperator particles = operatorOf(flame);
  CarriedModel& model = *flame.flowCase.carried;
  const State before = flame.state;
  const double dt = 1e-4;
  particles.advance(flame.state, 0.0, dt);
  const std::size_t n = flame.flowCase.mechanism->numSpecies();
  std::vector<double> exchanged, later, X(n), D(n), diffusivity(3);
  for (int c = 0; c < flame.mesh.owned; ++c) {
    const auto cell = static_cast<std::size_t>(c);
    const auto viscosity = [&](const State& state) {
      flame.thermo.massToMole({&state.Y[cell * n], n}, X);
      return flame.transport.mixture(state.temperature[cell], state.thermodynamicPressure, X, D).viscosity;
    };
    const ParticleGas gas = gasOfCell(flame.context, before, c, viscosity(before), model.exchanged(), exchanged);
    const auto start = particles.densities(before, c);
    std::vector<double> expected(start.begin(), start.end());
    model.advance(gas, dt, expected, exchanged, {});
    const auto found = particles.densities(std::as_const(flame.state), c);
    for (std::size_t s = 0; s < 3; ++s) EXPECT_NEAR(found[s] / expected[s], 1, 1e-12);
    // Diffusing with the size they have then, in a gas that is hardly another (its viscosity is that of the start).
    const ParticleGas end = gasOfCell(flame.context, flame.state, c, viscosity(before), model.exchanged(), later);
    model.diffusivities(end, found, diffusivity);
    for (std::size_t s = 0; s < 3; ++s)
      EXPECT_NEAR(flame.state.carriedDiffusivity[3 * cell + s] / diffusivity[s], 1, 1e-12);
  }
}

// What the budgets of a run count: nothing of number, carbon and hydrogen as mass and as themselves.
TEST(CarriedOperator, ItsAtomsStandInTheBudgets) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas);
  std::vector<std::vector<double>> elements;
  for (const CarriedModel::Scalar& scalar : flame.flowCase.carried->scalars()) elements.push_back(scalar.elements);
  for (const ConservedQuantity& q : massAndElements(*flame.flowCase.mechanism, elements)) {
    ASSERT_EQ(q.perCarried.size(), 3U) << q.name;
    EXPECT_EQ(q.perCarried[DimerSoot::number], 0.0) << q.name;
    EXPECT_EQ(q.perCarried[DimerSoot::carbon], q.name == "mass" || q.name == "C" ? 1.0 : 0.0) << q.name;
    EXPECT_EQ(q.perCarried[DimerSoot::hydrogen], q.name == "mass" || q.name == "H" ? 1.0 : 0.0) << q.name;
  }
}

// Towards the cold, all alike, under names of their own; little of them is as the model says.
TEST(CarriedOperator, ItsScalarsDriftByThermophoresis) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas);
  const std::vector<CarriedModel::Scalar>& own = flame.flowCase.carried->scalars();
  for (const CarriedScalar& scalar : flame.state.scalars) {
    EXPECT_EQ(scalar.negligible, ParticleModel::smallestShare * own[&scalar - flame.state.scalars.data()].scale);
    EXPECT_NEAR(scalar.thermophoresis, waldmannThermophoresis(), 1e-15) << scalar.name;
    EXPECT_EQ(scalar.name.rfind("soot_", 0), 0U) << scalar.name;
  }
}

// A row of the history has what its columns say; the peak is that of all ranks.
TEST(CarriedOperator, TellsItsPeakAndRefusesTooFewSections) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas,
              {"particles.description=sectional", "particles.sectional.sections=4", "particles.sectional.overflow=1"});
  CarriedOperator particles = operatorOf(flame);
  particles.advance(flame.state, 0.0, 3e-3);
  const std::vector<double> row = particles.historyValues(flame.state);
  ASSERT_EQ(row.size(), particles.historyColumns().size());
  double peak = 0;
  for (int c = 0; c < flame.mesh.owned; ++c)
    peak = std::max(peak, flame.flowCase.carried->volumeFraction(particles.densities(std::as_const(flame.state), c)));
  MPI_Allreduce(MPI_IN_PLACE, &peak, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  EXPECT_EQ(row[0], peak);
  EXPECT_GT(row[1], 0.1);  // most of it has outgrown four sections
  CarriedOperator strict(flame.context, *flame.flowCase.carried, 0, {true, 1e-4, "More sections help."});
  EXPECT_EQ(strict.historyValues(flame.state)[1], row[1]);  // a search may pass it on its way
  EXPECT_THROW(strict.checkResult(), NumericsError);
  EXPECT_NO_THROW(particles.checkResult());
}

}  // namespace
}  // namespace lampblack::app
