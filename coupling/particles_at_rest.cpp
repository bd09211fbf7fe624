#include "coupling/particles_at_rest.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace lampblack::coupling {

ParticlesAtRest::ParticlesAtRest(std::size_t reactors, std::vector<std::string> elements)
    : reactors_(reactors),
      elements_(std::move(elements)),
      enthalpies_(elementEnthalpies(elements_).value_or(std::vector<ElementEnthalpy>{})) {}

void ParticlesAtRest::sources(double, double, std::span<const double>, std::span<const double>, std::span<double> rates,
                              std::span<double>) {
  std::fill(rates.begin(), rates.end(), 0.0);
}

void ParticlesAtRest::jacobian(double, double, std::span<const double>, std::span<const double>,
                               std::span<double> values) {
  std::fill(values.begin(), values.end(), 0.0);
}

void ParticlesAtRest::enthalpies(double T, std::span<double> h, std::span<double> slope) {
  for (std::size_t s = 0; s < size(); ++s) {
    h[s] = slope[s] = 0;
    if (s < enthalpies_.size()) std::tie(h[s], slope[s]) = enthalpies_[s](T);
  }
}

std::vector<std::vector<double>> ParticlesAtRest::unitElements(const Mechanism& mechanism) const {
  std::vector<std::vector<double>> units(size(), std::vector<double>(mechanism.numElements(), 0.0));
  for (std::size_t e = 0; e < mark(); ++e) units[e][mechanism.elementIndex(elements_[e])] = 1;
  return units;
}

}  // namespace lampblack::coupling
