// What a flow's run tells at its end: the closing report, and what of it stands in the record of the run.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <limits>

#include "app/problems/flow/flow_loop.hpp"
#include "app/run/recorded_run.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "io/json.hpp"
#include "io/report.hpp"

namespace lampblack::app {
namespace {

// One object: the worst of each measure with its place, in SI.
std::string meshJson(const MeshQuality& quality) {
  JsonWriter json;
  json.beginObject();
  for (std::size_t s = 0; s < quality.cells.size(); ++s)
    if (quality.cells[s] > 0) json.field(nameOf(static_cast<CellShape>(s)), quality.cells[s]);
  const auto add = [&](const char* name, const MeshQuality::Worst& worst) {
    json.key(name).beginObject().field("value", worst.value).field("number", worst.number).key("place").beginArray();
    for (int axis = 0; axis < quality.dimension; ++axis) json.value(worst.place[axis]);
    json.endArray().endObject();
  };
  add("smallest_cell", quality.smallest);
  add("largest_cell", quality.largest);
  add("growth", quality.growth);
  add("angle", quality.angle);
  json.field("mean_angle", quality.meanAngle).field("faces_beyond_largest_angle", quality.facesBeyond);
  add("skewness", quality.skewness);
  add("aspect_ratio", quality.aspect);
  json.endObject();
  return json.text();
}

std::string steepnessText(const flow::FlameSteepness& flame, int dimension) {
  return fmt::format(
      "flame: where it burns temperatures of neighbouring cells differ by {:.4g} K, at {}: {:.1f} cells from cold to "
      "hot{}",
      flame.difference, placeText(flame.place, dimension), flame.cells,
      flame.cells < flow::FlameSteepness::fewCells
          ? "; so thin a premixed flame, or foot of a flame, stands where the cells are: smaller cells there"
          : "");
}

}  // namespace

std::vector<std::string> FlowLoop::steadyLines() const {
  if (holder() != nullptr) return {};
  if (search_) {
    std::vector<std::string> lines = searchLines();
    for (const std::vector<std::string>& more : {stabilityLines(), branchLines()})
      lines.insert(lines.end(), more.begin(), more.end());
    return lines;
  }
  std::vector<std::string> lines = steadiness_.lines();
  if (case_.time.steady)
    lines.push_back(fmt::format("{} (time.steady.tolerance {:.2g}, {} norm)",
                                isSteady() ? fmt::format("steady at t = {:.6g} s", time_) : "not steady",
                                case_.time.steady->tolerance,
                                case_.time.steady->norm == Steadiness::Norm::Rms ? "RMS" : "maximum"));
  return lines;
}

std::vector<ResidualNorm> FlowLoop::residualNow() {
  if (!rounds_ && std::ranges::any_of(operators_, &Operator::isStochastic)) return {};
  if (normsOf_ == steps_) return norms_;
  const Timers::Scope scope(timers_, "monitoring");
  FlowResidual residual(domain_->context, domain_->state, case_.flow.velocityScheme, operators_);
  try {
    residual.evaluate(domain_->state);
  } catch (const NumericsError& error) {  // of all ranks alike; the run's results are what they are
    printWarnings({fmt::format("the last state has no residual: {}", error.what())});
    return {};
  }
  return residualNorms(domain_->context, domain_->state, residual, steadiness_.time());
}

// One object; null where it is not known.
std::string FlowLoop::steadyJson(const std::vector<ResidualNorm>& residual,
                                 const std::optional<flow::FlameSteepness>& flame) const {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto whole = [&](Steadiness::Norm norm) {
    const auto change = steadiness_.change(norm);
    return change && change->isWhole ? change->value : unknown;
  };
  JsonWriter json;
  json.beginObject();
  if (case_.time.steady || search_) json.field("steady", isSteady());
  json.field("residence_time_s", steadiness_.time()).field("change", whole(Steadiness::Norm::Maximum));
  json.field("change_rms", whole(Steadiness::Norm::Rms));
  json.field("period_s", steadiness_.periodicity() ? steadiness_.periodicity()->period : unknown);
  json.key("residual").beginObject();
  for (const ResidualNorm& norm : residual) json.field(norm.equation.c_str(), norm.value);
  json.endObject();
  if (search_) {
    json.field("flame_cells", flame ? flame->cells : unknown);
    addSearch(json);
  }
  addStability(json);
  addBranch(json);
  json.endObject();
  return json.text();
}

void FlowLoop::count(RunRecord& record) const {
  record.steps = steps_;
  record.earlierSteps = earlierSteps_;
  record.retriedSteps = retried_;
  record.cells = domain_->mesh.totalCells;
  record.meshJson = meshJson(quality_);
  record.simulatedTime = time_;
}

void FlowLoop::measure(RunRecord& record) const {
  record.stages.clear();
  for (const auto& stage : timers_.gather(comm_))
    record.stages.push_back({stage.name, stage.least, stage.mean, stage.most});
  record.peakMemoryPerRank = peakMemory(comm_);
}

void FlowLoop::report(double wallTime, RunRecord& record) {
  ClosingReport closing;
  closing.ranks = domain_->mesh.ranks;
  closing.cells = domain_->mesh.totalCells;
  closing.steps = steps_ - earlierSteps_;
  closing.earlierSteps = earlierSteps_;
  closing.wallTime = wallTime;
  const std::vector<ResidualNorm> residual = residualNow();
  MPI_Allreduce(MPI_IN_PLACE, processorTime_.data(), static_cast<int>(processorTime_.size()), MPI_DOUBLE, MPI_SUM,
                comm_);
  measure(record);
  closing.stages = record.stages;
  closing.peakMemoryPerRank = record.peakMemoryPerRank;
  for (const Operator* op : operators_)
    if (const auto imbalance = op->imbalance())
      closing.imbalances.push_back({op->name(), imbalance->before, imbalance->after});
  count(record);
  const auto steepness = flow::flameSteepness(domain_->context, domain_->state);
  if (holder() == nullptr) record.resultsJson = steadyJson(residual, steepness);
  if (search_ && !steepness && case_.mechanism->numReactions() > 0)
    printWarnings(
        {"nothing burns in the steady state that was found: a flame that has gone out, or was never lit, is "
         "steady too"});
  if (search_ && steepness && steepness->cells < flow::FlameSteepness::fewCells)
    printWarnings({fmt::format(
        "the flame has {:.1f} cells from cold to hot at {}: so thin a premixed flame, or foot of a flame, may stand in "
        "one row of cells or in another, each a steady state of this mesh, as the start decides; cells there of {:.2g} "
        "of their size (mesh) are small enough",
        steepness->cells, placeText(steepness->place, domain_->mesh.dimension),
        steepness->cells / flow::FlameSteepness::fewCells)});
  if (domain_->mesh.rank != 0) return;
  std::cout << formatReport(closing);
  for (const std::string& line : quality_.lines()) fmt::print("{}\n", line);
  if (costs_.partitions() > 0) fmt::print("times the mesh was partitioned anew: {}\n", costs_.partitions());
  if (const std::int64_t retried = retried_ - earlierRetried_; retried > 0)
    fmt::print("steps that failed and were tried again, smaller: {}\n", retried);
  fmt::print("peak temperature {:.1f} K at {} = ({:.3f}, {:.3f}) mm\n", last_.extremes.maximumTemperature,
             domain_->mesh.axisymmetric() ? "(r, z)" : "(x, y)", 1e3 * peakTemperature_.place[0],
             1e3 * peakTemperature_.place[1]);
  if (steepness) fmt::print("{}\n", steepnessText(*steepness, domain_->mesh.dimension));
  for (const Operator* op : operators_)
    for (const std::string& line : op->closingLines()) fmt::print("{}\n", line);
  for (const std::string& line : steadyLines()) fmt::print("{}\n", line);
  if (const std::string text = residualText(residual, domain_->mesh.dimension); !text.empty())
    fmt::print("residual, of the throughflow: {}\n", text);
  for (const Budget::Line& line : search_ ? std::vector<Budget::Line>() : last_.budget)  // iterations have none
    fmt::print("budget of {:<5} closed to {:.2e} of the inflow\n", line.name, line.error);
  fmt::print("sum of mass fractions 1 to {:.1e}; most negative mass fraction {:.1e} at the end (nothing is clipped)\n",
             last_.extremes.massFractionSumError, last_.extremes.minimumMassFraction);
}

}  // namespace lampblack::app
