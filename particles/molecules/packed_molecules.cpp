#include "particles/molecules/packed_molecules.hpp"

#include <cmath>

#include "core/errors.hpp"
#include "core/packed_doubles.hpp"
#include "particles/trees/packed_tree.hpp"
#include "particles/trees/tree_options.hpp"
#include "particles/trees/tree_shape.hpp"

namespace lampblack::particles {
namespace {

constexpr std::size_t fixedLength = sizeof(MoleculeRow) / sizeof(double);
// A cell as one number; molecules of Molecule::mostSites are smaller than half of it.
constexpr double rowOfCells = 131072;

void packCells(const std::vector<LatticeCell>& cells, std::vector<double>& to) {
  to.push_back(static_cast<double>(cells.size()));
  for (const LatticeCell& c : cells) to.push_back(c.q * rowOfCells + c.r);
}
std::vector<LatticeCell> nextCells(PackedDoubles& state) {
  std::vector<LatticeCell> cells(state.nextCount());
  for (LatticeCell& c : cells) {
    const double packed = state.next(), q = std::round(packed / rowOfCells);
    if (!(std::abs(packed) < rowOfCells * rowOfCells)) throw InputError("particles: the saved molecules are damaged");
    c = {static_cast<std::int32_t>(q), static_cast<std::int32_t>(packed - q * rowOfCells)};
  }
  return cells;
}

MoleculeRow rowOf(const MoleculeParticle& p, double number, const MoleculeParticles& type) {
  const TreeHead& tree = p.tree.head();
  const TreeMaterial& m = type.trees().material();
  const double ratio = std::max(1.0, tree.surface / treeSphere(tree.volume));
  double rings = 0;
  for (const MoleculesOfPrimary& primary : *p.inside)
    for (const HeldMolecule& molecule : primary) rings += static_cast<double>(molecule->rings());
  const auto mass = [&](std::size_t c) { return tree.units[c] * m.components[c].weight / constants::avogadro; };
  return {{mass(0), mass(1), ratio * ratio * ratio, number},
          0,
          static_cast<double>(p.molecules),
          static_cast<double>(p.mostRings),
          static_cast<double>(p.mostCarbon),
          p.collision,
          rings};
}

}  // namespace

MoleculeRow MoleculeRow::of(const double* row) {
  return PackedDoubles({row, fixedLength}).next<MoleculeRow>();
}
TreeHead MoleculeRow::treeOf(const double* row) {
  return headOfPackedTree(row + fixedLength);
}

void packFixedPart(const MoleculeParticle& p, double number, const MoleculeParticles& type, std::vector<double>& to) {
  packDoubles(to, rowOf(p, number, type));
  packSums(p.tree, number, type.trees().material(), to);
}

void packParticle(const MoleculeParticle& p, double number, const MoleculeParticles& type, std::vector<double>& to) {
  const std::size_t begin = to.size();
  packDoubles(to, rowOf(p, number, type));
  packTree(p.tree, number, type.trees().material(), to);
  for (const MoleculesOfPrimary& primary : *p.inside) {
    to.push_back(static_cast<double>(primary.size()));
    for (const HeldMolecule& molecule : primary) {
      packCells(molecule->cells(false), to);
      packCells(molecule->cells(true), to);
    }
  }
  to[begin + packedParticle] = static_cast<double>(to.size() - begin);
}

MoleculeParticle unpackParticle(std::span<const double> row, const MoleculeParticles& type, const HeldMolecule& known) {
  MoleculeParticle p;
  PackedDoubles state(row);
  state.next<MoleculeRow>();
  const double* tree = row.data() + fixedLength;
  p.tree = unpackTree(row.subspan(fixedLength), type.trees().pool(), type.trees().material());
  state.nextRow(treeRows.lengthOf(tree));
  MoleculesOfParticle inside(p.tree.count());
  const std::vector<LatticeCell> usual = known->cells(false);
  for (MoleculesOfPrimary& primary : inside) {
    primary.resize(state.nextCount());
    for (HeldMolecule& molecule : primary) {
      const std::vector<LatticeCell> six = nextCells(state), five = nextCells(state);
      molecule = five.empty() && six == usual ? known : std::make_shared<const Molecule>(six, five);
    }
  }
  p.inside = std::make_shared<const MoleculesOfParticle>(std::move(inside));
  type.measure(p);
  return p;
}

}  // namespace lampblack::particles
