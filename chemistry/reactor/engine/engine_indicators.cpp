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

PressureRise steepestRise(const EngineTrace& trace) {
  PressureRise most;
  for (std::size_t k = 1; k < trace.angle.size(); ++k) {
    const double rise = trace.pressure[k] - trace.pressure[k - 1];
    most.perAngle = std::max(most.perAngle, rise / (trace.angle[k] - trace.angle[k - 1]));
    most.perTime = std::max(most.perTime, rise / (trace.time[k] - trace.time[k - 1]));
  }
  return most;
}

double ringingIntensity(const EngineTrace& trace) {
  const auto at = static_cast<std::size_t>(std::ranges::max_element(trace.pressure) - trace.pressure.begin());
  const double g = trace.gamma[at], swing = pulsation * steepestRise(trace).perTime;
  return swing * swing / (2 * g * trace.pressure[at]) * std::sqrt(g * trace.gasConstant[at] * trace.temperature[at]);
}

}  // namespace lampblack::chemistry
