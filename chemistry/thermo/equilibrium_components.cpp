#include "chemistry/thermo/equilibrium_components.hpp"

#include <algorithm>
#include <cmath>

namespace lampblack::chemistry {
namespace {

// Atoms are small numbers: what elimination leaves below this is rounding.
constexpr double negligible = 1e-10;

}  // namespace

void EquilibriumComponents::setSpecies(std::size_t numElements, std::size_t numSpecies, std::vector<double> atoms) {
  numElements_ = numElements;
  numSpecies_ = numSpecies;
  atoms_ = std::move(atoms);
  remainder_.resize(numSpecies);
  species_.clear();
  rows_.clear();
  size_.assign(numSpecies, 1.0);
  logSize_.assign(numSpecies, 0.0);
  for (std::size_t j = 0; j < numSpecies; ++j) {
    double sum = 0;
    for (std::size_t e = 0; e < numElements; ++e) sum += std::max(atoms_[e * numSpecies + j], 0.0);
    size_[j] = std::max(sum, 1.0);
  }
  hasHeavy_ = std::ranges::any_of(size_, [](double size) { return size > mostLightAtoms; });
  if (!hasHeavy_) size_.assign(numSpecies, 1.0);
  for (std::size_t j = 0; j < numSpecies; ++j) logSize_[j] = 2 * std::log(size_[j]);
}

// The most abundant species that is not made of the components so far; numSpecies_ if there is none.
std::size_t EquilibriumComponents::mostAbundant(std::span<const double> lnAmounts) const {
  std::size_t best = numSpecies_;
  for (std::size_t j = 0; j < numSpecies_; ++j) {
    if (best < numSpecies_ && !(lnAmounts[j] + logSize_[j] > lnAmounts[best] + logSize_[best])) continue;
    for (std::size_t e = 0; e < numElements_; ++e)
      if (!rowUsed_[e] && work_[e * numSpecies_ + j] != 0) {
        best = j;
        break;
      }
  }
  return best;
}

void EquilibriumComponents::choose(std::span<const double> lnAmounts) {
  work_ = atoms_;
  // Per atom of the species, so that all numbers are of one magnitude.
  if (hasHeavy_)
    for (std::size_t e = 0; e < numElements_; ++e)
      for (std::size_t k = 0; k < numSpecies_; ++k) work_[e * numSpecies_ + k] /= size_[k];
  species_.clear();
  rows_.clear();
  rowUsed_.assign(numElements_, false);
  for (;;) {
    const std::size_t j = mostAbundant(lnAmounts);
    if (j == numSpecies_) break;
    std::size_t pivot = numElements_;
    for (std::size_t e = 0; e < numElements_; ++e)
      if (!rowUsed_[e] &&
          (pivot == numElements_ || std::abs(work_[e * numSpecies_ + j]) > std::abs(work_[pivot * numSpecies_ + j])))
        pivot = e;
    // Gauss-Jordan: the pivot's row becomes that of the new component.
    double* row = &work_[pivot * numSpecies_];
    const double scale = 1.0 / row[j];
    for (std::size_t k = 0; k < numSpecies_; ++k) row[k] *= scale;
    for (std::size_t e = 0; e < numElements_; ++e) {
      double* other = &work_[e * numSpecies_];
      const double factor = other[j];
      if (e == pivot || factor == 0) continue;
      for (std::size_t k = 0; k < numSpecies_; ++k) {
        const double left = other[k] - factor * row[k];
        other[k] = std::abs(left) < negligible ? 0.0 : left;
      }
    }
    rowUsed_[pivot] = true;
    rows_.push_back(pivot);
    species_.push_back(j);
  }
  if (hasHeavy_)
    for (std::size_t i = 0; i < count(); ++i)
      for (std::size_t k = 0; k < numSpecies_; ++k) work_[rows_[i] * numSpecies_ + k] *= size_[k] / size_[species_[i]];
  for (std::size_t k = 0; k < numSpecies_; ++k) {
    double left = 1.0;
    for (std::size_t i = 0; i < count(); ++i) left -= row(i)[k];
    remainder_[k] = std::abs(left) < negligible ? 0.0 : left;
  }
}

bool EquilibriumComponents::fit(std::span<const double> lnAmounts, double tolerance) const {
  for (std::size_t i = 0; i < count(); ++i) {
    const double most = lnAmounts[species_[i]] + logSize_[species_[i]] + tolerance;
    const double* nu = row(i);
    for (std::size_t j = 0; j < numSpecies_; ++j)
      if (nu[j] != 0 && lnAmounts[j] + logSize_[j] > most) return false;
  }
  return true;
}

}  // namespace lampblack::chemistry
