// The step of a split reactor by predictor and corrector.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "coupling/split_reactor.hpp"

namespace lampblack::coupling {

// The first has nothing to expect its exchange from, where the particles do not know their rates: from what it
// exchanges without, in a first try.
double SplitReactor::predictedStep(double h) {
  const SplitParticles& particles = *particles_.front();
  bool isKnown = true;
  for (std::size_t i = 0; means_.empty() && i < expected_.size(); ++i)
    isKnown = isKnown && particles.rateOf(i, gas(0)).has_value();
  if (isKnown) return correctedStep(h);
  const std::vector<double> before = y_;
  const double begin = x_;
  const auto saved = particles_.front()->save();
  (void)correctedStep(h);
  particles_.front()->restore(*saved);
  y_ = before;
  x_ = begin;
  means_.clear();
  return correctedStep(h);
}

// 1/s, by which the particles take or give species in proportion to these concentrations, of those where they know it.
std::vector<std::optional<double>> SplitReactor::currentRates(const std::vector<double>& concentrations) {
  ParticleGas now = gas(0);
  std::vector<double> seen = concentrations;
  for (double& c : seen) c = std::max(c, negligible(0));
  now.concentrations = seen;
  std::vector<std::optional<double>> rates;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    rates.push_back(particles_.front()->rateOf(i, now));
    if (rates.back()) *rates.back() /= seen[i];
  }
  return rates;
}

// What the particles know takes the place of what the last step exchanged.
void SplitReactor::predictExchange() {
  known_ = currentRates(means_);
  for (std::size_t i = 0; i < known_.size(); ++i) {
    if (!known_[i]) continue;
    const double rate = *known_[i];
    expected_[i] = rate < 0 ? ExchangeInGas::Rate{-rate, 0} : ExchangeInGas::Rate{0, rate * std::max(means_[i], 0.0)};
  }
}

double SplitReactor::correctedStep(double h) {
  const std::size_t n = mechanism_.numSpecies();
  SplitParticles& particles = *particles_.front();
  const auto& species = particles.species();
  ExchangeInGas& expected = *gas_.expected;
  const std::vector<double> before = y_;
  const double firstDensity = gas_.density(x_, y_.data());
  const ParticleGas& first = gas(0);
  const bool isIdle = particles.idle(first);
  const std::vector<double> start(first.concentrations.begin(), first.concentrations.end());
  if (means_.empty()) {
    means_ = start;
    predictExchange();
  }

  // The gas, with the exchange as it is expected.
  double duration = h * gas_.timePerUnit(y_.data());
  expected.expect(expected_, duration);
  std::fill(y_.begin() + static_cast<std::ptrdiff_t>(n + 1 + expected.mark()), y_.end(), 0.0);
  y_[n + 1 + expected.mark()] = 1;
  const double end = x_ + h, centre = x_ + 0.5 * h;
  integrator_.start(x_, y_, end);
  while (integrator_.time() < end) integrator_.step();
  work_.gasSteps += integrator_.statistics().steps;
  y_.assign(integrator_.state().begin(), integrator_.state().end());
  x_ = end;

  // The particles, in the middle of the gas: its mean composition and temperature, and the mean concentrations over the
  // step of what they exchange. Half of their volume's change, and of what flows out, is before.
  std::vector<double> middle(block_), means(species.size());
  for (std::size_t i = 0; i < block_; ++i) middle[i] = 0.5 * (before[i] + y_[i]);
  const std::span<const double> amounts = std::span<const double>(y_).subspan(n + 1);
  for (std::size_t i = 0; i < species.size(); ++i) means[i] = expected.meanConcentration(amounts, i);
  const double density = gas_.density(centre, middle.data()), left = std::sqrt(amounts[expected.mark()]);
  particles.dilute(density / firstDensity * left);
  ParticleGas seen = seen_.atComposition(middle[n], gas_.pressure(centre, middle.data()), {middle.data(), n});
  seen.concentrations = means;
  duration = h * gas_.timePerUnit(middle.data());
  const SplitParticles::Exchange taken = particles.advance(seen, duration);

  // The difference to what was expected.
  std::vector<double> gasBooked(species.size()), elementsBooked(expected.mark());
  for (std::size_t e = 0; e < elementsBooked.size(); ++e) elementsBooked[e] = taken.elements[e] / density * left;
  for (std::size_t i = 0; i < species.size(); ++i) {
    const double known = expected.added(amounts, i);
    gasBooked[i] = isHeld(species[i]) ? 0 : taken.gas[i] / density * left - known;
    for (std::size_t e = 0; e < elementsBooked.size(); ++e) elementsBooked[e] += known * expected.perMole(i, e);
  }
  recordExchange(0, gasBooked, elementsBooked);
  particles.dilute(gas_.density(x_, y_.data()) / density * left);

  for (std::size_t i = 0; i < species.size(); ++i) {
    const double rate = taken.gas[i] / duration;
    const bool isTaken = rate < 0 && means[i] > 0;
    expected_[i] = {isTaken ? -rate / means[i] : 0.0, isTaken ? 0.0 : rate};
  }
  // From step to step, or from the beginning of this one, where events of few particles have moved it.
  const bool wasIdle = isIdle && particles.idle(gas(0));
  const double changed = std::min(change(0, before[n], means_, means), change(0, before[n], start, means));
  // And by how much the particles' rates have moved as they changed.
  const auto now = currentRates(means_);
  double largest = changed;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] && *known_[i] != 0 && !isHeld(species[i]))
      largest = std::max(largest, std::abs(*now[i] - *known_[i]) / std::max(std::abs(*now[i]), std::abs(*known_[i])));
  means_ = means;
  predictExchange();
  return wasIdle ? 0 : largest;
}

}  // namespace lampblack::coupling
