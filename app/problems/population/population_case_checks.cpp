// What the parts of a population balance deck, each in its range, cannot be together.
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/problems/population/population_case_parts.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"

namespace lampblack::app::populationcase {
namespace {

// Changes by more than this factor leave the range of numbers, and a Monte Carlo sample would be refilled for ever.
constexpr double largestExponent = 600;

void requireBounded(const Deck& deck, const std::string& key, double rate, double end, const char* what) {
  if (std::abs(rate) * end > largestExponent)
    throw deck.error(
        key, fmt::format("until time.end {} changes by the factor e^{:.4g}; expected e^{:g} at most, here "
                         "a rate up to {:.4g} 1/s",
                         what, rate * end, rate < 0 ? -largestExponent : largestExponent, largestExponent / end));
}

// By how much collisions alone lower the number density until the end, as the exponent of e, for the kernels whose law
// is known (Smoluchowski 1916): 1 + A N0 t/2 of the constant one, exp(A M1 t) of the additive one.
double fallByCollisions(const PopulationCase& made) {
  const CollisionKernelOptions& kernel = *made.model.coagulation;
  const InitialPopulation& initial = made.initial;
  if (initial.distribution == InitialPopulation::Distribution::none || kernel.efficiencyDiameter != 0) return 0;
  const double rate = kernel.rate * kernel.efficiency;
  if (kernel.type == CollisionKernelType::constant) return std::log1p(0.5 * rate * initial.number * made.times.end);
  if (kernel.type != CollisionKernelType::additive) return 0;
  return rate * initialMoment(initial, 1) * made.times.end;
}

void checkCollisions(const Deck& deck, const PopulationCase& made) {
  const PopulationModel& model = made.model;
  if (!model.coagulation || model.nucleation || model.breakage) return;
  if (const double fall = fallByCollisions(made); !(fall <= largestExponent))
    throw deck.error("processes.coagulation.rate",
                     fmt::format("until time.end collisions lower the number density by the factor e^{:.4g}; "
                                 "expected e^{:g} at most: a lower rate, fewer particles or an earlier end",
                                 fall, largestExponent));
}

// Processes of the first order, whose effect until the end is known.
void checkRates(const Deck& deck, const PopulationModel& model, double end) {
  requireBounded(deck, "processes.condensation.rate", model.growth.condensation, end, "every volume");
  requireBounded(deck, "processes.dilution.rate", model.dilution, end, "every number density");
  if (model.deposition && model.deposition->exponent == 0)
    requireBounded(deck, "processes.deposition.rate", model.deposition->rate, end, "the number density");
  if (model.breakage && model.breakage->exponent == 0)
    requireBounded(deck, "processes.breakage.rate", model.breakage->rate * (model.breakage->fragments - 1), end,
                   "the number density");
}

// The smallest volume that particles begin with, of those that have one; infinite where there is none.
double smallestStart(const PopulationCase& made) {
  double volume = std::numeric_limits<double>::infinity();
  for (const InitialPopulation& mode : modesOf(made.initial)) {
    if (mode.distribution == InitialPopulation::Distribution::monodisperse) volume = std::min(volume, mode.volume);
    if (!mode.intervals.empty()) volume = std::min(volume, mode.intervals.front().from);
  }
  if (made.model.nucleation) volume = std::min(volume, made.model.nucleation->volume);
  return volume;
}

void checkGrowth(const Deck& deck, const PopulationCase& made) {
  const GrowthOptions& growth = made.model.growth;
  const double start = smallestStart(made);
  if (growth.smallestVolume >= start)
    throw deck.error("processes.growth.smallest_volume",
                     fmt::format("particles begin with {:.4g} m3 and would vanish at once; expected less", start));
  if (growth.monomer > start)
    throw deck.error("processes.growth.monomer",
                     fmt::format("expected at most the {:.4g} m3 that particles begin with", start));
}

// Whether nuclei appear at all before the end.
bool nucleates(const NucleationOptions& nucleation, double end) {
  if (nucleation.source != NucleationOptions::Source::table) return true;
  for (std::size_t k = 1; k < nucleation.times.size(); ++k)
    if (nucleation.times[k - 1] < end && nucleation.times[k] > 0 && nucleation.rates[k - 1] + nucleation.rates[k] > 0)
      return true;
  return false;
}

void checkParticles(const Deck& deck, const PopulationCase& made) {
  if (made.initial.distribution != InitialPopulation::Distribution::none) return;
  if (!made.model.nucleation)
    throw deck.error("initial", "there are no particles: 'initial' has none and no process makes any");
  if (!nucleates(*made.model.nucleation, made.times.end))
    throw deck.error("processes.nucleation.rates",
                     "there are no particles: 'initial' has none and the rates are zero until time.end");
}

void checkMethod(const Deck& deck, const PopulationCase& made, const PopulationMethod& method) {
  const std::string section = "methods." + method.name;
  const std::vector<std::string> moments = deck.strings(section + ".unbiased_moments");
  for (std::size_t i = 1; i < moments.size(); ++i)
    if (std::find(moments.begin(), moments.begin() + static_cast<std::ptrdiff_t>(i), moments[i]) !=
        moments.begin() + static_cast<std::ptrdiff_t>(i))
      throw deck.error(section + ".unbiased_moments", fmt::format("{} is named twice", moments[i]));
  const auto* sections = std::get_if<SectionalOptions>(&method.options);
  const bool spread = made.initial.distribution != InitialPopulation::Distribution::none;
  if (sections != nullptr && spread && made.initial.volume < sections->smallest)
    throw deck.error(section + ".smallest", fmt::format("the first pivot is above the initial particles, whose mean or "
                                                        "median volume is {:.4g} m3",
                                                        made.initial.volume));
}

}  // namespace

void checkProcesses(const Deck& deck, const PopulationCase& made) {
  checkParticles(deck, made);
  checkRates(deck, made.model, made.times.end);
  checkCollisions(deck, made);
  checkGrowth(deck, made);
}

void checkMethods(const Deck& deck, const PopulationCase& made) {
  for (const PopulationMethod& method : made.methods) checkMethod(deck, made, method);
}

}  // namespace lampblack::app::populationcase
