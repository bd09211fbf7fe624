#include "app/problems/flow/flow_output.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "flow/field_registry.hpp"

namespace lampblack::app {

namespace {

// The corners that stand for each of a quadrilateral's or a hexahedron's where a cell of another shape has to look like
// one.
std::vector<int> drawnAs(CellShape shape, int corners) {
  if (corners == cornersOf(shape)) {
    std::vector<int> own(static_cast<std::size_t>(corners));
    std::iota(own.begin(), own.end(), 0);
    return own;
  }
  switch (shape) {
    case CellShape::Triangle:
      return {0, 1, 2, 2};
    case CellShape::Tetrahedron:
      return {0, 1, 2, 2, 3, 3, 3, 3};
    case CellShape::Pyramid:
      return {0, 1, 2, 3, 4, 4, 4, 4};
    default:  // prism
      return {0, 1, 2, 2, 3, 4, 5, 5};
  }
}

// Corners of the one shape that all cells of the mesh have, or of the shape that all can look like. Collective.
int drawnCorners(const Mesh& mesh) {
  std::array<int, 2> ends{0, 0};  // most, and fewest with the other sign
  ends[1] = -8;
  for (const CellShape shape : mesh.shape) {
    ends[0] = std::max(ends[0], cornersOf(shape));
    ends[1] = std::max(ends[1], -cornersOf(shape));
  }
  MPI_Allreduce(MPI_IN_PLACE, ends.data(), 2, MPI_INT, MPI_MAX, mesh.comm);
  return ends[0] == -ends[1] ? ends[0] : mesh.dimension == 2 ? 4 : 8;
}

}  // namespace

MeshOutput meshOutput(const Mesh& mesh) {
  MeshOutput out;
  out.dimension = mesh.dimension;
  out.corners = drawnCorners(mesh);
  out.totalCells = mesh.totalCells;
  out.totalVertices = mesh.totalVertices;
  for (int c = 0; c < mesh.owned; ++c) {
    out.globalCell.push_back(mesh.naturalCell[c]);
    out.cellVolume.push_back(mesh.volume[c]);
    out.cellCentre.insert(out.cellCentre.end(), mesh.centre[c].begin(), mesh.centre[c].end());
    for (const int corner : drawnAs(mesh.shape[c], out.corners))
      out.connectivity.push_back(mesh.vertexNumber[mesh.corner[mesh.cornerStart[c] + corner]]);
  }
  out.globalVertex = mesh.vertexNumber;
  for (const Vector3& x : mesh.vertex) out.vertexCoordinates.insert(out.vertexCoordinates.end(), x.begin(), x.end());
  return out;
}

void flowFields(const FlowContext& context, const FlowCase& flowCase, const State& state,
                const std::vector<Operator*>& operators, const std::set<std::string>* wanted, const FlowFieldSink& sink,
                bool future) {
  const auto owned = static_cast<std::size_t>(context.mesh.owned);
  const auto n = static_cast<std::size_t>(state.species);
  std::size_t left = wanted ? wanted->size() : 1;  // to be found
  const auto counts = [&](const std::string& name) {
    if (!wanted) return true;
    if (!wanted->contains(name)) return false;
    --left;
    return true;
  };
  const auto give = [&](const Quantity& field, int components, std::span<const double> values) {
    if (counts(field.name)) sink(field, components, values);
  };
  for (const FieldDeclaration& field : fieldRegistry())
    if (const int width = field.widthIn(state); field.isWritten && width > 0)
      give({field.name, field.unit, field.description}, width,
           {field.of(state).data(), owned * static_cast<std::size_t>(width)});
  if (!context.wallDistance.empty())
    give({"wall_distance", "m", "distance of the cell's centre from the nearest wall"}, 1, context.wallDistance);
  std::vector<double> column(owned), weight;
  if (const auto& mixture = flowCase.output.mixtureFraction; mixture && counts("mixture_fraction")) {
    for (std::size_t c = 0; c < owned; ++c) column[c] = mixture->of({&state.Y[c * n], n});
    sink({"mixture_fraction", "1", "mixture fraction of Bilger, from the oxidizer to the fuel"}, 1, column);
  }
  for (std::size_t k : flowCase.output.species) {
    const std::string& species = context.mechanism.speciesName(k);
    const std::string name = "X_" + species;
    if (!counts(name)) continue;
    if (weight.empty())
      for (std::size_t c = 0; c < owned; ++c)
        weight.push_back(context.thermo.meanMolecularWeight({&state.Y[c * n], n}));
    for (std::size_t c = 0; c < owned; ++c)
      column[c] = state.Y[c * n + k] * weight[c] / context.mechanism.molecularWeights()[k];
    sink({name, "1", "mole fraction of " + species}, 1, column);
  }
  Operator::FieldSink fromOperator = [&](const Quantity& field, std::span<const double> values) {
    give(field, static_cast<int>(values.size() / owned), values);
  };
  if (wanted) fromOperator.wants = [&](const std::string& name) { return wanted->contains(name); };
  fromOperator.future = future;
  for (const Operator* op : operators)
    if (left > 0) op->fields(state, fromOperator);
}

void writeFields(ResultsWriter& results, const FlowContext& context, const FlowCase& flowCase, const State& state,
                 const std::vector<Operator*>& operators, std::int64_t step, double time) {
  results.beginStep(step, time);
  flowFields(context, flowCase, state, operators, nullptr,
             [&](const Quantity& field, int components, std::span<const double> values) {
               results.cellField(field.name, field.unit, components, values, field.description);
             });
  results.endStep();
}

std::vector<Quantity> historyColumns(const Mesh& mesh, const std::vector<Operator*>& operators,
                                     const std::vector<Budget::Line>& budget) {
  std::vector<Quantity> columns{{"step", "1", "number of the step"},
                                {"time", "s", "simulated time"},
                                {"dt", "s", "time step"},
                                {"retried_steps", "1", "attempts at a step so far that failed, before a smaller one"},
                                {"maximum_temperature", "K", "largest gas temperature"},
                                {"minimum_mass_fraction", "1", "most negative mass fraction; nothing is clipped"},
                                {"mass_fraction_sum_error", "1", "largest |sum of mass fractions - 1|"}};
  for (const Operator* op : operators)
    for (Quantity& column : op->historyColumns()) columns.push_back(std::move(column));
  for (const Budget::Line& line : budget) {
    const std::string unit = integralUnit(mesh, "kg");
    columns.push_back({line.name + "_content", unit, line.name + " in the domain"});
    columns.push_back({line.name + "_inflow", unit, line.name + " that came in since the start"});
    columns.push_back({line.name + "_outflow", unit, line.name + " that left since the start"});
    columns.push_back({line.name + "_budget_error", "1", "unexplained change over the inflow"});
  }
  return columns;
}

std::vector<double> historyValues(const HistoryRow& row) {
  std::vector<double> values{static_cast<double>(row.step),
                             row.time,
                             row.dt,
                             static_cast<double>(row.retriedSteps),
                             row.extremes.maximumTemperature,
                             row.extremes.minimumMassFraction,
                             row.extremes.massFractionSumError};
  values.insert(values.end(), row.operators.begin(), row.operators.end());
  for (const Budget::Line& line : row.budget)
    for (double value : {line.content, line.inflow, line.outflow, line.error}) values.push_back(value);
  values.insert(values.end(), row.steady.begin(), row.steady.end());
  return values;
}

}  // namespace lampblack::app
