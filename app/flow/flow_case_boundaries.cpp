// The boundaries of a flow deck: where each is, and what happens there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/deck/temperature_input.hpp"
#include "app/flow/flow_case_parts.hpp"
#include "app/tools/gas_input.hpp"
#include "core/errors.hpp"

namespace lampblack::app::flowcase {

std::vector<double> readComposition(const Deck& deck, const std::string& key, const Mechanism& mechanism) {
  try {
    const std::vector<double> X = parseComposition(mechanism, deck.string(key));
    std::vector<double> Y(X.size());
    Thermo(mechanism).moleToMass(X, Y);
    return Y;
  } catch (const InputError& error) {
    throw deck.error(key, error.what());
  }
}

namespace {

BoundaryPatch readPatch(const Deck& deck, const std::string& name, Geometry geometry) {
  const AxisNames names = axisNames(geometry);
  const std::string section = "boundaries." + name, side = deck.choice(section + ".side");
  const auto axis = std::find(names.begin(), names.end(), side.substr(0, 1));
  if (axis == names.end())
    throw deck.error(section + ".side", fmt::format("the axes of this mesh are {} and {}", names[0], names[1]));
  if (const std::string type = deck.choice(section + ".type"); side == "r-min" && type != "symmetry")
    throw deck.error(section + ".type",
                     fmt::format("r-min is the axis, which has no area; expected symmetry, found {}", type));
  BoundaryPatch patch{name, static_cast<int>(axis - names.begin()), side.ends_with("max")};
  if (const auto from = deck.optionalQuantity(section + ".from")) patch.from = *from;
  if (const auto to = deck.optionalQuantity(section + ".to")) patch.to = *to;
  return patch;
}

BoundaryCondition readCondition(const Deck& deck, const std::string& name, const Mechanism& mechanism) {
  const std::string section = "boundaries." + name, type = deck.choice(section + ".type");
  const auto temperature = [&] {
    return readTemperature(deck, section + ".temperature", mechanism, TemperatureUse::transport);
  };
  BoundaryCondition boundary;
  boundary.name = name;
  boundary.slip = deck.boolean(section + ".slip");
  boundary.tangential = deck.quantity(section + ".tangential_velocity");
  if (boundary.slip && boundary.tangential != 0)
    throw deck.error(section + ".tangential_velocity",
                     "a wall that the gas slides along does not move it; expected slip: false");
  boundary.fixedComposition = deck.choice(section + ".species") == "fixed";
  if (type == "inlet" || type == "outlet") {
    boundary.kind = type == "inlet" ? BoundaryKind::Inlet : BoundaryKind::Outlet;
    const std::string what = type == "inlet" ? "an inlet" : "an outlet (for the gas it may entrain)";
    for (const char* key : {"temperature", "composition"})
      if (!deck.has(section + "." + key)) throw deck.error(section, fmt::format("{} needs the key '{}'", what, key));
    boundary.temperature = temperature();
    boundary.Y = readComposition(deck, section + ".composition", mechanism);
  }
  if (type == "inlet") {
    boundary.speed = neededQuantity(deck, section, "velocity", "an inlet");
    requireLowMach(deck, section + ".velocity", Thermo(mechanism), boundary.speed, boundary.temperature, boundary.Y);
  }
  if (type == "symmetry") boundary.kind = BoundaryKind::Symmetry;
  if (type == "wall" && deck.has(section + ".temperature")) {
    boundary.isothermal = true;
    boundary.temperature = temperature();
  }
  return boundary;
}

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

}  // namespace

void readBoundaries(const Deck& deck, FlowCase& flowCase) {
  const MeshSpec& mesh = flowCase.mesh;
  for (const std::string& name : deck.children("boundaries")) {
    flowCase.mesh.patches.push_back(readPatch(deck, name, mesh.geometry));
    flowCase.boundaries.push_back(readCondition(deck, name, *flowCase.mechanism));
  }
  for (const BoundaryPatch& patch : mesh.patches) checkExtent(deck, flowCase, patch);
  for (int axis = 0; axis < 2; ++axis)
    for (const bool atMax : {false, true}) {
      std::vector<BoundaryPatch> patches;
      for (const BoundaryPatch& patch : mesh.patches)
        if (patch.axis == axis && patch.atMax == atMax) patches.push_back(patch);
      checkCoverage(deck, Side(mesh, axis, atMax), std::move(patches));
    }
}

}  // namespace lampblack::app::flowcase
