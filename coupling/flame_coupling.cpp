#include "coupling/flame_coupling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"

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
    if (!v.z.empty()) v.value = path.valuesOf("volume_fraction").mean;
    if (path.options.fromRight) {
      std::reverse(v.z.begin(), v.z.end());
      std::reverse(v.value.begin(), v.value.end());
    }
    result.push_back(std::move(v));
  }
  return result;
}

FlameCouplingStep describe(const std::vector<FlameEnsemblePath>& paths, const std::vector<Volumes>& volumes,
                           const std::vector<Volumes>& before, std::size_t elements) {
  FlameCouplingStep step;
  step.leaving.assign(elements, 0.0);
  for (const FlameEnsemblePath& path : paths) {
    if (path.path.z.empty()) continue;
    const RepeatedValue& fraction = path.valuesOf("volume_fraction");
    for (std::size_t k = 0; k < path.path.z.size(); ++k) {
      if (fraction.mean[k] <= step.volumeFraction) continue;
      step.volumeFraction = fraction.mean[k];
      step.noise = fraction.error[k] / step.volumeFraction;
    }
    const double out = std::abs(path.path.velocity.back());
    for (std::size_t e = 0; e < elements; ++e) step.leaving[e] += out * path.content[e];
  }
  for (std::size_t p = 0; p < before.size(); ++p)
    for (std::size_t k = 0; k < volumes[p].z.size(); ++k) {
      const double old = interpolate(before[p].z, before[p].value, 1, 0, volumes[p].z[k]);
      step.volumeFractionChange = std::max(step.volumeFractionChange, std::abs(volumes[p].value[k] - old));
    }
  step.volumeFractionChange = before.empty() ? 1 : step.volumeFractionChange / std::max(step.volumeFraction, 1e-300);
  return step;
}

// Of the e-th of so many elements.
double integral(const FlameExchange& x, std::size_t e, std::size_t elements) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < x.z.size(); ++i)
    sum += 0.5 * (x.elements[i * elements + e] + x.elements[(i + 1) * elements + e]) * (x.z[i + 1] - x.z[i]);
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

FlameExchange::FlameExchange(std::vector<double> points, std::size_t n, std::size_t held)
    : z(std::move(points)), species(z.size() * n), elements(z.size() * held), absorption(z.size()) {}

GivenExchange relaxed(const GivenExchange& old, const FlameProfile& profile,
                      std::span<const ElementEnthalpy> enthalpies, const FlameExchange& population,
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
    double toParticles = 0;
    for (std::size_t e = 0, at = i * enthalpies.size(); e < enthalpies.size(); ++e, ++at)
      toParticles += enthalpies[e](T).first * (population.elements[at] - transfer.elements[at]);
    given.enthalpy.push_back(mix(before.enthalpy(), -toParticles));
  }
  return given;
}

FlameExchange exchangeOf(const Mechanism& mechanism, const StochasticPopulation& kind, const FlameProfile& profile,
                         const std::vector<FlameEnsemblePath>& paths) {
  const auto& species = kind.species();
  const std::size_t n = mechanism.numSpecies(), last = profile.points() - 1, elements = kind.elements().size();
  const auto weights = mechanism.molecularWeights();
  FlameExchange e(profile.z, n, elements);
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
        const PathExchange& x = path.exchange[k];
        for (std::size_t s = 0; s < species.size(); ++s)
          e.species[i * n + species[s]] += part * x.gas[s] * weights[species[s]];
        for (std::size_t held = 0; held < elements; ++held) e.elements[i * elements + held] += part * x.elements[held];
      }
    }
    if (z.empty()) continue;
    const RepeatedValue& fraction = path.valuesOf("volume_fraction");
    for (std::size_t i = 0; i <= last; ++i)
      for (std::size_t k = 0; k < z.size(); ++k)
        if (z[k] == profile.z[i]) e.absorption[i] += kind.absorption(profile.temperature(i), fraction.mean[k]);
  }
  return e;
}

FlameExchange exchangeOfTransfer(const Mechanism& mechanism, CarriedModel& transfer,
                                 std::span<const std::string> elements, const FlameProfile& profile,
                                 const GasOfFlame& gas) {
  const std::size_t n = mechanism.numSpecies();
  FlameExchange e(profile.z, n, elements.size());
  const auto& scalars = transfer.scalars();
  const auto& exchanged = transfer.exchanged();
  const auto weights = mechanism.molecularWeights();
  std::vector<std::size_t> held;
  for (const std::string& element : elements) held.push_back(mechanism.elementIndex(element));
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
    for (std::size_t k = 0; k < scalars.size(); ++k)
      for (std::size_t at = 0; at < held.size(); ++at)
        e.elements[i * held.size() + at] += rates[k] * scalars[k].elements[held[at]];
    e.absorption[i] = transfer.absorption(s.temperature, densities);
  }
  return e;
}

FlameCoupling coupleFlame(MPI_Comm comm, const Mechanism& mechanism, double pressure, FlameSolver& solver,
                          CarriedModel* transfer, FlameSolution start, const FlameCouplingOptions& options,
                          const std::function<void(const FlameCouplingStep&)>& report) {
  FlameCoupling result;
  result.solution = std::move(start);
  std::unique_ptr<StochasticPopulation> kind;
  std::vector<ElementEnthalpy> enthalpies;
  collectively(comm, [&] {
    kind = options.ensemble.make(0);
    auto known = elementEnthalpies(kind->elements());
    if (!known)
      throw InputError(fmt::format("particles of {}: their heat is not known, so that a flame cannot take and give it",
                                   kind->material()));
    enthalpies = std::move(*known);
  });
  const std::size_t n = mechanism.numSpecies(), elements = kind->elements().size(),
                    watched = FlameLayout::firstSpecies + kind->species()[kind->watchedSpecies()];
  GivenExchange given;
  std::vector<Volumes> before;
  double temperatureChange = 1, speciesChange = 1;
  for (std::size_t k = 0;; ++k) {
    const double began = MPI_Wtime();
    const FlameProfile& profile = result.solution.profile;
    GasOfFlame gas;
    collectively(comm, [&] { gas = gasOfFlame(profile, mechanism, pressure, *kind); });
    result.paths = runFlameEnsemble(comm, gas, options.ensemble);
    const FlameExchange population = exchangeOf(mechanism, *kind, profile, result.paths);
    const std::vector<Volumes> volumes = volumesOf(result.paths);
    FlameCouplingStep step = describe(result.paths, volumes, before, elements);
    before = volumes;
    step.points = profile.points();
    step.temperatureChange = temperatureChange;
    step.speciesChange = speciesChange;
    for (std::size_t e = 0; e < elements; ++e) step.taken.push_back(integral(population, e, elements));
    // Two means that differ by their noise alone are sqrt(2) standard errors apart.
    const double noise = 2 * std::sqrt(2.0) * step.noise;
    result.converged = step.volumeFractionChange <= std::max(options.tolerance, noise) &&
                       temperatureChange <= options.tolerance && speciesChange <= std::max(options.tolerance, noise);
    if (!result.converged && k < options.iterations) {
      const FlameExchange own = transfer != nullptr
                                    ? exchangeOfTransfer(mechanism, *transfer, kind->elements(), profile, gas)
                                    : FlameExchange(profile.z, n, elements);
      given = relaxed(given, profile, enthalpies, population, own, options.relaxation);
      solver.setExchange(given);
      const FlameProfile old = profile;
      result.solution = solver.solve(old);
      temperatureChange = change(old, result.solution.profile, FlameLayout::temperature);
      speciesChange = change(old, result.solution.profile, watched);
    }
    step.seconds = MPI_Wtime() - began;
    result.steps.push_back(step);
    if (report) report(step);
    if (result.converged || k == options.iterations) return result;
  }
}

}  // namespace lampblack::coupling
