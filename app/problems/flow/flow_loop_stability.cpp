// Whether the flow stays in the steady state that was found: what is found of it, and what it tells.
#include <fmt/format.h>

#include <cmath>

#include "app/problems/flow/disturbed_flow.hpp"
#include "app/problems/flow/flow_loop.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "io/json.hpp"

namespace lampblack::app {
namespace {

// The time of a march: of the residence time.
constexpr double ofResidenceTime = 1.0 / 40.0;
// Of the velocity with which the gas passes the domain: slow.
constexpr double slowVelocity = 1e-2;

std::string modeText(const Mode& mode) {
  const std::string rate = fmt::format("{} at {:.4g} 1/s, known to {:.1g} 1/s",
                                       mode.growthRate > 0 ? "grows" : "decays", std::abs(mode.growthRate), mode.error);
  return mode.frequency > 0.0 ? fmt::format("{}, and oscillates at {:.4g} Hz", rate, mode.frequency) : rate;
}

}  // namespace

void FlowLoop::findStability() {
  if (!search_ || !case_.time.search->stability || !search_->isSteady()) return;
  const TimeControl::Stability& asked = *case_.time.search->stability;
  const Timers::Scope scope(timers_, "stability");
  Stability found;
  found.time = asked.time.value_or(ofResidenceTime * steadiness_.time());
  try {
    if (!std::isfinite(found.time))
      throw NumericsError("the flow's residence time is not known yet; expected 'time.steady.stability.time'");
    const double slow = slowVelocity * steadiness_.lengthOfDomain() / steadiness_.time();
    DisturbedFlow flow(*domain_, case_, thermo_, transport_, found.time, slow);
    found.step = flow.step();
    found.modes = leadingModes(comm_, flow.marched(), flow.start(), asked.modes);
    stability_ = std::move(found);
  } catch (const NumericsError& error) {  // of all ranks alike; the state is what it is
    if (domain_->mesh.ranks > 1 && !isCollective(error)) throw;
    printWarnings({fmt::format("whether the steady state lasts is not known: {}", error.what())});
  }
}

std::vector<std::string> FlowLoop::stabilityLines() const {
  if (!stability_) return {};
  const LeadingModes& found = stability_->modes;
  std::vector<std::string> lines;
  const std::string how = fmt::format("{} disturbances over {:.3g} s in steps of {:.3g} s", found.vectors,
                                      stability_->time, stability_->step);
  lines.push_back(fmt::format(
      "{} ({})",
      found.grows()    ? "the least disturbance of the steady state grows, and the flow leaves it"
      : found.decays() ? "disturbances of the steady state decay: the flow stays in it"
                       : "whether disturbances of the steady state grow is not decided; more vectors or a longer time "
                         "(time.steady.stability) may tell",
      how));
  for (const Mode& mode : found.modes) lines.push_back("a disturbance " + modeText(mode));
  return lines;
}

void FlowLoop::addStability(JsonWriter& json) const {
  if (!stability_) return;
  const LeadingModes& found = stability_->modes;
  json.key("stability").beginObject();
  json.key("stable");
  if (found.grows() || found.decays())
    json.value(found.decays());
  else
    json.null();
  json.field("vectors", static_cast<std::int64_t>(found.vectors)).field("march_s", stability_->time);
  json.field("step_s", stability_->step);
  const auto list = [&](const char* name, double Mode::*value) {
    json.key(name).beginArray();
    for (const Mode& mode : found.modes) json.value(mode.*value);
    json.endArray();
  };
  list("growth_rates_per_s", &Mode::growthRate);
  list("frequencies_hz", &Mode::frequency);
  list("errors_per_s", &Mode::error);
  json.endObject();
}

void FlowLoop::writeStability(ResultsWriter& results) const {
  if (!stability_) return;
  const auto write = [&](const char* path, double Mode::*value, const char* unit, const char* description) {
    std::vector<double> values;
    for (const Mode& mode : stability_->modes.modes) values.push_back(mode.*value);
    results.dataset(path, {static_cast<std::int64_t>(values.size())}, values, unit, description);
  };
  write("/stability/growth_rate", &Mode::growthRate, "1/s", "of the disturbances of the steady state that lead");
  write("/stability/frequency", &Mode::frequency, "Hz", "of their oscillation; zero: none");
  write("/stability/error", &Mode::error, "1/s", "of the growth rate and of the angular frequency");
}

}  // namespace lampblack::app
