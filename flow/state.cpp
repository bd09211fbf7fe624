#include "flow/state.hpp"

#include <algorithm>
#include <stdexcept>

#include "flow/field_registry.hpp"

namespace lampblack::flow {

State::State(const Mesh& mesh, std::size_t speciesCount, const std::vector<ScalarBlock>& carriedBlocks, bool turns)
    : species(static_cast<int>(speciesCount)), dimension(mesh.dimension), swirls(turns) {
  for (const ScalarBlock& block : carriedBlocks) {
    if (std::ranges::find(blocks, block.owner, &ScalarRange::owner) != blocks.end())
      throw std::logic_error("two blocks of carried scalars of " + block.owner);
    blocks.push_back({block.owner, carriedCount(), static_cast<int>(block.scalars.size())});
    if (block.wallLaw != WallLaw::None) {
      wallEnergy = blocks.back().first;
      wallLaw = block.wallLaw;
    }
    scalars.insert(scalars.end(), block.scalars.begin(), block.scalars.end());
    hasEddies = hasEddies || block.givesEddies;
  }
  for (const FieldDeclaration& field : fieldRegistry())
    field.of(*this).assign(
        static_cast<std::size_t>(field.countIn(mesh)) * static_cast<std::size_t>(field.widthIn(*this)), 0.0);
}

const ScalarRange& State::block(const std::string& owner) const {
  const auto found = std::ranges::find(blocks, owner, &ScalarRange::owner);
  if (found == blocks.end()) throw std::logic_error("nothing is carried for " + owner);
  return *found;
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
  for (std::vector<double>* rates : {&exchanged, &enthalpy, &carried, &carriedSink})
    std::fill(rates->begin(), rates->end(), 0.0);
}

void State::keepStart() {
  for (const FieldDeclaration& field : fieldRegistry())
    if (field.start) start.*field.start = field.of(*this);
  start.thermodynamicPressure = thermodynamicPressure;
}

void State::updateHalo(HaloExchange& halo) {
  std::vector<FieldView> fields;
  for (const FieldDeclaration& field : fieldRegistry())
    if (const int width = field.widthIn(*this); field.isInHalo && width > 0) fields.push_back({field.of(*this), width});
  halo.update(fields);
}

void State::saveOrLoad(StateArchive& archive) {
  archive.shared("thermodynamic_pressure", thermodynamicPressure);
  for (const FieldDeclaration& field : fieldRegistry()) {
    const int width = field.widthIn(*this);
    if (!field.archived || width == 0) continue;
    if (field.kind == FieldDeclaration::Kind::FaceFlux)
      archive.faces(field.archived, field.of(*this), width);
    else
      archive.cells(field.archived, field.of(*this), width);
  }
}

}  // namespace lampblack::flow
