// What a deck with `problem: prescribed_gas` asks for: a path through a given gas, and the particles on it. Ensembles
// that leave the gas as it is and models are marched along the path; trees, and ensembles that deplete it, are coupled
// with it as with the gas of a reactor.
#pragma once

#include <mpi.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/deck/population_deck.hpp"
#include "app/problems/reactor/reactor_case.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/gas/gas_path.hpp"
#include "particles/models/particle_model.hpp"

namespace lampblack::app {

class PreparedRun;

struct PrescribedGasCase {
  std::string title;
  std::shared_ptr<const Mechanism> mechanism;
  std::optional<ReactorCase> coupled;  // then nothing of the following

  ParticlePath path;
  std::vector<std::size_t> recorded;  // points of the path with a row
  std::optional<PopulationRequest> ensemble;
  std::unique_ptr<ParticleModel> model;  // where there is no ensemble
  std::vector<std::size_t> depleted;     // of the model's species
  double sootAtLimit = 1;                // as ReactorCase
};

// All keys such a deck may have.
DeckSchema prescribedGasSchema();

// Reads mechanism, gas and particles. InputError, pointing into the deck.
PrescribedGasCase readPrescribedGasCase(const Deck& deck);

// Collective; see Problem. Repeats of an ensemble are spread over the ranks; a model runs on the first.
std::unique_ptr<PreparedRun> preparePrescribedGas(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
