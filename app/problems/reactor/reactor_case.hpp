// What a deck with `problem: reactor` asks for, checked and in SI: the bridge from the words of the deck to the
// reactors.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/deck/ensemble_deck.hpp"
#include "app/deck/population_deck.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/closed_reactor.hpp"
#include "chemistry/reactor/ignition.hpp"
#include "chemistry/reactor/network_solver.hpp"
#include "chemistry/reactor/reactor_network.hpp"
#include "chemistry/reactor/stiff_integrator.hpp"
#include "core/modules.hpp"
#include "coupling/given_gas.hpp"
#include "coupling/reactor_particles.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

// Kinds of reactors. GivenGas: the history of the gas is prescribed (problem: prescribed_gas).
enum class ReactorType { ConstantPressure, ConstantVolume, GivenVolume, Stirred, PlugFlow, Network, GivenGas };

struct ReactorOutput {
  std::optional<double> interval;    // s (plug flow: m) between rows; every step otherwise
  std::vector<std::size_t> species;  // whose fractions are written
  bool massFractions = false;
};

// Stochastic populations: repeats of the reactor with one each, whose random numbers have an owner each.
struct ReactorPopulations : PopulationRequest {
  bool predicted = false;  // coupled by predictor and corrector, or by splitting
};

struct ReactorCase {
  std::string title;
  std::shared_ptr<const Mechanism> mechanism;
  ReactorType type = ReactorType::ConstantPressure;
  StiffIntegrator::Options integrator;
  ReactorOutput output;
  std::optional<TemperatureProfile> profile;  // a given temperature of a closed reactor or a plug flow
  // Particles that the gas carries and exchanges with; null: none. The second looks at the first.
  std::shared_ptr<CarriedParticles> soot;
  std::shared_ptr<ReactorParticles> particles;
  std::optional<ReactorPopulations> ensemble;  // in place of these
  double couplingChange = 0;                   // SplitReactor::Options::change
  double sootAtLimit = 1;  // largest volume fraction in the model's largest particles, over the largest of all

  // Closed reactors.
  GasState initial;
  std::optional<VolumeLaw> volume;
  std::optional<double> startAngle, angularSpeed;  // rad after top dead centre, rad/s, of a piston
  double ignitionFrom = 0;                         // s, what delays count from
  double end = 0.0;                                // s; stirred: of a transient, 0 where the steady state is wanted
  std::vector<IgnitionCriterion> ignition;
  std::vector<std::size_t> sensitivities;  // reactions

  // A given gas: what particles deplete of it, and the times of rows.
  std::shared_ptr<const GasHistory> history;
  std::vector<std::size_t> depleted;
  std::vector<double> rows;  // s, rising

  // Plug flow. With a stirred reactor before the duct, `inlet` is what flows into that one; populations have
  // `upstreamTime` (s) in it.
  std::optional<ReactorNetwork> upstream;
  double upstreamTime = 0;
  GasState inlet;
  double massFlux = 0.0, length = 0.0;  // kg/m2/s, m

  // Stirred reactors.
  ReactorNetwork network;
  NetworkStart start;
};

// All keys a reactor deck may have.
DeckSchema reactorSchema();

// Reads the mechanism and checks what the schema cannot. InputError otherwise.
ReactorCase readReactorCase(const Deck& deck);

}  // namespace lampblack::app
