// A stochastic population of any kind as the particles of a split reactor.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "core/modules.hpp"
#include "coupling/split_reactor.hpp"
#include "particles/stochastic/stochastic_population.hpp"

namespace lampblack::coupling {

class ReactorPopulation : public SplitParticles {
 public:
  explicit ReactorPopulation(std::unique_ptr<StochasticPopulation> population,
                             GasViscosity viscosity = GasViscosity::transport)
      : population_(std::move(population)), viscosity_(viscosity) {}

  [[nodiscard]] StochasticPopulation& population() const { return *population_; }

  [[nodiscard]] const std::vector<std::string>& elements() const override { return population_->elements(); }
  [[nodiscard]] GasViscosity viscosity() const override { return viscosity_; }
  [[nodiscard]] const std::vector<std::size_t>& species() const override { return population_->species(); }
  Exchange advance(const ParticleGas& gas, double dt) override {
    population_->advance(gas, dt);
    return population_->takeExchange();
  }
  [[nodiscard]] std::optional<double> rateOf(std::size_t i, const ParticleGas& gas) const override {
    return population_->rateOf(i, gas);
  }
  void dilute(double factor) override {
    if (factor != 1) population_->dilute(factor);
  }
  [[nodiscard]] std::vector<double> content() const override { return population_->content(); }
  void join(std::span<const double> content, double share) override { population_->join(content, share); }
  [[nodiscard]] bool idle(const ParticleGas& gas) const override {
    return population_->size() == 0 && !population_->hasPrecursors(gas);
  }
  [[nodiscard]] std::uint64_t removals() const override { return population_->removals(); }
  [[nodiscard]] std::unique_ptr<State> save() const override { return population_->save(); }
  void restore(const State& state) override { population_->restore(state); }

 private:
  std::unique_ptr<StochasticPopulation> population_;
  GasViscosity viscosity_;
};

}  // namespace lampblack::coupling
