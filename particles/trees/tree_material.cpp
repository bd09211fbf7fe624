#include "particles/trees/tree_material.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

// Mole fraction of a precursor below which nothing is born or grows to speak of.
constexpr double negligiblePrecursor = 1e-15;

void requireTree(bool isMet, const std::string& what) {
  if (!isMet) throw InputError("particles: " + what);
}

void requireSites(const TreeMaterial& m, const SiteReactions& r) {
  requireTree(r.site < m.components.size() && r.bridge < m.components.size() && r.site != r.bridge,
              "sites and bridges need to be two components of the material");
  requireTree(m.volume(r.nucleus) > 0, "a nucleus needs mass");
  for (const double units : r.nucleus)
    requireTree(units >= 0, "a nucleus may not have less than nothing of a component");
  requireTree(m.volume(r.growth) >= 0, "a surface reaction may not take mass from a particle");
  requireTree(r.nucleusPrecursors > 0 && r.nucleusProducts >= 0 && r.growthProducts >= 0,
              "molecules of the precursor need to be more than none, those of the product none or more");
  requireTree(r.moleculeMass > 0 && r.moleculeDiameter > 0, "molecules of the precursor need a mass and a diameter");
  requireTree(r.prefactor >= 0 && r.energy >= 0, "the rate constant of the surface reaction may not be below zero");
}

}  // namespace

double SiteReactions::inceptionKernel(const CollisionKernel& coagulation, double density) const {
  const CollisionKernel::Properties molecule{moleculeMass / density, moleculeMass, moleculeDiameter};
  if (!freeMolecularInception) return coagulation.value(molecule, molecule);
  const double T = coagulation.options().gas.temperature;
  return 4 * std::sqrt(constants::pi * constants::boltzmann * T / moleculeMass) * moleculeDiameter * moleculeDiameter;
}

double SiteReactions::growthRate(double temperature, double concentration) const {
  const double arrhenius = energy == 0 ? 1 : std::exp(-energy / (constants::gasConstant * temperature));
  return prefactor * (power == 0 ? 1 : std::pow(temperature, power)) * arrhenius * std::max(concentration, 0.0);
}

std::vector<std::string> TreeMaterial::species() const {
  if (const SiteReactions* r = sites()) return {r->precursor, r->product};
  if (isGiven()) return {};
  return sootSpecies(soot()->soot);
}

std::vector<std::string> TreeMaterial::precursors() const {
  if (const SiteReactions* r = sites()) return {r->precursor};
  if (isGiven()) return {};
  return sootPrecursors(soot()->soot);
}

bool TreeMaterial::hasPrecursors(const ParticleGas& gas) const {
  if (isGiven()) return false;
  if (soot() != nullptr) return particles::hasPrecursors(gas);
  return gas.concentrations[0] > negligiblePrecursor * gas.pressure / (constants::gasConstant * gas.temperature);
}

double TreeMaterial::volumeOfSite() const {
  TreeUnits site{};
  site[sites()->site] = 1;
  site[sites()->bridge] = -0.5;
  return volume(site);
}

void requireMaterial(const TreeMaterial& m) {
  requireTree(!m.components.empty() && m.components.size() <= mostTreeComponents,
              fmt::format("a material has 1 to {} components, not {}", mostTreeComponents, m.components.size()));
  for (const TreeComponent& c : m.components)
    requireTree(c.weight > 0,
                fmt::format("the component {} needs a mass above zero, not {:g} kg/mol", c.name, c.weight));
  requireTree(m.density > 0 && std::isfinite(m.density), "the density needs to be above zero");
  requireTree(m.fractalDimension >= 1 && m.fractalDimension <= 3, "the fractal dimension needs to be in [1, 3]");
  requireTree(m.smoothing >= 0 && m.smoothing <= 2, "the smoothing factor needs to be in [0, 2]");
  const SinteringLaw& law = m.sintering;
  requireTree(law.prefactor >= 0 && law.temperature >= 0 && law.critical >= 0,
              "constants of sintering may not be below zero");
  requireTree(!law.active() || law.prefactor > 0, "sintering needs a prefactor above zero");
  if (const SiteReactions* r = m.sites()) requireSites(m, *r);
  if (const SootReactions* r = m.soot()) {
    requireTree(
        r->fragmentation.factor >= 0 && std::isfinite(r->fragmentation.factor) && r->fragmentation.fractalDimension > 0,
        "the factor of fragmentation may not be below zero, its fractal dimension needs to be above");
    requireTree(m.density == r->soot.sootDensity && m.components.size() == 2 &&
                    m.components[SootReactions::carbon].weight == r->soot.carbonWeight &&
                    m.components[SootReactions::hydrogen].weight == r->soot.hydrogenWeight,
                "soot has the density and the weights of its processes");
  }
}

TreeMaterial silica() {
  TreeMaterial m;
  m.name = "silica";
  m.density = 2200;
  m.fractalDimension = 1.8;
  m.components = {{"Si", 28.08e-3, {{"Si", 1}}}, {"O", 16.00e-3, {{"O", 1}}}, {"OH", 17.01e-3, {{"O", 1}, {"H", 1}}}};
  m.sintering = {SinteringMechanism::viscousFlow, 1.1e-16, 1.2e5, 4.4e-9};
  SiteReactions r;
  r.precursor = "H4O4SI";
  r.product = "H2O";
  r.nucleus = {2, 1, 6};
  r.moleculeMass = 9.981e-26;
  r.moleculeDiameter = 0.32e-9;
  r.site = 2;
  r.bridge = 1;
  r.growth = {1, 1, 2};
  r.prefactor = 1e7;
  m.reactions = r;
  return m;
}

TreeMaterial sootMaterial(const SootReactions& reactions) {
  TreeMaterial m;
  m.name = "soot";
  m.density = reactions.soot.sootDensity;
  m.fractalDimension = 1.8;
  m.components = {{"C", reactions.soot.carbonWeight, {{"C", 1}}}, {"H", reactions.soot.hydrogenWeight, {{"H", 1}}}};
  m.reactions = reactions;
  return m;
}

TreeMaterial givenMaterial(double density) {
  TreeMaterial m;
  m.name = "spheres";
  m.density = density;
  m.fractalDimension = 1.8;
  constexpr double unit = 1e-27;  // m3
  m.components = {{"volume", density * constants::avogadro * unit, {}}};
  m.reactions = GivenReactions{};
  return m;
}

}  // namespace lampblack::particles
