// The former name of SpeciesThermo.
#pragma once

#include "chemistry/species_thermo.hpp"

namespace lampblack {
using Nasa7Table = SpeciesThermo;
}
