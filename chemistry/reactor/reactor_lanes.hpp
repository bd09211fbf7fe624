// Many adiabatic reactors of constant pressure at once, one a vector lane: rates, Jacobian, factors of one sparse
// pattern and steps of RODAS3 with the vector instructions of BatchKinetics. A lane that has arrived takes the next
// reactor, so that reactors of few and of many steps share lanes without waiting for one another. A reactor's result
// depends on its own input alone, to the last bit, not on its place nor on the others; it agrees with
// ReactorRosenbrock's to round-off.
//
// What lanes cannot do is left to the scalar method: a matrix that wants pivoting, a state on the way that has no
// rates, a temperature at which rates cannot be formed from products (batch_kinetics_kernel.hpp).
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "chemistry/kinetics/batch_kinetics.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class ReactorLanes {
 public:
  struct Reactor {
    double pressure = 0, heating = 0;    // Pa, W/kg
    double rateFactor = 1;               // on the rates of the reactions
    double duration = 0, firstStep = 0;  // s; 0: the whole duration
    std::span<double> state;             // (Y, T): in, and out where it has arrived
    std::span<const double> source;      // 1/s; may be empty

    enum class Outcome { Arrived, TooManySteps, Left } outcome = Outcome::Left;  // Left: to the scalar method
    int steps = 0, rejected = 0;
    double nextStep = 0;  // s, what the error of the last step asks of the next
  };
  // As of RosenbrockSolver::Tolerance; the smallest temperature is 1 K.
  struct Tolerance {
    double relative = 0, absolute = 0;
    int maximumSteps = 0;  // those rejected among them
  };

  // Whether a mechanism's rates have derivatives in lanes (BatchJacobianTables).
  static bool covers(const Mechanism& mechanism);

  // std::logic_error for a mechanism that is not covered; InputError for instructions that are not available.
  // `leastFraction` as of ReactorSystem.
  ReactorLanes(const Mechanism& mechanism, double leastFraction,
               BatchKinetics::Instructions instructions = BatchKinetics::best());
  ~ReactorLanes();
  ReactorLanes(ReactorLanes&&) noexcept;
  ReactorLanes& operator=(ReactorLanes&&) noexcept;

  // The largest |dY_k/dt| of the chemistry alone in each state, 1/s; NaN where it has no rates.
  void largestChemicalRates(std::span<const Reactor> reactors, std::span<double> largest);

  void advance(std::span<Reactor> reactors, const Tolerance& tolerance);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lampblack::chemistry
