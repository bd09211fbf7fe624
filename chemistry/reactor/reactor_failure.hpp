// A cell whose chemistry could not be advanced, with all that is needed to try again.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "chemistry/reactor/reactor.hpp"
#include "core/group_failure.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct FailedCell {
  double temperature = 0;      // K
  double pressure = 0;         // Pa
  double duration = 0;         // s
  double firstStep = 0;        // s, Cell::initialStep
  std::vector<double> Y;       // mass fractions
  std::vector<double> source;  // 1/s; empty where there was none
  double heating = 0;          // W/kg
  double rateFactor = 1;       // Cell::rateFactor
  ConstantPressureReactor::Options options;
  std::string reason;
};

class ReactorFailure : public FailureInGroup {
 public:
  ReactorFailure(const std::string& message, FailedCell cell, std::size_t place)
      : FailureInGroup(message, place), cell_(std::move(cell)) {}
  const FailedCell& cell() const { return cell_; }

 private:
  FailedCell cell_;
};

}  // namespace lampblack::chemistry
