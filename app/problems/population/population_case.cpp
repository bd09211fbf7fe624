#include "app/problems/population/population_case.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/deck/initial_distribution.hpp"
#include "app/problems/population/population_case_parts.hpp"
#include "core/errors.hpp"
#include "particles/population/monte_carlo/shipped_types.hpp"

namespace lampblack::app {

using namespace populationcase;

namespace {

// A warning where the sample that a method starts from lacks what a few large particles hold; empty where it does not.
std::string missedAtStart(const PopulationCase& made, const PopulationMethod& method,
                          const std::array<double, 4>& moments) {
  const std::string missed = method.deterministic() ? "" : missedMoments(made.initial, moments);
  if (missed.empty()) return {};
  return fmt::format(
      "methods.{}: the {} particles that the first repeat starts from miss what a few large ones hold: {} times that "
      "of "
      "the initial distribution, and the intervals of the results do not know of it; take more particles, a method "
      "with different weights (sammc, swa, mmc) and initial_weights: moments, or sections",
      method.name, std::get<MonteCarloOptions>(method.options).particles, missed);
}

PopulationTimes readTimes(const Deck& deck) {
  PopulationTimes times{deck.quantity("time.end"), deck.integer<std::size_t>("time.outputs"), 0};
  if (deck.choice("time.spacing") == "linear") return times;
  times.first = needed(deck, "time", "first", "the spacing logarithmic");
  if (!(times.first < times.end)) throw deck.error("time.first", "expected a time before time.end");
  if (times.outputs < 2) throw deck.error("time.outputs", "logarithmic spacing needs at least 2 rows");
  return times;
}

PopulationBins readBins(const Deck& deck, double end) {
  PopulationBins bins;
  if (!deck.has("distribution")) return bins;
  const double low = deck.quantity("distribution.minimum"), high = deck.quantity("distribution.maximum");
  const bool logarithmic = deck.choice("distribution.spacing") == "logarithmic";
  if (!(low < high)) throw deck.error("distribution.maximum", "expected a volume above distribution.minimum");
  if (logarithmic && !(low > 0))
    throw deck.error("distribution.minimum", "logarithmic bins need a volume above 0; or spacing: linear");
  const auto count = deck.integer<std::size_t>("distribution.bins");
  for (std::size_t k = 0; k <= count; ++k) {
    const double x = static_cast<double>(k) / static_cast<double>(count);
    bins.edges.push_back(k == count ? high : logarithmic ? low * std::pow(high / low, x) : low + x * (high - low));
  }
  bins.times = deck.has("distribution.times") ? deck.quantities("distribution.times") : std::vector<double>{end};
  if (bins.times.empty()) throw deck.error("distribution.times", "the list is empty; expected at least one time");
  for (std::size_t k = 0; k < bins.times.size(); ++k) {
    const std::string key = fmt::format("distribution.times[{}]", k);
    if (bins.times[k] > end) throw deck.error(key, "this time is after time.end; expected one before it");
    if (k > 0 && !(bins.times[k] > bins.times[k - 1])) throw deck.error(key, "the times have to rise");
  }
  return bins;
}

}  // namespace

std::vector<double> PopulationTimes::rows() const {
  std::vector<double> rows{0};
  for (std::size_t k = 1; k < outputs; ++k) {
    if (first > 0)
      rows.push_back(first * std::pow(end / first, static_cast<double>(k - 1) / static_cast<double>(outputs - 1)));
    else
      rows.push_back(end * static_cast<double>(k) / static_cast<double>(outputs));
  }
  rows.push_back(end);
  return rows;
}

bool PopulationCase::conservesMass() const {
  const GrowthOptions& growth = model.growth;
  const bool grows = growth.condensation != 0 || growth.surfaceGrowth != 0 || growth.oxidation != 0;
  return !model.nucleation && !model.deposition && !grows && model.dilution == 0;
}

std::unique_ptr<ExactSolution> exactSolution(const PopulationCase& populationCase) {
  const PopulationModel& model = populationCase.model;
  // The solutions of kernels and growth that see a diameter or a surface are those of spheres; sintering changes no
  // volume.
  const bool sees =
      model.growth.surface() != 0 || (model.coagulation && CollisionKernel(*model.coagulation).needsDiameter());
  if (sees && !std::holds_alternative<Sphere>(populationCase.particles)) return nullptr;
  PopulationModel volumes = model;
  volumes.growth.always = false;
  return exactSolution(volumes, populationCase.initial);
}

std::unique_ptr<PopulationSolver> makeSolver(const PopulationCase& populationCase, const PopulationMethod& method,
                                             std::uint64_t repeat) {
  const PopulationModel& model = populationCase.model;
  const InitialPopulation& initial = populationCase.initial;
  if (const auto* sections = std::get_if<SectionalOptions>(&method.options))
    return makeSectional(model, initial, *sections);
  if (const auto* moments = std::get_if<MomentOptions>(&method.options)) return makeMoments(model, initial, *moments);
  MonteCarloOptions options = std::get<MonteCarloOptions>(method.options);
  options.seed = populationCase.seed;
  options.repeat = repeat;
  return std::visit([&](const auto& type) { return makeMonteCarlo(type, model, initial, options); },
                    populationCase.particles);
}

PopulationCase readPopulationCase(const Deck& deck) {
  PopulationCase made;
  made.name = deck.string("name");
  made.model = readModel(deck);
  made.particles = readParticles(deck, made.model);
  made.initial = readInitialDistribution(deck, "initial");
  made.times = readTimes(deck);
  made.bins = readBins(deck, made.times.end);
  made.repeats = deck.integer<std::uint64_t>("repeats");
  made.seed = deck.integer<std::uint64_t>("seed");
  try {
    check(made.model, made.initial);
  } catch (const InputError& error) {
    throw deck.error("processes", error.what());
  }
  checkProcesses(deck, made);
  made.methods = readMethods(deck, made);
  checkMethods(deck, made);
  for (const PopulationMethod& method : made.methods) {
    try {
      const auto solver = makeSolver(made, method, 0);
      if (std::string missed = missedAtStart(made, method, solver->moments()); !missed.empty())
        made.warnings.push_back(std::move(missed));
    } catch (const InputError& error) {
      throw deck.error("methods." + method.name, error.what());
    }
  }
  return made;
}

}  // namespace lampblack::app
