// What a deck with `problem: engine` asks for: an engine, its charge, what happens to the gas between the closing of
// the inlet and the opening of the exhaust, how many particles and repeats, and what is written.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/deck/checkpoint_deck.hpp"
#include "app/deck/population_deck.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/engine/engine_cylinder.hpp"
#include "chemistry/reactor/slider_crank.hpp"
#include "core/modules.hpp"
#include "coupling/carried_particles.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {

class PreparedRun;

struct EngineCase {
  std::string title;
  std::shared_ptr<const Mechanism> mechanism;
  SliderCrank crank;
  double speed = 0;                                     // 1/s, turns
  double start = 0, end = 0;                            // deg, from the upper dead centre
  double temperature = 0, pressure = 0;                 // K, Pa, at the start
  double temperatureDeviation = 0, ratioDeviation = 0;  // K; 1, of the particles at the start
  std::vector<double> fresh;                            // mass fractions
  std::vector<double> fuel, oxidizer;                   // mole fractions, where the charge is given by them
  double ratio = 0;                                     // equivalence ratio of the fresh charge
  double exhaust = 0;                                   // part of the charge that is burnt gas, by mole or by mass
  bool isExhaustByMole = false;
  double exhaustFrozen = 1000;  // K, at which the burnt gas is in equilibrium
  double residual = 0;          // part by mass that stays of the cycle before
  std::size_t mostCycles = 1;
  double angleTolerance = 0, temperatureTolerance = 0;  // deg of CA50, K at the start
  EngineOptions options;                                // but the repeat
  std::optional<double> headArea, pistonArea;           // m2; those of the bore
  std::size_t particles = 100;
  std::uint64_t repeats = 1;
  double step = 0;                   // deg
  double every = 0;                  // deg, between rows
  std::vector<double> particlesAt;   // deg
  std::vector<std::size_t> species;  // of the history, the particles and the emissions
  CheckpointTimes checkpoints;
  std::shared_ptr<CarriedParticles> soot;       // that each particle of gas carries; null: nothing
  double sootAtLimit = 1;                       // largest part of its volume in the largest particles of the model
  std::optional<PopulationRequest> population;  // along the mean gas

  [[nodiscard]] double timeOf(double angle) const { return (angle - start) / (360 * speed); }
  [[nodiscard]] std::vector<double> angles() const;  // of the rows
};

// Fuel as a deck describes it.
struct EngineSpray {
  std::string fuel;
  EngineTable rate;                          // kg/s
  double temperature = 300, latentHeat = 0;  // K, J/kg, of the liquid
  double dilution = 5;                       // kg of gas a kg of fuel
  std::optional<std::size_t> mostParticles;
};

// All keys such a deck may have; those that an EngineCase is filled by, with angles and speeds in SI; those of the
// section injection.
DeckSchema engineSchema();
DeckKeys<EngineCase> engineKeys();
DeckKeys<EngineSpray> engineSprayKeys();

// The laws of heat transfer by their names in decks.
using NamedHeatLaw = std::pair<std::string, EngineHeatLaw>;
const std::vector<NamedHeatLaw>& engineHeatLaws();

// Collective only in warnings; InputError, pointing into the deck.
EngineCase readEngineCase(const Deck& deck);

// Collective; see Problem. Several repeats are spread over the ranks; of one the ranks share the reactions.
std::unique_ptr<PreparedRun> prepareEngine(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
