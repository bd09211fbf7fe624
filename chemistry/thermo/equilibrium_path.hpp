// The equations of chemical equilibrium of an ideal gas at given potentials, and the way to their solution: from a
// composition that is an equilibrium of some other potentials and elements, both are moved to the wanted ones along a
// straight line, and the equilibrium is followed (Gibbs function continuation, Pope 2004).
//
// Unknowns are the logarithms of the amounts of the components (equilibrium_components.hpp) and of the total amount N.
// Species j, made of nu_ij components i, has n_j = exp(sum_i nu_ij ln n_i + d_j ln N - dg_j) with d_j = 1 - sum_i nu_ij
// and dg_j = g_j - sum_i nu_ij g_i, where g_j = G_j/RT at the pressure of the mixture. The equations are
// sum_j nu_ij n_j = q_i, the components' amounts, and sum_j n_j = N. At constant volume g_j = G_j/RT - ln(p0 V/RT) with
// G_j at the standard pressure p0, ln N is replaced by zero, and the last equation drops out.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/thermo/equilibrium_components.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class EquilibriumPath {
 public:
  enum class Constant { Pressure, Volume };
  enum class Outcome { Found, Lost, SpeciesExcluded };

  // Species that may be present, and a composition (moles, not negative) that has the elements of the mixture.
  void setMixture(Constant constant, std::size_t numElements, std::vector<double> atoms,
                  std::span<const double> amounts);

  // The composition to start from, ln of moles; it need not have the elements of the mixture.
  void startFrom(std::span<const double> lnAmounts);

  // Follows the equilibrium to potentials g (per species). Later calls start where the last one ended. Lost: the
  // path could not be followed. SpeciesExcluded: the elements forbid excluded(); leave them out and begin again.
  Outcome follow(std::span<const double> g);
  std::span<const std::size_t> excluded() const { return excluded_; }

  std::span<const double> lnAmounts() const { return lnAmounts_; }
  // Change of ln n of every species with a parameter by which the potentials change as dg, at equilibrium.
  void sensitivity(std::span<const double> dg, std::span<double> dLnAmounts);

  std::size_t iterations() const { return iterations_; }  // Newton's, since setMixture

 private:
  enum class Stage { Elements, Potentials };

  std::size_t unknowns() const { return components_.count() + 1; }
  bool chooseComponents();
  void exclude(std::size_t i);
  bool excludeAbsent();
  bool excludeVanishing(double left);
  void setPosition(Stage stage, double left);
  bool setTangent(Stage stage);
  double advance(Stage stage, double left, double step);
  Outcome walk(Stage stage);
  void evaluate();
  bool factorise();
  void solve(std::vector<double>& x) const;
  bool correct(double tolerance);
  void componentPotentials(std::span<const double> g, std::vector<double>& dg) const;
  double componentAmounts(std::span<const double> amounts, std::size_t i) const;
  void weightedSums(const std::vector<double>& values, std::vector<double>& sums) const;

  EquilibriumComponents components_;
  Constant constant_ = Constant::Pressure;
  std::size_t n_ = 0;
  std::vector<double> mixture_, start_;       // moles that define the elements at the end and start of the path
  std::vector<double> startG_, endG_;         // potentials there
  std::vector<double> startDg_, endDg_, dg_;  // the same of forming the species from components; dg_ at the position
  std::vector<double> startQ_, endQ_, q_;
  std::vector<double> z_;  // unknowns: ln of components, ln N
  std::vector<double> lnAmounts_, amounts_, weighted_, change_, residual_, matrix_, scale_, tangent_, saved_, work_;
  std::vector<std::size_t> excluded_;
  std::size_t iterations_ = 0;
};

}  // namespace lampblack::chemistry
