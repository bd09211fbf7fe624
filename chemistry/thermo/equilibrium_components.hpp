// Components of an equilibrium: as many species as there are independent elements, chosen so that every other species
// is made of components that are at least as abundant as itself. Written in them, the equations of chemical equilibrium
// stay well conditioned however small some amounts are (Smith and Missen 1982, the optimised basis). Abundant means in
// moles; where a species has more than mostLightAtoms (a section of soot), in moles times the square of the atoms, the
// weight of a species in the equation of a component it is made of: a small amount of it may hold all there is of an
// element.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

class EquilibriumComponents {
 public:
  static constexpr double mostLightAtoms = 64;  // of a species that is not heavy

  // atoms[e * numSpecies + j]: of element e in species j. Elements may depend on each other, and on nothing.
  void setSpecies(std::size_t numElements, std::size_t numSpecies, std::vector<double> atoms);

  // Picks the components by falling amount and rewrites all species in them.
  void choose(std::span<const double> lnAmounts);
  // Whether no species exceeds a component it is made of by more than a factor of e^tolerance.
  bool fit(std::span<const double> lnAmounts, double tolerance) const;

  std::size_t count() const { return species_.size(); }
  std::size_t species(std::size_t i) const { return species_[i]; }
  // Species j = sum_i row(i)[j] times component i; remainder()[j] = 1 - sum_i row(i)[j], the moles that are lost when
  // it is made of them.
  const double* row(std::size_t i) const { return &work_[rows_[i] * numSpecies_]; }
  const double* remainder() const { return remainder_.data(); }

 private:
  std::size_t mostAbundant(std::span<const double> lnAmounts) const;

  std::size_t numElements_ = 0, numSpecies_ = 0;
  std::vector<double> atoms_, work_, remainder_;
  std::vector<double> size_, logSize_;  // atoms of the species and ln of their square; one and zero if none is heavy
  bool hasHeavy_ = false;
  std::vector<std::size_t> species_, rows_;
  std::vector<bool> rowUsed_;
};

}  // namespace lampblack::chemistry
