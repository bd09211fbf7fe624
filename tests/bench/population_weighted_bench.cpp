// Speed of the methods with different weights: events per second against the number of numerical particles, and the
// cases of chapter 5 of Wang (2025) with 2000 numerical particles and 200 repeats.
//
//   population_weighted_bench [events | cases [start of a name [number of particles of events]]]

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "particles/population/monte_carlo_options.hpp"
#include "tests/bench/processor_time.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;

struct Case {
  std::string name;
  PopulationModel model;
  InitialPopulation initial;
  MonteCarloOptions options;
  double end;
};

PopulationModel freeMolecular() {
  PopulationModel model;
  CollisionKernelOptions kernel;
  kernel.type = CollisionKernelType::freeMolecular;
  kernel.gas = {1500, 101325, 0.2, 5e-5, 0.029};
  model.coagulation = kernel;
  return model;
}

PopulationModel constant(double rate) {
  PopulationModel model;
  CollisionKernelOptions kernel;
  kernel.rate = rate;
  model.coagulation = kernel;
  return model;
}

InitialPopulation population(InitialPopulation::Distribution distribution, double number, double volume) {
  InitialPopulation initial;
  initial.distribution = distribution;
  initial.number = number;
  initial.volume = volume;
  return initial;
}

std::string only;               // what starts so is run
std::size_t onlyParticles = 0;  // zero: all

// Coagulation of populations that have coagulated for a while: from one event to ten events a particle, one population
// after the other until there were a million events and two a particle. (A population of a thousand that goes on for a
// million events has weights beyond the range of numbers.)
void events(const std::string& name, const PopulationModel& model, const InitialPopulation& initial,
            MonteCarloOptions options) {
  if (!name.starts_with(only)) return;
  fmt::print("{}\n  {:>9} {:>12} {:>12} {:>10} {:>10} {:>8}\n", name, "N", "events/s", "ns/event", "attempts",
             "bytes/N", "merges");
  for (const std::size_t n : {1000u, 10000u, 100000u, 1000000u}) {
    if (onlyParticles != 0 && n != onlyParticles) continue;
    options.particles = n;
    const std::uint64_t least = std::max<std::uint64_t>(2 * n, 1000000);
    std::uint64_t done = 0, attempts = 0, merges = 0;
    double time = 0, bytes = 0;
    for (options.repeat = 0; done < least; ++options.repeat) {
      const auto solver = makeMonteCarlo(model, initial, options);
      const PopulationCounters& counters = solver->counters();
      double step = initial.volume < 1e-10 ? 1e-7 : 1e-3;
      const auto advanceTo = [&](std::uint64_t count, std::uint64_t most) {
        while (counters.events() < count) {
          const auto before = counters.events();
          solver->advance(solver->time() + step);
          if (counters.events() - before < most) step *= 1.5;
        }
      };
      advanceTo(n, n / 20);
      const PopulationCounters start = counters;
      const double from = bench::processorSeconds();
      advanceTo(start.events() + std::min<std::uint64_t>(9 * n, least - done), n / 20);
      time += bench::processorSeconds() - from;
      done += counters.events() - start.events();
      attempts += counters.events() + counters.fictitious - (start.events() + start.fictitious);
      merges += counters.merges - start.merges;
      bytes = std::max(bytes, static_cast<double>(solver->bytes()));
    }
    const auto count = static_cast<double>(done);
    fmt::print("  {:>9} {:>12.4g} {:>12.1f} {:>10.3f} {:>10.1f} {:>8.3f}\n", n, count / time, 1e9 * time / count,
               static_cast<double>(attempts) / count, bytes / static_cast<double>(n),
               static_cast<double>(merges) / count);
    std::fflush(stdout);
  }
}

void run(const Case& c) {
  if (!c.name.starts_with(only)) return;
  constexpr std::uint64_t repeats = 200;
  double m0 = 0;
  std::uint64_t count = 0, attempts = 0;
  const double from = bench::processorSeconds();
  for (std::uint64_t repeat = 0; repeat < repeats; ++repeat) {
    MonteCarloOptions options = c.options;
    options.repeat = repeat;
    const auto solver = makeMonteCarlo(c.model, c.initial, options);
    solver->advance(c.end);
    m0 += solver->moments()[0] / repeats;
    count += solver->counters().events();
    attempts += solver->counters().events() + solver->counters().fictitious;
  }
  const double time = bench::processorSeconds() - from;
  fmt::print("  {:<34} {:>8.3f} s {:>10} events/repeat {:>8.1f} ns/event {:>6.2f} attempts/event  M0/N0 {:.5g}\n",
             c.name, time, count / repeats, 1e9 * time / static_cast<double>(count),
             static_cast<double>(attempts) / static_cast<double>(count), m0 / c.initial.number);
}

void cases() {
  using Distribution = InitialPopulation::Distribution;
  using enum MonteCarloMethod;
  MonteCarloOptions mmcOptions, sammcOptions, fractions;
  mmcOptions.method = mmc;
  sammcOptions.method = sammc;
  fractions.method = sammc;
  fractions.fraction = FractionFunction::hyperbolic;
  fractions.fractionOf = FractionOf::weights;
  const auto with = [](MonteCarloOptions options, MonteCarloMethod method) {
    options.method = method;
    return options;
  };
  const auto mono = population(Distribution::monodisperse, 1e12, 1);
  const auto monoBreak = population(Distribution::monodisperse, 3000, 1);
  const auto expBreak = population(Distribution::exponential, 3000, 1);
  const PopulationModel coagulation = constant(1e-12);
  const auto breakage = [](double rate, double exponent, int fragments, BreakageOptions::Daughters daughters) {
    PopulationModel model;
    model.breakage = BreakageOptions{rate, exponent, fragments, daughters};
    return model;
  };
  using enum BreakageOptions::Daughters;
  PopulationModel nucleation;
  nucleation.nucleation.emplace();
  nucleation.nucleation->source = NucleationOptions::Source::precursor;
  nucleation.nucleation->rateConstant = 5e-6;
  nucleation.nucleation->precursor = 1e5;
  fmt::print("Wang 2025, chapter 5, 2000 numerical particles, 200 repeats\n");
  run({"1 sammc", nucleation, monoBreak, sammcOptions, 1e6});
  run({"2 mmc", coagulation, mono, mmcOptions, 50});
  run({"2 sammc", coagulation, mono, sammcOptions, 50});
  run({"3 sammc", coagulation, population(Distribution::exponential, 1e12, 1), sammcOptions, 20});
  run({"4 sammc", coagulation, mono, fractions, 50});
  run({"4 wfmc", coagulation, mono, with(fractions, wfmc), 50});
  run({"4 samwfmc", coagulation, mono, with(fractions, samwfmc), 50});
  run({"5 mmc", breakage(1, 1, 2, equal), monoBreak, mmcOptions, 50});
  run({"5 sammc", breakage(1, 1, 2, equal), monoBreak, sammcOptions, 50});
  run({"6 sammc", breakage(1, 1, 2, uniform), monoBreak, sammcOptions, 50});
  run({"7 sammc", breakage(1, 2, 2, uniform), expBreak, sammcOptions, 50});
  run({"8 sammc", breakage(1, 1.8, 12, equal), monoBreak, sammcOptions, 50});
  PopulationModel both = constant(1e-11);
  both.nucleation.emplace();
  both.nucleation->rate = 1e12;
  run({"9 sammc", both, population(Distribution::monodisperse, 1e11, 1), sammcOptions, 10});
  PopulationModel equilibrium = constant(1e-13);
  equilibrium.breakage = BreakageOptions{0.5, 0, 2, uniform};
  run({"12 sammc, tau 10", equilibrium, population(Distribution::monodisperse, 1e13, 1), sammcOptions, 10});
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  using Distribution = InitialPopulation::Distribution;
  if (argc > 2) only = argv[2];
  if (argc > 3) onlyParticles = std::stoul(argv[3]);
  if (what != "cases") {
    MonteCarloOptions options;
    options.method = MonteCarloMethod::sammc;
    options.fraction = FractionFunction::hyperbolic;
    options.fractionOf = FractionOf::weights;
    const auto mono = population(Distribution::monodisperse, 1e12, 1);
    const auto nano = population(Distribution::monodisperse, 1e18, 5e-28);
    events("sammc, hyperbolic, constant kernel", constant(1e-12), mono, options);
    events("sammc, hyperbolic, free-molecular kernel", freeMolecular(), nano, options);
    // Hardly any two volumes are equal.
    const auto spread = population(Distribution::exponential, 1e12, 1);
    const auto spreadNano = population(Distribution::exponential, 1e18, 5e-28);
    events("sammc, exponential start, constant kernel", constant(1e-12), spread, options);
    events("sammc, exponential start, free-molecular kernel", freeMolecular(), spreadNano, options);
    options.method = MonteCarloMethod::samwfmc;
    events("samwfmc, hyperbolic, free-molecular kernel", freeMolecular(), nano, options);
    options.method = MonteCarloMethod::wfmc;
    events("wfmc, hyperbolic, free-molecular kernel", freeMolecular(), nano, options);
    options.fraction = FractionFunction::one;
    options.method = MonteCarloMethod::mmc;
    events("mmc, free-molecular kernel", freeMolecular(), nano, options);
    options.method = MonteCarloMethod::swa;
    events("swa, free-molecular kernel", freeMolecular(), nano, options);
  }
  if (what != "events") cases();
  return 0;
}
