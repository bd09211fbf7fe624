// What a repeat of each Monte Carlo method costs for what it tells: time times variance of M0, M2, M6 and of the number
// in the largest bin of size, over the square of the mean, in five cases; and what sections cost and err by.
//
//   population_pairs_bench [start of a case's name [numbers of particles, with commas [repeats of 500 particles
//                          [a method [a probability of pairs]]]]]
//
// Times are of one core, CPU seconds, with what a repeat starts from. The largest bin holds what is above the volume
// beyond which the reference, 300 sections, has one thousandth of the number.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "particles/population/monte_carlo/shipped_types.hpp"
#include "particles/population/sectional/sectional_options.hpp"
#include "tests/bench/processor_time.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::particles;

constexpr double nanometre = 5.235987755982989e-28;  // m3, of a sphere of 1 nm

struct Case {
  std::string name;
  PopulationModel model;
  InitialPopulation initial;
  double end, expectedNumber;
  bool hasAggregates = false;
};

PopulationModel colliding(CollisionKernelType type) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = type;
  model.coagulation->gas = {1800, 101325, 0.2, 6e-5, 0.029};
  return model;
}

std::vector<Case> cases() {
  using enum CollisionKernelType;
  InitialPopulation equal;
  equal.distribution = InitialPopulation::Distribution::monodisperse;
  equal.number = 1e18;
  equal.volume = nanometre;
  InitialPopulation large = equal;
  large.volume = 1e6 * nanometre;
  PopulationModel burst = colliding(freeMolecular);
  burst.nucleation.emplace();
  burst.nucleation->rate = 1e22;
  burst.nucleation->volume = nanometre;
  PopulationModel growing = burst;
  growing.growth.surfaceGrowth = 3e-6;
  growing.growth.oxidation = 2e-6;
  growing.growth.smallestVolume = 0.1 * nanometre;
  PopulationModel aggregates = burst;
  aggregates.coagulation->type = transition;
  return {{"nucleation burst", burst, {}, 5e-3, 3e18},
          {"free molecular", colliding(freeMolecular), equal, 5e-2, 0},
          {"continuum", colliding(continuum), large, 0.1, 0},
          {"growth and oxidation", growing, {}, 2e-3, 3e18},
          {"aggregates", aggregates, {}, 2e-3, 1e18, true}};
}

constexpr std::size_t quantities = 4;
constexpr std::array<const char*, quantities> names{"M0", "M2", "M6", "largest"};

// M6 by bins of 4 % of volume.
std::array<double, quantities> outcome(const PopulationSolver& solver, const std::vector<double>& edges, double large) {
  const auto moments = solver.moments();
  const auto bins = solver.numberInBins(edges);
  double sixth = 0, above = 0;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    sixth += bins[b] * std::pow(std::sqrt(edges[b] * edges[b + 1]) / nanometre, 6);
    if (edges[b] >= large) above += bins[b];
  }
  return {moments[0], moments[2], sixth, above};
}

std::vector<double> edgesOf(const Case& c) {
  std::vector<double> edges{c.initial.number > 0 ? 0.5 * c.initial.volume : 0.05 * nanometre};
  while (edges.size() < 700) edges.push_back(edges.back() * 1.04);
  return edges;
}

void run(const Case& c, const std::vector<std::size_t>& numbers, double repeatsOf500, const std::string& onlyMethod,
         double probability) {
  const std::vector<double> edges = edgesOf(c);
  double large = edges[edges.size() / 2];
  fmt::print("{}\n", c.name);
  const auto sections = [&](std::size_t count) {
    SectionalOptions options;
    options.sections = count;
    options.smallest = c.initial.number > 0 ? c.initial.volume : 0.1 * nanometre;
    options.largest = edges.back();
    const double from = bench::processorSeconds();
    auto solver = makeSectional(c.model, c.initial, options);
    solver->advance(c.end);
    return std::pair{std::move(solver), bench::processorSeconds() - from};
  };
  std::array<double, quantities> reference{};
  if (!c.hasAggregates) {
    const auto [solver, seconds] = sections(300);
    const auto bins = solver->numberInBins(edges);
    double above = 0;
    std::size_t b = bins.size();
    while (b > 0 && above < 1e-3 * solver->moments()[0]) above += bins[--b];
    large = edges[b];
    reference = outcome(*solver, edges, large);
    fmt::print("  300 sections {:.4g} s: M0 {:.4g}, M2 {:.4g}\n", seconds, reference[0], reference[1]);
    for (const std::size_t count : {40u, 80u}) {
      const auto [coarse, time] = sections(count);
      const auto result = outcome(*coarse, edges, large);
      fmt::print("  {:>4} sections {:9.4g} ms", count, 1e3 * time);
      for (std::size_t q = 0; q < quantities; ++q)
        fmt::print("  {} off by {:6.2f} %", names[q], 100 * (result[q] / reference[q] - 1));
      fmt::print("\n");
    }
  } else {
    large = 200 * nanometre;
  }
  fmt::print("  {:>7} {:>7} {:>8} {:>10}", "N", "method", "repeats", "ms/repeat");
  for (const char* name : names) fmt::print(" {:>12} {:>8} {:>10}", fmt::format("{} mean", name), "sd %", "ms var");
  fmt::print("\n");
  using enum MonteCarloMethod;
  for (const std::size_t n : numbers) {
    for (const auto& [method, name] : {std::pair{pairs, "pairs"}, {sammc, "sammc"}, {swa, "swa"}, {dsmc, "dsmc"}}) {
      if (!std::string(name).starts_with(onlyMethod)) continue;
      const auto repeats =
          std::max<std::uint64_t>(24, static_cast<std::uint64_t>(repeatsOf500 * 500 / static_cast<double>(n)));
      std::array<double, quantities> sum{}, squares{};
      double seconds = 0;
      for (std::uint64_t repeat = 0; repeat < repeats; ++repeat) {
        MonteCarloOptions options;
        options.method = method;
        options.particles = n;
        options.pairProbability = probability;
        options.repeat = repeat;
        options.expectedNumber = c.initial.number > 0 ? 0 : c.expectedNumber;
        const double from = bench::processorSeconds();
        const auto solver = c.hasAggregates ? makeMonteCarlo(SurfaceVolume(1800), c.model, c.initial, options)
                                            : makeMonteCarlo(Sphere(1800), c.model, c.initial, options);
        solver->advance(c.end);
        seconds += bench::processorSeconds() - from;
        const auto result = outcome(*solver, edges, large);
        for (std::size_t q = 0; q < quantities; ++q) {
          sum[q] += result[q];
          squares[q] += result[q] * result[q];
        }
      }
      const auto count = static_cast<double>(repeats);
      const double milliseconds = 1e3 * seconds / count;
      fmt::print("  {:>7} {:>7} {:>8} {:>10.4g}", n, name, repeats, milliseconds);
      for (std::size_t q = 0; q < quantities; ++q) {
        const double mean = sum[q] / count;
        const double variance = std::max(0.0, squares[q] / count / (mean * mean) - 1) * count / (count - 1);
        fmt::print(" {:>12.4g} {:>8.3g} {:>10.3g}", mean, 100 * std::sqrt(variance), milliseconds * variance);
      }
      fmt::print("\n");
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  std::vector<std::size_t> numbers;
  std::stringstream list(argc > 2 ? argv[2] : "100,500,2000");
  for (std::string item; std::getline(list, item, ',');) numbers.push_back(std::stoul(item));
  for (const Case& c : cases())
    if (c.name.starts_with(only))
      run(c, numbers, argc > 3 ? std::stod(argv[3]) : 200, argc > 4 ? argv[4] : "",
          argc > 5 ? std::stod(argv[5]) : MonteCarloOptions{}.pairProbability);
  return 0;
}
