// The section time.steady.continuation of a flow's deck: the branch of steady states, and the key that it goes along.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/deck/temperature_input.hpp"
#include "app/problems/flow/flow_case_parts.hpp"
#include "core/nearest_name.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app::flowcase {
namespace {

constexpr const char* branchSection = "time.steady.continuation";
constexpr const char* loadedKey = "time.steady.continuation.key";
constexpr const char* ofBoundaries = "boundaries.";

// A value of a boundary: 'boundaries.fuel.velocity', 'boundaries.fuel.composition.CH4'.
class BoundaryKeyReader {
 public:
  BoundaryKeyReader(const Deck& deck, const FlowCase& flowCase, const std::string& key)
      : deck_(deck), flowCase_(flowCase) {
    const std::string rest = key.substr(std::string(ofBoundaries).size());
    const std::size_t dot = std::min(rest.find('.'), rest.size());
    const std::string name = rest.substr(0, dot);
    what_ = rest.substr(std::min(dot + 1, rest.size()));
    const auto found = std::ranges::find(flowCase.boundaries, name, &BoundaryCondition::name);
    if (found == flowCase.boundaries.end()) {
      std::vector<std::string> names;
      for (const BoundaryCondition& boundary : flowCase.boundaries) names.push_back(boundary.name);
      throw deck.error(loadedKey, fmt::format("there is no boundary '{}'{}", name, didYouMean(name, names)));
    }
    boundary_ = &*found;
    number_ = static_cast<std::size_t>(found - flowCase.boundaries.begin());
  }

  void read(TimeControl::Branch& branch) const {
    const std::string species = what_.starts_with(ofComposition) ? what_.substr(ofComposition.size()) : std::string();
    branch.load.boundary = number_;
    if (what_ == "velocity") {
      requireInlet();
      branch.load.of = Load::Of::Velocity;
      branch.unit = "m/s";
      branch.start = boundary_->speed;
    } else if (what_ == "temperature") {
      if (boundary_->kind != BoundaryKind::Wall || !boundary_->isothermal) requireInlet();
      requireOneGas();
      branch.load.of = Load::Of::Temperature;
      branch.unit = "K";
      branch.start = boundary_->temperature;
    } else if (!species.empty()) {
      requireInlet();
      requireOneGas();
      branch.load.of = Load::Of::MoleFraction;
      branch.load.species = deck_.at(loadedKey, [&] { return flowCase_.mechanism->speciesIndex(species); });
      std::vector<double> X(boundary_->Y.size());
      Thermo(*flowCase_.mechanism).massToMole(boundary_->Y, X);
      branch.start = X[branch.load.species];
      if (branch.start >= 1.0)
        throw deck_.error(loadedKey, fmt::format("'{}' has nothing but {}: expected a trace of what is to take its "
                                                 "place in 'composition'",
                                                 boundary_->name, species));
    } else {
      throw deck_.error(loadedKey, fmt::format("expected 'velocity', 'temperature' or 'composition.' and a species "
                                               "behind the name of the boundary, found '{}'",
                                               what_));
    }
    if (branch.start == 0.0)
      throw deck_.error(loadedKey, fmt::format("the load is a factor on '{}' of the boundary '{}', which is zero there",
                                               what_, boundary_->name));
  }

 private:
  static constexpr std::string_view ofComposition = "composition.";

  void requireInlet() const {
    if (boundary_->kind != BoundaryKind::Inlet)
      throw deck_.error(loadedKey, fmt::format("'{}' is no inlet{}", boundary_->name,
                                               what_ == "temperature" ? ", nor a wall that has a temperature" : ""));
  }
  void requireOneGas() const {
    if (!boundary_->varies.gas.isEmpty())
      throw deck_.error(loadedKey, fmt::format("the gas of '{}' is given by formulas or a table; expected values in "
                                               "'temperature' and 'composition'",
                                               boundary_->name));
  }

  const Deck& deck_;
  const FlowCase& flowCase_;
  std::string what_;  // velocity, temperature, composition.CH4
  const BoundaryCondition* boundary_ = nullptr;
  std::size_t number_ = 0;
};

void readKey(const Deck& deck, const FlowCase& flowCase, TimeControl::Branch& branch) {
  const auto hasKind = [&](BoundaryKind kind) {
    return std::ranges::any_of(flowCase.boundaries, [kind](const auto& b) { return b.kind == kind; });
  };
  if (branch.key.empty()) {
    if (!hasKind(BoundaryKind::Inlet))
      throw deck.error(branchSection, "the load is a factor on the velocities of inlets, and there is none");
  } else if (branch.key == "pressure") {
    if (!hasKind(BoundaryKind::Outlet))
      throw deck.error(loadedKey, "a vessel without an outlet has a pressure that follows from what is in it");
    branch.load.of = Load::Of::Pressure;
    branch.unit = "Pa";
    branch.start = flowCase.pressure;
  } else if (branch.key.starts_with(ofBoundaries)) {
    BoundaryKeyReader(deck, flowCase, branch.key).read(branch);
  } else {
    throw deck.error(loadedKey, fmt::format("expected 'pressure', or a value of a boundary such as "
                                            "'boundaries.fuel.temperature', found '{}'",
                                            branch.key));
  }
}

DeckKeys<TimeControl::Branch> branchKeys() {
  using Branch = TimeControl::Branch;
  DeckKeys<Branch> keys(branchSection);
  keys.section(Presence::optional,
               "The branch of steady states along a load, a factor on the velocities of all inlets or on 'key', from "
               "the one that was found (load 1) round its turning points (extinction, ignition). The run's fields are "
               "those of load 1; the branch is a table.",
               {{"time.mode", {"steady"}}});
  keys.text("key", &Branch::key, rules().optional(),
            "What the load is a factor on: 'pressure', or of a boundary NAME 'boundaries.NAME.velocity' (of "
            "one inlet), 'boundaries.NAME.temperature' (of an inlet or a wall), "
            "'boundaries.NAME.composition.SPECIES' (a mole fraction of an inlet, the others of which share "
            "the rest as before). What inlets bring of turbulence stays as it is. Absent: the velocities of "
            "all inlets.");
  keys.choice("towards", &Branch::towardsHigherLoad, {{"higher", true}, {"lower", false}}, rules(),
              "Whether the load rises or falls at the start of the branch.");
  keys.number("lowest_load", &Branch::lowestLoad, rules().atLeast(0), "The branch ends where the load is below this.");
  keys.number("highest_load", &Branch::highestLoad, rules().optional().above(0),
              "The branch ends where the load is above this.");
  keys.quantity("lowest_temperature", units::temperature, &Branch::lowestPeakTemperature, temperatureRules().optional(),
                "The branch ends where the largest temperature is below this.");
  keys.integer("turning_points", &Branch::turningPoints, rules().atLeast(1),
               "The branch ends after this number of turning points; from a burning flame the first is extinction.");
  keys.integer("maximum_points", &Branch::points, rules().atLeast(2), "The branch ends after this number of states.");
  keys.number("first_step", &Branch::firstStep, rules().above(0).below(1),
              "Change of the load from the first state of the branch to the second, over the load of the first.");
  keys.integer("iterations", &Branch::iterations, rules().atLeast(1),
               "Iterations for a state of the branch, after which a shorter step is tried.");
  return keys;
}

}  // namespace

std::optional<TimeControl::Branch> readBranch(const Deck& deck, const TimeControl::Search& search,
                                              const FlowCase& flowCase) {
  if (!deck.has(branchSection)) return {};
  TimeControl::Branch options = branchKeys().read(deck);
  readKey(deck, flowCase, options);
  if (options.lowestLoad >= 1.0 || options.highestLoad <= 1.0)
    throw deck.error(branchSection,
                     "the branch begins with a load of one: expected 'lowest_load' below it, and "
                     "'highest_load' above it");
  options.residual = search.residual;
  return options;
}

void addBranchKeys(DeckSchema& schema) {
  schema.add(branchKeys().schema());
}

}  // namespace lampblack::app::flowcase
