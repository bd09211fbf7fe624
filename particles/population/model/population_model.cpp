#include "particles/population/model/population_model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>

#include "core/errors.hpp"
#include "particles/population/model/nucleation_schedule.hpp"

namespace lampblack::particles {
namespace {

[[noreturn]] void fail(std::string_view name, std::string_view expected, double value) {
  throw InputError(fmt::format("{} needs to be {}, not {}", name, expected, value));
}

void finite(std::string_view name, double value) {
  if (!std::isfinite(value)) fail(name, "a finite number", value);
}

void positive(std::string_view name, double value) {
  if (!(value > 0) || !std::isfinite(value)) fail(name, "above zero", value);
}

void notNegative(std::string_view name, double value) {
  if (!(value >= 0) || !std::isfinite(value)) fail(name, "zero or above", value);
}

void check(const NucleationOptions& nucleation) {
  positive("nucleation.volume", nucleation.volume);
  switch (nucleation.source) {
    case NucleationOptions::Source::constant:
      notNegative("nucleation.rate", nucleation.rate);
      break;
    case NucleationOptions::Source::precursor:
      positive("nucleation.rate_constant", nucleation.rateConstant);
      notNegative("nucleation.precursor", nucleation.precursor);
      break;
    case NucleationOptions::Source::table:
      for (const double time : nucleation.times) finite("nucleation.times: each", time);
      for (const double rate : nucleation.rates) notNegative("nucleation.rates: each", rate);
      [[maybe_unused]] const NucleationSchedule schedule(nucleation);  // throws unless the times increase
      break;
  }
}

void check(const BreakageOptions& breakage) {
  notNegative("breakage.rate", breakage.rate);
  finite("breakage.exponent", breakage.exponent);
  if (breakage.fragments < 2) fail("breakage.fragments", "at least 2", breakage.fragments);
  if (breakage.daughters == BreakageOptions::Daughters::uniform && breakage.fragments != 2) {
    fail("breakage.fragments", "2 where the daughters are uniform", breakage.fragments);
  }
}

void check(const GrowthOptions& growth) {
  finite("growth.condensation", growth.condensation);
  notNegative("growth.surface_growth", growth.surfaceGrowth);
  notNegative("growth.oxidation", growth.oxidation);
  notNegative("growth.smallest_volume", growth.smallestVolume);
  notNegative("growth.step", growth.step);
  if (growth.always) {
    positive("growth.step (of particles that sinter)", growth.step);
    if (growth.treatment == GrowthOptions::Treatment::jumps) {
      throw InputError("growth.treatment: particles that sinter cannot grow by jumps");
    }
  } else if (growth.active() && growth.treatment == GrowthOptions::Treatment::jumps) {
    positive("growth.monomer (with growth by jumps)", growth.monomer);
  }
}

void check(const InitialPopulation& initial) {
  if (initial.distribution == InitialPopulation::Distribution::none) return;
  positive("initial.number", initial.number);
  positive("initial.volume", initial.volume);
  if (initial.distribution == InitialPopulation::Distribution::lognormal &&
      (!(initial.geometricDeviation >= 1) || !std::isfinite(initial.geometricDeviation))) {
    fail("initial.geometric_deviation", "1 or above", initial.geometricDeviation);
  }
  for (const InitialPopulation& mode : initial.modes) check(mode);
}

}  // namespace

InitialPopulation tabulated(std::vector<SizeInterval> intervals) {
  InitialPopulation table;
  table.distribution = InitialPopulation::Distribution::table;
  double volume = 0, before = 0;
  for (const auto& [from, to, number] : intervals) {
    positive("the table: each lower end", from);
    if (!(to > from) || !std::isfinite(to))
      throw InputError(fmt::format("the table: expected an upper end above {:g} m3, not {:g} m3", from, to));
    if (from < before * (1 - 1e-9))
      throw InputError(
          fmt::format("the table: its sizes have to rise without overlap; {:g} m3 follows {:g} m3", from, before));
    notNegative("the table: each number", number);
    before = to;
    table.number += number;
    volume += number * (to - from) / std::log(to / from);
  }
  if (!(table.number > 0)) throw InputError("the table holds no particles");
  std::erase_if(intervals, [](const SizeInterval& interval) { return interval.number == 0; });
  table.volume = volume / table.number;
  table.intervals = std::move(intervals);
  return table;
}

InitialPopulation sumOf(const std::vector<InitialPopulation>& modes) {
  InitialPopulation sum;
  double volume = 0;
  for (const InitialPopulation& part : modes) {
    for (const InitialPopulation& mode : modesOf(part)) {
      if (mode.distribution == InitialPopulation::Distribution::none || !(mode.number > 0)) continue;
      const double logarithm = std::log(mode.geometricDeviation);
      const bool median = mode.distribution == InitialPopulation::Distribution::lognormal;
      sum.number += mode.number;
      volume += mode.number * mode.volume * (median ? std::exp(4.5 * logarithm * logarithm) : 1);
      sum.modes.push_back(mode);
    }
  }
  if (sum.modes.empty()) return {};
  if (sum.modes.size() == 1) return InitialPopulation(sum.modes.front());
  sum.distribution = InitialPopulation::Distribution::modes;
  sum.volume = volume / sum.number;
  return sum;
}

std::span<const InitialPopulation> modesOf(const InitialPopulation& initial) {
  if (initial.distribution == InitialPopulation::Distribution::modes) return initial.modes;
  return {&initial, 1};
}

void check(const PopulationModel& model, const InitialPopulation& initial) {
  if (model.coagulation) static_cast<void>(CollisionKernel(*model.coagulation));  // throws for what it lacks
  if (model.nucleation) check(*model.nucleation);
  if (model.breakage) check(*model.breakage);
  if (model.deposition) {
    notNegative("deposition.rate", model.deposition->rate);
    finite("deposition.exponent", model.deposition->exponent);
  }
  check(model.growth);
  finite("dilution", model.dilution);
  positive("density", model.density);
  check(initial);
}

}  // namespace lampblack::particles
