#include "app/problems/aggregates/aggregates_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/deck/sintering_deck.hpp"
#include "app/problems/aggregates/aggregates_gas.hpp"
#include "core/errors.hpp"
#include "io/deck_keys.hpp"
#include "io/request_limits.hpp"
#include "particles/trees/tree_material.hpp"

namespace lampblack::app {
namespace {

const std::vector<std::string> pairs{"equal_pairs"}, single{"single_spheres"}, inGas{"collisions"};

DeckKeys<AggregatesCase> sphereKeys() {
  DeckKeys<AggregatesCase> keys("spheres");
  keys.section(Presence::required, "What aggregates are made of.");
  keys.choice("material", {"silica", "other"}, rules().byDefault("other"),
              "silica has the density and the law of sintering of silica's trees.");
  keys.quantity("density", units::density, rules().optional().above(0), "Density; 2200 kg/m^3 of silica.");
  keys.quantity("radius", units::length, &AggregatesCase::radius, rules().required().above(0),
                "Radius of the spheres at the start, their median.");
  keys.number("deviation", &AggregatesCase::deviation, rules().byDefault("1").atLeast(1).atMost(5),
              "Geometric standard deviation of that radius; 1: all are equal.");
  return keys;
}

DeckKeys<AggregatesCase> buildKeys() {
  using Case = AggregatesCase;
  constexpr auto ofPopulation = [](auto member) { return inner(&Case::population, member); };
  constexpr auto kernel = [](auto member) { return inner(inner(&Case::population, &TreeOptions::kernel), member); };
  DeckKeys<AggregatesCase> keys("build");
  keys.section(Presence::required, "How spheres become aggregates. They meet on straight lines.");
  keys.choice(
      "by", &Case::build,
      {{"equal_pairs", Case::Build::equalPairs},
       {"single_spheres", Case::Build::singleSpheres},
       {"collisions", Case::Build::collisions}},
      rules().required(),
      "equal_pairs: clusters of the same number join in pairs, drawn from all that there are; single_spheres: spheres "
      "join each aggregate one by one; collisions: a population, whose particles collide as often as the kernel says.");
  keys.integer("doublings", &Case::doublings, rules().byDefault("10").atLeast(1).atMost(20).onlyWith("build.by", pairs),
               "How often the number of spheres of a cluster doubles.");
  keys.integer("spheres", &Case::spheres, rules().byDefault("256").atLeast(2).atMost(1e6).onlyWith("build.by", single),
               "Spheres of an aggregate.");
  keys.integer("aggregates", &Case::aggregates,
               rules().byDefault("200").atLeast(2).atMost(1e6).onlyWith("build.by", {pairs[0], single[0]}),
               "How many aggregates each repeat makes, of equal pairs at each doubling.");
  keys.quantity("number", units::perVolume, &Case::number,
                rules().byDefault("0 1/m^3").atLeast(0).onlyWith("build.by", inGas),
                "Number density of the spheres at the start, 0: none.");
  keys.quantity("expected_number", units::perVolume, ofPopulation(&TreeOptions::fullAt),
                rules().byDefault("1e18 1/m^3").above(0).onlyWith("build.by", inGas),
                "Expected largest number density: an empty sample is full when it first reaches it.");
  keys.integer("sample", ofPopulation(&TreeOptions::particles),
               rules().byDefault("512").atLeast(8).atMost(1e6).onlyWith("build.by", inGas),
               "Most numerical particles of a repeat; at least half as many once it was full.");
  keys.choice("kernel", kernel(&CollisionKernelOptions::type),
              {{"transition", CollisionKernelType::transition},
               {"free_molecular", CollisionKernelType::freeMolecular},
               {"continuum", CollisionKernelType::continuum}},
              rules().byDefault("transition").onlyWith("build.by", inGas),
              "Collision rates: harmonic mean of the two limits, or one of them.");
  keys.number("van_der_waals", kernel(&CollisionKernelOptions::enhancement),
              rules().byDefault("1").above(0).onlyWith("build.by", inGas),
              "Enhancement of collisions in the free-molecular regime.");
  keys.choice(
      "collision_size", ofPopulation(&TreeOptions::size),
      {{"shadow", CollisionSize::shadow}, {"fractal", CollisionSize::primaries}, {"lines", CollisionSize::lines}},
      rules().byDefault("shadow").onlyWith("build.by", inGas),
      "Diameter of collision. shadow: of the sphere with the mean projected area; fractal: mean diameter of "
      "the spheres' volumes times n^(1/D), D the key fractal_dimension, n = S^3/(36 pi V^2) of so many equal "
      "spheres in point contact; lines: of the bounding sphere, and only pairs that touch on the straight line "
      "that is drawn for them collide, the rate of free molecules without an assumption on their size; with "
      "'kernel: free_molecular'.");
  keys.number("fractal_dimension",
              rules()
                  .byDefault("1.8")
                  .atLeast(1)
                  .atMost(3)
                  .onlyWith("build.collision_size", {"fractal"})
                  .onlyWith("build.by", inGas),
              "D of the diameter of collision.");
  keys.number("split_tolerance", ofPopulation(&TreeOptions::splitTolerance),
              rules().byDefault("0.05").above(0).atMost(1).onlyWith("build.by", inGas),
              "Part of the particles that collide, or of the smallest radius that grows, in a step of splitting.");
  return keys;
}

void addGas(DeckSchema& schema) {
  SectionKeys keys("");
  keys.section("gas", Presence::optional,
               "The gas, for collisions, sintering and growth; its viscosity and mean molar mass are those of air.");
  keys.quantity("gas.temperature", units::temperature, rules().optional().above(0),
                "Temperature of a gas that stays as it is.");
  keys.quantity("gas.pressure", units::pressure, rules().byDefault("1 atm").above(0),
                "Pressure of a gas that stays as it is.");
  keys.quantity("gas.growth", units::velocity, rules().byDefault("0 m/s").atLeast(0),
                "Speed at which the free surface grows outward.");
  keys.quantity("gas.births", units::ratePerVolume, rules().byDefault("0 1/m^3/s").atLeast(0),
                "Rate at which spheres are born; only of collisions.");
  keys.text("gas.file", rules().optional(),
            "A table in place of these keys (CSV, relative to the deck): columns time, temperature, pressure, and "
            "births and growth where there are any, linear in between.");
  keys.quantity("gas.birth_diameter", units::length, rules().optional().above(0), "Diameter of what is born.");
  keys.section("sintering", Presence::optional, "How spheres that touch become one.");
  addSinteringLawKeys(keys.schema(), "sintering");
  keys.number("sintering.step_error", rules().formerly("tolerance").byDefault("1e-4").above(0).atMost(0.1),
              "Relative error of a step in the sixth power of a neck's radius.");
  keys.section("time", Presence::optional, "The time in the gas; of aggregates that are built, after that.");
  keys.quantity("time.end", units::time, rules().above(0), "End of the run, from zero.");
  keys.integer("time.outputs", rules().byDefault("20").atLeast(1).atMost(1e5),
               "Rows of the history after that at time zero.");
  keys.choice("time.spacing", {"linear", "logarithmic"}, rules().byDefault("linear"),
              "Whether rows are as far apart, or each as many times later than the last, from time.first.");
  keys.quantity("time.first", units::time, rules().optional().above(0).onlyWith("time.spacing", {"logarithmic"}),
                "First row of logarithmic spacing; absent: 1e-3 of the end.");
  schema.add(keys.schema());
}

DeckKeys<AggregatesCase> outputKeys() {
  using Case = AggregatesCase;
  DeckKeys<Case> keys("");
  keys.integer("repeats", &Case::repeats, rules().byDefault("4").atLeast(2).atMost(1e6),
               "Independent repeats, of which means and errors are.");
  keys.integer("seed", &Case::seed, rules().byDefault("1").atLeast(0),
               "Start of the random numbers: another seed gives another sample, the same seed the same result.");
  keys.integer("output.fit_from", &Case::fitFrom, rules().byDefault("16").atLeast(2),
               "Fewest spheres of an aggregate in the fit of the fractal law, n = k (R_g/a)^D.");
  keys.integer("output.directions", &Case::directions, rules().byDefault("4").atLeast(1).atMost(1e4),
               "Directions from which each aggregate's shadow is measured.");
  keys.integer("output.aggregates", &Case::drawn, rules().byDefault("12").atLeast(0).atMost(10000),
               "Aggregates at the end whose spheres are written, for pictures.");
  return keys;
}

AggregatesGas readGas(const Deck& deck) {
  const bool isGiven = deck.has("gas.file");
  if (isGiven == deck.has("gas.temperature"))
    throw deck.error("gas", "expected either 'temperature', of a gas that stays as it is, or 'file', a table");
  if (!isGiven)
    return {{0},
            {deck.quantity("gas.temperature")},
            {deck.quantity("gas.pressure")},
            {deck.quantity("gas.births")},
            {deck.quantity("gas.growth")}};
  for (const char* key : {"gas.pressure", "gas.growth", "gas.births"})
    if (deck.isGiven(key)) throw deck.error(key, "the table 'gas.file' says this; leave it out");
  const std::string name = deck.string("gas.file");
  return deck.at("gas.file", [&] { return readAggregatesGas(deck.resolvePath(name)); });
}

std::vector<double> readTimes(const Deck& deck) {
  std::vector<double> times{0};
  if (!deck.has("time")) return times;
  const double end = deck.quantity("time.end");
  const auto outputs = deck.integer<std::size_t>("time.outputs");
  const bool isLinear = deck.choice("time.spacing") == "linear";
  const double first = deck.optionalQuantity("time.first").value_or(1e-3 * end);
  if (!isLinear && !(first < end)) throw deck.error("time.first", "expected a time before time.end");
  for (std::size_t k = 1; k < outputs; ++k) {
    const double part = static_cast<double>(k - (isLinear ? 0 : 1)) / static_cast<double>(outputs - (isLinear ? 0 : 1));
    times.push_back(isLinear ? part * end : first * std::pow(end / first, part));
  }
  times.push_back(end);
  return times;
}

void readPopulation(const Deck& deck, AggregatesCase& made) {
  TreeOptions& options = made.population;
  if (options.size == CollisionSize::primaries)
    options.material.fractalDimension = deck.number("build.fractal_dimension");
  if (options.size == CollisionSize::lines && options.kernel.type != CollisionKernelType::freeMolecular)
    throw deck.error("build.collision_size", "particles fly on lines with 'kernel: free_molecular' alone");
  if (!deck.has("gas")) throw deck.error("build.by", "collisions take place in a gas; give the section 'gas'");
  if (!deck.has("time")) throw deck.error("build.by", "collisions take time; give the section 'time'");
}

}  // namespace

DeckSchema aggregatesSchema() {
  SectionKeys keys("");
  keys.choice("problem", {"aggregates"}, rules(), "What is solved.");
  keys.text("title", rules().byDefault("''"), "One line for reports and pictures.");
  keys.schema().add(sphereKeys().schema()).add(buildKeys().schema());
  addGas(keys.schema());
  keys.schema().add(outputKeys().schema());
  return keys.schema();
}

AggregatesCase readAggregatesCase(const Deck& deck) {
  AggregatesCase made;
  made.title = deck.string("title");
  made.population.size = CollisionSize::shadow;
  sphereKeys().read(deck, made, "spheres");
  buildKeys().read(deck, made, "build");
  outputKeys().read(deck, made, "");
  const bool isSilica = deck.choice("spheres.material") == "silica";
  const auto density = deck.optionalQuantity("spheres.density");
  if (!isSilica && !density) throw deck.error("spheres", "a material that is not silica needs the key 'density'");
  const TreeMaterial shipped = isSilica ? silica() : TreeMaterial{};
  TreeOptions& options = made.population;
  options.material = givenMaterial(density.value_or(shipped.density));
  options.shape = TreeShape::spheres;
  SinteringLaw& law = options.material.sintering;
  const bool hasGas = deck.has("gas"), sinters = deck.has("sintering") || isSilica;
  law = readSinteringLaw(deck, "sintering", shipped.sintering);
  requirePrefactor(deck, "sintering", law);
  if (deck.has("sintering") && !law.active() && !deck.has("sintering.mechanism"))
    throw deck.error("sintering", "a material that is not silica needs the key 'mechanism'");
  if (deck.has("sintering")) options.sphereTolerance = deck.number("sintering.step_error");
  const bool collide = made.build == AggregatesCase::Build::collisions;
  made.times = readTimes(deck);
  if (!collide) {
    if (deck.has("time") && !hasGas) throw deck.error("time", "the time is one in a gas; give the section 'gas'");
    requireMemory(deck, "build", fmt::format("{} aggregates of {} spheres", made.aggregates, made.sizes().back()),
                  2.0 * sizeof(AggregateSphere) * static_cast<double>(made.aggregates) *
                      static_cast<double>(made.sizes().back()));
  } else {
    readPopulation(deck, made);
  }
  if (hasGas && !deck.has("time"))
    throw deck.error("gas", "what takes place in it takes time; give the section 'time'");
  if (hasGas) made.gas = readGas(deck);
  if (!hasGas && deck.has("sintering"))
    throw deck.error("sintering", "it takes place in a gas; give the section 'gas'");
  if (!sinters) law = {};
  const bool hasBirths = std::ranges::any_of(made.gas.births, [](double rate) { return rate > 0; });
  if (hasBirths && !collide) throw deck.error("gas", "particles are born only where build.by is 'collisions'");
  const bool grows = std::ranges::any_of(made.gas.growth, [](double rate) { return rate > 0; });
  if (hasGas && !collide && !law.active() && !grows)
    throw deck.error("gas",
                     "nothing happens in it to what is built: give 'sintering' or 'gas.growth', or leave 'gas' and "
                     "'time' out");
  if (hasBirths != deck.has("gas.birth_diameter"))
    throw deck.error("gas", "'births' and 'birth_diameter' belong together");
  if (hasBirths) made.birthDiameter = deck.quantity("gas.birth_diameter");
  if (collide && !hasBirths && !(made.number > 0))
    throw deck.error("build.number", "there are no particles: give their number, or births in the gas");
  return made;
}

}  // namespace lampblack::app
