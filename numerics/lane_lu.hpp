// LU factors of several matrices of one sparse pattern at once, one a vector lane: the plan that the kernel follows
// (lane_lu_kernel.hpp). Order and fill are those of SparseLu; so are the matrices it refuses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/modules.hpp"
#include "numerics/elimination.hpp"
#include "numerics/lane_lu_view.hpp"

namespace lampblack::numerics {

class LaneLu {
 public:
  // lanes: doubles a value.
  LaneLu(const Elimination& elimination, std::size_t lanes);

  // Points into this object.
  [[nodiscard]] LaneLuView view() const;

  [[nodiscard]] std::size_t size() const { return unknown_.size(); }
  [[nodiscard]] std::size_t numEntries() const { return matrix_.list.size(); }
  [[nodiscard]] std::size_t numLower() const { return lower_.list.size(); }
  [[nodiscard]] std::size_t numUpper() const { return upper_.list.size(); }
  // The offset of an entry, named by its unknowns, in LaneLuWork::matrix. std::logic_error if there is none.
  [[nodiscard]] std::uint32_t position(std::size_t row, std::size_t column) const;

 private:
  struct Rows {
    std::vector<std::uint32_t> begin, list;
  };

  std::size_t lanes_, inner_;
  Rows matrix_, lower_, upper_;
  std::vector<std::uint32_t> unknown_;
  std::vector<std::size_t> place_;
};

}  // namespace lampblack::numerics
