// A cell whose chemistry could not be advanced, with all that is needed to try again.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "chemistry/reactor/reactor.hpp"
#include "core/errors.hpp"
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
  ConstantPressureReactor::Options options;
  std::string reason;
};

class ReactorFailure : public NumericsError {
 public:
  ReactorFailure(const std::string& message, FailedCell cell, std::size_t place)
      : NumericsError(message), cell_(std::move(cell)), place_(place) {}
  const FailedCell& cell() const { return cell_; }
  std::size_t place() const { return place_; }  // among the cells that were advanced together

 private:
  FailedCell cell_;
  std::size_t place_;
};

}  // namespace lampblack::chemistry
