// What a deck with `problem: reactor` asks for, checked and in SI: the bridge from the words of the deck to the
// reactors.
#pragma once

#include <mpi.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/deck/ensemble_deck.hpp"
#include "app/deck/population_deck.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/stiff_integrator.hpp"
#include "chemistry/reactor/temperature_profile.hpp"
#include "core/modules.hpp"
#include "coupling/reactor_particles.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

class PreparedRun;

struct ReactorOutput {
  std::optional<double> interval;    // s (plug flow: m) between rows; every step otherwise
  std::vector<std::size_t> species;  // whose fractions are written
  bool massFractions = false;
};

// Stochastic populations: repeats of the reactor with one each, whose random numbers have an owner each.
struct ReactorPopulations : PopulationRequest {
  bool predicted = false;  // coupled by predictor and corrector, or by splitting
};

class ReactorKind;

// What every kind of reactor may have.
struct ReactorCase {
  std::string title;
  std::shared_ptr<const Mechanism> mechanism;
  std::shared_ptr<const ReactorKind> kind;  // and what that kind has (reactor_kind.hpp)
  StiffIntegrator::Options integrator;
  ReactorOutput output;
  std::optional<TemperatureProfile> profile;  // a given temperature of a closed reactor or a plug flow
  // Particles that the gas carries and exchanges with; null: none. The second looks at the first.
  std::shared_ptr<CarriedParticles> soot;
  std::shared_ptr<ReactorParticles> particles;
  std::optional<ReactorPopulations> ensemble;  // in place of these
  double couplingChange = 0;                   // SplitReactor::Options::change
  double sootAtLimit = 1;  // largest volume fraction in the model's largest particles, over the largest of all
};

// All keys a reactor deck may have.
DeckSchema reactorSchema();

// Reads the mechanism and checks what the schema cannot. InputError otherwise.
ReactorCase readReactorCase(const Deck& deck);

// Collective; see Problem. A reactor has one cell: rank 0 computes, the others wait.
std::unique_ptr<PreparedRun> prepareReactor(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
