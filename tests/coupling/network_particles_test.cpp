// Particles that go from reactor to reactor with the gas: where they are, that nothing is lost, and the order of
// splitting where they come back.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "chemistry/reactor/reactor_network.hpp"
#include "coupling/reactor_balance.hpp"
#include "coupling/split_gas.hpp"
#include "tests/coupling/populations_in_reactors.hpp"
#include "tests/coupling/toy_particles.hpp"
#include "tests/effort.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::coupling {
namespace {

using test::ethylene;
using test::gasOf;
using test::integrated;
using test::Toy;
using test::ToyPhase;
using test::ToySplit;
// Two reactors, of which the second, hotter one gives half of what flows through it back to the first.
ReactorNetwork recycle(const GasState& gas, std::optional<double> first, std::optional<double> second) {
  return {gas.pressure,
          {{"first", {}, 1e-3, first, 0, 0}, {"second", {}, 5e-4, second, 0, 0}},
          {{0, 1.0, gas.temperature, gas.Y}},
          {{0, 1, 2.0}, {1, 0, 1.0}}};
}

TEST(NetworkOfToys, IsOfSecondOrderWithARecycle) {
  const Toy toy(ethylene(), 4e6, 15000, 50);
  const GasState gas = gasOf(ethylene(), 1900, "C2H2: 0.1, A1: 0.02, H2: 0.02, N2: 0.86");
  const ReactorNetwork network = recycle(gas, {}, {});
  const std::size_t n = ethylene().numSpecies();
  const double end = 2e-4;
  constexpr double tolerance = 1e-10;
  const NetworkStart start{false, gas};
  ToyPhase phase(toy);
  NetworkSystem whole(ethylene(), network, &phase);
  const auto exact = integrated(whole, startUnknowns(ethylene(), network, start, whole.numCarried()), end, tolerance);
  double last = 0;
  for (const std::size_t count : {8u, 16u}) {
    ParticlesAtRest atRest(2);
    NetworkSystem system(ethylene(), network, &atRest);
    ToySplit first(toy), second(toy);
    SplitReactor::Options options;
    options.integrator = {tolerance, 1e-6 * tolerance, 0, 1000000};
    options.fixedStep = true;
    options.largestStep = end / static_cast<double>(count);
    SplitReactor march(ethylene(), splitGas(system), std::vector<SplitParticles*>{&first, &second}, options);
    const auto unknowns = startUnknowns(ethylene(), network, start, system.numCarried());
    march.start(0, unknowns);
    march.advance(end);
    ReactorBalance balance(ethylene(), atRest, atRest.unitElements(ethylene()));
    const auto elements = [&](std::span<const double> at) {
      return balance.elements(at.first(n), at.subspan(n + 1, atRest.size()));
    };
    double error = 0;
    for (std::size_t r = 0; r < 2; ++r) {
      const auto y = march.state(r);
      const double carbon = y[n + 1 + ParticlesAtRest::carbon], T = whole.block(exact.data(), r)[n];
      // What was booked is what the particles have.
      EXPECT_NEAR(system.density(y.data()) * carbon / (r == 0 ? first : second).carbon, 1, 1e-6) << r;
      // All that flows in has the elements of the start.
      EXPECT_LT(largestImbalance(elements(std::span(unknowns).first(system.blockSize())), elements(y)), 1e-12) << r;
      error = std::max({error, std::abs(y[n] / T - 1),
                        std::abs(carbon / (whole.block(exact.data(), r)[n + 1] * ToyPhase::unit) - 1)});
    }
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / error), 2, 0.4) << error;
    }
    last = error;
  }
  EXPECT_LT(last, 5e-3);
}

// Ensembles of particles of two sizes, of which nothing becomes of itself, in inert gas at given temperatures.
class FlowingEnsembles : public ::testing::TestWithParam<EnsembleMethod> {
 protected:
  static constexpr double number = 1e16;  // 1/m3
  const std::size_t repeats = test::fewOrMany<std::size_t>(6, 16);
  GasState gas = gasOf(ethylene(), 1500, "N2: 1");

  // Numbers and masses per m3 over those of the first reactor at the start, of each reactor; a sample each.
  [[nodiscard]] std::pair<std::vector<test::Sample>, std::vector<test::Sample>> march(const ReactorNetwork& network,
                                                                                      double end) const {
    const std::size_t count = network.reactors.size();
    std::vector<std::vector<double>> numbers(count), masses(count);
    for (std::size_t repeat = 0; repeat < repeats; ++repeat) {
      std::vector<std::unique_ptr<test::ReactorSoot>> ensembles;
      std::vector<SplitParticles*> particles;
      EnsembleOptions options;
      options.method = GetParam();
      options.particles = 200;
      options.soot.pah = {{"A2", 10, 8, 2e-3}};
      options.soot.inception = options.soot.condensation = options.soot.surfaceGrowth = false;
      options.soot.oxidation = options.soot.coagulation = false;
      for (std::size_t r = 0; r < count; ++r) {
        options.owner = repeat * count + r;
        ensembles.push_back(std::make_unique<test::ReactorSoot>(ethylene(), options));
        particles.push_back(ensembles.back().get());
        if (r > 0) continue;
        const auto full = makeEnsemble(options);
        std::vector<GivenParticle> given;
        for (std::size_t k = 0; k < 200; ++k) given.push_back({k < 150 ? 1e-22 : 7e-22, 1e-24, 1, number / 200});
        full->initialise(given);
        ensembles[0]->population().unpack(full->pack());
      }
      const double mass = ensembles[0]->ensemble().totals().mass();
      ParticlesAtRest atRest(count);
      NetworkSystem system(ethylene(), network, &atRest);
      SplitReactor::Options split;
      split.integrator = {1e-8, 1e-14, 0, 1000000};
      split.fixedStep = true;
      split.largestStep = end / 20;
      SplitReactor reactors(ethylene(), splitGas(system), particles, split);
      reactors.start(0, startUnknowns(ethylene(), network, {false, gas}, atRest.size()));
      reactors.advance(end);
      for (std::size_t r = 0; r < count; ++r) {
        const auto totals = ensembles[r]->ensemble().totals();
        numbers[r].push_back(totals.number / number);
        masses[r].push_back(totals.mass() / mass);
      }
    }
    std::pair<std::vector<test::Sample>, std::vector<test::Sample>> all;
    for (std::size_t r = 0; r < count; ++r) {
      all.first.push_back(test::summarise(numbers[r]));
      all.second.push_back(test::summarise(masses[r]));
    }
    return all;
  }

  // The solver's error of the marks, 1e-6, is added to the noise: where nothing is drawn there is none.
  void expectAt(const ReactorNetwork& network, double end, const std::vector<double>& exact) const {
    const auto [numbers, masses] = march(network, end);
    for (std::size_t r = 0; r < exact.size(); ++r)
      for (const test::Sample& sample : {numbers[r], masses[r]}) {
        EXPECT_LT(std::abs(sample.mean - exact[r]) / (sample.standardError + 1e-6 * exact[r]), test::zLimit)
            << r << ": " << sample.mean << " +- " << sample.standardError << ", exact " << exact[r];
        EXPECT_LT(std::abs(sample.mean / exact[r] - 1), 0.1) << r;
      }
  }
};

// n_r = n_0 (t/tau)^r e^(-t/tau) / r!, per kg; the third reactor is at half the density of the others.
using FlowingEnsemblesLong = FlowingEnsembles;

TEST_P(FlowingEnsemblesLong, StayInAChainAsLongAsItsGas) {
  const double tau = 1e-3, end = 1.3e-3, x = end / tau;
  const ReactorNetwork chain{gas.pressure,
                             {{"a", {}, tau, 1000, 0, 0}, {"b", {}, tau, 1000, 0, 0}, {"c", {}, tau, 2000, 0, 0}},
                             {{0, 1.0, 1000, gas.Y}},
                             {{0, 1, 1.0}, {1, 2, 1.0}}};
  expectAt(chain, end, {std::exp(-x), x * std::exp(-x), 0.5 * (0.5 * x * x) * std::exp(-x)});
}

// The second reactor is at half the density of the first. Per kg: a' = -a/t1 + (M21/m1) b, b' = (M12/m2) a - b/t2, with
// m1 = 2 t1 and m2 = 2 t2: eigenvalues and closed solution of two by two.
TEST_P(FlowingEnsembles, ComeBackByARecycle) {
  const ReactorNetwork network = recycle(gas, 1500, 3000);
  const double end = 1.2e-3, t1 = 1e-3, t2 = 5e-4;
  const double a11 = -1 / t1, a12 = 1 / (2 * t1), a21 = 1 / t2, a22 = -1 / t2;
  const double mean = 0.5 * (a11 + a22), root = std::sqrt(0.25 * (a11 - a22) * (a11 - a22) + a12 * a21);
  const double grown = std::exp(mean * end), c = std::cosh(root * end), s = std::sinh(root * end) / root;
  expectAt(network, end, {grown * (c + (a11 - mean) * s), 0.5 * grown * a21 * s});
}

INSTANTIATE_TEST_SUITE_P(Methods, FlowingEnsembles, ::testing::Values(EnsembleMethod::sammc));
INSTANTIATE_TEST_SUITE_P(Long, FlowingEnsembles, ::testing::Values(EnsembleMethod::dsmc, EnsembleMethod::swa));
INSTANTIATE_TEST_SUITE_P(Methods, FlowingEnsemblesLong,
                         ::testing::Values(EnsembleMethod::sammc, EnsembleMethod::dsmc, EnsembleMethod::swa));

}  // namespace
}  // namespace lampblack::coupling
