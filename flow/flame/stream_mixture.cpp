#include "flow/flame/stream_mixture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>
#include <utility>

#include "chemistry/thermo/equilibrium.hpp"
#include "core/errors.hpp"

namespace lampblack::flow {
namespace {

constexpr double leastRise = 100;  // K, by burning at constant pressure
// K, of the products of a fuel that burns by itself where no flame is asked for: ethylene, whose equilibrium has soot's
// precursors and 1140 K, flows and mixes.
constexpr double leastHot = 1300;
// Ratio of fuel to oxidiser outside which no gas is flammable by itself at usual temperatures.
constexpr double leanest = 0.1, richest = 6;
// Share of a flammable stream in what it has mixed with when it burns: it burns early.
constexpr double flammableShare = 0.9;

std::string text(double value) {
  std::ostringstream out;
  out << std::setprecision(4) << value;
  return out.str();
}

void checkSize(const Mechanism& mechanism, const FlameStream& stream) {
  if (stream.Y.size() != mechanism.numSpecies())
    throw InputError("flame: a stream has " + std::to_string(stream.Y.size()) + " mass fractions, the mechanism " +
                     std::to_string(mechanism.numSpecies()) + " species");
}

struct Burnt {
  double T = 0;
  std::vector<double> Y;
};

Burnt burn(const Mechanism& mechanism, double enthalpy, double pressure, std::vector<double> Y) {
  Burnt burnt{0, std::move(Y)};
  burnt.T = Equilibrium(mechanism).atEnthalpyAndPressure(enthalpy, pressure, burnt.Y);
  return burnt;
}

bool flammable(const Mechanism& mechanism, const Thermo& thermo, const FlameStream& stream, double pressure) {
  const auto [fuel, oxidiser] = fuelAndOxidiser(mechanism, stream.Y);
  if (fuel <= leanest * oxidiser || fuel >= richest * oxidiser) return false;
  const double h = thermo.enthalpyMass(stream.temperature, stream.Y);
  return burn(mechanism, h, pressure, stream.Y).T > stream.temperature + leastRise;
}

// The products of a gas that burns with nothing: hydrogen peroxide, hydrazine, ozone, acetylene. Empty where they are
// not hotter than `least`.
std::optional<Burnt> decompose(const Mechanism& mechanism, const Thermo& thermo, const FlameStream& stream,
                               double pressure, double least) {
  const double h = thermo.enthalpyMass(stream.temperature, stream.Y);
  try {
    Burnt burnt = burn(mechanism, h, pressure, stream.Y);
    if (burnt.T >= std::max(least, stream.temperature + leastRise)) return burnt;
  } catch (const NumericsError&) {
    // No equilibrium in the range of the data, as of a fuel that would get cold.
  }
  return std::nullopt;
}

}  // namespace

FuelAndOxidiser fuelAndOxidiser(const Mechanism& mechanism, std::span<const double> Y) {
  // O atoms that an atom takes when it burns.
  constexpr std::array<std::pair<const char*, double>, 5> takes{{{"C", 2}, {"H", 0.5}, {"O", -1}, {"S", 2}, {"Si", 2}}};
  FuelAndOxidiser content;
  for (std::size_t k = 0; k < Y.size(); ++k) {
    double perMol = 0;
    for (const auto& [element, oxygen] : takes)
      if (const auto e = mechanism.findElement(element)) perMol += oxygen * mechanism.atoms(k, *e);
    const double perKg = perMol * std::max(Y[k], 0.0) / mechanism.molecularWeights()[k];
    (perKg > 0 ? content.fuel : content.oxidiser) += std::abs(perKg);
  }
  return content;
}

StreamMixture::StreamMixture(const Mechanism& mechanism, const FlameStream& left, const FlameStream& right)
    : thermo_(mechanism) {
  checkSize(mechanism, left);
  checkSize(mechanism, right);
  leftEnthalpy_ = thermo_.enthalpyMass(left.temperature, left.Y);
  rightEnthalpy_ = thermo_.enthalpyMass(right.temperature, right.Y);
  knots_ = {{0.0, right.Y}, {1.0, left.Y}};
  hottest_ = std::max(left.temperature, right.temperature);
  hottestShare_ = left.temperature > right.temperature ? 1 : 0;
}

StreamMixture StreamMixture::cold(const Mechanism& mechanism, const FlameStream& left, const FlameStream& right) {
  return {mechanism, left, right};
}

StreamMixture StreamMixture::premixed(const Mechanism& mechanism, const FlameProblem& problem) {
  const FlameStream& stream = problem.left;
  const double pressure = problem.pressure;
  checkSize(mechanism, stream);
  const auto [fuel, oxidiser] = fuelAndOxidiser(mechanism, stream.Y);
  const Thermo thermo(mechanism);
  Burnt burnt;
  if (fuel > 0 && oxidiser > 0) {
    const double h = thermo.enthalpyMass(stream.temperature, stream.Y);
    burnt = burn(mechanism, h, pressure, stream.Y);
    if (burnt.T < stream.temperature + leastRise)
      throw InputError("flame: the stream of " + text(stream.temperature) + " K burns to only " + text(burnt.T) +
                       " K (equivalence ratio " + text(fuel / oxidiser) + ")");
  } else {
    // At a given temperature, whether the gas would be hotter says nothing.
    std::optional<Burnt> decomposed;
    if (!problem.given)
      decomposed =
          decompose(mechanism, thermo, stream, pressure, fuel > 0 && problem.type != FlameType::Free ? leastHot : 0);
    if (!decomposed)
      throw InputError(std::string("flame: the stream has no ") + (fuel <= 0 ? "fuel" : "oxidiser") +
                       " and does not burn by itself: its equilibrium is not hotter");
    burnt = std::move(*decomposed);
  }
  FlameStream products = stream;
  products.temperature = burnt.T;
  products.Y = burnt.Y;
  return {mechanism, stream, products};
}

StreamMixture StreamMixture::counterflow(const Mechanism& mechanism, const FlameStream& left, const FlameStream& right,
                                         double pressure) {
  StreamMixture mixture(mechanism, left, right);
  const auto l = fuelAndOxidiser(mechanism, left.Y);
  const auto r = fuelAndOxidiser(mechanism, right.Y);
  if (flammable(mechanism, mixture.thermo_, right, pressure))
    mixture.addEquilibrium(mechanism, 1 - flammableShare, pressure);
  // Stoichiometric: what is missing on one side is there on the other.
  const double missingLeft = l.fuel - l.oxidiser;
  const double missingRight = r.fuel - r.oxidiser;
  if (missingLeft * missingRight < 0)
    mixture.addEquilibrium(mechanism, missingRight / (missingRight - missingLeft), pressure);
  if (flammable(mechanism, mixture.thermo_, left, pressure))
    mixture.addEquilibrium(mechanism, flammableShare, pressure);
  if (mixture.knots_.size() == 2) {
    const auto burns = [&](const FlameStream& stream, double fuel) {
      return decompose(mechanism, mixture.thermo_, stream, pressure, fuel > 0 ? leastHot : 0).has_value();
    };
    if (burns(right, r.fuel)) mixture.addEquilibrium(mechanism, 1 - flammableShare, pressure);
    if (burns(left, l.fuel)) mixture.addEquilibrium(mechanism, flammableShare, pressure);
  }
  if (mixture.knots_.size() == 2)
    throw InputError("flame: these two streams do not burn with each other: " +
                     std::string(l.fuel + r.fuel <= 0           ? "neither has fuel"
                                 : l.oxidiser + r.oxidiser <= 0 ? "neither has an oxidiser"
                                                                : "no mixture of them is stoichiometric or flammable"));
  return mixture;
}

void StreamMixture::addEquilibrium(const Mechanism& mechanism, double share, double pressure) {
  // Two places so near are one.
  for (const Knot& knot : knots_)
    if (std::abs(knot.share - share) < 1e-6) return;
  std::vector<double> Y(mechanism.numSpecies());
  const auto& right = knots_.front().Y;
  const auto& left = knots_.back().Y;
  for (std::size_t k = 0; k < Y.size(); ++k) Y[k] = share * left[k] + (1 - share) * right[k];
  const double h = share * leftEnthalpy_ + (1 - share) * rightEnthalpy_;
  Burnt burnt = burn(mechanism, h, pressure, std::move(Y));
  if (burnt.T > hottest_) {
    hottest_ = burnt.T;
    hottestShare_ = share;
  }
  const auto place = std::ranges::upper_bound(knots_, share, {}, &Knot::share);
  knots_.insert(place, {share, std::move(burnt.Y)});
}

double StreamMixture::at(double share, std::span<double> Y) const {
  share = std::clamp(share, 0.0, 1.0);
  const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, share,
                                      [](double s, const Knot& knot) { return s < knot.share; });
  const Knot& to = *above;
  const Knot& from = *(above - 1);
  const double t = (share - from.share) / (to.share - from.share);
  for (std::size_t k = 0; k < Y.size(); ++k) Y[k] = (1 - t) * from.Y[k] + t * to.Y[k];
  return thermo_.temperatureFromEnthalpy(share * leftEnthalpy_ + (1 - share) * rightEnthalpy_, Y, hottest_);
}

std::string inertReason(const Mechanism& mechanism, const FlameProblem& problem) {
  try {
    if (problem.right)
      static_cast<void>(StreamMixture::counterflow(mechanism, problem.left, *problem.right, problem.pressure));
    else
      static_cast<void>(StreamMixture::premixed(mechanism, problem));
  } catch (const InputError& error) {
    const std::string reason = error.what(), about = "flame: ";
    return reason.starts_with(about) ? reason.substr(about.size()) : reason;
  }
  return {};
}

}  // namespace lampblack::flow
