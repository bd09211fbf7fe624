// Ensembles in the cells of a flow: what they take the gas loses, ranks and work sharing do not show, and a restart
// goes on to the same bits.
#include "coupling/ensemble_operator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/state_backup.hpp"
#include "particles/models/soot_model.hpp"
#include "tests/coupling/closed_box.hpp"
#include "tests/coupling/soot_in_cells.hpp"
#include "tests/effort.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flow_fixture.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::test {
namespace {

// A closed vessel of sooting gas, hotter and richer in PAH on one side.
struct Vessel : CellVessel {
  explicit Vessel(const SootOptions& o, MPI_Comm comm = MPI_COMM_WORLD,
                  const std::vector<ScalarBlock>& carriedBefore = {}, double rise = 200.0)
      : CellVessel(
            ethylene(),
            [rise](const Vector3& x) {
              const double part = x[0] / 0.004;
              return Box::Local{
                  {},
                  1500.0 + rise * part,
                  ethylene().massFractions(fmt::format("N2: 0.8, C2H2: 0.08, H2: 0.06, H: 5e-4, OH: 1e-5, "
                                                       "H2O: 0.04, CO: 0.02, A2: {:.17g}",
                                                       2e-4 * part))};
            },
            sootOf(o), o, comm, carriedBefore) {}
};

// The amounts of the particles stand where their block stands.
TEST(EnsembleOperator, DoesNotTouchWhatElseIsCarried) {
  const SootOptions o = sootOptions(Exchange::TwoWay);
  Vessel alone(o), beside(o, MPI_COMM_WORLD, {{"other", {{"a", "1/m^3", ""}, {"b", "1/m^3", ""}}}});
  const std::size_t n = alone.state.scalars.size();
  for (std::size_t i = 0; i < beside.state.carried.size(); ++i)
    if (i % (n + 2) < 2) beside.state.carried[i] = beside.state.density[i / (n + 2)];
  const double massAtStart = integral(beside.box.mesh, [&](int c) { return beside.state.density[at(c)]; });
  for (int s = 0; s < 5; ++s)
    for (Vessel* v : {&alone, &beside}) v->step();
  EXPECT_EQ(beside.state.temperature, alone.state.temperature);
  EXPECT_EQ(beside.ensembles.populations(), alone.ensembles.populations());
  for (std::size_t c = 0; c < alone.state.density.size(); ++c) {
    for (std::size_t s = 0; s < n; ++s)
      ASSERT_EQ(beside.state.carried[c * (n + 2) + 2 + s], alone.state.carried[c * n + s]) << s;
    ASSERT_EQ(beside.state.carried[c * (n + 2) + 1], beside.state.carried[c * (n + 2)]);
  }
  EXPECT_NEAR(integral(beside.box.mesh, [&](int c) { return beside.state.carried[at(c) * (n + 2)]; }) / massAtStart,
              1.0, 1e-12);
  EXPECT_EQ(beside.ensembles.historyValues(beside.state)[0], alone.ensembles.historyValues(alone.state)[0]);
}

class ExchangeWithGas : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Averages, ExchangeWithGas, testing::Values(0.0, 1e-4));

TEST_P(ExchangeWithGas, KeepsElementsAndGivesTheGasWhatParticlesLeave) {
  Vessel v(sootOptions(Exchange::TwoWay, GetParam()));
  const std::vector<std::string> names{"mass", "C", "H", "O", "N"};
  std::vector<double> before;
  for (const std::string& name : names) before.push_back(v.contentOf(name));
  for (int s = 0; s < 25; ++s) v.step();
  const double soot =
      integral(v.box.mesh, [&](int c) { return v.state.carried[at(c) * v.state.scalars.size() + CellSoot::carbon]; });
  EXPECT_GT(soot, 1e-6 * before[1]);
  for (std::size_t k = 0; k < names.size(); ++k) EXPECT_NEAR(v.contentOf(names[k]) / before[k], 1.0, 1e-13) << names[k];
}

// The gas's PAH goes into the particles, whether it is told at once or smoothed.
TEST(EnsembleOperator, SmoothsWhatTheGasLosesWithoutChangingIt) {
  std::vector<double> soot, pah;
  for (const double average : {0.0, 1e-4}) {
    Vessel v(sootOptions(Exchange::TwoWay, average));
    const std::size_t A2 = ethylene().mechanism.speciesIndex("A2");
    const auto left = [&] {
      return integral(v.box.mesh,
                      [&](int c) { return v.state.density[at(c)] * v.state.Y[at(c * v.state.species) + A2]; });
    };
    const double before = left();
    for (int s = 0; s < 50; ++s) v.step();
    pah.push_back(left() / before);
    soot.push_back(integral(v.box.mesh,
                            [&](int c) { return v.state.carried[at(c) * v.state.scalars.size() + CellSoot::carbon]; }));
  }
  report(fmt::format("PAH left after 1 ms: {:.4f} at once, {:.4f} over 0.1 ms; soot differs by {:.1e}", pah[0], pah[1],
                     soot[1] / soot[0] - 1.0));
  EXPECT_LT(pah[0], 0.97);
  EXPECT_NEAR(pah[1], pah[0], 0.15 * (1.0 - pah[0]));  // a tenth of the time is still to come
  EXPECT_NEAR(soot[1] / soot[0], 1.0, 0.1);
}

// What particles gain is as warm as the gas when they gain it; their own heat on the way is not followed.
TEST(EnsembleOperator, KeepsTheEnthalpyOfGasAndParticles) {
  SootOptions still = sootOptions(Exchange::TwoWay);
  still.diffusion = false;
  Vessel v(still, MPI_COMM_WORLD, {}, 0.0);  // in which nothing drifts
  std::ranges::fill(v.state.massFlux, 0.0);
  const auto gasHeat = [&] {
    return integral(v.box.mesh, [&](int c) { return v.state.density[at(c)] * v.state.enthalpy[at(c)]; });
  };
  double moved = 0.0;
  for (int s = 0; s < 25; ++s) {
    const double before = gasHeat();
    const std::vector<double> T = v.state.temperature, amounts = v.state.carried;
    v.step(false);
    const double gained = integral(v.box.mesh, [&](int c) {
      const double *old = &amounts[at(c) * v.state.scalars.size()],
                   *now = &v.state.carried[at(c) * v.state.scalars.size()];
      return (now[CellSoot::carbon] - old[CellSoot::carbon]) * sootCarbonEnthalpy(T[at(c)]).first +
             (now[CellSoot::hydrogen] - old[CellSoot::hydrogen]) * sootHydrogenEnthalpy(T[at(c)]).first;
    });
    EXPECT_NEAR(gasHeat() + gained, before, 1e-12 * std::abs(before));
    moved += std::abs(gained);
  }
  EXPECT_GT(moved, 1e-8 * std::abs(gasHeat()));
}

// The heat of what particles take goes through the reserve as atoms do: the next step has it as a source.
TEST(EnsembleOperator, GivesTheGasTheHeatOfTheReserve) {
  constexpr double average = 1e-4;
  Vessel v(sootOptions(Exchange::TwoWay, average)), without(sootOptions(Exchange::OneWay));
  for (Vessel* vessel : {&v, &without}) vessel->step(false);
  double given = 0.0, gained = 0.0;
  for (int c = 0; c < v.box.mesh.owned; ++c) {
    const double* amount = &v.state.carried[at(c) * v.state.scalars.size()];
    const double T = v.state.temperature[at(c)];
    given += average * (v.state.balance.enthalpy[at(c)] - without.state.balance.enthalpy[at(c)]);
    gained += amount[CellSoot::carbon] * sootCarbonEnthalpy(T).first +
              amount[CellSoot::hydrogen] * sootHydrogenEnthalpy(T).first;
  }
  given = sumOverRanks(given);
  gained = sumOverRanks(gained);
  EXPECT_GT(std::abs(gained), 0.0);
  // What diffused between the cells since has come from gas of another temperature.
  EXPECT_NEAR(given / -gained, 1.0, 0.01);
}

TEST(EnsembleOperator, OneWayLeavesTheGasAlone) {
  Vessel v(sootOptions(Exchange::OneWay)), without(sootOptions(Exchange::OneWay));
  for (int s = 0; s < 5; ++s) {
    v.step();
    without.transport.advance(without.state, without.time, Vessel::dt);
    without.transport.endSweep(without.state);
  }
  for (int c = 0; c < v.box.mesh.owned; ++c) EXPECT_EQ(v.state.temperature[at(c)], without.state.temperature[at(c)]);
  EXPECT_GT(integral(v.box.mesh, [&](int c) { return v.state.carried[at(c) * v.state.scalars.size()]; }), 0.0);
}

// Particles of equal weight come and go where they are resampled: with what is told of that nothing is missing.
TEST(EnsembleOperator, TellsWhatEqualWeightsTakeAndBring) {
  SootOptions o = sootOptions(Exchange::TwoWay);
  o.ensemble.method = EnsembleMethod::dsmc;
  o.ensemble.startNumberDensity = 1e12;
  Vessel v(o);
  double carbon = 0.0, hydrogen = 0.0;
  v.ensembles.watchAmounts([&](std::span<const double> came, std::span<const double>) {
    carbon += came[CellSoot::carbon];
    hydrogen += came[CellSoot::hydrogen];
  });
  const double C = v.contentOf("C"), H = v.contentOf("H");
  for (int s = 0; s < 12; ++s) v.step();
  EXPECT_NE(sumOverRanks(carbon), 0.0);
  EXPECT_NEAR((v.contentOf("C") - sumOverRanks(carbon)) / C, 1.0, 1e-12);
  EXPECT_NEAR((v.contentOf("H") - sumOverRanks(hydrogen)) / H, 1.0, 1e-12);
}

// In a gas that stays as it is the ensembles are the same to the last bit on any number of ranks, with sharing and
// without.
class MethodsInCells : public testing::TestWithParam<EnsembleMethod> {
 protected:
  [[nodiscard]] static SootOptions optionsOf(Exchange exchange, double average = 0.0) {
    SootOptions o = sootOptions(exchange, average);
    o.ensemble.method = GetParam();
    o.particles = o.ensemble.particles;
    if (GetParam() == EnsembleMethod::pairs) o.particlesAtEdges = 15;
    return o;
  }
};
INSTANTIATE_TEST_SUITE_P(All, MethodsInCells, testing::Values(EnsembleMethod::sammc, EnsembleMethod::pairs));

TEST_P(MethodsInCells, DoNotDependOnRanksNorSharing) {
  SootOptions shared = optionsOf(Exchange::OneWay), own = shared;
  own.shareWork = false;
  Vessel alone(own, MPI_COMM_SELF), together(shared), apart(own);
  for (Vessel* v : {&alone, &together, &apart})
    for (int s = 0; s < 12; ++s) v->step(false);
  std::size_t particles = 0;
  for (int c = 0; c < together.box.mesh.owned; ++c) {
    const int same = alone.box.mesh.findOwned(together.box.mesh.naturalCell[at(c)]);
    const auto& population = alone.ensembles.populations()[at(same)];
    EXPECT_EQ(together.ensembles.populations()[at(c)], population) << c;
    EXPECT_EQ(apart.ensembles.populations()[at(c)], population) << c;
    particles += packedParticles(population).size();
  }
  EXPECT_GT(sumOverRanks(static_cast<double>(particles)), 200.0);
}

// Room for as many as the root of a cell's share of the largest number or volume says, at the edges for
// `particlesAtEdges`.
TEST(EnsembleOperator, HasFewerParticlesWhereThereIsLess) {
  SootOptions o = sootOptions(Exchange::OneWay);
  o.ensemble.method = EnsembleMethod::pairs;
  o.diffusion = false;
  o.particles = o.ensemble.particles = 80;
  o.particlesAtEdges = 20;
  const auto kind = sootOf(o);
  CellVessel v(
      ethylene(),
      [](const Vector3&) {
        return Box::Local{{}, 1500.0, ethylene().massFractions("N2: 1")};
      },
      kind, o);
  struct Filled {
    std::int64_t cell;
    double number, mass;  // of each numerical particle, over those of the first
    double room;
  };
  const std::vector<Filled> filled{
      {2, 1.0, 1.0, 80.0}, {9, 0.1, 20.0, 80.0}, {16, 0.25, 1.0, 40.0}, {23, 0.04, 1.0, 20.0}};
  const auto own = [&](const Filled& one) { return v.box.mesh.findOwned(one.cell); };
  for (const Filled& one : filled) {
    if (own(one) < 0) continue;
    std::vector<GivenParticle> particles;
    for (int k = 0; k < 76; ++k)
      particles.push_back({one.mass * 1e-23 * (1.0 + 0.01 * k), 0.0, 1.0, 1e13 * one.number});
    v.ensembles.initialise(v.state, own(one), kind->packed(particles, static_cast<std::uint64_t>(one.cell)));
  }
  v.step(false);
  for (const Filled& one : filled) {
    if (own(one) < 0) continue;
    const auto count = static_cast<double>(packedParticles(v.ensembles.populations()[at(own(one))]).size());
    EXPECT_LE(count, one.room) << one.cell;
    EXPECT_GE(count, 0.9 * one.room) << one.cell;
  }
}

// What a step that failed goes back to, and a restart: the same bits.
TEST_P(MethodsInCells, GoOnToTheSameBits) {
  Vessel v(optionsOf(Exchange::TwoWay, 1e-4));
  for (int s = 0; s < 6; ++s) v.step();
  StateBackup kept(v.box.mesh.owned, v.box.mesh.faces);
  const double time = v.time;
  kept.save([&](StateArchive& archive) { v.saveOrLoad(archive); });
  for (int s = 0; s < 4; ++s) v.step();
  const auto populations = v.ensembles.populations();
  const std::vector<double> carried = v.state.carried, temperature = v.state.temperature;
  kept.restore([&](StateArchive& archive) { v.saveOrLoad(archive); });
  v.state.updateHalo(v.box.halo);
  v.time = time;
  v.begin();
  for (int s = 0; s < 4; ++s) v.step();
  EXPECT_EQ(v.ensembles.populations(), populations);
  EXPECT_EQ(v.state.carried, carried);
  EXPECT_EQ(v.state.temperature, temperature);
}

// The gas stays to the last bit, the balance of atoms too, and a restart has what moves the particles.
TEST(EnsembleOperator, GoesOnInAGasThatIsHeld) {
  SootOptions o = sootOptions(Exchange::TwoWay, 1e-4);
  o.frozenFrom = 4.5 * Vessel::dt;
  Vessel v(o);
  for (int s = 0; s < 5; ++s) v.step();
  ASSERT_TRUE(v.ensembles.holdsOthers(v.time));
  const std::vector<double> T = v.state.temperature;
  const double carbon = v.contentOf("C"), soot = v.state.carried[CellSoot::carbon];
  const auto hold = [](Vessel& vessel) {
    vessel.ensembles.advance(vessel.state, vessel.time, Vessel::dt);
    vessel.begin();
    vessel.time += Vessel::dt;
  };
  for (int s = 0; s < 3; ++s) hold(v);
  StateBackup kept(v.box.mesh.owned, v.box.mesh.faces);
  kept.save([&](StateArchive& archive) { v.saveOrLoad(archive); });
  for (int s = 0; s < 3; ++s) hold(v);
  EXPECT_EQ(v.state.temperature, T);
  EXPECT_NEAR(v.contentOf("C") / carbon, 1.0, 1e-13);
  EXPECT_NE(v.state.carried[CellSoot::carbon], soot);
  Vessel other(o);
  kept.restore([&](StateArchive& archive) { other.saveOrLoad(archive); });
  other.state.updateHalo(other.box.halo);
  other.time = 8 * Vessel::dt;
  other.begin();
  for (int s = 0; s < 3; ++s) hold(other);
  EXPECT_EQ(other.ensembles.populations(), v.ensembles.populations());
}

TEST(EnsembleOperator, TakesStepsOfSeveralSweepsOnce) {
  const SootOptions single = sootOptions(Exchange::TwoWay, 1e-4);
  SootOptions o = single;
  o.sweeps = 2;
  Vessel once(single), twice(o);
  for (int s = 0; s < 6; ++s) {
    once.step(false);
    twice.state.keepStart();
    for (int sweep = 0; sweep < 2; ++sweep) twice.ensembles.advance(twice.state, twice.time, Vessel::dt);
    twice.begin();
    twice.time += Vessel::dt;
  }
  EXPECT_EQ(once.ensembles.populations(), twice.ensembles.populations());
  EXPECT_EQ(once.state.carried, twice.state.carried);  // with what the reserve owes
}

// Other random numbers in every step.
TEST(EnsembleOperator, DrawsAnewInEveryStep) {
  SootOptions o = sootOptions(Exchange::OneWay);
  o.ensemble.particles = 400;
  for (bool SootModelOptions::*process :
       {&SootModelOptions::inception, &SootModelOptions::coagulation, &SootModelOptions::condensation,
        &SootModelOptions::surfaceGrowth, &SootModelOptions::oxidation})
    o.ensemble.soot.*process = false;
  Vessel v(o);
  v.step();  // the faces have densities now, across which particles diffuse
  std::vector<GivenParticle> fresh;
  for (int k = 0; k < 400; ++k) fresh.push_back({1e-24, 0.0, 1.0, 1e14 * (1.0 + 0.001 * k)});
  std::vector<std::vector<std::vector<double>>> found;
  double moved = 0.0;
  for (int s = 0; s < 2; ++s) {
    for (int c = 0; c < v.box.mesh.owned; ++c)
      v.ensembles.initialise(v.state, c, sootOf(o)->packed(fresh, numberOf(v.box.mesh, c)));
    v.step(false);
    found.emplace_back();
    for (const auto& population : v.ensembles.populations()) {
      found.back().emplace_back(population.begin() + static_cast<std::ptrdiff_t>(packedHead), population.end());
      moved += packedParticles(population).size() == fresh.size() ? 0.0 : 1.0;
    }
  }
  EXPECT_GT(sumOverRanks(moved), 5.0);
  EXPECT_GT(sumOverRanks(found[0] == found[1] ? 0.0 : 1.0), 0.0);
}

TEST(EnsembleOperator, MakesEnsemblesOnlyWhereThereIsSomethingToBecomeSoot) {
  Vessel v(sootOptions(Exchange::OneWay));
  for (int c = 0; c < v.box.mesh.cells; ++c)
    if (v.box.mesh.centre[at(c)][0] < 0.0013)
      v.state.Y[at(c * v.state.species) + ethylene().mechanism.speciesIndex("A2")] = 0.0;
  v.step(false);
  for (int c = 0; c < v.box.mesh.owned; ++c)
    EXPECT_EQ(v.ensembles.populations()[at(c)].empty(), v.box.mesh.centre[at(c)][0] < 0.0013);
}

}  // namespace
}  // namespace lampblack::test
