#include "particles/population/moments/momic_coagulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "particles/population/moments/moment_system.hpp"

namespace lampblack::particles {

MomicCoagulation::MomicCoagulation(const CollisionKernelOptions& kernel, std::size_t count, double unit, double density)
    : type_(kernel.type), count_(count) {
  static_cast<void>(CollisionKernel(kernel));  // throws for what it lacks
  if (kernel.efficiencyDiameter > 0) {
    throw InputError("MOMIC: an efficiency that depends on the diameter has no closure; use QMOM");
  }
  for (std::size_t l = 0; l < halfWeights_.size(); ++l) {
    const std::vector<double> weights = lagrangeWeights(l + 1, 0.5);
    std::copy(weights.begin(), weights.end(), halfWeights_[l].begin());
  }
  set(kernel, unit, density);
}

void MomicCoagulation::set(const CollisionKernelOptions& kernel, double unit, double density) {
  type_ = kernel.type;
  termCount_ = 0;
  knudsen_ = 0;
  const double efficiency = kernel.efficiency;
  const auto& gas = kernel.gas;
  const double diameter = std::cbrt(6 / constants::pi * unit);  // of the unit volume
  switch (kernel.type) {
    case CollisionKernelType::constant:
      add({efficiency * kernel.rate, 0, 0});
      return;
    case CollisionKernelType::additive:
      add({2 * efficiency * kernel.rate * unit, 6, 0});
      return;
    case CollisionKernelType::multiplicative:
      add({efficiency * kernel.rate * unit * unit, 6, 6});
      return;
    case CollisionKernelType::shear: {  // (u^(1/3) + v^(1/3))^3
      const double c = efficiency * kernel.shearRate / 6 * diameter * diameter * diameter;
      add({2 * c, 6, 0});
      add({6 * c, 4, 2});
      return;
    }
    case CollisionKernelType::continuum:
    case CollisionKernelType::transition: {
      // (C_u/u^(1/3) + C_v/v^(1/3)) (u^(1/3) + v^(1/3)) with C = 1 + a Kn.
      const double c = efficiency * continuumPrefactor(gas.temperature, gas.viscosity);
      const double path = meanFreePath(gas);
      knudsen_ = 2 * path / diameter;
      const double slip = c * knudsen_;
      add({2 * c, 0, 0});
      add({2 * c, 2, -2});
      add({2 * slip, -2, 0, true});
      add({2 * slip, 2, -4, true});
      if (kernel.type == CollisionKernelType::continuum) return;
      break;
    }
    case CollisionKernelType::freeMolecular:
      break;
    case CollisionKernelType::transitionFuchs:
    case CollisionKernelType::gravitational:
      throw InputError(fmt::format("MOMIC: the {} kernel has no closure; use QMOM", nameOf(kernel.type)));
  }
  freeMolecular_ = efficiency * freeMolecularPrefactor(gas.temperature, kernel.enhancement) * diameter * diameter /
                   std::sqrt(density * unit);
}

// a of the slip correction 1 + a Kn, a = 1.257 + 0.4 exp(-1.1/Kn), which has no closure but changes slowly: that of the
// mean volume for all.
double MomicCoagulation::slipFactor(double meanVolume) const {
  if (!(knudsen_ > 0)) return 1;
  const double knudsen = knudsen_ / std::cbrt(meanVolume);
  return (slipCorrection(knudsen) - 1) / knudsen;
}

MomicCoagulation::Rates MomicCoagulation::polynomial(const BrokenMoments& moments) const {
  Rates f{};
  const double factor = slipFactor(moments.at(6) / moments.at(0));
  for (std::size_t i = 0; i < termCount_; ++i) {
    const Term& t = terms_[i];
    const double coefficient = t.slip ? factor * t.coefficient : t.coefficient;
    f[0] -= 0.5 * coefficient * moments.at(t.first) * moments.at(t.second);
    for (std::size_t r = 2; r < count_; ++r) {
      for (std::size_t k = 1; k < r; ++k) {
        const int a = 6 * static_cast<int>(k), b = 6 * static_cast<int>(r - k);
        f[r] += 0.5 * coefficient * binomial(r, k) * moments.at(a + t.first) * moments.at(b + t.second);
      }
    }
  }
  return f;
}

// Sum over pairs of u^x v^y sqrt(u + v) / sqrt(u v) (u^(1/3) + v^(1/3))^2. With (u + v)^l instead of the root it is a
// sum of products of moments for l = 0, 1, 2, 3; the logarithm is interpolated to l = 1/2. Orders far above the highest
// moment are left out.
double MomicCoagulation::gridFunction(const BrokenMoments& moments, std::size_t x, std::size_t y) const {
  const std::size_t highest = std::max(x, y);
  const std::size_t last = std::clamp<std::size_t>(count_ - 1 > highest ? count_ - 1 - highest : 1, 1, 3);
  const auto& weights = halfWeights_[last];
  double logarithm = 0;
  for (std::size_t l = 0; l <= last; ++l) {
    double sum = 0;
    for (std::size_t q = 0; q <= l; ++q) {
      const int a = 6 * static_cast<int>(x + q) - 3, b = 6 * static_cast<int>(y + l - q) - 3;
      sum += binomial(l, q) * (moments.at(a + 4) * moments.at(b) + 2 * moments.at(a + 2) * moments.at(b + 2) +
                               moments.at(a) * moments.at(b + 4));
    }
    logarithm += weights[l] * std::log(sum);
  }
  return std::exp(logarithm);
}

MomicCoagulation::Rates MomicCoagulation::freeMolecular(const BrokenMoments& moments) const {
  Rates f{};
  f[0] = -0.5 * freeMolecular_ * gridFunction(moments, 0, 0);
  for (std::size_t r = 2; r < count_; ++r) {
    for (std::size_t k = 1; k <= r / 2; ++k) {
      const double both = 2 * k == r ? 1.0 : 2.0;  // (k, r-k) and (r-k, k)
      f[r] += 0.5 * both * freeMolecular_ * binomial(r, k) * gridFunction(moments, k, r - k);
    }
  }
  return f;
}

void MomicCoagulation::addRates(const BrokenMoments& moments, double* f) const {
  const Rates first = termCount_ == 0 ? freeMolecular(moments) : polynomial(moments);
  const Rates second = type_ == CollisionKernelType::transition ? freeMolecular(moments) : Rates{};
  for (std::size_t k = 0; k < count_; ++k) {
    if (k == 1) continue;  // the volume is conserved
    f[k] += type_ == CollisionKernelType::transition ? first[k] * second[k] / (first[k] + second[k]) : first[k];
  }
}

}  // namespace lampblack::particles
