#include "coupling/split_reactor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::coupling {
namespace {

// A change of temperature that counts as much as a concentration's of one.
constexpr double temperatureScale = 200;
// Mole fraction below which a concentration may change as it likes.
constexpr double smallestCountedMoleFraction = 1e-9;
constexpr double smallestPart = 1e-9;  // of the way to the next stop
constexpr double firstPart = 1e-3;
// Of the change that is aimed at: where less is expected of a step, it is not prepared to be taken back.
constexpr double calmPart = 0.1;

}  // namespace

const std::vector<std::string>& SplitParticles::sootElements() {
  static const std::vector<std::string> elements{"C", "H"};
  return elements;
}

SplitReactor::SplitReactor(const Mechanism& mechanism, Gas gas, std::vector<SplitParticles*> particles,
                           const Options& options)
    : mechanism_(mechanism),
      gas_(std::move(gas)),
      particles_(std::move(particles)),
      block_(gas_.system->size() / particles_.size()),
      options_(options),
      integrator_(*gas_.system, options.integrator),
      atRest_(particles_.size(), particles_.front()->elements()),
      thermo_(mechanism),
      seen_(mechanism, particles_.front()->species(), particles_.front()->viscosity()) {
  if (gas_.expected != nullptr && particles_.size() > 1)
    throw InputError("the exchange of several reactors is not predicted: couple them by splitting");
}

void SplitReactor::start(double x, std::span<const double> y) {
  x_ = x;
  y_.assign(y.begin(), y.end());
  exchanged_.assign(y_.size(), 0.0);
  expected_.assign(particles_.front()->species().size(), {});
  means_.clear();
  h_ = lastRate_ = 0;
  work_ = {};
}

const ParticleGas& SplitReactor::gas(std::size_t reactor) {
  const std::size_t n = mechanism_.numSpecies();
  const double* block = y_.data() + reactor * block_;
  return seen_.atComposition(block[n], gas_.pressure(x_, block), {block, n});
}

// The gas over h, and with it what it carries.
void SplitReactor::react(double h) {
  const std::size_t mark = mechanism_.numSpecies() + 1 + atRest_.mark();
  std::vector<double> before;
  for (std::size_t r = 0; r < particles_.size(); ++r) {
    double* block = y_.data() + r * block_;
    for (std::size_t s = 0; s < particles_.size(); ++s) block[mark + s] = r == s ? 1 : 0;
    before.push_back(gas_.density(x_, block));
  }
  const double end = x_ + h;
  integrator_.start(x_, y_, end);
  while (integrator_.time() < end) integrator_.step();
  work_.gasSteps += integrator_.statistics().steps;
  y_.assign(integrator_.state().begin(), integrator_.state().end());
  x_ = end;
  moveParticles(before);
}

void SplitReactor::moveParticles(const std::vector<double>& before) {
  const std::size_t count = particles_.size(), mark = mechanism_.numSpecies() + 1 + atRest_.mark();
  const auto moved = [&](std::size_t from, std::size_t to) { return y_[to * block_ + mark + from]; };
  // All as they were before any others joined them.
  std::vector<std::vector<double>> content(count);
  for (std::size_t from = 0; from < count; ++from)
    for (std::size_t to = 0; to < count && content[from].empty(); ++to)
      if (to != from && moved(from, to) > 0) content[from] = particles_[from]->content();
  for (std::size_t to = 0; to < count; ++to) {
    const double density = gas_.density(x_, y_.data() + to * block_);
    particles_[to]->dilute(density * moved(to, to) / before[to]);
    for (std::size_t from = 0; from < count; ++from) {
      // Below zero by the solver's error where nothing flows yet.
      if (from != to && moved(from, to) > 0)
        particles_[to]->join(content[from], density * moved(from, to) / before[from]);
    }
  }
}

// J/kg of gas and particles
double SplitReactor::energy(Gas::Kept kept, const double* block, double T) {
  const std::size_t n = mechanism_.numSpecies();
  const double* amounts = block + n + 1;
  std::vector<double> h(atRest_.size()), slope(atRest_.size());
  atRest_.enthalpies(T, h, slope);
  const double gas =
      kept == Gas::Kept::enthalpy ? thermo_.enthalpyMass(T, {block, n}) : thermo_.internalEnergyMass(T, {block, n});
  return std::inner_product(h.begin(), h.begin() + static_cast<std::ptrdiff_t>(atRest_.mark()), amounts, gas);
}

double SplitReactor::heatCapacity(Gas::Kept kept, const double* block, double T) {
  const std::size_t n = mechanism_.numSpecies();
  const double* amounts = block + n + 1;
  std::vector<double> h(atRest_.size()), slope(atRest_.size());
  atRest_.enthalpies(T, h, slope);
  const double gas = kept == Gas::Kept::enthalpy ? thermo_.cpMass(T, {block, n}) : thermo_.cvMass(T, {block, n});
  return std::inner_product(slope.begin(), slope.begin() + static_cast<std::ptrdiff_t>(atRest_.mark()), amounts, gas);
}

void SplitReactor::recordExchange(std::size_t reactor, std::span<const double> gas, std::span<const double> elements) {
  const std::size_t n = mechanism_.numSpecies();
  const auto& species = particles_[reactor]->species();
  double* y = y_.data() + reactor * block_;
  double& T = y[n];
  const Gas::Kept held = gas_.kept[reactor];
  const bool energyIsKept = held != Gas::Kept::temperature;
  const double kept = energyIsKept ? energy(held, y, T) : 0;
  for (std::size_t i = 0; i < species.size(); ++i) y[species[i]] += gas[i] * mechanism_.molecularWeights()[species[i]];
  for (std::size_t e = 0; e < elements.size(); ++e) y[n + 1 + e] += elements[e];
  // Nearly linear over the few kelvin of a step.
  for (int iteration = 0; energyIsKept && iteration < 20; ++iteration) {
    const double difference = (kept - energy(held, y, T)) / heatCapacity(held, y, T);
    T += difference;
    if (std::abs(difference) <= 1e-13 * T) break;
  }
}

double SplitReactor::exchange(std::size_t reactor, double h) {
  const std::size_t n = mechanism_.numSpecies();
  SplitParticles& particles = *particles_[reactor];
  const auto& species = particles.species();
  double* y = y_.data() + reactor * block_;
  double* exchanged = exchanged_.data() + reactor * block_;
  const std::vector<double> before(y, y + block_);
  const double density = gas_.density(x_, y);
  for (std::size_t i = 0; i <= n + atRest_.mark(); ++i) y[i] += 0.5 * h * exchanged[i];
  for (const std::size_t k : species) y[k] = std::max(y[k], 0.5 * before[k]);
  const double middle = gas_.density(x_, y), volume = 1 / middle;
  particles.dilute(middle / density);
  const ParticleGas& seen = gas(reactor);
  const double smallest = negligible(reactor);
  auto taken = particles.advance(seen, h * gas_.timePerUnit(y));
  double change = 0;
  for (std::size_t i = 0; i < species.size(); ++i) {
    if (isHeld(species[i]))
      taken.gas[i] = 0;
    else
      change = std::max(change, std::abs(taken.gas[i]) / (std::abs(seen.concentrations[i]) + smallest));
  }

  std::copy(before.begin(), before.end(), y);
  for (std::vector<double>* perVolume : {&taken.gas, &taken.elements})
    for (double& amount : *perVolume) amount *= volume;
  recordExchange(reactor, taken.gas, taken.elements);
  particles.dilute(gas_.density(x_, y) / middle);
  for (std::size_t i = 0; i < block_; ++i) exchanged[i] = (y[i] - before[i]) / h;
  return change;
}

double SplitReactor::negligible(std::size_t reactor) const {
  const double* block = y_.data() + reactor * block_;
  return smallestCountedMoleFraction * gas_.pressure(x_, block) /
         (constants::gasConstant * block[mechanism_.numSpecies()]);
}

double SplitReactor::change(std::size_t reactor, double T, std::span<const double> before,
                            std::span<const double> after) const {
  const double smallest = negligible(reactor);
  double largest = std::abs(y_[reactor * block_ + mechanism_.numSpecies()] - T) / temperatureScale;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double part = std::abs(after[i] - before[i]) / (std::max(after[i], before[i]) + smallest);
    if (!std::isfinite(part)) return part;
    largest = std::max(largest, part);
  }
  return largest;
}

// One step from x_; the largest change in it.
double SplitReactor::step(double h) {
  return gas_.expected != nullptr ? predictedStep(h) : splitStep(h);
}

double SplitReactor::splitStep(double h) {
  const std::size_t n = mechanism_.numSpecies(), count = particles_.size();
  std::vector<double> T, changes;
  std::vector<std::vector<double>> first;
  std::vector<bool> idle;
  for (std::size_t r = 0; r < count; ++r) {
    T.push_back(y_[r * block_ + n]);
    const ParticleGas& seen = gas(r);
    first.emplace_back(seen.concentrations.begin(), seen.concentrations.end());
    idle.push_back(particles_[r]->idle(seen));
  }
  react(0.5 * h);
  for (std::size_t r = 0; r < count; ++r) changes.push_back(exchange(r, h));
  react(0.5 * h);
  double all = 0;
  for (std::size_t r = 0; r < count; ++r) {
    const ParticleGas& last = gas(r);
    if (idle[r] && particles_[r]->idle(last)) continue;
    for (const double part : {changes[r], change(r, T[r], first[r], last.concentrations)}) {
      if (!std::isfinite(part)) return part;
      all = std::max(all, part);
    }
  }
  return all;
}

std::uint64_t SplitReactor::allRemovals() const {
  std::uint64_t all = 0;
  for (const SplitParticles* particles : particles_) all += particles->removals();
  return all;
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
    const std::vector<double> state = y_, exchanged = exchanged_, means = means_;
    const auto known = known_;
    const std::vector<ExchangeInGas::Rate> expected = expected_;
    std::vector<std::unique_ptr<SplitParticles::State>> saved;
    const bool isCalm = options_.fixedStep || (work_.steps > 0 && lastRate_ * h < calmPart * options_.change);
    if (!isCalm)
      for (const SplitParticles* particles : particles_) saved.push_back(particles->save());
    const std::uint64_t removals = allRemovals();
    const double change = step(h);
    if (!std::isfinite(change))
      throw NumericsError(fmt::format("the step that began at {:.6g} gave values that are not finite", begin));
    bool isTooMuch = !options_.fixedStep && change > 2 * options_.change;
    if (isTooMuch && (isCalm || allRemovals() != removals)) {
      ++work_.unchecked;
      isTooMuch = false;
    }
    lastRate_ = change / h;
    if (isTooMuch) {
      if (h < smallestPart * std::abs(end))
        throw NumericsError(
            fmt::format("gas and particles change by {:.3g} in a step of {:.3g} at {:.6g}: no step is short enough",
                        change, h, begin));
      ++work_.rejected;
      x_ = begin;
      y_ = state;
      exchanged_ = exchanged;
      expected_ = expected;
      means_ = means;
      known_ = known;
      for (std::size_t r = 0; r < saved.size(); ++r) particles_[r]->restore(*saved[r]);
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
