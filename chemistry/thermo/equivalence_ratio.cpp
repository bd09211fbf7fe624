#include "chemistry/thermo/equivalence_ratio.hpp"

#include <utility>

#include "core/errors.hpp"

namespace lampblack::chemistry {
namespace {

// Oxygen atoms a mole of this mixture needs to burn completely; negative where it has some to give.
double oxygenNeed(const Mechanism& mechanism, const std::vector<double>& X) {
  double need = 0;
  for (const auto& [name, atoms] : {std::pair{"C", 2.0}, {"H", 0.5}, {"S", 2.0}, {"Si", 2.0}, {"O", -1.0}}) {
    const auto element = mechanism.findElement(name);
    if (!element) continue;
    for (std::size_t k = 0; k < X.size(); ++k) need += atoms * X[k] * mechanism.atoms(k, *element);
  }
  return need;
}

}  // namespace

std::vector<double> mixByEquivalenceRatio(const Mechanism& mechanism, const std::vector<double>& fuel,
                                          const std::vector<double>& oxidizer, double ratio) {
  const double need = oxygenNeed(mechanism, fuel), spare = -oxygenNeed(mechanism, oxidizer);
  if (!(need > 0))
    throw InputError("the fuel needs no oxygen, so that it has no equivalence ratio; expected a fuel that burns");
  if (!(spare > 0))
    throw InputError(
        "the oxidizer has no oxygen to give, so that it has no equivalence ratio; expected one with O2 or the like");
  std::vector<double> X(fuel.size());
  double sum = 0;
  for (std::size_t k = 0; k < X.size(); ++k) sum += X[k] = ratio * spare / need * fuel[k] + oxidizer[k];
  for (double& x : X) x /= sum;
  return X;
}

}  // namespace lampblack::chemistry
