#include "flow/field_registry.hpp"

#include <algorithm>
#include <array>

namespace lampblack::flow {
namespace {

using Kind = FieldDeclaration::Kind;
using Width = FieldDeclaration::Width;

// In the order in which results and messages have them.
const std::array registry{
    FieldDeclaration{.name = "temperature",
                     .unit = "K",
                     .description = "gas temperature",
                     .kind = Kind::Intensive,
                     .width = Width::One,
                     .values = &State::temperature,
                     .archived = "temperature",
                     .isInHalo = true,
                     .isAveraged = true,
                     .isWritten = true,
                     .isChecked = true,
                     .isWatched = true},
    FieldDeclaration{.name = "density",
                     .unit = "kg/m^3",
                     .description = "gas density",
                     .kind = Kind::PerVolume,
                     .width = Width::One,
                     .values = &State::density,
                     .start = &State::Start::density,
                     .archived = "density",
                     .isInHalo = true,
                     .isAveraged = true,
                     .isWritten = true,
                     .isChecked = true},
    FieldDeclaration{.name = "velocity",
                     .unit = "m/s",
                     .description = "gas velocity along the mesh's axes",
                     .kind = Kind::Intensive,
                     .width = Width::Dimension,
                     .values = &State::velocity,
                     .archived = "velocity",
                     .isInHalo = true,
                     .isAveraged = true,
                     .isWritten = true,
                     .isChecked = true,
                     .isWatched = true},
    FieldDeclaration{.name = "pressure",
                     .unit = "Pa",
                     .description = "hydrodynamic pressure",
                     .kind = Kind::Intensive,
                     .width = Width::One,
                     .values = &State::pressure,
                     .archived = "pressure",
                     .isInHalo = true,
                     .isWritten = true,
                     .isChecked = true},
    FieldDeclaration{.name = "swirl_velocity",
                     .unit = "m/s",
                     .description = "gas velocity about the axis",
                     .kind = Kind::Intensive,
                     .width = Width::Swirl,
                     .values = &State::swirl,
                     .archived = "swirl",
                     .isInHalo = true,
                     .isAveraged = true,
                     .isWritten = true,
                     .isChecked = true,
                     .isWatched = true},
    FieldDeclaration{.name = "enthalpy",
                     .unit = "J/kg",
                     .description = "gas enthalpy, formation included",
                     .kind = Kind::Intensive,
                     .width = Width::One,
                     .values = &State::enthalpy,
                     .start = &State::Start::enthalpy,
                     .archived = "enthalpy",
                     .isInHalo = true,
                     .isChecked = true},
    // Results have mole fractions, of the species that a deck names.
    FieldDeclaration{.name = "mass_fraction",
                     .unit = "1",
                     .description = "mass fractions of the gas",
                     .kind = Kind::Intensive,
                     .width = Width::Species,
                     .values = &State::Y,
                     .start = &State::Start::Y,
                     .archived = "Y",
                     .isInHalo = true,
                     .isAveraged = true,
                     .isChecked = true,
                     .isWatched = true},
    // Written by their owners, with what they make of them.
    FieldDeclaration{.name = "carried_scalar",
                     .unit = "",
                     .description = "carried scalars, per volume",
                     .kind = Kind::PerVolume,
                     .width = Width::Carried,
                     .values = &State::carried,
                     .archived = "carried",
                     .isInHalo = true,
                     .isAveraged = true,
                     .isChecked = true,
                     .isWatched = true},
    FieldDeclaration{.name = "carried_diffusivity",
                     .unit = "m^2/s",
                     .description = "diffusivities of the carried scalars",
                     .kind = Kind::Intensive,
                     .width = Width::Carried,
                     .values = &State::carriedDiffusivity,
                     .archived = "carried_diffusivity",
                     .isInHalo = true},
    FieldDeclaration{.name = "eddy_viscosity",
                     .unit = "Pa s",
                     .description = "dynamic viscosity by turbulence, beside that of the molecules",
                     .kind = Kind::Intensive,
                     .width = Width::Eddies,
                     .values = &State::eddyViscosity,
                     .archived = "eddy_viscosity",
                     .isInHalo = true,
                     .isWritten = true,
                     .isChecked = true},
    FieldDeclaration{.name = "mass_flux",
                     .unit = "kg/s",
                     .description = "of the gas through each face, per radian or metre of depth",
                     .kind = Kind::FaceFlux,
                     .width = Width::One,
                     .values = &State::massFlux,
                     .archived = "mass_flux",
                     .isAveraged = true,
                     .isChecked = true},
    FieldDeclaration{.name = "reaction_rate",
                     .unit = "kg/m^3/s",
                     .description = "of the species by reactions, as transport takes them",
                     .kind = Kind::Rate,
                     .width = Width::Species,
                     .rates = &State::Balance::reactions,
                     .archived = "reaction_rates"},
    FieldDeclaration{.name = "heating",
                     .unit = "W/m^3",
                     .description = "of the gas by operators, as transport takes it",
                     .kind = Kind::Rate,
                     .width = Width::One,
                     .rates = &State::Balance::enthalpy},
    FieldDeclaration{.name = "carried_rate",
                     .unit = "",
                     .description = "of the carried scalars by their owners, as transport takes them",
                     .kind = Kind::Rate,
                     .width = Width::Carried,
                     .rates = &State::Balance::carried},
    FieldDeclaration{.name = "carried_sink",
                     .unit = "1/s",
                     .description = "of the carried scalars by their owners, in proportion to what there is",
                     .kind = Kind::Rate,
                     .width = Width::Carried,
                     .rates = &State::Balance::carriedSink},
};

}  // namespace

std::span<const FieldDeclaration> fieldRegistry() {
  return registry;
}

int FieldDeclaration::widthIn(const State& state) const {
  switch (width) {
    case Width::One:
      return 1;
    case Width::Dimension:
      return state.dimension;
    case Width::Species:
      return state.species;
    case Width::Carried:
      return state.carriedCount();
    case Width::Swirl:
      return state.swirls ? 1 : 0;
    case Width::Eddies:
      return state.hasEddies ? 1 : 0;
  }
  return 0;
}

int FieldDeclaration::countIn(const Mesh& mesh) const {
  return kind == Kind::FaceFlux ? mesh.faces : kind == Kind::Rate ? mesh.owned : mesh.cells;
}

std::string FieldDeclaration::nameOf(int component, const State& state, const Mechanism& mechanism) const {
  const auto i = static_cast<std::size_t>(component);
  if (values == &State::carried) return state.scalars[i].name;
  std::string words = name;
  std::ranges::replace(words, '_', ' ');
  if (width == Width::Species) words += " of " + mechanism.speciesName(i);
  if (width == Width::Carried) words += " of " + state.scalars[i].name;
  return words;
}

}  // namespace lampblack::flow
