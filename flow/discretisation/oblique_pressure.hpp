// The operator of the pressure on cells whose steps are oblique to their faces, as a matrix of PETSc that is not
// assembled: besides the differences along the steps, the slopes along Mesh::oblique, from the cells' least-squares
// gradients (the over-relaxed split; Jasak 1996, section 3.3.1.3).
//
// Solved as one matrix by a Krylov method, with the differences alone as preconditioner. Correcting for the slopes
// from solution to solution does not converge where they outweigh the differences: on cells ten times as long as wide
// whose faces are turned by 60 degrees each correction is larger than the one before.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/petsc.hpp"
#include "core/petsc_callbacks.hpp"
#include "flow/discretisation/gradient.hpp"
#include "flow/flow_context.hpp"

namespace lampblack::flow {

class ObliquePressure {
 public:
  // Collective. `known`: as Projection has it. `differences`: the assembled matrix, in whose rows the cells are; it and
  // `conductance` (one a face, m^3/s of flow for a difference of 1 Pa) are read at each product.
  ObliquePressure(const FlowContext& context, std::span<const BoundaryData> known, Mat differences,
                  const std::vector<double>& conductance);
  ObliquePressure(const ObliquePressure&) = delete;
  ObliquePressure& operator=(const ObliquePressure&) = delete;

  [[nodiscard]] Mat matrix() const { return matrix_.get(); }
  // Runs a call of PETSc in which products are made: what they throw comes out of it.
  template <typename Call>
  void run(Call&& call) {
    exceptions_.run(std::forward<Call>(call));
  }

  // Collective. Adds to the velocity (m/s) through each face what a pressure (halo filled, zero at outlets) drives
  // along the oblique parts.
  void addVelocity(std::span<const double> pressure, std::span<double> velocity);

 private:
  void multiply(Vec x, Vec y);

  const FlowContext& context_;
  std::vector<BoundaryData> known_;
  Mat differences_;
  const std::vector<double>& conductance_;
  Gradient gradient_;
  std::vector<double> pressure_, slope_, flow_, atOutlets_;
  PetscExceptions exceptions_;
  PetscMatrix matrix_;
};

}  // namespace lampblack::flow
