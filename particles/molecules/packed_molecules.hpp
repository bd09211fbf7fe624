// A particle of molecules as a row of a packed population (particles/stochastic/particle_rows.hpp): what moves it and
// how large it is, the row's length, what it says of its molecules; the row of its tree; the rings of its molecules.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/molecules/molecule_particles.hpp"
#include "particles/stochastic/particle_rows.hpp"

namespace lampblack::particles {

// Of its fixed part.
struct MoleculeRow {
  GivenParticle particle;
  double length = 0, molecules = 0, mostRings = 0, mostCarbon = 0, collision = 0, rings = 0;
  [[nodiscard]] static MoleculeRow of(const double* row);
  // Behind it: the tree, of which the fixed part belongs to this one's too.
  [[nodiscard]] static TreeHead treeOf(const double* row);
};

// Adds the row of a particle that stands for `number` (1/m3); or its fixed part alone.
void packParticle(const MoleculeParticle& p, double number, const MoleculeParticles& type, std::vector<double>& to);
void packFixedPart(const MoleculeParticle& p, double number, const MoleculeParticles& type, std::vector<double>& to);
// The particle of a row; molecules that are equal to `known` are held with it. InputError for what packParticle() did
// not write.
[[nodiscard]] MoleculeParticle unpackParticle(std::span<const double> row, const MoleculeParticles& type,
                                              const HeldMolecule& known);

}  // namespace lampblack::particles
