// Kinetics' construction, and what there is to ask beside the rates.
#include <fmt/format.h>

#include <cmath>

#include "chemistry/kinetics/kinetics.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

Kinetics::Kinetics(const Mechanism& mechanism)
    : tables_(mechanism),
      jacobianTable_(tables_),
      thermo_(mechanism.allSpecies()),
      falloff_(tables_),
      pressureRates_(tables_),
      enthalpyFactors_(tables_),
      linearBurke_(mechanism, tables_) {
  internal_.resize(tables_.numReactions);
  for (std::size_t i = 0; i < tables_.numReactions; ++i) internal_[tables_.original[i]] = i;
  findThirdSlots();
  sizeWorkspace();
}

void Kinetics::findThirdSlots() {
  const auto none = static_cast<std::int32_t>(tables_.numSpecies);
  for (const bool left : {true, false}) {
    const auto& slot = left ? tables_.reactant[2] : tables_.product[2];
    const std::size_t count = left ? tables_.numReactions : tables_.numReversible;
    for (std::size_t i = 0; i < count; ++i)
      if (slot[i] != none)
        thirdSlots_[left ? 0 : 1].push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(slot[i])});
  }
}

void Kinetics::sizeWorkspace() {
  const std::size_t n = tables_.numReactions;
  for (auto* array : {&lnkf_, &kf_, &kr_, &forward_, &reverse_, &factorByT_}) array->assign(n, 0.0);
  for (std::size_t i = tables_.constantBegin; i < tables_.constantEnd; ++i) {
    lnkf_[i] = tables_.lnA[i];
    kf_[i] = std::exp(lnkf_[i]);
  }
  lnkr_.assign(tables_.numReversible, 0.0);
  gibbs_.assign(tables_.numSpecies + 1, 0.0);
  enthalpy_.assign(tables_.numSpecies + 1, 0.0);
  heatCapacity_.assign(tables_.numSpecies, 0.0);
  c_.assign(tables_.numSpecies + 1, 1.0);
  M_.assign(tables_.sets.size(), 0.0);
  multiplier_.assign(n, 1.0);
  factor_.assign(n, 1.0);
  progress_.assign(2 * n + 1, 0.0);
  sources_.assign(jacobianTable_.numSources(), 0.0);
  setColumns_.assign(tables_.sets.size() * tables_.numSpecies, 0.0);
  sparseValues_.assign(jacobianPattern().numEntries(), 0.0);
  common_.assign(tables_.numSpecies, 0.0);
}

void Kinetics::setMultiplier(std::size_t reaction, double factor) {
  if (reaction >= tables_.numReactions)
    throw InputError(fmt::format("reaction {} of {} does not exist (they count from 0)", reaction, numReactions()));
  if (!std::isfinite(factor)) throw InputError(fmt::format("the factor of reaction {} is not a number", reaction));
  multiplier_[internal_[reaction]] = factor;
  factor_[internal_[reaction]] = factor;  // stays unless updateFactors replaces it
}

void Kinetics::ratesOfProgress(double T, std::span<const double> concentrations, std::span<double> forward,
                               std::span<double> reverse) {
  update(T, concentrations);
  updateProgress();
  for (std::size_t i = 0; i < tables_.numReactions; ++i) {
    forward[tables_.original[i]] = factor_[i] * forward_[i];
    reverse[tables_.original[i]] = factor_[i] * reverse_[i];
  }
}

void Kinetics::rateConstants(double T, std::span<const double> concentrations, std::span<double> forward,
                             std::span<double> reverse) {
  update(T, concentrations);
  for (const auto& use : tables_.threeBody) factor_[use.reaction] = multiplier_[use.reaction];
  for (std::size_t i = 0; i < tables_.numReactions; ++i) {
    forward[tables_.original[i]] = factor_[i] * kf_[i];
    reverse[tables_.original[i]] = factor_[i] * kr_[i];
  }
}

void Kinetics::equilibriumConstants(double T, std::span<double> Kc) {
  updateTemperature(T);
  const double lnStandard = std::log(constants::oneAtmosphere / (constants::gasConstant * T));
  for (std::size_t i = 0; i < tables_.numReactions; ++i) {
    double lnK = tables_.nuSum[i] * lnStandard;
    for (const auto& term : tables_.netTerms[i]) lnK -= term.coefficient * gibbs_[term.species];
    Kc[tables_.original[i]] = std::exp(lnK);
  }
}

}  // namespace lampblack::chemistry
