#include "flow/implicit_diffusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/errors.hpp"

namespace lampblack::flow {
namespace {

// Of the source: below the one a residual does not fall, and above the other none is left, as where diffusion is so
// fast that the guess is no solution by far.
constexpr double roundOff = 1e-14, largestShare = 1e-7;

// Square of the residual (norm) that is good enough.
double targetOf(double startSquares, double sourceSquares, double tolerance) {
  const double wanted = std::min(tolerance * tolerance * startSquares, largestShare * largestShare * sourceSquares);
  return std::max({wanted, roundOff * roundOff * sourceSquares, std::numeric_limits<double>::min()});
}

// Columns `kept` of `rows` rows of `width` values each. `to` may be where they come from.
void keepColumns(std::span<const double> from, std::size_t rows, std::size_t width, std::span<const std::size_t> kept,
                 std::vector<double>& to) {
  if (to.size() < rows * kept.size()) to.resize(rows * kept.size());
  std::size_t at = 0;
  for (std::size_t row = 0; row < rows; ++row)
    for (const std::size_t column : kept) to[at++] = from[row * width + column];
}

}  // namespace

void ImplicitDiffusion::apply(const Active& active, std::span<const double> x, std::span<double> result) const {
  const Mesh& m = mesh_;
  const int fields = active.count();
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(m.owned) * fields; ++i)
    result[i] = active.diagonal[i] * x[i];
  for (int face = 0; face < m.interiorFaces; ++face) {
    const int low = m.low[face];
    const int high = m.high[face];
    const double* g = active.conductance.data() + static_cast<std::ptrdiff_t>(face) * fields;
    const double* xl = x.data() + static_cast<std::ptrdiff_t>(low) * fields;
    const double* xh = x.data() + static_cast<std::ptrdiff_t>(high) * fields;
    if (low < m.owned) {
      double* r = result.data() + static_cast<std::ptrdiff_t>(low) * fields;
      for (int k = 0; k < fields; ++k) r[k] += g[k] * (xl[k] - xh[k]);
    }
    if (high < m.owned) {
      double* r = result.data() + static_cast<std::ptrdiff_t>(high) * fields;
      for (int k = 0; k < fields; ++k) r[k] += g[k] * (xh[k] - xl[k]);
    }
  }
}

void ImplicitDiffusion::subtract(int fields, std::span<const double> diagonal, std::span<const double> conductance,
                                 std::span<const double> x, std::span<double> source) {
  Active active;
  active.field.resize(static_cast<std::size_t>(fields));
  active.diagonal = diagonal;
  active.conductance = conductance;
  const std::size_t values = static_cast<std::size_t>(mesh_.owned) * static_cast<std::size_t>(fields);
  product_.resize(values);
  apply(active, x, product_);
  for (std::size_t i = 0; i < values; ++i) source[i] -= product_[i];
}

void ImplicitDiffusion::products(const Active& active) {
  const auto n = static_cast<std::size_t>(active.count());
  const auto owned = static_cast<std::size_t>(mesh_.owned);
  for (std::size_t i = 0; i < owned * n; ++i) preconditioned_[i] = inverse_[i] * residual_[i];
  halo_.update({preconditioned_.data(), static_cast<std::size_t>(mesh_.cells) * n}, active.count());
  apply(active, preconditioned_, product_);
  sums_.assign(3 * n, 0.0);
  for (std::size_t cell = 0; cell < owned; ++cell)
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = cell * n + k;
      sums_[k] += residual_[i] * preconditioned_[i];
      sums_[n + k] += preconditioned_[i] * product_[i];
      sums_[2 * n + k] += residual_[i] * residual_[i];
    }
}

// Fields that have converged go; what is known of the others moves together.
void ImplicitDiffusion::leave(Active& active, std::span<double> x) {
  const auto n = static_cast<std::size_t>(active.count());
  const auto cells = static_cast<std::size_t>(mesh_.cells), owned = static_cast<std::size_t>(mesh_.owned);
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < n; ++k)
    if (active.rr[k] > active.target[k]) kept.push_back(k);
  if (active.x.data() != x.data()) {
    const std::size_t fields = x.size() / cells;
    for (std::size_t cell = 0; cell < owned; ++cell)
      for (std::size_t k = 0; k < n; ++k)
        x[cell * fields + static_cast<std::size_t>(active.field[k])] = active.x[cell * n + k];
  }
  for (std::vector<double>* values :
       {&residual_, &preconditioned_, &product_, &direction_, &directionProduct_, &inverse_})
    keepColumns(*values, owned, n, kept, *values);
  keepColumns(active.diagonal, owned, n, kept, activeDiagonal_);
  keepColumns(active.conductance, static_cast<std::size_t>(mesh_.interiorFaces), n, kept, activeConductance_);
  keepColumns(active.x, cells, n, kept, activeX_);
  for (std::vector<double>* values : {&active.rz, &active.rr, &active.target, &active.step})
    keepColumns(*values, 1, n, kept, *values), values->resize(kept.size());
  for (std::size_t k = 0; k < kept.size(); ++k) active.field[k] = active.field[kept[k]];
  active.field.resize(kept.size());
  active.diagonal = activeDiagonal_;
  active.conductance = activeConductance_;
  active.x = activeX_;
}

ImplicitDiffusion::Result ImplicitDiffusion::solve(int fields, std::span<const double> diagonal,
                                                   std::span<const double> conductance, std::span<const double> source,
                                                   std::span<double> x, double tolerance, int maxIterations) {
  const Mesh& m = mesh_;
  const auto owned = static_cast<std::size_t>(m.owned);
  auto n = static_cast<std::size_t>(fields);
  Active active;
  active.field.resize(n);
  std::iota(active.field.begin(), active.field.end(), 0);
  active.diagonal = diagonal;
  active.conductance = conductance;
  active.x = x;
  for (std::vector<double>* values : {&residual_, &product_, &direction_, &directionProduct_, &inverse_})
    values->assign(owned * n, 0.0);
  preconditioned_.resize(static_cast<std::size_t>(m.cells) * n);

  std::copy_n(diagonal.begin(), owned * n, inverse_.begin());
  for (int face = 0; face < m.interiorFaces; ++face) {
    for (const int cell : {m.low[face], m.high[face]}) {
      if (cell >= m.owned) continue;
      for (std::size_t k = 0; k < n; ++k) inverse_[cell * n + k] += conductance[face * n + k];
    }
  }
  for (double& value : inverse_) value = 1.0 / value;

  halo_.update(x, fields);
  apply(active, x, residual_);
  std::vector<double> sourceSquares(n, 0.0);
  for (std::size_t cell = 0; cell < owned; ++cell)
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = cell * n + k;
      residual_[i] = source[i] - residual_[i];
      sourceSquares[k] += source[i] * source[i];
    }
  products(active);
  sums_.insert(sums_.end(), sourceSquares.begin(), sourceSquares.end());
  const auto reduce = [&] {
    MPI_Allreduce(MPI_IN_PLACE, sums_.data(), static_cast<int>(sums_.size()), MPI_DOUBLE, MPI_SUM, m.comm);
  };
  reduce();
  active.rz.assign(sums_.begin(), sums_.begin() + fields);
  active.rr.assign(sums_.begin() + 2 * fields, sums_.begin() + 3 * fields);
  const std::vector<double> start = active.rr;
  std::vector<double> end = active.rr;
  for (std::size_t k = 0; k < n; ++k) {
    active.target.push_back(targetOf(start[k], sums_[3 * n + k], tolerance));
    active.step.push_back(sums_[n + k] > 0.0 ? sums_[k] / sums_[n + k] : 0.0);
  }
  std::vector<double> turn(n, 0.0);  // share of the last direction in the new one

  Result result;
  while (true) {
    std::size_t remaining = 0;
    for (std::size_t k = 0; k < n; ++k) remaining += active.rr[k] > active.target[k] ? 1 : 0;
    if (4 * remaining <= 3 * n) {
      std::vector<std::size_t> kept;
      for (std::size_t k = 0; k < n; ++k)
        if (active.rr[k] > active.target[k]) kept.push_back(k);
      keepColumns(turn, 1, n, kept, turn);
      leave(active, x);
      n = remaining;
    }
    if (remaining == 0) break;
    if (result.iterations == maxIterations)
      throw NumericsError(fmt::format("implicit diffusion did not converge in {} iterations", maxIterations));
    for (std::size_t cell = 0; cell < owned; ++cell)
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = cell * n + k;
        direction_[i] = preconditioned_[i] + turn[k] * direction_[i];
        directionProduct_[i] = product_[i] + turn[k] * directionProduct_[i];
        active.x[i] += active.step[k] * direction_[i];
        residual_[i] -= active.step[k] * directionProduct_[i];
      }
    products(active);
    reduce();
    for (std::size_t k = 0; k < n; ++k) {
      turn[k] = active.rz[k] > 0.0 ? sums_[k] / active.rz[k] : 0.0;
      const double curvature = active.step[k] != 0.0 ? sums_[n + k] - turn[k] * sums_[k] / active.step[k] : 0.0;
      active.rz[k] = sums_[k];
      active.rr[k] = end[static_cast<std::size_t>(active.field[k])] = sums_[2 * n + k];
      // A field that waits for others to leave with it stands still.
      active.step[k] = active.rr[k] > active.target[k] && curvature > 0.0 ? active.rz[k] / curvature : 0.0;
    }
    ++result.iterations;
  }
  halo_.update(x, fields);
  for (std::size_t k = 0; k < start.size(); ++k)
    if (start[k] > 0.0) result.worstResidual = std::max(result.worstResidual, std::sqrt(end[k] / start[k]));
  return result;
}

}  // namespace lampblack::flow
