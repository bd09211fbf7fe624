// Which molecules stick when they meet: none below a number of rings, as the program MOpS has it, or a probability that
// rises with the smaller one's mass, or one of a table. docs/theory/molecules_in_particles.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/constants.hpp"
#include "core/modules.hpp"

namespace lampblack::particles {

// m, of collision (Frenklach and Wang 1994, eq. 10.19).
[[nodiscard]] inline double moleculeDiameter(double carbon) {
  return 1.395e-10 * std::sqrt(2 * carbon);
}

struct MoleculeSticking {
  // What has to have `rings` rings: the smaller one, the larger one, both together, or the product over the sum.
  enum class Rule { always, smaller, larger, together, reduced, bySize, byTable };
  Rule rule = Rule::always;
  double rings = 0;
  // bySize: 1/(1 + exp(-A (d^3/m + (m/B)^6 - C))), d in Angstrom, m = 12 times the carbon atoms.
  double A = 0, B = 0, C = 0;

  // byTable: of each temperature (K, rising) and, in a row, number of carbon atoms of the smaller one (rising);
  // straight in between, as at the ends beyond.
  std::vector<double> temperatures = {}, carbons = {}, probabilities = {};
  std::vector<double> row = {};  // of the present temperature

  // Between two neighbours of x, and the share of the second.
  struct Place {
    std::size_t first = 0, second = 0;
    double share = 0;
  };
  [[nodiscard]] static Place placeOf(const std::vector<double>& points, double x) {
    const auto next = static_cast<std::size_t>(std::upper_bound(points.begin(), points.end(), x) - points.begin());
    if (next == 0) return {};
    if (next == points.size()) return {next - 1, next - 1, 0};
    return {next - 1, next, (x - points[next - 1]) / (points[next] - points[next - 1])};
  }
  // For probability() by a table.
  void setTemperature(double temperature) {
    if (rule != Rule::byTable) return;
    const Place t = placeOf(temperatures, temperature);
    row.resize(carbons.size());
    for (std::size_t k = 0; k < carbons.size(); ++k)
      row[k] = (1 - t.share) * probabilities[t.first * carbons.size() + k] +
               t.share * probabilities[t.second * carbons.size() + k];
  }

  struct Partner {
    double rings = 0, carbon = 0;  // of a particle those of its largest molecule
  };
  [[nodiscard]] double probability(const Partner& p, const Partner& q) const {
    const double least = std::min(p.rings, q.rings), most = std::max(p.rings, q.rings);
    switch (rule) {
      case Rule::always:
        return 1;
      case Rule::smaller:
        return least >= rings ? 1 : 0;
      case Rule::larger:
        return most >= rings ? 1 : 0;
      case Rule::together:
        return least + most >= rings ? 1 : 0;
      case Rule::reduced:
        return least * most >= rings * (least + most) ? 1 : 0;
      case Rule::bySize:
      case Rule::byTable:
        break;
    }
    const double carbon = std::min(p.carbon, q.carbon);
    if (rule == Rule::byTable) {
      const Place c = placeOf(carbons, carbon);
      return (1 - c.share) * row[c.first] + c.share * row[c.second];
    }
    const double m = 12 * carbon, d = 1e10 * moleculeDiameter(carbon);
    return 1 / (1 + std::exp(-A * (d * d * d / m + std::pow(m / B, 6) - C)));
  }
};

}  // namespace lampblack::particles
