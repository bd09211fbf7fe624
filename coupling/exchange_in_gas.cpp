#include "coupling/exchange_in_gas.hpp"

#include <algorithm>
#include <utility>

namespace lampblack::coupling {
namespace {

// mol/m3, of the amounts that stand for concentrations.
constexpr double seenUnit = 1e-5;

}  // namespace

ExchangeInGas::ExchangeInGas(const Mechanism& mechanism, std::vector<std::string> elements,
                             std::vector<std::size_t> species)
    : ParticlesAtRest(1, std::move(elements)), species_(std::move(species)), rates_(species_.size()) {
  for (const std::size_t k : species_) {
    weights_.push_back(mechanism.molecularWeights()[k]);
    for (std::size_t e = 0; e < mark(); ++e) {
      const std::size_t element = mechanism.elementIndex(elementName(e));
      perMole_.push_back(mechanism.atoms(k, element) * mechanism.atomicWeight(element));
    }
  }
}

void ExchangeInGas::expect(std::span<const Rate> rates, double duration) {
  rates_.assign(rates.begin(), rates.end());
  perTime_ = 1 / duration;
}

double ExchangeInGas::meanConcentration(std::span<const double> amounts, std::size_t i) const {
  return seenUnit * amounts[seen(i)] / amounts[time()];
}

double ExchangeInGas::added(std::span<const double> amounts, std::size_t i) const {
  return amounts[given(i)] / weights_[i];
}

void ExchangeInGas::sources(double, double, std::span<const double> concentrations, std::span<const double> densities,
                            std::span<double> rates, std::span<double> exchange) {
  std::fill(rates.begin(), rates.end(), 0.0);
  const double perTime = perTime_ * densities[mark()];
  rates[time()] = perTime;
  for (std::size_t i = 0; i < species_.size(); ++i) {
    const double c = concentrations[species_[i]];
    exchange[i] = rates_[i].constant - rates_[i].perConcentration * c;
    for (std::size_t e = 0; e < mark(); ++e) rates[e] -= exchange[i] * perMole(i, e);
    rates[seen(i)] = perTime * c / seenUnit;
    rates[given(i)] = exchange[i] * weights_[i];
  }
}

void ExchangeInGas::jacobian(double, double, std::span<const double> concentrations, std::span<const double> densities,
                             std::span<double> values) {
  std::fill(values.begin(), values.end(), 0.0);
  const std::size_t columns = size() + species_.size() + 1;
  const auto slope = [&](std::size_t row, std::size_t column) -> double& { return values[row * columns + column]; };
  slope(time(), mark()) = perTime_;
  for (std::size_t i = 0; i < species_.size(); ++i) {
    const std::size_t c = size() + i;
    const double taken = -rates_[i].perConcentration;
    for (std::size_t e = 0; e < mark(); ++e) slope(e, c) = -taken * perMole(i, e);
    slope(seen(i), mark()) = perTime_ * concentrations[species_[i]] / seenUnit;
    slope(seen(i), c) = perTime_ * densities[mark()] / seenUnit;
    slope(given(i), c) = taken * weights_[i];
    slope(size() + i, c) = taken;
  }
}

}  // namespace lampblack::coupling
