// The gas between the streams of a flame as a first guess: cold mixtures of them, and chemical equilibrium where they
// burn. In terms of a share of the left stream, from 0 to 1; the elements and the enthalpy are those of the mixture
// everywhere.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_problem.hpp"

namespace lampblack::flow {

// What a gas could burn and burn with: mol of O atoms per kg that are missing to CO2, H2O (SO2, SiO2), and that are
// there to be had. Products have neither.
struct FuelAndOxidiser {
  double fuel = 0, oxidiser = 0;
};
[[nodiscard]] FuelAndOxidiser fuelAndOxidiser(const Mechanism& mechanism, std::span<const double> Y);

class StreamMixture {
 public:
  // The fresh stream on the left (share 1) and its products at constant enthalpy (share 0). InputError if it gets
  // hardly warmer by burning; a stream without fuel or without oxidiser may burn by itself (hydrogen peroxide, ozone,
  // acetylene).
  static StreamMixture premixed(const Mechanism& mechanism, const FlameProblem& problem);
  // Two streams that burn where they are stoichiometric, and next to a stream that is flammable by itself; where there
  // is no such place, next to a stream that decomposes to hotter products. InputError if there is none either.
  static StreamMixture counterflow(const Mechanism& mechanism, const FlameStream& left, const FlameStream& right,
                                   double pressure);
  // Streams that mix and do not burn.
  static StreamMixture cold(const Mechanism& mechanism, const FlameStream& left, const FlameStream& right);

  // The mixture at a share of the left stream; the temperature is returned (K).
  double at(double share, std::span<double> Y) const;
  [[nodiscard]] double hottest() const { return hottest_; }  // K, of streams and equilibria
  // The share where the gas is hottest.
  [[nodiscard]] double hottestShare() const { return hottestShare_; }

 private:
  // A composition; between two of them Y is linear in the share.
  struct Knot {
    double share = 0;
    std::vector<double> Y;
  };

  StreamMixture(const Mechanism& mechanism, const FlameStream& left, const FlameStream& right);
  void addEquilibrium(const Mechanism& mechanism, double share, double pressure);

  Thermo thermo_;
  double leftEnthalpy_ = 0, rightEnthalpy_ = 0;  // J/kg
  double hottest_ = 0, hottestShare_ = 0;
  std::vector<Knot> knots_;  // by rising share
};

// Why the streams of a flame cannot burn ("the stream has no fuel"); empty where they can.
[[nodiscard]] std::string inertReason(const Mechanism& mechanism, const FlameProblem& problem);

}  // namespace lampblack::flow
