#include "app/problems/flow/flow_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "app/problems/flow/flow_case_parts.hpp"
#include "app/problems/flow/flow_output.hpp"
#include "core/first_error.hpp"
#include "flow/equations/heat_conduction.hpp"
#include "flow/field_registry.hpp"
#include "io/csv.hpp"

namespace lampblack::app {
namespace {

const std::vector<Quantity> momentColumns{{"step", "1", "number of the step"}, {"time", "s", "simulated time"}};

Vector3 placeOn(const OutputTables::Line& line, int point) {
  const double share = static_cast<double>(point) / (line.points - 1);
  return sum(scaled(line.from, 1.0 - share), scaled(line.to, share));
}

// Fields that tables have where the deck names none.
bool isUsual(const std::string& field) {
  const auto isOfState = [&](const FieldDeclaration& one) { return one.isWritten && one.name == field; };
  return std::ranges::any_of(fieldRegistry(), isOfState) || field.starts_with("X_") ||
         field.ends_with("_volume_fraction");
}

std::vector<Quantity> joined(std::vector<Quantity> first, const std::vector<Quantity>& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

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

FlowTables::FlowTables(const FlowContext& context, const FlowCase& flowCase, const Source& source)
    : context_(&context), case_(flowCase), hasDeposition_(source.deposition != nullptr) {
  const OutputTables& tables = flowCase.output.tables;
  const auto axes = flowcase::axisNames(flowCase);
  if (!tables.probes.empty() || !tables.lines.empty()) chooseQuantities(source);
  if (!tables.probes.empty()) {
    std::vector<Vector3> places;
    for (const OutputTables::Probe& probe : tables.probes) {
      places.push_back(probe.at);
      tables_.push_back({"probe", probe.name, "/probes/" + probe.name, columnsOf(momentColumns)});
    }
    probes_ = std::make_unique<FieldSampler>(context, std::move(places));
    requireInside(
        *probes_, [&](int p) { return "output.probes." + tables.probes[p].name + ".at"; }, "the probe");
  }
  for (const std::size_t b : tables.boundaries) {
    const std::string name = flowcase::fileNameOf(flowCase.boundaries[b].name);
    tables_.push_back({"boundary", name, "/boundaries/" + name, boundaryColumns(b)});
  }
  for (const OutputTables::Line& line : tables.lines) {
    std::vector<Vector3> places;
    for (int p = 0; p < line.points; ++p) places.push_back(placeOn(line, p));
    std::vector<Quantity> first = momentColumns;
    first.push_back({"distance", "m", "from the line's first point"});
    for (const std::string& axis : axes) first.push_back({axis, "m", "coordinate along the axis " + axis});
    tables_.push_back({"line", line.name, "/lines/" + line.name, columnsOf(first)});
    lines_.emplace_back(context, std::move(places));
    requireInside(
        lines_.back(), [&](int) { return "output.lines." + line.name; }, "a point of the line");
  }
  for (const std::size_t b : deposits()) {
    std::vector<Quantity> columns = momentColumns;
    for (const std::string& axis : axes)
      columns.push_back({axis, "m", "coordinate of the face's middle along " + axis});
    columns.push_back({"area", integralUnit(context.mesh, "m^2"), "of the face"});
    columns.push_back({"deposition", "kg/m^2/s", "of particles on the face, mean of the step"});
    columns.push_back({"deposited", "kg/m^2", "of particles on the face since the start"});
    const std::string name = flowcase::fileNameOf(flowCase.boundaries[b].name);
    tables_.push_back({"deposit", name, "/deposits/" + name, columns});
  }
  for (const std::size_t b : walls()) {
    std::vector<Quantity> columns = momentColumns;
    for (const std::string& axis : axes)
      columns.push_back({axis, "m", "coordinate of the face's middle along " + axis});
    columns.push_back({"area", integralUnit(context.mesh, "m^2"), "of the face"});
    for (const std::string& axis : axes)
      columns.push_back({"friction_" + axis, "Pa", "of the gas along the wall, along " + axis});
    if (case_.swirls) columns.push_back({"friction_swirl", "Pa", "the same about the axis"});
    columns.push_back({"y_plus", "1", "of the centre of the cell beside"});
    columns.push_back({"heat_flux", "W/m^2", "conducted into the gas, mean of the step"});
    const std::string name = flowcase::fileNameOf(flowCase.boundaries[b].name);
    tables_.push_back({"wall", name, "/walls/" + name, columns});
  }
  makeRegions();
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    const std::string& name = tables.regions[r].name;
    if (regions_[r].isEmpty())
      raiseTogether(context.mesh.comm, tables.deck->error("particles.regions." + name,
                                                          "no cell of the mesh has its centre in this region"));
    for (const Operator* op : source.operators)
      for (const Operator::RegionTable& table : op->regionTables())
        tables_.push_back(
            {table.kind, name, "/regions/" + name + "/" + table.kind, joined(momentColumns, table.columns)});
  }
}

void FlowTables::makeRegions() {
  regions_.clear();
  for (const OutputTables::Region& region : case_.output.tables.regions)
    regions_.emplace_back(context_->mesh, region.from, region.to);
}

void FlowTables::moveTo(const FlowContext& context) {
  context_ = &context;
  if (probes_) probes_ = std::make_unique<FieldSampler>(context, probes_->places());
  std::vector<FieldSampler> lines;
  for (const FieldSampler& line : lines_) lines.emplace_back(context, line.places());
  lines_.swap(lines);
  makeRegions();
}

void FlowTables::requireInside(const FieldSampler& sampler, const std::function<std::string(int)>& keyOf,
                               const std::string& what) const {
  const int outside = sampler.firstOutside();
  if (outside < 0) return;
  const Vector3& place = sampler.places()[outside];
  const std::string where = meshExtentText(context_->mesh, place);
  raiseTogether(
      context_->mesh.comm,
      case_.output.tables.deck->error(keyOf(outside), fmt::format("{} at {} is outside the mesh: {}", what,
                                                                  placeText(place, context_->mesh.dimension), where)));
}

void FlowTables::chooseQuantities(const Source& source) {
  const auto axes = flowcase::axisNames(case_);
  const std::vector<std::string>& asked = case_.output.tables.quantities;
  std::vector<std::string> there;
  std::vector<Wanted> found;
  flowFields(
      *context_, case_, source.state, source.operators, nullptr,
      [&](const Quantity& field, int components, std::span<const double>) {
        there.push_back(field.name);
        if (asked.empty() ? !isUsual(field.name) : std::ranges::find(asked, field.name) == asked.end()) return;
        for (int i = 0; i < components; ++i) {
          Quantity column = field;
          if (field.name == "velocity")
            column.name += "_" + axes[static_cast<std::size_t>(i)];
          else if (components > 1)
            column.name += fmt::format("_{:02}", i + 1);
          found.push_back({column, field.name, i});
        }
      },
      true);
  for (const std::string& name : asked)
    if (std::ranges::find(there, name) == there.end())
      raiseTogether(context_->mesh.comm,
                    case_.output.tables.deck->error(
                        "output.quantities", fmt::format("'{}' is no field of this flow; its fields are: {}", name,
                                                         fmt::join(there, ", "))));
  wanted_ = std::move(found);
}

std::vector<Quantity> FlowTables::columnsOf(const std::vector<Quantity>& first) const {
  std::vector<Quantity> columns = first;
  for (const Wanted& wanted : wanted_) columns.push_back(wanted.column);
  return columns;
}

std::vector<std::size_t> FlowTables::deposits() const {
  std::vector<std::size_t> found;
  for (const std::size_t b : case_.output.tables.boundaries)
    if (hasDeposition_ && case_.boundaries[b].kind == BoundaryKind::Wall && case_.boundaries[b].takesParticles)
      found.push_back(b);
  return found;
}

std::vector<std::size_t> FlowTables::walls() const {
  std::vector<std::size_t> found;
  for (const std::size_t b : case_.output.tables.boundaries)
    if (case_.boundaries[b].isNoSlipWall()) found.push_back(b);
  return found;
}

std::vector<Quantity> FlowTables::boundaryColumns(std::size_t boundary) const {
  const auto unit = [this](const char* of) { return integralUnit(context_->mesh, of); };
  std::vector<Quantity> columns = momentColumns;
  columns.push_back({"area", unit("m^2"), "of the boundary"});
  columns.push_back({"mass_flow", unit("kg/s"), "of gas that comes in through it, mean of the step"});
  columns.push_back({"enthalpy_flow", unit("W"), "that comes in through it in all, heats of formation included"});
  columns.push_back({"heat_flow", unit("W"), "heat conducted into the gas through it, mean of the step"});
  for (const char* part : {"pressure", "viscous"})
    for (const std::string& axis : flowcase::axisNames(case_))
      columns.push_back({fmt::format("{}_force_{}", part, axis), unit("N"),
                         fmt::format("{} force of the gas on it along {}", part, axis)});
  if (case_.swirls) columns.push_back({"torque", unit("N m"), "of the gas on it about the axis"});
  if (hasDeposition_ && case_.boundaries[boundary].kind == BoundaryKind::Wall) {
    columns.push_back({"deposition", unit("kg/s"), "of particles on the wall, mean of the step"});
    columns.push_back({"mean_deposition", "kg/m^2/s", "the same over the wall's area"});
    columns.push_back({"largest_deposition", "kg/m^2/s", "the same of the face that takes most"});
    columns.push_back({"deposited", unit("kg"), "of particles on the wall since the start"});
  }
  return columns;
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
