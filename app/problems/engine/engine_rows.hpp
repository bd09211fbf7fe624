// What is said of a cycle of an engine as it goes on: rows of its history, the cycle as a whole, its particles.
#pragma once

#include <optional>
#include <vector>

#include "app/problems/engine/engine_case.hpp"
#include "chemistry/reactor/engine/engine_indicators.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "core/state_archive.hpp"
#include "coupling/reactor_particles.hpp"

namespace lampblack::app {

// What a row of the history has besides its angle and time, in this order.
[[nodiscard]] std::vector<Quantity> engineQuantities(const EngineCase& made);
// What is said of a cycle as a whole, in this order.
[[nodiscard]] std::vector<Quantity> engineSummaryQuantities(const EngineCase& made);
// What is said of a particle, after angle and number.
[[nodiscard]] std::vector<Quantity> engineParticleQuantities(const EngineCase& made);

// Of one cycle.
class EngineRows {
 public:
  EngineRows(const EngineCase& made, const Thermo& thermo);

  void clear();
  void add(const EngineCylinder& cylinder, double angle);
  [[nodiscard]] std::vector<double> rows() const;  // row-major, engineQuantities()
  [[nodiscard]] std::vector<double> summary(const EngineCylinder& cylinder, std::size_t cycle) const;

  [[nodiscard]] double halfBurnt() const { return burntAngle(trace_, 0.5); }
  [[nodiscard]] double startTemperature() const { return trace_.temperature.front(); }

  // NumericsError where a model of soot has too much in its largest particles.
  void requireSizeRangeCovered() const;
  void saveOrLoad(StateArchive& archive);

 private:
  void addSoot(const EngineGas& gas, const EngineTotals& all, std::vector<double>& row);

  const EngineCase& made_;
  const Thermo& thermo_;
  EngineTrace trace_;
  std::vector<double> rows_;  // row-major
  std::vector<double> lastMoles_, lastMasses_;
  double mass_ = 0;
  std::optional<ReactorGas> seen_;                        // of soot
  double sootMass_ = 0, mostSoot_ = 0, mostAtLimit_ = 0;  // kg at the last row; volume fractions, largest
};

// Rows of angle, number, engineParticleQuantities() of all particles.
void addEngineParticles(const EngineCase& made, const Thermo& thermo, const EngineGas& gas, double angle,
                        std::vector<double>& rows);

}  // namespace lampblack::app
