#include "particles/molecules/molecule_particles.hpp"

#include <iterator>
#include <stdexcept>

#include "particles/trees/tree_rounding.hpp"

namespace lampblack::particles {

TreeUnits unitsOf(const MoleculesOfPrimary& molecules) {
  TreeUnits units{};
  for (const HeldMolecule& m : molecules) {
    units[0] += static_cast<double>(m->carbon());
    units[1] += static_cast<double>(m->hydrogen());
  }
  return units;
}

MoleculeParticle MoleculeParticles::made(MoleculesOfPrimary molecules) const {
  MoleculeParticle p;
  p.tree = trees_.make(unitsOf(molecules));
  p.tree.own().time = trees_.clock();
  p.inside = std::make_shared<const MoleculesOfParticle>(1, std::move(molecules));
  measure(p);
  return p;
}

MoleculeParticle MoleculeParticles::make(double) const {
  throw std::logic_error("MoleculeParticles: a volume does not say which molecules");
}

MoleculeParticle MoleculeParticles::coagulated(MoleculeParticle&& p, MoleculeParticle&& q, RandomStream& random) const {
  if (spheres_) {
    MoleculesOfPrimary all = p.inside->front();
    all.insert(all.end(), q.inside->front().begin(), q.inside->front().end());
    return made(std::move(all));
  }
  // The smaller tree's primaries stand behind, as PrimaryTrees::coagulated() has them.
  if (p.tree.count() < q.tree.count()) std::swap(p, q);
  MoleculesOfParticle inside = *p.inside;
  inside.insert(inside.end(), q.inside->begin(), q.inside->end());
  MoleculeParticle joined;
  joined.tree = trees_.coagulated(std::move(p.tree), std::move(q.tree), random);
  joined.inside = std::make_shared<const MoleculesOfParticle>(std::move(inside));
  measure(joined);
  return joined;
}

void MoleculeParticles::set(MoleculeParticle& p, MoleculesOfParticle inside) const {
  TreeHead& tree = p.tree.own();
  TreePrimary* primaries = primariesOf(&tree);
  std::vector<double> change(tree.count);
  for (std::size_t i = 0; i < tree.count; ++i) {
    const double before = trees_.material().volume(primaries[i].units);
    primaries[i].units = unitsOf(inside[i]);
    change[i] = trees_.material().volume(primaries[i].units) - before;
  }
  roundTree(trees_, tree, change, 1);
  p.inside = std::make_shared<const MoleculesOfParticle>(std::move(inside));
  measure(p);
}

void MoleculeParticles::fuse(MoleculeParticle& p, const std::vector<FusedPrimaries>& fusions) const {
  if (!fusions.empty()) {
    MoleculesOfParticle inside = *p.inside;
    const auto at = [&](std::uint32_t i) { return inside.begin() + static_cast<std::ptrdiff_t>(i); };
    for (const FusedPrimaries& f : fusions) {  // as fuseNeck() has it
      inside[f.left].insert(inside[f.left].end(), inside[f.right].begin(), inside[f.right].end());
      std::rotate(at(f.first), at(f.neck + 1), at(f.right));
      inside.erase(at(f.right));
    }
    p.inside = std::make_shared<const MoleculesOfParticle>(std::move(inside));
  }
  measure(p);
}

void MoleculeParticles::measure(MoleculeParticle& p) const {
  p.molecules = p.mostRings = p.mostCarbon = 0;
  for (const MoleculesOfPrimary& primary : *p.inside) {
    p.molecules += static_cast<std::uint32_t>(primary.size());
    for (const HeldMolecule& m : primary)
      if (m->carbon() > p.mostCarbon) {
        p.mostCarbon = static_cast<std::uint32_t>(m->carbon());
        p.mostRings = static_cast<std::uint32_t>(m->rings());
      }
  }
  p.collision = std::max(p.tree.head().collision, moleculeDiameter(p.mostCarbon));
}

}  // namespace lampblack::particles
