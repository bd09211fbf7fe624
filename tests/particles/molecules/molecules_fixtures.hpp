// What the tests of particles of molecules share: a gas, options, what is to hold of a particle.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "particles/molecules/molecule_population.hpp"
#include "particles/pah/named_molecules.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/pah/pah_fixtures.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::test {

// That of the reference numbers, with so much of the molecules (mole fraction).
struct MoleculeGas : FlameGas {
  explicit MoleculeGas(double molecules = 0, double temperature = 1500, double OH = 0, double O2 = 0)
      : FlameGas(temperature, 0.01, 0.1, OH, 0, O2, 0.1, {molecules}) {}
  [[nodiscard]] double number() const { return constants::avogadro * concentrations.back(); }  // of molecules, 1/m3
};

// Of pyrene, single molecules to which nothing happens but what their edges do.
inline MoleculeOptions singlePyrene() {
  MoleculeOptions o;
  o.precursor = "A4";
  o.rings = namedMolecule("pyrene");
  o.inception = MoleculeOptions::Inception::none;
  o.rates = particles::test::referenceConstants();
  o.coagulation = false;
  o.particles = 500;
  o.atStart = 1e18;
  return o;
}
inline MoleculeOptions inert(MoleculeOptions o) {
  o.active.fill(false);
  return o;
}
inline MoleculeOptions onlyProcess(MoleculeOptions o, PahProcess process) {
  o.active.fill(false);
  o.active[static_cast<std::size_t>(process)] = true;
  return o;
}

// That its primaries are those of its molecules, and its sums those of its primaries.
inline void expectParticle(const MoleculeParticles& type, const MoleculeParticle& p) {
  ASSERT_EQ(p.inside->size(), p.tree.count());
  TreeUnits sum{};
  std::size_t molecules = 0;
  for (std::size_t i = 0; i < p.inside->size(); ++i) {
    const TreeUnits units = unitsOf((*p.inside)[i]);
    EXPECT_EQ(p.tree.primaries()[i].units, units);
    EXPECT_DOUBLE_EQ(p.tree.primaries()[i].diameter, treeDiameter(type.trees().material().volume(units)));
    for (std::size_t c = 0; c < 2; ++c) sum[c] += units[c];
    molecules += (*p.inside)[i].size();
    EXPECT_GT((*p.inside)[i].size(), 0u);
  }
  EXPECT_EQ(p.molecules, molecules);
  EXPECT_DOUBLE_EQ(p.carbon(), sum[0]);
  EXPECT_DOUBLE_EQ(p.hydrogen(), sum[1]);
  EXPECT_GE(p.collision, p.tree.head().collision);
}

}  // namespace lampblack::test
