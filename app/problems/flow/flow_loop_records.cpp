// What a flow's run keeps and tells: rows of the history, fields, checkpoints, the closing report.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "app/problems/flow/flow_loop.hpp"
#include "app/run/failed_cell.hpp"
#include "app/run/recorded_run.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "core/system_error.hpp"
#include "core/wall_clock.hpp"
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

// Rows of a history of other last columns than those that are asked for now, behind the common ones: NaN is what they
// do not have.
std::vector<double> withWidth(const std::vector<double>& rows, std::size_t from, std::size_t common, std::size_t to) {
  if (from == to) return rows;
  std::vector<double> others;
  for (std::size_t row = 0; row + from <= rows.size(); row += from) {
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(row);
    others.insert(others.end(), begin, begin + static_cast<std::ptrdiff_t>(common));
    others.insert(others.end(), to - common, std::numeric_limits<double>::quiet_NaN());
  }
  return others;
}

const std::vector<Quantity> steadyColumns{
    {"steady_change", "1", "largest change of a field in a cell over the residence time, of the field's range"},
    {"steady_change_rms", "1", "the same, root of the mean square over the domain"},
    {"steady_time", "s", "residence time, or time.steady.time"},
    {"steady_period", "s", "after which the flow repeats itself"}};

}  // namespace

std::vector<Quantity> FlowLoop::columns() const {
  std::vector<Quantity> columns = historyColumns(domain_->mesh, operators_, domain_->budget->lines(domain_->state));
  if (case_.time.steady) columns.insert(columns.end(), steadyColumns.begin(), steadyColumns.end());
  if (search_) {
    const std::vector<Quantity> more = searchColumns();
    columns.insert(columns.end(), more.begin(), more.end());
  }
  return columns;
}

HistoryRow FlowLoop::observe() {
  const Timers::Scope scope(timers_, "monitoring");
  if (iteration_) domain_->adopt(case_);
  HistoryRow row;
  row.step = steps_;
  row.time = time_;
  row.dt = iteration_ ? 0.0 : dt_;
  row.retriedSteps = retried_;
  row.extremes = extremesOf(domain_->context, domain_->state);
  for (Operator* op : operators_) {
    const std::vector<double> values = op->historyValues(domain_->state);
    row.operators.insert(row.operators.end(), values.begin(), values.end());
  }
  row.budget = domain_->budget->lines(domain_->state);
  if (search_) row.steady = searchValues();
  if (case_.time.steady) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    for (const auto norm : {Steadiness::Norm::Maximum, Steadiness::Norm::Rms}) {
      const auto change = steadiness_.change(norm);
      row.steady.push_back(change ? change->value : unknown);
    }
    row.steady.push_back(steadiness_.time());
    row.steady.push_back(steadiness_.periodicity() ? steadiness_.periodicity()->period : unknown);
  }
  peakTemperature_ = peakOf(domain_->mesh, [&](int c) { return domain_->state.temperature[c]; });
  last_ = row;
  return row;
}

void FlowLoop::checkResult() const {
  for (const Operator* op : operators_) op->checkResult();
}

HistoryRow FlowLoop::writeRow(HistoryWriter& history) {
  HistoryRow row = observe();
  if (!search_) checkResult();  // on its way a search may pass what is none
  history.row(historyValues(row));
  const Timers::Scope scope(timers_, "monitoring");
  tables_->historyRow({steps_, time_}, tableSource());
  return row;
}

std::string FlowLoop::status(const HistoryRow& row) const {
  std::string text = fmt::format("Tmax {:.0f} K", row.extremes.maximumTemperature);
  for (const Operator* op : operators_)
    if (const std::string more = op->status(); !more.empty()) text += "  " + more;
  if (search_ && !isTurnOfParticles())
    if (const std::string norms = residualText(norms_, domain_->mesh.dimension); !norms.empty())
      text += "  residual: " + norms;
  if (!case_.time.steady) return text;
  const auto& [tolerance, _, after, norm] = *case_.time.steady;
  if (const auto change = steadiness_.change(norm))
    text += fmt::format("  change {:.2g} in {:.3g} s (to be {:.2g})", change->value, steadiness_.time(), tolerance);
  else
    text += fmt::format("  change of {:.3g} s not known yet", steadiness_.time());
  if (steadiness_.periodicity()) text += fmt::format("  period {:.3g} s", steadiness_.periodicity()->period);
  return text;
}

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

void FlowLoop::saveOrLoadParts(StateArchive& archive) {
  domain_->state.saveOrLoad(archive);
  for (Operator* op : operators_) op->saveOrLoad(archive);
  domain_->budget->saveOrLoad(archive);
}

void FlowLoop::saveOrLoad(StateArchive& archive, std::vector<double>& history) {
  saveOrLoadParts(archive);
  costs_.saveOrLoad(archive);
  const double interval = case_.output.interval;
  const std::size_t width = columns().size();
  const std::size_t ofSearch = searchColumns().size();
  const std::size_t common = width - (search_ ? ofSearch : case_.time.steady ? steadyColumns.size() : 0);
  std::vector<double> clock{time_,
                            static_cast<double>(steps_),
                            dt_,
                            nextOutput_,
                            interval,
                            static_cast<double>(written_),
                            static_cast<double>(width),
                            static_cast<double>(retried_)};
  archive.shared("clock", clock);
  archive.shared("history", history);
  const auto stored = static_cast<std::size_t>(clock.size() > 6 ? clock[6] : 0.0);
  const bool hasSearch = stored == common + ofSearch, hasSteady = hasSearch || stored == common + steadyColumns.size();
  if ((case_.time.steady || search_) && hasSteady) steadiness_.saveOrLoad(archive);
  if (search_ && hasSearch) saveOrLoadSearch(archive);
  if (!archive.loading()) return;
  collectively(comm_, [&] {
    if (clock.size() != 8 || (stored != common && !hasSteady))
      throw InputError(
          "the checkpoint was written by another version of Lampblack, with another history; begin a new run instead, "
          "from the results of the interrupted one (initial.flow.results)");
  });
  history = withWidth(history, stored, common, width);
  time_ = clock[0];
  steps_ = static_cast<std::int64_t>(clock[1]);
  dt_ = clock[2];
  // Another interval counts from the start.
  nextOutput_ = clock[4] == interval ? clock[3] : interval * (std::floor(time_ / interval * (1.0 + 1e-12)) + 1.0);
  written_ = static_cast<std::int64_t>(clock[5]);
  retried_ = static_cast<std::int64_t>(clock[7]);
  if (!(case_.time.steady || search_) || !hasSteady) steadiness_.begin(domain_->state, time_);
}

void FlowLoop::restore(ResultsWriter& results, HistoryWriter& history) {
  const double start = secondsSinceStart();
  for (const auto& file : restart_->outputs) results.loadSteps(file);
  const auto count = static_cast<double>(std::max<std::size_t>(results.stepCount(), 1));
  wallLimit_.recordOutput((secondsSinceStart() - start) / count);
  history.row(earlierRows_);
  earlierRows_.clear();
}

std::string FlowLoop::writeCheckpoint(Outputs& outputs) {
  const Timers::Scope scope(timers_, "checkpoints");
  const double start = secondsSinceStart();
  try {
    outputs.checkpoints.write(domain_->mesh, steps_, outputs.results, [&](CheckpointWriter& archive) {
      std::vector<double> rows = outputs.history.rows();
      saveOrLoad(archive, rows);
      tables_->save(archive);
    });
  } catch (const SystemError& error) {
    return fmt::format("no checkpoint at step {}: {}", steps_, error.what());
  }
  wallLimit_.recordCheckpoint(secondsSinceStart() - start);
  return "";
}

std::string FlowLoop::saveLastState(Outputs& outputs) {
  std::string checkpoint = writeCheckpoint(outputs);
  if (checkpoint.empty()) checkpoint = fmt::format("--restart goes on from {}", outputs.checkpoints.last().string());
  if (written_ != steps_) {
    if (last_.step != steps_) writeRow(outputs.history);
    output(outputs.results);
  }
  outputs.history.writeTo(outputs.results);
  tables_->writeTo(outputs.results);
  outputs.results.closePartial();
  return fmt::format("the fields until then are in {}; {}", outputs.folder.partialResults().string(), checkpoint);
}

std::string FlowLoop::mistakeAtWalls() const {
  const std::string warning = domain_->turbulence ? domain_->turbulence->warning() : "";
  return warning.empty() ? "" : "; " + warning;
}

void FlowLoop::stop(Outputs& outputs) {
  const std::string where = fmt::format("at t = {:.6g} s, step {}: {}", time_, steps_, saveLastState(outputs));
  if (requests_.signal != 0) raiseStopped(comm_, requests_.signal, where);
  raiseStopped(comm_, fmt::format("time.wall_limit of {}", formatDuration(case_.time.wallLimit.value_or(0.0))), where);
}

void FlowLoop::output(ResultsWriter& results) {
  const Timers::Scope scope(timers_, "output");
  const double start = secondsSinceStart();
  written_ = steps_;
  writeFields(results, domain_->context, case_, domain_->state, operators_, steps_, time_);
  tables_->outputRows({steps_, time_}, tableSource());
  wallLimit_.recordOutput(secondsSinceStart() - start);
}

ReactionOperator::Options FlowLoop::withFailedCellFiles(ReactionOperator::Options options) {
  options.keepFailed = [this](std::int64_t cell, const FailedCell& failed) {
    return keepFailedCell(folder_.value(), *case_.mechanism, cell, failed);
  };
  return options;
}

}  // namespace lampblack::app
