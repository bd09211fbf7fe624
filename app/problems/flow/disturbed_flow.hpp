// A copy of a flow that is marched in time beside it, as often as it is asked for and from any values of its fields:
// what disturbances of a state become (flow/steady/leading_modes.hpp). Steps are of one length and of two sweeps, of
// second order in time: one sweep, an explicit step, would make what oscillates grow.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/problems/flow/flow_case.hpp"
#include "app/problems/flow/flow_domain.hpp"
#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "core/state_backup.hpp"
#include "flow/steady/leading_modes.hpp"

namespace lampblack::app {

class DisturbedFlow {
 public:
  // Collective. Of the state that `found` has, which stays as it is; `time` (s): over which it is marched, in a whole
  // number of steps; `slow` (m/s): a velocity that is small in it. The copy is marched beforehand until what a step
  // keeps from the one before belongs to such steps. NumericsError where one fails.
  DisturbedFlow(FlowDomain& found, const FlowCase& flowCase, const Thermo& thermo, Transport& transport, double time,
                double slow);
  DisturbedFlow(const DisturbedFlow&) = delete;
  DisturbedFlow& operator=(const DisturbedFlow&) = delete;

  // What is marched, over `time`; lives no longer than this.
  [[nodiscard]] MarchedFlow marched();
  // Collective. A disturbance of temperatures, velocities and, towards the mean gas, of mass fractions, of a few waves
  // a domain and without any symmetry.
  [[nodiscard]] std::vector<double> start();

  [[nodiscard]] double step() const { return dt_; }  // s

 private:
  // Takes the values of a field, `width` for each cell, face or domain, and whether they are of cells.
  using Take = std::function<void(const std::string& name, std::span<double> values, int width, bool ofCells)>;
  class Unknowns;

  void forEachUnknown(bool loading, const Take& take);
  [[nodiscard]] std::vector<double> gathered();
  void begin();  // what a step begins with has been changed
  void advance(double dt);
  void settle();
  void march(std::vector<double>& values);
  // Of each component of a field, over the domain: what is a large change of it.
  [[nodiscard]] std::vector<double> rangesOf(const std::string& name, std::span<const double> values, int width) const;

  FlowCase case_;
  FlowDomain domain_;
  StateBackup base_;
  double time_, slow_, dt_ = 0.0;
  int steps_ = 1;
};

}  // namespace lampblack::app
