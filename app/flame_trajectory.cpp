#include "app/flame_trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/transport/transport.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack {
namespace {

// Derivative of a parabola through three points at the middle one (or, at the ends, a straight line).
double slope(const std::vector<double>& z, const std::vector<double>& f, std::size_t i) {
  const std::size_t last = z.size() - 1;
  if (i == 0) return (f[1] - f[0]) / (z[1] - z[0]);
  if (i == last) return (f[last] - f[last - 1]) / (z[last] - z[last - 1]);
  const double a = z[i] - z[i - 1], b = z[i + 1] - z[i];
  return (a / b * (f[i + 1] - f[i]) + b / a * (f[i] - f[i - 1])) / (a + b);
}

SootPathPoint pointAt(const FlameSootGas& gas, std::size_t i) {
  SootPathPoint p;
  p.z = gas.z[i];
  p.velocity = gas.velocity[i] + gas.thermophoresis[i];
  p.gas = gas.state[i];
  const std::size_t n = gas.pah.size() / gas.z.size();
  const auto first = gas.pah.begin() + static_cast<std::ptrdiff_t>(i * n);
  p.pah.assign(first, first + static_cast<std::ptrdiff_t>(n));
  return p;
}

SootPathPoint between(const SootPathPoint& a, const SootPathPoint& b, double w) {
  SootPathPoint p = a;
  const auto mix = [w](double& x, double y) { x = (1 - w) * x + w * y; };
  mix(p.z, b.z);
  mix(p.velocity, b.velocity);
  p.gas = mixed(a, b, w, p.pah);
  p.gas.pah = {};
  return p;
}

// Time from one point to the next with a velocity that is linear in z.
double travel(const SootPathPoint& a, const SootPathPoint& b) {
  const double ratio = b.velocity / a.velocity, dz = b.z - a.z;
  if (std::abs(ratio - 1) < 1e-6) return 2 * dz / (a.velocity + b.velocity);
  return dz * std::log(ratio) / (b.velocity - a.velocity);
}

}  // namespace

FlameSootGas flameSootGas(const FlameProfile& profile, const Mechanism& mechanism, double pressure,
                          const std::vector<PahSpecies>& pah, double thermophoresis) {
  const std::size_t n = mechanism.numSpecies(), points = profile.points();
  FlameSootGas gas;
  gas.z = profile.z;
  std::vector<std::pair<double SootGasState::*, std::size_t>> species;
  const auto want = [&](double SootGasState::*member, const char* name) {
    if (const auto k = mechanism.findSpecies(name)) species.emplace_back(member, *k);
  };
  want(&SootGasState::H, "H");
  want(&SootGasState::H2, "H2");
  want(&SootGasState::OH, "OH");
  want(&SootGasState::H2O, "H2O");
  want(&SootGasState::O2, "O2");
  want(&SootGasState::C2H2, "C2H2");
  std::vector<std::size_t> pahIndex;
  pahIndex.reserve(pah.size());
  for (const PahSpecies& p : pah) pahIndex.push_back(mechanism.speciesIndex(p.name));
  Transport transport(mechanism);
  const auto weights = mechanism.molecularWeights();
  std::vector<double> X(n), D(n), T(points);
  for (std::size_t i = 0; i < points; ++i) {
    const auto Y = profile.massFractions(i);
    T[i] = profile.temperature(i);
    double moles = 0;  // per kg
    for (std::size_t k = 0; k < n; ++k) moles += X[k] = std::max(Y[k], 0.0) / weights[k];
    for (double& x : X) x /= moles;
    SootGasState s;
    s.temperature = T[i];
    s.pressure = pressure;
    s.meanMolecularWeight = 1 / moles;
    s.density = pressure / (constants::gasConstant * T[i] * moles);
    s.viscosity = transport.mixture(T[i], pressure, X, D).viscosity;
    const double c = s.density * moles;
    for (const auto& [member, k] : species) s.*member = c * X[k];
    for (const std::size_t k : pahIndex) gas.pah.push_back(c * X[k]);
    gas.state.push_back(s);
    gas.rho.push_back(s.density);
    gas.spread.push_back(profile.at(i, FlameLayout::spread));
  }
  for (std::size_t i = 0; i < points; ++i) {
    // Mass fluxes are those through the faces halfway to the neighbours, linear in between.
    const double left = i == 0 ? profile.global(leftMassFlux) : profile.at(i - 1, FlameLayout::massFlux);
    const double right = profile.at(i, FlameLayout::massFlux);
    double flux = i == 0 ? left : right;
    if (i > 0 && i + 1 < points)
      flux = left + (right - left) * (gas.z[i] - gas.z[i - 1]) / (gas.z[i + 1] - gas.z[i - 1]);
    gas.velocity.push_back(flux / gas.rho[i]);
    const double nu = gas.state[i].viscosity / gas.rho[i];
    gas.thermophoresis.push_back(-thermophoresis * nu * slope(gas.z, T, i) / T[i]);
  }
  return gas;
}

FlamePath flamePath(const FlameSootGas& gas, const FlamePathOptions& options) {
  const std::size_t points = gas.z.size();
  const double sign = options.fromRight ? -1 : 1;
  const auto at = [&](std::size_t k) { return options.fromRight ? points - 1 - k : k; };
  FlamePath result;
  SootPath& path = result.path;
  std::size_t k = 0;
  if (options.start) {
    while (k < points && sign * (gas.z[at(k)] - *options.start) < 0) ++k;
  }
  for (; k < points; ++k) {
    SootPathPoint next = pointAt(gas, at(k));
    if (path.points.empty()) {
      if (!(sign * next.velocity > options.slowest)) {
        result.stagnates = true;
        return result;
      }
      path.points.push_back(std::move(next));
      continue;
    }
    const SootPathPoint& from = path.points.back();
    if (sign * next.velocity < options.slowest) {
      const double v = sign * from.velocity;
      next = between(from, next, (v - options.slowest) / (v - sign * next.velocity));
      next.velocity = sign * options.slowest;
      result.stagnates = true;
    }
    const double dt = travel(from, next);
    next.time = from.time + dt;
    const double spread = 0.5 * (gas.spread[at(k - 1)] + gas.spread[at(k)]);
    path.divergence.push_back(std::log(next.velocity / from.velocity) / dt + 2 * spread);
    path.points.push_back(std::move(next));
    if (result.stagnates) break;
  }
  if (path.points.size() < 2) path = {};
  return result;
}

}  // namespace lampblack
