// What the primaries of a tree are made of and what a gas does to them: a table of components and a few processes, as
// plain data. Silica from silicic acid is one (Shekar, Smith, Kraft, Wagner 2011), soot another; a material whose sites
// react with one precursor is another table of the first kind.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/constants.hpp"
#include "core/modules.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "particles/soot/soot_fragmentation.hpp"
#include "particles/spheres/sintering_law.hpp"

namespace lampblack::particles {

inline constexpr std::size_t mostTreeComponents = 3;
// Numbers of units of each component.
using TreeUnits = std::array<double, mostTreeComponents>;

struct TreeComponent {
  std::string name;
  double weight = 0;                                     // kg/mol
  std::vector<std::pair<std::string, double>> elements;  // atoms of each in a unit
};

// One precursor in the gas, whose molecules make primaries and react with sites on their surface.
struct SiteReactions {
  // Species of the gas: what particles are made from, and what they give back.
  std::string precursor, product;
  // Inception: `nucleusPrecursors` molecules become a primary of `nucleus` and give `nucleusProducts`. Molecules have
  // the mass (kg) and the diameter (m) of the collision kernel.
  TreeUnits nucleus{};
  double nucleusPrecursors = 2, nucleusProducts = 1, moleculeMass = 0, moleculeDiameter = 0;
  // By the free-molecular kernel without enhancement (Shekar, Smith, Kraft, Wagner 2011, eq. 25) in place of that of
  // coagulation.
  bool freeMolecularInception = false;
  // Surface reaction of a molecule with a site, a unit of the component `site`: what the primary gains, and the
  // product; rate constant prefactor T^power exp(-energy/RT) for each site, m3/mol/s and J/mol.
  std::size_t site = 0;
  TreeUnits growth{};
  double growthProducts = 1, prefactor = 0, power = 0, energy = 0;
  // Two sites become one unit of `bridge` and one molecule of the product, by sintering and within a particle. The last
  // process keeps the composition (eq. 59 of Shekar et al. 2011) and may be off.
  std::size_t bridge = 0;
  bool condenses = true;

  // 1/s for each site, at a concentration (mol/m3) of the precursor.
  [[nodiscard]] double growthRate(double temperature, double concentration) const;
  // Two molecules, m3/s; `coagulation`: the kernel of particles in this gas, `density` (kg/m3) that of the material.
  [[nodiscard]] double inceptionKernel(const CollisionKernel& coagulation, double density) const;
};

// Carbon and hydrogen, by the processes that all populations of soot have: nuclei of PAH, condensation of PAH, growth
// by acetylene, oxidation by O2 and OH (SootMedium).
struct SootReactions {
  SootModelOptions soot;
  bool alphaOfPrimaries = false;  // as EnsembleOptions
  bool keepsHydrogen = true;
  // What a primary leaves behind that has burnt away: the parts that it held together go apart, as aggregates that burn
  // were seen to (Neoh, Howard, Sarofim 1985); or all that touched it touches the neighbour it shared most surface
  // with.
  bool breaksUp = true;
  // By attack of the necks: of a tree with as many primaries of 6 V/S as have its surface (equalPrimaries).
  SootFragmentation fragmentation;

  enum Component : std::size_t { carbon, hydrogen };
};

// Nothing of the gas: births and growth are said from outside (TreeGiven).
struct GivenReactions {};

struct TreeMaterial {
  std::string name;
  double density = 0;           // kg/m3
  double fractalDimension = 3;  // of aggregates, for the diameter of collision
  std::vector<TreeComponent> components;
  // How much of the surface that a primary gains by growth its necks gain, 0 to 2 (eq. 30).
  double smoothing = 1;
  SinteringLaw sintering;
  std::variant<SiteReactions, SootReactions, GivenReactions> reactions;

  [[nodiscard]] const SiteReactions* sites() const { return std::get_if<SiteReactions>(&reactions); }
  [[nodiscard]] const SootReactions* soot() const { return std::get_if<SootReactions>(&reactions); }
  [[nodiscard]] bool isGiven() const { return std::holds_alternative<GivenReactions>(reactions); }
  // For who changes a shipped material; throws std::bad_variant_access for another.
  [[nodiscard]] SiteReactions& siteReactions() { return std::get<SiteReactions>(reactions); }

  // Species of the gas by name, in the order in which particles see them.
  [[nodiscard]] std::vector<std::string> species() const;
  // The species that particles are born of.
  [[nodiscard]] std::vector<std::string> precursors() const;
  // Whether a gas, with these species, has what particles are born of, to speak of.
  [[nodiscard]] bool hasPrecursors(const ParticleGas& gas) const;
  // m3 that a site takes along as it becomes half a bridge.
  [[nodiscard]] double volumeOfSite() const;
  [[nodiscard]] double volume(const TreeUnits& units) const {  // m3
    double sum = 0;
    for (std::size_t c = 0; c < components.size(); ++c) sum += units[c] * components[c].weight;
    return sum / (density * constants::avogadro);
  }
};

// Throws InputError for what is not a material: a component without mass, constants below zero, processes that name
// components that are not there or make particles of nothing.
void requireMaterial(const TreeMaterial& material);

// Si, O and OH from Si(OH)4, called H4O4SI (Shekar et al. 2011, eqs. 11, 23, 29, 58; rates of sintering and of the
// surface reaction: what the public code of that group, MOpS, has as input for its tests, not the fitted ones of Shekar
// et al. 2012).
[[nodiscard]] TreeMaterial silica();

// C and H with the density and weights of these options; aggregates of the fractal dimension 1.8, which do not sinter.
[[nodiscard]] TreeMaterial sootMaterial(const SootReactions& reactions);

// Of one component whose unit is a nm3, with GivenReactions: aggregates of the fractal dimension 1.8, which do not
// sinter.
[[nodiscard]] TreeMaterial givenMaterial(double density);

}  // namespace lampblack::particles
