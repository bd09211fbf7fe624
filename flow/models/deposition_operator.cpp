#include "flow/models/deposition_operator.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <utility>

#include "core/gather.hpp"
#include "core/order_free_sums.hpp"

namespace lampblack::flow {

DepositionOperator::DepositionOperator(const FlowContext& context, std::string material)
    : context_(context),
      material_(std::move(material)),
      rate_(static_cast<std::size_t>(context.mesh.faces)),
      mass_(rate_.size()) {}

bool DepositionOperator::isNeeded(const std::vector<BoundaryCondition>& boundaries) {
  return std::ranges::any_of(boundaries,
                             [](const BoundaryCondition& boundary) { return boundary.kind == BoundaryKind::Wall; });
}

void DepositionOperator::record(double dt, std::span<const double> mass) {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const double taken = context_.takesParticles(face) ? mass[face - m.interiorFaces] : 0.0;
    rate_[face] = taken / dt;
    mass_[face] += taken;
  }
}

void DepositionOperator::setRate(std::span<const double> rate) {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face)
    rate_[face] = context_.takesParticles(face) ? rate[face - m.interiorFaces] : 0.0;
}

void DepositionOperator::saveOrLoad(StateArchive& archive) {
  archive.faces("deposition_rate", rate_, 1);
  archive.faces("deposited_mass", mass_, 1);
}

std::vector<DepositionOperator::Totals> DepositionOperator::totals() const {
  const Mesh& m = context_.mesh;
  const std::size_t boundaries = context_.boundaries.size();
  std::vector<PlacedValue> values;
  std::vector<double> largest(boundaries, 0.0);
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    if (context_.boundaryOf(face).kind != BoundaryKind::Wall || m.area[face] <= 0.0) continue;
    const auto b = static_cast<std::size_t>(m.patch[face - m.interiorFaces]);
    values.push_back({3 * b, rate_[face]});
    values.push_back({3 * b + 1, mass_[face]});
    values.push_back({3 * b + 2, m.area[face]});
    largest[b] = std::max(largest[b], rate_[face] / m.area[face]);
  }
  const std::vector<double> sums = orderFreeSums(m.comm, 3 * boundaries, values);
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(boundaries), MPI_DOUBLE, MPI_MAX, m.comm);
  std::vector<Totals> totals;
  for (std::size_t b = 0; b < boundaries; ++b)
    totals.push_back({sums[3 * b], largest[b], sums[3 * b + 1], sums[3 * b + 2]});
  return totals;
}

std::vector<Quantity> DepositionOperator::historyColumns() const {
  return {{material_ + "_deposition", integralUnit(context_.mesh, "kg/s"),
           material_ + " that walls take, mean of the step"},
          {material_ + "_deposited", integralUnit(context_.mesh, "kg"),
           material_ + " that walls have taken since the start"}};
}

std::vector<double> DepositionOperator::historyValues(const State&) {
  last_ = totals();
  double rate = 0.0, mass = 0.0;
  for (const Totals& of : last_) {
    rate += of.rate;
    mass += of.mass;
  }
  return {rate, mass};
}

std::vector<std::string> DepositionOperator::closingLines() const {
  std::vector<std::string> lines;
  for (std::size_t b = 0; b < last_.size(); ++b) {
    const BoundaryCondition& boundary = context_.boundaries[b];
    const Totals& of = last_[b];
    if (boundary.kind == BoundaryKind::Wall && (boundary.takesParticles || of.mass > 0.0))
      lines.push_back(fmt::format(
          "{} on the wall {}: {:.3g} {} at the end (mean {:.3g}, largest {:.3g} kg/m^2/s), {:.4g} {} since the start",
          material_, boundary.name, of.rate, integralUnit(context_.mesh, "kg/s"), of.meanFlux(), of.largestFlux,
          of.mass, integralUnit(context_.mesh, "kg")));
  }
  return lines;
}

std::vector<DepositionOperator::Face> DepositionOperator::facesOf(int boundary) const {
  const Mesh& m = context_.mesh;
  std::vector<Face> own;
  for (int face = m.interiorFaces; face < m.faces; ++face)
    if (m.patch[face - m.interiorFaces] == boundary && m.area[face] > 0.0)
      own.push_back({m.faceNumber[face], m.faceCentre[face], m.area[face], rate_[face] / m.area[face],
                     mass_[face] / m.area[face]});
  std::vector<Face> faces = gatheredOnFirst(m.comm, std::move(own)).values;
  std::ranges::sort(faces, {}, &Face::number);
  return faces;
}

}  // namespace lampblack::flow
