#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "particles/population/comparison/method_accumulator.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"

namespace lampblack::particles {
namespace {

constexpr double largestZ = 3.3;    // exceeded by chance once in a thousand
constexpr double roundOff = 1e-11;  // relative, of what is exact but for rounding

}  // namespace

void judge(const PopulationCase& populationCase, const PopulationMethod& method, MethodStatistics& statistics) {
  const bool conserved = populationCase.conservesMass();
  const auto known = [&](std::size_t k) { return !std::isnan(statistics.deviation[k]); };
  // What is wrong with a moment, in a few words; empty where nothing is.
  const auto fault = [&](std::size_t k, bool claimed) -> std::string {
    if (k == 1 && conserved && claimed && method.conservesMass && !(statistics.massError <= roundOff))
      return fmt::format("M1 not conserved ({:.1e})", statistics.massError);
    if (!known(k)) return "";
    if (std::isnan(statistics.z[k])) {
      if (std::abs(statistics.deviation[k]) <= roundOff) return "";
      return fmt::format("M{} off by {:.1e} without scatter", k, statistics.deviation[k]);
    }
    return std::abs(statistics.z[k]) <= largestZ ? "" : fmt::format("M{} (z = {:.1f})", k, statistics.z[k]);
  };

  statistics.bias = BiasVerdict::none;
  if (statistics.gelation) {
    statistics.verdict = fmt::format("gels at t = {:.6g} s", *statistics.gelation);
    return;
  }
  const bool nothingKnown = !known(0) && !known(1) && !known(2) && !known(3);
  if (nothingKnown) {
    const std::string mass = conserved ? fault(1, method.unbiased[1]) : "";
    statistics.bias = mass.empty() ? BiasVerdict::none : BiasVerdict::biased;
    statistics.verdict = mass.empty() ? "no exact solution" : mass;
    return;
  }
  if (method.deterministic()) {
    std::size_t worst = 4;
    for (std::size_t k = 0; k < 4; ++k)
      if (known(k) && (worst == 4 || std::abs(statistics.deviation[k]) > std::abs(statistics.deviation[worst])))
        worst = k;
    statistics.verdict = fmt::format("M{} off by {:.1e}", worst, statistics.deviation[worst]);
    return;
  }
  if (statistics.repeats.size() < 2) {
    statistics.verdict = "bias unknown: one repeat only";
    return;
  }
  std::vector<std::string> faults, others;
  bool anyUnbiased = false;
  for (std::size_t k = 0; k < 4; ++k) {
    anyUnbiased = anyUnbiased || method.unbiased[k];
    if (const std::string found = fault(k, method.unbiased[k]); !found.empty())
      (method.unbiased[k] ? faults : others).push_back(found);
  }
  if (!anyUnbiased) {
    statistics.bias = others.empty() ? BiasVerdict::noBiasSeen : BiasVerdict::biasedAsKnown;
    statistics.verdict =
        others.empty() ? "bias expected, none found" : fmt::format("biased, as expected: {}", fmt::join(others, ", "));
  } else if (!faults.empty()) {
    statistics.bias = BiasVerdict::biased;
    statistics.verdict = fmt::format("biased: {}", fmt::join(faults, ", "));
  } else {
    statistics.bias = BiasVerdict::noBias;
    statistics.verdict = others.empty() ? "no bias" : fmt::format("no bias; not required: {}", fmt::join(others, ", "));
  }
}

std::vector<std::string> startsWithoutTruth(const PopulationCase& populationCase,
                                            const PopulationStatistics& statistics) {
  constexpr double negligible = 0.01;
  std::vector<std::string> warnings;
  for (const MethodStatistics& method : statistics.methods) {
    if (method.deterministic || method.mean.empty() || method.repeats.size() < 2) continue;
    std::vector<std::string> missed;
    for (const std::size_t k : {0U, 1U, 2U, 3U}) {
      const double known = initialMoment(populationCase.initial, static_cast<double>(k));
      if (!(known > 0)) continue;
      const double part = method.mean[0][k] / known, error = method.error[0][k] / known;
      if (std::abs(part - 1) > std::max(negligible, largestZ * error))
        missed.push_back(fmt::format("M{} {:.3g} +- {:.2g}", k, part, largestZ * error));
    }
    if (!missed.empty())
      warnings.push_back(
          fmt::format("methods.{}: at the start the mean of {} repeats and its interval do not hold the moments of the "
                      "initial distribution, of which they are {}; nor can the intervals later hold the truth",
                      method.name, method.repeats.size(), fmt::join(missed, ", ")));
  }
  return warnings;
}

}  // namespace lampblack::particles
