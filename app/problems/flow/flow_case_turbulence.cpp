// The section turbulence of a flow deck, and what its inlets bring of turbulence.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/problems/flow/flow_case_parts.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app::flowcase {
namespace {

constexpr double ratioOfStream = 0.21;  // of an inlet that says nothing, for models of one equation: 3 nu of SA

// m^2/s, of a gas.
double kinematicViscosity(const FlowCase& flowCase, double temperature, std::span<const double> Y) {
  const Thermo thermo(*flowCase.mechanism);
  Transport transport(*flowCase.mechanism, flowCase.transport.averaged());
  std::vector<double> X(Y.size()), D(Y.size());
  thermo.massToMole(Y, X);
  return transport.mixture(temperature, flowCase.pressure, X, D).viscosity /
         thermo.density(temperature, flowCase.pressure, Y);
}

FreeStream streamOf(const Deck& deck, const BoundaryCondition& boundary, FlowCase& flowCase) {
  const std::string section = "boundaries." + boundary.name, intensityKey = section + ".turbulence_intensity";
  const auto intensity = deck.optionalNumber(intensityKey);
  const auto length = deck.optionalQuantity(section + ".turbulence_length");
  const auto ratio = deck.optionalNumber(section + ".eddy_viscosity_ratio");
  const bool knowsEnergy = flowCase.turbulence.model->knowsEnergy();
  if (boundary.varies.turbulentEnergy) {
    if (intensity || length || ratio)
      throw deck.error(
          section,
          "the turbulence that comes in is given by 'turbulent_kinetic_energy' and 'turbulent_dissipation'; "
          "expected no 'turbulence_intensity', 'turbulence_length' and 'eddy_viscosity_ratio' beside them");
    return {.viscosity = kinematicViscosity(flowCase, boundary.temperature, boundary.Y),
            .energyAt = boundary.varies.turbulentEnergy,
            .dissipationAt = boundary.varies.turbulentDissipation};
  }
  if (length && ratio)
    throw deck.error(section, "expected one of 'turbulence_length' and 'eddy_viscosity_ratio', found both");
  if (length && !intensity) throw deck.error(section, "a 'turbulence_length' needs a 'turbulence_intensity', too");
  if (knowsEnergy && (!intensity || (!length && !ratio)))
    throw deck.error(section,
                     "this turbulence model needs a 'turbulence_intensity' and one of 'turbulence_length' and "
                     "'eddy_viscosity_ratio' of each inlet, or by formula or table its 'turbulent_kinetic_energy' and "
                     "'turbulent_dissipation'");
  FreeStream stream;
  stream.viscosity = kinematicViscosity(flowCase, boundary.temperature, boundary.Y);
  stream.eddyViscosity = ratio.value_or(ratioOfStream) * stream.viscosity;
  if (!intensity) return stream;
  const double fluctuation = *intensity * std::abs(boundary.speed);
  stream.energy = 1.5 * fluctuation * fluctuation;
  if (knowsEnergy && !(stream.energy > 0.0))
    throw deck.error(intensityKey, "expected an inlet with a velocity, whose turbulent energy is above zero");
  // omega = k^(1/2)/(C_mu^(1/4) l), with C_mu = 0.09.
  if (length) stream.eddyViscosity = std::sqrt(stream.energy) * std::pow(0.09, 0.25) * *length;
  if (length && !flowCase.meshFile) {
    double most = 0.0;
    for (const std::vector<double>& vertices : flowCase.mesh.vertices)
      if (!vertices.empty()) most = std::max(most, vertices.back() - vertices.front());
    if (*length > most)
      flowCase.notes.push_back(
          fmt::format("{}.turbulence_length: {:g} m, more than the mesh is long", section, *length));
  }
  if (*intensity > 1.0) flowCase.notes.push_back(fmt::format("{}: more than one, {:g}", intensityKey, *intensity));
  return stream;
}

}  // namespace

void addTurbulenceKeys(DeckSchema& schema) {
  SectionKeys keys("");
  std::vector<std::string> names{"none"}, described, blended, ofEnergy;
  for (const TurbulenceRow& row : turbulenceModels()) {
    names.emplace_back(row.name);
    described.push_back(fmt::format("{}: {}", row.name, row.description));
    if (turbulenceModel(row.name)->wallBeta() > 0.0) blended.emplace_back(row.name);
    if (turbulenceModel(row.name)->knowsEnergy()) ofEnergy.emplace_back(row.name);
  }
  const std::vector<std::string> models(names.begin() + 1, names.end());
  keys.choice("turbulence.model", names, rules().byDefault("none"),
              fmt::format("Model of Reynolds-averaged turbulence. none: laminar, or all eddies resolved; {}. All but "
                          "k_epsilon and realizable_k_epsilon resolve the layers beside walls: y+ of the first cells "
                          "(history.csv) about one or less; those have wall functions: y+ from 30 to 300 (or "
                          "turbulence.walls: automatic).",
                          fmt::join(described, "; ")));
  keys.number("turbulence.prandtl", rules().byDefault("0.9").above(0).onlyWith("turbulence.model", models),
              "Turbulent Prandtl number: eddies mix heat by their viscosity over it.");
  keys.number("turbulence.schmidt", rules().byDefault("0.9").above(0).onlyWith("turbulence.model", models),
              "Turbulent Schmidt number, of species and of the particles of models. In flames 0.7 is usual for both.");
  keys.number("turbulence.eddy_viscosity_ratio", rules().byDefault("10").above(0).onlyWith("turbulence.model", models),
              "Eddy viscosity over that of the molecules at the start, and of gas that outlets draw in.");
  keys.choice(
      "turbulence.wall_distance", {"walls", "infinite"},
      rules().byDefault("walls").onlyWith("turbulence.model", models),
      "Distances from walls, by which sa, sst, sst1994, wang and k-epsilon with automatic walls go. infinite: as if "
      "there were no walls, for jets and other flows far from them.");
  keys.choice(
      "turbulence.walls", {"resolved", "automatic"}, rules().optional().onlyWith("turbulence.model", blended),
      "How a model of two equations meets walls. resolved, of those with omega the default, not for the k-epsilon "
      "models: the first cell has y+ of about one or less. automatic: by both layers of the law of the wall at "
      "once, for cells of any thickness up to y+ 300; the k-epsilon models resolve the layers beside walls by "
      "algebraic lengths then, and without the key have wall functions.");
  keys.number("turbulence.c_epsilon1",
              rules().byDefault("1.44").above(0).below(1.92).onlyWith("turbulence.model", {"k_epsilon"}),
              "C_1 of k_epsilon, by which what makes k makes epsilon. 1.6 lets round jets spread as they are measured "
              "to; beside walls the logarithmic layer is another then (kappa 0.35).");
  keys.number("turbulence.largest_eddy_viscosity_ratio",
              rules().byDefault("1e5").above(0).onlyWith("turbulence.model", models),
              "A run ends where the eddy viscosity over that of the molecules becomes larger.");
  keys.boolean("turbulence.buoyancy", rules().byDefault("false").onlyWith("turbulence.model", ofEnergy),
               "Whether eddies gain k where gravity and the slope of the density make them, and lose it where they "
               "hinder them; off as in most published results.");
  keys.quantity(
      "turbulence.energy", units::velocity * units::velocity,
      rules().optional().above(0).onlyWith("turbulence.model", models),
      "Turbulent kinetic energy k at the start, and of gas that outlets draw in, '0.3 m^2/s^2', of models of two "
      "equations; absent: the largest that an inlet brings by its intensity.");
  keys.number("boundaries.*.turbulence_intensity", rules().optional().above(0).onlyWith("boundaries.*.type", {"inlet"}),
              "Fluctuations of the velocity over the velocity: k = 1.5 (intensity * velocity)^2, of the velocity in "
              "the middle where it varies.");
  keys.quantity("boundaries.*.turbulence_length", units::length,
                rules().optional().above(0).onlyWith("boundaries.*.type", {"inlet"}),
                "Length of the eddies that come in; in developed pipes 0.07 of the diameter.");
  keys.number("boundaries.*.eddy_viscosity_ratio", rules().optional().above(0).onlyWith("boundaries.*.type", {"inlet"}),
              "Eddy viscosity over that of the molecules of the gas that comes in, in place of the length; absent, for "
              "models of one equation: 0.21.");
  schema.add(keys.schema());
}

void readTurbulenceModel(const Deck& deck, FlowCase& flowCase) {
  const std::string name = deck.choice("turbulence.model");
  if (name == "none") return;
  TurbulenceChoices choices;
  if (deck.isGiven("turbulence.walls")) {
    choices.blendsLayers = deck.choice("turbulence.walls") == "automatic";
    if (!choices.blendsLayers && turbulenceModel(name)->usesWallLaw())
      throw deck.error("turbulence.walls",
                       fmt::format("'{}' has no form of its own for the layers beside walls; expected 'automatic', or "
                                   "no key for wall functions",
                                   name));
  }
  if (deck.isGiven("turbulence.c_epsilon1")) choices.dissipationSource = deck.number("turbulence.c_epsilon1");
  flowCase.turbulence.model = turbulenceModel(name, choices);
}

// The algebraic lengths of a k-epsilon model go by the distance from the wall whose layer they resolve.
void checkThatNoLayerIsLost(const Deck& deck, const FlowCase& flowCase) {
  const TurbulenceModel& model = *flowCase.turbulence.model;
  if (model.wallLaw() != WallLaw::Blended || model.secondVariable() != SecondVariable::Dissipation) return;
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.isNoSlipWall())
      throw deck.error("turbulence.wall_distance",
                       fmt::format("with 'turbulence.walls: automatic' '{}' resolves the layer beside the wall '{}' by "
                                   "the distance from it; expected walls, or no 'turbulence.walls'",
                                   model.name(), boundary.name));
}

void readTurbulence(const Deck& deck, FlowCase& flowCase) {
  const std::string name = deck.choice("turbulence.model");
  if (name == "none") {
    for (const BoundaryCondition& boundary : flowCase.boundaries)
      for (const char* key : {"turbulence_intensity", "turbulence_length", "eddy_viscosity_ratio"})
        if (const std::string full = "boundaries." + boundary.name + "." + key; deck.has(full))
          throw deck.error(full, "the flow has no turbulence model; expected a 'turbulence.model'");
    for (const BoundaryCondition& boundary : flowCase.boundaries)
      if (boundary.varies.turbulentEnergy)
        throw deck.error("boundaries." + boundary.name,
                         "turbulence comes in, and the flow has no turbulence model; expected a 'turbulence.model'");
    return;
  }
  TurbulenceCase& turbulence = flowCase.turbulence;
  turbulence.ignoresWalls = deck.choice("turbulence.wall_distance") == "infinite";
  if (turbulence.ignoresWalls) checkThatNoLayerIsLost(deck, flowCase);
  turbulence.options.mostRatio = deck.number("turbulence.largest_eddy_viscosity_ratio");
  if (turbulence.model->knowsEnergy()) turbulence.options.buoyancy = deck.boolean("turbulence.buoyancy");
  if (turbulence.options.buoyancy && length(flowCase.gravity) == 0.0)
    throw deck.error("turbulence.buoyancy", "there is no gravity; expected 'gravity: {z: -9.81 m/s^2}' or the like");
  turbulence.numbers = {deck.number("turbulence.prandtl"), deck.number("turbulence.schmidt")};
  if (flowCase.swirls)
    flowCase.notes.push_back(
        fmt::format("turbulence.model: '{}' knows the strain of a flow that swirls, and not what the curvature of its "
                    "streamlines does to eddies: strong swirl decays too fast",
                    name));
  if (turbulence.model->needsWallDistance() && !turbulence.ignoresWalls &&
      std::ranges::none_of(flowCase.boundaries,
                           [](const BoundaryCondition& boundary) { return boundary.isNoSlipWall(); })) {
    std::vector<std::string> names;
    for (const BoundaryCondition& boundary : flowCase.boundaries) names.push_back(boundary.name);
    throw deck.error(
        "turbulence.model",
        fmt::format("'{}' goes by the distance from walls, and no boundary is a wall without slip: {}; where all "
                    "of them are far away 'wall_distance: infinite' does without",
                    name, fmt::join(names, ", ")));
  }
  const Stream first{flowCase.initial.low.temperature, flowCase.initial.low.Y};
  turbulence.start.viscosity = kinematicViscosity(flowCase, first.temperature, first.Y);
  turbulence.start.eddyViscosity = deck.number("turbulence.eddy_viscosity_ratio") * turbulence.start.viscosity;
  std::map<std::string, FreeStream> streams;  // of inlets
  double most = 0.0;
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.kind == BoundaryKind::Inlet) {
      const FreeStream& stream = streams[boundary.name] = streamOf(deck, boundary, flowCase);
      most = std::max(most, stream.energy);
    }
  if (turbulence.model->knowsEnergy()) {
    turbulence.start.energy = deck.optionalQuantity("turbulence.energy").value_or(most);
    if (!(turbulence.start.energy > 0.0))
      throw deck.error("turbulence",
                       fmt::format("'{}' needs the key 'energy', as no inlet has a 'turbulence_intensity'", name));
  }
  for (const BoundaryCondition& boundary : flowCase.boundaries) {
    const auto stream = streams.find(boundary.name);
    turbulence.boundaries.push_back(stream == streams.end() ? turbulence.start : stream->second);
  }
}

}  // namespace lampblack::app::flowcase
