// Tables and memory of ReactorLanes' kernel.
#pragma once

#include <cstdint>
#include <vector>

#include "chemistry/kinetics/batch_jacobian.hpp"
#include "chemistry/kinetics/batch_kinetics_tables.hpp"
#include "chemistry/kinetics/batch_workspace.hpp"
#include "chemistry/kinetics/kinetics_jacobian_table.hpp"
#include "chemistry/kinetics/kinetics_tables.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/reactor_lanes_view.hpp"
#include "core/modules.hpp"
#include "numerics/lane_lu.hpp"

namespace lampblack::chemistry {

class ReactorLanesTables {
 public:
  static bool covers(const Mechanism& mechanism);

  ReactorLanesTables(const Mechanism& mechanism, double leastFraction);
  ReactorLanesTables(const ReactorLanesTables&) = delete;
  ReactorLanesTables& operator=(const ReactorLanesTables&) = delete;

  [[nodiscard]] const ReactorLanesView& view() const { return view_; }
  [[nodiscard]] const ReactorLanesWork& work() const { return work_; }

 private:
  void setEntries();
  void setView();

  std::size_t n_;  // species
  KineticsTables tables_;
  BatchTables batch_;
  JacobianTable jacobianTable_;
  LaneLu lu_;
  BatchJacobianTables jacobian_;
  std::vector<double> weights_, inverseWeights_, gasConstants_;
  std::vector<LaneEntry> entries_;
  std::vector<std::uint32_t> entriesBegin_, temperatureRow_, temperatureColumn_, product_;
  ReactorLanesView view_{};
  BatchWorkspace ratesWork_;
  ReactorLanesWork work_{};
  BatchRows rows_;
};

}  // namespace lampblack::chemistry
