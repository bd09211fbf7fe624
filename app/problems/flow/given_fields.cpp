#include "app/problems/flow/given_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>

#include "core/errors.hpp"
#include "core/nearest_name.hpp"
#include "io/deck_keys.hpp"
#include "io/formula.hpp"
#include "io/grid_table.hpp"

namespace lampblack::app::flowcase {
namespace {

constexpr std::string_view moleFraction = "X_";

// The two or three coordinates, then the time.
std::array<double, 4> inAxes(const Vector3& place, double time, std::size_t dimension) {
  std::array values{place[0], place[1], place[2], 0.0};
  values[dimension] = time;
  return values;
}

std::vector<std::string> namesOf(const GivenFields::Names& names) {
  std::vector<std::string> known;
  for (const auto& [name, dimension] : names) known.push_back(name);
  return known;
}

InputError notGivenHere(const std::string& name, const GivenFields::Names& names) {
  return InputError(fmt::format("'{}' cannot be given here; expected one of: {}, or X_ and the name of a species{}",
                                name, fmt::join(namesOf(names), ", "), didYouMean(name, namesOf(names))));
}

}  // namespace

void addGivenFieldKeys(DeckSchema& schema, const std::string& section, const std::string& names) {
  SectionKeys keys(section);
  keys.text("formula.*", rules().optional(),
            "A quantity over place and time, '0.2*(1 - (r/0.005)^2)': a formula in SI of the mesh's axes (r and z, x "
            "and y, or x, y and z) and t. Its name is one of: " +
                names + ".");
  keys.text(
      "table", rules().optional(),
      "CSV file, relative to the deck, with columns that have the name of an axis or t, and of the same quantities as "
      "'formula'; a unit may stand behind a name, 'velocity [cm/s]'. Linear between its points, constant beyond them.");
  schema.add(keys.schema());
}

GivenFields::GivenFields(const Deck& deck, const std::string& section, const AxisNames& axes, const Names& names,
                         const Mechanism& mechanism) {
  readFormulas(deck, section, axes);
  readTable(deck, section, axes, names);
  sortOut(deck, names, mechanism);
}

void GivenFields::readFormulas(const Deck& deck, const std::string& section, const AxisNames& axes) {
  for (const std::string& name : deck.children(section + ".formula")) {
    const std::string key = section + ".formula." + name;
    deck.at(key, [&] {
      std::vector<std::string> variables = axes;
      variables.emplace_back("t");
      const Formula formula(deck.string(key), variables);
      fields_[name] = {[formula, dimension = axes.size()](const Vector3& place, double time) {
                         const std::array values = inAxes(place, time, dimension);
                         return formula(std::span(values).first(dimension + 1));
                       },
                       key, formula.has("t")};
    });
  }
}

void GivenFields::readTable(const Deck& deck, const std::string& section, const AxisNames& axes, const Names& names) {
  const std::string key = section + ".table";
  if (!deck.has(key)) return;
  const auto dimensionOf = [&](const std::string& name) -> std::optional<units::Dimension> {
    if (name.starts_with(moleFraction)) return units::dimensionless;
    const auto known = names.find(name);
    if (known == names.end())
      throw InputError(fmt::format("{}; places and times are columns {}, t", notGivenHere(name, names).what(),
                                   fmt::join(axes, ", ")));
    return known->second;
  };
  deck.at(key, [&] {
    std::vector<GridTable::Coordinate> coordinates;
    for (const std::string& axis : axes) coordinates.push_back({axis, units::length});
    coordinates.push_back({"t", units::time});
    const auto table =
        std::make_shared<GridTable>(deck.resolvePath(deck.string(key)), std::move(coordinates), dimensionOf);
    for (std::size_t column = 0; column < table->names().size(); ++column) {
      const std::string& name = table->names()[column];
      if (has(name)) throw InputError(fmt::format("'{}' is given by a formula, too", name));
      fields_[name] = {[table, column, dimension = axes.size()](const Vector3& place, double time) {
                         const std::array values = inAxes(place, time, dimension);
                         return table->value(column, std::span(values).first(dimension + 1));
                       },
                       key, table->dependsOn("t")};
    }
  });
}

void GivenFields::sortOut(const Deck& deck, const Names& names, const Mechanism& mechanism) {
  for (const auto& [name, field] : fields_) {
    if (names.contains(name)) continue;
    if (!name.starts_with(moleFraction)) throw deck.error(field.key, notGivenHere(name, names).what());
    const std::string species = name.substr(moleFraction.size());
    const auto number = mechanism.findSpecies(species);
    if (!number) throw deck.error(field.key, fmt::format("the mechanism has no species '{}'", species));
    moleFractions_.emplace_back(*number, field.value);
  }
}

FieldFunction GivenFields::find(const std::string& name) const {
  const auto field = fields_.find(name);
  return field == fields_.end() ? FieldFunction{} : field->second.value;
}

bool GivenFields::varyInTime() const {
  return std::ranges::any_of(fields_, [](const auto& field) { return field.second.inTime; });
}

std::string GivenFields::keyOf(const std::string& name) const {
  return fields_.at(name).key;
}

}  // namespace lampblack::app::flowcase
