// Averages over time of the ensembles in the cells of a flow that has become steady but for its noise.
//
// Time is divided into blocks. Before the averages start, the mean of each block of the soot in the whole domain and of
// its number is kept, until neither has a trend (isStationary): then they start by themselves, with the next block. Or
// they start at a given time. From there on each cell has the mean over its blocks and, from their scatter, an interval
// of confidence. Steps count by their length; a block ends with the step that fills it.
//
// A cell keeps running sums, 3 numbers an amount, not its blocks; and the sum of its size distributions.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/mesh.hpp"
#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "flow/operator.hpp"
#include "particles/stochastic/size_bins.hpp"

namespace lampblack::coupling {

class EnsembleStatistics {
 public:
  struct Options {
    std::optional<double> start;  // s; nothing: when stationary
    double block = 0.0;           // s
    double drift = 0.01;          // of the mean over the blocks that are looked at: what counts as none
  };
  enum Amount : std::size_t { number, volume, primaries, surface, diameters, amounts };
  using CellAmounts = std::array<double, amounts>;  // per m3
  struct Source {
    std::function<CellAmounts(int cell)> cell;
    std::function<void(int cell, std::span<double> sizes)> sizes;  // a size distribution
  };

  // `material`: what names of fields begin with. `bins` of the size distributions; nothing: they are not averaged.
  EnsembleStatistics(const Mesh& mesh, std::string material, Options options, std::optional<SizeBins> bins);

  // A step of the length `dt` has ended at `time`. Collective.
  void addStep(double time, double dt, const Source& source);

  [[nodiscard]] std::optional<double> since() const { return since_; }  // s, once the averages have started
  [[nodiscard]] std::size_t blocks() const { return blocks_; }          // in the averages
  [[nodiscard]] double block() const { return options_.block; }
  [[nodiscard]] std::optional<double> start() const { return options_.start; }  // s; nothing: when stationary

  // Fields of the averages; those that are not known yet are left out, unless the sink wants them.
  void fields(const Operator::FieldSink& sink) const;
  [[nodiscard]] std::vector<std::string> closingLines() const;

  // Where there are none here, those of the archive are passed over; where it has none, or of other bins, they begin
  // anew. A block once begun keeps its length, whatever the options are now.
  static void saveOrLoad(StateArchive& archive, EnsembleStatistics* statistics);

 private:
  static constexpr std::size_t totals = 2;  // volume, number
  // Of a cell: means, sums of squares of the blocks' deviations, and of products of those of number and diameters.
  static constexpr std::size_t products = 2 * amounts, width = 2 * amounts + 1;

  static constexpr std::ptrdiff_t clocks = 6;

  [[nodiscard]] std::size_t sizeCount() const { return bins_ ? bins_->count : 0; }
  // What is saved of all ranks together; and its way back. False where it is not of this kind.
  [[nodiscard]] std::vector<double> kind() const;
  [[nodiscard]] std::vector<double> head() const;
  [[nodiscard]] bool takeHead(std::span<const double> head);
  void clear();
  void closeBlock(double time);
  void addBlock();
  [[nodiscard]] std::vector<double> series(std::size_t total, bool averagedOnly) const;

  const Mesh& mesh_;
  std::string material_;
  Options options_;
  std::optional<SizeBins> bins_;
  std::optional<double> since_;
  double blockTime_ = 0.0;                     // s, of the running block
  std::size_t blocks_ = 0;                     // in the averages
  std::array<double, totals> running_{};       // this rank's part of the block's integral over time and cells
  std::vector<double> series_;                 // totals of each block
  std::vector<double> block_, sums_;           // of the owned cells
  std::vector<double> sizes_;                  // integral over time of the owned cells' distributions
  double sizesTime_ = 0.0, sinceSizes_ = 0.0;  // s, that it is over, and since it was looked at
};

}  // namespace lampblack::coupling
