// Which derivative of which reaction goes to which entry of the Jacobian of the production rates. Built once from the
// tables of the reactions.
//
// The Jacobian is d wdot_k/d c_j = S_kj + common_k: S is sparse and holds the laws of mass action and, for every set of
// collision efficiencies and every reaction with colliders
// of its own, the excess of the colliders named; common holds what is the same for all j.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "chemistry/kinetics/kinetics_tables.hpp"
#include "core/modules.hpp"
#include "numerics/sparse_pattern.hpp"

namespace lampblack::chemistry {

class JacobianTable {
 public:
  explicit JacobianTable(const KineticsTables& tables);

  const SparsePattern& pattern() const { return pattern_; }

  // d progress / d concentration: six blocks of numReactions for the slots (three reactants, three products), then one
  // value for each order of the general reactions, forward before reverse.
  std::size_t numSources() const { return numSources_; }

  // Adds the laws of mass action to the entries of S.
  void addMassAction(const double* sources, double* values) const;

  // The species that change in the reactions with a set of efficiencies.
  std::span<const std::size_t> setRows(std::size_t set) const { return sets_[set].rows; }
  // Adds excess_j * column[k] to entry (k, j) for every collider j named by the set and every species k of setRows.
  void addExcess(const KineticsTables& tables, std::size_t set, const double* column, double* values) const;
  // Adds scale * excess_j * nu_k to entry (k, j) for every named collider j of tables.linearBurke[i].
  void addColliders(const KineticsTables& tables, std::size_t i, double scale, std::span<const double> excess,
                    double* values) const;

 private:
  // Reactions with the same numbers of reactants, of products whose concentrations count, and of species that change.
  struct Group {
    std::size_t numReactants = 0, numProducts = 0, numRows = 0;
    std::vector<std::uint32_t> reaction;
    std::vector<double> nu;               // numRows a reaction
    std::vector<std::uint32_t> position;  // by reaction, slot, row
  };
  struct GeneralTerm {
    std::uint32_t position = 0, source = 0;
    double nu = 0;
  };
  struct SetTable {
    std::vector<std::size_t> rows;
    std::vector<std::uint32_t> position;  // by collider, row
  };

  template <std::size_t Rows>
  void addGroup(const Group& group, const double* sources, double* __restrict values) const;
  void setPattern(const KineticsTables& tables);
  void setGroups(const KineticsTables& tables);
  std::uint32_t position(std::size_t row, std::size_t column) const;

  std::size_t numReactions_ = 0;
  std::size_t numSources_ = 0;
  SparsePattern pattern_;
  std::vector<Group> groups_;
  std::vector<GeneralTerm> general_;
  std::vector<SetTable> sets_;
  std::vector<std::vector<std::uint32_t>> colliders_;  // positions by collider, row; one list each of linearBurke
};

}  // namespace lampblack::chemistry
