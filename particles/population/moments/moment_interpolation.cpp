#include "particles/population/moments/moment_interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lampblack::particles {

std::vector<double> lagrangeWeights(std::size_t count, double x) {
  std::vector<double> weights(count, 1.0);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = static_cast<double>(i);
    for (std::size_t j = 0; j < count; ++j) {
      if (j != i) weights[i] *= (x - static_cast<double>(j)) / (at - static_cast<double>(j));
    }
  }
  return weights;
}

MomentInterpolation::MomentInterpolation(std::size_t count, int lowest, int highest) : count_(count), lowest_(lowest) {
  if (count > mostMoments || highest - lowest >= static_cast<int>(BrokenMoments::most)) {
    throw std::invalid_argument("MomentInterpolation: too many moments");
  }
  for (int j = lowest; j <= highest; ++j) {
    const std::vector<double> weights = lagrangeWeights(count, j / 6.0);
    std::copy(weights.begin(), weights.end(), weights_.emplace_back().begin());
  }
}

double MomentInterpolation::polynomial(std::size_t order, const double* logarithms) const {
  double sum = 0;
  for (std::size_t k = 0; k < count_; ++k) sum += weights_[order][k] * logarithms[k];
  return sum;
}

void MomentInterpolation::interpolate(std::span<const double> moments, BrokenMoments& broken) const {
  std::array<double, mostMoments> logarithms;
  for (std::size_t k = 0; k < count_; ++k) logarithms[k] = std::log(moments[k]);
  broken.lowest = lowest_;
  for (std::size_t j = 0; j < weights_.size(); ++j) broken.values[j] = std::exp(polynomial(j, logarithms.data()));
}

void MomentInterpolation::interpolateWithin(std::span<const double> L, double logSmallest,
                                            BrokenMoments& broken) const {
  const std::size_t last = count_ - 1;
  const double lowestSlope = std::min(logSmallest, L[1] - L[0]);
  broken.lowest = lowest_;
  for (std::size_t j = 0; j < weights_.size(); ++j) {
    const double x = (lowest_ + static_cast<int>(j)) / 6.0;
    double value = polynomial(j, L.data());
    if (x < 0) {
      value = std::clamp(value, L[0] + x * (L[1] - L[0]), L[0] + x * lowestSlope);
    } else if (x > static_cast<double>(last)) {
      value = std::max(value, L[last] + (x - static_cast<double>(last)) * (L[last] - L[last - 1]));
    } else {
      const std::size_t k = std::min(static_cast<std::size_t>(x), last - 1);
      const double beyond = x - static_cast<double>(k), chord = L[k] + beyond * (L[k + 1] - L[k]);
      double least = L[k] + beyond * (k > 0 ? L[k] - L[k - 1] : lowestSlope);
      if (k + 2 <= last) least = std::max(least, L[k + 1] - (1 - beyond) * (L[k + 2] - L[k + 1]));
      value = std::min(std::max(value, least), chord);
    }
    broken.values[j] = std::exp(value);
  }
}

}  // namespace lampblack::particles
