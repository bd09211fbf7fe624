#include "coupling/cell_trees.hpp"

#include <utility>

#include "core/constants.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/trees/packed_tree.hpp"

namespace lampblack::coupling {

CellTrees::CellTrees(const Mechanism& mechanism, const TreeOptions& options)
    : CellTrees(mechanism, options, ReactorTrees(mechanism, options, GasViscosity::transport, {})) {}

CellTrees::CellTrees(const Mechanism& mechanism, const TreeOptions& options, ReactorTrees trees)
    : CellParticles(options.material.name, trees.elements(), mechanism, trees.species(),
                    {SootAggregate(options.material.density, false), treeRows}),
      options_(options),
      trees_(std::move(trees)),
      before_(elements().size()) {
  for (const std::string& element : elements()) {
    TreeUnits& mass = elementMass_.emplace_back();
    for (std::size_t c = 0; c < options.material.components.size(); ++c)
      for (const auto& [name, atoms] : options.material.components[c].elements)
        if (name == element)
          mass[c] += atoms * mechanism.atomicWeight(mechanism.elementIndex(element)) / constants::avogadro;
  }
  blank_ = pack();
}

void CellTrees::addElements(const TreeUnits& units, double number, std::span<double> elements) const {
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (std::size_t c = 0; c < units.size(); ++c) elements[e] += number * units[c] * elementMass_[e][c];
}

void CellTrees::addContent(std::span<double> elements) const {
  trees_.population().forEachTree(
      [&](const Tree& tree, double number) { addElements(tree.head().units, number, elements); });
}

void CellTrees::addAmounts(const double* row, double number, std::span<double> amounts) const {
  const AmountPlaces at = this->amounts();
  const PackedTreeSums tree = sumsOfPackedTree(row);
  const GivenParticle particle = particleAt(row);
  const SootAggregate& type = sizes().type;
  amounts[AmountPlaces::number] += number;
  addElements(tree.units, number, amounts.subspan(at.element(0), elements().size()));
  const bool isBySurface = options_.shape == TreeShape::surfaceVolume;
  amounts[at.primaries()] += number * (isBySurface ? particle.primaries : tree.count);
  amounts[at.surface()] += number * tree.surface;
  amounts[at.diameters()] += number * type.mobilityDiameter(type.make(particle.carbon, 0.0, particle.primaries));
}

double CellTrees::absorption(double temperature, double volumeFraction) const {
  return options_.material.soot() != nullptr ? sootAbsorption(temperature, volumeFraction) : 0.0;
}

bool CellTrees::hasPrecursors(const ParticleGas& gas) const {
  return trees_.canBeBorn(gas);
}

void CellTrees::unpack(std::span<const double> population) {
  trees_.population().unpack(population);
  before_.assign(elements().size(), 0.0);
  addContent(before_);
}

void CellTrees::join(std::span<const double> rows) {
  this->rows().forEach(
      rows, [&](const double* row) { addElements(sumsOfPackedTree(row).units, row[packedNumberAt], before_); });
  trees_.population().join(rows, 1.0);
}

CellParticles::Change CellTrees::advance(const ParticleGas& gas, double dt) {
  // What waits to sinter does so before the exchange is looked at, and before particles move on.
  SplitParticles::Exchange exchange = trees_.advanceAndApplyDeferred(gas, dt);
  Change change{std::move(exchange.gas), std::move(exchange.elements), std::vector<double>(elements().size())};
  addContent(change.resampled);
  for (std::size_t e = 0; e < before_.size(); ++e) change.resampled[e] -= before_[e] + change.elements[e];
  return change;
}

std::vector<double> CellTrees::packed(std::span<const TreeStart> starts, std::uint64_t cell) const {
  TreeOptions own = options_;
  own.owner = cell;
  const auto population = makeTreePopulation(own);
  population->fill(starts);
  return population->pack();
}

}  // namespace lampblack::coupling
