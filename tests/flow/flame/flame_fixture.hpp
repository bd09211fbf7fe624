// A small hydrogen flame for tests of what flames are made of.
#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_problem.hpp"
#include "flow/flame/flame_profile.hpp"
#include "tests/flow/flame/streams.hpp"

namespace lampblack::flow {

inline std::shared_ptr<const Mechanism> hydrogenMechanism() {
  static const auto mechanism = std::make_shared<const Mechanism>(shippedMechanism("hydrogen_h2o2_10.yaml"));
  return mechanism;
}

inline FlameStream hydrogenStream(const std::string& composition, double temperature, double massFlux) {
  return streamOf(*hydrogenMechanism(), composition, temperature, massFlux);
}

inline FlameProblem hydrogenProblem(FlameType type) {
  FlameProblem problem;
  problem.type = type;
  problem.length = 0.02;
  if (type == FlameType::Counterflow) {
    problem.left = hydrogenStream("H2: 1, N2: 1", 300, 0.4);
    problem.right = hydrogenStream("O2: 0.21, N2: 0.79", 300, 0.6);
  } else {
    problem.left = hydrogenStream("H2: 0.4, O2: 0.21, N2: 0.79", 300, 0.8);
  }
  // Fast enough that the flame stands off the nozzle.
  if (type == FlameType::Wall) problem.left.massFlux = 3;
  problem.wallTemperature = 400;
  return problem;
}

// Smooth profiles without any meaning but that all terms of the equations are there.
inline FlameProfile roughFlame(const FlameProblem& problem, std::size_t points, std::size_t scalars = 0) {
  const auto mechanism = hydrogenMechanism();
  const std::size_t n = mechanism->numSpecies();
  FlameProfile p{{n, scalars}, {}, {}};
  for (std::size_t i = 0; i < points; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(points - 1);
    p.z.push_back(problem.length * (s + 0.3 * s * (1 - s)));
  }
  p.x.assign(p.size(), 0.0);
  std::vector<double> X(n), Y(n);
  Thermo thermo(*mechanism);
  for (std::size_t i = 0; i < points; ++i) {
    const double s = p.z[i] / problem.length, hot = std::sin(3 * s) * std::sin(3 * s);
    p.at(i, FlameLayout::massFlux) = 0.5 - (problem.type == FlameType::Counterflow ? s : 0.2 * s);
    p.at(i, FlameLayout::spread) = 40 * s * (1 - s);
    p.at(i, FlameLayout::temperature) = 400 + 1500 * hot;
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k)
      sum += X[k] = 0.02 + 0.2 * std::abs(std::sin(1.0 + 2.3 * static_cast<double>(k) + s));
    for (double& x : X) x /= sum;
    thermo.moleToMass(X, Y);
    for (std::size_t k = 0; k < n; ++k) p.at(i, FlameLayout::firstSpecies + k) = Y[k];
    for (std::size_t c = 0; c < scalars; ++c)
      p.at(i, p.layout.firstScalar() + c) = 0.5 + 0.3 * std::cos(5 * s + static_cast<double>(c));
  }
  p.global(leftMassFlux) = 0.45;
  p.global(pressureGradient) = -800;
  p.global(load) = 1;
  return p;
}

}  // namespace lampblack::flow
