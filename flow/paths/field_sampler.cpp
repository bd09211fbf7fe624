#include "flow/paths/field_sampler.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/sorted_numbers.hpp"
#include "flow/discretisation/vertex_field.hpp"

namespace lampblack::flow {

FieldSampler::FieldSampler(const FlowContext& context, std::vector<Vector3> places)
    : context_(context), places_(std::move(places)), found_(findCells(context.mesh, places_)), inCell_(places_.size()) {
  const Mesh& m = context.mesh;
  // Four corners a place at most; a place has one owner.
  constexpr std::size_t most = std::tuple_size_v<decltype(PlaceInCell::vertex)>;
  std::vector<std::int64_t> corners(most * places_.size(), -1);
  for (std::size_t p = 0; p < places_.size(); ++p) {
    if (found_.cell[p] < 0) continue;
    inCell_[p] = placeInCell(m, found_.cell[p], places_[p]);
    for (int i = 0; i < inCell_[p].corners; ++i)
      corners[most * p + static_cast<std::size_t>(i)] = m.vertexNumber[inCell_[p].vertex[i]];
  }
  MPI_Allreduce(MPI_IN_PLACE, corners.data(), static_cast<int>(corners.size()), MPI_INT64_T, MPI_MAX, m.comm);
  std::erase(corners, -1);
  vertices_ = sortedOnce(corners);
}

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
  const Mesh& m = context_.mesh;
  const std::size_t count = fields.size();
  std::vector<FieldView> views;
  for (Field& field : fields) views.push_back({field.values, 1});
  context_.halo.update(views);
  VertexField::Source source{static_cast<int>(count),
                             std::vector<double>(static_cast<std::size_t>(m.cells) * count),
                             std::vector<double>(static_cast<std::size_t>(m.boundaryFaces()) * count),
                             std::vector<BoundaryData>(static_cast<std::size_t>(m.boundaryFaces()) * count),
                             true,
                             {},
                             vertices_};
  source.isLedOut.resize(count);
  for (std::size_t f = 0; f < count; ++f) {
    source.isLedOut[f] = fields[f].isLedOut ? 1 : 0;
    for (std::size_t c = 0; c < fields[f].values.size(); ++c) source.values[c * count + f] = fields[f].values[c];
    for (std::size_t b = 0; b < fields[f].known.size(); ++b) {
      source.boundary[b * count + f] = fields[f].boundary[b];
      source.known[b * count + f] = fields[f].known[b];
    }
  }
  const VertexField vertexField(context_, std::move(source));
  std::vector<double> samples(places_.size() * count, 0.0);
  for (std::size_t p = 0; p < places_.size(); ++p)
    for (std::size_t f = 0; found_.cell[p] >= 0 && f < count; ++f)
      samples[p * count + f] = vertexField.at(inCell_[p], static_cast<int>(f));
  MPI_Allreduce(MPI_IN_PLACE, samples.data(), static_cast<int>(samples.size()), MPI_DOUBLE, MPI_SUM, m.comm);
  return samples;
}

}  // namespace lampblack::flow
