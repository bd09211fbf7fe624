#include "app/flow_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/gas_input.hpp"
#include "app/soot_deck.hpp"
#include "core/errors.hpp"
#include "core/grading.hpp"

namespace lampblack {
namespace {

using AxisNames = std::array<std::string, 2>;

AxisNames axisNames(Geometry geometry) {
  return geometry == Geometry::Axisymmetric ? AxisNames{"r", "z"} : AxisNames{"x", "y"};
}

MeshSpec readMesh(const Deck& deck) {
  MeshSpec spec;
  spec.geometry = deck.choice("mesh.geometry") == "axisymmetric" ? Geometry::Axisymmetric : Geometry::Planar;
  const AxisNames names = axisNames(spec.geometry);
  const AxisNames others =
      axisNames(spec.geometry == Geometry::Axisymmetric ? Geometry::Planar : Geometry::Axisymmetric);
  for (const std::string& other : others)
    if (deck.has("mesh." + other))
      throw deck.error("mesh." + other, fmt::format("a {} mesh has the axes {} and {}", deck.choice("mesh.geometry"),
                                                    names[0], names[1]));
  const double refinement = deck.number("mesh.refinement");
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::string list = "mesh." + names[axis];
    std::vector<AxisSegment> segments;
    for (std::size_t i = 0; i < deck.size(list); ++i) {
      const std::string item = fmt::format("{}[{}].", list, i);
      segments.push_back(
          {deck.quantity(item + "to"), static_cast<int>(deck.integer(item + "cells")), deck.number(item + "ratio")});
    }
    if (segments.empty())
      throw deck.error("mesh", fmt::format("the mesh has no cells along {}: expected a list '{}' of segments",
                                           names[axis], names[axis]));
    try {
      spec.vertices[axis] = gradedAxis(0.0, segments, refinement);
    } catch (const InputError& error) {
      throw deck.error(list, error.what());
    }
  }
  return spec;
}

// Species names of a composition, as mass fractions; `key` is where the deck says it.
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

double requiredQuantity(const Deck& deck, const std::string& section, const std::string& name, const std::string& why) {
  const auto value = deck.optionalQuantity(section + "." + name);
  if (!value) throw deck.error(section, fmt::format("{} needs the key '{}'", why, name));
  return *value;
}

void readBoundaries(const Deck& deck, const Mechanism& mechanism, FlowCase& flowCase) {
  const AxisNames names = axisNames(flowCase.mesh.geometry);
  for (const std::string& name : deck.children("boundaries")) {
    const std::string section = "boundaries." + name;
    BoundaryPatch patch{name};
    const std::string side = deck.choice(section + ".side");
    const auto axis = std::find(names.begin(), names.end(), side.substr(0, 1));
    if (axis == names.end())
      throw deck.error(section + ".side", fmt::format("the axes of this mesh are {} and {}", names[0], names[1]));
    patch.axis = static_cast<int>(axis - names.begin());
    patch.atMax = side.ends_with("max");
    if (const auto from = deck.optionalQuantity(section + ".from")) patch.from = *from;
    if (const auto to = deck.optionalQuantity(section + ".to")) patch.to = *to;

    BoundaryCondition boundary;
    boundary.name = name;
    const std::string type = deck.choice(section + ".type");
    boundary.slip = deck.boolean(section + ".slip");
    boundary.fixedComposition = deck.choice(section + ".species") == "fixed";
    const bool hasTemperature = deck.has(section + ".temperature");
    if (type == "inlet" || type == "outlet") {
      boundary.kind = type == "inlet" ? BoundaryKind::Inlet : BoundaryKind::Outlet;
      const std::string what = type == "inlet" ? "an inlet" : "an outlet (for the gas it may entrain)";
      boundary.temperature = requiredQuantity(deck, section, "temperature", what);
      if (!deck.has(section + ".composition")) throw deck.error(section, what + " needs the key 'composition'");
      boundary.Y = readComposition(deck, section + ".composition", mechanism);
    }
    if (type == "inlet")
      boundary.speed = requiredQuantity(deck, section, "velocity", "an inlet");
    if (type == "symmetry") boundary.kind = BoundaryKind::Symmetry;
    if (type == "wall") {
      boundary.isothermal = hasTemperature;
      if (hasTemperature) boundary.temperature = deck.quantity(section + ".temperature");
    }
    flowCase.mesh.patches.push_back(patch);
    flowCase.boundaries.push_back(std::move(boundary));
  }
  if (std::none_of(flowCase.boundaries.begin(), flowCase.boundaries.end(),
                   [](const BoundaryCondition& b) { return b.kind == BoundaryKind::Outlet; }))
    throw deck.error("boundaries", "one boundary has to be an outlet; closed domains are not supported yet");
}

// Every face of the surface belongs to a boundary; the first that does not is told before anything is made.
void checkCoverage(const Deck& deck, const MeshSpec& mesh) {
  for (int axis = 0; axis < 2; ++axis)
    for (const bool atMax : {false, true}) {
      const auto& along = mesh.vertices[static_cast<std::size_t>(1 - axis)];
      const auto& across = mesh.vertices[static_cast<std::size_t>(axis)];
      for (std::size_t i = 0; i + 1 < along.size(); ++i) {
        std::array<double, 2> face{};
        face[static_cast<std::size_t>(axis)] = atMax ? across.back() : across.front();
        const double place = face[static_cast<std::size_t>(1 - axis)] = 0.5 * (along[i] + along[i + 1]);
        if (std::none_of(mesh.patches.begin(), mesh.patches.end(), [&](const BoundaryPatch& p) {
              return p.axis == axis && p.atMax == atMax && place >= p.from && place <= p.to;
            }))
          throw deck.error("boundaries", fmt::format("the boundary face at ({:.6g}, {:.6g}) m belongs to no boundary",
                                                     face[0], face[1]));
      }
    }
}

Stream streamOf(const Deck& deck, const std::string& key, const FlowCase& flowCase) {
  const std::string name = deck.string(key);
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.name == name && boundary.kind == BoundaryKind::Inlet) return {boundary.temperature, boundary.Y};
  std::string inlets;
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.kind == BoundaryKind::Inlet) inlets += (inlets.empty() ? "" : ", ") + boundary.name;
  throw deck.error(key, fmt::format("'{}' is not an inlet; the inlets are: {}", name, inlets));
}

void readInitial(const Deck& deck, FlowCase& flowCase) {
  MixingLayer& layer = flowCase.initial;
  layer.low = streamOf(deck, "initial.low", flowCase);
  layer.high = streamOf(deck, "initial.high", flowCase);
  layer.position = deck.quantity("initial.position");
  layer.width = deck.quantity("initial.width");
  layer.temperature = deck.quantity("initial.temperature");
  layer.burnt = deck.choice("initial.layer") == "burnt";
  if (!layer.burnt) {
    layer.hotPosition = requiredQuantity(deck, "initial", "hot_position", "a hot layer");
    layer.hotWidth = requiredQuantity(deck, "initial", "hot_width", "a hot layer");
  }
}

void readOutput(const Deck& deck, FlowCase& flowCase) {
  OutputControl& output = flowCase.output;
  output.interval = deck.optionalQuantity("output.interval").value_or(flowCase.time.end);
  output.historySteps = static_cast<int>(deck.integer("output.history_steps"));
  const std::vector<std::string> names = deck.strings("output.species");
  for (const std::string& name : names) {
    if (name == "all") {
      output.species.clear();
      for (std::size_t k = 0; k < flowCase.mechanism->numSpecies(); ++k) output.species.push_back(k);
      return;
    }
    try {
      output.species.push_back(flowCase.mechanism->speciesIndex(name));
    } catch (const InputError& error) {
      throw deck.error("output.species", error.what());
    }
  }
}

void readSoot(const Deck& deck, FlowCase& flowCase) {
  if (!deck.has("soot")) return;
  if (deck.choice("soot.model") == "none") {
    if (deck.has("trajectories"))
      flowCase.notes.push_back("soot.model is none: the trajectories of the deck are left out");
    return;
  }
  const Mechanism& mechanism = *flowCase.mechanism;
  SootModelOptions options;
  options.sootDensity = deck.quantity("soot.density");
  options.alpha = deck.optionalNumber("soot.alpha");
  options.ohEfficiency = deck.number("soot.oh_efficiency");
  options.vanDerWaals = deck.number("soot.van_der_waals");
  try {
    const std::size_t carbon = mechanism.elementIndex("C");
    const std::size_t hydrogen = mechanism.elementIndex("H");
    options.carbonWeight = mechanism.atomicWeight(carbon);
    options.hydrogenWeight = mechanism.atomicWeight(hydrogen);
    for (const char* name : {"H", "H2", "OH", "H2O", "O2", "C2H2", "CO"})
      static_cast<void>(mechanism.speciesIndex(name));
  } catch (const InputError& error) {
    throw deck.error("soot.pah", error.what());
  }
  options.pah = readPahSpecies(deck, mechanism);
  flowCase.soot = options;
}

void readTransport(const Deck& deck, FlowCase& flowCase) {
  const Mechanism& mechanism = *flowCase.mechanism;
  auto& options = flowCase.transport;
  options.integrals = readCollisionIntegrals(deck, mechanism);
  const auto model = deck.choice("transport.model");
  if (model == "unity_lewis") options.diffusion = DiffusionModel::UnityLewis;
  if (model == "constant_lewis") options.diffusion = DiffusionModel::ConstantLewis;
  options.lewisNumbers = readLewisNumbers(deck, mechanism);
}

void readTrajectories(const Deck& deck, FlowCase& flowCase) {
  if (!deck.has("trajectories")) return;
  if (deck.has("soot") && deck.choice("soot.model") == "none") return;
  if (!flowCase.soot)
    throw deck.error("trajectories", "trajectories need a 'soot' section: it names the particle model");
  TrajectoryRequest options;
  options.duration = deck.quantity("trajectories.duration");
  options.timeStep = deck.quantity("trajectories.time_step");
  options.particles = static_cast<int>(deck.integer("trajectories.particles"));
  options.bins = static_cast<int>(deck.integer("trajectories.bins"));
  options.smallest = deck.quantity("trajectories.smallest");
  options.largest = deck.quantity("trajectories.largest");
  if (options.largest <= options.smallest) throw deck.error("trajectories.largest", "expected more than 'smallest'");
  for (std::size_t i = 0; i < deck.size("trajectories.start"); ++i) {
    const std::string item = fmt::format("trajectories.start[{}]", i);
    const TrajectoryStart start{deck.quantity(item + ".r"), deck.quantity(item + ".z")};
    const auto& v = flowCase.mesh.vertices;
    if (start.r > v[0].back() || start.z > v[1].back()) throw deck.error(item, "the start lies outside the mesh");
    options.starts.push_back(start);
  }
  flowCase.trajectories = options;
}

}  // namespace

FlowCase readFlowCase(const Deck& deck) {
  FlowCase flowCase;
  flowCase.title = deck.string("title");
  flowCase.pressure = deck.quantity("pressure");
  flowCase.seed = static_cast<std::uint64_t>(deck.integer("seed"));
  flowCase.mesh = readMesh(deck);
  flowCase.mechanism = readMechanism(deck);
  readTransport(deck, flowCase);
  readBoundaries(deck, *flowCase.mechanism, flowCase);
  checkCoverage(deck, flowCase.mesh);
  readInitial(deck, flowCase);
  flowCase.time = {deck.quantity("time.end"), deck.quantity("time.first_step"), deck.quantity("time.maximum_step"),
                   deck.number("time.courant"), deck.number("time.growth")};
  flowCase.chemistry.deferred = deck.choice("chemistry.coupling") == "deferred";
  flowCase.chemistry.shareWork = deck.boolean("chemistry.share_work");
  flowCase.chemistry.reactor.relativeTolerance = deck.number("chemistry.relative_tolerance");
  flowCase.chemistry.reactor.absoluteTolerance = deck.number("chemistry.absolute_tolerance");
  readOutput(deck, flowCase);
  readSoot(deck, flowCase);
  readTrajectories(deck, flowCase);
  return flowCase;
}

}  // namespace lampblack
