#include "app/deck/other_names.hpp"

namespace lampblack::app {

OtherNames otherNamesOfKeysAndChoices() {
  return {// keys of a gas
          {"mole_fractions", "composition"},
          {"X", "composition"},
          {"reactants", "composition"},
          {"composition", "mole_fractions"},
          {"Y", "mass_fractions"},
          {"phi", "equivalence_ratio"},
          {"T", "temperature"},
          {"p", "pressure"},
          {"P", "pressure"},
          {"gas", "charge"},
          // reactors
          {"psr", "stirred"},
          {"cstr", "stirred"},
          {"pfr", "plug_flow"},
          {"IdealGasReactor", "constant_volume"},
          {"IdealGasConstPressureReactor", "constant_pressure"},
          {"ConstPressureReactor", "constant_pressure"},
          // flames
          {"diffusion", "counterflow"},
          {"premixed", "free"},
          {"freeflame", "free"},
          {"stagnation", "wall"},
          // streams of a flow
          {"mass_flow", "velocity"},
          {"mass_flow_rate", "velocity"},
          {"mass_flux", "velocity"},
          {"volume_flow", "velocity"},
          {"flow_rate", "velocity"},
          {"U", "velocity"},
          // models of turbulence
          {"laminar", "none"},
          {"k-omega-sst", "sst"},
          {"kEpsilon", "k_epsilon"},
          {"kOmegaSST", "sst"},
          {"kOmega", "k_omega"},
          {"SpalartAllmaras", "sa"},
          // geometries
          {"2d", "planar"},
          {"cartesian", "planar"},
          {"cylindrical", "axisymmetric"},
          {"3d", "space"}};
}

}  // namespace lampblack::app
