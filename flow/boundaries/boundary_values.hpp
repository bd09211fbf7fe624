// What boundaries that vary over place or time have at each of their faces now.
#pragma once

#include <vector>

#include "chemistry/thermo/thermo.hpp"
#include "core/mesh.hpp"
#include "core/modules.hpp"
#include "flow/boundaries/boundary.hpp"

namespace lampblack::flow {

class BoundaryValues {
 public:
  BoundaryValues(const Mesh& mesh, const std::vector<BoundaryCondition>& boundaries, const Thermo& thermo);

  [[nodiscard]] bool isEmpty() const { return faces_.empty(); }

  // Collective. The gas's boundaries at the time `gas`, what velocities meet at the time `velocity` (s). InputError
  // with the place where a temperature or a composition is none.
  void set(double gas, double velocity);

  struct Face {
    double speed = 0.0;            // m/s, at the time of the gas
    double speedOfMomentum = 0.0;  // m/s, at that of the velocities
    double tangential = 0.0;       // m/s, at that of the velocities
    double swirl = 0.0;            // m/s, at that of the velocities
    double temperature = 0.0;      // K
    double heatFlux = 0.0;         // W/m^2
    std::vector<double> Y;
  };
  // Null where nothing varies.
  [[nodiscard]] const Face* at(int boundaryFace) const {
    const int row = row_[static_cast<std::size_t>(boundaryFace)];
    return row < 0 ? nullptr : &faces_[static_cast<std::size_t>(row)];
  }

 private:
  void evaluate(int face, double gas, double velocity, Face& values) const;

  const Mesh& mesh_;
  std::vector<BoundaryCondition> boundaries_;
  const Thermo& thermo_;
  std::vector<int> row_;     // of each boundary face; -1: does not vary
  std::vector<int> number_;  // face of each row
  std::vector<Face> faces_;
};

}  // namespace lampblack::flow
