// What the search for the steady state of a flow tells: columns of the history, the line of progress, the report.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/problems/flow/flow_loop.hpp"
#include "io/json.hpp"

namespace lampblack::app {
namespace {

// "mass_fluxes" of "mass fluxes".
std::string columnName(std::string equation) {
  std::ranges::replace(equation, ' ', '_');
  return "residual_" + equation;
}

}  // namespace

std::vector<Quantity> FlowLoop::searchColumns() const {
  std::vector<Quantity> columns{{"iteration", "1", "iterations so far; of a row that is one, time stands still"}};
  columns.push_back({"newton_vectors", "1", "Krylov vectors of a step of Newton's method in this iteration"});
  columns.push_back({"newton_taken_back", "1", "whether that step was taken back, and another iteration made"});
  if (std::ranges::any_of(domain_->state.scalars, &CarriedScalar::isTransported))
    columns.push_back(
        {"held_cells", "1", "cells in which limits held back the last change of what is carried in this iteration"});
  const auto add = [&](const std::string& equation, const std::string& what) {
    columns.push_back({columnName(equation), "1", "what is left of " + what + ", of what goes through"});
  };
  add("mass", "the balance of mass");
  add("mass fluxes", "the mass fluxes of the faces");
  add("momentum", "the balance of momentum");
  if (domain_->state.swirls) add("swirl", "the balance of angular momentum");
  add("enthalpy", "the balance of enthalpy");
  add("species", "the balance of the species that has most");
  if (std::ranges::any_of(domain_->state.scalars, &CarriedScalar::isTransported))
    add("carried", "the balance of the carried scalar that has most");
  return columns;
}

std::vector<double> FlowLoop::searchValues() const {
  std::vector<double> values{static_cast<double>(search_->iterations())};
  const SteadyIteration::Outcome last = iteration_ ? iteration_->last() : SteadyIteration::Outcome{};
  values.push_back(last.newtonIterations);
  values.push_back(last.newtonTakenBack ? 1.0 : 0.0);
  if (std::ranges::any_of(domain_->state.scalars, &CarriedScalar::isTransported))
    values.push_back(heldCellsOf_ == steps_ ? static_cast<double>(heldCells_) : 0.0);
  if (normsOf_ == steps_)
    for (const ResidualNorm& norm : worstOfEachKind(norms_)) values.push_back(norm.value);
  values.resize(searchColumns().size(), std::numeric_limits<double>::quiet_NaN());
  return values;
}

std::string FlowLoop::searchPlace() const {
  if (isTurnOfParticles())
    return fmt::format("step {:>6}  ensembles, round {}  t {:.4g} s  dt {:.3g} s", steps_, rounds_->rounds() + 1, time_,
                       dt_);
  if (iteration_) return fmt::format("step {:>6}  iteration {}", steps_, search_->iterations());
  return fmt::format("step {:>6}  t {:.4g} s  dt {:.3g} s", steps_, time_, dt_);
}

double FlowLoop::searchProgress() const {
  if (!isTurnOfParticles()) return search_->progress();
  return static_cast<double>(domain_->ensembles->averagedBlocks()) / static_cast<double>(rounds_->blocks());
}

std::vector<std::string> FlowLoop::searchLines() const {
  const std::string back = search_->returns() > 0 ? fmt::format(", {} times back to steps", search_->returns()) : "";
  const std::string lit = search_->lightings() > 0 ? fmt::format(", {} times lit", search_->lightings()) : "";
  const std::string early = search_->isAttempt() && isSteady()
                                ? ", before the heat release was quiet (where a flow has several steady states, one in "
                                  "time may end in another: "
                                  "time.steady.attempts=0)"
                                : "";
  const std::string takenBack =
      search_->attempts() > 0 ? fmt::format(", {} of which were taken back", search_->iterationsTakenBack()) : "";
  const std::string first = search_->firstResidual() > 0.0
                                ? fmt::format("{:.2e} before the first iteration, ", search_->firstResidual())
                                : "";
  std::vector<std::string> lines;
  for (const TimeControl::Search::Coarser& coarser : case_.time.search->coarser)
    lines.push_back(
        fmt::format("on a coarser mesh of {} cells {} after {} steps in time and {} iterations, {:.3g} s of "
                    "processor{}",
                    coarser.cells, coarser.isSteady ? "steady" : "not steady", coarser.steps, coarser.iterations,
                    coarser.processorTime, coarser.isStart ? "" : "; nothing burns there: no start of the next"));
  lines.push_back(fmt::format(
      "{} (time.steady.residual {:.2g}) after {} steps in time, to t = {:.6g} s{}, and {} iterations{}{}{}; "
      "largest residual {}{:.2e} now",
      isSteady() ? "steady" : "not steady", search_->options().residual, search_->steps(), time_, early,
      search_->iterations(), takenBack, back, lit, first, largestNorm()));
  if (heldCells_ > 0)
    lines.push_back(fmt::format(
        "in {} cells limits held back what the last iteration would have made of what is carried (held_cells in "
        "history.csv): there it has not settled, however small its residual",
        heldCells_));
  lines.push_back(fmt::format("processor time of the steps in time {:.3g} s, of the iterations {:.3g} s",
                              processorTime(ProcessorTimeOf::Steps), processorTime(ProcessorTimeOf::Iterations)));
  for (const std::string& line : roundLines()) lines.push_back(line);
  return lines;
}

void FlowLoop::tellSearch() {
  MPI_Allreduce(MPI_IN_PLACE, processorTime_.data(), static_cast<int>(processorTime_.size()), MPI_DOUBLE, MPI_SUM,
                comm_);
  if (domain_->mesh.rank != 0) return;
  for (const std::string& line : searchLines()) fmt::print("{}\n", line);
}

TimeControl::Search::Coarser FlowLoop::searchAsCoarser() const {
  return {cells(),
          search_->isSteady(),
          burnsOrCannot(),
          search_->steps(),
          search_->iterations(),
          processorTime(ProcessorTimeOf::Steps) + processorTime(ProcessorTimeOf::Iterations)};
}

void FlowLoop::addSearch(JsonWriter& json) const {
  json.key("search").beginObject();
  json.field("steps_in_time", static_cast<std::int64_t>(search_->steps()));
  json.field("iterations", static_cast<std::int64_t>(search_->iterations()));
  json.field("attempts_taken_back", static_cast<std::int64_t>(search_->attempts()));
  json.field("iterations_taken_back", static_cast<std::int64_t>(search_->iterationsTakenBack()));
  json.field("found_early", search_->isAttempt() && isSteady());
  json.field("returns_to_steps", static_cast<std::int64_t>(search_->returns()));
  json.field("times_lit", static_cast<std::int64_t>(search_->lightings()));
  json.field("held_cells", heldCells_);
  json.field("residual_before_iterations", search_->firstResidual()).field("last_residual", largestNorm());
  json.field("processor_time_of_steps_s", processorTime(ProcessorTimeOf::Steps));
  json.field("processor_time_of_iterations_s", processorTime(ProcessorTimeOf::Iterations));
  if (rounds_) addRounds(json);
  json.key("coarser_meshes").beginArray();
  for (const TimeControl::Search::Coarser& coarser : case_.time.search->coarser) {
    json.beginObject().field("cells", coarser.cells).field("steady", coarser.isSteady);
    json.field("is_start", coarser.isStart);
    json.field("steps_in_time", static_cast<std::int64_t>(coarser.steps));
    json.field("iterations", static_cast<std::int64_t>(coarser.iterations));
    json.field("processor_time_s", coarser.processorTime).endObject();
  }
  json.endArray();
  json.endObject();
}

}  // namespace lampblack::app
