// Inside of SectionalSoot: what the aggregates of each section look like. Not for other models.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/collisions/collision_physics.hpp"

namespace lampblack::particles {

class SectionShapes {
 public:
  // `pivots`: kg, increasing; `regularisation`: 1/m3, numbers below which n_p goes to one. `spheres`: n_p = 1 always.
  SectionShapes(std::span<const double> pivots, double density, std::vector<double> regularisation, bool spheres);

  // n_p between 1 and what would make the primaries smaller than the first pivot; it follows primaries/aggregates but
  // for a short smooth turn at either end, so that it has a derivative everywhere. Densities must not be negative.
  void update(std::span<const double> aggregates, std::span<const double> primaries);
  // Slip of the mobility diameter, and so what goes into the continuum kernel.
  void updateGas(double twiceMeanFreePath);

  [[nodiscard]] std::size_t size() const { return sphere.size(); }

  std::vector<double> sphere;                                    // m, diameter of the sphere of the pivot
  std::vector<double> primariesEach, byAggregates, byPrimaries;  // n_p, its derivatives by the two densities, m3
  std::vector<double> primary, mobility, collision;              // m (Wang 2025, eqs. 9-21, 9-22)
  std::vector<double> area, areaSlope;                           // m2 of an aggregate; slopes are derivatives by n_p
  std::vector<double> collisionSlope;                            // m
  std::vector<double> slip, slipOver, slipOverSlope;             // C, C/d of the collision diameter (1/m) and its slope

  // Of the larger of mobility and gyration diameter.
  [[nodiscard]] double gyration(std::size_t i) const;

 private:
  void setShape(std::size_t i);

  std::vector<double> most_, regularisation_, mobilitySlope_;
  bool spheres_;
};

}  // namespace lampblack::particles
