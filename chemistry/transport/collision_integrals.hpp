// Reduced collision integrals of the Stockmayer (12-6-3) potential: what the kinetic theory of a pair of molecules
// needs to know about their collisions.
#pragma once

#include "chemistry/transport/cubic_spline.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// Where the integrals come from.
enum class CollisionIntegrals {
  // The tables of Monchick, Mason, J. Chem. Phys. 35 (1961) 1676-1697.
  MonchickMason,
  // The fits of Wang (2025, eqs 6-36, 6-37, Table 6.1) to Omega(1,1)* and Omega(2,2)*, within 2.5 % of the tables. The
  // other ratios are those of the tables.
  WangFits,
};

// The integrals of one reduced dipole moment delta* = mu_j mu_k / (2 (4 pi eps0) eps sigma^3) as functions of the
// logarithm of the reduced temperature T* = k_B T/eps.
//
// Between the entries of the tables run cubic splines: in delta*, of which the integrals are even functions, then in
// ln T*. The ratios have four digits, of which transport properties feel the last: from T* = 0.5 up a least-squares
// polynomial of degree 8 in ln T* smooths them first (by 0.2 % at most, 0.05 % without dipole). Beyond T* = 0.1 and 100
// ln Omega(2,2)* goes on as a straight line in ln T*, as the integrals of attraction alone and of repulsion alone do,
// and so does A* above 100; the other ratios keep their last value.
class ReducedIntegrals {
 public:
  static constexpr double largestDipole = 2.5;  // where the tables end

  // The dipole moment is taken by magnitude; above largestDipole it counts as that.
  explicit ReducedIntegrals(double reducedDipole, CollisionIntegrals source = CollisionIntegrals::MonchickMason);

  double omega11(double logTemperature) const;  // Omega(1,1)*
  double omega22(double logTemperature) const;  // Omega(2,2)*
  double ratioA(double logTemperature) const;   // A* = Omega(2,2)*/Omega(1,1)*
  double ratioB(double logTemperature) const;   // B* = (5 Omega(1,2)* - 4 Omega(1,3)*)/Omega(1,1)*
  double ratioC(double logTemperature) const;   // C* = Omega(1,2)*/Omega(1,1)*

  // omega11 and the ratios at once, for less than half the cost.
  struct All {
    double omega11, ratioA, ratioB, ratioC;
  };
  All all(double logTemperature) const;

 private:
  double dipole_;
  CollisionIntegrals source_;
  CubicSpline logOmega22_, ratioA_, ratioB_, ratioC_;
};

}  // namespace lampblack::chemistry
