// How fast a premixed gas burns, to begin with: an estimate of the mass flux of its free flame from the mechanism.
#pragma once

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_problem.hpp"

namespace lampblack::flow {

// lambda/cp of combustion gases, kg/m/s (Smooke, Giovangigli 1991): good enough for
// the thickness of a guess.
[[nodiscard]] double conductivityOverCp(double T);

// The mass flux of a free flame, kg/m2/s, from a diffusivity and a chemical time, m^2 = rho (lambda/cp) / t (Mallard,
// Le Chatelier 1883; Williams 1985, section 5.1), where t is the residence time at which a
// perfectly stirred reactor of the gas blows out, and rho and lambda/cp are those of the gas there. `burnt`: of the
// equilibrium, K. Within a factor of two of flames of methane and ethylene; of hydrogen up to five
// too slow where it is hot and ten too fast where it is lean. Where no reactor burns, a power law.
[[nodiscard]] double burningRate(const Mechanism& mechanism, const FlameStream& stream, double pressure, double burnt);

}  // namespace lampblack::flow
