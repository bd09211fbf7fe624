// Time of an equilibrium at constant enthalpy and pressure, from nothing known but the mixture.
//
//   build/release/tests/bench/equilibrium_bench      (configured with -DLAMPBLACK_BENCH=ON)
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "chemistry/thermo/equilibrium.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/every_module.hpp"
#include "tests/source_folder.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;

void adiabaticFlame(benchmark::State& state, const char* file, const char* composition, double T) {
  const auto mechanism = Mechanism::fromFile(test::sourcePath(std::string("cases/mechanisms/") + file));
  const Thermo thermo(mechanism);
  Equilibrium equilibrium(mechanism);
  std::vector<double> Y(mechanism.numSpecies());
  thermo.moleToMass(parseComposition(mechanism, composition), Y);
  const std::vector<double> fresh = Y;
  const double h = thermo.enthalpyMass(T, fresh);
  for (auto _ : state) {
    Y = fresh;
    benchmark::DoNotOptimize(equilibrium.atEnthalpyAndPressure(h, constants::oneAtmosphere, Y));
  }
  state.counters["iterations"] = static_cast<double>(equilibrium.iterations());
}

BENCHMARK_CAPTURE(adiabaticFlame, hydrogen_air, "hydrogen_h2o2_10.yaml", "H2:2, O2:1, N2:3.76", 1200);
BENCHMARK_CAPTURE(adiabaticFlame, methane_air, "methane_gri30_53.yaml", "CH4:1, O2:2, N2:7.52", 1400);
BENCHMARK_CAPTURE(adiabaticFlame, rich_ethylene_air, "ethylene_km2_202.yaml", "C2H4:1, O2:1, N2:3.76", 300);

}  // namespace

BENCHMARK_MAIN();
