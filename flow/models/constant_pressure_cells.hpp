// Cells whose reactions are those of a closed vessel at constant pressure, by chemistry/reactor's integrators.
#pragma once

#include <vector>

#include "chemistry/reactor/reactor.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "flow/models/cell_reactor.hpp"

namespace lampblack::flow {

class ConstantPressureCells final : public CellReactor {
 public:
  // `thermo` has to live as long.
  ConstantPressureCells(const Mechanism& mechanism, const Thermo& thermo,
                        const ConstantPressureReactor::Options& options)
      : thermo_(thermo),
        reactor_(mechanism, options),
        system_(mechanism, nullptr, options.leastFraction()),
        y_(system_.size()),
        f_(system_.size()) {}

  // Many more than the reactor has lanes, so that few lanes wait for the last ones, and few enough for their states to
  // stay in the processor's cache.
  [[nodiscard]] std::size_t cellsTogether() const override { return 256; }
  // ReactorFailure where the reactor fails.
  void advance(std::span<const Cell> cells, double dt, std::span<Result> results) override;
  void rates(std::span<const Asked> cells) override;

 private:
  void findRates(const Asked& cell);

  const Thermo& thermo_;
  ConstantPressureReactor reactor_;
  ReactorSystem system_;  // of rates alone
  std::vector<double> y_, f_;
  std::vector<ConstantPressureReactor::Cell> cells_;
  std::vector<ConstantPressureReactor::Result> found_;
};

}  // namespace lampblack::flow
