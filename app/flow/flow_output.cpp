#include "app/flow/flow_output.hpp"

#include <algorithm>
#include <map>

namespace lampblack::app {

MeshOutput meshOutput(const Mesh& mesh) {
  MeshOutput out;
  const std::int64_t n0 = mesh.cellsAlong[0];
  const std::int64_t n1 = mesh.cellsAlong[1];
  out.totalCells = mesh.totalCells;
  out.totalVertices = (n0 + 1) * (n1 + 1);
  std::map<std::int64_t, std::array<double, 2>> vertices;
  for (int c = 0; c < mesh.owned; ++c) {
    const std::int64_t natural = mesh.naturalCell[c];
    const std::int64_t i = natural % n0;
    const std::int64_t j = natural / n0;
    out.globalCell.push_back(natural);
    out.cellVolume.push_back(mesh.volume[c]);
    for (double x : {mesh.centre[c][0], mesh.centre[c][1], 0.0}) out.cellCentre.push_back(x);
    for (const auto& [di, dj] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
      const std::int64_t vertex = (i + di) + (j + dj) * (n0 + 1);
      out.connectivity.push_back(vertex);
      vertices[vertex] = {mesh.spec.vertices[0][static_cast<std::size_t>(i + di)],
                          mesh.spec.vertices[1][static_cast<std::size_t>(j + dj)]};
    }
  }
  for (const auto& [vertex, x] : vertices) {
    out.globalVertex.push_back(vertex);
    for (double value : {x[0], x[1], 0.0}) out.vertexCoordinates.push_back(value);
  }
  return out;
}

void writeFields(ResultsWriter& results, const FlowContext& context, const FlowCase& flowCase, const State& state,
                 const std::vector<Operator*>& operators, std::int64_t step, double time) {
  const auto owned = static_cast<std::size_t>(context.mesh.owned);
  const auto n = static_cast<std::size_t>(state.species);
  const auto part = [owned](const std::vector<double>& field, std::size_t components) {
    return std::span<const double>{field.data(), owned * components};
  };
  results.beginStep(step, time);
  results.cellField("temperature", "K", 1, part(state.temperature, 1), "gas temperature");
  results.cellField("density", "kg/m^3", 1, part(state.density, 1), "gas density");
  results.cellField("velocity", "m/s", 2, part(state.velocity, 2), "gas velocity along the mesh's axes");
  results.cellField("pressure", "Pa", 1, part(state.pressure, 1), "hydrodynamic pressure");
  std::vector<double> column(owned);
  std::vector<double> weight(owned);
  for (std::size_t c = 0; c < owned; ++c) weight[c] = context.thermo.meanMolecularWeight({&state.Y[c * n], n});
  for (std::size_t k : flowCase.output.species) {
    for (std::size_t c = 0; c < owned; ++c)
      column[c] = state.Y[c * n + k] * weight[c] / context.mechanism.molecularWeights()[k];
    const std::string& name = context.mechanism.speciesName(k);
    results.cellField("X_" + name, "1", 1, column, "mole fraction of " + name);
  }
  for (const Operator* op : operators)
    op->fields(state, [&](const Quantity& field, std::span<const double> values) {
      results.cellField(field.name, field.unit, 1, values, field.description);
    });
  results.endStep();
}

std::vector<Quantity> historyColumns(const std::vector<Operator*>& operators, const std::vector<Budget::Line>& budget) {
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
    columns.push_back({line.name + "_content", "kg/rad", line.name + " in the domain (planar: kg/m)"});
    columns.push_back({line.name + "_inflow", "kg/rad", line.name + " that came in since the start"});
    columns.push_back({line.name + "_outflow", "kg/rad", line.name + " that left since the start"});
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
  return values;
}

}  // namespace lampblack::app
