// A gas that depends on place and time: at a boundary, or at the start.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "core/vector3.hpp"

namespace lampblack::flow {

// A quantity over place and time, SI. Place: along the axes of the mesh, m.
using FieldFunction = std::function<double(const Vector3& place, double time)>;

struct GasVariation {
  FieldFunction temperature;  // K; empty: does not vary
  // Of some species, by number; the others keep their proportions and share what is left of one.
  std::vector<std::pair<std::size_t, FieldFunction>> moleFractions;

  [[nodiscard]] bool isEmpty() const { return !temperature && moleFractions.empty(); }

  // Changes what varies. InputError where a temperature is out of the range of transport properties or mole fractions
  // are below zero or do not sum to one.
  void apply(const Vector3& place, double time, const Thermo& thermo, double& T, std::vector<double>& Y) const;
};

}  // namespace lampblack::flow
