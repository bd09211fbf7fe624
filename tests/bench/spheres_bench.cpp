// Cost of aggregates of spheres in space: collisions a second, lines drawn for one, shadows, sintering.
#include <benchmark/benchmark.h>

#include <vector>

#include "particles/spheres/sphere_measures.hpp"
#include "particles/spheres/sphere_sintering.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::particles;

// Some aggregates of so many spheres, from pairs of clusters as equal as can be.
std::vector<SphereAggregate> aggregatesOf(std::size_t spheres) {
  RandomStream random(1, spheres, 0);
  BallisticJoining joining;
  const auto of = [&](std::size_t n, const auto& self) -> SphereAggregate {
    if (n == 1) return SphereAggregate(1);
    return joining.join(self(n / 2, self), self(n - n / 2, self), random);
  };
  std::vector<SphereAggregate> all;
  for (int k = 0; k < 8; ++k) all.push_back(of(spheres, of));
  return all;
}

// Two aggregates of range(0) spheres each become one.
void collisions(benchmark::State& state) {
  const std::vector<SphereAggregate> all = aggregatesOf(static_cast<std::size_t>(state.range(0)));
  RandomStream random(2, 0, 0);
  BallisticJoining joining;
  std::size_t k = 0;
  for (auto _ : state) {
    ++k;
    benchmark::DoNotOptimize(joining.join(all[k % 8], all[(k / 8 + k) % 8], random));
  }
  const auto count = static_cast<double>(state.iterations());
  state.counters["collisions"] = benchmark::Counter(count, benchmark::Counter::kIsRate);
  state.counters["lines"] = static_cast<double>(joining.tries()) / count;
}
BENCHMARK(collisions)->Arg(1)->Arg(10)->Arg(100)->Arg(1000);

// Its area from three sides, which a population asks for after each collision.
void shadows(benchmark::State& state) {
  const std::vector<SphereAggregate> all = aggregatesOf(static_cast<std::size_t>(state.range(0)));
  std::size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(shadowAlongAxes(all[++k % 8]));
}
BENCHMARK(shadows)->Arg(10)->Arg(100)->Arg(1000);

// From point contact to necks of half the radius, by grain boundaries.
void sintering(benchmark::State& state) {
  const std::vector<SphereAggregate> all = aggregatesOf(static_cast<std::size_t>(state.range(0)));
  SphereSintering sinter({SinteringMechanism::grainBoundary, 1.0 / 16, 0, 0});
  std::size_t k = 0;
  for (auto _ : state) {
    SphereAggregate one = all[++k % 8];
    sinter.advance(one, 1, 6e-3);
    benchmark::DoNotOptimize(one);
  }
  state.counters["steps"] = static_cast<double>(sinter.steps()) / static_cast<double>(state.iterations());
}
BENCHMARK(sintering)->Arg(10)->Arg(100)->Arg(1000);

}  // namespace

BENCHMARK_MAIN();
