// What a deck with `problem: flame1d` asks for, checked and in SI: the bridge from the words of the deck to the
// one-dimensional flames.
#pragma once

#include <mpi.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/problems/flame/flame_stochastic_deck.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "coupling/carried_particles.hpp"
#include "flow/flame/flame_continuation.hpp"
#include "flow/flame/flame_problem.hpp"
#include "flow/flame/flame_solver.hpp"
#include "flow/flame/initial_flame.hpp"
#include "flow/flame/unsteady_flame.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

class PreparedRun;

// The flame in time, from its steady state or from the earlier flame as it is; strain as 1 + amplitude sin(2 pi f t).
struct FlameUnsteady {
  UnsteadyOptions options;
  std::optional<double> interval;  // s, between outputs; a hundredth of the time if not given
  double amplitude = 0, frequency = 0;
  bool fromInitial = false;
};

struct FlameCase {
  std::string title;
  std::shared_ptr<const Mechanism> mechanism;
  FlameProblem problem;
  FlameSolverOptions solver;
  InitialFlameOptions start;
  std::optional<NamedFlameProfile> initial;  // an earlier flame to start from
  std::unique_ptr<CarriedParticles> soot;    // null: none
  double sootAtLimit = 1;                    // the part of it in the last section that is a failure
  std::optional<StochasticRequest> stochastic;
  std::optional<FlameContinuationOptions> continuation;
  std::optional<FlameUnsteady> unsteady;
  std::vector<std::size_t> sensitivities;  // reactions, of the speed

  [[nodiscard]] std::vector<std::string> scalarNames() const;  // of the soot
};

// All keys a flame deck may have.
DeckSchema flameSchema();

// Reads mechanism, temperature profile and earlier flame, and checks what the schema cannot. InputError otherwise.
FlameCase readFlameCase(const Deck& deck);

// "free", "burner", "wall", "counterflow".
const char* nameOf(FlameType type);

// Collective; see Problem. Prepared is the first guess. A run whose flame does not converge throws NumericsError;
// results.h5.part then holds its last grid and profile, from which another run can start.
std::unique_ptr<PreparedRun> prepareFlame(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
