// How often processes of a population of trees happen, from its state (Shekar, Smith, Kraft, Wagner 2011, eqs. 24, 32,
// 36, 59).
#include <algorithm>
#include <cmath>
#include <vector>

#include "particles/gas/soot_gas.hpp"
#include "particles/trees/tree_population.hpp"

namespace lampblack::particles {

TreeRates TreePopulation::rates(const ParticleGas& gas, std::size_t pairs) const {
  requirePhysical(gas, "particles");
  CollisionKernelOptions options = options_.kernel;
  options.gas = gas;
  const CollisionKernel kernel(options);
  TreeRates rates;
  std::vector<CollisionKernel::Properties> all;
  all.reserve(pairs > 0 ? size() : 0);
  std::visit(
      [&](auto reactions) {  // a copy, which sees this gas
        reactions.setGas(gas, kernel);
        const auto present = sums(reactions);
        rates.inceptions = reactions.inception(present, 0);
        reactions.begin(present, 0);
        forEachTree([&](const Tree& tree, double number) {
          const TreeHead& head = tree.head();
          if constexpr (requires { reactions.addRates(rates, head, number); }) reactions.addRates(rates, head, number);
          if (pairs > 0) all.push_back({head.volume, head.volume * options_.material.density, head.collision});
        });
      },
      reactions_);
  if (all.size() < 2 || !options_.coagulation || pairs == 0) return rates;
  // Of their own random numbers: to look changes nothing.
  RandomStream random(options_.seed, random_.owner(), treePairStream);
  random.seek(random_.position());
  double sum = 0;
  for (std::size_t k = 0; k < pairs; ++k) {
    const std::size_t i = random.below(all.size()), j = random.below(all.size() - 1);
    sum += kernel.value(all[i], all[j < i ? j : j + 1]);
  }
  const double n = static_cast<double>(all.size());
  rates.coagulations = 0.5 * n * (n - 1) * weight() * weight() * sum / static_cast<double>(pairs);
  return rates;
}

}  // namespace lampblack::particles
