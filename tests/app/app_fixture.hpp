// A small flame whose gas is a formula of the place, on any communicator: what the tests of the app module act on.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/problems/flow/flow_case.hpp"
#include "coupling/carried_particles.hpp"
#include "flow/flow_context.hpp"
#include "flow/models/carried_operator.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"
#include "particles/models/two_equation/dimer_soot.hpp"
#include "tests/every_module.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::test {

// tests/app/flame.yaml with the shipped mechanism.
inline Deck flameDeck(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), "mechanism=" + sourcePath("cases/mechanisms/ethylene_bisetti2012_47.yaml"));
  return Deck::load(sourceFolder / "tests/app/flame.yaml", overrides, flowSchema());
}

// What the deck says of the two-equation model.
inline const SootModelOptions& dimerOptions(const FlowCase& flowCase) {
  const auto& particles = dynamic_cast<const CarriedParticles&>(*flowCase.carried);
  return dynamic_cast<const DimerSoot&>(particles.model()).twoEquation().options();
}

// Temperature and mole fractions ("A2: 1e-5, N2: 1") at a place.
struct Gas {
  double temperature = 300.0;
  std::string composition;
};

struct Flame {
  template <typename GasAt>
  Flame(MPI_Comm comm, const GasAt& gasAt, std::vector<std::string> overrides = {})
      : flowCase(readFlowCase(flameDeck(std::move(overrides)))),
        mesh(comm, flowCase.mesh),
        halo(mesh),
        thermo(*flowCase.mechanism),
        transport(*flowCase.mechanism),
        context{mesh, halo, *flowCase.mechanism, thermo, transport, flowCase.boundaries},
        state(mesh, flowCase.mechanism->numSpecies(),
              {CarriedOperator::blockOf(*flowCase.carried, flowCase.boundaries)}) {
    state.thermodynamicPressure = flowCase.pressure;
    const std::size_t n = flowCase.mechanism->numSpecies();
    for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.cells); ++c) {
      const Gas gas = gasAt(mesh.centre[c]);
      const std::span<double> Y{&state.Y[c * n], n};
      thermo.moleToMass(parseComposition(*flowCase.mechanism, gas.composition), Y);
      state.temperature[c] = gas.temperature;
      state.density[c] = thermo.density(gas.temperature, flowCase.pressure, Y);
      state.enthalpy[c] = thermo.enthalpyMass(gas.temperature, Y);
      // A stagnation flow, against z = 4 mm.
      state.velocity[2 * c] = 50.0 * mesh.centre[c][0];
      state.velocity[2 * c + 1] = -100.0 * (mesh.centre[c][1] - 4e-3);
    }
    properties.update(context, state);
  }
  Flame(const Flame&) = delete;
  Flame& operator=(const Flame&) = delete;

  [[nodiscard]] std::span<const double> massFractions(int cell) const {
    const auto n = static_cast<std::size_t>(state.species);
    return {&state.Y[static_cast<std::size_t>(cell) * n], n};
  }

  FlowCase flowCase;
  Mesh mesh;
  HaloExchange halo;
  Thermo thermo;
  Transport transport;
  FlowContext context;
  State state;
  GasProperties properties;
};

// Rich and hot enough for every part of the soot model, between 1500 and 1900 K.
inline Gas sootingGas(const Vector3& x) {
  return {1500.0 + 400.0 * std::exp(-std::pow((x[1] - 4.5e-3) / 3e-3, 2)) - 2e3 * x[0],
          "C2H2: 0.05, H: 2e-3, H2: 0.05, OH: 1e-4, H2O: 0.1, O2: 1e-4, CO: 0.15, A2: 2e-5, N2: 0.65"};
}

}  // namespace lampblack::test
