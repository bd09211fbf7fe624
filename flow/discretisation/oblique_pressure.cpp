#include "flow/discretisation/oblique_pressure.hpp"

#include <algorithm>

#include "flow/discretisation/face_fluxes.hpp"

namespace lampblack::flow {

ObliquePressure::ObliquePressure(const FlowContext& context, std::span<const BoundaryData> known, Mat differences,
                                 const std::vector<double>& conductance)
    : context_(context),
      known_(known.begin(), known.end()),
      differences_(differences),
      conductance_(conductance),
      gradient_(context.mesh),
      pressure_(static_cast<std::size_t>(context.mesh.cells)),
      slope_(pressure_.size() * static_cast<std::size_t>(context.mesh.dimension)),
      flow_(static_cast<std::size_t>(context.mesh.faces)),
      atOutlets_(static_cast<std::size_t>(context.mesh.boundaryFaces()), 0.0) {
  const Mesh& m = context.mesh;
  checkPetsc(MatCreateShell(m.comm, m.owned, m.owned, PETSC_DETERMINE, PETSC_DETERMINE, this, matrix_.put()));
  const auto product = [](Mat matrix, Vec x, Vec y) -> PetscErrorCode {
    void* self = nullptr;
    if (const PetscErrorCode code = MatShellGetContext(matrix, static_cast<void*>(&self)); code != 0) return code;
    auto* of = static_cast<ObliquePressure*>(self);
    return of->exceptions_.guard([&] { of->multiply(x, y); });
  };
  PetscErrorCode (*const call)(Mat, Vec, Vec) = product;
  checkPetsc(MatShellSetOperation(matrix_.get(), MATOP_MULT, reinterpret_cast<void (*)()>(call)));
}

void ObliquePressure::addVelocity(std::span<const double> pressure, std::span<double> velocity) {
  const Mesh& m = context_.mesh;
  gradient_.compute(pressure, atOutlets_, 1, slope_, known_);
  context_.halo.update(slope_, m.dimension);
  for (int face = 0; face < m.faces; ++face)
    if (conductance_[face] != 0.0)
      velocity[face] -=
          conductance_[face] * m.distance[face] / m.area[face] * faceSlope(m, face, m.oblique[face], slope_);
}

// What flows out of the cells.
void ObliquePressure::multiply(Vec x, Vec y) {
  const Mesh& m = context_.mesh;
  checkPetsc(MatMult(differences_, x, y));
  {
    const PetscValues values(x);
    std::ranges::copy(values.get(), pressure_.begin());
  }
  context_.halo.update(pressure_, 1);
  std::ranges::fill(flow_, 0.0);
  addVelocity(pressure_, flow_);
  for (int face = 0; face < m.faces; ++face) flow_[face] *= m.area[face];
  const PetscMutableValues product(y);
  addFaceFluxes(m, flow_, 1, -1.0, product.get());
}

}  // namespace lampblack::flow
