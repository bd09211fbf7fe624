// One gas state for the moment models, and their equations integrated in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "particles/models/soot_model.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::test {

// The gas of a fixture in the order of a model's species.
class ModelGas {
 public:
  ModelGas(const FlameGas& flame, const SootModelOptions& options) : concentrations_(flame.concentrations) {
    concentrations_.resize(SootSpecies::fixed + options.pah.size());
    gas = flame.state;
    gas.concentrations = concentrations_;
  }
  ModelGas(const ModelGas&) = delete;
  ModelGas& operator=(const ModelGas&) = delete;

  ParticleGas gas;

  [[nodiscard]] std::vector<double> rates(const SootModel& model, const std::vector<double>& densities) const {
    std::vector<double> rates(model.scalars().size()), exchange(model.gasSpecies().size());
    model.sources(gas, densities, rates, exchange);
    return rates;
  }
  [[nodiscard]] std::vector<double> exchange(const SootModel& model, const std::vector<double>& densities) const {
    std::vector<double> rates(model.scalars().size()), exchange(model.gasSpecies().size());
    model.sources(gas, densities, rates, exchange);
    return exchange;
  }

  // The scalars after `time` (s) with the gas held: Bogacki and Shampine's third-order pair (1989), local errors below
  // `tolerance` of each scalar.
  [[nodiscard]] std::vector<double> integrate(const SootModel& model, std::vector<double> y, double time,
                                              double tolerance = 1e-7) const {
    const std::size_t n = y.size();
    std::vector<double> k1 = rates(model, y), k2, k3, k4, at(n), next(n);
    double t = 0, dt = time * 1e-6;
    for (int step = 0; t < time; ++step) {
      if (step > 200000) throw std::runtime_error("integrate: too many steps");
      dt = std::min(dt, time - t);
      const auto move = [&](auto&& slope) {
        for (std::size_t i = 0; i < n; ++i) at[i] = y[i] + dt * slope(i);
      };
      move([&](std::size_t i) { return 0.5 * k1[i]; });
      k2 = rates(model, at);
      move([&](std::size_t i) { return 0.75 * k2[i]; });
      k3 = rates(model, at);
      move([&](std::size_t i) { return 2.0 / 9 * k1[i] + 1.0 / 3 * k2[i] + 4.0 / 9 * k3[i]; });
      next = at;
      k4 = rates(model, next);
      double error = 1e-10;
      for (std::size_t i = 0; i < n; ++i) {
        const double e = dt * (-5.0 / 72 * k1[i] + 1.0 / 12 * k2[i] + 1.0 / 9 * k3[i] - 1.0 / 8 * k4[i]);
        error = std::max(error, std::abs(e) / (tolerance * std::max(std::abs(next[i]), std::abs(y[i])) + 1e-300));
      }
      if (error <= 1) {
        t += dt;
        y = next;
        k1 = k4;
      }
      dt *= std::clamp(0.9 * std::cbrt(1 / error), 0.2, 5.0);
    }
    return y;
  }

 private:
  std::vector<double> concentrations_;
};

}  // namespace lampblack::test
