#include "app/problems/engine/engine_repeat.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"

namespace lampblack::app {
namespace {

EngineOptions optionsOf(const EngineCase& made, std::uint64_t repeat) {
  EngineOptions options = made.options;
  options.repeat = repeat;
  return options;
}

bool isAmong(double angle, const std::vector<double>& some) {
  return std::ranges::any_of(some, [angle](double a) { return std::abs(a - angle) < 1e-9; });
}

}  // namespace

EngineCycles::EngineCycles(MPI_Comm comm, const EngineCase& made, std::uint64_t repeat)
    : made_(made),
      repeat_(repeat),
      thermo_(*made.mechanism),
      cylinder_(comm, *made.mechanism, thermo_, optionsOf(made, repeat)),
      said_(made, thermo_),
      stops_(made.angles()) {
  stops_.insert(stops_.end(), made.particlesAt.begin(), made.particlesAt.end());
  std::ranges::sort(stops_);
  stops_.erase(std::ranges::unique(stops_, [](double a, double b) { return std::abs(a - b) < 1e-9; }).begin(),
               stops_.end());
  if (!made.soot) return;
  soot_.emplace(comm, *made.mechanism, thermo_, *made.soot, made.options.reactions);
  cylinder_.carry(*soot_);
}

void EngineCycles::advance() {
  if (at_ == stops_.size()) {
    ++cycle_;
    at_ = 0;
  }
  if (at_ == 0) {
    said_.clear();
    done_.particles.clear();
    cylinder_.start(engineCharge(made_, repeat_, left_), 0);
  }
  const double angle = stops_[at_++];
  try {
    cylinder_.advanceTo(made_.timeOf(angle));
  } catch (const NumericsError& error) {
    throw NumericsError(fmt::format("cycle {}, before {:.4g} deg: {}", cycle_ + 1, angle, error.what()));
  }
  if (isAmong(angle, made_.angles())) said_.add(cylinder_, angle);
  if (isAmong(angle, made_.particlesAt)) addEngineParticles(made_, thermo_, cylinder_.gas(), angle, done_.particles);
  if (at_ == stops_.size()) endCycle();
}

void EngineCycles::endCycle() {
  said_.requireSizeRangeCovered();
  done_.summary = said_.summary(cylinder_, cycle_);
  done_.cycles.insert(done_.cycles.end(), done_.summary.begin(), done_.summary.end());
  done_.rows = said_.rows();
  isDone_ = true;
  if (!(made_.residual > 0)) return;
  const EngineTotals all = totalsOf(thermo_, cylinder_.gas());
  left_ = {thermo_.temperatureFromEnthalpy(all.enthalpy / all.mass, all.massFractions, all.temperature),
           cylinder_.gas().pressure, all.massFractions};
  const bool isSame = std::abs(said_.startTemperature() - temperatureBefore_) < made_.temperatureTolerance &&
                      (std::abs(said_.halfBurnt() - halfBefore_) < made_.angleTolerance ||
                       (std::isnan(halfBefore_) && std::isnan(said_.halfBurnt())));
  if (isSame && cycle_ > 0) return;
  isDone_ = cycle_ + 1 == made_.mostCycles;
  done_.isConverged = !isDone_;
  halfBefore_ = said_.halfBurnt();
  temperatureBefore_ = said_.startTemperature();
}

void EngineCycles::saveOrLoad(StateArchive& archive) {
  archive.shared("cycle", cycle_);
  archive.shared("stops", at_);
  archive.shared("is_done", isDone_);
  archive.shared("is_converged", done_.isConverged);
  archive.shared("half_before", halfBefore_);
  archive.shared("temperature_before", temperatureBefore_);
  archive.shared("residual_temperature", left_.temperature);
  archive.shared("residual_pressure", left_.pressure);
  archive.shared("residual_mass_fractions", left_.massFractions);
  archive.shared("done_rows", done_.rows);
  archive.shared("done_summary", done_.summary);
  archive.shared("done_cycles", done_.cycles);
  archive.shared("done_particles", done_.particles);
  cylinder_.saveOrLoad(archive);
  said_.saveOrLoad(archive);
}

}  // namespace lampblack::app
