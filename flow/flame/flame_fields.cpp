#include "flow/flame/flame_fields.hpp"

#include <algorithm>
#include <cmath>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/thermo/sound_speed.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "chemistry/transport/multicomponent_transport.hpp"
#include "chemistry/transport/transport.hpp"

namespace lampblack::flow {
namespace {

// Linear between the two faces of a point's control volume, whose places are halfway to its neighbours (or the ends).
double massFluxAt(const FlameProfile& profile, std::size_t i) {
  const auto& z = profile.z;
  if (i == 0) return profile.global(leftMassFlux);
  const double below = profile.at(i - 1, FlameLayout::massFlux), above = profile.at(i, FlameLayout::massFlux);
  if (i + 1 == z.size()) return above;
  return below + (above - below) * (z[i] - z[i - 1]) / (z[i + 1] - z[i - 1]);
}

}  // namespace

FlameFields flameFields(const Mechanism& mechanism, const FlameProblem& problem, const FlameProfile& profile) {
  const std::size_t points = profile.points(), n = mechanism.numSpecies();
  FlameFields f;
  f.z = profile.z;
  for (auto* field : {&f.temperature, &f.density, &f.velocity, &f.massFlux, &f.spread, &f.viscosity, &f.conductivity,
                      &f.cp, &f.meanMolecularWeight, &f.heatRelease, &f.soundSpeed})
    field->resize(points);
  f.X.resize(points * n);
  f.Y.resize(points * n);
  const Thermo thermo(mechanism);
  Kinetics kinetics(mechanism);
  Transport transport(mechanism, problem.transport.averaged());
  std::optional<MulticomponentTransport> multicomponent;
  if (problem.transport.isMulticomponent()) multicomponent.emplace(mechanism, problem.transport.integrals);
  std::vector<double> c(n), wdot(n), h(n), D(n);
  for (std::size_t i = 0; i < points; ++i) {
    const double T = f.temperature[i] = profile.temperature(i);
    const auto Y = profile.massFractions(i);
    std::copy(Y.begin(), Y.end(), f.Y.begin() + static_cast<std::ptrdiff_t>(i * n));
    const std::span<double> X(f.X.data() + i * n, n);
    thermo.massToMole(Y, X);
    f.density[i] = thermo.density(T, problem.pressure, Y);
    f.meanMolecularWeight[i] = thermo.meanMolecularWeight(Y);
    f.cp[i] = thermo.cpMass(T, Y);
    f.soundSpeed[i] = soundSpeed(thermo, T, Y);
    f.massFlux[i] = massFluxAt(profile, i);
    f.velocity[i] = f.massFlux[i] / f.density[i];
    f.spread[i] = profile.at(i, FlameLayout::spread);
    const auto mixture = transport.mixture(T, problem.pressure, X, D);
    f.viscosity[i] = mixture.viscosity;
    f.conductivity[i] =
        multicomponent ? multicomponent->mixture(T, problem.pressure, X, D).conductivity : mixture.conductivity;
    for (std::size_t k = 0; k < n; ++k) c[k] = std::max(0.0, Y[k]) * f.density[i] / mechanism.molecularWeights()[k];
    kinetics.netProductionRates(T, c, wdot);
    thermo.speciesEnthalpies(T, h);
    double release = 0;
    for (std::size_t k = 0; k < n; ++k) release -= h[k] * mechanism.molecularWeights()[k] * wdot[k];
    f.heatRelease[i] = release;
  }
  return f;
}

namespace {

FlameStrain strainOf(const FlameProblem& problem, const FlameProfile& profile, const FlameFields& f) {
  FlameStrain strain;
  const std::size_t last = f.z.size() - 1;
  const double length = f.z[last] - f.z[0];
  strain.mean = std::abs(f.velocity[last] - f.velocity[0]) / length;
  for (std::size_t i = 0; i < last; ++i)
    strain.maximum = std::max(strain.maximum, std::abs((f.velocity[i + 1] - f.velocity[i]) / (f.z[i + 1] - f.z[i])));
  const double lambda = std::max(0.0, -profile.global(pressureGradient));
  strain.left = std::sqrt(lambda / f.density[0]);
  strain.right = std::sqrt(lambda / f.density[last]);
  if (problem.type == FlameType::Counterflow && problem.nozzles == FlameNozzles::Plug) {
    const double left = std::abs(f.velocity[0]), right = std::abs(f.velocity[last]);
    strain.global = 2 / length * (right + left * std::sqrt(f.density[0] / f.density[last]));
  }
  return strain;
}

}  // namespace

FlameSummary flameSummary(const FlameProblem& problem, const FlameProfile& profile, const FlameFields& f) {
  FlameSummary summary;
  const auto hottest = std::max_element(f.temperature.begin(), f.temperature.end());
  summary.maximumTemperature = *hottest;
  summary.positionOfMaximum = f.z[static_cast<std::size_t>(hottest - f.temperature.begin())];
  double slope = 0;
  for (std::size_t i = 0; i + 1 < f.z.size(); ++i) {
    const double dz = f.z[i + 1] - f.z[i];
    slope = std::max(slope, std::abs(f.temperature[i + 1] - f.temperature[i]) / dz);
    summary.heatRelease += 0.5 * dz * (f.heatRelease[i] + f.heatRelease[i + 1]);
    if (!summary.stagnationPlane && f.velocity[i] > 0 && f.velocity[i + 1] <= 0)
      summary.stagnationPlane = f.z[i] + dz * f.velocity[i] / (f.velocity[i] - f.velocity[i + 1]);
  }
  const double coldest = *std::min_element(f.temperature.begin(), f.temperature.end());
  summary.thermalThickness = slope > 0 ? (*hottest - coldest) / slope : 0;
  summary.leftVelocity = f.velocity.front();
  for (std::size_t i = 0; i < f.z.size(); ++i)
    summary.maximumMach = std::max(summary.maximumMach, std::abs(f.velocity[i]) / f.soundSpeed[i]);
  summary.pressureGradient = profile.global(pressureGradient);
  if (problem.type == FlameType::Counterflow || problem.type == FlameType::Wall)
    summary.strain = strainOf(problem, profile, f);
  return summary;
}

}  // namespace lampblack::flow
