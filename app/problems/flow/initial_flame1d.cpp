#include "app/problems/flow/initial_flame1d.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "core/errors.hpp"
#include "io/deck_keys.hpp"
#include "io/grid_table.hpp"

namespace lampblack::app::flowcase {
namespace {

std::optional<units::Dimension> dimensionOf(const std::string& column) {
  if (column == "temperature") return units::temperature;
  if (column == "velocity") return units::velocity;
  if (column == "spread") return units::frequency;
  if (column.starts_with("X_")) return units::dimensionless;
  return std::nullopt;
}

}  // namespace

void addInitialFlameKeys(DeckSchema& schema) {
  SectionKeys keys("initial.flame1d");
  keys.section(Presence::optional, "A one-dimensional flame to start from, laid over the mesh; 'layer' is none.");
  keys.text("file", rules(), "profile.csv of a run of problem flame1d, relative to the deck.");
  keys.choice("axis", {"r", "z", "x", "y"}, rules(), "Axis of the mesh that the flame's z lies along.");
  keys.quantity("origin", units::length, rules().byDefault("0 m"), "Coordinate on the axis where the flame has z = 0.");
  schema.add(keys.schema());
}

InitialFields readInitialFlame(const Deck& deck, const FlowCase& flowCase) {
  const std::string section = "initial.flame1d.", file = section + "file";
  const AxisNames names = axisNames(flowCase);
  const auto named = std::ranges::find(names, deck.choice(section + "axis"));
  if (named == names.end()) throw deck.error(section + "axis", axesText(names));
  const auto axis = static_cast<std::size_t>(named - names.begin());
  const double origin = deck.quantity(section + "origin");
  try {
    const auto profile = std::make_shared<GridTable>(
        deck.resolvePath(deck.string(file)), std::vector<GridTable::Coordinate>{{"z", units::length}}, dimensionOf);
    if (!profile->has("temperature")) throw InputError("the profile has no column 'temperature'");
    InitialFields fields;
    for (std::size_t column = 0; column < profile->names().size(); ++column) {
      const std::string& name = profile->names()[column];
      const FieldFunction value = [profile, column, axis, origin](const Vector3& place, double) {
        return profile->value(column, std::array{place[axis] - origin});
      };
      if (name == "temperature") {
        fields.gas.temperature = value;
      } else if (name == "velocity") {
        fields.velocity[axis] = value;
      } else if (name == "spread") {
        for (std::size_t other = 0; other < names.size(); ++other)
          if (other != axis)
            fields.velocity[other] = [value, other](const Vector3& place, double time) {
              return value(place, time) * place[other];
            };
      } else {
        const auto species = flowCase.mechanism->findSpecies(name.substr(2));
        if (!species) throw InputError(fmt::format("the mechanism has no species '{}'", name.substr(2)));
        // A solver's round-off may lie below zero.
        fields.gas.moleFractions.emplace_back(
            *species, [value](const Vector3& place, double time) { return std::max(value(place, time), 0.0); });
      }
    }
    return fields;
  } catch (const InputError& error) {
    throw deck.error(file, error.what());
  }
}

}  // namespace lampblack::app::flowcase
