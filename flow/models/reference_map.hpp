// Cells of nearly the same gas take the reactions of one of them (DLBFoam's reference mapping, Tekgul, Peltonen,
// Kahila, Kaario and Vuorinen 2021, by bins of any gas in place of the oxidiser alone): what the reference's reactions
// made in the mean of a step is what they make in the others. A rate of another cell conserves mass and elements as its
// own does, and the enthalpy of a cell does not change by reactions; its temperature follows from both.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "chemistry/thermo/mixture_fraction.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "core/rank_exchange.hpp"
#include "core/state_archive.hpp"

namespace lampblack::flow {

// Which gas is nearly the same: bins of the mixture fraction, the temperature and the logarithm of the density. The
// bins begin where no usual value is: a stream's own gas lies well within one.
class ReferenceMap {
 public:
  struct Options {
    // Widths of the bins.
    double mixtureWidth = 1e-3;
    double temperatureWidth = 2.0;  // K
    double densityWidth = 0.01;     // of the logarithm
    double checked = 0.02;          // share of the cells that take others' reactions whose own are found as well
  };
  using Bin = std::array<std::int64_t, 3>;

  ReferenceMap(const Options& options, MixtureFraction mixtureFraction)
      : options_(options), mixtureFraction_(std::move(mixtureFraction)) {}

  [[nodiscard]] Bin binOf(double temperature, double density, std::span<const double> Y) const;
  // Whether a cell (its permanent number) belongs to the sample of a step that begins at this time (s).
  [[nodiscard]] bool isChecked(std::int64_t number, double time) const;

 private:
  Options options_;
  MixtureFraction mixtureFraction_;
};

// The references among cells of all ranks: in each bin the cell of the smallest permanent number. Which they are, and
// what they give, does not depend on the ranks. Collective, each of them.
class ReferenceCells {
 public:
  struct Cell {
    std::int64_t number;  // permanent
    ReferenceMap::Bin bin;
  };

  ReferenceCells(MPI_Comm comm, std::span<const Cell> cells);

  [[nodiscard]] bool isReference(std::size_t cell) const { return isReference_[cell] != 0; }
  // Rows of `width` values from each reference to the cells of its bin that are none: give(cell, row) fills that of a
  // reference of this rank, take(cell, row) is called for each of the others.
  void spread(std::size_t width, const std::function<void(std::size_t cell, std::span<double> row)>& give,
              const std::function<void(std::size_t cell, std::span<const double> row)>& take) const;

 private:
  std::vector<std::size_t> binOf_;      // of each cell, which of this rank's bins
  std::vector<std::size_t> first_;      // of each of these, the cell of this rank with the smallest number
  std::vector<char> isReference_;       // of each cell
  std::optional<RankExchange> toHome_;  // from bins to the ranks that look after them
  std::vector<std::size_t> holder_;     // of each bin that came here, which of those that came has the reference
};

// What the map did, and by how much cells with their own reactions would have ended a step elsewhere.
struct MapTally {
  double cells = 0.0, mapped = 0.0;  // all, and those that took another's reactions
  double refused = 0.0;              // whose mass fractions would have been below zero by them
  double checked = 0.0;
  double heat = 0.0, heatError = 0.0;                  // J/kg of the checked, absolute values
  double temperatureError = 0.0, fractionError = 0.0;  // K and of any mass fraction, the largest of the checked

  void add(const MapTally& other);
  // Collective. Of all ranks.
  [[nodiscard]] MapTally overRanks(MPI_Comm comm) const;
  void saveOrLoad(StateArchive& archive, MPI_Comm comm);
  [[nodiscard]] static std::vector<Quantity> columns();
  [[nodiscard]] std::vector<double> values() const;
  [[nodiscard]] std::string line() const;  // of a report

 private:
  [[nodiscard]] double relativeHeatError() const { return heat > 0.0 ? heatError / heat : 0.0; }
};

}  // namespace lampblack::flow
