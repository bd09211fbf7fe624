// Transport properties of a gas at one state by the model the user chose, for `lampblack gas`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/transport/collision_integrals.hpp"
#include "core/modules.hpp"

namespace lampblack::app {

struct GasTransportChoice {
  enum class Model { MixtureAveraged, Multicomponent, UnityLewis };
  Model model = Model::MixtureAveraged;
  CollisionIntegrals integrals = CollisionIntegrals::MonchickMason;
};

struct GasTransport {
  GasTransportChoice choice;
  double viscosity = 0;                         // Pa s
  double thermalConductivity = 0;               // W/m/K
  std::vector<double> mixtureDiffusion;         // m2/s, of mass fluxes by gradients of mole fractions, in every model
  std::vector<double> thermalDiffusion;         // kg/m/s; empty with unity Lewis numbers, which have none
  std::vector<double> multicomponentDiffusion;  // m2/s, [k][j]; of the multicomponent model alone
};

// "mixture-averaged", "multicomponent", "unity-lewis" and back; "monchick-mason", "wang". InputError with the nearest
// known name.
GasTransportChoice::Model transportModel(const std::string& name);
std::string transportModelName(GasTransportChoice::Model model);
CollisionIntegrals collisionIntegrals(const std::string& name);

// At T (K), p (Pa) and mole fractions X. InputError if a species has no transport data, NumericsError outside the range
// of temperature of the model.
GasTransport gasTransport(const Mechanism& mechanism, double T, double p, std::span<const double> X,
                          const GasTransportChoice& choice);

}  // namespace lampblack::app
