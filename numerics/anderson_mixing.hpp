// Anderson's acceleration of a fixed-point iteration x -> G(x) (Anderson 1965; Walker and Ni 2011, SIAM J. Numer. Anal.
// 49, 1715): of the last iterations, the combination whose change G(x) - x would be the smallest.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <deque>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::numerics {

class AndersonMixing {
 public:
  // `depth`: iterations that are kept beside the present.
  AndersonMixing(MPI_Comm comm, std::size_t depth) : comm_(comm), depth_(depth) {}

  // Forgets what it knows.
  void clear();
  // Collective. `before`: x, `found`: G(x), which becomes the next x; `weights`: of the squares in the norm of a
  // change, zero for values that another rank counts. The same sizes in every call since clear().
  void mix(std::span<const double> before, std::span<double> found, std::span<const double> weights);

 private:
  struct Difference {
    std::vector<double> change, found;  // of G(x) - x and of G(x), from one iteration to the next
  };
  [[nodiscard]] std::vector<double> coefficients(std::span<const double> change, std::span<const double> weights) const;

  MPI_Comm comm_;
  std::size_t depth_;
  std::vector<double> change_, found_;  // of the last iteration
  std::deque<Difference> differences_;
};

}  // namespace lampblack::numerics
