// A new model of particles is a file with its class, its keys and how they are read, and one row of the table of
// models.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "coupling/carried_particles.hpp"
#include "flow/models/carried_operator.hpp"
#include "tests/app/app_fixture.hpp"

namespace lampblack::app {
namespace {

using test::Flame;

constexpr double dustEnthalpy = -2e6;  // J/kg

// Hydrogen as dust, which vanishes into the gas.
class Dust final : public ParticleModel {
 public:
  explicit Dust(double rate) : rate_(rate) {}
  [[nodiscard]] std::string material() const override { return "dust"; }
  [[nodiscard]] const std::vector<std::string>& gasSpecies() const override { return species_; }
  [[nodiscard]] std::vector<std::size_t> precursors() const override { return {}; }
  [[nodiscard]] const std::vector<ParticleScalar>& scalars() const override { return scalars_; }
  void sources(const ParticleGas&, std::span<const double> densities, std::span<double> rates,
               std::span<double> exchange) const override {
    rates[0] = -rate_ * densities[0];
    exchange[0] = rate_ * densities[0] / 2.016e-3;
  }
  void diffusivities(const ParticleGas&, std::span<const double>, std::span<double> D) const override { D[0] = 1e-6; }
  void enthalpies(double, std::span<double> h, std::span<double> slope) const override {
    h[0] = dustEnthalpy;
    slope[0] = 0;
  }
  [[nodiscard]] double absorption(double, double) const override { return 0; }
  [[nodiscard]] ParticleProperties properties(const ParticleGas&, std::span<const double> densities) const override {
    ParticleProperties p;
    p.volumeFraction = densities[0] / 1000;
    return p;
  }
  [[nodiscard]] ParticleProcesses processes(const ParticleGas&, std::span<const double>) const override { return {}; }

 private:
  double rate_;  // 1/s
  std::vector<std::string> species_{"H2"};
  std::vector<ParticleScalar> scalars_{{"mass", "kg/m^3", "dust", 1e-3, {{"H", 1}}}};
};

void addDustKeys(DeckSchema& schema) {
  schema.section("particles.dust", Presence::defaulted, "The model dust.", {{"particles.description", {"dust"}}})
      .add(quantityKey("particles.dust.rate", units::frequency, "How fast it vanishes.").byDefault("10 1/s").above(0));
}

SootModelOptions dustDefaults() {
  return {};
}

std::unique_ptr<ParticleModel> readDust(const Deck& deck, const Mechanism&) {
  return std::make_unique<Dust>(deck.quantity("particles.dust.rate"));
}

std::vector<SootModelEntry> modelsAndDust() {
  std::vector<SootModelEntry> models = sootModels();
  models.push_back({"dust", "nobody", addDustKeys, dustDefaults, readDust});
  return models;
}

TEST(NewModel, IsARowOfTheTableAndGoesIntoAFlow) {
  DeckSchema schema;
  addParticleKeys(schema, {.description = "Particles."}, modelsAndDust());
  const Deck deck = Deck::parse("particles: {description: dust, dust: {rate: 100 1/s}}", "deck.yaml", {}, schema);
  Flame flame(MPI_COMM_WORLD, test::sootingGas);
  const Mechanism& mechanism = *flame.flowCase.mechanism;
  CarriedParticles dust(mechanism, readSootModel(deck, mechanism, modelsAndDust()));
  flame.state = State(flame.mesh, mechanism.numSpecies(), {CarriedOperator::blockOf(dust, flame.flowCase.boundaries)});
  Flame gas(MPI_COMM_WORLD, test::sootingGas);
  for (auto field : {&State::temperature, &State::density, &State::enthalpy, &State::Y, &State::velocity})
    flame.state.*field = gas.state.*field;
  std::fill(flame.state.carried.begin(), flame.state.carried.end(), 2e-3);
  CarriedOperator particles(flame.context, dust, 0, {});
  particles.endStep(flame.state);
  particles.endSweep(flame.state);
  particles.advance(flame.state, 0.0, 5e-3);
  for (int c = 0; c < flame.mesh.owned; ++c)
    EXPECT_NEAR(particles.densities(flame.state, c)[0] / (2e-3 * std::exp(-0.5)), 1, 1e-3);
  EXPECT_EQ(flame.state.scalars[0].name, "dust_mass");
}

// Where a flow brings as much dust as vanishes the state is steady, and knows no step; in turn with the flow it would
// be off by half a step of what vanishes. Dust and what comes of it: mass of the gas, hydrogen, enthalpy.
TEST(NewModel, ASteadyStateDoesNotDependOnTheStep) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas);
  const Mechanism& mechanism = *flame.flowCase.mechanism;
  const std::size_t n = mechanism.numSpecies(), h2 = mechanism.speciesIndex("H2");
  const double rate = 100, brought = 0.1;  // 1/s, kg/m3/s
  CarriedParticles dust(mechanism, std::make_unique<Dust>(rate));
  const State gas = flame.state;
  for (const double dt : {1e-4, 2e-3, 5e-2}) {  // a hundredth to five times of what there is vanishes in a step
    State state(flame.mesh, n, {CarriedOperator::blockOf(dust, flame.flowCase.boundaries)});
    for (auto field : {&State::temperature, &State::density, &State::enthalpy, &State::Y}) state.*field = gas.*field;
    state.thermodynamicPressure = gas.thermodynamicPressure;
    std::fill(state.carried.begin(), state.carried.end(), 2e-3);
    CarriedOperator particles(flame.context, dust, 0, {});
    particles.endStep(state);
    particles.endSweep(state);
    // In place of a flow: dust comes, the hydrogen that it gives goes, and what the balance says happens.
    const auto flow = [&] {
      for (int c = 0; c < flame.mesh.owned; ++c) {
        const auto cell = static_cast<std::size_t>(c);
        double* Y = &state.Y[cell * n];
        const double before = state.density[cell];
        double mass = before - dt * brought;
        std::vector<double> told(n);
        state.balance.ofSpecies(cell, told);
        for (std::size_t k = 0; k < n; ++k) mass += dt * told[k];
        for (std::size_t k = 0; k < n; ++k) Y[k] = (before * Y[k] + dt * (told[k] - (k == h2 ? brought : 0.0))) / mass;
        state.density[cell] = mass;
        state.enthalpy[cell] = (before * state.enthalpy[cell] + dt * state.balance.enthalpy[cell]) / mass;
        state.carried[cell] += dt * (brought + state.balance.carried[cell]);
      }
      state.balance.clear();
    };
    int steps = 0;
    for (; steps * dt < 0.3; ++steps) {
      flow();
      particles.advance(state, steps * dt, dt);
      particles.endStep(state);
      particles.endSweep(state);
    }
    for (int c = 0; c < flame.mesh.owned; ++c) {
      const auto cell = static_cast<std::size_t>(c);
      EXPECT_NEAR(state.carried[cell] / (brought / rate), 1, 1e-6) << dt;
      // What the next step's transport is told.
      EXPECT_NEAR(state.balance.carried[cell] / -brought, 1, 1e-6) << dt;
      std::vector<double> told(n);
      state.balance.ofSpecies(cell, told);
      EXPECT_NEAR(told[h2] / brought, 1, 1e-6) << dt;
      EXPECT_NEAR(state.balance.enthalpy[cell] / (brought * dustEnthalpy), 1, 1e-6) << dt;
      // What was there of dust in the beginning and is not there now has become gas.
      const double gained = 2e-3 - state.carried[cell];
      EXPECT_NEAR(state.density[cell] - gas.density[cell], gained, 1e-12) << dt;
      EXPECT_NEAR(state.density[cell] * state.Y[cell * n + h2] - gas.density[cell] * gas.Y[cell * n + h2], gained,
                  1e-12);
      const double vanished = steps * dt * brought + gained;
      EXPECT_NEAR(state.density[cell] * state.enthalpy[cell] - gas.density[cell] * gas.enthalpy[cell],
                  vanished * dustEnthalpy, 1e-9 * std::abs(vanished * dustEnthalpy));
    }
  }
}

// Transport is told all that has vanished, with its heat, be it more than is left; where the flow carries all away it
// takes back what it was told.
TEST(NewModel, TakesBackWhatTransportWasTold) {
  Flame flame(MPI_COMM_WORLD, test::sootingGas);
  const Mechanism& mechanism = *flame.flowCase.mechanism;
  const std::size_t n = mechanism.numSpecies(), h2 = mechanism.speciesIndex("H2");
  CarriedParticles dust(mechanism, std::make_unique<Dust>(1e3));
  State state(flame.mesh, n, {CarriedOperator::blockOf(dust, flame.flowCase.boundaries)});
  for (auto field : {&State::temperature, &State::density, &State::enthalpy, &State::Y})
    state.*field = flame.state.*field;
  state.thermodynamicPressure = flame.state.thermodynamicPressure;
  CarriedOperator particles(flame.context, dust, 0, {});
  std::fill(state.carried.begin(), state.carried.end(), 2e-3);
  particles.endStep(state);
  particles.endSweep(state);
  const double dt = 2e-3;
  particles.advance(state, 0.0, dt);
  particles.endStep(state);
  particles.endSweep(state);
  const State before = state;
  for (int c = 0; c < flame.mesh.owned; ++c) {
    const auto cell = static_cast<std::size_t>(c);
    EXPECT_GT(state.carried[cell], 1e-5);
    EXPECT_NEAR(dt * state.balance.carried[cell] / (state.carried[cell] - 2e-3), 1, 1e-12);
    EXPECT_NEAR(state.balance.enthalpy[cell] / (-state.balance.carried[cell] * dustEnthalpy), 1, 1e-9);
    // A flow that carries all away, and adds what it was told.
    std::vector<double> rates(n);
    state.balance.ofSpecies(cell, rates);
    const double told = dt * rates[h2], mass = state.density[cell] + told;
    for (std::size_t k = 0; k < n; ++k)
      state.Y[cell * n + k] = (state.density[cell] * state.Y[cell * n + k] + (k == h2 ? told : 0.0)) / mass;
    state.enthalpy[cell] = (state.density[cell] * state.enthalpy[cell] + dt * state.balance.enthalpy[cell]) / mass;
    state.density[cell] = mass;
    state.carried[cell] = dt * state.balance.carried[cell];
  }
  particles.advance(state, dt, dt);
  for (int c = 0; c < flame.mesh.owned; ++c) {
    const auto cell = static_cast<std::size_t>(c);
    EXPECT_NEAR(state.carried[cell], 0, 1e-15);
    EXPECT_NEAR(state.density[cell] / before.density[cell], 1, 1e-12);
    EXPECT_NEAR(state.Y[cell * n + h2], before.Y[cell * n + h2], 1e-12);
    EXPECT_NEAR(state.enthalpy[cell] / before.enthalpy[cell], 1, 1e-12);
  }
}

}  // namespace
}  // namespace lampblack::app
