#include "particles/population/moments/moment_interpolation.hpp"

#include <cmath>

namespace lampblack {

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

MomentInterpolation::MomentInterpolation(std::size_t count, int lowest, int highest)
    : count_(count), lowest_(lowest), logarithms_(count) {
  for (int j = lowest; j <= highest; ++j) weights_.push_back(lagrangeWeights(count, j / 6.0));
  values_.resize(weights_.size());
}

void MomentInterpolation::set(std::span<const double> moments) {
  for (std::size_t k = 0; k < count_; ++k) logarithms_[k] = std::log(moments[k]);
  for (std::size_t j = 0; j < values_.size(); ++j) {
    double sum = 0;
    for (std::size_t k = 0; k < count_; ++k) sum += weights_[j][k] * logarithms_[k];
    values_[j] = std::exp(sum);
  }
}

}  // namespace lampblack
