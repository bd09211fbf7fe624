// Cells that react by the eddy dissipation concept: in fine structures of a share chi of the gas, which take it in at
// its mean, let it react at constant pressure and enthalpy for their time tau*, and mix it back,
//   dY/dt = chi (Y*(Y) - Y)/tau* + what else changes it,
// by explicit parts of an interval that are short against tau*/chi: reactions conserve what they do in each of them,
// and a steady state does not depend on the interval. Cells without fine structures react as they are.
#pragma once

#include <vector>

#include "chemistry/reactor/reactor_failure.hpp"
#include "chemistry/reactor/reactor_rosenbrock.hpp"
#include "core/modules.hpp"
#include "flow/models/constant_pressure_cells.hpp"

namespace lampblack::flow {

class FineStructureCells final : public CellReactor {
 public:
  // As of ConstantPressureCells.
  FineStructureCells(const Mechanism& mechanism, const Thermo& thermo, const ConstantPressureReactor::Options& options);

  [[nodiscard]] std::size_t cellsTogether() const override { return plain_.cellsTogether(); }
  // A cell's first step is that of the reactor over the time of its structures.
  void advance(std::span<const Cell> cells, double dt, std::span<Result> results) override;
  void rates(std::span<const Asked> cells) override;

 private:
  void advancePlain(std::span<const Cell> cells, double dt, std::span<Result> results);
  template <typename FractionsOf>
  void react(ConstantPressureCells& reactor, const FractionsOf& fractionsOf);
  void findSlopes(const Gas& gas, std::span<const double> Y, std::span<double> slopes);

  const Thermo& thermo_;
  ConstantPressureCells plain_, smooth_;  // the latter for rates of a state
  ReactorSystem system_;
  ReactorRosenbrock steps_;         // of the slopes
  std::vector<std::size_t> which_;  // of the cells, those that have a part to go
  std::vector<int> parts_;          // of each of the cells
  std::vector<Gas> now_;            // of each of the cells, at the beginning of a part
  // Of `which_`, after the time of their structures.
  std::vector<double> reacted_;
  std::vector<Cell> inside_;
  std::vector<Result> found_;
};

}  // namespace lampblack::flow
