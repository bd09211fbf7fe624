// Derivatives of the production rates of several states at once, one a vector lane: the tables of the kernel
// (batch_jacobian_kernel.hpp), from those of Kinetics and BatchKinetics. As there, d wdot_k/d c_j = S_kj + common_k.
//
// Left to Kinetics are mechanisms with rates that are rarer in flames: functions of pressure, of the enthalpy of
// reaction or of the mixture's colliders, orders that are no whole numbers, NASA-9 polynomials.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <tuple>
#include <vector>

#include "chemistry/kinetics/batch_jacobian_view.hpp"
#include "chemistry/kinetics/kinetics_jacobian_table.hpp"
#include "chemistry/kinetics/kinetics_tables.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class BatchJacobianTables {
 public:
  // Where the kernel puts S_kj (row k, column j), an offset in doubles.
  using Place = std::function<std::uint32_t(std::size_t row, std::size_t column)>;

  static bool covers(const KineticsTables& tables, const BatchView& rates);

  // `nowhere` is the place of a derivative that is not used. std::logic_error for a mechanism that is not covered.
  BatchJacobianTables(const KineticsTables& tables, const BatchView& rates, std::size_t entries,
                      const JacobianTable& table, const Place& place, std::uint32_t nowhere);

  // Points into this object.
  [[nodiscard]] BatchJacobianView view() const;

 private:
  struct Group {
    BatchJacobianGroup view{};
    std::vector<std::uint32_t> rows;
    std::vector<double> A;
  };

  void setColumns(const BatchView& rates);
  void addGroup(const BatchGroup& group, const Place& place, std::uint32_t nowhere);
  void addGeneral(const BatchGeneral& reaction, const BatchView& rates, const Place& place);
  void addSets(const KineticsTables& tables, const JacobianTable& table, const Place& place);
  [[nodiscard]] std::uint32_t columnOf(std::uint32_t entry) const;

  std::size_t species_, entries_;
  std::map<std::uint32_t, std::uint32_t> columns_;  // by entry
  std::vector<Group> groups_;
  std::vector<BatchJacobianGroup> groupViews_;
  std::vector<BatchJacobianGeneral> general_;
  std::vector<BatchJacobianSet> sets_;
  std::vector<std::uint32_t> valueList_, rowList_, placeList_;
  std::vector<BatchTerm> terms_;
  std::vector<double> excess_;
};

}  // namespace lampblack::chemistry
