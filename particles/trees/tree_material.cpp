#include "particles/trees/tree_material.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

void requireTree(bool isMet, const std::string& what) {
  if (!isMet) throw InputError("particles: " + what);
}

}  // namespace

double TreeMaterial::unitMass(std::size_t component) const {
  return components[component].weight / constants::avogadro;
}

double TreeMaterial::growthVolume() const {
  return volume(growth);
}

double TreeMaterial::growthRate(double temperature, double concentration) const {
  const double arrhenius = energy == 0 ? 1 : std::exp(-energy / (constants::gasConstant * temperature));
  return prefactor * (power == 0 ? 1 : std::pow(temperature, power)) * arrhenius * std::max(concentration, 0.0);
}

void requireMaterial(const TreeMaterial& m) {
  requireTree(!m.components.empty() && m.components.size() <= mostTreeComponents,
              fmt::format("a material has 1 to {} components, not {}", mostTreeComponents, m.components.size()));
  for (const TreeComponent& c : m.components)
    requireTree(c.weight > 0,
                fmt::format("the component {} needs a mass above zero, not {:g} kg/mol", c.name, c.weight));
  requireTree(m.density > 0 && std::isfinite(m.density), "the density needs to be above zero");
  requireTree(m.fractalDimension >= 1 && m.fractalDimension <= 3, "the fractal dimension needs to be in [1, 3]");
  requireTree(m.site < m.components.size() && m.bridge < m.components.size(),
              "sites and bridges need to be components of the material");
  requireTree(m.volume(m.nucleus) > 0, "a nucleus needs mass");
  for (const double units : m.nucleus)
    requireTree(units >= 0, "a nucleus may not have less than nothing of a component");
  requireTree(m.moleculeMass > 0 && m.moleculeDiameter > 0, "molecules of the precursor need a mass and a diameter");
  requireTree(m.prefactor >= 0, "the rate constant of the surface reaction may not be below zero");
  requireTree(m.smoothing >= 0 && m.smoothing <= 2, "the smoothing factor needs to be in [0, 2]");
  const SinteringLaw& law = m.sintering;
  requireTree(law.prefactor >= 0 && law.temperature >= 0 && law.critical >= 0,
              "constants of sintering may not be below zero");
  requireTree(!law.active() || law.prefactor > 0, "sintering needs a prefactor above zero");
}

TreeMaterial silica() {
  TreeMaterial m;
  m.name = "silica";
  m.density = 2200;
  m.fractalDimension = 1.8;
  m.components = {{"Si", 28.08e-3, {{"Si", 1}}}, {"O", 16.00e-3, {{"O", 1}}}, {"OH", 17.01e-3, {{"O", 1}, {"H", 1}}}};
  m.precursor = "H4O4SI";
  m.product = "H2O";
  m.nucleus = {2, 1, 6};
  m.moleculeMass = 9.981e-26;
  m.moleculeDiameter = 0.32e-9;
  m.site = 2;
  m.bridge = 1;
  m.growth = {1, 1, 2};
  m.prefactor = 1e7;
  m.sintering = {SinteringMechanism::viscousFlow, 1.1e-16, 1.2e5, 4.4e-9};
  return m;
}

}  // namespace lampblack::particles
