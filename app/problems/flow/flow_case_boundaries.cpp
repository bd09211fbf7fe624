// The boundaries of a flow deck: where each is, and what happens there.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "app/deck/gas_input.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/problems/flow/flow_case_parts.hpp"
#include "app/problems/flow/given_fields.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::app::flowcase {

std::vector<double> readComposition(const Deck& deck, const std::string& key, const Mechanism& mechanism) {
  return deck.at(key, [&] {
    const std::vector<double> X = parseComposition(mechanism, deck.string(key));
    std::vector<double> Y(X.size());
    Thermo(mechanism).moleToMass(X, Y);
    return Y;
  });
}

namespace {

// The surface of a solid.
BoundaryPatch readSolidPatch(const Deck& deck, const std::string& name, const FlowCase& flowCase) {
  const std::string section = "boundaries." + name, key = section + ".solid", solid = deck.string(key);
  for (const char* other : {".side", ".from", ".to"})
    if (deck.has(section + other))
      throw deck.error(section + other, "the boundary is the whole surface of its solid; leave this out");
  if (deck.choice(section + ".type") == "periodic")
    throw deck.error(section + ".type", "a solid has no partner to be periodic with; expected another type");
  const auto found = std::ranges::find(flowCase.solids, solid);
  if (found == flowCase.solids.end())
    throw deck.error(key, fmt::format("'mesh.solids' has no '{}'{}", solid, didYouMean(solid, flowCase.solids)));
  BoundaryPatch patch;
  patch.name = name;
  patch.leftOut = static_cast<int>(found - flowCase.solids.begin());
  for (const BoundaryPatch& other : flowCase.mesh.patches)
    if (other.leftOut == patch.leftOut)
      throw deck.error(key, fmt::format("the solid '{}' is that of the boundary '{}', too", solid, other.name));
  return patch;
}

BoundaryPatch readPatch(const Deck& deck, const std::string& name, const FlowCase& flowCase) {
  const AxisNames names = axisNames(flowCase);
  const std::string section = "boundaries." + name;
  if (deck.has(section + ".solid")) return readSolidPatch(deck, name, flowCase);
  if (!deck.has(section + ".side"))
    throw deck.error(section,
                     flowCase.solids.empty() ? "expected the key 'side'" : "expected the key 'side' or 'solid'");
  const std::string side = *deck.optionalString(section + ".side");
  const auto axis = std::find(names.begin(), names.end(), side.substr(0, 1));
  if (axis == names.end()) throw deck.error(section + ".side", axesText(names));
  if (const std::string type = deck.choice(section + ".type"); type == "periodic" && side == "r-max")
    throw deck.error(section + ".type", "the radius has no partner to be periodic with; expected another type");
  else if (side == "r-min" && type != "symmetry")
    throw deck.error(section + ".type",
                     fmt::format("r-min is the axis, which has no area; expected symmetry, found {}", type));
  BoundaryPatch patch;
  patch.name = name;
  patch.axis = static_cast<int>(axis - names.begin());
  patch.atMax = side.ends_with("max");
  if (const auto from = deck.optionalQuantity(section + ".from")) patch.from = *from;
  if (const auto to = deck.optionalQuantity(section + ".to")) patch.to = *to;
  return patch;
}

// A place on a boundary, its middle; in the middle of its solid.
Vector3 middleOf(const BoundaryPatch& patch, const MeshSpec& mesh) {
  const auto normal = static_cast<std::size_t>(patch.axis);
  Vector3 place{};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(mesh.dimension()); ++axis) {
    const std::vector<double>& v = mesh.vertices[axis];
    double from = v.front(), to = v.back();
    if (patch.leftOut >= 0) {
      const MeshSpec::LeftOut& part = mesh.leftOut[static_cast<std::size_t>(patch.leftOut)];
      from = std::max(from, part.lower[axis]);
      to = std::min(to, part.upper[axis]);
    } else if (axis == normal) {
      from = to = patch.atMax ? to : from;
    } else if (axis == alongSide(patch.axis)) {
      from = std::max(from, patch.from);
      to = std::min(to, patch.to);
    }
    place[axis] = 0.5 * (from + to);
  }
  return mesh.map ? mesh.map(place) : place;
}

constexpr const char *energyName = "turbulent_kinetic_energy", *dissipationName = "turbulent_dissipation";

// What may vary over a boundary of a type.
GivenFields::Names variableNames(const std::string& type) {
  GivenFields::Names names{{"temperature", units::temperature}};
  if (type == "outlet") return names;
  names["tangential_velocity"] = names["swirl_velocity"] = units::velocity;
  if (type == "inlet")
    names.insert({{"velocity", units::velocity},
                  {energyName, units::velocity * units::velocity},
                  {dissipationName, units::velocity * units::velocity / units::time}});
  else
    names["heat_flux"] = units::heatFlux;
  return names;
}

class ConditionReader {
 public:
  // `middle`: where what varies is looked at beforehand.
  ConditionReader(const Deck& deck, const std::string& name, const Vector3& middle, const FlowCase& flowCase)
      : deck_(deck),
        section_("boundaries." + name),
        type_(deck.choice(section_ + ".type")),
        isAxisymmetric_(flowCase.mesh.geometry == Geometry::Axisymmetric),
        isPlane_(flowCase.dimension == 2),
        middle_(middle),
        mechanism_(*flowCase.mechanism),
        fields_(deck, section_, axisNames(flowCase), variableNames(type_), mechanism_) {
    boundary_.name = name;
    boundary_.varies = {fields_.find("velocity"),
                        fields_.find("tangential_velocity"),
                        fields_.find("swirl_velocity"),
                        fields_.find("heat_flux"),
                        fields_.gas(),
                        fields_.find(energyName),
                        fields_.find(dissipationName),
                        fields_.varyInTime()};
  }

  BoundaryCondition read() {
    if (type_ == "symmetry") {
      boundary_.kind = BoundaryKind::Symmetry;
      if (!boundary_.varies.isEmpty()) throw deck_.error(section_, "there is nothing to give along a symmetry");
      return boundary_;
    }
    boundary_.tangential = valueOf("tangential_velocity");
    boundary_.swirl = valueOf("swirl_velocity");
    if (isGiven("swirl_velocity") && !isAxisymmetric_)
      throw deck_.error(section_, "there is no axis to swirl about; expected 'mesh: {geometry: axisymmetric}'");
    if (isGiven("tangential_velocity") && !isPlane_)
      throw deck_.error(
          fields_.has("tangential_velocity") ? fields_.keyOf("tangential_velocity") : keyOf("tangential_velocity"),
          "along a surface in space it would have no direction; it is for planar and axisymmetric flows");
    if (type_ == "wall")
      readWall();
    else
      readGas();
    if (type_ == "inlet") readInlet();
    return boundary_;
  }

 private:
  [[nodiscard]] std::string keyOf(const std::string& name) const { return section_ + "." + name; }

  // By key, or by formula or table in the middle of the boundary at the start; 0 where it is not given.
  [[nodiscard]] double valueOf(const std::string& name) const {
    if (fields_.has(name) && deck_.isGiven(keyOf(name)))
      throw deck_.error(keyOf(name), fmt::format("'{}' is given by a formula or a table, too", name));
    if (fields_.has(name)) try {
        return fields_.find(name)(middle_, 0.0);
      } catch (const InputError& error) {
        throw deck_.error(fields_.keyOf(name), error.what());
      }
    return deck_.optionalQuantity(keyOf(name)).value_or(0.0);
  }
  [[nodiscard]] bool isGiven(const std::string& name) const { return deck_.has(keyOf(name)) || fields_.has(name); }

  void readTemperature() {
    boundary_.temperature = valueOf("temperature");
    requireTemperature(deck_, fields_.has("temperature") ? fields_.keyOf("temperature") : keyOf("temperature"),
                       boundary_.temperature, mechanism_, TemperatureUse::transport);
  }

  void readWall() {
    boundary_.slip = deck_.boolean(keyOf("slip"));
    boundary_.takesParticles = isGiven("particles") ? deck_.choice(keyOf("particles")) == "deposit" : !boundary_.slip;
    for (const char* name : {"tangential_velocity", "swirl_velocity"})
      if (boundary_.slip && (valueOf(name) != 0 || fields_.has(name)))
        throw deck_.error(fields_.has(name) ? fields_.keyOf(name) : keyOf(name),
                          "a wall that the gas slides along does not move it; expected slip: false");
    boundary_.isothermal = isGiven("temperature");
    if (boundary_.isothermal && isGiven("heat_flux"))
      throw deck_.error(section_, "a wall has either a 'temperature' or a 'heat_flux'; expected one of them");
    if (boundary_.isothermal) readTemperature();
    boundary_.heatFlux = valueOf("heat_flux");
    if (!fields_.gas().moleFractions.empty())
      throw deck_.error(section_, "no gas comes through a wall; expected no mole fractions");
  }

  // An outlet that says nothing of the gas outside: that of the start, where it is one gas everywhere.
  [[nodiscard]] bool entrainsFirstGas(const GasVariation& gas) const {
    return type_ == "outlet" && !isGiven("temperature") && !deck_.has(keyOf("composition")) &&
           gas.moleFractions.empty() && deck_.choice("initial.layer") == "none" &&
           deck_.isGiven("initial.temperature") && deck_.has("initial.composition");
  }

  // Of an inlet, and of what an outlet may draw in.
  void readGas() {
    boundary_.kind = type_ == "inlet" ? BoundaryKind::Inlet : BoundaryKind::Outlet;
    const std::string what = type_ == "inlet" ? "an inlet" : "an outlet (for the gas it may entrain)";
    const GasVariation gas = fields_.gas();
    if (entrainsFirstGas(gas)) {
      boundary_.temperature = deck_.quantity("initial.temperature");
      requireTemperature(deck_, "initial.temperature", boundary_.temperature, mechanism_, TemperatureUse::transport);
      boundary_.Y = readComposition(deck_, "initial.composition", mechanism_);
      given_ = {boundary_.temperature, boundary_.Y};
      return;
    }
    if (!isGiven("temperature")) throw deck_.error(section_, fmt::format("{} needs the key 'temperature'", what));
    if (!deck_.has(keyOf("composition")) && gas.moleFractions.empty())
      throw deck_.error(section_, fmt::format("{} needs the key 'composition'", what));
    readTemperature();
    boundary_.Y = deck_.has(keyOf("composition")) ? readComposition(deck_, keyOf("composition"), mechanism_)
                                                  : std::vector<double>(mechanism_.numSpecies(), 0.0);
    given_ = {boundary_.temperature, boundary_.Y};
    try {
      gas.apply(middle_, 0.0, Thermo(mechanism_), given_.temperature, given_.Y);
    } catch (const InputError& error) {
      throw deck_.error(section_, error.what());
    }
    if (!deck_.has(keyOf("composition"))) boundary_.Y = given_.Y;
  }

  void readInlet() {
    boundary_.fixedComposition = deck_.choice(keyOf("species")) == "fixed";
    if (!isGiven("velocity")) throw deck_.error(section_, "an inlet needs the key 'velocity'");
    boundary_.speed = valueOf("velocity");
    for (const auto& [name, partner] : {std::pair{energyName, dissipationName}, {dissipationName, energyName}}) {
      if (!fields_.has(name)) continue;
      if (!fields_.has(partner))
        throw deck_.error(fields_.keyOf(name), fmt::format("'{}' needs '{}' beside it", name, partner));
      if (fields_.dependsOnTime(name))
        throw deck_.error(fields_.keyOf(name), fmt::format("'{}' does not vary in time; expected no t", name));
    }
    requireLowMach(deck_, fields_.has("velocity") ? fields_.keyOf("velocity") : keyOf("velocity"), Thermo(mechanism_),
                   std::hypot(boundary_.speed, boundary_.swirl), given_.temperature, given_.Y);
  }

  const Deck& deck_;
  std::string section_, type_;
  bool isAxisymmetric_, isPlane_;
  Vector3 middle_;
  const Mechanism& mechanism_;
  GivenFields fields_;
  BoundaryCondition boundary_;
  Stream given_;  // in the middle, at the start
};

// The two boundaries of an axis whose ends are one, each a whole side.
void readPeriodic(const Deck& deck, FlowCase& flowCase) {
  MeshSpec& mesh = flowCase.mesh;
  std::array<std::array<std::string, 2>, 3> names;  // of each axis: low end, high end
  for (const std::string& name : deck.children("boundaries")) {
    const std::string section = "boundaries." + name;
    if (deck.choice(section + ".type") != "periodic") continue;
    const BoundaryPatch patch = readPatch(deck, name, flowCase);
    if (deck.has(section + ".from") || deck.has(section + ".to"))
      throw deck.error(section, "a periodic boundary is a whole side; expected no 'from' and 'to'");
    std::string& entry = names[static_cast<std::size_t>(patch.axis)][patch.atMax ? 1 : 0];
    if (!entry.empty()) throw deck.error(section, fmt::format("the side is that of the boundary '{}', too", entry));
    entry = name;
    mesh.periodic[static_cast<std::size_t>(patch.axis)] = true;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!mesh.periodic[axis]) continue;
    const std::string& given = names[axis][0].empty() ? names[axis][1] : names[axis][0];
    if (names[axis][0].empty() || names[axis][1].empty())
      throw deck.error("boundaries." + given,
                       "a periodic boundary has a partner; expected 'type: periodic' on the "
                       "opposite side, too");
    if (mesh.vertices[axis].size() < 4)
      throw deck.error("boundaries." + given,
                       fmt::format("a periodic axis needs 3 cells or more, found {}", mesh.vertices[axis].size() - 1));
  }
}

// Of a mesh file, whose parts go by their names.
void readNamedBoundaries(const Deck& deck, FlowCase& flowCase) {
  for (const std::string& name : deck.children("boundaries")) {
    const std::string section = "boundaries." + name;
    for (const char* key : {".side", ".from", ".to", ".solid"})
      if (deck.has(section + key))
        throw deck.error(section + key, "boundaries of a mesh file go by the names in the file; leave this out");
    if (deck.choice(section + ".type") == "periodic")
      flowCase.meshFile->periodic.push_back(name);
    else
      flowCase.boundaries.push_back(ConditionReader(deck, name, {}, flowCase).read());
  }
}

}  // namespace

void readBoundaries(const Deck& deck, FlowCase& flowCase) {
  if (flowCase.meshFile) {
    readNamedBoundaries(deck, flowCase);
    return;
  }
  const MeshSpec& mesh = flowCase.mesh;
  readPeriodic(deck, flowCase);
  for (const std::string& name : deck.children("boundaries")) {
    if (deck.choice("boundaries." + name + ".type") == "periodic") continue;
    flowCase.mesh.patches.push_back(readPatch(deck, name, flowCase));
    flowCase.boundaries.push_back(ConditionReader(deck, name, middleOf(mesh.patches.back(), mesh), flowCase).read());
  }
  addAxis(flowCase);
  checkSides(deck, flowCase);
}

}  // namespace lampblack::app::flowcase
