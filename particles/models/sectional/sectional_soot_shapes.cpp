#include "particles/models/sectional/sectional_soot_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "particles/collisions/collision_physics.hpp"

namespace lampblack::particles {
namespace {

constexpr double turn = 0.05;  // part of an end of the range of n_p over which it turns
constexpr double mobilityExponent = 0.45;
constexpr double looseGyration = 1.8;  // n_p from which the gyration diameter depends on n_p

// A function that is flat below 1, the identity above 1 + turn, and smooth in between: value and slope.
std::pair<double, double> atLeastOne(double x) {
  if (x <= 1) return {1, 0};
  if (x >= 1 + turn) return {x, 1};
  const double t = (x - 1) / turn;
  return {1 + turn * t * t * (2 - t), t * (4 - 3 * t)};
}

std::pair<double, double> between(double x, double most) {
  if (2 * x < most) return atLeastOne(x);
  if (most <= 1) return {1, 0};
  // The same turn, seen from the other end.
  const double y = (most - x) / most + 1;
  const auto [value, slope] = atLeastOne(y);
  const double mirrored = most * (2 - value);
  if (mirrored < 1 + turn) {  // a range of a turn's width or two: both turns
    const auto [lower, lowerSlope] = atLeastOne(mirrored);
    return {lower, lowerSlope * slope};
  }
  return {mirrored, slope};
}

}  // namespace

SectionShapes::SectionShapes(std::span<const double> pivots, double density, std::vector<double> regularisation,
                             bool spheres)
    : regularisation_(std::move(regularisation)), spheres_(spheres) {
  const std::size_t n = pivots.size();
  for (const double m : pivots) {
    sphere.push_back(std::cbrt(6 * m / (constants::pi * density)));
    most_.push_back(m / pivots[0]);
  }
  for (auto* values :
       {&byAggregates, &byPrimaries, &areaSlope, &collisionSlope, &mobilitySlope_, &slip, &slipOver, &slipOverSlope})
    values->assign(n, 0);
  primariesEach.assign(n, 1);
  primary = mobility = collision = area = sphere;
  for (std::size_t i = 0; i < n; ++i) setShape(i);
}

void SectionShapes::setShape(std::size_t i) {
  const double n = primariesEach[i];
  const double logarithm = n > 1 ? std::log(n) : 0;
  const double third = n > 1 ? std::exp(logarithm / 3) : 1;
  primary[i] = sphere[i] / third;
  area[i] = constants::pi * sphere[i] * sphere[i] * third;
  areaSlope[i] = area[i] / (3 * n);
  mobility[i] = n > 1 ? primary[i] * std::exp(mobilityExponent * logarithm) : sphere[i];
  mobilitySlope_[i] = mobility[i] * (mobilityExponent - 1.0 / 3) / n;
  collision[i] = mobility[i];
  collisionSlope[i] = mobilitySlope_[i];
  if (n > looseGyration) {
    const double power = std::exp(-0.2 * logarithm), ratio = 1 / (power + 0.4);
    if (ratio > 1) {
      collision[i] = mobility[i] * ratio;
      collisionSlope[i] = mobilitySlope_[i] * ratio + mobility[i] * ratio * ratio * 0.2 * power / n;
    }
  }
}

void SectionShapes::update(std::span<const double> aggregates, std::span<const double> primaries) {
  if (spheres_) return;
  for (std::size_t i = 0; i < size(); ++i) {
    const double number = aggregates[i] + regularisation_[i];
    const double ratio = (primaries[i] + regularisation_[i]) / number;
    const auto [value, slope] = between(ratio, most_[i]);
    byPrimaries[i] = slope / number;
    byAggregates[i] = -ratio * slope / number;
    if (value == primariesEach[i]) continue;
    primariesEach[i] = value;
    setShape(i);
  }
}

void SectionShapes::updateGas(double twiceMeanFreePath) {
  for (std::size_t i = 0; i < size(); ++i) {
    const double knudsen = twiceMeanFreePath / mobility[i];
    const double exponential = DaviesSlip::slow * std::exp(-DaviesSlip::fall / knudsen);
    slip[i] = 1 + knudsen * (DaviesSlip::fast + exponential);
    slipOver[i] = slip[i] / collision[i];
    const double byKnudsen = DaviesSlip::fast + exponential * (1 + DaviesSlip::fall / knudsen);
    slipOverSlope[i] = -byKnudsen * knudsen * mobilitySlope_[i] / (mobility[i] * collision[i]) -
                       slipOver[i] * collisionSlope[i] / collision[i];
  }
}

double SectionShapes::gyration(std::size_t i) const {
  const double n = primariesEach[i];
  return n > looseGyration ? mobility[i] / (std::pow(n, -0.2) + 0.4) : mobility[i] * std::sqrt(0.6);
}

}  // namespace lampblack::particles
