// Factors k/k_base of reactions by the linear mixture rule (Collider of reaction.hpp), one state at a time. What
// depends on temperature alone is kept between calls.
//
// Colliders that share a rate constant k_r make a group: k = sum_r m_r k_r/E with m_r = sum of efficiency_j c_j over
// the group, E the sum of all m. A collider with a rate of its own is a group alone; the first group has all others.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/kinetics/kinetics_falloff.hpp"
#include "chemistry/kinetics/kinetics_pressure.hpp"
#include "chemistry/kinetics/kinetics_tables.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class LinearBurkeFactors {
 public:
  LinearBurkeFactors(const Mechanism& mechanism, const KineticsTables& tables);

  // lnBase: ln of the base constants of `tables` at this temperature.
  void setTemperature(double T, double lnT, const double* lnBase);

  // The factors of tables.linearBurke for concentrations of `total` (mol/m3). Without gas, as for a pressure of
  // smallestConcentration.
  std::span<const double> evaluate(const double* c, double total);

  // Derivatives of the factors last evaluated: by T at constant concentrations with k_base held, by the concentration
  // of a species that is not named, and the excess over it of each that is. Call evaluateSlopes first.
  void evaluateSlopes();
  double byT(std::size_t i) const { return reactions_[i].byT; }
  double byOther(std::size_t i) const { return reactions_[i].byOther; }
  std::span<const double> excess(std::size_t i) const { return reactions_[i].excess; }

 private:
  struct Named {
    std::size_t species = 0, group = 0;
    Arrhenius efficiency;  // A as ln A
    double value = 1, byT = 0;
  };
  struct Group {
    enum class Kind { Falloff, PressureLog, Chebyshev };
    Kind kind = Kind::Falloff;
    std::size_t entry = 0;             // among those of its kind
    std::size_t internal = 0;          // number in rates_
    std::size_t named = none;          // its collider, of a group of one
    double amount = 0, amountByT = 0;  // m, dm/dT
    double effective = 0;              // what its rate takes for the total concentration, E/efficiency
    double relative = 0, factor = 0;   // k_r over the base constants of rates_ and of the tables
  };
  struct OneReaction {
    std::size_t reaction = 0;
    std::vector<Named> named;
    std::vector<Group> groups;
    bool empty = false;
    double lnBase = 0;
    double sum = 0;  // E
    double factor = 0, byT = 0, byOther = 0;
    std::vector<double> excess;
  };
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  // By the logarithm of the effective concentration, and by T at its constant value, of ln k_r.
  struct Slope {
    double byLnAmount = 0, byT = 0;
  };

  LinearBurkeFactors(const Mechanism& mechanism, const KineticsTables& tables, const std::vector<Reaction>& rates);
  void findEntries();
  void setAmounts(OneReaction& one, const double* c, double total);
  double lnPressure(const Group& group) const;
  Slope slope(const Group& group) const;

  KineticsTables rates_;  // each group a reaction
  FalloffFactors falloff_;
  PressureRates pressureRates_;
  std::vector<OneReaction> reactions_;
  double T_ = 0;
  std::vector<double> lnBase_;     // of rates_
  std::vector<double> effective_;  // [M] of each fall-off entry
  std::vector<double> values_;
};

}  // namespace lampblack::chemistry
