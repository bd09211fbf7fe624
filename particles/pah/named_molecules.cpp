#include "particles/pah/named_molecules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

constexpr LatticeCell centreCell{0, 0};

struct NamedMolecule {
  const char* name;
  std::vector<unsigned> around;  // directions from the middle ring in which there are rings
};

const NamedMolecule smallMolecules[] = {{"benzene", {}},
                                        {"naphthalene", {0}},
                                        {"anthracene", {0, 3}},
                                        {"phenanthrene", {0, 2}},
                                        {"pyrene", {5, 0, 1}},
                                        {"triphenylene", {0, 2, 4}},
                                        {"benzo[ghi]perylene", {1, 2, 3, 4, 5}},
                                        {"coronene", {0, 1, 2, 3, 4, 5}}};

// The hexagon of cells at most so far from the middle.
std::vector<LatticeCell> hexagon(int radius) {
  std::vector<LatticeCell> cells;
  for (int q = -radius; q <= radius; ++q)
    for (int r = -radius; r <= radius; ++r)
      if (std::abs(q + r) <= radius) cells.push_back({q, r});
  return cells;
}

std::vector<LatticeCell> ovalene() {
  std::vector<LatticeCell> cells;
  for (const LatticeCell& centre : {centreCell, beside(centreCell, 0)})
    for (unsigned k = 0; k < 7; ++k) {
      const LatticeCell cell = k < 6 ? beside(centre, k) : centre;
      if (std::ranges::find(cells, cell) == cells.end()) cells.push_back(cell);
    }
  return cells;
}

}  // namespace

std::vector<std::string> moleculeNames() {
  std::vector<std::string> names;
  for (const NamedMolecule& molecule : smallMolecules) names.emplace_back(molecule.name);
  names.insert(names.end(), {"ovalene", "circumcoronene"});
  return names;
}

std::vector<LatticeCell> namedMolecule(std::string_view name) {
  if (name == "ovalene") return ovalene();
  if (name == "circumcoronene") return hexagon(2);
  for (const NamedMolecule& molecule : smallMolecules) {
    if (name != molecule.name) continue;
    std::vector<LatticeCell> cells{centreCell};
    for (const unsigned k : molecule.around) cells.push_back(beside(centreCell, k));
    return cells;
  }
  throw InputError(fmt::format("'{}' is none of the molecules: {}", name, fmt::join(moleculeNames(), ", ")));
}

}  // namespace lampblack::particles
