#include "app/problems/aggregates/aggregates_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/deck/sintering_deck.hpp"
#include "core/errors.hpp"
#include "io/request_limits.hpp"
#include "particles/trees/tree_material.hpp"

namespace lampblack::app {
namespace {

const std::vector<std::string> pairs{"equal_pairs"}, single{"single_spheres"}, inGas{"collisions"};

void addSpheres(DeckSchema& schema) {
  schema.section("spheres", Presence::required, "What aggregates are made of.")
      .add(choiceKey("spheres.material", {"silica", "other"},
                     "silica has the density and the law of sintering of silica's trees.")
               .byDefault("other"))
      .add(quantityKey("spheres.density", units::density, "Density; 2200 kg/m^3 of silica.").optional().above(0))
      .add(quantityKey("spheres.radius", units::length, "Radius of the spheres at the start, their median.").above(0))
      .add(numberKey("spheres.deviation", "Geometric standard deviation of that radius; 1: all are equal.")
               .byDefault("1")
               .atLeast(1)
               .atMost(5));
}

void addBuild(DeckSchema& schema) {
  schema.section("build", Presence::required, "How spheres become aggregates. They meet on straight lines.")
      .add(choiceKey("build.by", {"equal_pairs", "single_spheres", "collisions"},
                     "equal_pairs: clusters of the same number join in pairs, drawn from all that there are; "
                     "single_spheres: spheres join each aggregate one by one; collisions: a population, whose "
                     "particles collide as often as the kernel says."))
      .add(integerKey("build.doublings", "How often the number of spheres of a cluster doubles.")
               .byDefault("10")
               .atLeast(1)
               .atMost(20)
               .onlyWith("build.by", pairs))
      .add(integerKey("build.spheres", "Spheres of an aggregate.")
               .byDefault("256")
               .atLeast(2)
               .atMost(1e6)
               .onlyWith("build.by", single))
      .add(integerKey("build.aggregates", "How many aggregates each repeat makes, of equal pairs at each doubling.")
               .byDefault("200")
               .atLeast(2)
               .atMost(1e6)
               .onlyWith("build.by", {pairs[0], single[0]}))
      .add(quantityKey("build.number", units::perVolume, "Number density of the spheres at the start, 0: none.")
               .byDefault("0 1/m^3")
               .atLeast(0)
               .onlyWith("build.by", inGas))
      .add(quantityKey("build.expected_number", units::perVolume,
                       "Expected largest number density: an empty sample is full when it first reaches it.")
               .byDefault("1e18 1/m^3")
               .above(0)
               .onlyWith("build.by", inGas))
      .add(integerKey("build.sample", "Most numerical particles of a repeat; at least half as many once it was full.")
               .byDefault("512")
               .atLeast(8)
               .atMost(1e6)
               .onlyWith("build.by", inGas))
      .add(choiceKey("build.kernel", {"transition", "free_molecular", "continuum"},
                     "Collision rates: harmonic mean of the two limits, or one of them.")
               .byDefault("transition")
               .onlyWith("build.by", inGas))
      .add(numberKey("build.van_der_waals", "Enhancement of collisions in the free-molecular regime.")
               .byDefault("1")
               .above(0)
               .onlyWith("build.by", inGas))
      .add(choiceKey(
               "build.collision_size", {"shadow", "fractal"},
               "Diameter of collision. shadow: of the sphere with the mean projected area; fractal: mean diameter "
               "of the spheres' volumes times n^(1/D), D the key fractal_dimension, n = S^3/(36 pi V^2) of so many "
               "equal spheres in point contact.")
               .byDefault("shadow")
               .onlyWith("build.by", inGas))
      .add(numberKey("build.fractal_dimension", "D of the diameter of collision.")
               .byDefault("1.8")
               .atLeast(1)
               .atMost(3)
               .onlyWith("build.collision_size", {"fractal"})
               .onlyWith("build.by", inGas))
      .add(
          numberKey("build.split_tolerance",
                    "Part of the particles that collide, or of the smallest radius that grows, in a step of splitting.")
              .byDefault("0.05")
              .above(0)
              .atMost(1)
              .onlyWith("build.by", inGas));
}

void addGas(DeckSchema& schema) {
  schema
      .section("gas", Presence::optional,
               "The gas, for collisions, sintering and growth; its viscosity and mean molar mass are those of air.")
      .add(quantityKey("gas.temperature", units::temperature, "Temperature of a gas that stays as it is.")
               .optional()
               .above(0))
      .add(quantityKey("gas.pressure", units::pressure, "Pressure of a gas that stays as it is.")
               .byDefault("1 atm")
               .above(0))
      .add(quantityKey("gas.growth", units::velocity, "Speed at which the free surface grows outward.")
               .byDefault("0 m/s")
               .atLeast(0))
      .add(quantityKey("gas.births", units::ratePerVolume, "Rate at which spheres are born; only of collisions.")
               .byDefault("0 1/m^3/s")
               .atLeast(0))
      .add(stringKey("gas.file",
                     "A table in place of these keys (CSV, relative to the deck): columns time, temperature, pressure, "
                     "and births and growth where there are any, linear in between.")
               .optional())
      .add(quantityKey("gas.birth_diameter", units::length, "Diameter of what is born.").optional().above(0));
  schema.section("sintering", Presence::optional, "How spheres that touch become one.");
  addSinteringLawKeys(schema, "sintering");
  schema.add(numberKey("sintering.tolerance", "Relative error of a step in the sixth power of a neck's radius.")
                 .byDefault("1e-4")
                 .above(0)
                 .atMost(0.1));
  schema.section("time", Presence::optional, "The time in the gas; of aggregates that are built, after that.")
      .add(quantityKey("time.end", units::time, "End of the run, from zero.").above(0))
      .add(integerKey("time.outputs", "Rows of the history after that at time zero.")
               .byDefault("20")
               .atLeast(1)
               .atMost(1e5))
      .add(choiceKey("time.spacing", {"linear", "logarithmic"},
                     "Whether rows are as far apart, or each as many times later than the last, from time.first.")
               .byDefault("linear"))
      .add(quantityKey("time.first", units::time, "First row of logarithmic spacing; absent: 1e-3 of the end.")
               .optional()
               .above(0)
               .onlyWith("time.spacing", {"logarithmic"}));
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
  options.particles = deck.integer<std::size_t>("build.sample");
  options.fullAt = deck.quantity("build.expected_number");
  const std::string kernel = deck.choice("build.kernel");
  options.kernel.type = kernel == "transition"       ? CollisionKernelType::transition
                        : kernel == "free_molecular" ? CollisionKernelType::freeMolecular
                                                     : CollisionKernelType::continuum;
  options.kernel.enhancement = deck.number("build.van_der_waals");
  if (deck.choice("build.collision_size") == "fractal") {
    options.size = CollisionSize::primaries;
    options.material.fractalDimension = deck.number("build.fractal_dimension");
  }
  options.splitTolerance = deck.number("build.split_tolerance");
  made.number = deck.quantity("build.number");
  if (!deck.has("gas")) throw deck.error("build.by", "collisions take place in a gas; give the section 'gas'");
  if (!deck.has("time")) throw deck.error("build.by", "collisions take time; give the section 'time'");
}

}  // namespace

std::vector<std::size_t> AggregatesCase::sizes() const {
  std::vector<std::size_t> all{1};
  if (build == Build::collisions) return all;
  const std::size_t last = build == Build::equalPairs ? std::size_t{1} << doublings : spheres;
  while (2 * all.back() <= last) all.push_back(2 * all.back());
  if (all.back() != last) all.push_back(last);
  return all;
}

DeckSchema aggregatesSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"aggregates"}, "What is solved."))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"));
  addSpheres(schema);
  addBuild(schema);
  addGas(schema);
  schema
      .add(integerKey("repeats", "Independent repeats, of which means and errors are.")
               .byDefault("4")
               .atLeast(2)
               .atMost(1e6))
      .add(integerKey("seed",
                      "Start of the random numbers: another seed gives another sample, the same seed the same result.")
               .byDefault("1")
               .atLeast(0))
      .add(integerKey("output.fit_from",
                      "Fewest spheres of an aggregate in the fit of the fractal law, n = k (R_g/a)^D.")
               .byDefault("16")
               .atLeast(2))
      .add(integerKey("output.directions", "Directions from which each aggregate's shadow is measured.")
               .byDefault("4")
               .atLeast(1)
               .atMost(1e4))
      .add(integerKey("output.aggregates", "Aggregates at the end whose spheres are written, for pictures.")
               .byDefault("12")
               .atLeast(0)
               .atMost(10000));
  return schema;
}

AggregatesCase readAggregatesCase(const Deck& deck) {
  AggregatesCase made;
  made.title = deck.string("title");
  made.radius = deck.quantity("spheres.radius");
  made.deviation = deck.number("spheres.deviation");
  const bool isSilica = deck.choice("spheres.material") == "silica";
  const auto density = deck.optionalQuantity("spheres.density");
  if (!isSilica && !density) throw deck.error("spheres", "a material that is not silica needs the key 'density'");
  const TreeMaterial shipped = isSilica ? silica() : TreeMaterial{};
  TreeOptions& options = made.population;
  options.material = givenMaterial(density.value_or(shipped.density));
  options.shape = TreeShape::spheres;
  options.size = CollisionSize::shadow;
  SinteringLaw& law = options.material.sintering;
  const bool hasGas = deck.has("gas"), sinters = deck.has("sintering") || isSilica;
  law = readSinteringLaw(deck, "sintering", shipped.sintering);
  requirePrefactor(deck, "sintering", law);
  if (deck.has("sintering") && !law.active() && !deck.has("sintering.mechanism"))
    throw deck.error("sintering", "a material that is not silica needs the key 'mechanism'");
  if (deck.has("sintering")) options.sphereTolerance = deck.number("sintering.tolerance");
  const std::string by = deck.choice("build.by");
  made.times = readTimes(deck);
  if (by != inGas[0]) {
    made.build = by == pairs[0] ? AggregatesCase::Build::equalPairs : AggregatesCase::Build::singleSpheres;
    if (by == pairs[0]) made.doublings = deck.integer<std::size_t>("build.doublings");
    if (by == single[0]) made.spheres = deck.integer<std::size_t>("build.spheres");
    made.aggregates = deck.integer<std::size_t>("build.aggregates");
    if (deck.has("time") && !hasGas) throw deck.error("time", "the time is one in a gas; give the section 'gas'");
    requireMemory(deck, "build", fmt::format("{} aggregates of {} spheres", made.aggregates, made.sizes().back()),
                  2.0 * sizeof(AggregateSphere) * static_cast<double>(made.aggregates) *
                      static_cast<double>(made.sizes().back()));
  } else {
    made.build = AggregatesCase::Build::collisions;
    readPopulation(deck, made);
  }
  if (hasGas && !deck.has("time"))
    throw deck.error("gas", "what takes place in it takes time; give the section 'time'");
  if (hasGas) made.gas = readGas(deck);
  if (!hasGas && deck.has("sintering"))
    throw deck.error("sintering", "it takes place in a gas; give the section 'gas'");
  if (!sinters) law = {};
  const bool hasBirths = std::ranges::any_of(made.gas.births, [](double rate) { return rate > 0; });
  if (hasBirths && by != inGas[0]) throw deck.error("gas", "particles are born only where build.by is 'collisions'");
  if (hasBirths != deck.has("gas.birth_diameter"))
    throw deck.error("gas", "'births' and 'birth_diameter' belong together");
  if (hasBirths) made.birthDiameter = deck.quantity("gas.birth_diameter");
  if (by == inGas[0] && !hasBirths && !(made.number > 0))
    throw deck.error("build.number", "there are no particles: give their number, or births in the gas");
  made.fitFrom = static_cast<double>(deck.integer<std::size_t>("output.fit_from"));
  made.directions = deck.integer<std::size_t>("output.directions");
  made.drawn = deck.integer<std::size_t>("output.aggregates");
  made.repeats = deck.integer<std::uint64_t>("repeats");
  made.seed = deck.integer<std::uint64_t>("seed");
  return made;
}

}  // namespace lampblack::app
