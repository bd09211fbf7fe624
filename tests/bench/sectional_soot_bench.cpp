// Cost of the sectional soot model at one point: sources, analytic Jacobian, diffusivities.
#include <benchmark/benchmark.h>

#include "tests/every_module.hpp"
#include "tests/particles/models/sectional/sectional_soot_fixtures.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;

struct Point {
  SectionalSoot model;
  test::SectionGas gas{1650, test::sooting({1e-6})};
  std::vector<double> y = test::randomState(model, 1);
  explicit Point(const SectionalSootOptions& options) : model(options) {}
};

SectionalSootOptions optionsOf(const benchmark::State& state) {
  SectionalSootOptions options = test::pyrene();
  options.sections = static_cast<std::size_t>(state.range(0));
  if (options.sections > 35) options.factor = 1.4;
  if (state.range(1) == 1) options.nucleation = SectionalSootOptions::Nucleation::dimer;
  if (state.range(2) == 1) options.aggregation = SectionalSootOptions::Aggregation::spheres;
  return options;
}

void sources(benchmark::State& state) {
  const Point point(optionsOf(state));
  std::vector<double> rates(point.y.size()), exchange(point.gas.concentrations.size());
  for (auto _ : state) {
    point.model.sources(point.gas.gas, point.y, rates, exchange);
    benchmark::DoNotOptimize(rates.data());
  }
}
void jacobian(benchmark::State& state) {
  const Point point(optionsOf(state));
  const std::size_t rows = point.y.size() + point.gas.concentrations.size();
  std::vector<double> values(rows * (rows + 1));
  for (auto _ : state) {
    point.model.jacobian(point.gas.gas, point.y, values);
    benchmark::DoNotOptimize(values.data());
  }
}
void diffusivities(benchmark::State& state) {
  const Point point(optionsOf(state));
  std::vector<double> D(point.y.size());
  for (auto _ : state) {
    point.model.diffusivities(point.gas.gas, point.y, D);
    benchmark::DoNotOptimize(D.data());
  }
}

// Sections; dimers; spheres.
void variants(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"sections", "dimers", "spheres"})
      ->Args({35, 0, 0})
      ->Args({35, 1, 0})
      ->Args({35, 0, 1})
      ->Args({70, 0, 0});
  bench->Unit(benchmark::kMicrosecond);
}
BENCHMARK(sources)->Apply(variants);
BENCHMARK(jacobian)->Apply(variants);
BENCHMARK(diffusivities)->Apply(variants);

}  // namespace

BENCHMARK_MAIN();
