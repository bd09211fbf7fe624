#include "coupling/split_reactor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "particles/models/soot_model.hpp"

namespace lampblack::coupling {
namespace {

// A change of temperature that counts as much as a concentration's of one.
constexpr double temperatureScale = 200;
// Mole fraction below which a concentration may change as it likes.
constexpr double smallestCountedMoleFraction = 1e-9;
constexpr double smallestPart = 1e-9;  // of the way to the next stop
constexpr double firstPart = 1e-3;

}  // namespace

void ParticlesAtRest::sources(double, double, std::span<const double>, std::span<const double>, std::span<double> rates,
                              std::span<double>) {
  std::fill(rates.begin(), rates.end(), 0.0);
}

void ParticlesAtRest::jacobian(double, double, std::span<const double>, std::span<const double>,
                               std::span<double> values) {
  std::fill(values.begin(), values.end(), 0.0);
}

void ParticlesAtRest::enthalpies(double T, std::span<double> h, std::span<double> slope) {
  std::tie(h[carbon], slope[carbon]) = sootCarbonEnthalpy(T);
  std::tie(h[hydrogen], slope[hydrogen]) = sootHydrogenEnthalpy(T);
  h[mark] = slope[mark] = 0;
}

std::vector<std::vector<double>> ParticlesAtRest::unitElements(const Mechanism& mechanism) {
  std::vector<std::vector<double>> elements(count, std::vector<double>(mechanism.numElements(), 0.0));
  elements[carbon][mechanism.elementIndex("C")] = elements[hydrogen][mechanism.elementIndex("H")] = 1;
  return elements;
}

SplitReactor::SplitReactor(const Mechanism& mechanism, Gas gas, SplitParticles& particles, const Options& options)
    : mechanism_(mechanism),
      gas_(std::move(gas)),
      particles_(particles),
      options_(options),
      integrator_(*gas_.system, options.integrator),
      thermo_(mechanism),
      seen_(mechanism, particles.species()) {}

void SplitReactor::start(double x, std::span<const double> y) {
  x_ = x;
  y_.assign(y.begin(), y.end());
  exchanged_.assign(y_.size(), 0.0);
  h_ = 0;
  work_ = {};
}

const ParticleGas& SplitReactor::gas() {
  const std::size_t n = mechanism_.numSpecies();
  return seen_.atComposition(y_[n], gas_.pressure(y_.data()), {y_.data(), n});
}

// The gas over h, and with it what it carries.
void SplitReactor::react(double h) {
  const std::size_t mark = mechanism_.numSpecies() + 1 + ParticlesAtRest::mark;
  y_[mark] = 1;
  const double before = gas_.density(y_.data()), end = x_ + h;
  integrator_.start(x_, y_, end);
  while (integrator_.time() < end) integrator_.step();
  work_.gasSteps += integrator_.statistics().steps;
  y_.assign(integrator_.state().begin(), integrator_.state().end());
  particles_.dilute(gas_.density(y_.data()) * y_[mark] / before);
  x_ = end;
}

// J/kg of gas and particles
double SplitReactor::energy(double T) {
  const std::size_t n = mechanism_.numSpecies();
  const double* amounts = y_.data() + n + 1;
  double h[ParticlesAtRest::count], slope[ParticlesAtRest::count];
  atRest_.enthalpies(T, h, slope);
  const double gas = gas_.kept == Gas::Kept::enthalpy ? thermo_.enthalpyMass(T, {y_.data(), n})
                                                      : thermo_.internalEnergyMass(T, {y_.data(), n});
  return gas + amounts[0] * h[0] + amounts[1] * h[1];
}

double SplitReactor::heatCapacity(double T) {
  const std::size_t n = mechanism_.numSpecies();
  const double* amounts = y_.data() + n + 1;
  double h[ParticlesAtRest::count], slope[ParticlesAtRest::count];
  atRest_.enthalpies(T, h, slope);
  const double gas =
      gas_.kept == Gas::Kept::enthalpy ? thermo_.cpMass(T, {y_.data(), n}) : thermo_.cvMass(T, {y_.data(), n});
  return gas + amounts[0] * slope[0] + amounts[1] * slope[1];
}

double SplitReactor::exchange(double h) {
  const std::size_t n = mechanism_.numSpecies();
  const auto& species = particles_.species();
  const std::vector<double> before = y_;
  const double density = gas_.density(y_.data());
  for (std::size_t i = 0; i <= n + ParticlesAtRest::hydrogen + 1; ++i) y_[i] += 0.5 * h * exchanged_[i];
  for (const std::size_t k : species) y_[k] = std::max(y_[k], 0.5 * before[k]);
  const double middle = gas_.density(y_.data()), volume = 1 / middle;
  particles_.dilute(middle / density);
  const ParticleGas& seen = gas();
  const double negligible = smallestCountedMoleFraction * seen.pressure / (constants::gasConstant * seen.temperature);
  const auto taken = particles_.advance(seen, h * gas_.timePerUnit(y_.data()));
  double change = 0;
  for (std::size_t i = 0; i < species.size(); ++i)
    change = std::max(change, std::abs(taken.gas[i]) / (std::abs(seen.concentrations[i]) + negligible));

  y_ = before;
  double& T = y_[n];
  const bool energyIsKept = gas_.kept != Gas::Kept::temperature;
  const double kept = energyIsKept ? energy(T) : 0;
  for (std::size_t i = 0; i < species.size(); ++i)
    y_[species[i]] += taken.gas[i] * mechanism_.molecularWeights()[species[i]] * volume;
  y_[n + 1 + ParticlesAtRest::carbon] += taken.carbon * volume;
  y_[n + 1 + ParticlesAtRest::hydrogen] += taken.hydrogen * volume;
  // Nearly linear over the few kelvin of a step.
  for (int iteration = 0; energyIsKept && iteration < 20; ++iteration) {
    const double difference = (kept - energy(T)) / heatCapacity(T);
    T += difference;
    if (std::abs(difference) <= 1e-13 * T) break;
  }
  particles_.dilute(gas_.density(y_.data()) / middle);
  for (std::size_t i = 0; i < y_.size(); ++i) exchanged_[i] = (y_[i] - before[i]) / h;
  return change;
}

// One step from x_; the largest change in it.
double SplitReactor::step(double h) {
  const std::size_t n = mechanism_.numSpecies();
  const auto& species = particles_.species();
  const double T = y_[n];
  const std::vector<double> first(gas().concentrations.begin(), gas().concentrations.end());
  const bool idle = particles_.idle(gas());
  react(0.5 * h);
  double change = exchange(h);
  react(0.5 * h);
  const ParticleGas& last = gas();
  const double negligible = smallestCountedMoleFraction * last.pressure / (constants::gasConstant * last.temperature);
  if (idle && particles_.idle(last)) return 0;
  change = std::max(change, std::abs(y_[n] - T) / temperatureScale);
  for (std::size_t i = 0; i < species.size(); ++i)
    change = std::max(change, std::abs(last.concentrations[i] - first[i]) /
                                  (std::max(last.concentrations[i], first[i]) + negligible));
  return change;
}

void SplitReactor::advance(double end) {
  while (x_ < end) {
    double stop = end;
    if (gas_.nextStop) stop = std::min(stop, gas_.nextStop(x_));
    const double left = stop - x_, begin = x_;
    if (!(h_ > 0)) h_ = options_.fixedStep ? options_.largestStep : firstPart * left;
    if (options_.largestStep > 0) h_ = std::min(h_, options_.largestStep);
    // The last two steps to a stop are alike.
    const double h = h_ >= left * (1 - 1e-12) ? left : h_ > 0.5 * left && !options_.fixedStep ? 0.5 * left : h_;
    const std::vector<double> state = y_, exchanged = exchanged_, particles = particles_.save();
    const double change = step(h);
    if (!std::isfinite(change))
      throw NumericsError(fmt::format("the step that began at {:.6g} gave values that are not finite", begin));
    const bool isTooMuch = !options_.fixedStep && change > 2 * options_.change;
    if (isTooMuch) {
      if (h < smallestPart * std::abs(end))
        throw NumericsError(
            fmt::format("gas and particles change by {:.3g} in a step of {:.3g} at {:.6g}: no step is short enough",
                        change, h, begin));
      ++work_.rejected;
      x_ = begin;
      y_ = state;
      exchanged_ = exchanged;
      particles_.restore(particles);
    } else {
      ++work_.steps;
      x_ = h == left ? stop : begin + h;
    }
    if (options_.fixedStep) continue;
    const double factor = change > 0 ? 0.9 * options_.change / change : 2.0;
    const double next = h * std::clamp(factor, 0.2, 2.0);
    // A step that a stop has shortened says little of the next.
    h_ = isTooMuch || h == h_ ? next : std::max(next, h_ * std::min(1.0, factor));
  }
}

}  // namespace lampblack::coupling
