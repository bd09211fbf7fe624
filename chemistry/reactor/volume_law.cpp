#include "chemistry/reactor/volume_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {
namespace {

// The isentrope of a gas of frozen composition: ln of temperature over ln of pressure, at even distances.
MonotoneCubic isentrope(const Mechanism& mechanism, double temperature, std::span<const double> Y, double lastRatio) {
  constexpr int steps = 2000;
  const Thermo thermo(mechanism);
  double moles = 0;
  for (std::size_t k = 0; k < Y.size(); ++k) moles += Y[k] / mechanism.molecularWeights()[k];
  const double R = constants::gasConstant * moles, step = std::log(lastRatio) / steps;
  const auto slope = [&](double logT) { return R / thermo.cpMass(std::exp(logT), Y); };
  std::vector<double> logP{0.0}, logT{std::log(temperature)};
  for (int i = 0; i < steps; ++i) {  // Runge-Kutta, classical
    const double at = logT.back();
    const double a = slope(at), b = slope(at + 0.5 * step * a), c = slope(at + 0.5 * step * b),
                 d = slope(at + step * c);
    logT.push_back(at + step / 6 * (a + 2 * b + 2 * c + d));
    logP.push_back(step * (i + 1));
    const double T = std::exp(logT.back());
    if (!(T >= Thermo::minTemperature && T <= Thermo::maxTemperature))
      throw InputError(
          fmt::format("along this rise of pressure the unreacted gas leaves {} to {} K before the end; "
                      "a smaller rise or an earlier end",
                      Thermo::minTemperature, Thermo::maxTemperature));
  }
  if (step < 0) {
    std::reverse(logP.begin(), logP.end());
    std::reverse(logT.begin(), logT.end());
  }
  return {std::move(logP), std::move(logT)};
}

}  // namespace

VolumeLaw::VolumeLaw(Function volume, Function slope) : volume_(std::move(volume)), slope_(std::move(slope)) {
  initial_ = volume_(0.0);
}

VolumeLaw VolumeLaw::table(std::vector<double> times, std::vector<double> volumes) {
  for (const double volume : volumes)
    if (!(volume > 0)) throw InputError(fmt::format("expected volumes above zero, found {:g}", volume));
  const auto cubic = std::make_shared<MonotoneCubic>(std::move(times), std::move(volumes));
  VolumeLaw law([cubic](double t) { return cubic->at(t).value; }, [cubic](double t) { return cubic->at(t).slope; });
  law.points_ = cubic->points();
  law.kinks_ = {cubic->points().front(), cubic->points().back()};
  return law;
}

VolumeLaw VolumeLaw::piston(const SliderCrank& crank, double startAngle, double speed) {
  return {[=](double t) { return crank.volume(startAngle + speed * t); },
          [=](double t) { return speed * crank.slope(startAngle + speed * t); }};
}

VolumeLaw VolumeLaw::formula(std::function<double(double)> volume, double end) {
  const double h = 1e-4 * end;
  const auto slope = [volume, h](double t) {
    const auto central = [&](double step) { return (volume(t + step) - volume(t - step)) / (2 * step); };
    return (4 * central(h) - central(2 * h)) / 3;
  };
  return {volume, slope};
}

VolumeLaw VolumeLaw::pressureRise(const Mechanism& mechanism, double temperature, std::span<const double> Y,
                                  double rate, double end) {
  const double last = 1 + rate * end;
  if (!(last > 0)) throw InputError("the pressure falls to zero before the end; a smaller fall or an earlier end");
  if (rate == 0) return {[](double) { return 1.0; }, [](double) { return 0.0; }};
  // A little beyond the end, where an integrator may look.
  const auto curve = std::make_shared<MonotoneCubic>(isentrope(mechanism, temperature, Y, std::pow(last, 1.01)));
  const double logT0 = std::log(temperature);
  const auto volume = [=](double t) {
    const double logP = std::log1p(rate * t);
    return std::exp(curve->at(logP).value - logT0 - logP);
  };
  return {volume, [=](double t) {
            const double ratio = 1 + rate * t;
            return volume(t) * (curve->at(std::log(ratio)).slope - 1) * rate / ratio;
          }};
}

double VolumeLaw::smallestAt(double end) const {
  std::vector<double> times{0.0};
  if (points_.empty())
    for (int i = 1; i < 2000; ++i) times.push_back(end * i / 2000);
  else
    for (const double t : points_)
      if (t > 0 && t < end) times.push_back(t);
  times.push_back(end);
  std::size_t best = 0;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (ratio(times[i]) < ratio(times[best]) * (1 - 1e-4)) best = i;  // of equal ones the first
  while (best + 1 < times.size() && ratio(times[best + 1]) < ratio(times[best])) ++best;
  if (best == 0 || best + 1 == times.size() || !points_.empty()) return times[best];
  double low = times[best - 1], high = times[best + 1];  // the slope changes its sign between
  for (int i = 0; i < 200 && high - low > 1e-15 * end; ++i) {
    const double middle = 0.5 * (low + high);
    (expansion(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace lampblack::chemistry
