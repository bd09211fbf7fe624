// The section initial of a flow deck: a layer between two streams, one gas everywhere, or fields that are given.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "app/deck/gas_input.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/problems/flow/flow_case_parts.hpp"
#include "app/problems/flow/given_fields.hpp"
#include "app/problems/flow/initial_flame1d.hpp"
#include "app/problems/flow/initial_flow.hpp"
#include "core/errors.hpp"

namespace lampblack::app::flowcase {
namespace {

Stream streamOf(const Deck& deck, const std::string& key, const FlowCase& flowCase) {
  const std::string name = deck.string(key);
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.name == name && boundary.kind == BoundaryKind::Inlet) return {boundary.temperature, boundary.Y};
  std::string inlets;
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.kind == BoundaryKind::Inlet) inlets += (inlets.empty() ? "" : ", ") + boundary.name;
  throw deck.error(key, fmt::format("'{}' is not an inlet; the inlets are: {}", name, inlets));
}

// What is given over place, on whatever the start is otherwise.
void readInitialFields(const Deck& deck, FlowCase& flowCase) {
  const AxisNames axes = axisNames(flowCase);
  GivenFields::Names names{{"temperature", units::temperature}};
  for (const std::string& axis : axes) names["velocity_" + axis] = units::velocity;
  if (flowCase.mesh.geometry == Geometry::Axisymmetric) names["swirl_velocity"] = units::velocity;
  const GivenFields given(deck, "initial", axes, names, *flowCase.mechanism);
  InitialFields& fields = flowCase.initialFields;
  fields = {.gas = given.gas(),
            .velocity = {},
            .swirl = given.find("swirl_velocity"),
            .thermodynamicPressure = {},
            .carried = {},
            .turbulence = {}};
  for (std::size_t axis = 0; axis < axes.size(); ++axis) fields.velocity[axis] = given.find("velocity_" + axes[axis]);
  for (const char* whole : {"initial.flame1d", "initial.flow"}) {
    if (!deck.has(whole)) continue;
    if (!fields.isEmpty() || deck.choice("initial.layer") != "none")
      throw deck.error(whole,
                       "it fills all of the mesh; expected 'layer: none' and nothing else that gives the start: no "
                       "formulas, no table, one of 'flame1d' and 'flow'");
    fields =
        std::string_view(whole) == "initial.flow" ? readInitialFlow(deck, flowCase) : readInitialFlame(deck, flowCase);
  }
  flowCase.swirls = fields.swirl || std::ranges::any_of(flowCase.boundaries, [](const BoundaryCondition& boundary) {
                      return boundary.swirl != 0.0 || boundary.varies.swirl;
                    });
  if (flowCase.swirls && flowCase.meshFile)
    throw deck.error("mesh.file",
                     "a flow that swirls needs a mesh of rectangles; expected a box, segments of 'r' and 'z'");
}

// One gas everywhere, under the fields that are given.
void readEvenStart(const Deck& deck, FlowCase& flowCase) {
  MixingLayer& layer = flowCase.initial;
  const GasVariation& gas = flowCase.initialFields.gas;
  if (!deck.has("initial.composition") && gas.moleFractions.empty())
    throw deck.error("initial", "a start without a layer needs the key 'composition'");
  std::vector<double> Y(flowCase.mechanism->numSpecies(), 0.0);
  if (deck.has("initial.composition")) {
    Y = readComposition(deck, "initial.composition", *flowCase.mechanism);
  } else {
    double T = layer.temperature;
    try {
      gas.apply({0.0, 0.0}, 0.0, Thermo(*flowCase.mechanism), T, Y);
    } catch (const InputError& error) {
      throw deck.error("initial", error.what());
    }
  }
  layer.low = layer.high = {layer.temperature, Y};
  layer.burnt = false;
  layer.hotWidth = 1.0;
}

}  // namespace

void readInitial(const Deck& deck, FlowCase& flowCase) {
  MixingLayer& layer = flowCase.initial;
  layer.temperature = readTemperature(deck, "initial.temperature", *flowCase.mechanism, TemperatureUse::transport);
  readInitialFields(deck, flowCase);
  if (deck.choice("initial.layer") == "none") {
    readEvenStart(deck, flowCase);
    return;
  }
  for (const char* key : {"low", "high"})
    if (!deck.has(std::string("initial.") + key))
      throw deck.error("initial", fmt::format("a layer needs the key '{}'", key));
  layer.low = streamOf(deck, "initial.low", flowCase);
  layer.high = streamOf(deck, "initial.high", flowCase);
  layer.position = neededQuantity(deck, "initial", "position", "a layer");
  layer.width = neededQuantity(deck, "initial", "width", "a layer");
  layer.burnt = deck.choice("initial.layer") == "burnt";
  const std::vector<double>& along = flowCase.mesh.vertices[static_cast<std::size_t>(layer.axis)];
  const auto requireInside = [&](const char* key, double place) {
    if (flowCase.meshFile || flowCase.mesh.map) return;  // it is known later how far the mesh goes
    const double end = along.back();
    if (place < 0 || place > end)
      throw deck.error(key, fmt::format("expected a place in the domain, from 0 to {:g} m, found {:g} m", end, place));
  };
  requireInside("initial.position", layer.position);
  if (layer.burnt) return;
  layer.hotPosition = neededQuantity(deck, "initial", "hot_position", "a hot layer");
  layer.hotWidth = neededQuantity(deck, "initial", "hot_width", "a hot layer");
  requireInside("initial.hot_position", layer.hotPosition);
}

}  // namespace lampblack::app::flowcase
