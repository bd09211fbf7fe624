// What a flow's run keeps and tells on its way: rows of the history, fields, checkpoints.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "app/problems/flow/flow_loop.hpp"
#include "app/run/failed_cell.hpp"
#include "app/run/recorded_run.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "core/system_error.hpp"
#include "core/wall_clock.hpp"

namespace lampblack::app {
namespace {

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
  lastRow_ = steps_;
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

void FlowLoop::writeLastState(Outputs& outputs) {
  if (search_ && norms_.empty()) {
    norms_ = residualNow();
    normsOf_ = steps_;
  }
  if (last_.step != steps_) {
    if (written_ == steps_ || lastRow_ == steps_)
      observe();
    else
      writeRow(outputs.history);
  }
  if (written_ != steps_) output(outputs.results);
}

std::string FlowLoop::saveLastState(Outputs& outputs) {
  std::string checkpoint = writeCheckpoint(outputs);
  if (checkpoint.empty()) checkpoint = fmt::format("--restart goes on from {}", outputs.checkpoints.last().string());
  writeLastState(outputs);
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
