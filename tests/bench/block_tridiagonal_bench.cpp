// Timings of the Newton matrix of a flame of 200 points with one unknown of the whole flame: methane (56 unknowns a
// point), ethylene (104), and ethylene with 35 sections of soot of two variables each (180).
//
//   build/release/tests/bench/block_tridiagonal_bench --benchmark_repetitions=9   (configured with
//   -DLAMPBLACK_BENCH=ON)
#include <benchmark/benchmark.h>
#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "numerics/block_tridiagonal.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;

constexpr std::size_t points = 200, border = 1;

// Blocks as mixture-averaged diffusion makes them: every species reacts with every other, neighbours couple each
// species with itself and, by temperature and by the sum of the fluxes, with a few others; `sections` couple to their
// own neighbours and to temperature only.
struct FlameMatrix {
  std::size_t n, sections;
  std::vector<double> lower, diagonal, upper, columns;

  FlameMatrix(std::size_t width, std::size_t numSections) : n(width), sections(numSections) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> entry(-1, 1);
    const std::size_t gas = n - sections;
    for (auto* block : {&lower, &diagonal, &upper}) block->resize(n * n);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        diagonal[j * n + i] = entry(random) + (i == j ? 4.0 * static_cast<double>(n) : 0);
        const bool couples = i == j || j < 3 || (i < gas && j < gas);
        lower[j * n + i] = couples ? entry(random) : 0;
        upper[j * n + i] = couples ? entry(random) : 0;
      }
    columns.assign(n, 1.0);
  }

  void fill(BlockTridiagonal& A) const {
    A.clear();
    for (std::size_t i = A.ownedBegin(); i < A.ownedEnd(); ++i) {
      if (i > 0) std::copy(lower.begin(), lower.end(), A.lower(i).entries());
      std::copy(diagonal.begin(), diagonal.end(), A.diagonal(i));
      if (i + 1 < points) std::copy(upper.begin(), upper.end(), A.upper(i).entries());
      std::copy(columns.begin(), columns.end(), A.borderColumns(i));
      if (i == points / 3) A.borderRows(i)[n / 2] = 1;
    }
  }
};

void fill(benchmark::State& timer) {
  const FlameMatrix matrix(static_cast<std::size_t>(timer.range(0)), static_cast<std::size_t>(timer.range(1)));
  BlockTridiagonal A(MPI_COMM_WORLD, points, matrix.n, border);
  for (auto _ : timer) matrix.fill(A);
}

void factorise(benchmark::State& timer) {
  const FlameMatrix matrix(static_cast<std::size_t>(timer.range(0)), static_cast<std::size_t>(timer.range(1)));
  BlockTridiagonal A(MPI_COMM_WORLD, points, matrix.n, border);
  for (auto _ : timer) {
    timer.PauseTiming();
    matrix.fill(A);
    timer.ResumeTiming();
    if (!A.factorise()) timer.SkipWithError("singular");
  }
}

void solve(benchmark::State& timer) {
  const FlameMatrix matrix(static_cast<std::size_t>(timer.range(0)), static_cast<std::size_t>(timer.range(1)));
  BlockTridiagonal A(MPI_COMM_WORLD, points, matrix.n, border);
  matrix.fill(A);
  if (!A.factorise()) timer.SkipWithError("singular");
  std::vector<double> b(A.size());
  for (auto _ : timer) {
    std::fill(b.begin(), b.end(), 1.0);
    A.solve(b);
    benchmark::DoNotOptimize(b.data());
  }
}

void flames(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"width", "sections"})->Args({56, 0})->Args({104, 0})->Args({180, 70})->Unit(benchmark::kMillisecond);
}
BENCHMARK(fill)->Apply(flames);
BENCHMARK(factorise)->Apply(flames);
BENCHMARK(solve)->Apply(flames);

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  benchmark::Initialize(&argc, argv);
  const bool wrong = benchmark::ReportUnrecognizedArguments(argc, argv);
  if (!wrong) benchmark::RunSpecifiedBenchmarks();
  MPI_Finalize();
  return wrong ? 1 : 0;
}
