#include "chemistry/transport/pure_gas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

using constants::boltzmann;
using constants::gasConstant;
using constants::pi;

constexpr double coulomb = 4.0 * pi * constants::vacuumPermittivity;

// delta* of eq. 6-39
double reducedDipole(double dipole1, double dipole2, double wellDepth, double diameter) {
  return 0.5 * dipole1 * dipole2 / (coulomb * boltzmann * wellDepth * diameter * diameter * diameter);
}

// Temperature dependence of rotational relaxation, eq. 6-30 (Parker 1959; Brau and Jonkman 1970).
double relaxation(double wellDepth, double T) {
  const double x = wellDepth / T;
  return 1.0 + 0.5 * std::pow(pi, 1.5) * std::sqrt(x) + (0.25 * pi * pi + 2.0) * x +
         std::pow(pi, 1.5) * std::pow(x, 1.5);
}

}  // namespace

PureGas::PureGas(const Mechanism& mechanism, CollisionIntegrals source) {
  for (const auto& species : mechanism.allSpecies()) {
    if (!species.transport)
      throw InputError(fmt::format("{}: species '{}' has no transport data; expected a 'transport' entry of model gas",
                                   mechanism.placeOf(species), species.name));
    const auto& data = *species.transport;
    const double delta = reducedDipole(data.dipole, data.dipole, data.wellDepth, data.diameter);
    if (delta > ReducedIntegrals::largestDipole)
      throw InputError(
          fmt::format("{}: species '{}' has the reduced dipole moment {:.3g}; expected at most {}, where the tables "
                      "of collision integrals end: check dipole, well depth and diameter",
                      mechanism.placeOf(species), species.name, delta, ReducedIntegrals::largestDipole));
    molecules_.push_back({data, species.molecularWeight, species.molecularWeight / constants::avogadro});
  }
  pairs_.reserve(size() * (size() + 1) / 2);
  for (std::size_t j = 0; j < size(); ++j)
    for (std::size_t k = 0; k <= j; ++k) pairs_.push_back(makePair(j, k, source));
}

PureGas::Pair PureGas::makePair(std::size_t j, std::size_t k, CollisionIntegrals source) {
  const auto *a = &molecules_[j].data, *b = &molecules_[k].data;
  double wellDepth = std::sqrt(a->wellDepth * b->wellDepth);  // eq. 6-40
  double diameter = 0.5 * (a->diameter + b->diameter);        // eq. 6-41
  if ((a->dipole > 0) != (b->dipole > 0)) {
    // Polar with nonpolar, eqs 6-42..6-46. The induced dipole enters with the square of the reduced dipole moment
    // (Hirschfelder, Curtiss, Bird 1954, eq. 8.6-3); Wang (2025) prints the first power.
    if (b->dipole > 0) std::swap(a, b);  // a polar, b not
    const double polarizability = b->polarizability / std::pow(b->diameter, 3);
    const double dipoleSquared = 2.0 * reducedDipole(a->dipole, a->dipole, a->wellDepth, a->diameter);
    const double xi = 1.0 + 0.25 * polarizability * dipoleSquared * std::sqrt(a->wellDepth / b->wellDepth);
    wellDepth *= xi * xi;
    diameter *= std::pow(xi, -1.0 / 6.0);
  }
  const double mj = molecules_[j].mass, mk = molecules_[k].mass;
  const double hard = 16.0 / 3.0 * pi * diameter * diameter * std::sqrt(mj * mk / (2.0 * pi * (mj + mk))) /
                      (boltzmann * std::sqrt(boltzmann));
  // The pair is polar only if both are.
  const double delta = reducedDipole(a->dipole, b->dipole, wellDepth, diameter);
  return {std::log(wellDepth), diameter, hard, integralsOf(delta, source)};
}

std::size_t PureGas::integralsOf(double delta, CollisionIntegrals source) {
  const auto known = std::find(dipoles_.begin(), dipoles_.end(), delta);
  const auto index = static_cast<std::size_t>(known - dipoles_.begin());
  if (known == dipoles_.end()) {
    dipoles_.push_back(delta);
    integrals_.emplace_back(delta, source);
  }
  return index;
}

double PureGas::viscosity(std::size_t k, double T) const {
  const auto& p = pair(k, k);
  return 5.0 / 16.0 * std::sqrt(pi * molecules_[k].mass * boltzmann * T) /
         (pi * p.diameter * p.diameter * integrals_[p.integrals].omega22(std::log(T) - p.logWellDepth));
}

double PureGas::resistance(std::size_t j, std::size_t k, double T) const {
  const auto& p = pair(j, k);
  return p.hardResistance * integrals_[p.integrals].omega11(std::log(T) - p.logWellDepth);
}

double PureGas::diffusionTimesPressure(std::size_t j, std::size_t k, double T) const {
  return T * std::sqrt(T) / resistance(j, k, T);
}

double PureGas::ratioA(std::size_t j, std::size_t k, double T) const {
  const auto& p = pair(j, k);
  return integrals_[p.integrals].ratioA(std::log(T) - p.logWellDepth);
}

double PureGas::ratioB(std::size_t j, std::size_t k, double T) const {
  const auto& p = pair(j, k);
  return integrals_[p.integrals].ratioB(std::log(T) - p.logWellDepth);
}

double PureGas::ratioC(std::size_t j, std::size_t k, double T) const {
  const auto& p = pair(j, k);
  return integrals_[p.integrals].ratioC(std::log(T) - p.logWellDepth);
}

void PureGas::pairProperties(double T, double* conductance, double* A, double* B, double* C) const {
  const std::size_t n = size();
  const double logT = std::log(T), cube = T * std::sqrt(T);
  const Pair* pair = pairs_.data();
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k <= j; ++k, ++pair) {
      const auto of = integrals_[pair->integrals].all(logT - pair->logWellDepth);
      const std::size_t below = j * n + k, above = k * n + j;
      conductance[below] = conductance[above] = pair->hardResistance * of.omega11 / cube;
      A[below] = A[above] = of.ratioA;
      B[below] = B[above] = of.ratioB;
      C[below] = C[above] = of.ratioC;
    }
}

double PureGas::rotationalHeatCapacity(std::size_t k) const {
  switch (molecules_[k].data.shape) {
    case MoleculeShape::Atom:
      return 0.0;
    case MoleculeShape::Linear:
      return 1.0;
    case MoleculeShape::Nonlinear:
      break;
  }
  return 1.5;
}

double PureGas::rotationalRelaxation(std::size_t k, double T, double least) const {
  const auto& data = molecules_[k].data;
  return std::max(data.rotationalRelaxation, least) * relaxation(data.wellDepth, 298.0) / relaxation(data.wellDepth, T);
}

// Eqs 6-23..6-33 with Cv = cp - R, ordered by what multiplies cp.
PureGas::EuckenFactors PureGas::euckenFactors(std::size_t k, double T) const {
  const auto& m = molecules_[k];
  if (m.data.shape == MoleculeShape::Atom) return {2.5 * 1.5, 0.0};
  // rho D_kk / mu with rho = p W/(R T)
  const double schmidt = diffusionTimesPressure(k, k, T) * m.weight / (gasConstant * T) / viscosity(k, T);
  const double cvTrans = 1.5;  // heat capacities in units of R
  const double cvRot = rotationalHeatCapacity(k);
  const double A = 2.5 - schmidt;
  const double B = rotationalRelaxation(k, T) + 2.0 / pi * (5.0 / 3.0 * cvRot + schmidt);
  const double ratio = 2.0 / pi * A / B;
  const double fTrans = 2.5 * (1.0 - ratio * cvRot / cvTrans);
  const double fRot = schmidt * (1.0 + ratio);
  return {fTrans * cvTrans + fRot * cvRot - schmidt * (1.0 + cvTrans + cvRot), schmidt};
}

double PureGas::conductivity(std::size_t k, double T, double cpOverR) const {
  const auto eucken = euckenFactors(k, T);
  return viscosity(k, T) / molecules_[k].weight * gasConstant * (eucken.rigid + eucken.vibrating * cpOverR);
}

}  // namespace lampblack::chemistry
