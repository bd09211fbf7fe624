#include "flow/models/combustion/chemical_time.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lampblack::flow {
namespace {

constexpr double still = 1e-16;  // 1/s, a mass fraction that changes no faster has no time of its own

double sumOf(const std::vector<StoichiometricTerm>& terms) {
  return std::accumulate(terms.begin(), terms.end(), 0.0,
                         [](double sum, const StoichiometricTerm& term) { return sum + term.coefficient; });
}

}  // namespace

ChemicalTime::ChemicalTime(const Mechanism& mechanism, Kind kind)
    : mechanism_(mechanism),
      kind_(kind),
      kinetics_(mechanism),
      c_(mechanism.numSpecies()),
      forward_(mechanism.numReactions()),
      back_(forward_.size()),
      net_(c_.size()) {
  for (const double W : mechanism.molecularWeights()) inverseWeights_.push_back(1.0 / W);
  for (std::size_t r = 0; r < forward_.size(); ++r) {
    madeForward_.push_back(sumOf(mechanism.reaction(r).products));
    madeBack_.push_back(sumOf(mechanism.reaction(r).reactants));
  }
}

void ChemicalTime::setConcentrations(double density, std::span<const double> Y) {
  for (std::size_t k = 0; k < c_.size(); ++k) c_[k] = std::max(Y[k], 0.0) * density * inverseWeights_[k];
}

double ChemicalTime::of(double temperature, double density, std::span<const double> Y) {
  setConcentrations(density, Y);
  if (kind_ == Kind::SlowestSpecies) {
    kinetics_.netProductionRates(temperature, c_, net_);
    for (std::size_t k = 0; k < c_.size(); ++k) {
      // Of mass fractions from here on.
      const double toFraction = 1.0 / (density * inverseWeights_[k]);
      net_[k] *= toFraction;
      c_[k] *= toFraction;
    }
    return ofSlowest();
  }
  kinetics_.ratesOfProgress(temperature, c_, forward_, back_);
  return ofReactions();
}

double ChemicalTime::ofReactions() const {
  const double total = std::accumulate(c_.begin(), c_.end(), 0.0);
  double made = 0.0, squares = 0.0;
  for (std::size_t r = 0; r < forward_.size(); ++r) {
    const double ahead = madeForward_[r] * forward_[r];
    made += ahead;
    if (kind_ == Kind::ReactionsOf6) continue;
    const double back = madeBack_[r] * back_[r];
    made += back;
    squares += ahead * ahead + back * back;
  }
  // c_tot n/sum w, and c_tot sum w/sum w^2.
  const double amount = kind_ == Kind::ReactionsOf6 ? total * static_cast<double>(forward_.size()) : total * made;
  const double speed = kind_ == Kind::ReactionsOf6 ? made : squares;
  return speed * longest > amount ? amount / speed : longest;
}

double ChemicalTime::ofSlowest() const {
  double slowest = 0.0;
  bool anyMoves = false;
  for (std::size_t k = 0; k < c_.size(); ++k) {
    const double speed = std::abs(net_[k]);
    if (!(speed > still)) continue;
    anyMoves = true;
    slowest = std::max(slowest, c_[k] / speed);
  }
  return anyMoves ? std::min(slowest, longest) : longest;
}

// With g_r = d ln tau/d ln w_r of each direction and G_j = sum g_r nu_rj over what it uses, at constant pressure
//   d ln tau/dY_j = G_j/Y_j - (W/W_j) sum G,   d ln tau/dT = d ln tau/dT at constant concentrations - (1 + sum G)/T.
void ChemicalTime::slopes(double temperature, double density, std::span<const double> Y, std::span<double> slopes) {
  std::ranges::fill(slopes, 0.0);
  const double time = of(temperature, density, Y);
  if (kind_ == Kind::SlowestSpecies || time >= longest) return;
  double made = 0.0, squares = 0.0, total = 0.0, all = 0.0;
  for (std::size_t r = 0; r < forward_.size(); ++r) {
    const double ahead = madeForward_[r] * forward_[r], back = madeBack_[r] * back_[r];
    made += ahead + (kind_ == Kind::ReactionsOf6 ? 0.0 : back);
    squares += ahead * ahead + back * back;
  }
  const auto add = [&](double w, const std::vector<StoichiometricTerm>& used) {
    const double g = kind_ == Kind::ReactionsOf6 ? -w / made : w / made - 2.0 * w * w / squares;
    for (const StoichiometricTerm& term : used) slopes[term.species] += g * term.coefficient;
  };
  for (std::size_t r = 0; r < forward_.size(); ++r) {
    add(madeForward_[r] * forward_[r], mechanism_.reaction(r).reactants);
    if (kind_ == Kind::WeightedReactions) add(madeBack_[r] * back_[r], mechanism_.reaction(r).products);
  }
  for (std::size_t k = 0; k < c_.size(); ++k) {
    total += c_[k];
    all += slopes[k];
  }
  for (std::size_t k = 0; k < c_.size(); ++k)
    slopes[k] = (c_[k] > 0.0 ? slopes[k] / Y[k] : 0.0) - density / total * inverseWeights_[k] * all;
  const double rise = 1e-4 * temperature;
  kinetics_.ratesOfProgress(temperature + rise, c_, forward_, back_);
  slopes[c_.size()] = (ofReactions() / time - 1.0) / rise - (1.0 + all) / temperature;
}

}  // namespace lampblack::flow
