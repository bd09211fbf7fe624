// Sums over molecules that grew: of each quantity at each row, and of how many had which formula. All are whole
// numbers, so that sums are exact, and the same however molecules are spread over ranks and runs.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "core/state_archive.hpp"
#include "particles/pah/molecule_growth.hpp"
#include "particles/pah/site_counting.hpp"

namespace lampblack::particles {

// What a row has of a molecule, in this order.
[[nodiscard]] const std::vector<Quantity>& growthQuantities();
// Of site counting what is beside a site is not known: all sites are of types without R5 beside them.
using GrowthValues = std::vector<std::uint64_t>;
[[nodiscard]] GrowthValues valuesOf(const MoleculeGrowth& growth);
// Of what is not counted there are zeros.
[[nodiscard]] GrowthValues valuesOf(const SiteCounting& growth);
// Whether site counting knows a quantity, by its place in growthQuantities().
[[nodiscard]] bool isCounted(std::size_t quantity);

// A formula at a row.
struct RowFormula {
  std::uint64_t row = 0, carbon = 0, hydrogen = 0;
  friend constexpr auto operator<=>(const RowFormula&, const RowFormula&) = default;
};

class GrowthSums {
 public:
  explicit GrowthSums(std::size_t rows);

  // A molecule at a row, which has not left. NumericsError where sums outgrow integers.
  void add(std::size_t row, const GrowthValues& values);
  // Its formula, where the row has a spectrum.
  void addFormula(std::size_t row, const GrowthValues& values);
  // What is beside its sites, for a closure of site counting.
  void addNeighbours(const Molecule& molecule) { closure_.add(molecule); }
  void addEvents(std::uint64_t events) { events_ += events; }
  void add(const GrowthSums& other);
  // Collective. The sums of all ranks on rank 0, those of this rank alone on the others. NumericsError, as add().
  [[nodiscard]] GrowthSums ofAllRanks(MPI_Comm comm) const;
  // Those of rank 0 as they are saved; loaded, rank 0 has them and the others none.
  void saveOrLoad(StateArchive& archive, int rank);

  // Molecules that were there, mean, and its standard error: NaN where there are too few.
  [[nodiscard]] std::uint64_t count(std::size_t row) const { return count_[row]; }
  [[nodiscard]] double mean(std::size_t row, std::size_t quantity) const;
  [[nodiscard]] double standardError(std::size_t row, std::size_t quantity) const;
  [[nodiscard]] const std::map<RowFormula, std::uint64_t>& formulas() const { return formulas_; }
  [[nodiscard]] const SiteClosure& closure() const { return closure_; }
  [[nodiscard]] std::uint64_t events() const { return events_; }  // of all molecules, void ones too

 private:
  [[nodiscard]] std::size_t place(std::size_t row, std::size_t quantity) const;

  std::vector<std::uint64_t> count_, sum_, squares_;
  std::uint64_t events_ = 0;
  std::map<RowFormula, std::uint64_t> formulas_;
  SiteClosure closure_;
};

}  // namespace lampblack::particles
