// Cost of the soot models: a cell of the two-equation model, and coagulation events of stochastic soot.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "particles/ensemble/ensemble.hpp"
#include "particles/models/two_equation/dimer_soot.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;

// At one atmosphere, with naphthalene.
struct Flame {
  std::vector<double> concentrations;
  ParticleGas gas;
  explicit Flame(double pahFraction) : concentrations{1e-3, 0.03, 1e-4, 0.08, 1e-4, 0.03, 0, pahFraction} {
    const double T = 1700, c = constants::oneAtmosphere / (constants::gasConstant * T);
    for (double& x : concentrations) x *= c;
    gas = {{T, constants::oneAtmosphere, 0.028 * c, 6e-5, 0.028}, concentrations};
  }
  Flame(const Flame&) = delete;
  Flame& operator=(const Flame&) = delete;
};

SootModelOptions naphthalene() {
  SootModelOptions options;
  options.pah = {{"A2", 10, 8, 2.0e-3}};
  return options;
}

// One cell over range(0) nanoseconds; the population and gas are put back every time.
void twoEquationAdvance(benchmark::State& state) {
  const Flame flame(2e-5);
  const DimerSoot model(naphthalene());
  const double dt = 1e-9 * static_cast<double>(state.range(0));
  std::vector<double> cell, soot;
  for (auto _ : state) {
    cell = flame.concentrations;
    soot = {1e17, 2e-4, 6e-6};
    benchmark::DoNotOptimize(model.advance(flame.gas, dt, soot, cell));
    benchmark::DoNotOptimize(soot.data());
  }
}
BENCHMARK(twoEquationAdvance)->Arg(1000)->Arg(10000)->Arg(100000);

void twoEquationSources(benchmark::State& state) {
  const Flame flame(2e-5);
  const TwoEquationSoot model(naphthalene());
  for (auto _ : state) benchmark::DoNotOptimize(model.sources(flame.gas, {1e17, 2e-4, 6e-6}));
}
BENCHMARK(twoEquationSources);

// Coagulation alone from equal spheres, until an eighth of the number is left: real events a second.
void coagulation(benchmark::State& state, CollisionKernelType kernel) {
  const Flame flame(0);
  EnsembleOptions options;
  options.particles = static_cast<std::size_t>(state.range(0));
  options.kernel.type = kernel;
  options.soot = naphthalene();
  options.soot.surfaceGrowth = options.soot.oxidation = false;
  const std::vector<GivenParticle> spheres(options.particles,
                                           {0.96e-23, 0.04e-23, 1, 1e18 / static_cast<double>(options.particles)});
  double events = 0;
  for (auto _ : state) {
    const auto soot = makeEnsemble(options);
    soot->initialise(spheres);
    soot->advance(flame.gas, 0, 3e-3);
    events += static_cast<double>(soot->counters().coagulations);
  }
  state.counters["events/s"] = benchmark::Counter(events, benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(coagulation, freeMolecular, CollisionKernelType::freeMolecular)->Arg(1000)->Arg(10000)->Arg(100000);
BENCHMARK_CAPTURE(coagulation, transition, CollisionKernelType::transition)->Arg(1000)->Arg(10000)->Arg(100000);

// Everything on, from nothing, over 2 ms of a sooting gas: jumps (real, fictitious and inceptions) a second.
void sootingGas(benchmark::State& state, EnsembleMethod method) {
  const Flame flame(2e-5);
  EnsembleOptions options;
  options.method = method;
  options.particles = static_cast<std::size_t>(state.range(0));
  options.soot = naphthalene();
  double jumps = 0;
  for (auto _ : state) {
    const auto soot = makeEnsemble(options);
    soot->advance(flame.gas, 0, 2e-3);
    const auto& c = soot->counters();
    jumps += static_cast<double>(c.coagulations + c.fictitious + c.nucleations);
  }
  state.counters["jumps/s"] = benchmark::Counter(jumps, benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(sootingGas, dsmc, EnsembleMethod::dsmc)->Arg(1000)->Arg(10000);
BENCHMARK_CAPTURE(sootingGas, sammc, EnsembleMethod::sammc)
    ->Arg(500)
    ->Arg(1000)
    ->Arg(2000)
    ->Arg(4000)
    ->Arg(8000)
    ->Arg(10000);

// Accuracy, not time: relative error of number and carbon after two steps of 0.1 ms, at a tolerance of range(0) 1e-5.
void twoEquationAccuracy(benchmark::State& state) {
  const Flame flame(2e-5);
  const auto run = [&](double tolerance) {
    DimerSoot model(naphthalene());
    model.setAdvanceTolerance(tolerance);
    std::vector<double> cell = flame.concentrations, soot{1e17, 2e-5, 6e-7};
    for (int k = 0; k < 2; ++k) model.advance(flame.gas, 1e-4, soot, cell);
    return soot;
  };
  const auto exact = run(1e-8);
  std::vector<double> soot;
  for (auto _ : state) soot = run(1e-5 * static_cast<double>(state.range(0)));
  state.counters["number"] = std::abs(soot[DimerSoot::number] / exact[DimerSoot::number] - 1);
  state.counters["carbon"] = std::abs(soot[DimerSoot::carbon] / exact[DimerSoot::carbon] - 1);
}
BENCHMARK(twoEquationAccuracy)->Arg(10)->Arg(100)->Arg(1000);

// Accuracy: mean and standard error over range(1) repeats of the sooting gas at a splitting tolerance of range(0) 1e-4.
void splittingAccuracy(benchmark::State& state, EnsembleMethod method) {
  const Flame flame(2e-5);
  EnsembleOptions options;
  options.method = method;
  options.particles = 1024;
  options.soot = naphthalene();
  options.splitTolerance = 1e-4 * static_cast<double>(state.range(0));
  const int repeats = static_cast<int>(state.range(1));
  double number = 0, squares = 0, volume = 0;
  for (auto _ : state) {
    for (int repeat = 0; repeat < repeats; ++repeat) {
      options.owner = static_cast<std::uint64_t>(repeat);
      const auto soot = makeEnsemble(options);
      soot->advance(flame.gas, 0, 2e-3);
      number += soot->totals().number / repeats;
      squares += std::pow(soot->totals().number, 2) / repeats;
      volume += soot->volumeFraction() / repeats;
    }
  }
  state.counters["number"] = number;
  state.counters["error"] = std::sqrt((squares - number * number) / repeats);
  state.counters["fv"] = volume;
}
BENCHMARK_CAPTURE(splittingAccuracy, dsmc, EnsembleMethod::dsmc)->ArgsProduct({{2000, 500, 125}, {400}})->Iterations(1);
BENCHMARK_CAPTURE(splittingAccuracy, pairs, EnsembleMethod::pairs)
    ->ArgsProduct({{4000, 2000, 1000, 500}, {1500}})
    ->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
