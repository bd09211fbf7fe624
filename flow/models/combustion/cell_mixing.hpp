// How turbulence holds up the reactions of a cell: what a model of combustion tells of it, and who asks. The equations
// stand in docs/theory/combustion.md.
#pragma once

#include <algorithm>
#include <span>

#include "core/modules.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// As the gas of a cell reacts. Without turbulence: all of it, at its mean.
struct CellMixing {
  double reactingShare = 1.0;  // what the rates of the reactions are multiplied with, kappa or chi
  double fineTime = 0.0;       // s, of fine structures in which the gas reacts before it mixes; 0: it reacts as it is
};

class MixingModel {
 public:
  virtual ~MixingModel() = default;
  // Of the owned cells in the state at the end of the last sweep.
  [[nodiscard]] virtual std::span<const CellMixing> present() const = 0;
  // Of the owned cells in a state, for what is a function of it alone. Until the next call.
  virtual std::span<const CellMixing> of(const State& state) = 0;
  // Of the state that of() was asked of last: derivatives of the logarithm of a cell's reacting share, by mass
  // fractions at constant pressure, then by temperature. They steer iterations: what is small may be left out, here all
  // of it.
  virtual void slopesOfShare(const State&, int /*cell*/, std::span<double> slopes) { std::ranges::fill(slopes, 0.0); }

 protected:
  MixingModel() = default;
  MixingModel(const MixingModel&) = default;
  MixingModel& operator=(const MixingModel&) = default;
};

}  // namespace lampblack::flow
