// Timings of the transport models on random states, GRI-Mech 3.0 (53 species); one call is one
// state. Construction on the smallest and the largest mechanism.
//
//   build/release/tests/bench/transport_bench --benchmark_repetitions=9      (configured with -DLAMPBLACK_BENCH=ON)
#include <benchmark/benchmark.h>

#include <vector>

#include "chemistry/transport/multicomponent_transport.hpp"
#include "chemistry/transport/transport.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;

Mechanism mechanismOf(const char* file) {
  return Mechanism::fromFile(test::sourcePath(std::string("cases/mechanisms/") + file));
}

struct States {
  Mechanism mechanism = mechanismOf("methane_gri30_53.yaml");
  std::vector<double> T, p;
  std::vector<std::vector<double>> X;

  States() {
    const test::Table table("transport_gri30_states.csv");
    for (std::size_t s = 0; s < table.size(); ++s) {
      T.push_back(table.number(s, "T"));
      p.push_back(table.number(s, "p"));
      X.push_back(table.moleFractions(s, mechanism));
    }
  }
};

const States& states() {
  static const States result;
  return result;
}

// work(transport, T, p, X, D), a new state every time
template <class Model, class Work>
void perState(benchmark::State& state, Work&& work) {
  const auto& s = states();
  Model transport(s.mechanism);
  std::vector<double> D(s.mechanism.numSpecies() * s.mechanism.numSpecies());
  std::size_t i = 0;
  for (auto _ : state) {
    work(transport, s.T[i], s.p[i], s.X[i], D);
    benchmark::DoNotOptimize(D.data());
    benchmark::ClobberMemory();
    i = (i + 1) % s.T.size();
  }
}

void mixtureAveraged(benchmark::State& state) {
  perState<Transport>(state, [](auto& transport, double T, double p, auto& X, auto& D) {
    benchmark::DoNotOptimize(transport.mixture(T, p, X, D));
  });
}
BENCHMARK(mixtureAveraged)->Unit(benchmark::kMicrosecond);

void mixtureAveragedMassBasis(benchmark::State& state) {
  perState<Transport>(
      state, [](auto& transport, double T, double p, auto& X, auto& D) { transport.massDiffusion(T, p, X, D); });
}
BENCHMARK(mixtureAveragedMassBasis)->Unit(benchmark::kMicrosecond);

void mixtureAveragedThermalDiffusion(benchmark::State& state) {
  perState<Transport>(
      state, [](auto& transport, double T, double p, auto& X, auto& D) { transport.thermalDiffusion(T, p, X, D); });
}
BENCHMARK(mixtureAveragedThermalDiffusion)->Unit(benchmark::kMicrosecond);

void multicomponent(benchmark::State& state) {
  perState<MulticomponentTransport>(state, [](auto& transport, double T, double p, auto& X, auto& D) {
    benchmark::DoNotOptimize(transport.mixture(T, p, X, D));
  });
}
BENCHMARK(multicomponent)->Unit(benchmark::kMicrosecond);

void multicomponentDiffusion(benchmark::State& state) {
  perState<MulticomponentTransport>(
      state, [](auto& transport, double T, double p, auto& X, auto& D) { transport.diffusion(T, p, X, D); });
}
BENCHMARK(multicomponentDiffusion)->Unit(benchmark::kMicrosecond);

// Fluxes of the gradients that a mixture of a quarter more of every other species would have, a millimetre away.
template <bool WithHeat>
void multicomponentFluxes(benchmark::State& state) {
  std::vector<double> gradient(states().mechanism.numSpecies()), j(gradient.size());
  perState<MulticomponentTransport>(state, [&](auto& transport, double T, double p, auto& X, auto& D) {
    double sum = 0;
    for (std::size_t k = 0; k < X.size(); ++k) sum += gradient[k] = k % 2 == 0 ? 250 * X[k] : 0;
    for (std::size_t k = 0; k < X.size(); ++k) gradient[k] -= sum * X[k];
    if (WithHeat) benchmark::DoNotOptimize(transport.mixture(T, p, X, D));
    transport.diffusionFluxes(T, p, X, gradient, j);
    benchmark::DoNotOptimize(j.data());
  });
}
BENCHMARK(multicomponentFluxes<true>)->Unit(benchmark::kMicrosecond);
BENCHMARK(multicomponentFluxes<false>)->Unit(benchmark::kMicrosecond);

void construction(benchmark::State& state, const char* file) {
  const auto mechanism = mechanismOf(file);
  for (auto _ : state) {
    Transport transport(mechanism);
    benchmark::DoNotOptimize(transport);
  }
}
BENCHMARK_CAPTURE(construction, species10, "hydrogen_h2o2_10.yaml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(construction, species53, "methane_gri30_53.yaml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(construction, species202, "ethylene_km2_202.yaml")->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
