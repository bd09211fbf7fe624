#include "coupling/flame_coupling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "chemistry/mechanism/known_species.hpp"
#include "core/errors.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/models/soot_model.hpp"

namespace lampblack::coupling {
namespace {

double interpolate(const std::vector<double>& z, std::span<const double> f, std::size_t stride, std::size_t k,
                   double at) {
  if (z.size() < 2 || at < z.front() || at > z.back()) return 0;
  const auto upper = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::upper_bound(z.begin(), z.end(), at) - z.begin()), 1, z.size() - 1);
  const double share = (at - z[upper - 1]) / (z[upper] - z[upper - 1]);
  return (1 - share) * f[(upper - 1) * stride + k] + share * f[upper * stride + k];
}

// Volume fraction over z, of all paths.
struct Volumes {
  std::vector<double> z, value;
};

std::vector<Volumes> volumesOf(const std::vector<FlameEnsemblePath>& paths) {
  std::vector<Volumes> result;
  for (const FlameEnsemblePath& path : paths) {
    Volumes v;
    v.z = path.path.z;
    v.value = path.volumeFraction.mean;
    if (path.options.fromRight) {
      std::reverse(v.z.begin(), v.z.end());
      std::reverse(v.value.begin(), v.value.end());
    }
    result.push_back(std::move(v));
  }
  return result;
}

FlameCouplingStep describe(const std::vector<FlameEnsemblePath>& paths, const std::vector<Volumes>& volumes,
                           const std::vector<Volumes>& before) {
  FlameCouplingStep step;
  for (const FlameEnsemblePath& path : paths) {
    for (std::size_t k = 0; k < path.path.z.size(); ++k) {
      if (path.volumeFraction.mean[k] <= step.volumeFraction) continue;
      step.volumeFraction = path.volumeFraction.mean[k];
      step.noise = path.volumeFraction.error[k] / step.volumeFraction;
    }
    if (path.path.z.empty()) continue;
    const double out = std::abs(path.path.velocity.back());
    step.carbonLeaving += out * path.carbon.mean.back();
    step.hydrogenLeaving += out * path.hydrogen.mean.back();
  }
  for (std::size_t p = 0; p < before.size(); ++p)
    for (std::size_t k = 0; k < volumes[p].z.size(); ++k) {
      const double old = interpolate(before[p].z, before[p].value, 1, 0, volumes[p].z[k]);
      step.volumeFractionChange = std::max(step.volumeFractionChange, std::abs(volumes[p].value[k] - old));
    }
  step.volumeFractionChange = before.empty() ? 1 : step.volumeFractionChange / std::max(step.volumeFraction, 1e-300);
  return step;
}

double integral(const std::vector<double>& z, const std::vector<double>& f) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < z.size(); ++i) sum += 0.5 * (f[i] + f[i + 1]) * (z[i + 1] - z[i]);
  return sum;
}

// Largest change of a component between two flames, over its largest value.
double change(const FlameProfile& before, const FlameProfile& after, std::size_t component) {
  double most = 0, largest = 0;
  for (std::size_t i = 0; i < after.points(); ++i) {
    const double value = after.at(i, component);
    most =
        std::max(most, std::abs(value - interpolate(before.z, before.x, before.layout.width(), component, after.z[i])));
    largest = std::max(largest, std::abs(value));
  }
  return largest > 0 ? most / largest : 0;
}

}  // namespace

FlameExchange::FlameExchange(std::vector<double> points, std::size_t n)
    : z(std::move(points)), species(z.size() * n), carbon(z.size()), hydrogen(z.size()), absorption(z.size()) {}

GivenExchange relaxed(const GivenExchange& old, const FlameProfile& profile, const FlameExchange& population,
                      const FlameExchange& transfer, double w) {
  const std::size_t n = profile.layout.species;
  GivenExchange given;
  given.z = profile.z;
  for (std::size_t i = 0; i < given.z.size(); ++i) {
    const GivenExchange::Sample before = old.at(given.z[i]);
    const auto mix = [&](double earlier, double target) { return (1 - w) * earlier + w * target; };
    for (std::size_t k = 0; k < n; ++k)
      given.species.push_back(mix(before.species(k), population.species[i * n + k] - transfer.species[i * n + k]));
    given.absorption.push_back(mix(before.absorption(), population.absorption[i] - transfer.absorption[i]));
    const double T = profile.temperature(i);
    const double toSoot = sootCarbonEnthalpy(T).first * (population.carbon[i] - transfer.carbon[i]) +
                          sootHydrogenEnthalpy(T).first * (population.hydrogen[i] - transfer.hydrogen[i]);
    given.enthalpy.push_back(mix(before.enthalpy(), -toSoot));
  }
  return given;
}

FlameExchange exchangeOf(const Mechanism& mechanism, const SootModelOptions& soot, const FlameProfile& profile,
                         const std::vector<FlameEnsemblePath>& paths) {
  const auto species = indicesOfSootSpecies(mechanism, soot);
  const std::size_t n = mechanism.numSpecies(), last = profile.points() - 1;
  const auto weights = mechanism.molecularWeights();
  FlameExchange e(profile.z, n);
  for (const FlameEnsemblePath& path : paths) {
    const auto& points = path.path.path.points;
    const std::vector<double>& z = path.path.z;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const double dt = points[k + 1].time - points[k].time;
      const double length = std::abs(z[k + 1] - z[k]);
      for (const double end : {z[k], z[k + 1]}) {
        const auto i = static_cast<std::size_t>(
            std::min_element(e.z.begin(), e.z.end(),
                             [&](double a, double b) { return std::abs(a - end) < std::abs(b - end); }) -
            e.z.begin());
        const double below = i == 0 ? 0 : e.z[i] - e.z[i - 1], above = i == last ? 0 : e.z[i + 1] - e.z[i];
        const double part = length / (below + above) / dt;
        const EnsembleExchange& x = path.exchange[k];
        for (std::size_t s = 0; s < species.size(); ++s)
          e.species[i * n + species[s]] += part * x.gas[s] * weights[species[s]];
        e.carbon[i] += part * x.carbon;
        e.hydrogen[i] += part * x.hydrogen;
      }
    }
    for (std::size_t i = 0; i <= last; ++i) {
      for (std::size_t k = 0; k < z.size(); ++k)
        if (z[k] == profile.z[i])
          e.absorption[i] += sootAbsorption(profile.temperature(i), path.volumeFraction.mean[k]);
    }
  }
  return e;
}

FlameExchange exchangeOfTransfer(const Mechanism& mechanism, CarriedModel& transfer, const FlameProfile& profile,
                                 const FlameSootGas& gas) {
  const std::size_t n = mechanism.numSpecies();
  FlameExchange e(profile.z, n);
  const auto& scalars = transfer.scalars();
  const auto& exchanged = transfer.exchanged();
  const auto weights = mechanism.molecularWeights();
  const std::size_t carbon = mechanism.elementIndex("C"), hydrogen = mechanism.elementIndex("H");
  std::vector<double> concentrations(exchanged.size()), densities(scalars.size()), rates(scalars.size()),
      production(exchanged.size());
  for (std::size_t i = 0; i < profile.points(); ++i) {
    const CarrierGas& s = gas.carrier[i];
    for (std::size_t k = 0; k < exchanged.size(); ++k)
      concentrations[k] = s.density * profile.massFractions(i)[exchanged[k]] / weights[exchanged[k]];
    for (std::size_t k = 0; k < scalars.size(); ++k)
      densities[k] = profile.scalars(i)[k] * scalars[k].scale * s.density;
    transfer.sources({s, concentrations}, densities, rates, production);
    for (std::size_t k = 0; k < exchanged.size(); ++k)
      e.species[i * n + exchanged[k]] = production[k] * weights[exchanged[k]];
    for (std::size_t k = 0; k < scalars.size(); ++k) {
      e.carbon[i] += rates[k] * scalars[k].elements[carbon];
      e.hydrogen[i] += rates[k] * scalars[k].elements[hydrogen];
    }
    e.absorption[i] = transfer.absorption(s.temperature, densities);
  }
  return e;
}

FlameCoupling coupleFlame(MPI_Comm comm, const Mechanism& mechanism, double pressure, FlameSolver& solver,
                          CarriedModel* transfer, FlameSolution start, const FlameCouplingOptions& options,
                          const std::function<void(const FlameCouplingStep&)>& report) {
  FlameCoupling result;
  result.solution = std::move(start);
  GivenExchange given;
  std::vector<Volumes> before;
  double temperatureChange = 1, acetyleneChange = 1;
  for (std::size_t k = 0;; ++k) {
    const double began = MPI_Wtime();
    const FlameProfile& profile = result.solution.profile;
    FlameSootGas gas;
    collectively(comm, [&] {
      gas = flameSootGas(profile, mechanism, pressure, options.ensemble.soot.soot, waldmannThermophoresis());
    });
    result.paths = runFlameEnsemble(comm, gas, options.ensemble);
    const FlameExchange population = exchangeOf(mechanism, options.ensemble.soot.soot, profile, result.paths);
    const std::vector<Volumes> volumes = volumesOf(result.paths);
    FlameCouplingStep step = describe(result.paths, volumes, before);
    before = volumes;
    step.points = profile.points();
    step.temperatureChange = temperatureChange;
    step.acetyleneChange = acetyleneChange;
    step.carbonTaken = integral(population.z, population.carbon);
    step.hydrogenTaken = integral(population.z, population.hydrogen);
    // Two means that differ by their noise alone are sqrt(2) standard errors apart.
    const double noise = 2 * std::sqrt(2.0) * step.noise;
    result.converged = step.volumeFractionChange <= std::max(options.tolerance, noise) &&
                       temperatureChange <= options.tolerance && acetyleneChange <= std::max(options.tolerance, noise);
    if (!result.converged && k < options.iterations) {
      const FlameExchange own = transfer != nullptr ? exchangeOfTransfer(mechanism, *transfer, profile, gas)
                                                    : FlameExchange(profile.z, mechanism.numSpecies());
      given = relaxed(given, profile, population, own, options.relaxation);
      solver.setExchange(given);
      const FlameProfile old = profile;
      result.solution = solver.solve(old);
      temperatureChange = change(old, result.solution.profile, FlameLayout::temperature);
      acetyleneChange = change(old, result.solution.profile,
                               FlameLayout::firstSpecies + knownSpecies(mechanism, "C2H2", "ensembles need"));
    }
    step.seconds = MPI_Wtime() - began;
    result.steps.push_back(step);
    if (report) report(step);
    if (result.converged || k == options.iterations) return result;
  }
}

}  // namespace lampblack::coupling
