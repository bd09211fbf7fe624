// What a one-dimensional flame says to its user: stages as they end, the closing report, the record's numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/problems/flame/flame_output.hpp"
#include "io/report.hpp"

namespace lampblack::app {
namespace {

// "m/s" as part of a name: "m_per_s".
std::string unitInName(const std::string& unit) {
  if (unit == "1") return "";
  std::string text;
  for (const char c : unit) {
    if (c == '/')
      text += text.empty() || text == "1" ? "per_" : "_per_";
    else if (c == ' ')
      text += '_';
    else if (c != '^' && !(c == '1' && text.empty()))
      text += c;
  }
  return "_" + text;
}

// What a user has to know of a flame that does not simply burn.
std::string stateText(const FlameResult& result) {
  switch (result.state) {
    case FlameState::Burning:
      return "";
    case FlameState::Inert:
      return "\nNothing burns: these streams are no fuel and oxidiser to each other.\n";
    case FlameState::UnstableBranch:
      return fmt::format(
          "\nAn unstable flame: the least disturbance grows at {:.3g} 1/s, and the flame goes out or flares up. No "
          "stable "
          "flame was\nfound from here; a burning flame at lower velocities can be the start of this one (initial: "
          "results.h5).\n",
          result.solution.growthRate.value_or(0));
    case FlameState::Out:
      break;
  }
  const std::string out = "\nThe flame is out: nothing is warmer than what flows in. ";
  if (result.extinctionLoad)
    return out + fmt::format("Followed from lower velocities, burning flames end at {:.4g} of this strain.\n",
                             *result.extinctionLoad);
  return out + "No burning flame was found from lower velocities, either.\n";
}

constexpr double lowMach = 0.3;

// A column for what ensembles give the gas where there are such.
std::string budgetText(const std::vector<FlameBudget>& budgets) {
  if (budgets.empty()) return "";
  const bool given = std::any_of(budgets.begin(), budgets.end(), [](const FlameBudget& b) { return b.given != 0; });
  std::string text = fmt::format("\nBudgets{:>18} {:>13} {:>13} {:>13}", "in", "out", "wall", "radiated");
  if (given) text += fmt::format(" {:>13}", "by ensembles");
  text += fmt::format(" {:>10}\n", "imbalance");
  for (const FlameBudget& b : budgets) {
    if (b.in == 0 && std::abs(b.out) < 1e-20) continue;  // an element that is not there
    text += fmt::format("  {:<10} {:>13.6e} {:>13.6e} {:>13.6e} {:>13.6e}", b.name, b.in, b.out, b.wall, b.radiated);
    if (given) text += fmt::format(" {:>13.6e}", b.given);
    text += fmt::format(" {:>10.1e}\n", b.imbalance());
  }
  return text;
}

}  // namespace

std::string stageLine(const FlameStage& stage) {
  std::string text =
      fmt::format("{:<28} {:>5} points  {:>4} Newton steps", stage.name, stage.points, stage.newton.steps);
  text += stage.newton.timeSteps > 0 ? fmt::format("  {:>4} time steps", stage.newton.timeSteps) : std::string(17, ' ');
  return text + fmt::format("  {}\n", formatDuration(stage.seconds));
}

void recordNumbers(JsonWriter& json, const std::vector<NamedNumber>& numbers) {
  for (const NamedNumber& number : numbers) json.field(number.name + unitInName(number.unit), number.value);
}

std::string numbersText(const std::vector<NamedNumber>& numbers) {
  std::string text;
  for (const NamedNumber& number : numbers) {
    std::string name = number.name;
    std::replace(name.begin(), name.end(), '_', ' ');
    text += fmt::format("  {:<42} {:.6g}{}\n", name, number.value, number.unit == "1" ? "" : " " + number.unit);
  }
  return text;
}

void recordFlame(JsonWriter& json, const FlameCase& flame, const FlameResult& result) {
  json.field("type", nameOf(flame.problem.type)).field("converged", result.converged);
  if (result.converged) json.field("flame_state", nameOf(result.state));
  recordNumbers(json, namedNumbers(flame, result));
  const auto& counters = result.solution.counters;
  json.field("jacobians", static_cast<std::uint64_t>(counters.jacobians));
  json.field("jacobian_points", static_cast<std::uint64_t>(counters.jacobianPoints));
  json.field("residual_s", counters.residualSeconds).field("jacobian_s", counters.jacobianSeconds);
  json.field("factorise_s", counters.factoriseSeconds).field("solve_s", counters.solveSeconds);
}

std::string flameReport(const FlameCase& flame, const FlameResult& result) {
  std::string text = numbersText(namedNumbers(flame, result));
  text += stateText(result);
  if (result.solution.scalarChange > flame.solver.scalarChange)
    text += fmt::format(
        "\nWhat is carried still moved by {:.1e} of its largest value in the last of the last steps, more than "
        "{:.0e}:\n"
        "its values between points have not settled. A finer grid may help.\n",
        result.solution.scalarChange, flame.solver.scalarChange);
  if (result.summary.maximumMach > lowMach)
    text += fmt::format(
        "\nThe gas reaches a Mach number of {:.2g}: beyond {} the equations, which know no sound, are wrong.\n",
        result.summary.maximumMach, lowMach);
  text += budgetText(result.solution.budgets);
  const auto& c = result.solution.counters;
  double total = 0;
  for (const FlameStage& stage : result.solution.stages) total += stage.seconds;
  const auto share = [&](const char* what, double seconds) {
    text += fmt::format("  {:<24} {:>10.3f} {:>7.1f}\n", what, seconds, total > 0 ? 100 * seconds / total : 0.0);
  };
  text += fmt::format("\nTime, s{:>28} {:>7}\n", "", "%");
  share("residuals", c.residualSeconds);
  share("Newton matrices", c.jacobianSeconds);
  share("factorisation", c.factoriseSeconds);
  share("solution", c.solveSeconds);
  share("other", std::max(0.0, total - c.residualSeconds - c.jacobianSeconds - c.factoriseSeconds - c.solveSeconds));
  share("total", total);
  if (c.jacobians > 0 && c.jacobianPoints > 0) {
    const double points = static_cast<double>(c.jacobianPoints);
    text += fmt::format(
        "\n{} Newton matrices, {:.0f} points each: {:.1f} us a point to build, {:.1f} us to factorise\n", c.jacobians,
        points / static_cast<double>(c.jacobians), 1e6 * c.jacobianSeconds / points, 1e6 * c.factoriseSeconds / points);
  }
  return text;
}

}  // namespace lampblack::app
