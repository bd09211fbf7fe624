#include "chemistry/reactor/temperature_profile.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "chemistry/thermo/thermo.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

TemperatureProfile::TemperatureProfile(double temperature) : TemperatureProfile({0.0}, {temperature}) {}

TemperatureProfile::TemperatureProfile(std::vector<double> points, std::vector<double> temperatures)
    : points_(std::move(points)), temperatures_(std::move(temperatures)) {
  if (points_.empty() || points_.size() != temperatures_.size())
    throw InputError(
        fmt::format("a temperature profile needs as many temperatures as points, found {} points and {} "
                    "temperatures",
                    points_.size(), temperatures_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (i > 0 && !(points_[i] > points_[i - 1]))
      throw InputError(
          fmt::format("the points of a temperature profile have to rise; {} follows {}", points_[i], points_[i - 1]));
    if (!(temperatures_[i] >= Thermo::minTemperature && temperatures_[i] <= Thermo::maxTemperature))
      throw InputError(fmt::format("expected temperatures from {} to {} K, found {} K", Thermo::minTemperature,
                                   Thermo::maxTemperature, temperatures_[i]));
  }
}

double TemperatureProfile::value(double x) const {
  if (x <= points_.front()) return temperatures_.front();
  if (x >= points_.back()) return temperatures_.back();
  const auto next = static_cast<std::size_t>(std::upper_bound(points_.begin(), points_.end(), x) - points_.begin());
  return temperatures_[next - 1] + slope(x) * (x - points_[next - 1]);
}

double TemperatureProfile::slope(double x) const {
  if (x < points_.front() || x >= points_.back()) return 0.0;
  const auto next = static_cast<std::size_t>(std::upper_bound(points_.begin(), points_.end(), x) - points_.begin());
  return (temperatures_[next] - temperatures_[next - 1]) / (points_[next] - points_[next - 1]);
}

std::optional<double> TemperatureProfile::nextKink(double x) const {
  const auto next = std::upper_bound(points_.begin(), points_.end(), x);
  if (points_.size() < 2 || next == points_.end()) return std::nullopt;
  return *next;
}

}  // namespace lampblack::chemistry
