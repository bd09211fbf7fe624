// Time to load a mechanism file, from 9 to 202 species.
//
//   build/release/tests/bench/mechanism_bench      (configured with -DLAMPBLACK_BENCH=ON)
#include <benchmark/benchmark.h>

#include <string>

#include "chemistry/mechanism/mechanism.hpp"
#include "tests/chemistry/table.hpp"

namespace {

void load(benchmark::State& state, const std::string& name) {
  const auto path = lampblack::test::sourcePath("cases/mechanisms/" + name);
  for (auto _ : state) {
    const auto mechanism = lampblack::chemistry::Mechanism::fromFile(path);
    state.counters["species"] = static_cast<double>(mechanism.numSpecies());
    state.counters["reactions"] = static_cast<double>(mechanism.numReactions());
  }
}

BENCHMARK_CAPTURE(load, hydrogen, "hydrogen_sandiego_9.yaml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load, gri30, "methane_gri30_53.yaml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load, narayanaswamy, "ethylene_narayanaswamy2010_158.yaml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load, km2, "ethylene_km2_202.yaml")->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
