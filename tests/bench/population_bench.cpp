// Monte Carlo of the population balance: coagulation events per second with the free-molecular kernel against the
// number of particles, and the cases of Wang (2025) for which it gives times (200 repeats, 2000 particles).
#include <benchmark/benchmark.h>

#include "particles/population/monte_carlo_options.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;
using Distribution = InitialPopulation::Distribution;

PopulationModel soot() {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = CollisionKernelType::freeMolecular;
  model.coagulation->gas.temperature = 1800;
  return model;
}
constexpr InitialPopulation nuclei{Distribution::monodisperse, 1e18, 4.2e-27, 1};

// range(0) particles, from nuclei until each particle has about 1000 of them: ten doublings.
void coagulation(benchmark::State& state, MonteCarloMethod method) {
  MonteCarloOptions options;
  options.method = method;
  options.particles = static_cast<std::size_t>(state.range(0));
  double bytes = 0, events = 0, attempts = 0;
  for (auto _ : state) {
    state.PauseTiming();
    ++options.repeat;
    const auto solver = makeMonteCarlo(soot(), nuclei, options);
    // Past the first doublings, where all particles are alike.
    double end = 1e-3;
    solver->advance(end);
    const double before = static_cast<double>(solver->counters().coagulations);
    const double failed = static_cast<double>(solver->counters().fictitious);
    state.ResumeTiming();
    while (solver->counters().coagulations < static_cast<std::uint64_t>(before) + 5 * options.particles) {
      solver->advance(end *= 1.1);
      bytes = std::max(bytes, static_cast<double>(solver->bytes()));
    }
    state.PauseTiming();
    events += static_cast<double>(solver->counters().coagulations) - before;
    attempts += static_cast<double>(solver->counters().fictitious) - failed;
    state.ResumeTiming();
  }
  state.counters["events/s"] = benchmark::Counter(events, benchmark::Counter::kIsRate);
  state.counters["bytes/particle"] = bytes / static_cast<double>(options.particles);
  state.counters["fictitious/event"] = attempts / events;
}

struct Case {
  PopulationModel model;
  InitialPopulation initial;
  double end = 0;
  int outputs = 50;
};

Case wangCase(int number) {
  Case result;
  result.initial = {Distribution::monodisperse, 1, 1, 1};
  PopulationModel& model = result.model;
  const auto nucleates = [&] {
    model.nucleation.emplace();
    return &*model.nucleation;
  };
  if (number == 1) {
    NucleationOptions* nucleation = nucleates();
    nucleation->source = NucleationOptions::Source::precursor;
    nucleation->rateConstant = 5e-6;
    nucleation->precursor = 1e5;
    result.initial.number = 3000;
    result.end = 10 / 5e-6;
  } else if (number == 5) {
    model.breakage = BreakageOptions{1, 1, 2, BreakageOptions::Daughters::equal};
    result.initial.number = 3000;
    result.end = 50;
  } else {
    model.coagulation.emplace();
    model.coagulation->rate = 1;
    result.end = 50;
    if (number == 9) {
      NucleationOptions* nucleation = nucleates();
      nucleation->rate = 1;
      nucleation->volume = 1;
    }
  }
  return result;
}

// All 200 repeats of a case, with moments at 50 times.
void wang(benchmark::State& state, MonteCarloMethod method, int number) {
  const Case chosen = wangCase(number);
  MonteCarloOptions options;
  options.method = method;
  double events = 0, sum = 0;
  for (auto _ : state) {
    for (options.repeat = 0; options.repeat < 200; ++options.repeat) {
      const auto solver = makeMonteCarlo(chosen.model, chosen.initial, options);
      for (int output = 1; output <= chosen.outputs; ++output) {
        solver->advance(chosen.end * output / chosen.outputs);
        sum += solver->moments()[2];
      }
      events += static_cast<double>(solver->counters().events());
    }
  }
  benchmark::DoNotOptimize(sum);
  state.counters["events"] = benchmark::Counter(events, benchmark::Counter::kAvgIterations);
  state.counters["events/s"] = benchmark::Counter(events, benchmark::Counter::kIsRate);
}

constexpr auto byMass = MonteCarloMethod::constantNumberByMass;
constexpr auto byNumber = MonteCarloMethod::constantNumberByNumber;
constexpr auto constantVolume = MonteCarloMethod::constantVolume;

BENCHMARK_CAPTURE(coagulation, dsmc, MonteCarloMethod::dsmc)->RangeMultiplier(10)->Range(1000, 1000000);
BENCHMARK_CAPTURE(coagulation, constantNumberByMass, byMass)->RangeMultiplier(10)->Range(1000, 1000000);
BENCHMARK_CAPTURE(wang, case1_constantVolume, constantVolume, 1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wang, case1_constantNumberByMass, byMass, 1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wang, case1_constantNumberByNumber, byNumber, 1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wang, case2_constantVolume, constantVolume, 2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wang, case2_constantNumberByMass, byMass, 2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wang, case2_constantNumberByNumber, byNumber, 2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wang, case5_constantVolume, constantVolume, 5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wang, case5_constantNumberByMass, byMass, 5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wang, case5_constantNumberByNumber, byNumber, 5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wang, case9_constantVolume, constantVolume, 9)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wang, case9_constantNumberByMass, byMass, 9)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
