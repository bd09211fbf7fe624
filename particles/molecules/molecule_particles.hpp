// Particles whose matter are molecules, as a type of particles (particle_type.hpp): trees of primaries, each of which
// holds its molecules; or spheres, whose molecules are all in one. A particle shares its molecules with its copies, and
// each molecule with those who hold it, until they change.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/molecules/molecule_sticking.hpp"
#include "particles/pah/molecule.hpp"
#include "particles/population/model/particle_type.hpp"
#include "particles/trees/primary_trees.hpp"
#include "particles/trees/tree_sintering.hpp"

namespace lampblack::particles {

using HeldMolecule = std::shared_ptr<const Molecule>;
using MoleculesOfPrimary = std::vector<HeldMolecule>;
using MoleculesOfParticle = std::vector<MoleculesOfPrimary>;

struct MoleculeParticle {
  Tree tree;                                          // components carbon and hydrogen
  std::shared_ptr<const MoleculesOfParticle> inside;  // in the order of the tree's primaries
  double collision = 0;                               // m
  std::uint32_t molecules = 0;
  std::uint32_t mostRings = 0, mostCarbon = 0;  // of its largest molecule, by carbon

  [[nodiscard]] double carbon() const { return tree.head().units[0]; }
  [[nodiscard]] double hydrogen() const { return tree.head().units[1]; }
};

class MoleculeParticles {
 public:
  using Particle = MoleculeParticle;
  static constexpr bool moreThanVolume = true;

  MoleculeParticles(const TreeMaterial& material, const MoleculeSticking& sticking, bool spheres)
      : trees_(material, CollisionSize::volumeToSurface),
        sticking_(std::make_shared<MoleculeSticking>(sticking)),
        spheres_(spheres) {}

  [[nodiscard]] const PrimaryTrees& trees() const { return trees_; }
  // K, of the gas in which molecules meet, for this and its copies.
  void setTemperature(double temperature) { sticking_->setTemperature(temperature); }

  [[nodiscard]] double volume(const Particle& p) const { return p.tree.head().volume; }
  [[nodiscard]] double mass(const Particle& p) const { return trees_.mass(p.tree); }
  [[nodiscard]] double surface(const Particle& p) const { return p.tree.head().surface; }
  [[nodiscard]] double collisionDiameter(const Particle& p) const { return p.collision; }
  [[nodiscard]] double fractalDimension() const { return trees_.fractalDimension(); }
  // Two particles of several molecules always stick.
  [[nodiscard]] double sticking(const Particle& p, const Particle& q) const {
    if (p.molecules > 1 && q.molecules > 1) return 1;
    return sticking_->probability(partner(p), partner(q));
  }

  // One primary of these.
  [[nodiscard]] Particle made(MoleculesOfPrimary molecules) const;
  // Methods ask for it where a volume is all they know, which no process here does.
  [[nodiscard]] Particle make(double volume) const;
  [[nodiscard]] Particle coagulated(Particle&& p, Particle&& q, RandomStream& random) const;

  // Other molecules in its primaries: sizes and necks follow.
  void set(Particle& p, MoleculesOfParticle inside) const;
  // After primaries of the tree have fused.
  void fuse(Particle& p, const std::vector<FusedPrimaries>& fusions) const;
  // What follows from tree and molecules.
  void measure(Particle& p) const;

 private:
  [[nodiscard]] static MoleculeSticking::Partner partner(const Particle& p) {
    return {static_cast<double>(p.mostRings), static_cast<double>(p.mostCarbon)};
  }
  PrimaryTrees trees_;
  std::shared_ptr<MoleculeSticking> sticking_;
  bool spheres_;
};

// Atoms of all of them.
[[nodiscard]] TreeUnits unitsOf(const MoleculesOfPrimary& molecules);

}  // namespace lampblack::particles
