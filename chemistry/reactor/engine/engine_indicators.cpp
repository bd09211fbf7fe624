#include "chemistry/reactor/engine/engine_indicators.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lampblack::chemistry {
namespace {

constexpr double pulsation = 5e-5;  // s, amplitude of a pressure wave over the steepest rise

}  // namespace

double burntAngle(const EngineTrace& trace, double part) {
  const double all = trace.chemical.back(), wanted = part * all;
  if (!(all > 0)) return std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 1; k < trace.angle.size(); ++k) {
    const double before = trace.chemical[k - 1], after = trace.chemical[k];
    if (after < wanted) continue;
    const double way = after > before ? (wanted - before) / (after - before) : 1;
    return trace.angle[k - 1] + way * (trace.angle[k] - trace.angle[k - 1]);
  }
  return trace.angle.back();
}

std::vector<double> netHeatRelease(const EngineTrace& trace) {
  const std::size_t n = trace.angle.size();
  std::vector<double> released(n, 0);
  for (std::size_t k = 0; k < n && n > 1; ++k) {
    const std::size_t a = k == 0 ? 0 : k - 1, b = k + 1 == n ? k : k + 1;
    const double g = trace.gamma[k];
    released[k] = (g * trace.pressure[k] * (trace.volume[b] - trace.volume[a]) +
                   trace.volume[k] * (trace.pressure[b] - trace.pressure[a])) /
                  ((g - 1) * (trace.angle[b] - trace.angle[a]));
  }
  return released;
}

void EnginePeaks::begin(double window, double time, double pressure) {
  *this = {};
  window_ = window;
  time_ = time;
  pressure_ = pressure;
  times_ = {time};
  pressures_ = {pressure};
}

bool EnginePeaks::add(double time, double pressure) {
  times_.push_back(time);
  pressures_.push_back(pressure);
  // The last point at or before the begin of the window becomes the first.
  const double from = std::max(times_.front(), time - window_);
  std::size_t first = 0;
  while (times_[first + 1] <= from) ++first;
  times_.erase(times_.begin(), times_.begin() + static_cast<std::ptrdiff_t>(first));
  pressures_.erase(pressures_.begin(), pressures_.begin() + static_cast<std::ptrdiff_t>(first));
  const double way = (from - times_[0]) / (times_[1] - times_[0]);
  const double before = pressures_[0] + way * (pressures_[1] - pressures_[0]);
  if (time - from > (1 - 1e-9) * window_) rise_ = std::max(rise_, (pressure - before) / (time - from));
  if (!(pressure > pressure_)) return false;
  pressure_ = pressure;
  time_ = time;
  return true;
}

void EnginePeaks::setGas(double temperature, double gamma, double gasConstant) {
  temperature_ = temperature;
  gamma_ = gamma;
  gasConstant_ = gasConstant;
}

double EnginePeaks::ringing() const {
  const double swing = pulsation * rise_;
  return swing * swing / (2 * gamma_ * pressure_) * std::sqrt(gamma_ * gasConstant_ * temperature_);
}

std::vector<double> EnginePeaks::packed() const {
  std::vector<double> all{window_, pressure_, time_, rise_, temperature_, gamma_, gasConstant_};
  all.insert(all.end(), times_.begin(), times_.end());
  all.insert(all.end(), pressures_.begin(), pressures_.end());
  return all;
}

void EnginePeaks::unpack(const std::vector<double>& values) {
  double* const members[] = {&window_, &pressure_, &time_, &rise_, &temperature_, &gamma_, &gasConstant_};
  for (std::size_t k = 0; k < std::size(members); ++k) *members[k] = values.at(k);
  const auto points = values.begin() + static_cast<std::ptrdiff_t>(std::size(members));
  const auto half = points + (values.end() - points) / 2;
  times_.assign(points, half);
  pressures_.assign(half, values.end());
}

}  // namespace lampblack::chemistry
