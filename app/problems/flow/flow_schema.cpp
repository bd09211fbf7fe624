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

namespace lampblack::app {
namespace {

void addBoundaries(DeckSchema& schema) {
  schema.section("boundaries", Presence::required, "Named parts of the surface and what happens there.")
      .add(choiceKey(
          "boundaries.*.type", {"inlet", "outlet", "wall", "symmetry", "periodic"},
          "Kind of boundary: a stream that comes in, an opening, a solid wall, an axis or plane of symmetry, or one of "
          "two opposite sides of which what leaves by one comes in by the other."))
      .add(choiceKey(
               "boundaries.*.side", {"r-min", "r-max", "z-min", "z-max", "x-min", "x-max", "y-min", "y-max"},
               "Side of the box that the boundary lies on. A box needs it, or 'solid'; boundaries of a mesh file go "
               "by their names.")
               .optional())
      .add(stringKey("boundaries.*.solid", "Solid of 'mesh.solids' whose surface the boundary is, in place of a side.")
               .optional())
      .add(quantityKey(
               "boundaries.*.from", units::length,
               "Coordinate along the side (in space: along the first of its two axes) where the boundary starts; "
               "absent: the lower end of the side.")
               .optional())
      .add(quantityKey("boundaries.*.to", units::length,
                       "Coordinate along the side where the boundary ends; absent: the upper end of the side.")
               .optional())
      .add(quantityKey("boundaries.*.velocity", units::velocity, "Normal velocity into the domain.")
               .optional()
               .atLeast(0)
               .onlyWith("boundaries.*.type", {"inlet"}))
      .add(quantityKey(
               "boundaries.*.tangential_velocity", units::velocity,
               "Velocity along the boundary, in the direction of its axis: of a moving wall, or of a stream that comes "
               "in at an angle; absent: zero. Not in space.")
               .optional()
               .onlyWith("boundaries.*.type", {"inlet", "wall"}))
      .add(quantityKey("boundaries.*.swirl_velocity", units::velocity,
                       "Velocity about the axis of an axisymmetric flow: of a stream that swirls, or of a wall that "
                       "turns (formula: {swirl_velocity: '50*r'} for 50 rad/s); absent: zero.")
               .optional()
               .onlyWith("boundaries.*.type", {"inlet", "wall"}))
      .add(temperatureKey("boundaries.*.temperature",
                          "inlet: of the stream, needed; outlet: of entrained gas, needed unless the start is one gas "
                          "everywhere (initial.layer: none, with its temperature and composition), which is then also "
                          "outside; wall: isothermal at this temperature.")
               .optional()
               .onlyWith("boundaries.*.type", {"inlet", "outlet", "wall"}))
      .add(stringKey("boundaries.*.composition",
                     "Mole fractions of the stream (inlet) or of gas that is entrained (outlet), 'C2H4: 1, N2: 3'; "
                     "needed as the temperature is.")
               .optional()
               .onlyWith("boundaries.*.type", {"inlet", "outlet"}))
      .add(choiceKey(
               "boundaries.*.species", {"flux", "fixed"},
               "flux: what the stream carries comes in, and nothing is lost by diffusion into the nozzle; fixed: the "
               "mass fractions at the inlet are held.")
               .byDefault("flux")
               .onlyWith("boundaries.*.type", {"inlet"}))
      .add(quantityKey("boundaries.*.heat_flux", units::heatFlux,
                       "Heat that comes through the wall into the gas; absent, and without a temperature: adiabatic.")
               .optional()
               .onlyWith("boundaries.*.type", {"wall"}))
      .add(
          choiceKey(
              "boundaries.*.particles", {"deposit", "reflect"},
              "deposit: particles of models and ensembles that come to the wall, by thermophoresis and by "
              "diffusion, stay there; reflect: the wall takes none. Absent: deposit, of a wall with slip, which stands "
              "for no solid, reflect.")
              .optional()
              .onlyWith("boundaries.*.type", {"wall"}))
      .add(booleanKey("boundaries.*.slip",
                      "true: the gas slides along the wall without friction; false: it sticks to the wall.")
               .byDefault("false")
               .onlyWith("boundaries.*.type", {"wall"}));
  flowcase::addGivenFieldKeys(
      schema, "boundaries.*",
      "velocity (below zero: the gas that is there leaves), tangential_velocity, swirl_velocity, temperature, "
      "heat_flux, of an inlet turbulent_kinetic_energy and turbulent_dissipation (both, in place of the keys "
      "'turbulence_intensity' and 'turbulence_length'), and, of a stream, X_<species>, its mole fraction (the species "
      "that are not "
      "named share what is left of one in the proportions of 'composition')");
}

void addGravity(DeckSchema& schema) {
  schema.section("gravity", Presence::optional,
                 "Acceleration of gravity; absent: none. Along an outlet the gas outside is at rest.");
  for (const std::string axis : {"r", "z", "x", "y"})
    schema.add(
        quantityKey("gravity." + axis, units::acceleration, "Component along the " + axis + " axis, '-9.81 m/s^2'.")
            .optional());
  schema.section(
      "driving_acceleration", Presence::optional,
      "What drives the gas along periodic sides, in place of the difference of pressures over them: a force on "
      "all of the gas, by its mass (over the density, a mean gradient of the pressure); absent: none. Not with "
      "gravity, nor with outlets.");
  for (const std::string axis : {"z", "x", "y"})
    schema.add(quantityKey("driving_acceleration." + axis, units::acceleration,
                           "Component along the " + axis + " axis, whose two sides are periodic.")
                   .optional());
}

void addInitial(DeckSchema& schema) {
  schema
      .section("initial", Presence::required,
               "The start: two streams that mix across a burnt or hot layer, or one gas everywhere; over either "
               "what formulas, a table, a one-dimensional flame or an earlier run give.")
      .add(choiceKey("initial.layer", {"burnt", "hot", "none"},
                     "burnt: complete combustion where the streams meet (without CO2 in the mechanism: equilibrium); "
                     "hot: cold mixture with a hot layer that ignites it; none: one gas everywhere.")
               .byDefault("burnt"))
      .add(stringKey(
               "initial.low",
               "Boundary whose stream fills the low end of the axis (z; planar and in space: y). A layer needs it.")
               .optional()
               .onlyWith("initial.layer", {"burnt", "hot"}))
      .add(stringKey("initial.high", "Boundary whose stream fills the high end. A layer needs it.")
               .optional()
               .onlyWith("initial.layer", {"burnt", "hot"}))
      .add(quantityKey("initial.position", units::length,
                       "Coordinate on the axis where half of the mixture is of either stream. A layer needs it.")
               .optional()
               .onlyWith("initial.layer", {"burnt", "hot"}))
      .add(quantityKey("initial.width", units::length, "Width of the mixing layer, which a layer needs.")
               .optional()
               .above(0)
               .onlyWith("initial.layer", {"burnt", "hot"}))
      .add(stringKey("initial.composition", "Mole fractions of the gas, 'O2: 0.21, N2: 0.79', where there is no layer.")
               .optional()
               .onlyWith("initial.layer", {"none"}))
      .add(temperatureKey("initial.temperature",
                          "burnt: upper limit of the temperature; hot: peak of the hot layer; none: of the gas.")
               .byDefault("2200 K"))
      .add(quantityKey("initial.hot_position", units::length, "Centre of the hot layer.")
               .optional()
               .onlyWith("initial.layer", {"hot"}))
      .add(quantityKey("initial.hot_width", units::length, "Half width of the hot layer.")
               .optional()
               .above(0)
               .onlyWith("initial.layer", {"hot"}));
  flowcase::addGivenFieldKeys(schema, "initial",
                              "temperature, velocity_<axis>, swirl_velocity (about the axis) and X_<species>, the mole "
                              "fraction (the species that are "
                              "not named keep their proportions)");
  flowcase::addInitialFlameKeys(schema);
  flowcase::addInitialFlowKeys(schema);
}

void addConvectionAndOutput(DeckSchema& schema) {
  schema.add(
      choiceKey("convection.velocity", {"limited", "central"},
                "How the flow carries its velocity. limited: upwind of second order, of first where the flow is "
                "not smooth; robust, for steady flames. central: of fourth order on even cells with little "
                "damping, for flows that have to keep vortices a few cells wide; needs 'time.sweeps: 2' or more.")
          .byDefault("limited"));
  flowcase::addOutputKeys(schema);
  schema
      .add(integerKey(
               "checkpoint.steps",
               "Time steps between two checkpoints, from which `lampblack run --restart` continues a run that was "
               "interrupted; absent: checkpoints by wall time and on request only.")
               .optional()
               .atLeast(1))
      .add(quantityKey("checkpoint.wall_time", units::time, "Wall time between two checkpoints.")
               .byDefault("30 min")
               .above(0))
      .add(booleanKey("checkpoint.at_end",
                      "Write a checkpoint at the end of the run too, from which it can be continued to a later end.")
               .byDefault("false"));
}

void addParticles(DeckSchema& schema) {
  addParticleKeys(schema, {.description = "Particles, carried by the gas, or in the cells as ensembles or trees, which "
                                          "move with the gas, by thermophoresis and by diffusion from cell to cell; "
                                          "their random numbers are those of 'seed'. Absent: none.",
                           .method = "pairs",
                           .ensembleNumber = "400",
                           .treeNumber = "500"});
  addStartKeys(schema);
  DeckSchema part;
  part.add(choiceKey("particles.exchange", {"two_way", "one_way"},
                     "two_way: the gas loses what the particles take, and its heat; one_way: the gas does not know of "
                     "the particles.")
               .byDefault("two_way"))
      .add(quantityKey("particles.averaging_time", units::time,
                       "Time over which the exchange between particles and gas is averaged before the gas gets it: "
                       "longer is smoother; atoms and heat are conserved in either case. Zero: no average.")
               .formerly("average")
               .byDefault("0.2 ms")
               .atLeast(0)
               .onlyWith("particles.exchange", {"two_way"}))
      .add(
          quantityKey("particles.frozen_gas", units::time,
                      "Time from which on the gas is frozen and only the particles change, which costs less where a "
                      "flame is steady. The exchange with the gas is counted, but not given to the gas. Absent: never.")
              .formerly("hold_gas")
              .optional()
              .atLeast(0))
      .add(quantityKey("particles.minimum_number_density", units::perVolume,
                       "Smallest number density that is resolved. Where there are fewer particles, a new numerical "
                       "particle stands for this density divided by the largest number of numerical particles, so that "
                       "traces do not fill ensembles.")
               .formerly("least_number")
               .byDefault("1e12 1/m^3")
               .above(0))
      .add(
          integerKey("particles.number_at_edges",
                     "Largest number of numerical particles of a cell with next to no particles, by method pairs; "
                     "others have 'particles.number' in all cells. A cell in which the number or the volume fraction "
                     "is as large as in any has 'particles.number', one in between that times the root of its share of "
                     "the largest, by the larger of the two. Saves time where few particles are. Absent: "
                     "'particles.number' in all cells.")
              .optional()
              .atLeast(8))
      .add(numberKey("particles.bundled_growth",
                     "Growth in bundles, of method sammc: share of its volume that a particle may gain from small "
                     "particles in one event. Bundles save most events where new particles are many. Number and mass "
                     "are exact; the second moment grows too fast by at most half of the share. Zero: no bundles.")
               .formerly("share_at_once")
               .byDefault("0.05")
               .atLeast(0)
               .atMost(0.5))
      .add(choiceKey("particles.order", {"first", "second"},
                     "Order of the particles' transport in place and time. first: more diffusion by the cells' size, "
                     "fewer operations.")
               .byDefault("second"))
      .add(booleanKey("particles.size_distribution",
                      "Whether the size distribution of each cell is a field of the results, and with "
                      "particles.statistics its mean over time: as many numbers a cell as particles.bins, which is "
                      "about what mole fractions of all species take.")
               .byDefault("true"))
      .section("particles.statistics", Presence::optional,
               "Averages of the soot over time, for flames that have become steady but for the noise of their "
               "ensembles: of each cell means, and intervals of confidence from means over blocks of time. Absent: "
               "none.")
      .add(quantityKey("particles.statistics.start", units::time,
                       "When the averages start. Absent: by themselves, when the soot in the whole domain and its "
                       "number have no trend over the last ten blocks or more.")
               .optional()
               .atLeast(0))
      .add(quantityKey(
               "particles.statistics.block", units::time,
               "Length of a block of time, which should be long against what the soot takes to forget; the "
               "report says where it is not. Five blocks make an interval. Absent: a twentieth of time.end, with "
               "'time.mode: steady' of the residence time. "
               "A run that goes on from a checkpoint keeps the length it has begun with.")
               .optional()
               .above(0))
      .add(numberKey("particles.statistics.drift",
                     "Relative change of the soot over the blocks that are looked at which counts as no trend, "
                     "however clear it is; for averages that start by themselves.")
               .byDefault("0.01")
               .atLeast(0)
               .below(1))
      .section("particles.regions.*", Presence::optional,
               "A box of which the size distribution and, of aggregates, the joint distribution of the primary "
               "particles' diameter and number are written with each field output, to the tables "
               "tables/sizes_<name>.csv and tables/joint_<name>.csv: mean of the cells with their centre in it.")
      .add(quantityKey("particles.regions.*.from", units::length,
                       "Smallest coordinates of the box, '[0 mm, 3 mm]', in space three.")
               .list())
      .add(quantityKey("particles.regions.*.to", units::length, "Largest coordinates of the box.").list());
  schema.add(part, ofPopulations());
  schema
      .section("trajectories", Presence::optional,
               "Stochastic ensembles that ride along streamlines of the final flow; needs the section particles.")
      .add(quantityKey("trajectories.duration", units::time,
                       "Longest time that an ensemble is followed along its streamline.")
               .byDefault("50 ms")
               .above(0))
      .add(quantityKey("trajectories.time_step", units::time,
                       "Time between two points of a streamline at which the state of the gas is taken.")
               .byDefault("50 us")
               .above(0))
      .add(integerKey("trajectories.particles",
                      "Largest number of numerical particles of an ensemble: more have less noise and cost more.")
               .byDefault("4096")
               .atLeast(16))
      .add(booleanKey("trajectories.gas_tables",
                      "Whether the gas of each path, all of its species, is written to tables/streamline_<number>.csv, "
                      "which gas.file of a deck with problem: prescribed_gas reads.")
               .byDefault("false"));
  schema.add(splitToleranceKey("trajectories", "0.01"));
  addSizeBinKeys(schema, "trajectories", "200 nm");
  schema.section("trajectories.start", Presence::required, "Where the ensembles start.")
      .add(quantityKey("trajectories.start[].r", units::length,
                       "Where a streamline starts: radius of an axisymmetric mesh (in a plane the same as x).")
               .optional()
               .atLeast(0))
      .add(quantityKey("trajectories.start[].x", units::length, "Where a streamline starts: along x.").optional())
      .add(quantityKey("trajectories.start[].y", units::length, "Where a streamline starts: along y.").optional())
      .add(quantityKey("trajectories.start[].z", units::length,
                       "Where a streamline starts: axial position, or in space along z (with r in a plane the same "
                       "as y).")
               .optional());
}

}  // namespace

DeckSchema flowSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"flow"}, "What is solved."))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"));
  addMechanismKeys(schema);
  schema
      .add(quantityKey("pressure", units::pressure, "Thermodynamic pressure p0 of the gas, the same everywhere.")
               .byDefault("1 atm")
               .above(0))
      .add(integerKey("seed",
                      "Start of all random numbers: another seed gives another sample, the same seed the same result.")
               .byDefault("1")
               .atLeast(0));
  flowcase::addMeshKeys(schema);
  addBoundaries(schema);
  addInitial(schema);
  addGravity(schema);
  addRadiationKeys(schema);
  flowcase::addTurbulenceKeys(schema);
  flowcase::addCombustionKeys(schema);
  flowcase::addTimeKeys(schema);
  addConvectionAndOutput(schema);
  schema
      .add(booleanKey("chemistry.share_work", "Whether cells with costly chemistry are sent to less busy ranks.")
               .byDefault("true"))
      .add(numberKey("chemistry.relative_tolerance",
                     "Relative tolerance of the stiff solver of the chemistry: smaller is more accurate and slower.")
               .byDefault("1e-6")
               .above(0)
               .below(1))
      .add(integerKey(
               "chemistry.rosenbrock_steps",
               "Steps of a Rosenbrock method in which the chemistry of a cell has to be done, four times as many in "
               "vector lanes; a cell that needs more is integrated by CVODE. 0: CVODE for all cells.")
               .byDefault("10")
               .atLeast(0)
               .atMost(1000))
      .add(numberKey("chemistry.absolute_tolerance",
                     "Absolute tolerance of the stiff solver of the chemistry, in mass fraction: smaller is more "
                     "accurate and slower.")
               .byDefault("1e-12")
               .above(0)
               .below(1));
  addTransportKeys(schema);
  addParticles(schema);
  return schema;
}

}  // namespace lampblack::app
