#include "coupling/model_along.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/errors.hpp"
#include "core/stop_request.hpp"

namespace lampblack::coupling {
namespace {

// The model in a gas that is kept as it is: it exchanges nothing.
class GivenGasModel final : public ParticleModel {
 public:
  explicit GivenGasModel(const ParticleModel& model) : model_(model) {}

  [[nodiscard]] std::string material() const override { return model_.material(); }
  [[nodiscard]] const std::vector<std::string>& gasSpecies() const override { return model_.gasSpecies(); }
  [[nodiscard]] std::vector<std::size_t> precursors() const override { return model_.precursors(); }
  [[nodiscard]] const std::vector<ParticleScalar>& scalars() const override { return model_.scalars(); }
  void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
               std::span<double> exchange) const override {
    model_.sources(gas, densities, rates, exchange);
    std::fill(exchange.begin(), exchange.end(), 0.0);
  }
  void jacobian(const ParticleGas& gas, std::span<const double> densities, std::span<double> values) const override {
    model_.jacobian(gas, densities, values);
    const std::size_t n = scalars().size(), columns = n + gasSpecies().size() + 1;
    const std::span<double> ofExchange = values.subspan(n * columns);
    std::fill(ofExchange.begin(), ofExchange.end(), 0.0);
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
};

}  // namespace

ModelAlong marchModel(const ParticleModel& model, const ParticlePath& path, std::span<const std::size_t> recorded,
                      GasDivision division) {
  GivenGasModel held(model);
  const std::size_t species = model.gasSpecies().size();
  division.counted.resize(species);
  std::iota(division.counted.begin(), division.counted.end(), std::size_t{0});
  std::vector<double> densities(model.scalars().size(), 0.0), concentrations;
  ModelAlong result;
  std::size_t next = 0;
  const auto reached = [&](std::size_t point) {
    if (next == recorded.size() || recorded[next] != point) return;
    ++next;
    const ParticleGas gas{path.points[point].gas, path.points[point].concentrations};
    result.records.push_back({densities, model.properties(gas, densities), model.processes(gas, densities),
                              model.sizeDistribution(densities)});
  };
  const auto dilute = [&](double factor) {
    for (double& density : densities) density *= factor;
  };
  reached(0);
  for (std::size_t k = 0; k + 1 < path.points.size(); ++k) {
    if (const int signal = stopRequest(); signal != 0) throw NumericsError("stopped by " + signalName(signal));
    checkInterval(path.points[k], path.points[k + 1], species);
    marchInterval(path.points[k], path.points[k + 1], division, [&](const ParticleGas& gas, double w, double dt) {
      const double half = std::exp(-0.5 * path.divergence[k].at(w) * dt);
      dilute(half);
      if (!model.idle(gas, densities)) {
        concentrations.assign(gas.concentrations.begin(), gas.concentrations.end());
        const ParticleAdvance done = held.advance(gas, dt, densities, concentrations);
        result.steps += done.steps;
      }
      dilute(half);
    });
    reached(k + 1);
  }
  return result;
}

}  // namespace lampblack::coupling
