#include "flow/boundaries/boundary_values.hpp"

#include <fmt/format.h>

#include <exception>

#include "core/errors.hpp"

namespace lampblack::flow {

BoundaryValues::BoundaryValues(const Mesh& mesh, const std::vector<BoundaryCondition>& boundaries, const Thermo& thermo)
    : mesh_(mesh), boundaries_(boundaries), thermo_(thermo) {
  for (int face = mesh.interiorFaces; face < mesh.faces; ++face) {
    const bool varies =
        !boundaries_[static_cast<std::size_t>(mesh.patch[static_cast<std::size_t>(face - mesh.interiorFaces)])]
             .varies.isEmpty();
    row_.push_back(varies ? static_cast<int>(number_.size()) : -1);
    if (varies) number_.push_back(face);
  }
  faces_.resize(number_.size());
}

void BoundaryValues::evaluate(int face, double gas, double velocity, Face& values) const {
  const BoundaryCondition& boundary =
      boundaries_[static_cast<std::size_t>(mesh_.patch[static_cast<std::size_t>(face - mesh_.interiorFaces)])];
  const BoundaryVariation& varies = boundary.varies;
  const Vector3& place = mesh_.faceCentre[static_cast<std::size_t>(face)];
  values.speed = varies.speed ? varies.speed(place, gas) : boundary.speed;
  values.speedOfMomentum = varies.speed ? varies.speed(place, velocity) : boundary.speed;
  values.tangential = varies.tangential ? varies.tangential(place, velocity) : boundary.tangential;
  values.swirl = varies.swirl ? varies.swirl(place, velocity) : boundary.swirl;
  values.heatFlux = varies.heatFlux ? varies.heatFlux(place, gas) : boundary.heatFlux;
  values.temperature = boundary.temperature;
  values.Y = boundary.Y;
  varies.gas.apply(place, gas, thermo_, values.temperature, values.Y);
}

void BoundaryValues::set(double gas, double velocity) {
  collectively(mesh_.comm, [&] {
    for (std::size_t row = 0; row < faces_.size(); ++row) try {
        evaluate(number_[row], gas, velocity, faces_[row]);
      } catch (const std::exception& error) {
        const auto& place = mesh_.faceCentre[static_cast<std::size_t>(number_[row])];
        throw InputError(fmt::format("boundaries.{}: at {} and t = {:g} s: {}", mesh_.patchName(number_[row]),
                                     placeText(place, mesh_.dimension), gas, error.what()));
      }
  });
}

}  // namespace lampblack::flow
