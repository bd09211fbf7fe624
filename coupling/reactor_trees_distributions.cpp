// Distributions of a population of trees in a reactor, and averages over classes of its particles.
#include <algorithm>
#include <array>

#include "coupling/reactor_trees.hpp"
#include "particles/ensemble/size_bins.hpp"

namespace lampblack::coupling {
namespace {

using Functional = TreeFunctionals;

constexpr std::array sizeFunctionals{Functional::collisionDiameter, Functional::sphereDiameter,
                                     Functional::mobilityDiameter};
constexpr std::array classFunctionals{Functional::collisionDiameter, Functional::primaries};
constexpr std::array shareFunctionals{Functional::sinteringLevel, Functional::elementRatio};

}  // namespace

// By diameter of collision, which has no name, of the sphere, of mobility, and of all primaries.
std::vector<ReactorPopulation::Distribution> ReactorTrees::distributions() const {
  return {{"", "by diameter of collision"},
          {"sphere_", "by diameter of the sphere of the particle's volume"},
          {"mobility_", "by diameter of mobility, that of soot's aggregates"},
          {"primary_", "of primaries, by their diameter"}};
}

std::vector<double> ReactorTrees::distribution(std::size_t k, double logMin, double logMax, std::size_t bins) const {
  if (k >= sizeFunctionals.size()) return population_->primarySizes(logMin, logMax, bins);
  const SizeBins all{logMin, logMax, bins};
  std::vector<double> density(bins, 0.0);
  population_->forEachTree([&](const Tree& tree, double number) {
    if (const std::size_t bin = all.of(functionals_.of(tree.head(), sizeFunctionals[k])); bin < bins)
      density[bin] += number / all.width();
  });
  return density;
}

std::vector<ReactorPopulation::Distribution> ReactorTrees::shares() const {
  std::vector<Distribution> all;
  for (const auto which : shareFunctionals)
    if (which < functionals_.size())
      all.push_back({functionals_.column(which).name, functionals_.column(which).description});
  return all;
}

std::vector<double> ReactorTrees::shareDistribution(std::size_t k, std::size_t bins) const {
  std::vector<double> density(bins, 0.0);
  const auto count = static_cast<double>(bins);
  population_->forEachTree([&](const Tree& tree, double number) {
    const double share = functionals_.of(tree.head(), shareFunctionals[k]);
    // The last bin has its upper end too, where single primaries are.
    if (share >= 0 && share <= 1)
      density[std::min(static_cast<std::size_t>(share * count), bins - 1)] += number * count;
  });
  return density;
}

std::vector<ReactorPopulation::Column> ReactorTrees::classedBy() const {
  std::vector<Column> all;
  for (const auto which : classFunctionals) all.push_back(functionals_.column(which));
  return all;
}

std::vector<ReactorPopulation::Column> ReactorTrees::classAverages() const {
  std::vector<Column> all;
  for (std::size_t which = 0; which < functionals_.size(); ++which) all.push_back(functionals_.column(which));
  return all;
}

std::vector<double> ReactorTrees::classSums(std::size_t by, std::span<const double> edges) const {
  const std::size_t width = 1 + functionals_.size();
  std::vector<double> sums((edges.size() + 1) * width, 0.0);
  population_->forEachTree([&](const Tree& tree, double number) {
    const double x = functionals_.of(tree.head(), classFunctionals[by]);
    const auto before = std::upper_bound(edges.begin(), edges.end(), x) - edges.begin();
    double* own = &sums[static_cast<std::size_t>(before) * width];
    own[0] += number;
    for (std::size_t which = 0; which < functionals_.size(); ++which)
      own[1 + which] += number * functionals_.of(tree.head(), which);
  });
  return sums;
}

}  // namespace lampblack::coupling
