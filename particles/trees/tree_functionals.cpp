#include "particles/trees/tree_functionals.hpp"

#include <algorithm>
#include <utility>

#include "core/constants.hpp"
#include "particles/soot/soot_aggregate.hpp"
#include "particles/trees/tree_shape.hpp"

namespace lampblack::particles {
namespace {

using Use = ParticleFunctional::Use;

}  // namespace

TreeFunctionals::TreeFunctionals(const TreeMaterial& material)
    : all_{{{"collision_diameter", "m", "diameter of collision"}, Use::size, true},
           {{"sphere_diameter", "m", "diameter of the sphere of the particle's volume"}, Use::size},
           {{"mobility_diameter", "m", "diameter of mobility, that of soot's aggregates"}, Use::size},
           {{"primaries", "1", "primary particles in a particle"}, Use::plain, true},
           {{"primary_diameter", "m", "mean diameter of the particle's primaries"}},
           {{"sintering_level", "1", "mean sintering level of the particle; of one primary 1"}, Use::share}} {
  std::vector<std::string> elements;
  for (const TreeComponent& component : material.components)
    for (const auto& [element, atoms] : component.elements)
      if (std::find(elements.begin(), elements.end(), element) == elements.end()) elements.push_back(element);
  if (elements.size() < 2) return;
  if (material.soot() != nullptr) std::swap(elements[0], elements[1]);  // soot may have no hydrogen
  all_.push_back({{elements[0] + "_to_" + elements[1], "1",
                   "atoms of " + elements[0] + " over those of " + elements[1] + " in the particle"},
                  Use::share});
  for (const TreeComponent& component : material.components) {
    const auto atomsOf = [&](const std::string& wanted) {
      double sum = 0;
      for (const auto& [element, atoms] : component.elements)
        if (element == wanted) sum += atoms;
      return sum;
    };
    first_.push_back(atomsOf(elements[0]));
    second_.push_back(atomsOf(elements[1]));
  }
}

double TreeFunctionals::of(const TreeHead& tree, std::size_t which) const {
  switch (which) {
    case collisionDiameter:
      return tree.collision;
    case sphereDiameter:
      return treeDiameter(tree.volume);
    case mobilityDiameter: {
      const double ratio = tree.surface / treeSphere(tree.volume);
      return 6 * tree.volume / tree.surface * SootAggregate::mobilityFactor(ratio * ratio * ratio);
    }
    case primaries:
      return primariesOfTree(tree);
    case primaryDiameter:
      return meanPrimaryDiameter(tree);
    case sinteringLevel:
      return meanSinteringLevel(tree);
    default:
      break;
  }
  double first = 0, second = 0;
  for (std::size_t c = 0; c < first_.size(); ++c) {
    first += first_[c] * tree.units[c];
    second += second_[c] * tree.units[c];
  }
  return first / second;
}

}  // namespace lampblack::particles
