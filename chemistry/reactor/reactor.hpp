// One stiff integration a cell: a constant-pressure adiabatic reactor with detailed kinetics and an optional constant
// source of species, advanced by a few steps of a Rosenbrock method or, where those do not do, by CVODE's BDF method
// (SUNDIALS), both with the analytic Jacobian; one cell, or many at once. The result depends on the inputs alone, bit
// for bit, never on what the object did before; one object per thread or rank.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class ConstantPressureReactor {
 public:
  struct Options {
    double relativeTolerance = 1e-6;
    double absoluteTolerance = 1e-12;  // of a mass fraction
    int maxSteps = 20000;              // of CVODE
    // A cell is skipped, i.e. advanced by one explicit trapezoid, if its chemistry changes no mass fraction by more
    // than this over the interval, at the rates of its start and of its end, and those differ so little that the error
    // of the trapezoid is below absoluteTolerance. Zero never skips.
    double negligibleChange = 1e-10;
    // Steps, rejected ones among them, in which the Rosenbrock method has to arrive; cells that need more go to CVODE.
    // Zero: CVODE alone. In lanes, where a step costs a fifth, laneSteps times as many.
    int rosenbrockSteps = 10;
    static constexpr int laneSteps = 4;
    double belowZero = 100.0;  // of absoluteTolerance: how far rates follow a mass fraction
    // A mass fraction below this counts as this in the rates (ReactorSystem). Errors of the tolerance's size stay in
    // the range where rates are smooth.
    [[nodiscard]] double leastFraction() const { return -belowZero * absoluteTolerance; }
  };

  struct Cell {
    double temperature = 0;  // K, in and out
    double pressure = 0;     // Pa
    std::span<double>
        Y;  // mass fractions, in and out; small negative values (of the order of the tolerance) may come back
    std::span<const double>
        source;  // dY_k/dt added to the chemistry, 1/s, sums to zero but for round-off; may be empty
    // s, first step of the Rosenbrock method, 0 for the whole interval; returns what it asks of the next interval.
    // CVODE is used at once where it is too short.
    double initialStep = 0;
    double heating = 0;     // W/kg, at which the mixture's enthalpy rises
    double rateFactor = 1;  // on the rates of the reactions
  };

  struct Result {
    int steps = 0;
    int rhsEvaluations = 0;
    int jacobianEvaluations = 0;
    int retries = 0;          // of CVODE
    bool skipped = false;     // advanced by an explicit step
    bool handedOver = false;  // to CVODE
    double seconds = 0;       // wall clock of the call
    // What was counted, in about microseconds of one processor: by the numbers of rate evaluations and steps of each
    // kind and of the species, the same on every machine and in every run, which seconds are not.
    double work = 0;
  };

  enum class Method { Rosenbrock, Bdf };

  // What an observer is told: that an attempt begins, of each of its steps, how it ended.
  struct Event {
    enum class Kind { Attempt, Step, Failed, Done };
    Kind kind = Kind::Attempt;
    int attempt = 0;  // from 1
    Method method = Method::Bdf;
    // Of an attempt.
    double relativeTolerance = 0, absoluteTolerance = 0, firstStep = 0;
    int maxSteps = 0, parts = 0;
    // Of a step; the time counts from the beginning of the interval.
    double time = 0, stepSize = 0, temperature = 0;
    int order = 0;
    std::string reason;  // of a failure
  };
  using Observer = std::function<void(const Event&)>;

  ConstantPressureReactor(const Mechanism& mechanism, const Options& options);
  explicit ConstantPressureReactor(const Mechanism& mechanism) : ConstantPressureReactor(mechanism, Options{}) {}
  ~ConstantPressureReactor();
  ConstantPressureReactor(ConstantPressureReactor&&) noexcept;
  ConstantPressureReactor& operator=(ConstantPressureReactor&&) noexcept;

  // Advances the cell by dt seconds. The mixture's enthalpy (J/kg, with formation) changes by the heating alone: the
  // source carries the enthalpy that keeps it. On return the temperature belongs to that enthalpy to round-off and the
  // sum of Y is that of the start to about 1e-15. Throws ReactorFailure (reactor_failure.hpp), with the cell unchanged,
  // if the input is not a gas or the integration fails also with a small first step, tighter tolerances, more steps and
  // a divided interval; the message has T, p, dt, the composition and the solver's reason. An observer changes nothing
  // but the time it takes.
  Result advance(Cell& cell, double dt, const Observer& observer = {});

  // The same for many cells, several times faster: most go through vector lanes (ReactorLanes). A cell's result, its
  // seconds excepted, depends on that cell alone, to the last bit, and agrees with the other advance()'s to round-off.
  // Of several cells that fail, the first is reported, with its place (ReactorFailure); cells before it may have been
  // advanced.
  void advance(std::span<Cell> cells, double dt, std::span<Result> results);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lampblack::chemistry
