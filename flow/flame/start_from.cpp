// A flame as the start of another one (initial_flame.hpp).
#include <algorithm>
#include <cmath>
#include <string>

#include "chemistry/thermo/thermo.hpp"
#include "core/errors.hpp"
#include "flow/flame/flame_continuity.hpp"
#include "flow/flame/flame_grid.hpp"
#include "flow/flame/initial_flame.hpp"

namespace lampblack::flow {
namespace {

// The profile on the names of another mechanism and of other scalars.
FlameProfile renamed(const NamedFlameProfile& other, const Mechanism& mechanism, std::span<const std::string> scalars) {
  const FlameProfile& from = other.profile;
  if (other.species.size() != from.layout.species || other.scalars.size() != from.layout.scalars || from.points() < 2 ||
      from.x.size() != from.size())
    throw InputError("flame: the profile to start from does not fit its own names");
  FlameProfile to;
  to.layout = {mechanism.numSpecies(), scalars.size()};
  to.z = from.z;
  to.x.assign(to.size(), 0.0);
  std::copy(from.x.end() - numFlameGlobals, from.x.end(), to.x.end() - numFlameGlobals);
  for (std::size_t i = 0; i < from.points(); ++i) {
    for (std::size_t c = 0; c < FlameLayout::firstSpecies; ++c) to.at(i, c) = from.at(i, c);
    double sum = 0;
    for (std::size_t k = 0; k < other.species.size(); ++k)
      if (const auto found = mechanism.findSpecies(other.species[k])) {
        const double Y = std::max(from.at(i, FlameLayout::firstSpecies + k), 0.0);
        to.at(i, FlameLayout::firstSpecies + *found) = Y;
        sum += Y;
      }
    if (!(sum > 0))
      throw InputError("flame: the profile to start from has no species of " + mechanism.fileName() +
                       " at z = " + std::to_string(from.z[i]) + " m");
    for (std::size_t k = 0; k < to.layout.species; ++k) to.at(i, FlameLayout::firstSpecies + k) /= sum;
    for (std::size_t s = 0; s < scalars.size(); ++s) {
      const auto found = std::ranges::find(other.scalars, scalars[s]);
      if (found == other.scalars.end()) continue;
      const auto old = static_cast<std::size_t>(found - other.scalars.begin());
      to.at(i, to.layout.firstScalar() + s) = from.at(i, from.layout.firstScalar() + old);
    }
  }
  return to;
}

// Lengths of counterflows and walls are stretched; a premixed flame keeps its shape, in a domain with its right end
// elsewhere. A free flame that has widened its domain keeps it.
void fitLength(FlameProfile& profile, const FlameProblem& problem) {
  const double start = profile.z.front();
  const double old = profile.z.back() - start;
  for (double& z : profile.z) z -= start;
  profile.z.back() = old;
  const bool spreading = problem.type == FlameType::Counterflow || problem.type == FlameType::Wall;
  if (spreading) {
    for (double& z : profile.z) z *= problem.length / old;
    profile.z.back() = problem.length;
  } else if (old < problem.length * (1 - 1e-9)) {
    profile = widened(profile, 0, problem.length - old);
    profile.z.back() = problem.length;
  } else if (old > problem.length * (1 + 1e-9) && problem.type == FlameType::Burner) {
    auto z = profile.z;
    std::erase_if(z, [&](double at) { return at >= problem.length * (1 - 1e-6); });
    if (z.size() < 2) throw InputError("flame: the profile to start from has no points on the length of the new one");
    z.push_back(problem.length);
    profile = onGrid(profile, z);
  }
}

// Brings an end to a stream. The change fades away where the temperature has gone half of its way to the hottest.
void setStream(FlameProfile& profile, const FlameStream& stream, bool right) {
  const std::size_t n = profile.points();
  const std::size_t end = right ? n - 1 : 0;
  std::size_t hottest = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (profile.temperature(i) > profile.temperature(hottest)) hottest = i;
  const double from = profile.temperature(end);
  const double rise = profile.temperature(hottest) - from;
  std::vector<double> change;
  for (std::size_t k = 0; k < stream.Y.size(); ++k)
    change.push_back(stream.Y[k] - profile.at(end, FlameLayout::firstSpecies + k));
  const double warmer = stream.temperature - from;
  for (std::size_t step = 0; step < n; ++step) {
    const std::size_t i = right ? n - 1 - step : step;
    if (i == hottest && i != end) break;
    const double way = rise > 0 ? std::clamp((profile.temperature(i) - from) / rise, 0.0, 1.0) : 0.0;
    const double weight = i == end ? 1 : std::max(0.0, 1 - 2 * way);
    if (weight == 0) break;
    profile.at(i, FlameLayout::temperature) += weight * warmer;
    double sum = 0;
    for (std::size_t k = 0; k < stream.Y.size(); ++k) {
      double& Y = profile.at(i, FlameLayout::firstSpecies + k);
      Y = std::max(Y + weight * change[k], 0.0);
      sum += Y;
    }
    for (std::size_t k = 0; k < stream.Y.size(); ++k) profile.at(i, FlameLayout::firstSpecies + k) /= sum;
  }
  std::copy(stream.Y.begin(), stream.Y.end(), &profile.at(end, FlameLayout::firstSpecies));
  profile.at(end, FlameLayout::temperature) = stream.temperature;
}

void setFlow(FlameProfile& profile, const Mechanism& mechanism, const FlameProblem& problem) {
  const Thermo thermo(mechanism);
  std::vector<double> density;
  for (std::size_t i = 0; i < profile.points(); ++i)
    density.push_back(thermo.density(profile.temperature(i), problem.pressure, profile.massFractions(i)));
  const std::size_t last = profile.points() - 1;
  profile.global(load) = 1;
  if (problem.type == FlameType::Free || problem.type == FlameType::Burner) {
    for (std::size_t i = 0; i <= last; ++i) profile.at(i, FlameLayout::spread) = 0;
    profile.global(pressureGradient) = 0;
    setMassFlux(profile, density,
                problem.type == FlameType::Free ? profile.global(leftMassFlux) : problem.left.massFlux);
  } else if (problem.nozzles == FlameNozzles::Plug) {
    profile.at(0, FlameLayout::spread) = profile.at(last, FlameLayout::spread) = 0;
    scaleSpreading(profile, density, problem.left.massFlux, problem.right ? -problem.right->massFlux : 0.0);
  } else {
    // Spreading as the pressure gradient makes it in the stream that is told the strain rate.
    const double a = problem.strainRate;
    const double known = problem.right ? density[last] : density[0];
    const double old = std::sqrt(std::max(-profile.global(pressureGradient) / known, 0.0));
    if (!(old > 0)) throw InputError("flame: the profile to start from does not spread");
    for (std::size_t i = 0; i <= last; ++i) profile.at(i, FlameLayout::spread) *= a / old;
    profile.at(0, FlameLayout::spread) = a * std::sqrt(known / density[0]);
    profile.at(last, FlameLayout::spread) = problem.right ? a : 0;
    profile.global(pressureGradient) = -known * a * a;
    setMassFlux(profile, density, 0);
    // The flux that leaves none at the wall or the stagnation plane.
    double there = profile.at(last, FlameLayout::massFlux);
    for (std::size_t i = 0; problem.right && i < last; ++i)
      if (0.5 * (profile.z[i] + profile.z[i + 1]) >= problem.stagnationPlane) {
        there = profile.at(i, FlameLayout::massFlux);
        break;
      }
    setMassFlux(profile, density, -there);
  }
}

}  // namespace

FlameProfile startFrom(const NamedFlameProfile& other, const Mechanism& mechanism, const FlameProblem& problem,
                       std::span<const std::string> scalars) {
  FlameProfile profile = renamed(other, mechanism, scalars);
  fitLength(profile, problem);
  setStream(profile, problem.left, false);
  if (problem.type == FlameType::Counterflow) {
    if (!problem.right) throw InputError("flame: a counterflow needs a stream at the right end");
    setStream(profile, *problem.right, true);
  }
  if (problem.type == FlameType::Wall)
    profile.at(profile.points() - 1, FlameLayout::temperature) = problem.wallTemperature;
  setFlow(profile, mechanism, problem);
  return profile;
}

}  // namespace lampblack::flow
