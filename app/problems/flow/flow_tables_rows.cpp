// The rows of a flow's tables: what they are taken from, their files, and what a checkpoint has of them.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/problems/flow/flow_output.hpp"
#include "app/problems/flow/flow_tables.hpp"
#include "flow/equations/heat_conduction.hpp"
#include "io/csv.hpp"

namespace lampblack::app {
namespace {

// The moment in front of each row.
std::vector<double> withMoment(const FlowTables::Moment& moment, std::span<const double> rows, std::size_t width) {
  std::vector<double> all;
  for (std::size_t row = 0; row < rows.size(); row += width) {
    all.insert(all.end(), {static_cast<double>(moment.step), moment.time});
    all.insert(all.end(), rows.begin() + static_cast<std::ptrdiff_t>(row),
               rows.begin() + static_cast<std::ptrdiff_t>(row + width));
  }
  return all;
}

}  // namespace

std::string FlowTables::Table::header() const {
  return id() + " " + csvHeader(columns);
}

std::vector<FieldSampler::Field> FlowTables::fieldsOf(const Source& source) const {
  const Mesh& m = context_->mesh;
  std::set<std::string> names;
  for (const Wanted& wanted : wanted_) names.insert(wanted.field);
  std::vector<FieldSampler::Field> fields(wanted_.size(), FieldSampler::scalarField(*context_));
  const VelocityGradient* gradient =
      names.contains("velocity") ? &source.transport.velocityGradient(source.state) : nullptr;
  for (std::size_t f = 0; f < wanted_.size(); ++f) {
    FieldSampler::Field& field = fields[f];
    if (wanted_[f].field == "velocity") {
      field.known = gradient->known(wanted_[f].component);
      for (std::size_t b = 0; b < field.boundary.size(); ++b)
        field.boundary[b] = gradient->boundary()[b * m.dimension + wanted_[f].component];
    } else if (wanted_[f].field == "temperature") {
      for (int face = m.interiorFaces; face < m.faces; ++face) {
        field.known[face - m.interiorFaces] = knownTemperature(*context_, face);
        field.boundary[face - m.interiorFaces] = context_->boundaryTemperature(face);
      }
    } else if (wanted_[f].field == "pressure") {
      field.boundary = source.transport.boundaryPressures(source.state);
      field.isLedOut = true;
      for (int face = m.interiorFaces; face < m.faces; ++face)
        if (context_->boundaryOf(face).kind == BoundaryKind::Outlet)
          field.known[face - m.interiorFaces] = BoundaryData::Value;
    } else if (wanted_[f].field == "swirl_velocity") {
      std::ranges::fill(field.known, BoundaryData::Nothing);
    }
  }
  flowFields(
      *context_, case_, source.state, source.operators, &names,
      [&](const Quantity& quantity, int components, std::span<const double> values) {
        for (std::size_t f = 0; f < wanted_.size(); ++f)
          if (wanted_[f].field == quantity.name)
            for (int c = 0; c < m.owned; ++c) fields[f].values[c] = values[c * components + wanted_[f].component];
      },
      true);
  return fields;
}

void FlowTables::open(const RunFolder& folder) {
  if (tables_.empty()) return;
  collectively(context_->mesh.comm, [&] {
    if (context_->mesh.rank == 0) folder.makeTableFolder();
  });
  for (const Table& table : tables_) {
    writers_.emplace_back(context_->mesh.comm, folder.table(table.id()), table.columns);
    if (const auto earlier = loaded_.find(table.header()); earlier != loaded_.end())
      writers_.back().row(earlier->second);
  }
  loaded_.clear();
}

void FlowTables::historyRow(const Moment& moment, const Source& source) {
  const std::vector<double> first{static_cast<double>(moment.step), moment.time};
  std::size_t table = 0;
  if (probes_) {
    std::vector<FieldSampler::Field> fields = fieldsOf(source);
    const std::vector<double> samples = probes_->sample(fields);
    for (std::size_t p = 0; p < case_.output.tables.probes.size(); ++p, ++table) {
      std::vector<double> row = first;
      const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(p * wanted_.size());
      row.insert(row.end(), begin, begin + static_cast<std::ptrdiff_t>(wanted_.size()));
      writers_[table].row(row);
    }
  }
  if (case_.output.tables.boundaries.empty()) return;
  const std::vector<BoundaryTotals> totals = source.transport.boundaryTotals(source.state);
  std::vector<DepositionOperator::Totals> deposits;
  if (source.deposition) deposits = source.deposition->totals();
  for (const std::size_t b : case_.output.tables.boundaries) {
    const BoundaryTotals& of = totals[b];
    std::vector<double> row = first;
    row.insert(row.end(), {of.area, of.massFlow, of.enthalpyFlow, of.heatFlow});
    for (const Vector3* force : {&of.pressureForce, &of.viscousForce})
      row.insert(row.end(), force->begin(), force->begin() + context_->mesh.dimension);
    if (case_.swirls) row.push_back(of.torque);
    if (source.deposition && case_.boundaries[b].kind == BoundaryKind::Wall)
      row.insert(row.end(), {deposits[b].rate, deposits[b].meanFlux(), deposits[b].largestFlux, deposits[b].mass});
    writers_[table++].row(row);
  }
}

void FlowTables::outputRows(const Moment& moment, const Source& source) {
  std::size_t table = (probes_ ? probes_->places().size() : 0) + case_.output.tables.boundaries.size();
  std::vector<FieldSampler::Field> fields;
  if (!lines_.empty()) fields = fieldsOf(source);
  for (const FieldSampler& line : lines_) {
    const std::vector<double> samples = line.sample(fields);
    std::vector<double> rows;
    for (std::size_t p = 0; p < line.places().size(); ++p) {
      const Vector3& place = line.places()[p];
      rows.insert(rows.end(),
                  {static_cast<double>(moment.step), moment.time, length(difference(place, line.places().front()))});
      rows.insert(rows.end(), place.begin(), place.begin() + context_->mesh.dimension);
      const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(p * wanted_.size());
      rows.insert(rows.end(), begin, begin + static_cast<std::ptrdiff_t>(wanted_.size()));
    }
    writers_[table++].row(rows);
  }
  for (const std::size_t b : deposits()) {
    std::vector<double> rows;
    for (const DepositionOperator::Face& face : source.deposition->facesOf(static_cast<int>(b))) {
      rows.insert(rows.end(), {static_cast<double>(moment.step), moment.time});
      rows.insert(rows.end(), face.place.begin(), face.place.begin() + context_->mesh.dimension);
      rows.insert(rows.end(), {face.area, face.flux, face.mass});
    }
    writers_[table++].row(rows);
  }
  for (const std::size_t b : walls()) {
    const auto axes = static_cast<std::size_t>(context_->mesh.dimension);
    std::vector<double> rows;
    for (const WallFace& face : source.transport.wallFaces(source.state, static_cast<int>(b))) {
      rows.insert(rows.end(), {static_cast<double>(moment.step), moment.time});
      rows.insert(rows.end(), face.place.begin(), face.place.begin() + axes);
      rows.push_back(face.area);
      rows.insert(rows.end(), face.friction.begin(), face.friction.begin() + axes + (case_.swirls ? 1 : 0));
      rows.insert(rows.end(), {face.yPlus, face.heatFlux});
    }
    writers_[table++].row(rows);
  }
  for (const MeshRegion& region : regions_)
    for (const Operator* op : source.operators) {
      const std::vector<Operator::RegionTable> of = op->regionTables();
      for (std::size_t t = 0; t < of.size(); ++t)
        writers_[table++].row(withMoment(moment, op->regionRows(t, region), of[t].columns.size()));
    }
}

void FlowTables::writeTo(ResultsWriter& results) const {
  for (std::size_t t = 0; t < writers_.size(); ++t) writers_[t].writeTo(results, tables_[t].group);
}

void FlowTables::save(CheckpointWriter& archive) const {
  std::vector<std::string> headers{"tables"};  // a list of texts is not empty
  for (const Table& table : tables_) headers.push_back(table.header());
  archive.texts("tables", headers);
  for (std::size_t t = 0; t < writers_.size(); ++t) {
    std::vector<double> rows = writers_[t].rows();
    archive.shared(fmt::format("table_{}", t + 1), rows);
  }
}

void FlowTables::load(CheckpointReader& archive) {
  const std::vector<std::string> headers = archive.texts("tables");
  for (std::size_t t = 1; t < headers.size(); ++t) archive.shared(fmt::format("table_{}", t), loaded_[headers[t]]);
}

}  // namespace lampblack::app
