#include "flow/state.hpp"

#include <algorithm>
#include <utility>

namespace lampblack::flow {

State::State(const Mesh& mesh, std::size_t speciesCount, std::vector<CarriedScalar> carriedScalars, bool turns)
    : species(static_cast<int>(speciesCount)),
      dimension(mesh.dimension),
      swirls(turns),
      scalars(std::move(carriedScalars)) {
  const auto cells = static_cast<std::size_t>(mesh.cells);
  velocity.assign(static_cast<std::size_t>(dimension) * cells, 0.0);
  if (swirls) swirl.assign(cells, 0.0);
  pressure.assign(cells, 0.0);
  temperature.assign(cells, 0.0);
  density.assign(cells, 0.0);
  enthalpy.assign(cells, 0.0);
  Y.assign(cells * speciesCount, 0.0);
  carried.assign(cells * scalars.size(), 0.0);
  carriedDiffusivity.assign(cells * scalars.size(), 0.0);
  const auto owned = static_cast<std::size_t>(mesh.owned);
  balance = {std::vector<double>(owned * speciesCount),
             {},
             {},
             std::vector<double>(owned),
             std::vector<double>(owned * scalars.size())};
  massFlux.assign(static_cast<std::size_t>(mesh.faces), 0.0);
}

void State::Balance::ofSpecies(std::size_t cell, std::span<double> rate) const {
  std::copy_n(&reactions[cell * rate.size()], rate.size(), rate.begin());
  const std::size_t n = exchangedSpecies.size();
  for (std::size_t i = 0; i < n; ++i) rate[exchangedSpecies[i]] += exchanged[cell * n + i];
}

void State::Balance::exchange(std::size_t cell, std::size_t species, double rate) {
  auto place = std::find(exchangedSpecies.begin(), exchangedSpecies.end(), species);
  if (place == exchangedSpecies.end()) {
    const std::size_t n = exchangedSpecies.size(), cells = enthalpy.size();
    std::vector<double> wider((n + 1) * cells, 0.0);
    for (std::size_t c = 0; c < cells; ++c) std::copy_n(exchanged.data() + c * n, n, &wider[c * (n + 1)]);
    exchanged = std::move(wider);
    exchangedSpecies.push_back(species);
    place = exchangedSpecies.end() - 1;
  }
  exchanged[cell * exchangedSpecies.size() + static_cast<std::size_t>(place - exchangedSpecies.begin())] += rate;
}

void State::Balance::clear() {
  for (std::vector<double>* rates : {&exchanged, &enthalpy, &carried}) std::fill(rates->begin(), rates->end(), 0.0);
}

void State::keepStart() {
  const auto owned = static_cast<std::ptrdiff_t>(balance.enthalpy.size());
  start.Y = Y;
  start.density.assign(density.begin(), density.begin() + owned);
  start.enthalpy.assign(enthalpy.begin(), enthalpy.begin() + owned);
  start.thermodynamicPressure = thermodynamicPressure;
}

void State::updateHalo(HaloExchange& halo) {
  std::vector<FieldView> fields{{velocity, dimension}, {pressure, 1}, {temperature, 1},
                                {density, 1},          {enthalpy, 1}, {Y, species}};
  if (swirls) fields.push_back({swirl, 1});
  if (!scalars.empty()) {
    fields.push_back({carried, carriedCount()});
    fields.push_back({carriedDiffusivity, carriedCount()});
  }
  halo.update(fields);
}

void State::saveOrLoad(StateArchive& archive) {
  archive.shared("thermodynamic_pressure", thermodynamicPressure);
  archive.cells("velocity", velocity, dimension);
  if (swirls) archive.cells("swirl", swirl, 1);
  archive.cells("pressure", pressure, 1);
  archive.cells("temperature", temperature, 1);
  archive.cells("density", density, 1);
  archive.cells("enthalpy", enthalpy, 1);
  archive.cells("Y", Y, species);
  if (!scalars.empty()) {
    archive.cells("carried", carried, carriedCount());
    archive.cells("carried_diffusivity", carriedDiffusivity, carriedCount());
  }
  archive.faces("mass_flux", massFlux, 1);
  archive.cells("reaction_rates", balance.reactions, species);
}

}  // namespace lampblack::flow
