#include "app/problems/flow/flow_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/problems/flow/flow_case_parts.hpp"
#include "app/problems/flow/flow_output.hpp"
#include "core/first_error.hpp"
#include "flow/field_registry.hpp"

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

}  // namespace

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

}  // namespace lampblack::app
