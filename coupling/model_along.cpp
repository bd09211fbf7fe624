#include "coupling/model_along.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/errors.hpp"
#include "core/stop_request.hpp"

namespace lampblack::coupling {
namespace {

// The model in a gas of which most species are kept as they are: it exchanges nothing of these.
class GivenGasModel final : public ParticleModel {
 public:
  GivenGasModel(const ParticleModel& model, std::vector<bool> isHeld) : model_(model), isHeld_(std::move(isHeld)) {}

  [[nodiscard]] std::string material() const override { return model_.material(); }
  [[nodiscard]] const std::vector<std::string>& gasSpecies() const override { return model_.gasSpecies(); }
  [[nodiscard]] std::vector<std::size_t> precursors() const override { return model_.precursors(); }
  [[nodiscard]] const std::vector<ParticleScalar>& scalars() const override { return model_.scalars(); }
  void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
               std::span<double> exchange) const override {
    model_.sources(gas, densities, rates, exchange);
    for (std::size_t k = 0; k < isHeld_.size(); ++k)
      if (isHeld_[k]) exchange[k] = 0;
  }
  void jacobian(const ParticleGas& gas, std::span<const double> densities, std::span<double> values) const override {
    model_.jacobian(gas, densities, values);
    const std::size_t n = scalars().size(), columns = n + gasSpecies().size() + 1;
    for (std::size_t k = 0; k < isHeld_.size(); ++k) {
      if (!isHeld_[k]) continue;
      const std::span<double> row = values.subspan((n + k) * columns, columns);
      std::fill(row.begin(), row.end(), 0.0);
    }
  }
  void diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) const override {
    model_.diffusivities(gas, densities, D);
  }
  void enthalpies(double temperature, std::span<double> h, std::span<double> slope) const override {
    model_.enthalpies(temperature, h, slope);
  }
  [[nodiscard]] double absorption(double temperature, double volumeFraction) const override {
    return model_.absorption(temperature, volumeFraction);
  }
  [[nodiscard]] ParticleProperties properties(const ParticleGas& gas,
                                              std::span<const double> densities) const override {
    return model_.properties(gas, densities);
  }
  [[nodiscard]] ParticleProcesses processes(const ParticleGas& gas, std::span<const double> densities) const override {
    return model_.processes(gas, densities);
  }

 private:
  const ParticleModel& model_;
  std::vector<bool> isHeld_;
};

// What the gas has of the species that particles deplete, per kg of it, from what a path gives.
class DepletedSpecies {
 public:
  DepletedSpecies(const ParticlePath& path, std::span<const std::size_t> species)
      : species_(species.begin(), species.end()) {
    for (const std::size_t k : species_) amounts_.push_back(given(path.points.front(), k));
  }

  // From one sample to the next, at the middle w of a part of the way that is `share` of it: what the gas loses by
  // itself goes half before and half behind what particles take (lose), what it makes comes at a steady rate.
  void begin(const GasSample& from, const GasSample& to, double w, double share, double dt, double density,
             std::span<double> concentrations, std::span<double> supply) {
    halves_.clear();
    for (std::size_t i = 0; i < species_.size(); ++i) {
      const std::size_t k = species_[i];
      const double first = given(mixed(from, to, w - 0.5 * share), k),
                   last = given(mixed(from, to, w + 0.5 * share), k);
      halves_.push_back(last < first ? std::sqrt(std::max(last, 0.0) / first) : 1.0);
      concentrations[k] = amounts_[i] * halves_[i] * density;
      supply[k] = std::max(last - first, 0.0) * density / dt;
    }
  }
  void end(std::span<const double> concentrations, double density) {
    for (std::size_t i = 0; i < species_.size(); ++i) amounts_[i] = concentrations[species_[i]] / density * halves_[i];
  }
  // mol/m3, of all species where the path gives `all`.
  void putInto(std::vector<double>& all, double density) const {
    for (std::size_t i = 0; i < species_.size(); ++i) all[species_[i]] = amounts_[i] * density;
  }

 private:
  [[nodiscard]] static double given(const GasSample& at, std::size_t k) {
    return at.concentrations[k] / at.gas.density;
  }

  std::vector<std::size_t> species_;
  std::vector<double> amounts_, halves_;  // mol/kg
};

}  // namespace

ModelAlong marchModel(const ParticleModel& model, const ParticlePath& path, std::span<const std::size_t> recorded,
                      std::span<const std::size_t> depleted, GasDivision division) {
  const std::size_t species = model.gasSpecies().size(), scalars = model.scalars().size();
  std::vector<bool> isHeld(species, true);
  for (const std::size_t k : depleted) isHeld[k] = false;
  GivenGasModel held(model, isHeld);
  division.counted.resize(species);
  std::iota(division.counted.begin(), division.counted.end(), std::size_t{0});
  std::vector<double> densities(scalars, 0.0), concentrations, supply(scalars + species, 0.0);
  DepletedSpecies left(path, depleted);
  ModelAlong result;
  std::size_t next = 0;
  const auto reached = [&](std::size_t point) {
    if (next == recorded.size() || recorded[next] != point) return;
    ++next;
    const GasSample& at = path.points[point];
    concentrations = at.concentrations;
    left.putInto(concentrations, at.gas.density);
    const ParticleGas gas{at.gas, concentrations};
    std::vector<double> ofDepleted;
    for (const std::size_t k : depleted) ofDepleted.push_back(concentrations[k]);
    result.records.push_back({densities, model.propertiesForResults(gas, densities), model.processes(gas, densities),
                              model.sizeDistribution(densities), std::move(ofDepleted)});
  };
  const auto dilute = [&](double factor) {
    for (double& density : densities) density *= factor;
  };
  reached(0);
  for (std::size_t k = 0; k + 1 < path.points.size(); ++k) {
    if (const int signal = stopRequest(); signal != 0)
      throw Stopped(signal, "stopped by " + signalName(signal) + " before the end of the path");
    const GasSample &from = path.points[k], &to = path.points[k + 1];
    checkInterval(from, to, species);
    marchInterval(from, to, division, [&](const ParticleGas& gas, double w, double dt) {
      const double half = std::exp(-0.5 * path.divergence[k].at(w) * dt);
      dilute(half);
      concentrations.assign(gas.concentrations.begin(), gas.concentrations.end());
      const std::span<double> ofSpecies = std::span(supply).subspan(scalars);
      left.begin(from, to, w, dt / (to.time - from.time), dt, gas.density, concentrations, ofSpecies);
      if (model.idle(ParticleGas{gas, concentrations}, densities)) {
        for (const std::size_t i : depleted) concentrations[i] += ofSpecies[i] * dt;
      } else {
        const std::span<const double> brought = depleted.empty() ? std::span<const double>() : supply;
        result.steps += held.advance(gas, dt, densities, concentrations, brought).steps;
      }
      left.end(concentrations, gas.density);
      dilute(half);
    });
    reached(k + 1);
  }
  return result;
}

}  // namespace lampblack::coupling
