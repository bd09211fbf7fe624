#include "flow/field_sampler.hpp"

#include <algorithm>
#include <utility>

namespace lampblack::flow {

FieldSampler::FieldSampler(const FlowContext& context, std::vector<Vector3> places)
    : context_(context),
      places_(std::move(places)),
      found_(findCells(context.mesh, places_)),
      gradient_(context.mesh) {}

int FieldSampler::firstOutside() const {
  const auto outside = std::ranges::find(found_.naturalCell, -1);
  return outside == found_.naturalCell.end() ? -1 : static_cast<int>(outside - found_.naturalCell.begin());
}

FieldSampler::Field FieldSampler::scalarField(const FlowContext& context) {
  const Mesh& m = context.mesh;
  Field field;
  field.values.resize(static_cast<std::size_t>(m.cells));
  field.boundary.resize(static_cast<std::size_t>(m.boundaryFaces()));
  for (int face = m.interiorFaces; face < m.faces; ++face)
    field.known.push_back(context.boundaryOf(face).kind == BoundaryKind::Symmetry ? BoundaryData::ZeroSlope
                                                                                  : BoundaryData::Nothing);
  return field;
}

std::vector<double> FieldSampler::sample(std::span<Field> fields) const {
  std::vector<FieldView> views;
  for (Field& field : fields) views.push_back({field.values, 1});
  context_.halo.update(views);
  std::vector<double> samples(places_.size() * fields.size(), 0.0);
  for (std::size_t p = 0; p < places_.size(); ++p) {
    const int cell = found_.cell[p];
    if (cell < 0) continue;
    const Vector3 fromCentre = difference(places_[p], context_.mesh.centre[cell]);
    for (std::size_t f = 0; f < fields.size(); ++f) {
      double slope = 0.0;
      gradient_.along(fromCentre, cell, fields[f].values, fields[f].boundary, 1, {&slope, 1}, fields[f].known);
      samples[p * fields.size() + f] = fields[f].values[cell] + slope;
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, samples.data(), static_cast<int>(samples.size()), MPI_DOUBLE, MPI_SUM,
                context_.mesh.comm);
  return samples;
}

}  // namespace lampblack::flow
