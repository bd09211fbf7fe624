// Gas and particles in turn: order, what is kept, and ensembles against sections that stand in the equations.
#include "coupling/split_reactor.hpp"

#include <gtest/gtest.h>

#include "chemistry/reactor/plug_flow.hpp"
#include "chemistry/reactor/reactor_network.hpp"
#include "coupling/reactor_balance.hpp"
#include "coupling/split_gas.hpp"
#include "particles/models/sectional/sectional_soot.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/coupling/populations_in_reactors.hpp"
#include "tests/coupling/toy_particles.hpp"
#include "tests/effort.hpp"
#include "tests/every_module.hpp"

namespace lampblack::coupling {
namespace {

using test::ethylene;
using test::gasOf;
using test::integrated;
using test::Toy;
using test::ToyPhase;
using test::ToySplit;

using Held = ReactorSystem::Held;
using Kept = SplitReactor::Gas::Kept;

constexpr double tolerance = 1e-9;

struct Result {
  double temperature, acetylene, carbon;  // K, kg/kg, kg/kg
  [[nodiscard]] double distance(const Result& other) const {
    return std::max({std::abs(temperature / other.temperature - 1), std::abs(acetylene / other.acetylene - 1),
                     std::abs(carbon / other.carbon - 1)});
  }
};

class SplitToy : public ::testing::Test {
 protected:
  Toy toy{ethylene(), 4e6, 15000, 50};
  GasState gas = gasOf(ethylene(), 1900, "C2H2: 0.1, A1: 0.02, H2: 0.02, N2: 0.86");
  std::size_t n = ethylene().numSpecies();

  // By steps of end/count, or by steps that are chosen.
  Result split(OdeSystem& system, SplitReactor::Gas own, const std::vector<double>& start, double end,
               std::size_t count) {
    ToySplit particles(toy);
    SplitReactor::Options options;
    options.integrator = {tolerance, 1e-6 * tolerance, 0, 1000000};
    options.fixedStep = count > 0;
    if (count > 0) options.largestStep = end / static_cast<double>(count);
    own.system = &system;
    SplitReactor reactor(ethylene(), own, particles, options);
    reactor.start(0, start);
    reactor.advance(end);
    if (count > 0) {
      EXPECT_EQ(reactor.work().steps, static_cast<long>(count));
    }
    const auto y = reactor.state();
    // What was booked is what the particles have.
    EXPECT_NEAR(own.density(0, y.data()) * y[n + 1 + ParticlesAtRest::carbon] / particles.carbon, 1, 1e-7);
    ParticlesAtRest atRest;
    ReactorBalance balance(ethylene(), atRest, atRest.unitElements(ethylene()));
    const std::span<const double> first(start);
    const auto count0 = atRest.size();
    if (own.kept[0] == Kept::temperature) return {y[n], y[toy.acetylene], y[n + 1]};
    if (!isOpen) {
      EXPECT_LT(largestImbalance(balance.elements(first.first(n), first.subspan(n + 1, count0)),
                                 balance.elements(y.first(n), y.subspan(n + 1, count0))),
                1e-13);
      const auto energy = [&](std::span<const double> at) {
        const auto amounts = at.subspan(n + 1, count0);
        return own.kept[0] == Kept::enthalpy ? balance.enthalpy(at[n], at.first(n), amounts)
                                             : balance.internalEnergy(at[n], at.first(n), amounts);
      };
      EXPECT_NEAR(energy(y), energy(first), 1e-9 * 2e6);  // cp T is about 2e6 J/kg
    }
    return {y[n], y[toy.acetylene], y[n + 1 + ParticlesAtRest::carbon]};
  }

  // Halving the steps has to divide the error by four.
  void expectSecondOrder(OdeSystem& system, const SplitReactor::Gas& own, const std::vector<double>& start, double end,
                         const Result& exact) {
    double last = 0;
    // With a predictor, terms of higher order count in longer steps.
    const std::size_t first = own.expected ? 16 : test::fewOrMany<std::size_t>(8, 16);
    for (std::size_t count = first; count <= test::fewOrMany<std::size_t>(2 * first, 64); count *= 2) {
      const double error = split(system, own, start, end, count).distance(exact);
      test::measured("error", error);
      if (last > 0) {
        EXPECT_NEAR(std::log2(last / error), 2, 0.3) << count << " steps: " << error;
      }
      last = error;
    }
    EXPECT_LT(last, 1e-3);
    EXPECT_LT(split(system, own, start, end, 0).distance(exact), 2e-3);  // steps of its own
  }

  Result reference(OdeSystem& system, std::span<const double> start, double end) {
    const auto y = integrated(system, start, end, tolerance);
    return {y[n], y[toy.acetylene], y[n + 1] * ToyPhase::unit};
  }
  bool isOpen = false;
};

// By predictor and corrector as by splitting.
class EveryCoupling : public SplitToy, public ::testing::WithParamInterface<bool> {
 protected:
  // What the gas carries.
  ParticlesAtRest& phase() { return GetParam() ? static_cast<ParticlesAtRest&>(inGas) : atRest; }
  void couple(SplitReactor::Gas& own) { own.expected = GetParam() ? &inGas : nullptr; }
  // A closed reactor as the coupling sees it.
  SplitReactor::Gas closedGas(ClosedReactor& reactor, Held held) {
    SplitReactor::Gas own = splitGas(reactor, held);
    couple(own);
    return own;
  }
  // The work that a closed reactor of constant pressure takes up to `end`, s.
  SplitReactor::Work workOf(ToySplit& particles, double end) {
    ClosedReactor reactor(ethylene(), gas, Held::Pressure, std::nullopt, &phase());
    SplitReactor::Options options;
    options.integrator = {1e-6, 1e-12, 0, 1000000};
    options.change = 0.03;
    SplitReactor both(ethylene(), closedGas(reactor, Held::Pressure), particles, options);
    both.start(0, reactor.initialState());
    both.advance(end);
    return both.work();
  }
  ParticlesAtRest atRest;
  ExchangeInGas inGas{ethylene(), SplitParticles::sootElements(), {toy.acetylene}};
};

TEST_P(EveryCoupling, ClosedReactorsAreOfSecondOrder) {
  for (const Held held : {Held::Pressure, Held::Density}) {
    ToyPhase exact(toy);
    ClosedReactor whole(ethylene(), gas, held, std::nullopt, &exact);
    ClosedReactor reactor(ethylene(), gas, held, std::nullopt, &phase());
    SplitReactor::Gas own = closedGas(reactor, held);
    expectSecondOrder(reactor, own, reactor.initialState(), 2e-4, reference(whole, whole.initialState(), 2e-4));
  }
}

// A step that changes too much is taken back, but not one in which numerical particles went at random: that would
// choose among what chance has it.
TEST_P(EveryCoupling, NoStepWithRemovalsIsTakenBack) {
  for (const bool loses : {false, true}) {
    ToySplit particles(toy);
    particles.losesSome = loses;
    particles.burstAt = 1e-3;
    const SplitReactor::Work work = workOf(particles, 7e-5);
    ASSERT_GT(particles.carbon, particles.burstAt);
    EXPECT_GE(work.gasSteps, work.steps) << "the gas takes a step at least in each";
    EXPECT_EQ(work.rejected > 0, !loses);
    EXPECT_EQ(work.unchecked > 0, loses);
  }
}

// Where there are no particles, the exchange limits no step.
TEST_P(EveryCoupling, IdleParticlesLimitNoStep) {
  std::array<std::size_t, 2> steps{};
  for (const bool idle : {false, true}) {
    ToySplit particles(toy);
    particles.isIdle = idle;
    const SplitReactor::Work work = workOf(particles, 2e-4);
    steps[idle ? 1 : 0] = work.steps;
    if (idle) {
      EXPECT_EQ(work.rejected, 0u);
    }
  }
  EXPECT_LT(2 * steps[1], steps[0]);
}

TEST_P(EveryCoupling, PlugFlowIsOfSecondOrder) {
  ToyPhase exact(toy);
  PlugFlow whole(ethylene(), gas, 3.0, 4e-3, std::nullopt, &exact);
  PlugFlow flow(ethylene(), gas, 3.0, 4e-3, std::nullopt, &phase());
  SplitReactor::Gas own = splitGas(flow, gas.pressure);
  couple(own);
  expectSecondOrder(flow, own, flow.initialState(), 4e-3, reference(whole, whole.initialState(), 4e-3));
}

TEST_P(EveryCoupling, AStirredReactorIsOfSecondOrder) {
  isOpen = true;
  const StirredReactor vessel{"r", 1e-4, {}, {}, 0, 0};
  const ReactorNetwork network{gas.pressure, {vessel}, {{0, 5e-2, gas.temperature, gas.Y}}, {}};
  ToyPhase exact(toy);
  NetworkSystem whole(ethylene(), network, &exact);
  NetworkSystem system(ethylene(), network, &phase());
  SplitReactor::Gas own = splitGas(system);
  couple(own);
  const auto start = [&](const NetworkSystem& of) {
    return startUnknowns(ethylene(), network, {false, gas}, of.numCarried());
  };
  expectSecondOrder(system, own, start(system), 2e-4, reference(whole, start(whole), 2e-4));
}

INSTANTIATE_TEST_SUITE_P(Couplings, EveryCoupling, ::testing::Values(false, true),
                         [](const auto& info) { return info.param ? "Predicted" : "Split"; });

// The same soot by sections in the equations of the reactor and by ensembles in turn with the gas: spheres of dimers,
// in a closed reactor. Beside the noise of the repeats, 0.5 % for 60 sections and the steps of the splitting (0.3 %).
class EnsembleInAReactor : public ::testing::TestWithParam<EnsembleMethod> {
 protected:
  static SootModelOptions sootOptions() {
    SootModelOptions options;
    options.pah = {{"A2", 10, 8, 2e-3}};
    options.sootDensity = 1800;
    options.carbonWeight = ethylene().atomicWeight(ethylene().elementIndex("C"));
    options.hydrogenWeight = ethylene().atomicWeight(ethylene().elementIndex("H"));
    return options;
  }
};

TEST_P(EnsembleInAReactor, AgreesWithSections) {
  const GasState gas = gasOf(ethylene(), 1900, "C2H2: 0.06, A1: 0.01, N2: 0.93");
  const std::size_t n = ethylene().numSpecies();
  const double end = 1e-3;
  SectionalSootOptions options;
  options.soot = sootOptions();
  options.sections = 60;
  options.factor = std::pow(2.0, 0.5);
  options.nucleation = SectionalSootOptions::Nucleation::dimer;
  options.aggregation = SectionalSootOptions::Aggregation::spheres;
  options.growthScheme = SectionalSootOptions::GrowthScheme::limited;
  CarriedParticles sections(ethylene(), std::make_unique<SectionalSoot>(options));
  ReactorParticles particles(ethylene(), sections);
  ClosedReactor whole(ethylene(), gas, Held::Pressure, std::nullopt, &particles);
  const auto y = integrated(whole, whole.initialState(), end, 1e-8);
  std::vector<double> densities(particles.size());
  const double density = whole.density(0, y.data());
  particles.densities(density, std::span<const double>(y).subspan(n + 1), densities);
  const ParticleProperties exact =
      sections.model().properties(particles.gas().atComposition(y[n], gas.pressure, {y.data(), n}), densities);

  constexpr std::size_t repeats = 4;
  std::vector<double> number, fraction, temperature;
  for (std::size_t r = 0; r < repeats; ++r) {
    ParticlesAtRest atRest;
    ClosedReactor reactor(ethylene(), gas, Held::Pressure, std::nullopt, &atRest);
    const SplitReactor::Gas own = splitGas(reactor, Held::Pressure);
    EnsembleOptions stochastic;
    stochastic.method = GetParam();
    stochastic.particles = 300;
    stochastic.owner = r;
    stochastic.soot = sootOptions();
    stochastic.keepsHydrogen = false;
    test::ReactorSoot ensemble(ethylene(), stochastic);
    SplitReactor::Options split;
    split.integrator = {1e-6, 1e-12, 0, 1000000};
    split.change = 0.1;
    SplitReactor march(ethylene(), own, ensemble, split);
    march.start(0, reactor.initialState());
    march.advance(end);
    number.push_back(ensemble.ensemble().totals().number);
    fraction.push_back(ensemble.ensemble().volumeFraction());
    temperature.push_back(march.state()[n]);
    ReactorBalance balance(ethylene(), atRest, atRest.unitElements(ethylene()));
    const std::vector<double> start = reactor.initialState();
    const auto elements = [&](std::span<const double> at) {
      return balance.elements(at.first(n), at.subspan(n + 1, atRest.size()));
    };
    EXPECT_LT(largestImbalance(elements(start), elements(march.state())), 1e-13);
  }
  const auto expectNear = [&](const std::vector<double>& values, double expected, double scale, const char* what) {
    double mean = 0, sum = 0;
    for (const double value : values) mean += value / repeats;
    for (const double value : values) sum += (value - mean) * (value - mean);
    const double error = std::hypot(std::sqrt(sum / (repeats * (repeats - 1))), 0.008 * scale);
    // Student's t of three degrees of freedom is beyond 5.8 once in a hundred.
    EXPECT_LT(std::abs(mean - expected) / error, 5.8) << what << ": " << mean << " and " << expected;
    EXPECT_LT(std::abs(mean - expected), 0.1 * scale) << what;
  };
  expectNear(number, exact.numberDensity, exact.numberDensity, "number");
  expectNear(fraction, exact.volumeFraction, exact.volumeFraction, "volume fraction");
  expectNear(temperature, y[n], gas.temperature - y[n], "temperature");
}

INSTANTIATE_TEST_SUITE_P(Methods, EnsembleInAReactor, ::testing::Values(EnsembleMethod::swa));
INSTANTIATE_TEST_SUITE_P(Long, EnsembleInAReactor, ::testing::Values(EnsembleMethod::dsmc, EnsembleMethod::sammc));

}  // namespace
}  // namespace lampblack::coupling
