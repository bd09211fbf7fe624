// What a deck with `problem: reactor` asks for, checked and in SI: the bridge from the words of the deck to the
// reactors.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "chemistry/closed_reactor.hpp"
#include "chemistry/ignition.hpp"
#include "chemistry/mechanism.hpp"
#include "chemistry/stiff_integrator.hpp"
#include "io/deck.hpp"

namespace lampblack {

enum class ReactorType { ConstantPressure, ConstantVolume };

struct ReactorOutput {
  std::optional<double> interval;    // s (plug flow: m) between rows; every step otherwise
  std::vector<std::size_t> species;  // whose fractions are written
  bool massFractions = false;
};

struct ReactorCase {
  std::string title;
  std::shared_ptr<const Mechanism> mechanism;
  ReactorType type = ReactorType::ConstantPressure;
  GasState initial;
  std::optional<TemperatureProfile> profile;  // a given temperature
  double end = 0.0;                           // s
  StiffIntegrator::Options integrator;
  ReactorOutput output;
  std::vector<IgnitionCriterion> ignition;
  std::vector<std::size_t> sensitivities;  // reactions
};

// All keys a reactor deck may have.
DeckSchema reactorSchema();

// Reads the mechanism and checks what the schema cannot. InputError otherwise.
ReactorCase readReactorCase(const Deck& deck);

}  // namespace lampblack
