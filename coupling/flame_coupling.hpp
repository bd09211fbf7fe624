// Two-way coupling of a stochastic population of any kind and a one-dimensional flame, by iteration: the flame in its
// steady state, the population along its paths, what it exchanges with the gas back into the flame, and so on until
// nothing changes by more than a tolerance or the noise of the repeats.
//
// The flame may carry a simple model of the particles as well, the transfer model. Its exchange S_t with the gas is
// solved with the gas; what is iterated is the difference between the population's exchange and the transfer model's
// own,
//   E <- (1 - w) E + w (S - S_t),
// so that the gas sees the population's exchange in the end, whatever the transfer model says, but answers at once
// where the exchange depends on the gas: with the dimer model PAH are consumed by the same law in both, and E has no
// part in it. Without a transfer model S_t is zero.
#pragma once

#include <mpi.h>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "coupling/flame_ensemble.hpp"
#include "flow/flame/flame_solver.hpp"
#include "flow/flame/given_exchange.hpp"
#include "flow/models/carried_model.hpp"
#include "particles/models/element_enthalpies.hpp"

namespace lampblack::coupling {

// What particles exchange with the gas at the points of a flame.
struct FlameExchange {
  std::vector<double> z;           // m
  std::vector<double> species;     // production, kg/m3/s, point-major
  std::vector<double> elements;    // gained by the particles, kg/m3/s of each of theirs, point-major
  std::vector<double> absorption;  // 1/m

  FlameExchange(std::vector<double> points, std::size_t species, std::size_t elements);
};

// Of the population, of which `kind` is one, along its paths. The points of a path are those of the flame, in order,
// but for the last one where particles stagnate. A point gets half of the intervals on both sides: finite volumes
// around points see the sum.
[[nodiscard]] FlameExchange exchangeOf(const Mechanism& mechanism, const StochasticPopulation& kind,
                                       const FlameProfile& profile, const std::vector<FlameEnsemblePath>& paths);

// Of the transfer model at the points of the same flame, whose gas is `gas`; `elements`: of the population.
[[nodiscard]] FlameExchange exchangeOfTransfer(const Mechanism& mechanism, CarriedModel& transfer,
                                               std::span<const std::string> elements, const FlameProfile& profile,
                                               const GasOfFlame& gas);

// (1 - w) `old` + w (population - transfer), at the points of the profile: what the flame is given besides its transfer
// model. With the elements goes their enthalpy.
[[nodiscard]] GivenExchange relaxed(const GivenExchange& old, const FlameProfile& profile,
                                    std::span<const ElementEnthalpy> enthalpies, const FlameExchange& population,
                                    const FlameExchange& transfer, double w);

struct FlameCouplingOptions {
  FlameEnsembleOptions ensemble;
  std::size_t iterations = 10;
  double relaxation = 0.7;  // w
  double tolerance = 0.01;  // of the changes below
};

// Changes from one iteration to the next, relative to the largest value in the flame.
struct FlameCouplingStep {
  std::size_t points = 0;
  double volumeFraction = 0;  // the largest
  double noise = 0;           // standard error of the volume fraction where it is largest, relative
  double volumeFractionChange = 0, temperatureChange = 0, speciesChange = 0;  // of watchedSpecies()
  // kg/m2/s of each element: what the exchange takes from the gas along the path, and with what the particles leave.
  std::vector<double> taken, leaving;
  double seconds = 0;
};

struct FlameCoupling {
  FlameSolution solution;
  std::vector<FlameEnsemblePath> paths;
  std::vector<FlameCouplingStep> steps;
  bool converged = false;
};

// Collective. `solver` solves the flame with `transfer` (may be null); `start` is its solution without any exchange.
// InputError for particles of elements whose heat is not known (elementEnthalpies()); FlameFailure as of the solver;
// `converged` is false where the iteration does not converge.
[[nodiscard]] FlameCoupling coupleFlame(MPI_Comm comm, const Mechanism& mechanism, double pressure, FlameSolver& solver,
                                        CarriedModel* transfer, FlameSolution start,
                                        const FlameCouplingOptions& options,
                                        const std::function<void(const FlameCouplingStep&)>& report = {});

}  // namespace lampblack::coupling
