#include "coupling/given_gas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "chemistry/mechanism/known_species.hpp"
#include "core/errors.hpp"

namespace lampblack::coupling {
namespace {

constexpr double largestDeparture = 0.02;  // of the sum of the fractions from one
constexpr double mostNegative = -1e-6;     // of a fraction: below that it is no error of a transient
constexpr double densityStep = 0.02;       // of its logarithm between two points

}  // namespace

void requireHistory(const Mechanism& mechanism, const GasHistory& history) {
  const std::size_t n = mechanism.numSpecies();
  if (history.time.empty()) throw InputError("the history of the gas has no rows");
  for (std::size_t i = 0; i < history.time.size(); ++i) {
    const double t = history.time[i], T = history.temperature[i], p = history.pressure[i];
    if (!std::isfinite(t) || (i > 0 && !(t > history.time[i - 1])))
      throw InputError(
          fmt::format("the times have to rise; {:g} s follows {:g} s", t, i > 0 ? history.time[i - 1] : t));
    if (!(T > 0) || !std::isfinite(T))
      throw InputError(fmt::format("expected a temperature above 0 K, found {:g} K at {:g} s", T, t));
    if (!(p > 0) || !std::isfinite(p))
      throw InputError(fmt::format("expected a pressure above 0 Pa, found {:g} Pa at {:g} s", p, t));
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double x = history.fractions[i * n + k];
      if (!(x >= mostNegative) || !(x <= 1 + largestDeparture))
        throw InputError(fmt::format("expected a mole fraction of {} from 0 to 1, found {:g} at {:g} s",
                                     mechanism.speciesName(k), x, t));
      sum += std::max(x, 0.0);
    }
    if (!(std::abs(sum - 1) <= largestDeparture))
      throw InputError(fmt::format("the mole fractions add up to {:.4g} at {:g} s; expected one, within {:g} %", sum, t,
                                   100 * largestDeparture));
  }
}

std::vector<double> concentrationsOf(const GasHistory& history, std::size_t row, std::size_t species) {
  const std::span<const double> X = std::span(history.fractions).subspan(row * species, species);
  double sum = 0;
  for (const double x : X) sum += std::max(x, 0.0);
  const double total = history.pressure[row] / (constants::gasConstant * history.temperature[row]);
  std::vector<double> c(species);
  for (std::size_t k = 0; k < species; ++k) c[k] = total * std::max(X[k], 0.0) / sum;
  return c;
}

namespace {

// The mean between two points whose density changes from one to the other: exact for inert particles.
ParticlePath::Divergence expansion(const GasSample& from, const GasSample& to) {
  const double mean = std::log(from.gas.density / to.gas.density) / (to.time - from.time);
  return {mean, mean};
}

GasSample between(const GasSample& from, const GasSample& to, double w) {
  GasSample sample = mixed(from, to, w);
  sample.time = (1 - w) * from.time + w * to.time;
  return sample;
}

}  // namespace

ParticlePath givenPath(const Mechanism& mechanism, const GasHistory& history, std::span<const std::string> species,
                       GasViscosity viscosity) {
  requireHistory(mechanism, history);
  const std::size_t n = mechanism.numSpecies();
  std::vector<std::size_t> all(n);
  for (std::size_t k = 0; k < n; ++k) all[k] = k;
  ReactorGas gas(mechanism, all, viscosity);
  std::vector<std::optional<std::size_t>> seen;
  for (const std::string& name : species) seen.push_back(findKnownSpecies(mechanism, name));
  ParticlePath path;
  for (std::size_t i = 0; i < history.time.size(); ++i) {
    const std::vector<double> c = concentrationsOf(history, i, n);
    GasSample next;
    next.time = history.time[i];
    next.gas = gas.at(history.temperature[i], history.pressure[i], c);
    for (const auto& k : seen) next.concentrations.push_back(k ? c[*k] : 0.0);
    if (path.points.empty()) {
      path.points.push_back(std::move(next));
      continue;
    }
    const GasSample from = path.points.back();
    const double change = std::abs(std::log(next.gas.density / from.gas.density));
    const auto parts = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(change / densityStep)));
    for (std::size_t part = 1; part <= parts; ++part) {
      const double w = static_cast<double>(part) / static_cast<double>(parts);
      GasSample to = part < parts ? between(from, next, w) : next;
      path.divergence.push_back(expansion(path.points.back(), to));
      if (!history.numberLossRate.empty()) {
        path.divergence.back().first += history.numberLossRate[i - 1];
        path.divergence.back().last += history.numberLossRate[i - 1];
      }
      path.points.push_back(std::move(to));
    }
  }
  return path;
}

GasHistory historyAlong(const ParticlePath& path) {
  GasHistory history;
  for (const GasSample& point : path.points) {
    history.time.push_back(point.time);
    history.temperature.push_back(point.gas.temperature);
    history.pressure.push_back(point.gas.pressure);
    double sum = 0;
    for (const double c : point.concentrations) sum += c;
    for (const double c : point.concentrations) history.fractions.push_back(c / sum);
  }
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const ParticlePath::Divergence& divergence = path.divergence[i];
    history.numberLossRate.push_back(0.5 * (divergence.first + divergence.last) -
                                     expansion(path.points[i], path.points[i + 1]).first);
  }
  return history;
}

std::vector<std::size_t> insertPoints(ParticlePath& path, std::span<const double> times) {
  ParticlePath result;
  std::vector<std::size_t> at;
  std::size_t next = 0;
  const auto isAt = [](double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); };
  const auto mark = [&] {
    while (next < times.size() && isAt(times[next], result.points.back().time)) {
      at.push_back(result.points.size() - 1);
      ++next;
    }
  };
  for (std::size_t k = 0; k < path.points.size(); ++k) {
    if (k > 0) {
      const GasSample &from = path.points[k - 1], &to = path.points[k];
      const ParticlePath::Divergence whole = path.divergence[k - 1];
      double reached = 0;  // of the way
      while (next < times.size() && times[next] < to.time && !isAt(times[next], to.time)) {
        const double w = (times[next] - from.time) / (to.time - from.time);
        result.points.push_back(between(from, to, w));
        result.divergence.push_back({whole.at(reached), whole.at(w)});
        reached = w;
        mark();
      }
      result.divergence.push_back({whole.at(reached), whole.last});
    }
    result.points.push_back(path.points[k]);
    mark();
  }
  if (next < times.size())
    throw InputError(fmt::format("a record at {:g} s lies outside the history of the gas", times[next]));
  path = std::move(result);
  return at;
}

}  // namespace lampblack::coupling
