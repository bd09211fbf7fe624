#include "flow/implicit_diffusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::flow {

void ImplicitDiffusion::apply(int fields, std::span<const double> diagonal, std::span<const double> conductance,
                              std::span<const double> x, std::span<double> result) const {
  const Mesh& m = mesh_;
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(m.owned) * fields; ++i) result[i] = diagonal[i] * x[i];
  for (int face = 0; face < m.interiorFaces; ++face) {
    const int low = m.low[face];
    const int high = m.high[face];
    const double* g = conductance.data() + static_cast<std::ptrdiff_t>(face) * fields;
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

ImplicitDiffusion::Result ImplicitDiffusion::solve(int fields, std::span<const double> diagonal,
                                                   std::span<const double> conductance, std::span<const double> source,
                                                   std::span<double> x, double tolerance, int maxIterations) {
  const Mesh& m = mesh_;
  const auto ownedValues = static_cast<std::size_t>(m.owned) * fields;
  const auto n = static_cast<std::size_t>(fields);
  residual_.resize(ownedValues);
  product_.resize(ownedValues);
  inverse_.assign(diagonal.begin(), diagonal.begin() + static_cast<std::ptrdiff_t>(ownedValues));
  direction_.assign(static_cast<std::size_t>(m.cells) * n, 0.0);
  for (int face = 0; face < m.interiorFaces; ++face) {
    for (const int cell : {m.low[face], m.high[face]}) {
      if (cell >= m.owned) continue;
      for (std::size_t k = 0; k < n; ++k) inverse_[cell * n + k] += conductance[face * n + k];
    }
  }
  for (double& value : inverse_) value = 1.0 / value;

  halo_.update(x, fields);
  apply(fields, diagonal, conductance, x, product_);
  // sums: [r.z | r.r | b.b] for each field.
  std::vector<double> sums(3 * n, 0.0);
  for (int cell = 0; cell < m.owned; ++cell) {
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = cell * n + k;
      residual_[i] = source[i] - product_[i];
      direction_[i] = inverse_[i] * residual_[i];
      sums[k] += residual_[i] * direction_[i];
      sums[n + k] += residual_[i] * residual_[i];
      sums[2 * n + k] += source[i] * source[i];
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, m.comm);
  const std::vector<double> sourceNorm(sums.begin() + static_cast<std::ptrdiff_t>(2 * n), sums.end());
  std::vector<double> rz(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(n));
  std::vector<double> rr(sums.begin() + static_cast<std::ptrdiff_t>(n),
                         sums.begin() + static_cast<std::ptrdiff_t>(2 * n));
  const auto converged = [&](std::size_t k) {
    return rr[k] <= tolerance * tolerance * sourceNorm[k] || rr[k] < 1e-300;
  };

  Result result;
  std::vector<double> step(n);
  std::vector<double> beta(n);
  const auto allConverged = [&] {
    for (std::size_t k = 0; k < n; ++k)
      if (!converged(k)) return false;
    return true;
  };
  while (!allConverged()) {
    if (result.iterations == maxIterations)
      throw NumericsError(fmt::format("implicit diffusion did not converge in {} iterations", maxIterations));
    halo_.update(direction_, fields);
    apply(fields, diagonal, conductance, direction_, product_);
    std::fill(step.begin(), step.end(), 0.0);
    for (int cell = 0; cell < m.owned; ++cell)
      for (std::size_t k = 0; k < n; ++k) step[k] += direction_[cell * n + k] * product_[cell * n + k];
    MPI_Allreduce(MPI_IN_PLACE, step.data(), fields, MPI_DOUBLE, MPI_SUM, m.comm);
    for (std::size_t k = 0; k < n; ++k) step[k] = !converged(k) && step[k] > 0.0 ? rz[k] / step[k] : 0.0;
    std::fill(sums.begin(), sums.end(), 0.0);
    for (int cell = 0; cell < m.owned; ++cell) {
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = cell * n + k;
        x[i] += step[k] * direction_[i];
        residual_[i] -= step[k] * product_[i];
        sums[k] += residual_[i] * residual_[i] * inverse_[i];
        sums[n + k] += residual_[i] * residual_[i];
      }
    }
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2 * fields, MPI_DOUBLE, MPI_SUM, m.comm);
    for (std::size_t k = 0; k < n; ++k) {
      beta[k] = rz[k] > 0.0 ? sums[k] / rz[k] : 0.0;
      rz[k] = sums[k];
      rr[k] = sums[n + k];
    }
    for (int cell = 0; cell < m.owned; ++cell)
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = cell * n + k;
        direction_[i] = inverse_[i] * residual_[i] + beta[k] * direction_[i];
      }
    ++result.iterations;
  }
  halo_.update(x, fields);
  for (std::size_t k = 0; k < n; ++k)
    if (sourceNorm[k] > 0.0) result.worstResidual = std::max(result.worstResidual, std::sqrt(rr[k] / sourceNorm[k]));
  return result;
}

}  // namespace lampblack::flow
