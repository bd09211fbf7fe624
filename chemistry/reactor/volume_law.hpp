// The volume of a closed reactor as a given function of time: of a piston, of a rapid compression machine's trace, of a
// shock tube whose pressure rises by itself. Only its ratio to the volume at time zero counts.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/slider_crank.hpp"
#include "core/modules.hpp"
#include "numerics/monotone_cubic.hpp"

namespace lampblack::chemistry {

class VolumeLaw {
 public:
  // Volumes (above zero, any unit) over time (s): a monotone cubic through the points, constant beyond them.
  // InputError where one is not above zero.
  static VolumeLaw table(std::vector<double> times, std::vector<double> volumes);
  // A piston, from an angle (rad) after top dead centre at time zero, by a crank that turns at `speed` (rad/s).
  static VolumeLaw piston(const SliderCrank& crank, double startAngle, double speed);
  // A function of time (any unit), above zero from 0 to `end`; its slope by differences of fourth order.
  static VolumeLaw formula(std::function<double(double)> volume, double end);
  // What a gas of frozen composition does whose pressure rises along an isentrope by `rate` (1/s) of its first value:
  // p = p_0 (1 + rate t). Reflected shocks do so (Chaos and Dryer, Int. J. Chem. Kinet. 42 (2010) 143-150).
  // Good until the pressure is zero, or the temperature leaves the range of the data: InputError before `end`.
  static VolumeLaw pressureRise(const Mechanism& mechanism, double temperature, std::span<const double> Y, double rate,
                                double end);

  [[nodiscard]] double ratio(double time) const { return volume_(time) / initial_; }          // V/V(0)
  [[nodiscard]] double expansion(double time) const { return slope_(time) / volume_(time); }  // V'/V, 1/s
  // Times at which the slope jumps, rising.
  [[nodiscard]] const std::vector<double>& kinks() const { return kinks_; }
  // Where the volume is smallest from 0 to `end`, the first such time: the end of a compression. Zero without one.
  [[nodiscard]] double smallestAt(double end) const;

 private:
  using Function = std::function<double(double)>;
  VolumeLaw(Function volume, Function slope);

  Function volume_, slope_;
  double initial_ = 1;
  std::vector<double> kinks_, points_;
};

}  // namespace lampblack::chemistry
