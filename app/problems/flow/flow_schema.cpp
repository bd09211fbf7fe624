#include <array>
#include <string>

#include "app/deck/gas_input.hpp"
#include "app/deck/initial_distribution.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/radiation_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/deck/transport_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "app/problems/flow/flow_case.hpp"
#include "app/problems/flow/flow_case_parts.hpp"
#include "app/problems/flow/given_fields.hpp"
#include "app/problems/flow/initial_flame1d.hpp"
#include "app/problems/flow/initial_flow.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {
namespace {

void addBoundaries(DeckSchema& schema) {
  SectionKeys keys("");
  keys.section("boundaries", Presence::required,
               "Named parts of the surface and what happens there. The axis of an axisymmetric box needs none.");
  keys.choice("boundaries.*.type", {"inlet", "outlet", "wall", "symmetry", "periodic"}, rules(),
              "Kind of boundary: a stream that comes in, an opening, a solid wall, an axis or plane of symmetry, or "
              "one of two opposite sides of which what leaves by one comes in by the other.");
  keys.choice("boundaries.*.side", {"r-min", "r-max", "z-min", "z-max", "x-min", "x-max", "y-min", "y-max"},
              rules().optional(),
              "Side of the box that the boundary lies on. A box needs it, or 'solid'; boundaries of a mesh file go by "
              "their names.");
  keys.text("boundaries.*.solid", rules().optional(),
            "Solid of 'mesh.solids' whose surface the boundary is, in place of a side.");
  keys.quantity("boundaries.*.from", units::length, rules().optional(),
                "Coordinate along the side (in space: along the first of its two axes) where the boundary starts; "
                "absent: the lower end of the side.");
  keys.quantity("boundaries.*.to", units::length, rules().optional(),
                "Coordinate along the side where the boundary ends; absent: the upper end of the side.");
  keys.quantity("boundaries.*.velocity", units::velocity,
                rules().optional().atLeast(0).onlyWith("boundaries.*.type", {"inlet"}),
                "Normal velocity into the domain. Of a mass flow it is that over the density and the area.");
  keys.quantity("boundaries.*.tangential_velocity", units::velocity,
                rules().optional().onlyWith("boundaries.*.type", {"inlet", "wall"}),
                "Velocity along the boundary, in the direction of its axis: of a moving wall, or of a stream that "
                "comes in at an angle; absent: zero. Not in space.");
  keys.quantity("boundaries.*.swirl_velocity", units::velocity,
                rules().optional().onlyWith("boundaries.*.type", {"inlet", "wall"}),
                "Velocity about the axis of an axisymmetric flow: of a stream that swirls, or of a wall that turns "
                "(formula: {swirl_velocity: '50*r'} for 50 rad/s); absent: zero.");
  keys.quantity("boundaries.*.temperature", units::temperature,
                temperatureRules().optional().onlyWith("boundaries.*.type", {"inlet", "outlet", "wall"}),
                "inlet: of the stream, needed; outlet: of entrained gas, needed unless the start is one gas everywhere "
                "(initial.layer: none, with its temperature and composition), which is then also outside; wall: "
                "isothermal at this temperature.");
  keys.text("boundaries.*.composition", rules().optional().onlyWith("boundaries.*.type", {"inlet", "outlet"}),
            "Mole fractions of the stream (inlet) or of gas that is entrained (outlet), 'C2H4: 1, N2: 3'; needed as "
            "the temperature is.");
  keys.choice("boundaries.*.species", {"flux", "fixed"},
              rules().byDefault("flux").onlyWith("boundaries.*.type", {"inlet"}),
              "flux: what the stream carries comes in, and nothing is lost by diffusion into the nozzle; fixed: the "
              "mass fractions at the inlet are held.");
  keys.quantity("boundaries.*.heat_flux", units::heatFlux, rules().optional().onlyWith("boundaries.*.type", {"wall"}),
                "Heat that comes through the wall into the gas; absent, and without a temperature: adiabatic.");
  keys.choice(
      "boundaries.*.particles", {"deposit", "reflect"}, rules().optional().onlyWith("boundaries.*.type", {"wall"}),
      "deposit: particles of models and ensembles that come to the wall, by thermophoresis and by diffusion, stay "
      "there; reflect: the wall takes none. Absent: deposit, of a wall with slip, which stands for no solid, reflect.");
  keys.boolean("boundaries.*.slip", rules().byDefault("false").onlyWith("boundaries.*.type", {"wall"}),
               "true: the gas slides along the wall without friction; false: it sticks to the wall.");
  flowcase::addGivenFieldKeys(
      keys.schema(), "boundaries.*",
      "velocity (below zero: the gas that is there leaves), tangential_velocity, swirl_velocity, temperature, "
      "heat_flux, of an inlet turbulent_kinetic_energy and turbulent_dissipation (both, in place of the keys "
      "'turbulence_intensity' and 'turbulence_length'), and, of a stream, X_<species>, its mole fraction (the species "
      "that are not "
      "named share what is left of one in the proportions of 'composition')");
  schema.add(keys.schema());
}

void addGravity(DeckSchema& schema) {
  SectionKeys keys("");
  keys.section("gravity", Presence::optional,
               "Acceleration of gravity; absent: none. Along an outlet the gas outside is at rest.");
  for (const std::string axis : {"r", "z", "x", "y"})
    keys.quantity("gravity." + axis, units::acceleration, rules().optional(),
                  "Component along the " + axis + " axis, '-9.81 m/s^2'.");
  keys.section("driving_acceleration", Presence::optional,
               "What drives the gas along periodic sides, in place of the difference of pressures over them: a force "
               "on all of the gas, by its mass (over the density, a mean gradient of the pressure); absent: none. Not "
               "with gravity, nor with outlets.");
  for (const std::string axis : {"z", "x", "y"})
    keys.quantity("driving_acceleration." + axis, units::acceleration, rules().optional(),
                  "Component along the " + axis + " axis, whose two sides are periodic.");
  schema.add(keys.schema());
}

void addInitial(DeckSchema& schema) {
  SectionKeys keys("initial");
  keys.section(Presence::required,
               "The start: two streams that mix across a burnt or hot layer, or one gas everywhere; over either what "
               "formulas, a table, a one-dimensional flame or an earlier run give.");
  keys.choice("layer", {"burnt", "hot", "none"}, rules().byDefault("burnt"),
              "burnt: complete combustion where the streams meet (without CO2 in the mechanism: equilibrium); hot: "
              "cold mixture with a hot layer that ignites it; none: one gas everywhere.");
  keys.text("low", rules().optional().onlyWith("initial.layer", {"burnt", "hot"}),
            "Boundary whose stream fills the low end of the axis (z; planar and in space: y). A layer needs it.");
  keys.text("high", rules().optional().onlyWith("initial.layer", {"burnt", "hot"}),
            "Boundary whose stream fills the high end. A layer needs it.");
  keys.quantity("position", units::length, rules().optional().onlyWith("initial.layer", {"burnt", "hot"}),
                "Coordinate on the axis where half of the mixture is of either stream. A layer needs it.");
  keys.quantity("width", units::length, rules().optional().above(0).onlyWith("initial.layer", {"burnt", "hot"}),
                "Width of the mixing layer, which a layer needs.");
  keys.text("composition", rules().optional().onlyWith("initial.layer", {"none"}),
            "Mole fractions of the gas, 'O2: 0.21, N2: 0.79', where there is no layer.");
  keys.quantity("temperature", units::temperature, temperatureRules().byDefault("2200 K"),
                "burnt: upper limit of the temperature; hot: peak of the hot layer; none: of the gas.");
  keys.quantity("hot_position", units::length, rules().optional().onlyWith("initial.layer", {"hot"}),
                "Centre of the hot layer.");
  keys.quantity("hot_width", units::length, rules().optional().above(0).onlyWith("initial.layer", {"hot"}),
                "Half width of the hot layer.");
  flowcase::addGivenFieldKeys(keys.schema(), "initial",
                              "temperature, velocity_<axis>, swirl_velocity (about the axis) and X_<species>, the mole "
                              "fraction (the species that are "
                              "not named keep their proportions)");
  flowcase::addInitialFlameKeys(keys.schema());
  flowcase::addInitialFlowKeys(keys.schema());
  schema.add(keys.schema());
}

void addConvectionAndOutput(DeckSchema& schema) {
  SectionKeys keys("");
  keys.choice("convection.velocity", {"limited", "central"}, rules().byDefault("limited"),
              "How the flow carries its velocity. limited: upwind of second order, of first where the flow is not "
              "smooth; robust, for steady flames. central: of fourth order on even cells with little damping, for "
              "flows that have to keep vortices a few cells wide; needs 'time.sweeps: 2' or more.");
  flowcase::addOutputKeys(keys.schema());
  schema.add(keys.schema());
}

void addParticles(DeckSchema& schema) {
  SectionKeys keys("");
  addParticleKeys(keys.schema(),
                  {.description = "Particles, carried by the gas, or in the cells as ensembles or trees, which "
                                  "move with the gas, by thermophoresis and by diffusion from cell to cell; "
                                  "their random numbers are those of 'seed'. Absent: none.",
                   .method = "pairs",
                   .ensembleNumber = "400",
                   .treeNumber = "500"});
  addStartKeys(keys.schema());
  SectionKeys part("");
  part.choice(
      "particles.exchange", {"two_way", "one_way"}, rules().byDefault("two_way"),
      "two_way: the gas loses what the particles take, and its heat; one_way: the gas does not know of the particles.");
  part.quantity("particles.averaging_time", units::time,
                rules().formerly("average").byDefault("0.2 ms").atLeast(0).onlyWith("particles.exchange", {"two_way"}),
                "Time over which the exchange between particles and gas is averaged before the gas gets it: longer is "
                "smoother; atoms and heat are conserved in either case. Zero: no average.");
  part.quantity("particles.frozen_gas", units::time, rules().formerly("hold_gas").optional().atLeast(0),
                "Time from which on the gas is frozen and only the particles change, which costs less where a flame is "
                "steady. The exchange with the gas is counted, but not given to the gas. Absent: never.");
  part.quantity(
      "particles.minimum_number_density", units::perVolume,
      rules().formerly("least_number").byDefault("1e12 1/m^3").above(0),
      "Smallest number density that is resolved. Where there are fewer particles, a new numerical particle stands for "
      "this density divided by the largest number of numerical particles, so that traces do not fill ensembles.");
  part.integer("particles.number_at_edges", rules().optional().atLeast(8),
               "Largest number of numerical particles of a cell with next to no particles, by method pairs; others "
               "have 'particles.number' in all cells. A cell in which the number or the volume fraction is as large as "
               "in any has 'particles.number', one in between that times the root of its share of the largest, by the "
               "larger of the two. Saves time where few particles are. Absent: 'particles.number' in all cells.");
  part.number("particles.bundled_growth", rules().formerly("share_at_once").byDefault("0.05").atLeast(0).atMost(0.5),
              "Growth in bundles, of method sammc: share of its volume that a particle may gain from small particles "
              "in one event. Bundles save most events where new particles are many. Number and mass are exact; the "
              "second moment grows too fast by at most half of the share. Zero: no bundles.");
  part.choice("particles.order", {"first", "second"}, rules().byDefault("second"),
              "Order of the particles' transport in place and time. first: more diffusion by the cells' size, fewer "
              "operations.");
  part.boolean(
      "particles.size_distribution", rules().byDefault("true"),
      "Whether the size distribution of each cell is a field of the results, and with particles.statistics its mean "
      "over time: as many numbers a cell as particles.bins, which is about what mole fractions of all species take.");
  part.section(
      "particles.statistics", Presence::optional,
      "Averages of the soot over time, for flames that have become steady but for the noise of their ensembles: of "
      "each cell means, and intervals of confidence from means over blocks of time. Absent: none.");
  part.quantity("particles.statistics.start", units::time, rules().optional().atLeast(0),
                "When the averages start. Absent: by themselves, when the soot in the whole domain and its number have "
                "no trend over the last ten blocks or more.");
  part.quantity(
      "particles.statistics.block", units::time, rules().optional().above(0),
      "Length of a block of time, which should be long against what the soot takes to forget; the report says where it "
      "is not. Five blocks make an interval. Absent: a twentieth of time.end, with 'time.mode: steady' of the "
      "residence time. A run that goes on from a checkpoint keeps the length it has begun with.");
  part.number("particles.statistics.drift", rules().byDefault("0.01").atLeast(0).below(1),
              "Relative change of the soot over the blocks that are looked at which counts as no trend, however clear "
              "it is; for averages that start by themselves.");
  part.section("particles.regions.*", Presence::optional,
               "A box of which the size distribution and, of aggregates, the joint distribution of the primary "
               "particles' diameter and number are written with each field output, to the tables "
               "tables/sizes_<name>.csv and tables/joint_<name>.csv: mean of the cells with their centre in it.");
  part.quantity("particles.regions.*.from", units::length, rules().list(),
                "Smallest coordinates of the box, '[0 mm, 3 mm]', in space three.");
  part.quantity("particles.regions.*.to", units::length, rules().list(), "Largest coordinates of the box.");
  keys.schema().add(part.schema(), ofPopulations());
  keys.section("trajectories", Presence::optional,
               "Stochastic ensembles that ride along streamlines of the final flow; needs the section particles.");
  keys.quantity("trajectories.duration", units::time, rules().byDefault("50 ms").above(0),
                "Longest time that an ensemble is followed along its streamline.");
  keys.quantity("trajectories.time_step", units::time, rules().byDefault("50 us").above(0),
                "Time between two points of a streamline at which the state of the gas is taken.");
  keys.integer("trajectories.particles", rules().byDefault("4096").atLeast(16),
               "Largest number of numerical particles of an ensemble: more have less noise and cost more.");
  keys.boolean("trajectories.gas_tables", rules().byDefault("false"),
               "Whether the gas of each path, all of its species, is written to tables/streamline_<number>.csv, which "
               "gas.file of a deck with problem: prescribed_gas reads.");
  keys.add(splitToleranceKey("trajectories", "0.01"));
  addSizeBinKeys(keys.schema(), "trajectories", "200 nm");
  keys.section("trajectories.start", Presence::required, "Where the ensembles start.");
  keys.quantity("trajectories.start[].r", units::length, rules().optional().atLeast(0),
                "Where a streamline starts: radius of an axisymmetric mesh (in a plane the same as x).");
  keys.quantity("trajectories.start[].x", units::length, rules().optional(), "Where a streamline starts: along x.");
  keys.quantity("trajectories.start[].y", units::length, rules().optional(), "Where a streamline starts: along y.");
  keys.quantity("trajectories.start[].z", units::length, rules().optional(),
                "Where a streamline starts: axial position, or in space along z (with r in a plane the same as y).");
  schema.add(keys.schema());
}

}  // namespace

DeckSchema flowSchema() {
  SectionKeys keys("");
  keys.choice("problem", {"flow"}, rules(), "What is solved.");
  keys.text("title", rules().byDefault("''"), "One line for reports and pictures.");
  addMechanismKeys(keys.schema());
  keys.quantity("pressure", units::pressure, rules().byDefault("1 atm").above(0),
                "Thermodynamic pressure p0 of the gas, the same everywhere.");
  keys.integer("seed", rules().byDefault("1").atLeast(0),
               "Start of all random numbers: another seed gives another sample, the same seed the same result.");
  flowcase::addMeshKeys(keys.schema());
  addBoundaries(keys.schema());
  addInitial(keys.schema());
  addGravity(keys.schema());
  addRadiationKeys(keys.schema());
  flowcase::addTurbulenceKeys(keys.schema());
  flowcase::addCombustionKeys(keys.schema());
  flowcase::addTimeKeys(keys.schema());
  addConvectionAndOutput(keys.schema());
  flowcase::addChemistryKeys(keys.schema());
  addTransportKeys(keys.schema());
  addParticles(keys.schema());
  return keys.schema();
}

}  // namespace lampblack::app
