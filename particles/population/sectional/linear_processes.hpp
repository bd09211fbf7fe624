// The processes of the sections that are linear in the number densities: breakage, deposition and dilution, as one
// matrix.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/sectional/section_grid.hpp"

namespace lampblack::particles {

class LinearProcesses {
 public:
  // Fragments between two pivots are divided between them, those below the first pivot between it and the section at
  // zero: the number of fragments and their volume are exact for every section. Rates c v^p of the section at zero are
  // those of volume zero, or of half the first pivot where p < 0.
  LinearProcesses(const SectionGrid& grid, const PopulationModel& model);

  void addRates(const double* y, double* f) const;
  void addJacobian(double* J, std::size_t ld) const;
  [[nodiscard]] std::size_t bytes() const { return sizeof(double) * entries_.size(); }

 private:
  void addBreakage(const SectionGrid& grid, const BreakageOptions& breakage);
  double& at(std::size_t row, std::size_t column) { return entries_[column * (column + 1) / 2 + row]; }

  std::size_t sections_;
  std::vector<double> entries_;  // upper triangle by columns: nothing here makes particles larger
};

}  // namespace lampblack::particles
