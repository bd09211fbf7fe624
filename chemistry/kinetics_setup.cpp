// Kinetics' construction: where the derivatives go, and the workspace.
#include "chemistry/kinetics.hpp"

namespace lampblack {

Kinetics::Kinetics(const Mechanism& mechanism) : tables_(mechanism), thermo_(mechanism.allSpecies()) {
  setJacobianTerms();
  sizeWorkspace();
}

void Kinetics::setJacobianTerms() {
  const auto none = static_cast<std::int32_t>(tables_.numSpecies);
  const auto addTerms = [&](std::size_t i, std::size_t column, std::size_t source) {
    for (const auto& term : tables_.netTerms[i])
      jacobianTerms_.push_back({static_cast<std::uint32_t>(term.species), static_cast<std::uint32_t>(column),
                                static_cast<std::uint32_t>(source), term.coefficient});
  };
  for (std::size_t s = 0; s < 6; ++s) {
    const auto& slot = s < 3 ? tables_.reactant[s] : tables_.product[s - 3];
    const std::size_t count = s < 3 ? tables_.numReactions : tables_.numReversible;
    for (std::size_t i = 0; i < count; ++i)
      if (slot[i] != none) addTerms(i, static_cast<std::size_t>(slot[i]), s * tables_.numReactions + i);
  }
  std::size_t source = 6 * tables_.numReactions;
  for (const auto& general : tables_.general) {
    for (const auto& term : general.forwardOrders) addTerms(general.reaction, term.species, source++);
    for (const auto& term : general.reverseOrders) addTerms(general.reaction, term.species, source++);
  }
  derivatives_.assign(source, 0.0);
}

void Kinetics::sizeWorkspace() {
  const std::size_t n = tables_.numReactions, nf = tables_.falloff.reaction.size();
  lnkf_.assign(n, 0.0);
  kf_.assign(n, 0.0);
  lnkr_.assign(tables_.numReversible, 0.0);
  kr_.assign(n, 0.0);
  gibbs_.assign(tables_.numSpecies + 1, 0.0);
  enthalpy_.assign(tables_.numSpecies + 1, 0.0);
  lowOverHigh_.assign(nf, 0.0);
  lnFcent_.assign(nf, 0.0);
  troeTerms_.assign(3 * nf, 0.0);
  falloffWork_.assign(2 * nf, 0.0);
  c_.assign(tables_.numSpecies + 1, 1.0);
  M_.assign(tables_.sets.size(), 0.0);
  factor_.assign(n, 1.0);
  forward_.assign(n, 0.0);
  reverse_.assign(n, 0.0);
  progress_.assign(n + 1, 0.0);
  factorByT_.assign(n, 0.0);
  setColumn_.assign(tables_.numSpecies, 0.0);
}

}  // namespace lampblack
