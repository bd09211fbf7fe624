#include "chemistry/thermo/mixture_fraction.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/errors.hpp"

namespace lampblack::chemistry {
namespace {

// Of an element in beta, per mol of atoms.
double weightOf(const std::string& element) {
  if (element == "C") return 2.0;
  if (element == "H") return 0.5;
  return element == "O" ? -1.0 : 0.0;
}

}  // namespace

MixtureFraction::MixtureFraction(const Mechanism& mechanism, std::span<const double> fuel,
                                 std::span<const double> oxidizer)
    : share_(mechanism.numSpecies(), 0.0) {
  constexpr double least = 1e-6;  // of the largest share
  for (std::size_t e = 0; e < mechanism.numElements(); ++e)
    for (std::size_t k = 0; k < share_.size(); ++k)
      share_[k] += weightOf(mechanism.elementName(e)) * mechanism.atoms(k, e) / mechanism.molecularWeights()[k];
  const auto beta = [&](std::span<const double> Y) {
    return std::inner_product(Y.begin(), Y.end(), share_.begin(), 0.0);
  };
  const double start = beta(oxidizer), range = beta(fuel) - start;
  double most = 0.0;
  for (const double share : share_) most = std::max(most, std::abs(share));
  if (!(std::abs(range) > least * most))
    throw InputError("fuel and oxidizer have the same of C, H and O: there is no mixture fraction between them");
  for (double& share : share_) share /= range;
  ofOxidizer_ = start / range;
}

double MixtureFraction::of(std::span<const double> Y) const {
  return std::inner_product(Y.begin(), Y.end(), share_.begin(), 0.0) - ofOxidizer_;
}

}  // namespace lampblack::chemistry
