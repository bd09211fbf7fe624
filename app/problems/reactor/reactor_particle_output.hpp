// What a reactor run writes of its particles: columns beside those of the gas, size distributions, and how well
// elements and energy are kept.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/problems/reactor/reactor_case.hpp"
#include "core/modules.hpp"
#include "coupling/reactor_balance.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

// Properties, processes and scalars, each after the material.
[[nodiscard]] std::vector<Quantity> particleColumns(const CarriedParticles& particles);

class ReactorParticleOutput {
 public:
  // What does not change along a run, per kg: nothing, the elements, or these and enthalpy or internal energy.
  enum class Kept { nothing, elements, enthalpy, internalEnergy };

  // Of a case with or without particles; without, all of it does nothing.
  ReactorParticleOutput(const ReactorCase& reactorCase, Kept kept);

  // particleColumns(), and how much what is kept has changed.
  [[nodiscard]] std::vector<Quantity> columns() const;
  // Appends the columns at a state: (Y, T, amounts) as the reactor has them, `density` of gas and particles. The first
  // call is what changes refer to.
  void append(double pressure, double density, std::span<const double> y, std::vector<double>& row);

  // Of the state appended last.
  [[nodiscard]] const ParticleProperties& last() const { return last_; }

  // Collective: /particles, where the model has sizes.
  void write(ResultsWriter& results) const;
  void record(JsonWriter& json) const;
  void print() const;
  // NumericsError where more of the particles than allowed are as large as the model can have.
  void requireSizeRangeCovered() const;

 private:
  [[nodiscard]] bool keepsElements() const { return kept_ != Kept::nothing; }
  [[nodiscard]] bool keepsEnergy() const { return kept_ == Kept::enthalpy || kept_ == Kept::internalEnergy; }

  const ReactorCase& case_;
  Kept kept_;
  std::optional<ReactorBalance> balance_;
  std::vector<double> elements_, densities_;  // of the first state
  double energyAtStart_ = 0;
  double elementImbalance_ = 0, energyImbalance_ = 0;  // the largest
  ParticleProperties last_;
  double most_ = 0, mostAtLimit_ = 0;
  std::vector<double> diameter_, distribution_;
};

}  // namespace lampblack::app
