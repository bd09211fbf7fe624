// How long the reactions of a gas take, one number for all of them: what a partially stirred reactor compares with the
// time of mixing. There is no one such time, and the definitions differ by orders of magnitude
// (docs/theory/combustion.md).
#pragma once

#include <span>
#include <vector>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::flow {

class ChemicalTime {
 public:
  enum class Kind {
    ReactionsOf6,       // all concentrations over what the mean reaction makes, forward (OpenFOAM 6)
    WeightedReactions,  // the same of each reaction and direction, weighted by what it makes
    SlowestSpecies,     // of the species that changes most slowly
  };
  static constexpr double longest = 1.0;  // s, of gas that reacts more slowly or not at all

  // The mechanism has to live as long.
  ChemicalTime(const Mechanism& mechanism, Kind kind);

  // s, of a gas (K, kg/m3, mass fractions; those below zero count as zero). NumericsError where it has no rates.
  [[nodiscard]] double of(double temperature, double density, std::span<const double> Y);
  // Derivatives of its logarithm, by mass fractions at constant pressure, then by temperature. Of the reactions' times,
  // as if third bodies were none; of the slowest species', which jumps from one to another, zeros.
  void slopes(double temperature, double density, std::span<const double> Y, std::span<double> slopes);

 private:
  [[nodiscard]] double ofReactions() const;
  void setConcentrations(double density, std::span<const double> Y);
  [[nodiscard]] double ofSlowest() const;

  const Mechanism& mechanism_;
  Kind kind_;
  Kinetics kinetics_;
  std::vector<double> inverseWeights_;            // mol/kg
  std::vector<double> madeForward_, madeBack_;    // sum of the coefficients of what a reaction makes
  std::vector<double> c_, forward_, back_, net_;  // mol/m3; mol/m3/s
};

}  // namespace lampblack::flow
