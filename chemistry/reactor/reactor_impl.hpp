// The inside of ConstantPressureReactor, shared by its files alone: one cell (reactor.cpp), many at once
// (reactor_batch.cpp).
#pragma once

#include <chrono>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "chemistry/reactor/reactor.hpp"
#include "chemistry/reactor/reactor_integrator.hpp"
#include "chemistry/reactor/reactor_lanes.hpp"
#include "chemistry/reactor/reactor_rosenbrock.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

// What a cell's work is counted in (Result::work): about microseconds, fitted to mechanisms of 9 and 47 species
// (docs/verification.md, "The mesh on many ranks").
struct CountedWork {
  explicit CountedWork(std::size_t species)
      : cell(0.03 * static_cast<double>(species)),
        rates(0.05 * static_cast<double>(species)),
        bdfRates(0.1 * static_cast<double>(species)),
        laneStep(0.0172 * std::pow(static_cast<double>(species), 1.6)),
        scalarStep(5 * laneStep) {}
  double cell;      // of any cell
  double rates;     // an evaluation that decides whether a cell is skipped
  double bdfRates;  // an evaluation with its part of the steps
  double laneStep, scalarStep;
};

struct ConstantPressureReactor::Impl {
  // How an integration is tried.
  struct Attempt {
    Method method;
    double firstStep;  // s; 0: the method's choice
    double toleranceFactor;
    int maxSteps;
    int parts;
  };
  // What a cell has at the end of the interval, whatever its reactions.
  struct Invariants {
    double sum = 0;       // of the mass fractions
    double enthalpy = 0;  // J/kg
  };

  Impl(const Mechanism& mechanismIn, const Options& optionsIn);

  void checkInput(const Cell& cell, double dt) const;
  void begin(const Cell& cell, double dt);
  void advance(Cell& cell, double dt, const Observer& observer, Result& result);
  static bool isForRosenbrock(double firstStep, double dt, int steps) {
    return steps > 0 && (firstStep <= 0 || firstStep * steps >= dt);
  }
  bool skip(Cell& cell, double dt, Result& result);
  bool attempt(Cell& cell, double dt, const Attempt& attempt, int number, const Observer& observer, Result& result);
  bool integrate(const Cell& cell, double dt, const Attempt& attempt, Event event, const Observer& observer,
                 Result& result);
  void advanceByBdf(Cell& cell, double dt, double firstStep, int number, const Observer& observer, Result& result);
  bool accept(Cell& cell, std::span<double> out);
  [[noreturn]] void throwFailure(const Cell& cell, double dt) const;

  // reactor_batch.cpp
  void beginAll(std::span<const Cell> cells, double dt);
  void advanceInLanes(double dt, std::span<Result> results);
  void finish(Cell& cell, double dt, Result& result);

  const Mechanism& mechanism;
  Options options;
  std::size_t n;  // species
  CountedWork counted;
  ReactorSystem system;
  ReactorRosenbrock rosenbrock;
  ReactorIntegrator bdf;
  std::vector<double> start, predicted, chemical, chemicalEnd;
  Invariants end;
  std::size_t place = 0;  // of the cell among those advanced together
  std::string reason;

  std::optional<ReactorLanes> lanes;  // where the mechanism's rates have derivatives in lanes
  // Of cells that are advanced together.
  std::vector<double> states, largestRates;
  std::vector<Invariants> ends;
  std::vector<ReactorLanes::Reactor> reactors, inLanes;
  std::vector<std::size_t> cellInLane;
};

}  // namespace lampblack::chemistry
