// Factorisation and solution of matrices in lanes (lane_lu.hpp), for vectors V of batch_kinetics_simd.hpp, which also
// says what kernels have to mind. Every lane is computed by itself: what it holds, finite or not, does not reach the
// others.
#pragma once

#include "core/modules.hpp"
#include "numerics/lane_lu_view.hpp"

namespace lampblack::numerics {
namespace {

template <class V>
class LaneLuKernel {
  using D = typename V::D;
  static constexpr std::size_t lanes = V::lanes;

 public:
  // What became of the pivots.
  struct Quality {
    D largestMultiplier;  // in rows outside the border
    D finite;             // zero, where all pivots are finite and none is zero
  };

  // diag(diagonal) - factor * matrix, row by row; `diagonal` is in the order of elimination.
  static Quality factorise(const LaneLuView& view, const LaneLuWork& work, D factor, const double* diagonal) {
    Quality quality{D{}, D{}};
    for (std::size_t i = 0; i < view.size; ++i) {
      const std::uint32_t lowerEnd = view.lowerBegin[i + 1], upperEnd = view.upperBegin[i + 1];
      load(view, work, i, factor, diagonal);
      D largest = D{};
      for (std::uint32_t e = view.lowerBegin[i]; e < lowerEnd; ++e) {
        const std::uint32_t k = view.lower[e];
        const D l = V::load(work.row + k) * V::load(work.inversePivot + k);
        V::store(work.lower + e * lanes, l);
        largest = V::larger(V::larger(l, D{} - l), largest);
        subtractRow(view, work, k / lanes, l);
      }
      if (i < view.inner) quality.largestMultiplier = V::larger(largest, quality.largestMultiplier);
      const D inverse = V::all(1.0) / V::load(work.row + i * lanes);
      V::store(work.inversePivot + i * lanes, inverse);
      quality.finite += D{} * inverse;
      for (std::uint32_t e = view.upperBegin[i]; e < upperEnd; ++e)
        V::store(work.upper + e * lanes, V::load(work.row + view.upper[e]));
    }
    return quality;
  }

  // Overwrites b, in the order of the unknowns, with the solution.
  static void solve(const LaneLuView& view, const LaneLuWork& work, double* b) {
    for (std::size_t i = 0; i < view.size; ++i)
      V::store(work.x + i * lanes, V::load(b + view.unknown[i]) - product(view.lower, work.lower, view.lowerBegin[i],
                                                                          view.lowerBegin[i + 1], work.x));
    for (std::size_t i = view.size; i-- > 0;) {
      const D rest = V::load(work.x + i * lanes) -
                     product(view.upper, work.upper, view.upperBegin[i], view.upperBegin[i + 1], work.x);
      const D x = rest * V::load(work.inversePivot + i * lanes);
      V::store(work.x + i * lanes, x);
      V::store(b + view.unknown[i], x);
    }
  }

 private:
  // Row i of the matrix, spread over the columns of its factors.
  static void load(const LaneLuView& view, const LaneLuWork& work, std::size_t i, D factor, const double* diagonal) {
    for (std::uint32_t e = view.lowerBegin[i]; e < view.lowerBegin[i + 1]; ++e) V::store(work.row + view.lower[e], D{});
    for (std::uint32_t e = view.upperBegin[i]; e < view.upperBegin[i + 1]; ++e) V::store(work.row + view.upper[e], D{});
    for (std::uint32_t e = view.matrixBegin[i]; e < view.matrixBegin[i + 1]; ++e)
      V::store(work.row + view.matrix[e], D{} - factor * V::load(work.matrix + e * lanes));
    V::store(work.row + i * lanes, V::load(work.row + i * lanes) + V::load(diagonal + i * lanes));
  }

  static void subtractRow(const LaneLuView& view, const LaneLuWork& work, std::size_t k, D l) {
    const D minus = D{} - l;
    for (std::uint32_t e = view.upperBegin[k]; e < view.upperBegin[k + 1]; ++e) {
      double* at = work.row + view.upper[e];
      V::store(at, V::multiplyAdd(minus, V::load(work.upper + e * lanes), V::load(at)));
    }
  }

  // Of a row of L or U with x; in four sums, as one would wait for itself.
  static D product(const std::uint32_t* columns, const double* values, std::uint32_t e, std::uint32_t end,
                   const double* x) {
    D a = D{}, b = D{}, c = D{}, d = D{};
    const auto term = [&](std::uint32_t at, D sum) {
      return V::multiplyAdd(V::load(values + at * lanes), V::load(x + columns[at]), sum);
    };
    for (; e + 4 <= end; e += 4) {
      a = term(e, a);
      b = term(e + 1, b);
      c = term(e + 2, c);
      d = term(e + 3, d);
    }
    for (; e < end; ++e) a = term(e, a);
    return (a + b) + (c + d);
  }
};

}  // namespace
}  // namespace lampblack::numerics
