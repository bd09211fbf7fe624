// How fast reactions run away: the largest growth rate of a gas's reactions, the eigenvalue with the largest positive
// real part of their Jacobian at constant pressure and enthalpy (the chemical explosive mode; Lu, Yoo, Chen, Law 2010).
#pragma once

#include <span>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "core/modules.hpp"
#include "numerics/dense_lu.hpp"

namespace lampblack::chemistry {

class GrowthRate {
 public:
  // `leastFraction`: of ReactorSystem.
  GrowthRate(const Mechanism& mechanism, double leastFraction);

  // 1/s, of a gas (T in K, p in Pa) whose reactions go with a factor on their rates; zero where nothing grows with a
  // rate of 0.9/dt or more (dt in s), or where the state is none. By power iteration with (1 - h J)^-1 for some h, from
  // the rates themselves, which have no part in what reactions conserve; for rates up to 60/dt, beyond which it may be
  // missed.
  [[nodiscard]] double of(double temperature, double pressure, std::span<const double> Y, double dt,
                          double rateFactor = 1);

 private:
  [[nodiscard]] double growth(double h);
  double normalise();

  std::size_t n_;
  ReactorSystem system_;
  DenseLu lu_;
  std::vector<double> state_, rates_, jacobian_, vector_;
};

}  // namespace lampblack::chemistry
