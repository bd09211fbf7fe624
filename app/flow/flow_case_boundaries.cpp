// The boundaries of a flow deck: where each is, and what happens there.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "app/deck/temperature_input.hpp"
#include "app/flow/flow_case_parts.hpp"
#include "app/flow/given_fields.hpp"
#include "app/tools/gas_input.hpp"
#include "core/errors.hpp"

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

BoundaryPatch readPatch(const Deck& deck, const std::string& name, Geometry geometry) {
  const AxisNames names = axisNames(geometry);
  const std::string section = "boundaries." + name, side = deck.choice(section + ".side");
  const auto axis = std::find(names.begin(), names.end(), side.substr(0, 1));
  if (axis == names.end())
    throw deck.error(section + ".side", fmt::format("the axes of this mesh are {} and {}", names[0], names[1]));
  if (const std::string type = deck.choice(section + ".type"); type == "periodic" && side == "r-max")
    throw deck.error(section + ".type", "the radius has no partner to be periodic with; expected another type");
  else if (side == "r-min" && type != "symmetry")
    throw deck.error(section + ".type",
                     fmt::format("r-min is the axis, which has no area; expected symmetry, found {}", type));
  BoundaryPatch patch{name, static_cast<int>(axis - names.begin()), side.ends_with("max")};
  if (const auto from = deck.optionalQuantity(section + ".from")) patch.from = *from;
  if (const auto to = deck.optionalQuantity(section + ".to")) patch.to = *to;
  return patch;
}

// A place on a boundary, its middle.
Vector3 middleOf(const BoundaryPatch& patch, const MeshSpec& mesh) {
  const auto normal = static_cast<std::size_t>(patch.axis);
  const std::vector<double>& along = mesh.vertices[1 - normal];
  Vector3 place{};
  place[normal] = patch.atMax ? mesh.vertices[normal].back() : mesh.vertices[normal].front();
  place[1 - normal] = 0.5 * (std::max(patch.from, along.front()) + std::min(patch.to, along.back()));
  return place;
}

// What may vary over a boundary of a type.
GivenFields::Names variableNames(const std::string& type) {
  GivenFields::Names names{{"temperature", units::temperature}};
  if (type == "outlet") return names;
  names["tangential_velocity"] = names["swirl_velocity"] = units::velocity;
  if (type == "inlet")
    names["velocity"] = units::velocity;
  else
    names["heat_flux"] = units::heatFlux;
  return names;
}

class ConditionReader {
 public:
  ConditionReader(const Deck& deck, const BoundaryPatch& patch, const MeshSpec& mesh, const Mechanism& mechanism)
      : deck_(deck),
        section_("boundaries." + patch.name),
        type_(deck.choice(section_ + ".type")),
        isAxisymmetric_(mesh.geometry == Geometry::Axisymmetric),
        middle_(middleOf(patch, mesh)),
        mechanism_(mechanism),
        fields_(deck, section_, axisNames(mesh.geometry), variableNames(type_), mechanism) {
    boundary_.name = patch.name;
    boundary_.varies = {fields_.find("velocity"), fields_.find("tangential_velocity"), fields_.find("swirl_velocity"),
                        fields_.find("heat_flux"), fields_.gas()};
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

  // Of an inlet, and of what an outlet may draw in.
  void readGas() {
    boundary_.kind = type_ == "inlet" ? BoundaryKind::Inlet : BoundaryKind::Outlet;
    const std::string what = type_ == "inlet" ? "an inlet" : "an outlet (for the gas it may entrain)";
    const GasVariation gas = fields_.gas();
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
    requireLowMach(deck_, fields_.has("velocity") ? fields_.keyOf("velocity") : keyOf("velocity"), Thermo(mechanism_),
                   std::hypot(boundary_.speed, boundary_.swirl), given_.temperature, given_.Y);
  }

  const Deck& deck_;
  std::string section_, type_;
  bool isAxisymmetric_;
  Vector3 middle_;
  const Mechanism& mechanism_;
  GivenFields fields_;
  BoundaryCondition boundary_;
  Stream given_;  // in the middle, at the start
};

// One side of the box and the mesh along it.
struct Side {
  std::string name;  // "z-min"
  const std::vector<double>& vertices;

  Side(const MeshSpec& mesh, int axis, bool atMax)
      : name(axisNames(mesh.geometry)[static_cast<std::size_t>(axis)] + (atMax ? "-max" : "-min")),
        vertices(mesh.vertices[static_cast<std::size_t>(1 - axis)]) {}
  [[nodiscard]] double end() const { return vertices.back(); }
  [[nodiscard]] double tolerance() const { return 1e-9 * end(); }
};

// A boundary lies on its side, and has faces. Where an edge of it lies inside a face, the user is told.
void checkExtent(const Deck& deck, FlowCase& flowCase, const BoundaryPatch& patch) {
  const Side side(flowCase.mesh, patch.axis, patch.atMax);
  const std::string section = "boundaries." + patch.name;
  for (const auto& [key, value] : {std::pair{".from", patch.from}, {".to", patch.to}})
    if (deck.has(section + key) && (value < -side.tolerance() || value > side.end() + side.tolerance()))
      throw deck.error(section + key,
                       fmt::format("the side {} goes from 0 to {:g} m, found {:g} m", side.name, side.end(), value));
  if (!(patch.from < patch.to)) throw deck.error(section, "expected 'from' below 'to'");
  bool hasFaces = false;
  for (std::size_t i = 0; i + 1 < side.vertices.size(); ++i) {
    const double place = 0.5 * (side.vertices[i] + side.vertices[i + 1]);
    hasFaces = hasFaces || (place >= patch.from && place <= patch.to);
  }
  if (!hasFaces)
    throw deck.error(section, fmt::format("no face of the mesh has its centre between {:g} and {:g} m on the side {}",
                                          patch.from, patch.to, side.name));
  for (const double edge : {patch.from, patch.to}) {
    const double nearest = *std::min_element(side.vertices.begin(), side.vertices.end(), [&](double a, double b) {
      return std::abs(a - edge) < std::abs(b - edge);
    });
    if (edge > 0 && edge < side.end() && std::abs(nearest - edge) > 1e-6 * side.end())
      flowCase.notes.push_back(
          fmt::format("the boundary {} has its edge at {:g} m inside a face of the mesh, which belongs to the boundary "
                      "its centre lies on; the nearest edge of a face is at {:g} m",
                      patch.name, edge, nearest));
  }
}

// Along a side one boundary follows the other, without gaps and overlaps.
void checkCoverage(const Deck& deck, const Side& side, std::vector<BoundaryPatch> patches) {
  std::stable_sort(patches.begin(), patches.end(),
                   [](const BoundaryPatch& a, const BoundaryPatch& b) { return a.from < b.from; });
  double reached = 0;
  const auto requireNoGap = [&](double from) {
    if (from > reached + side.tolerance())
      throw deck.error("boundaries",
                       fmt::format("the side {} belongs to no boundary from {:g} to {:g} m", side.name, reached, from));
  };
  const BoundaryPatch* before = nullptr;
  for (const BoundaryPatch& patch : patches) {
    requireNoGap(patch.from);
    if (before != nullptr && patch.from < reached - side.tolerance())
      throw deck.error("boundaries." + patch.name,
                       fmt::format("it overlaps the boundary '{}' on the side {} from {:g} to {:g} m", before->name,
                                   side.name, std::max(patch.from, 0.0), std::min(reached, patch.to)));
    reached = std::min(patch.to, side.end());
    before = &patch;
  }
  requireNoGap(side.end());
}

// The two boundaries of an axis whose ends are one, each a whole side.
void readPeriodic(const Deck& deck, FlowCase& flowCase) {
  MeshSpec& mesh = flowCase.mesh;
  std::array<std::array<std::string, 2>, 2> names;  // of each axis: low end, high end
  for (const std::string& name : deck.children("boundaries")) {
    const std::string section = "boundaries." + name;
    if (deck.choice(section + ".type") != "periodic") continue;
    const BoundaryPatch patch = readPatch(deck, name, mesh.geometry);
    if (deck.has(section + ".from") || deck.has(section + ".to"))
      throw deck.error(section, "a periodic boundary is a whole side; expected no 'from' and 'to'");
    std::string& entry = names[static_cast<std::size_t>(patch.axis)][patch.atMax ? 1 : 0];
    if (!entry.empty()) throw deck.error(section, fmt::format("the side is that of the boundary '{}', too", entry));
    entry = name;
    mesh.periodic[static_cast<std::size_t>(patch.axis)] = true;
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
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

}  // namespace

void readBoundaries(const Deck& deck, FlowCase& flowCase) {
  const MeshSpec& mesh = flowCase.mesh;
  readPeriodic(deck, flowCase);
  for (const std::string& name : deck.children("boundaries")) {
    if (deck.choice("boundaries." + name + ".type") == "periodic") continue;
    flowCase.mesh.patches.push_back(readPatch(deck, name, mesh.geometry));
    flowCase.boundaries.push_back(ConditionReader(deck, mesh.patches.back(), mesh, *flowCase.mechanism).read());
  }
  for (const BoundaryPatch& patch : mesh.patches) checkExtent(deck, flowCase, patch);
  for (int axis = 0; axis < 2; ++axis)
    for (const bool atMax : {false, true}) {
      if (mesh.periodic[static_cast<std::size_t>(axis)]) {
        for (const BoundaryPatch& patch : mesh.patches)
          if (patch.axis == axis) throw deck.error("boundaries." + patch.name, "this side is periodic, too");
        continue;
      }
      std::vector<BoundaryPatch> patches;
      for (const BoundaryPatch& patch : mesh.patches)
        if (patch.axis == axis && patch.atMax == atMax) patches.push_back(patch);
      checkCoverage(deck, Side(mesh, axis, atMax), std::move(patches));
    }
}

}  // namespace lampblack::app::flowcase
