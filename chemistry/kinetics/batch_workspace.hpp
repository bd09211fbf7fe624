// Memory for kernels of states in lanes: rows of as many doubles as a block has states.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include "chemistry/kinetics/batch_kinetics_view.hpp"
#include "core/modules.hpp"
#include "numerics/aligned_vector.hpp"

namespace lampblack::chemistry {

class BatchRows {
 public:
  // Points each of the arrays to as many rows as it asks for, all of them zero.
  explicit BatchRows(std::initializer_list<std::pair<double**, std::size_t>> arrays) {
    std::size_t rows = 0;
    for (const auto& [start, count] : arrays) rows += count;
    memory_.assign(rows * batchLanes, 0.0);
    double* next = memory_.data();
    for (const auto& [start, count] : arrays) {
      *start = next;
      next += count * batchLanes;
    }
  }

 private:
  AlignedVector memory_;
};

// The rows of the kernel of BatchKinetics.
class BatchWorkspace {
 public:
  BatchWorkspace(const BatchView& view, std::size_t entries)
      : rows_({{&work_.c, view.numSpecies},
               {&work_.g, view.numSpecies},
               {&work_.s, view.numSpecies},
               {&work_.inverseS, view.numSpecies},
               {&work_.z, view.numSpecies},
               {&work_.wdot, view.numSpecies + 1},
               {&work_.wdotByLogs, view.numSpecies + 1},
               {&work_.M, view.thirdBodies.size},
               {&work_.logM, view.thirdBodies.size},
               {&work_.E, entries},
               {&work_.factors, view.factorExponentials.size},
               {&work_.X, entries},
               {&work_.centre, view.broadened.size},
               {&work_.given, view.given.size},
               {&work_.F, entries}}) {
    std::fill_n(work_.F, entries * batchLanes, 1.0);
    std::fill_n(work_.E + view.exponentials.size * batchLanes, batchLanes, 1.0);  // the entry that is always one
  }
  BatchWorkspace(const BatchWorkspace&) = delete;
  BatchWorkspace& operator=(const BatchWorkspace&) = delete;

  [[nodiscard]] const BatchWork& work() const { return work_; }

 private:
  BatchWork work_{};
  BatchRows rows_;
};

}  // namespace lampblack::chemistry
