#include "particles/stochastic/stochastic_population.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

namespace lampblack::particles {
namespace {

using Use = ParticleFunctional::Use;

struct PackedState final : StochasticPopulation::State {
  explicit PackedState(std::vector<double> packed) : values(std::move(packed)) {}
  std::vector<double> values;
};

template <class Wanted>
std::vector<std::size_t> placesWhere(const std::vector<ParticleFunctional>& all, Wanted wanted) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (wanted(all[i])) places.push_back(i);
  return places;
}

}  // namespace

void StochasticPopulation::advanceDiverging(const ParticleGas& gas, double divergence, double dt) {
  const double half = std::exp(-0.5 * divergence * dt);
  dilute(half);
  advance(gas, dt);
  dilute(half);
}

void StochasticPopulation::addAmountsOf(std::span<const double> of, std::span<double> amounts) const {
  rows().forEach(of, [&](const double* row) { addAmounts(row, row[packedNumberAt], amounts); });
}

std::vector<std::size_t> StochasticPopulation::pathSpecies() const {
  std::vector<std::size_t> all(species().size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::unique_ptr<StochasticPopulation::State> StochasticPopulation::save() const {
  return std::make_unique<PackedState>(pack());
}

void StochasticPopulation::restore(const State& state) {
  unpack(dynamic_cast<const PackedState&>(state).values);
}

std::vector<std::size_t> StochasticPopulation::placesOf(Use use) const {
  return placesWhere(functionals(), [use](const ParticleFunctional& f) { return f.use == use; });
}

std::vector<std::size_t> StochasticPopulation::placesOfClassed() const {
  return placesWhere(functionals(), [](const ParticleFunctional& f) { return f.isClassed; });
}

std::vector<StochasticPopulation::Distribution> StochasticPopulation::distributions() const {
  const std::vector<ParticleFunctional> all = functionals();
  std::vector<Distribution> sizes;
  for (const std::size_t i : placesOf(Use::size)) {
    const std::string_view name = all[i].name;
    const std::string_view prefix = name.substr(0, name.size() - std::string_view("diameter").size());
    sizes.push_back({sizes.empty() ? "" : std::string(prefix), "by " + all[i].description});
  }
  if (hasPrimarySizes()) sizes.push_back({"primary_", "of primaries, by their diameter"});
  return sizes;
}

std::vector<double> StochasticPopulation::distribution(std::size_t k, const SizeBins& bins) const {
  const std::vector<std::size_t> sizes = placesOf(Use::size);
  if (k >= sizes.size()) return primarySizes(bins);
  std::vector<double> density(bins.count, 0.0);
  forEachRow([&](const double* row) {
    if (const std::size_t bin = bins.of(functional(sizes[k], row)); bin < bins.count)
      density[bin] += row[packedNumberAt] / bins.width();
  });
  return density;
}

std::vector<StochasticPopulation::Distribution> StochasticPopulation::shares() const {
  const std::vector<ParticleFunctional> all = functionals();
  std::vector<Distribution> shares;
  for (const std::size_t i : placesOf(Use::share)) shares.push_back({all[i].name, all[i].description});
  return shares;
}

std::vector<double> StochasticPopulation::shareDistribution(std::size_t k, std::size_t bins) const {
  const std::size_t which = placesOf(Use::share)[k];
  std::vector<double> density(bins, 0.0);
  const auto count = static_cast<double>(bins);
  forEachRow([&](const double* row) {
    const double share = functional(which, row);
    // The last bin has its upper end too.
    if (share >= 0 && share <= 1)
      density[std::min(static_cast<std::size_t>(share * count), bins - 1)] += row[packedNumberAt] * count;
  });
  return density;
}

std::vector<Quantity> StochasticPopulation::classedBy() const {
  const std::vector<ParticleFunctional> all = functionals();
  std::vector<Quantity> quantities;
  for (const std::size_t i : placesOfClassed()) quantities.push_back(all[i]);
  return quantities;
}

std::vector<double> StochasticPopulation::classSums(std::size_t by, std::span<const double> edges) const {
  const std::size_t count = functionals().size(), width = 1 + count, sortedBy = placesOfClassed()[by];
  std::vector<double> sums((edges.size() + 1) * width, 0.0);
  forEachRow([&](const double* row) {
    const double number = row[packedNumberAt];
    const auto before = std::ranges::upper_bound(edges, functional(sortedBy, row)) - edges.begin();
    double* own = &sums[static_cast<std::size_t>(before) * width];
    own[0] += number;
    for (std::size_t which = 0; which < count; ++which) own[1 + which] += number * functional(which, row);
  });
  return sums;
}

}  // namespace lampblack::particles
