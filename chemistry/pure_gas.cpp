#include "chemistry/pure_gas.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "chemistry/species_thermo.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack {

namespace {

using constants::boltzmann;
using constants::gasConstant;
using constants::pi;

constexpr double coulomb = 4.0 * pi * constants::vacuumPermittivity;

// Temperature dependence of rotational relaxation, eq. 6-30 (Parker 1959; Brau and Jonkman 1970).
double relaxation(double wellDepth, double T) {
  const double x = wellDepth / T;
  return 1.0 + 0.5 * std::pow(pi, 1.5) * std::sqrt(x) + (0.25 * pi * pi + 2.0) * x +
         std::pow(pi, 1.5) * std::pow(x, 1.5);
}

}  // namespace

PureGas::PureGas(const Mechanism& mechanism, CollisionIntegrals integrals) : integrals_(integrals) {
  for (std::size_t k = 0; k < mechanism.numSpecies(); ++k) {
    const auto& species = mechanism.species(k);
    if (!species.transport)
      throw InputError(
          fmt::format("{}:{}: species '{}' has no transport data; expected a 'transport' entry of model gas",
                      mechanism.fileName(), species.line, species.name));
    molecules_.push_back(
        {*species.transport, species, species.molecularWeight, species.molecularWeight / constants::avogadro});
  }
}

PureGas::Pair PureGas::pair(std::size_t j, std::size_t k) const {
  const auto *a = &molecules_[j].data, *b = &molecules_[k].data;
  Pair p;
  p.wellDepth = std::sqrt(a->wellDepth * b->wellDepth);  // eq. 6-40
  p.diameter = 0.5 * (a->diameter + b->diameter);        // eq. 6-41
  if ((a->dipole > 0) != (b->dipole > 0)) {
    // Polar with nonpolar, eqs 6-42..6-46. The induced dipole enters with the square of the reduced dipole moment
    // (Hirschfelder, Curtiss, Bird 1954, eq. 8.6-3); the thesis prints the first power.
    if (b->dipole > 0) std::swap(a, b);  // a polar, b not
    const double polarizability = b->polarizability / std::pow(b->diameter, 3);
    const double dipoleSquared =
        a->dipole * a->dipole / (coulomb * boltzmann * a->wellDepth * std::pow(a->diameter, 3));
    const double xi = 1.0 + 0.25 * polarizability * dipoleSquared * std::sqrt(a->wellDepth / b->wellDepth);
    p.wellDepth *= xi * xi;
    p.diameter *= std::pow(xi, -1.0 / 6.0);
  }
  // eq. 6-39; zero unless both are polar
  p.reducedDipole = 0.5 * a->dipole * b->dipole / (coulomb * boltzmann * p.wellDepth * std::pow(p.diameter, 3));
  return p;
}

double PureGas::viscosity(std::size_t k, double T) const {
  const auto p = pair(k, k);
  return 5.0 / 16.0 * std::sqrt(pi * molecules_[k].mass * boltzmann * T) /
         (pi * p.diameter * p.diameter * collisionIntegral22(T / p.wellDepth, p.reducedDipole, integrals_));
}

double PureGas::diffusionTimesPressure(std::size_t j, std::size_t k, double T) const {
  const auto p = pair(j, k);
  const double mj = molecules_[j].mass, mk = molecules_[k].mass;
  const double kT = boltzmann * T;
  return 3.0 / 16.0 * std::sqrt(2.0 * pi * kT * kT * kT * (mj + mk) / (mj * mk)) /
         (pi * p.diameter * p.diameter * collisionIntegral11(T / p.wellDepth, p.reducedDipole, integrals_));
}

// Eqs 6-23..6-33 with Cv = cp - R, ordered by what multiplies cp.
PureGas::EuckenFactors PureGas::euckenFactors(std::size_t k, double T) const {
  const auto& m = molecules_[k];
  if (m.data.shape == MoleculeShape::Atom) return {2.5 * 1.5, 0.0};
  // rho D_kk / mu with rho = p W/(R T)
  const double schmidt = diffusionTimesPressure(k, k, T) * m.weight / (gasConstant * T) / viscosity(k, T);
  const double cvTrans = 1.5;  // heat capacities in units of R
  const double cvRot = m.data.shape == MoleculeShape::Linear ? 1.0 : 1.5;
  const double zRot =
      m.data.rotationalRelaxation * relaxation(m.data.wellDepth, 298.0) / relaxation(m.data.wellDepth, T);
  const double A = 2.5 - schmidt;
  const double B = zRot + 2.0 / pi * (5.0 / 3.0 * cvRot + schmidt);
  const double ratio = 2.0 / pi * A / B;
  const double fTrans = 2.5 * (1.0 - ratio * cvRot / cvTrans);
  const double fRot = schmidt * (1.0 + ratio);
  return {fTrans * cvTrans + fRot * cvRot - schmidt * (1.0 + cvTrans + cvRot), schmidt};
}

double PureGas::conductivity(std::size_t k, double T) const {
  const auto eucken = euckenFactors(k, T);
  return viscosity(k, T) / molecules_[k].weight * gasConstant *
         (eucken.rigid + eucken.vibrating * cpOverR(molecules_[k].species, T));
}

}  // namespace lampblack
