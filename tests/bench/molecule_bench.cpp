// Cost of molecules that grow site by site: events a second, and memory.
#include <benchmark/benchmark.h>

#include "core/constants.hpp"
#include "particles/pah/molecule_growth.hpp"
#include "particles/pah/named_molecules.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::particles;

// All processes of set R1 at a temperature and 1 atm.
PahRates ratesAt(double temperature, double acetylene) {
  const double total = constants::oneAtmosphere / (constants::gasConstant * temperature);
  return pahRates({}, temperature, std::vector<double>{0.01 * total, 0.1 * total, 0, 0, 0, acetylene * total});
}

// Molecules that grow from pyrene to range(0) rings and begin anew: events, the void ones too.
void growth(benchmark::State& state) {
  const PahRates rates = ratesAt(1500, 0.1);
  const Molecule start(namedMolecule("pyrene"));
  std::uint64_t events = 0, repeat = 0;
  std::size_t bytes = 0;
  for (auto _ : state) {
    MoleculeGrowth one(start, RandomStream(1, repeat++, 0), static_cast<std::size_t>(state.range(0)));
    (void)one.advance(rates, 1, 1000000);
    for (std::size_t p = 0; p < pahProcessCount; ++p) events += one.events()[p] + one.voids()[p];
    bytes = one.molecule().bytes();
  }
  state.counters["events"] = benchmark::Counter(static_cast<double>(events), benchmark::Counter::kIsRate);
  state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(growth)->Arg(10)->Arg(30)->Arg(100)->Arg(1000);

// A molecule of the size that losses and growth leave it.
void stationary(benchmark::State& state) {
  const PahRates rates = ratesAt(2100, 0.001);
  MoleculeGrowth one(Molecule(namedMolecule("naphthalene")), RandomStream(1, 0, 0));
  for (auto _ : state) benchmark::DoNotOptimize(one.advance(rates, 1e9, 1000));
  state.counters["events"] =
      benchmark::Counter(1000.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(stationary);

}  // namespace

BENCHMARK_MAIN();
