// Gases of flames: the mechanisms of cases/ and streams of them.
#pragma once

#include <string>
#include <string_view>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_problem.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::flow {

inline Mechanism shippedMechanism(const std::string& file) {
  return Mechanism::fromFile(test::sourcePath("cases/mechanisms/" + file));
}

// A mixture by moles, with a mass flux (kg/m2/s).
inline FlameStream streamOf(const Mechanism& mechanism, std::string_view moles, double temperature, double massFlux) {
  FlameStream stream{temperature, std::vector<double>(mechanism.numSpecies()), massFlux};
  Thermo(mechanism).moleToMass(parseComposition(mechanism, moles), stream.Y);
  return stream;
}

// With a speed (m/s).
inline FlameStream streamAt(const Mechanism& mechanism, std::string_view moles, double temperature, double speed,
                            double pressure = 101325) {
  FlameStream stream = streamOf(mechanism, moles, temperature, 0);
  stream.massFlux = speed * Thermo(mechanism).density(temperature, pressure, stream.Y);
  return stream;
}

}  // namespace lampblack::flow
