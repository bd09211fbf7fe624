// Ensembles in the flame that was solved, or coupled with it both ways;
// in results.h5 under /stochastic, in the record of the run and on the console.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "app/problems/flame/flame_stochastic_deck.hpp"
#include "core/modules.hpp"
#include "coupling/flame_coupling.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

struct StochasticFlame {
  std::vector<FlameEnsemblePath> paths;
  std::vector<FlameCouplingStep> steps;  // two-way
  bool converged = true;
};

// Collective. `solver` solved the flame with `carried` (may be null); coupled both ways, `solution` becomes that of the
// last iteration, after which the solver goes on with its exchange. FlameFailure, NumericsError.
[[nodiscard]] StochasticFlame runStochasticFlame(MPI_Comm comm, const Mechanism& mechanism, double pressure,
                                                 FlameSolver& solver, CarriedModel* carried, FlameSolution& solution,
                                                 const StochasticRequest& request);

// Collective.
void writeStochasticFlame(ResultsWriter& results, const StochasticRequest& request, const StochasticFlame& flame);
void recordStochasticFlame(JsonWriter& json, const StochasticFlame& flame);
std::string stochasticFlameReport(const StochasticFlame& flame);

}  // namespace lampblack::app
