#include "particles/population/sectional/linear_processes.hpp"

#include <cmath>

namespace lampblack::particles {
namespace {

double rateOf(const SectionGrid& grid, std::size_t k, double rate, double exponent) {
  const double volume = k == 0 && exponent < 0 ? 0.5 * grid.volume(1) : grid.volume(k);
  return rate * std::pow(volume, exponent);
}

}  // namespace

LinearProcesses::LinearProcesses(const SectionGrid& grid, const PopulationModel& model)
    : sections_(grid.layout().sections) {
  if (!model.breakage && !model.deposition && model.dilution == 0) return;
  entries_.assign(sections_ * (sections_ + 1) / 2, 0.0);
  for (std::size_t k = 0; k < sections_; ++k) {
    at(k, k) -= model.dilution;
    if (model.deposition) at(k, k) -= rateOf(grid, k, model.deposition->rate, model.deposition->exponent);
  }
  if (model.breakage) addBreakage(grid, *model.breakage);
}

void LinearProcesses::addBreakage(const SectionGrid& grid, const BreakageOptions& breakage) {
  const double pieces = breakage.fragments;
  for (std::size_t j = 0; j < sections_; ++j) {
    const double rate = rateOf(grid, j, breakage.rate, breakage.exponent), v = grid.volume(j);
    if (j == 0) {
      at(0, 0) += (pieces - 1) * rate;
    } else if (breakage.daughters == BreakageOptions::Daughters::equal) {
      const auto place = grid.pivotsAround(v / pieces);
      at(place.lower, j) += pieces * (1 - place.upper) * rate;
      at(place.lower + 1, j) += pieces * place.upper * rate;
      at(j, j) -= rate;
    } else {
      // Density 2 / v of fragments on (0, v), against the hat functions of the pivots.
      at(0, j) += grid.volume(1) / v * rate;
      for (std::size_t k = 1; k < j; ++k) at(k, j) += (grid.volume(k + 1) - grid.volume(k - 1)) / v * rate;
      at(j, j) -= grid.volume(j - 1) / v * rate;
    }
  }
}

void LinearProcesses::addRates(const double* y, double* f) const {
  const double* column = entries_.data();
  if (entries_.empty()) return;
  for (std::size_t j = 0; j < sections_; ++j) {
    const double number = y[j];
    for (std::size_t k = 0; k <= j; ++k) f[k] += column[k] * number;
    column += j + 1;
  }
}

void LinearProcesses::addJacobian(double* J, std::size_t ld) const {
  const double* column = entries_.data();
  if (entries_.empty()) return;
  for (std::size_t j = 0; j < sections_; ++j) {
    for (std::size_t k = 0; k <= j; ++k) J[k + j * ld] += column[k];
    column += j + 1;
  }
}

}  // namespace lampblack::particles
