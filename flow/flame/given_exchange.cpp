#include "flow/flame/given_exchange.hpp"

#include <algorithm>

namespace lampblack::flow {

GivenExchange::Sample::Sample(const GivenExchange& exchange, double z) : exchange_(&exchange) {
  const std::vector<double>& points = exchange.z;
  if (points.size() < 2 || z < points.front() || z > points.back()) return;
  const auto above = std::upper_bound(points.begin(), points.end(), z) - points.begin();
  upper_ = std::min(static_cast<std::size_t>(above), points.size() - 1);
  upperShare_ = (z - points[upper_ - 1]) / (points[upper_] - points[upper_ - 1]);
  lowerShare_ = 1 - upperShare_;
}

double GivenExchange::Sample::between(const std::vector<double>& values, std::size_t stride, std::size_t k) const {
  if (upper_ == 0) return 0;
  return lowerShare_ * values[(upper_ - 1) * stride + k] + upperShare_ * values[upper_ * stride + k];
}

double GivenExchange::Sample::species(std::size_t k) const {
  return between(exchange_->species, exchange_->species.size() / std::max<std::size_t>(exchange_->z.size(), 1), k);
}

double GivenExchange::Sample::absorption() const {
  return between(exchange_->absorption, 1, 0);
}

double GivenExchange::Sample::enthalpy() const {
  return between(exchange_->enthalpy, 1, 0);
}

}  // namespace lampblack::flow
