// The branch of steady states along a load that goes through the one that was found: what is found of it, and what it
// tells.
#include <fmt/format.h>

#include <cstdio>

#include "app/problems/flow/flow_loop.hpp"
#include "io/csv.hpp"
#include "io/json.hpp"

namespace lampblack::app {
namespace {

constexpr const char* table = "/continuation";

std::string whatOf(const TimeControl::Branch& of) {
  return "factor on " + (of.key.empty() ? "the velocities of the inlets" : of.key);
}

std::vector<Quantity> branchColumns(const TimeControl::Branch& of) {
  std::vector<Quantity> columns{
      {"load", "1", whatOf(of)},
      {"maximum_temperature", "K", "largest temperature"},
      {"heat_release", "W", "of the domain, per metre of depth or radian of two dimensions"},
      {"residual", "1", "largest residual of any equation, of its throughflow; of the first the limit"},
      {"iterations", "1", "taken to find the state, those of steps that found none before it too"}};
  if (!of.key.empty()) columns.push_back({"value", of.unit, "of " + of.key});
  return columns;
}

std::vector<double> rowsOf(const FlowBranch& branch, const TimeControl::Branch& of) {
  std::vector<double> rows;
  for (const FlowBranch::Point& point : branch.points()) {
    rows.insert(rows.end(), {point.load, point.peakTemperature, point.heatRelease, point.residual,
                             static_cast<double>(point.iterations)});
    if (!of.key.empty()) rows.push_back(point.load * of.start);
  }
  return rows;
}

}  // namespace

void FlowLoop::followBranch(Outputs& outputs) {
  if (!search_ || !case_.time.search->branch || !search_->isSteady()) return;
  const Timers::Scope scope(timers_, "branch");
  StateBackup found(domain_->mesh.owned, domain_->mesh.faces);
  const auto parts = [this](StateArchive& archive) { saveOrLoadParts(archive); };
  found.save(parts);
  const TimeControl::Branch& of = *case_.time.search->branch;
  const bool tells = domain_->mesh.rank == 0;
  if (tells) fmt::print("\nbranch: {}, largest temperature, heat release, iterations\n", whatOf(of));
  branch_.emplace(domain_->context, domain_->state, case_.flow.velocityScheme, operators_, steadiness_.time(), of);
  branch_->follow([&](const FlowBranch::Point& point) {
    if (tells) {
      fmt::print("  {:>12.6g} {:>10.2f} K {:>12.6g} W {:>5}\n", point.load, point.peakTemperature, point.heatRelease,
                 point.iterations);
      std::fflush(stdout);
      writeFileAtomically(outputs.folder.file("branch.csv"), csvTable(branchColumns(of), rowsOf(*branch_, of)));
    }
    checkStateAndRequests(outputs.checkpoints);
    return requests_.signal != 0 || requests_.wallLimit;
  });
  branch_->unload();
  found.restore(parts);
  domain_->state.updateHalo(domain_->halo);
  domain_->adopt(case_);
  if (requests_.signal != 0 || requests_.wallLimit) stop(outputs);
}

std::vector<std::string> FlowLoop::branchLines() const {
  if (!branch_) return {};
  const TimeControl::Branch& of = *case_.time.search->branch;
  const auto valueText = [&](double load) {
    return of.key.empty() ? "" : fmt::format(" ({} {:.6g} {})", of.key, load * of.start, of.unit);
  };
  std::vector<std::string> lines;
  for (const TurningPoint& turn : branch_->turningPoints())
    lines.push_back(fmt::format("the branch turns at the {} load {:.5g}{}, where the largest temperature is {:.1f} K",
                                turn.highest ? "largest" : "least", turn.load, valueText(turn.load),
                                branch_->points().at(turn.index).peakTemperature));
  lines.push_back(fmt::format("the branch ends with {} states: {}", branch_->points().size(), branch_->reason()));
  return lines;
}

void FlowLoop::addBranch(JsonWriter& json) const {
  if (!branch_) return;
  json.key("branch").beginObject();
  if (const std::string& key = case_.time.search->branch->key; !key.empty()) json.field("key", key);
  json.field("points", static_cast<std::int64_t>(branch_->points().size()));
  json.field("complete", branch_->isComplete());
  json.field("reason", branch_->reason());
  for (const TurningPoint& turn : branch_->turningPoints()) {
    if (!turn.highest) continue;
    json.field("extinction_load", turn.load);
    json.field("extinction_temperature_K", branch_->points().at(turn.index).peakTemperature);
    break;
  }
  json.endObject();
}

void FlowLoop::writeBranch(ResultsWriter& results) const {
  if (!branch_) return;
  const TimeControl::Branch& of = *case_.time.search->branch;
  results.table(table, branchColumns(of), rowsOf(*branch_, of));
  std::vector<double> turns;
  for (const TurningPoint& turn : branch_->turningPoints())
    turns.insert(turns.end(), {turn.load, turn.highest ? 1.0 : 0.0, static_cast<double>(turn.index)});
  results.table(fmt::format("{}/turning_points", table),
                {{"load", "1", whatOf(of)},
                 {"highest", "1", "1: the load is highest here (extinction); 0: lowest (ignition)"},
                 {"point", "1", "number of the state of the branch nearest to it, from 0"}},
                turns);
  results.attribute(table, "complete", static_cast<std::int64_t>(branch_->isComplete() ? 1 : 0));
  results.attribute(table, "reason", branch_->reason());
}

}  // namespace lampblack::app
