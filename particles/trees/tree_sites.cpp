#include "particles/trees/tree_sites.hpp"

#include <algorithm>
#include <limits>

#include "particles/population/model/newborn_step.hpp"

namespace lampblack::particles {

void TreeSites::setGas(const ParticleGas& gas, const CollisionKernel& kernel) {
  const SiteReactions& r = reactions_;
  const double concentration = std::max(gas.concentrations[precursor], 0.0);
  const double molecules = concentration * constants::avogadro;
  rate_ = r.growthRate(gas.temperature, concentration);
  growth_.setRate(rate_);
  inception_ = 0.5 * r.inceptionKernel(kernel, type_.material().density) * molecules * molecules;
}

double TreeSites::step(const Sums& s, const CollisionKernel* kernel, double tolerance, double remaining) const {
  const TreeMaterial& m = type_.material();
  const double growth = m.volume(reactions_.growth);  // m3, of a surface reaction
  double fastest = 0;
  if (s.number > 0) {
    fastest = rate_ * s.sites * growth / s.volume;
    if (kernel != nullptr) {
      const double v = s.volume / s.number;
      const CollisionKernel::Properties mean{v, v * m.density, s.diameters / s.number};
      fastest = std::max(fastest, 0.5 * kernel->value(mean, mean) * s.number);
    }
  }
  double longest = std::numeric_limits<double>::infinity();
  if (inception_ > 0) {
    const double v = m.volume(reactions_.nucleus);
    const CollisionKernel::Properties one{v, v * m.density, treeDiameter(v)};
    longest = newbornStep(tolerance, inception_, s.number, rate_ * reactions_.nucleus[reactions_.site] * growth / v,
                          kernel != nullptr ? kernel->value(one, one) : 0);
  }
  return std::min({remaining, fastest > 0 ? tolerance / fastest : remaining, longest});
}

void TreeSites::recordInception(double weight, TreeExchange& exchange) const {
  exchange.gas[precursor] -= reactions_.nucleusPrecursors * weight / constants::avogadro;
  exchange.gas[product] += reactions_.nucleusProducts * weight / constants::avogadro;
  for (std::size_t c = 0; c < mostTreeComponents; ++c) exchange.units[c] += weight * reactions_.nucleus[c];
}

void TreeSites::recordGrowth(double weight, TreeExchange& exchange, TreeCounters& counters) const {
  const double reactions = weight * grown_.reactions;
  exchange.reactions += reactions;
  exchange.condensations += weight * grown_.bridges;
  exchange.gas[precursor] -= reactions / constants::avogadro;
  exchange.gas[product] += reactions_.growthProducts * reactions / constants::avogadro;
  for (std::size_t c = 0; c < mostTreeComponents; ++c) exchange.units[c] += reactions * reactions_.growth[c];
  recordPairs(weight * grown_.bridges, exchange);
  counters.reactions += static_cast<std::uint64_t>(grown_.reactions);
  counters.condensations += static_cast<std::uint64_t>(grown_.bridges);
  counters.limited += grown_.limited;
}

void TreeSites::recordSintering(double weight, double pairs, TreeExchange& exchange) const {
  exchange.sinteredPairs += weight * pairs;
  recordPairs(weight * pairs, exchange);
}

void TreeSites::recordPairs(double number, TreeExchange& exchange) const {
  exchange.gas[product] += number / constants::avogadro;
  exchange.units[reactions_.site] -= 2 * number;
  exchange.units[reactions_.bridge] += number;
}

}  // namespace lampblack::particles
