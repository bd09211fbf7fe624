#include "app/problems/flame/flame_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/problems/flame/flame_file.hpp"
#include "core/errors.hpp"
#include "io/csv.hpp"
#include "io/table.hpp"

namespace lampblack::app {
namespace {

struct Field {
  const char *name, *unit, *description;
  std::vector<double> FlameFields::*values;
};

const std::vector<Field>& fieldsOfAPoint() {
  static const std::vector<Field> table{
      {"z", "m", "distance from the left end", &FlameFields::z},
      {"temperature", "K", "gas temperature", &FlameFields::temperature},
      {"velocity", "m/s", "axial velocity, towards larger z", &FlameFields::velocity},
      {"density", "kg/m^3", "gas density", &FlameFields::density},
      {"mass_flux", "kg/m^2/s", "density times velocity", &FlameFields::massFlux},
      {"spread", "1/s", "V = radial velocity over radius", &FlameFields::spread},
      {"heat_release", "W/m^3", "heat set free by the gas reactions", &FlameFields::heatRelease},
      {"viscosity", "Pa s", "dynamic viscosity", &FlameFields::viscosity},
      {"conductivity", "W/m/K", "thermal conductivity", &FlameFields::conductivity},
      {"cp", "J/kg/K", "heat capacity at constant pressure and composition", &FlameFields::cp},
      {"mean_molecular_weight", "kg/mol", "of the gas", &FlameFields::meanMolecularWeight},
  };
  return table;
}

struct StepCounts {
  std::size_t newton = 0, factorisations = 0, timeSteps = 0, residuals = 0;
};

StepCounts countsOf(const FlameSolution& solution) {
  StepCounts counts;
  for (const FlameStage& stage : solution.stages) {
    counts.newton += stage.newton.steps;
    counts.factorisations += stage.newton.factorisations;
    counts.timeSteps += stage.newton.timeSteps;
    counts.residuals += stage.newton.residuals;
  }
  return counts;
}

// Of what is conserved over what flows in of it; of an element that does not come in at all over the mass.
double relativeImbalance(const FlameBudget& budget, const std::vector<FlameBudget>& all) {
  double size = std::abs(budget.in);
  if (budget.name == "energy") size = std::max({size, std::abs(budget.out), std::abs(budget.wall)});
  for (const FlameBudget& mass : all)
    if (size == 0 && mass.name == "mass") size = std::abs(mass.in);
  return size > 0 ? budget.imbalance() / size : 0.0;
}

void writeFields(ResultsWriter& results, const FlameCase& flame, const FlameFields& f) {
  const auto points = static_cast<std::int64_t>(f.z.size());
  for (const Field& field : fieldsOfAPoint())
    results.dataset(fmt::format("/flame/{}", field.name), {points}, f.*field.values, field.unit, field.description);
  const std::size_t n = flame.mechanism->numSpecies();
  std::vector<double> values(f.z.size());
  for (const bool mole : {true, false})
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = (mole ? f.X : f.Y)[i * n + k];
      const std::string& name = flame.mechanism->speciesName(k);
      results.dataset(fmt::format("/flame/{}/{}", mole ? "X" : "Y", name), {points}, values, "1",
                      (mole ? "mole fraction of " : "mass fraction of ") + name);
    }
}

void writeStages(ResultsWriter& results, const FlameSolution& solution) {
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  const TableOf<const FlameStage&> table{
      {{"points", "1", "points of the grid"}, [&](const auto& s) { return count(s.points); }},
      {{"newton_steps", "1", "Newton steps"}, [&](const auto& s) { return count(s.newton.steps); }},
      {{"time_steps", "1", "pseudo-transient steps"}, [&](const auto& s) { return count(s.newton.timeSteps); }},
      {{"factorisations", "1", "Newton matrices built and factorised"},
       [&](const auto& s) { return count(s.newton.factorisations); }},
      {{"residuals", "1", "evaluations of the equations by the solver"},
       [&](const auto& s) { return count(s.newton.residuals); }},
      {{"step_size", "1", "scaled size of the last Newton step"}, [](const auto& s) { return s.newton.stepSize; }},
      {{"worst_residual", "1", "scaled Newton correction at its worst unknown"},
       [](const auto& s) { return s.newton.worstResidual; }},
      {{"seconds", "s", "wall time"}, [](const auto& s) { return s.seconds; }}};
  std::vector<std::string> names, worst;
  for (const FlameStage& stage : solution.stages) {
    names.push_back(stage.name);
    worst.push_back(stage.newton.worst);
  }
  table.of(solution.stages).write(results, "/stages");
  results.texts("/stages/name", names, "what was solved");
  results.texts("/stages/worst", worst, "unknown with the largest scaled Newton correction");
}

void writeBudgets(ResultsWriter& results, const FlameSolution& solution) {
  const TableOf<const FlameBudget&> table{
      {{"in", "kg/m^2/s", "with the streams; of energy W/m^2"}, [](const auto& b) { return b.in; }},
      {{"out", "kg/m^2/s", "at the ends and sideways, by spreading; of energy W/m^2"},
       [](const auto& b) { return b.out; }},
      {{"wall", "kg/m^2/s", "deposited on burner or wall; of energy conducted into it, W/m^2"},
       [](const auto& b) { return b.wall; }},
      {{"radiated", "W/m^2", "lost by radiation"}, [](const auto& b) { return b.radiated; }},
      {{"given", "kg/m^2/s",
        "by what is computed apart, as ensembles coupled both ways; negative: taken; of energy W/m^2"},
       [](const auto& b) { return b.given; }},
      {{"imbalance", "kg/m^2/s", "in + given - out - wall - radiated"}, [](const auto& b) { return b.imbalance(); }},
      {{"relative_imbalance", "1", "over what comes in (of energy: over the largest of in, out and wall)"},
       [&](const auto& b) { return relativeImbalance(b, solution.budgets); }}};
  std::vector<std::string> names;
  for (const FlameBudget& budget : solution.budgets) names.push_back(budget.name);
  table.of(solution.budgets).write(results, "/budgets");
  results.texts("/budgets/name", names, "conserved quantity");
}

std::vector<std::string> speciesNames(const Mechanism& mechanism) {
  std::vector<std::string> names;
  for (const Species& species : mechanism.allSpecies()) names.push_back(species.name);
  return names;
}

}  // namespace

FlameResult flameResult(const FlameCase& flame, FlameSolution solution, bool converged) {
  FlameResult result;
  result.solution = std::move(solution);
  result.converged = converged;
  result.state = stateOf(*flame.mechanism, flame.problem, result.solution);
  try {
    result.fields = flameFields(*flame.mechanism, flame.problem, result.solution.profile);
    result.summary = flameSummary(flame.problem, result.solution.profile, result.fields);
    if (flame.soot)
      result.soot = flameSootFields(*flame.mechanism, flame.problem.pressure, *flame.soot, result.solution.profile,
                                    result.fields);
  } catch (const NumericsError&) {
    if (converged) throw;
    result.fields = {};
  }
  return result;
}

std::vector<NamedNumber> namedNumbers(const FlameCase& flame, const FlameResult& result) {
  std::vector<NamedNumber> numbers;
  const FlameSummary& s = result.summary;
  if (!result.fields.z.empty()) {
    if (flame.problem.type == FlameType::Free) numbers.push_back({"flame_speed", "m/s", s.leftVelocity});
    numbers.push_back({"maximum_temperature", "K", s.maximumTemperature});
    numbers.push_back({"position_of_maximum_temperature", "m", s.positionOfMaximum});
    numbers.push_back({"thermal_thickness", "m", s.thermalThickness});
    numbers.push_back({"heat_release", "W/m^2", s.heatRelease});
    numbers.push_back({"maximum_mach_number", "1", s.maximumMach});
    if (result.solution.burnerHeatFlux)
      numbers.push_back({"burner_heat_flux", "W/m^2", *result.solution.burnerHeatFlux});
    if (s.strain) {
      if (s.strain->global) numbers.push_back({"strain_global", "1/s", *s.strain->global});
      numbers.push_back({"strain_maximum", "1/s", s.strain->maximum});
      numbers.push_back({"strain_mean", "1/s", s.strain->mean});
      numbers.push_back({"strain_left", "1/s", s.strain->left});
      numbers.push_back({"strain_right", "1/s", s.strain->right});
      numbers.push_back({"pressure_gradient", "N/m^4", s.pressureGradient});
    }
    if (s.stagnationPlane) numbers.push_back({"stagnation_plane", "m", *s.stagnationPlane});
    if (result.soot) {
      for (NamedNumber& number : namedSootNumbers(result.fields, *result.soot)) numbers.push_back(std::move(number));
      if (!result.soot->diameter.empty()) numbers.push_back({"soot_in_last_section", "1", result.soot->partAtLimit});
      if (const auto& wall = result.solution.deposition) {
        numbers.push_back({"soot_deposition_on_wall", "kg/m^2/s", wall->rate});
        numbers.push_back({"thermophoretic_velocity_at_wall", "m/s", wall->thermophoresis});
      }
    }
  }
  if (result.solution.growthRate) numbers.push_back({"growth_rate", "1/s", *result.solution.growthRate});
  if (result.extinctionLoad) numbers.push_back({"last_burning_load", "1", *result.extinctionLoad});
  const StepCounts counts = countsOf(result.solution);
  const auto add = [&](const char* name, std::size_t value) {
    numbers.push_back({name, "1", static_cast<double>(value)});
  };
  add("starts", result.solution.starts);
  add("points", result.solution.profile.points());
  add("newton_steps", counts.newton);
  add("time_steps", counts.timeSteps);
  add("factorisations", counts.factorisations);
  add("residuals", counts.residuals);
  double worst = 0;
  for (const FlameBudget& budget : result.solution.budgets)
    worst = std::max(worst, std::abs(relativeImbalance(budget, result.solution.budgets)));
  if (!result.solution.budgets.empty()) numbers.push_back({"largest_relative_imbalance", "1", worst});
  if (flame.soot) numbers.push_back({"last_scalar_change", "1", result.solution.scalarChange});
  return numbers;
}

void writeFlame(ResultsWriter& results, const FlameCase& flame, const FlameResult& result) {
  if (!result.fields.z.empty()) writeFields(results, flame, result.fields);
  if (result.soot) writeFlameSoot(results, *result.soot);
  writeFlameProfile(results, {result.solution.profile, speciesNames(*flame.mechanism), flame.scalarNames()});
  results.attribute("/flame", "type", std::string(nameOf(flame.problem.type)));
  results.attribute("/flame", "title", flame.title);
  results.attribute("/flame", "converged", static_cast<std::int64_t>(result.converged ? 1 : 0));
  results.attribute("/flame", "flame_state", std::string(nameOf(result.state)));
  results.attribute("/flame", "pressure", flame.problem.pressure);
  for (const NamedNumber& number : namedNumbers(flame, result)) results.attribute("/flame", number.name, number.value);
  writeStages(results, result.solution);
  writeBudgets(results, result.solution);
}

std::string flameTable(const FlameCase& flame, const FlameResult& result) {
  const FlameFields& f = result.fields;
  const std::size_t n = flame.mechanism->numSpecies();
  std::vector<std::string> names;
  std::vector<const std::vector<double>*> columns;
  for (const Field& field : fieldsOfAPoint()) {
    names.push_back(fmt::format("{} [{}]", field.name, field.unit));
    columns.push_back(&(f.*field.values));
  }
  if (result.soot) {
    for (const auto* fields : {&result.soot->properties, &result.soot->processes})
      for (const FlameSootFields::Field& field : *fields) {
        names.push_back(fmt::format("soot_{} [{}]", field.name, field.unit));
        columns.push_back(&field.values);
      }
  }
  for (std::size_t k = 0; k < n; ++k) names.push_back(fmt::format("X_{} [1]", flame.mechanism->speciesName(k)));
  std::string text = csvLine(names);
  for (std::size_t i = 0; i < f.z.size(); ++i) {
    for (const auto* column : columns) text += fmt::format("{}{}", column == columns[0] ? "" : ",", (*column)[i]);
    for (std::size_t k = 0; k < n; ++k) text += fmt::format(",{}", f.X[i * n + k]);
    text += '\n';
  }
  return text;
}

}  // namespace lampblack::app
