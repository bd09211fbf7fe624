#include "app/problems/flow/flow_case.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/deck/gas_input.hpp"
#include "app/deck/radiation_deck.hpp"
#include "app/deck/transport_deck.hpp"
#include "app/problems/flow/flow_case_parts.hpp"
#include "app/problems/flow/flow_limits.hpp"
#include "core/errors.hpp"

namespace lampblack::app {

using namespace flowcase;

namespace {

// Whether a symmetry of a box is normal to an axis somewhere. Of a file the mesh tells (flow_mesh).
bool isSymmetryAcross(const FlowCase& flowCase, std::size_t boundary, std::size_t axis) {
  if (flowCase.meshFile || flowCase.boundaries[boundary].kind != BoundaryKind::Symmetry) return false;
  const BoundaryPatch& patch = flowCase.mesh.patches[boundary];
  const bool isBent = flowCase.mesh.map && patch.axis == 1;
  return patch.leftOut >= 0 || isBent || patch.axis == static_cast<int>(axis);
}

// Gravity, which an axis or a plane of symmetry allows along it only.
void readGravity(const Deck& deck, FlowCase& flowCase) {
  const AxisNames names = axisNames(flowCase);
  for (const char* name : {"r", "x", "y", "z"}) {
    const std::string key = std::string("gravity.") + name;
    if (!deck.has(key)) continue;
    const auto axis = std::ranges::find(names, name);
    if (axis == names.end()) throw deck.error(key, axesText(names));
    const auto i = static_cast<std::size_t>(axis - names.begin());
    flowCase.gravity[i] = deck.quantity(key);
    for (std::size_t b = 0; b < flowCase.boundaries.size(); ++b)
      if (isSymmetryAcross(flowCase, b, i))
        throw deck.error(key, fmt::format("gravity would point through '{}', where the flow is symmetric",
                                          flowCase.boundaries[b].name));
  }
  flowCase.referenceDensity =
      Thermo(*flowCase.mechanism).density(flowCase.initial.low.temperature, flowCase.pressure, flowCase.initial.low.Y);
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.kind == BoundaryKind::Outlet)
      flowCase.referenceDensity =
          Thermo(*flowCase.mechanism).density(boundary.temperature, flowCase.pressure, boundary.Y);
}

// The weight of all of the gas, which the pressure of a flow without outlets may hold or not.
void readDrivingForce(const Deck& deck, FlowCase& flowCase) {
  if (!deck.has("driving_acceleration")) return;
  if (deck.has("gravity")) throw deck.error("driving_acceleration", "expected no 'gravity' beside it");
  const AxisNames names = axisNames(flowCase);
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.kind == BoundaryKind::Outlet)
      throw deck.error(
          "driving_acceleration",
          fmt::format("'{}' is an outlet, through which the pressure would fall; expected none", boundary.name));
  for (const char* name : {"x", "y", "z"}) {
    const std::string key = std::string("driving_acceleration.") + name;
    if (!deck.has(key)) continue;
    const auto axis = std::ranges::find(names, name);
    if (axis == names.end()) throw deck.error(key, axesText(names));
    const auto i = static_cast<std::size_t>(axis - names.begin());
    if (flowCase.meshFile || !flowCase.mesh.periodic[i])
      throw deck.error(key, fmt::format("expected a box whose sides along {} are periodic", name));
    flowCase.gravity[i] = deck.quantity(key);
  }
  flowCase.referenceDensity = 0.0;
  flowCase.isDriven = true;
}

}  // namespace

FlowCase readFlowCase(const Deck& deck) {
  FlowCase flowCase;
  flowCase.title = deck.string("title");
  flowCase.pressure = deck.quantity("pressure");
  flowCase.seed = deck.integer<std::uint64_t>("seed");
  flowCase.mechanism = readMechanism(deck);
  readMesh(deck, flowCase);
  flowCase.transport = readTransport(deck, *flowCase.mechanism);
  readBoundaries(deck, flowCase);
  readChemistry(deck, flowCase);
  readSoot(deck, flowCase);
  readTurbulenceModel(deck, flowCase);
  readInitial(deck, flowCase);
  readCarriedStart(deck, flowCase);
  readGravity(deck, flowCase);
  readDrivingForce(deck, flowCase);
  readTurbulence(deck, flowCase);
  readCombustion(deck, flowCase);
  flowCase.radiation = readRadiation(deck, *flowCase.mechanism);
  readTime(deck, flowCase);
  readOutput(deck, flowCase);
  readTrajectories(deck, flowCase);
  if (!flowCase.meshFile) {
    double cells = 1;
    for (int axis = 0; axis < flowCase.dimension; ++axis)
      cells *= static_cast<double>(flowCase.mesh.vertices[static_cast<std::size_t>(axis)].size() - 1);
    refuseExcess(deck, flowCase, cells);
  }
  return flowCase;
}

}  // namespace lampblack::app
