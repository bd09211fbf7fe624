#include "chemistry/reactor/reactor_lanes_tables.hpp"

#include <algorithm>

#include "chemistry/reactor/newton_matrix.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "numerics/sparse_lu.hpp"

namespace lampblack::chemistry {

bool ReactorLanesTables::covers(const Mechanism& mechanism) {
  const KineticsTables tables(mechanism);
  return BatchJacobianTables::covers(tables, BatchTables(mechanism, tables).view());
}

ReactorLanesTables::ReactorLanesTables(const Mechanism& mechanism, double leastFraction)
    : n_(mechanism.numSpecies()),
      tables_(mechanism),
      batch_(mechanism, tables_),
      jacobianTable_(tables_),
      lu_(borderedElimination(jacobianTable_.pattern()), batchLanes),
      jacobian_(
          tables_, batch_.view(), batch_.numEntries(), jacobianTable_,
          [this](std::size_t row, std::size_t column) { return lu_.position(row, column); },
          static_cast<std::uint32_t>(lu_.numEntries() * batchLanes)),
      weights_(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()),
      ratesWork_(batch_.view(), batch_.numEntries()),
      rows_({{&work_.jacobian.slope, batch_.numEntries()},
             {&work_.jacobian.byM, batch_.numEntries()},
             {&work_.jacobian.columns, jacobian_.view().columns},
             {&work_.jacobian.h, n_},
             {&work_.jacobian.cp, n_},
             {&work_.jacobian.cpSlope, n_},
             {&work_.jacobian.wdot, n_ + 1},
             {&work_.jacobian.byT, n_ + 1},
             {&work_.jacobian.common, n_},
             {&work_.lu.matrix, lu_.numEntries() + 1},
             {&work_.lu.lower, lu_.numLower()},
             {&work_.lu.upper, lu_.numUpper()},
             {&work_.lu.inversePivot, lu_.size()},
             {&work_.lu.row, lu_.size()},
             {&work_.lu.x, lu_.size()},
             {&work_.pressure, 1},
             {&work_.heating, 1},
             {&work_.rateFactor, 1},
             {&work_.stepSize, 1},
             {&work_.y, n_ + 1},
             {&work_.source, n_},
             {&work_.diagonal, n_ + 2},
             {&work_.end, n_ + 1},
             {&work_.errorSum, 1},
             {&work_.isGood, 1},
             {&work_.start, n_ + 1},
             {&work_.f, n_ + 1},
             {&work_.k1, n_ + 2},
             {&work_.k2, n_ + 2},
             {&work_.k3, n_ + 2},
             {&work_.k4, n_ + 2}}) {
  for (const double W : weights_) {
    inverseWeights_.push_back(1.0 / W);
    gasConstants_.push_back(constants::gasConstant / W);
  }
  work_.rates = ratesWork_.work();
  work_.jacobian.values = work_.lu.matrix;
  setEntries();
  view_.leastFraction = leastFraction;
  setView();
  // What never changes: the product's vector v, and the diagonal but for its own unknown.
  for (std::size_t j = 0; j < n_; ++j)
    std::fill_n(work_.lu.matrix + lu_.position(n_ + 1, j), batchLanes, inverseWeights_[j]);
  std::fill_n(work_.diagonal, (n_ + 2) * batchLanes, 1.0);
}

void ReactorLanesTables::setEntries() {
  const auto& pattern = jacobianTable_.pattern();
  std::vector<std::vector<LaneEntry>> rows(n_);
  for (std::size_t j = 0; j < n_; ++j)
    for (auto e = pattern.columnStart[j]; e < pattern.columnStart[j + 1]; ++e) {
      const auto k = static_cast<std::size_t>(pattern.row[static_cast<std::size_t>(e)]);
      rows[k].push_back({lu_.position(k, j), static_cast<std::uint32_t>(j * batchLanes), weights_[k] / weights_[j]});
    }
  for (auto& row : rows) {
    std::ranges::sort(row, {}, &LaneEntry::place);
    entriesBegin_.push_back(static_cast<std::uint32_t>(entries_.size()));
    entries_.insert(entries_.end(), row.begin(), row.end());
  }
  entriesBegin_.push_back(static_cast<std::uint32_t>(entries_.size()));
  const std::size_t T = n_, s = n_ + 1;
  for (std::size_t j = 0; j < n_; ++j) temperatureRow_.push_back(lu_.position(T, j));
  for (std::size_t i = 0; i <= n_; ++i) {
    temperatureColumn_.push_back(lu_.position(i, T));
    product_.push_back(lu_.position(i, s));
  }
}

void ReactorLanesTables::setView() {
  view_.rates = batch_.view();
  view_.jacobian = jacobian_.view();
  view_.lu = lu_.view();
  view_.numSpecies = n_;
  view_.minTemperature = Thermo::minTemperature;
  view_.maxTemperature = Thermo::maxTemperature;
  view_.minStepTemperature = std::max(view_.minTemperature, view_.rates.minProductTemperature);
  view_.maxStepTemperature = std::min(view_.maxTemperature, view_.rates.maxProductTemperature);
  view_.gasConstant = constants::gasConstant;
  view_.weights = weights_.data();
  view_.inverseWeights = inverseWeights_.data();
  view_.gasConstants = gasConstants_.data();
  view_.entries = entries_.data();
  view_.entriesBegin = entriesBegin_.data();
  view_.temperatureRow = temperatureRow_.data();
  view_.temperatureColumn = temperatureColumn_.data();
  view_.product = product_.data();
  view_.largestMultiplier = SparseLu::largestMultiplier;
}

}  // namespace lampblack::chemistry
