#include "app/flow_case.hpp"
#include "app/gas_input.hpp"
#include "app/soot_deck.hpp"
#include "app/temperature_input.hpp"

namespace lampblack {
namespace {

void addMesh(DeckSchema& schema) {
  schema
      .add(
          choiceKey("mesh.geometry", {"axisymmetric", "planar"}, "Axes r and z, or x and y.").byDefault("axisymmetric"))
      .add(numberKey("mesh.refinement", "Multiplies the cell count of every segment.").byDefault("1").above(0));
  for (const std::string axis : {"r", "z", "x", "y"}) {
    const std::string list = "mesh." + axis;
    schema.section(list, Presence::optional, "Segments of the " + axis + " axis, one after the other from zero.")
        .add(quantityKey(list + "[].to", units::length, "End of the segment.").above(0))
        .add(integerKey(list + "[].cells", "Cells of the segment.").atLeast(1))
        .add(
            numberKey(list + "[].ratio", "Last cell size over first; above 1 the cells grow.").byDefault("1").above(0));
  }
}

void addBoundaries(DeckSchema& schema) {
  schema.section("boundaries", Presence::required, "Named parts of the surface and what happens there.")
      .add(choiceKey("boundaries.*.type", {"inlet", "outlet", "wall", "symmetry"}, "Kind of boundary."))
      .add(choiceKey("boundaries.*.side", {"r-min", "r-max", "z-min", "z-max", "x-min", "x-max", "y-min", "y-max"},
                     "Side of the box it lies on."))
      .add(quantityKey("boundaries.*.from", units::length, "Start along the side.").optional())
      .add(quantityKey("boundaries.*.to", units::length, "End along the side.").optional())
      .add(quantityKey("boundaries.*.velocity", units::velocity, "Normal velocity into the domain.")
               .optional()
               .atLeast(0)
               .onlyWith("boundaries.*.type", {"inlet"}))
      .add(temperatureKey("boundaries.*.temperature",
                          "inlet: of the stream; outlet: of entrained gas; wall: isothermal at this temperature.")
               .optional()
               .onlyWith("boundaries.*.type", {"inlet", "outlet", "wall"}))
      .add(stringKey("boundaries.*.composition", "Of the stream or of entrained gas: mole fractions, 'C2H4: 1, N2: 3'.")
               .optional()
               .onlyWith("boundaries.*.type", {"inlet", "outlet"}))
      .add(choiceKey("boundaries.*.species", {"flux", "fixed"},
                     "Fix the total species flux (no diffusive loss into the nozzle) or the mass fractions.")
               .byDefault("flux")
               .onlyWith("boundaries.*.type", {"inlet"}))
      .add(booleanKey("boundaries.*.slip", "Without friction.")
               .byDefault("false")
               .onlyWith("boundaries.*.type", {"wall"}));
}

void addInitial(DeckSchema& schema) {
  schema.section("initial", Presence::required, "The start: two streams that mix across a burnt or hot layer.")
      .add(choiceKey("initial.layer", {"burnt", "hot"},
                     "burnt: complete combustion where the streams meet (without CO2 in the mechanism: equilibrium); "
                     "hot: cold mixture with a hot layer that ignites it.")
               .byDefault("burnt"))
      .add(stringKey("initial.low", "Boundary whose stream fills the low end of the axis."))
      .add(stringKey("initial.high", "Boundary whose stream fills the high end."))
      .add(quantityKey("initial.position", units::length, "Where the mixture is half and half."))
      .add(quantityKey("initial.width", units::length, "Width of the mixing layer.").above(0))
      .add(temperatureKey("initial.temperature", "burnt: upper limit of the temperature; hot: peak of the hot layer.")
               .byDefault("2200 K"))
      .add(quantityKey("initial.hot_position", units::length, "Centre of the hot layer.")
               .optional()
               .onlyWith("initial.layer", {"hot"}))
      .add(quantityKey("initial.hot_width", units::length, "Half width of the hot layer.")
               .optional()
               .above(0)
               .onlyWith("initial.layer", {"hot"}));
}

void addTimeAndOutput(DeckSchema& schema) {
  schema.add(quantityKey("time.end", units::time, "Simulated time.").above(0))
      .add(quantityKey("time.first_step", units::time, "First time step.").byDefault("1 us").above(0))
      .add(quantityKey("time.maximum_step", units::time, "Largest time step.").byDefault("1 ms").above(0))
      .add(numberKey("time.courant", "Share of a cell's volume that may flow out in a step.")
               .byDefault("0.5")
               .above(0)
               .atMost(1))
      .add(numberKey("time.growth", "Largest ratio of successive steps.").byDefault("1.2").above(1))
      .add(quantityKey("output.interval", units::time, "Time between field outputs; the last state is always written.")
               .optional()
               .above(0))
      .add(integerKey("output.history_steps", "Steps between rows of the history.").byDefault("1").atLeast(1))
      .add(stringKey("output.species", "Species whose mole fractions are written; 'all' writes every one.")
               .list()
               .byDefault("[all]"))
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
  addSootModelKeys(schema);
  schema
      .section("trajectories", Presence::optional,
               "Stochastic ensembles that ride along streamlines of the final flow; needs the soot section.")
      .add(quantityKey("trajectories.duration", units::time, "Longest ride.").byDefault("50 ms").above(0))
      .add(
          quantityKey("trajectories.time_step", units::time, "Between samples of the gas.").byDefault("50 us").above(0))
      .add(integerKey("trajectories.particles", "Capacity of each ensemble.").byDefault("4096").atLeast(16))
      .add(integerKey("trajectories.bins", "Bins of the size distribution.").byDefault("60").atLeast(2))
      .add(quantityKey("trajectories.smallest", units::length, "Lower end of the bins (diameter).")
               .byDefault("0.5 nm")
               .above(0))
      .add(quantityKey("trajectories.largest", units::length, "Upper end of the bins.").byDefault("200 nm").above(0))
      .section("trajectories.start", Presence::required, "Where the ensembles start.")
      .add(quantityKey("trajectories.start[].r", units::length, "Radius (planar: x).").atLeast(0))
      .add(quantityKey("trajectories.start[].z", units::length, "Axial position (planar: y).").atLeast(0));
}

}  // namespace

DeckSchema flowSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"flow"}, "What is solved."))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"));
  addMechanismKeys(schema);
  schema.add(quantityKey("pressure", units::pressure, "Thermodynamic pressure.").byDefault("1 atm").above(0))
      .add(integerKey("seed", "Of all random numbers.").byDefault("1").atLeast(0));
  addMesh(schema);
  addBoundaries(schema);
  addInitial(schema);
  addTimeAndOutput(schema);
  schema
      .add(choiceKey(
               "chemistry.coupling", {"deferred", "strang"},
               "deferred: reactions see the transport as a constant source, so that a steady flame does not depend "
               "on the time step; strang: Strang splitting.")
               .byDefault("deferred"))
      .add(booleanKey("chemistry.share_work", "Send stiff cells to less busy ranks.").byDefault("true"))
      .add(numberKey("chemistry.relative_tolerance", "Of the stiff solver.").byDefault("1e-6").above(0).below(1))
      .add(numberKey("chemistry.absolute_tolerance", "Of the stiff solver, in mass fraction.")
               .byDefault("1e-12")
               .above(0)
               .below(1));
  addTransportKeys(
      schema, {"mixture_averaged", "unity_lewis", "constant_lewis"},
      "How species diffuse: by mixture-averaged coefficients, as fast as heat, or as fast as heat over each "
      "species' Lewis number.");
  addParticles(schema);
  return schema;
}

}  // namespace lampblack
