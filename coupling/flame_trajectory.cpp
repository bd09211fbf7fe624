#include "coupling/flame_trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/mechanism/known_species.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "particles/collisions/collision_physics.hpp"

namespace lampblack::coupling {
namespace {

// Derivative of a parabola through three points at the middle one (or, at the ends, a straight line).
double slope(const std::vector<double>& z, const std::vector<double>& f, std::size_t i) {
  const std::size_t last = z.size() - 1;
  if (i == 0) return (f[1] - f[0]) / (z[1] - z[0]);
  if (i == last) return (f[last] - f[last - 1]) / (z[last] - z[last - 1]);
  const double a = z[i] - z[i - 1], b = z[i + 1] - z[i];
  return (a / b * (f[i + 1] - f[i]) + b / a * (f[i] - f[i - 1])) / (a + b);
}

struct FlamePathPoint : GasSample {
  double z = 0, velocity = 0;
};

FlamePathPoint pointAt(const GasOfFlame& gas, std::size_t i) {
  FlamePathPoint p;
  p.z = gas.z[i];
  p.velocity = gas.velocity[i] + gas.thermophoresis[i];
  p.gas = gas.carrier[i];
  const std::size_t n = gas.concentrations.size() / gas.z.size();
  const auto first = gas.concentrations.begin() + static_cast<std::ptrdiff_t>(i * n);
  p.concentrations.assign(first, first + static_cast<std::ptrdiff_t>(n));
  return p;
}

FlamePathPoint between(const FlamePathPoint& a, const FlamePathPoint& b, double w) {
  const auto mix = [w](double x, double y) { return (1 - w) * x + w * y; };
  return {mixed(a, b, w), mix(a.z, b.z), mix(a.velocity, b.velocity)};
}

// Time from one point to the next with a velocity that is linear in z.
double travel(const FlamePathPoint& a, const FlamePathPoint& b) {
  const double ratio = b.velocity / a.velocity, dz = b.z - a.z;
  if (std::abs(ratio - 1) < 1e-6) return 2 * dz / (a.velocity + b.velocity);
  return dz * std::log(ratio) / (b.velocity - a.velocity);
}

}  // namespace

GasOfFlame flameGasOf(std::span<const std::string> names, const FlameProfile& profile, const Mechanism& mechanism,
                      double pressure, double thermophoresis) {
  const std::size_t n = mechanism.numSpecies(), points = profile.points();
  GasOfFlame gas;
  gas.z = profile.z;
  std::vector<std::optional<std::size_t>> species;
  for (const std::string& name : names) species.push_back(findKnownSpecies(mechanism, name));
  Transport transport(mechanism);
  const auto weights = mechanism.molecularWeights();
  std::vector<double> X(n), D(n), T(points);
  for (std::size_t i = 0; i < points; ++i) {
    const auto Y = profile.massFractions(i);
    T[i] = profile.temperature(i);
    double moles = 0;  // per kg
    for (std::size_t k = 0; k < n; ++k) moles += X[k] = std::max(Y[k], 0.0) / weights[k];
    for (double& x : X) x /= moles;
    CarrierGas s;
    s.temperature = T[i];
    s.pressure = pressure;
    s.meanMolecularWeight = 1 / moles;
    s.density = pressure / (constants::gasConstant * T[i] * moles);
    s.viscosity = transport.mixture(T[i], pressure, X, D).viscosity;
    const double c = s.density * moles;
    for (const auto k : species) gas.concentrations.push_back(k ? c * X[*k] : 0.0);
    gas.carrier.push_back(s);
    gas.spread.push_back(profile.at(i, FlameLayout::spread));
  }
  for (std::size_t i = 0; i < points; ++i) {
    // Mass fluxes are those through the faces halfway to the neighbours, linear in between.
    const double left = i == 0 ? profile.global(leftMassFlux) : profile.at(i - 1, FlameLayout::massFlux);
    const double right = profile.at(i, FlameLayout::massFlux);
    double flux = i == 0 ? left : right;
    if (i > 0 && i + 1 < points)
      flux = left + (right - left) * (gas.z[i] - gas.z[i - 1]) / (gas.z[i + 1] - gas.z[i - 1]);
    gas.velocity.push_back(flux / gas.carrier[i].density);
    const double nu = gas.carrier[i].viscosity / gas.carrier[i].density;
    gas.thermophoresis.push_back(-thermophoresis * nu * slope(gas.z, T, i) / T[i]);
  }
  return gas;
}

GasOfFlame gasOfFlame(const FlameProfile& profile, const Mechanism& mechanism, double pressure,
                      const StochasticPopulation& kind) {
  std::vector<std::string> names;
  for (const std::size_t k : kind.species()) names.push_back(mechanism.speciesName(k));
  return flameGasOf(names, profile, mechanism, pressure, waldmannThermophoresis());
}

FlamePath flamePath(const GasOfFlame& gas, const FlamePathOptions& options) {
  const std::size_t gridPoints = gas.z.size();
  const double sign = options.fromRight ? -1 : 1;
  const auto at = [&](std::size_t k) { return options.fromRight ? gridPoints - 1 - k : k; };
  FlamePath result;
  std::vector<FlamePathPoint> points;
  std::size_t k = 0;
  if (options.start) {
    while (k < gridPoints && sign * (gas.z[at(k)] - *options.start) < 0) ++k;
  }
  for (; k < gridPoints && !result.stagnates; ++k) {
    FlamePathPoint next = pointAt(gas, at(k));
    if (points.empty()) {
      result.stagnates = !(sign * next.velocity > options.slowest);
      points.push_back(std::move(next));
      continue;
    }
    const FlamePathPoint& from = points.back();
    if (sign * next.velocity < options.slowest) {
      const double v = sign * from.velocity;
      next = between(from, next, (v - options.slowest) / (v - sign * next.velocity));
      next.velocity = sign * options.slowest;
      result.stagnates = true;
    }
    const double dt = travel(from, next);
    next.time = from.time + dt;
    const double spread = 0.5 * (gas.spread[at(k - 1)] + gas.spread[at(k)]);
    const double mean = std::log(next.velocity / from.velocity) / dt + 2 * spread;
    result.path.divergence.push_back({mean, mean});
    points.push_back(std::move(next));
  }
  if (points.size() < 2) return result;
  for (FlamePathPoint& point : points) {
    result.z.push_back(point.z);
    result.velocity.push_back(point.velocity);
    result.path.points.push_back(std::move(point));
  }
  return result;
}

}  // namespace lampblack::coupling
