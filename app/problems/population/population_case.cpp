#include "app/problems/population/population_case.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/deck/initial_distribution.hpp"
#include "app/problems/population/population_case_parts.hpp"
#include "core/errors.hpp"
#include "io/deck_keys.hpp"

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

DeckKeys<PopulationCase> timeKeys() {
  using Case = PopulationCase;
  constexpr auto time = [](auto member) { return inner(&Case::times, member); };
  DeckKeys<Case> keys("");
  keys.quantity("time.end", units::time, time(&PopulationTimes::end), rules().required().above(0),
                "Time at which the run ends, from zero.");
  keys.integer("time.outputs", time(&PopulationTimes::outputs), rules().atLeast(1).atMost(100000),
               "Rows of the histories after that at time zero.");
  keys.choice("time.spacing", {"linear", "logarithmic"}, rules().byDefault("linear"), "Spacing of the rows in time.");
  keys.quantity("time.first", units::time, time(&PopulationTimes::first),
                rules().optional().above(0).onlyWith("time.spacing", {"logarithmic"}),
                "Time of the first row after that at time zero.");
  keys.integer("repeats", &Case::repeats, rules().byDefault("20").atLeast(1).atMost(1e8),
               "Number of repeats of each Monte Carlo method, with random numbers of their own: more have less "
               "noise and cost more.");
  keys.integer("seed", &Case::seed, rules().atLeast(0),
               "Start of the random numbers: another seed gives another sample, the same seed the same result.");
  return keys;
}

struct BinsInput {
  double minimum = 0, maximum = 0;  // m3
  std::size_t bins = 50;
  bool isLogarithmic = true;
  std::vector<double> times;  // s
};

DeckKeys<BinsInput> binsKeys() {
  DeckKeys<BinsInput> keys("distribution");
  keys.section(Presence::optional, "Number densities in bins of volume.");
  keys.quantity("minimum", units::volume, &BinsInput::minimum, rules().required().atLeast(0),
                "Volume at the lower edge of the first bin.");
  keys.quantity("maximum", units::volume, &BinsInput::maximum, rules().required().above(0),
                "Volume at the upper edge of the last bin.");
  keys.integer("bins", &BinsInput::bins, rules().atLeast(1).atMost(100000), "Number of bins of the distribution.");
  keys.choice("spacing", &BinsInput::isLogarithmic, {{"logarithmic", true}, {"linear", false}}, rules(),
              "Spacing of the edges of the bins.");
  keys.quantity("times", units::time, &BinsInput::times, rules().optional().atLeast(0),
                "Times at which the distribution is written; absent: at time.end.");
  return keys;
}

void checkTimes(const Deck& deck, const PopulationTimes& times) {
  if (deck.choice("time.spacing") == "linear") return;
  needed(deck, "time", "first", "the spacing logarithmic");
  if (!(times.first < times.end)) throw deck.error("time.first", "expected a time before time.end");
  if (times.outputs < 2) throw deck.error("time.outputs", "logarithmic spacing needs at least 2 rows");
}

PopulationBins readBins(const Deck& deck, double end) {
  PopulationBins bins;
  if (!deck.has("distribution")) return bins;
  const BinsInput input = binsKeys().read(deck);
  const double low = input.minimum, high = input.maximum;
  const bool logarithmic = input.isLogarithmic;
  if (!(low < high)) throw deck.error("distribution.maximum", "expected a volume above distribution.minimum");
  if (logarithmic && !(low > 0))
    throw deck.error("distribution.minimum", "logarithmic bins need a volume above 0; or spacing: linear");
  for (std::size_t k = 0; k <= input.bins; ++k) {
    const double x = static_cast<double>(k) / static_cast<double>(input.bins);
    bins.edges.push_back(k == input.bins ? high : logarithmic ? low * std::pow(high / low, x) : low + x * (high - low));
  }
  bins.times = deck.has("distribution.times") ? input.times : std::vector<double>{end};
  if (bins.times.empty()) throw deck.error("distribution.times", "the list is empty; expected at least one time");
  for (std::size_t k = 0; k < bins.times.size(); ++k) {
    const std::string key = fmt::format("distribution.times[{}]", k);
    if (bins.times[k] > end) throw deck.error(key, "this time is after time.end; expected one before it");
    if (k > 0 && !(bins.times[k] > bins.times[k - 1])) throw deck.error(key, "the times have to rise");
  }
  return bins;
}

}  // namespace

DeckSchema populationcase::outputKeys() {
  return DeckSchema(timeKeys().schema()).add(binsKeys().schema());
}

PopulationCase readPopulationCase(const Deck& deck) {
  PopulationCase made;
  made.name = deck.string("name");
  made.model = readModel(deck);
  made.particles = readParticles(deck, made.model);
  made.initial = readInitialDistribution(deck, "initial");
  timeKeys().read(deck, made, "");
  checkTimes(deck, made.times);
  made.bins = readBins(deck, made.times.end);
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
