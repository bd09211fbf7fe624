#include "particles/population/sectional/section_coagulation.hpp"

#include <algorithm>
#include <cmath>

#include "particles/population/model/particle_type.hpp"
#include "particles/population/model/sphere.hpp"

namespace lampblack::particles {

SectionCoagulation::SectionCoagulation(const SectionGrid& grid, const CollisionKernel& kernel, double density)
    : layout_(grid.layout()) {
  const std::size_t n = grid.last();
  const Sphere spheres(density);
  std::vector<CollisionKernel::Properties> pivots(n);
  for (std::size_t k = 0; k < n; ++k) pivots[k] = kernelProperties(kernel, spheres, {grid.volume(k + 1)});
  rate_.reserve(n * (n + 1) / 2);
  upper_.reserve(n * (n + 1) / 2);
  const double logSpacing = std::log(grid.spacing()), end = grid.volume(n);
  for (std::size_t d = 0; d < n; ++d) {
    // The sum in units of the larger pivot; a sum on a pivot, but for rounding, counts to the interval below it.
    const double sum = 1 + std::pow(grid.spacing(), -static_cast<double>(d));
    const double steps = std::ceil(std::log(sum) / logSpacing - 1e-9);
    Diagonal diagonal{d, static_cast<std::size_t>(std::max(steps, 1.0)) - 1, rate_.size(), n - d, 0};
    const std::size_t above = d + diagonal.shift + 1;  // first pair's upper pivot
    diagonal.interior = above < n ? n - above : 0;
    for (std::size_t j = 0; j < diagonal.count; ++j) {
      const double vi = grid.volume(j + d + 1), vj = grid.volume(j + 1);
      rate_.push_back((d == 0 ? 0.5 : 1.0) * kernel.value(pivots[j + d], pivots[j]));
      if (j >= diagonal.interior) {
        upper_.push_back((vi + vj) / end);
        continue;
      }
      const double below = grid.volume(j + d + diagonal.shift + 1);
      const double width = grid.volume(j + d + diagonal.shift + 2) - below;
      upper_.push_back((diagonal.shift == 0 ? vj : vi + vj - below) / width);
    }
    diagonals_.push_back(diagonal);
  }
  // Kernels that have no finite value at volume zero are taken at half of the first pivot.
  const auto zeroAt = [&](double v) { return kernelProperties(kernel, spheres, {v}); };
  auto zero = zeroAt(0);
  if (!std::isfinite(kernel.value(zero, pivots[0])) || !std::isfinite(kernel.value(zero, zero)))
    zero = zeroAt(0.5 * grid.volume(1));
  withZero_.push_back(0.5 * kernel.value(zero, zero));
  for (const auto& pivot : pivots) withZero_.push_back(kernel.value(zero, pivot));
  for (auto* work : {&events_, &smaller_, &larger_, &made_, &flux_}) work->assign(n + 1, 0.0);
}

void SectionCoagulation::addRates(const double* y, double* f) {
  const std::size_t n = layout_.sections - 1;
  const double* __restrict pivots = y + 1;
  for (auto* work : {&smaller_, &larger_, &made_, &flux_}) std::fill(work->begin(), work->end(), 0.0);
  double overNumber = 0, overVolume = 0;
  for (const Diagonal& diagonal : diagonals_) {
    const double* __restrict rate = rate_.data() + diagonal.offset;
    const double* __restrict upper = upper_.data() + diagonal.offset;
    const double* __restrict larger = pivots + diagonal.d;
    double* __restrict events = events_.data();
    double* __restrict lost = smaller_.data();
    for (std::size_t j = 0; j < diagonal.count; ++j) {
      const double event = rate[j] * pivots[j] * larger[j];
      events[j] = event;
      lost[j] += event;
    }
    double* __restrict lostLarger = larger_.data() + diagonal.d;
    double* __restrict flux = flux_.data() + diagonal.d + diagonal.shift;
    if (diagonal.shift == 0) {
      // The larger one stays what it is, but for the part that moves up: no difference of large numbers.
      for (std::size_t j = 0; j < diagonal.interior; ++j) flux[j] += upper[j] * events[j];
    } else {
      double* __restrict made = made_.data() + diagonal.d + diagonal.shift;
      for (std::size_t j = 0; j < diagonal.interior; ++j) {
        lostLarger[j] += events[j];
        made[j] += events[j];
        flux[j] += upper[j] * events[j];
      }
    }
    for (std::size_t j = diagonal.interior; j < diagonal.count; ++j) {
      lostLarger[j] += events[j];
      overNumber += events[j];
      overVolume += upper[j] * events[j];
    }
  }
  double below = 0;
  for (std::size_t k = 0; k < n; ++k) {
    f[k + 1] += made_[k] - smaller_[k] - larger_[k] + (below - flux_[k]);
    below = flux_[k];
  }
  f[layout_.overNumber()] += overNumber;
  f[layout_.overVolume()] += overVolume;
  double lost = 0;
  for (std::size_t k = 0; k <= n; ++k) lost += withZero_[k] * y[k];
  f[0] -= lost * y[0];
}

void SectionCoagulation::addJacobian(const double* y, double* J, std::size_t ld) const {
  for (const Diagonal& diagonal : diagonals_) {
    for (std::size_t t = 0; t < diagonal.count; ++t) {
      const std::size_t j = t + 1, i = j + diagonal.d, k = i + diagonal.shift;
      const double rate = rate_[diagonal.offset + t], upper = upper_[diagonal.offset + t];
      const auto addColumn = [&](std::size_t column, double value) {
        double* into = J + column * ld;
        into[j] -= value;
        if (t >= diagonal.interior) {
          into[i] -= value;
          into[layout_.overNumber()] += value;
          into[layout_.overVolume()] += upper * value;
          return;
        }
        if (diagonal.shift > 0) {
          into[i] -= value;
          into[k] += value;
        }
        into[k] -= upper * value;
        into[k + 1] += upper * value;
      };
      addColumn(i, rate * y[j]);
      addColumn(j, rate * y[i]);
    }
  }
  double lost = withZero_[0] * y[0];
  for (std::size_t k = 0; k < layout_.sections; ++k) {
    lost += withZero_[k] * y[k];
    if (k > 0) J[k * ld] -= withZero_[k] * y[0];
  }
  J[0] -= lost;
}

std::size_t SectionCoagulation::bytes() const {
  return sizeof(double) * (rate_.size() + upper_.size() + withZero_.size() + 5 * events_.size());
}

}  // namespace lampblack::particles
