#include "app/problems/engine/engine_case.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/problems/engine/engine_rows.hpp"
#include "chemistry/thermo/equilibrium.hpp"
#include "coupling/reactor_particles.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app {
namespace {

constexpr double degree = std::numbers::pi / 180;

double degrees(const Deck& deck, const std::string& key) {
  return deck.quantity(key) / degree;
}

// Rising crank angles as times, and values of one key; a single value without angles.
EngineTable readAngleTable(const Deck& deck, const EngineCase& made, const std::string& angles,
                           const std::string& values) {
  EngineTable table{{}, deck.quantities(values)};
  if (table.values.empty()) throw deck.error(values, "expected one value or more");
  if (deck.has(angles))
    for (const double angle : deck.quantities(angles)) table.times.push_back(made.timeOf(angle / degree));
  else if (table.values.size() == 1)
    table.times = {0};
  if (table.times.size() != table.values.size())
    throw deck.error(values, fmt::format("there are {} values for {} angles ('{}'); give one for each",
                                         table.values.size(), table.times.size(), angles));
  for (std::size_t k = 1; k < table.times.size(); ++k)
    if (!(table.times[k] > table.times[k - 1])) throw deck.error(angles, "expected angles that rise");
  return table;
}

void readGeometry(const Deck& deck, EngineCase& made) {
  made.crank = {deck.quantity("engine.bore"), deck.quantity("engine.stroke"), deck.quantity("engine.rod"),
                deck.number("engine.compression_ratio")};
  if (!(2 * made.crank.rod > made.crank.stroke))
    throw deck.error("engine.rod", "the rod has to be longer than half of the stroke, the radius of the crank");
  made.speed = deck.quantity("engine.speed") / (2 * std::numbers::pi);
  made.start = degrees(deck, "engine.start");
  made.end = degrees(deck, "engine.end");
  if (!(made.start >= -180 && made.start < made.end && made.end <= 180))
    throw deck.error("engine.end", "expected angles from -180 deg on that rise, up to 180 deg");
}

void readCharge(const Deck& deck, EngineCase& made) {
  const Mechanism& mechanism = *made.mechanism;
  made.temperature = deck.quantity("charge.temperature");
  made.pressure = deck.quantity("charge.pressure");
  made.fresh = readMixture(deck, "charge", mechanism);
  made.temperatureDeviation = deck.quantity("charge.temperature_deviation");
  made.ratioDeviation = deck.number("charge.ratio_deviation");
  if (deck.has("charge.fuel")) {
    made.fuel = parseComposition(mechanism, deck.string("charge.fuel"));
    made.oxidizer = parseComposition(mechanism, deck.string("charge.oxidizer"));
    made.ratio = deck.number("charge.equivalence_ratio");
  } else if (made.ratioDeviation > 0) {
    throw deck.error("charge.ratio_deviation",
                     "it is one of equivalence ratios; give the charge by fuel, oxidizer and equivalence_ratio");
  }
  made.exhaust = deck.number("charge.exhaust");
  made.isExhaustByMole = deck.choice("charge.exhaust_by") == "mole";
  made.exhaustFrozen = deck.quantity("charge.exhaust_frozen");
  if (!deck.has("cycles")) return;
  made.residual = deck.number("cycles.residual");
  made.mostCycles = deck.integer<std::size_t>("cycles.most");
  made.angleTolerance = degrees(deck, "cycles.angle_tolerance");
  made.temperatureTolerance = deck.quantity("cycles.temperature_tolerance");
}

void readWalls(const Deck& deck, EngineCase& made) {
  EngineOptions& options = made.options;
  const std::string model = deck.has("walls") ? deck.choice("walls.model") : "none";
  options.bore = made.crank.bore;
  options.pistonSpeed = 2 * made.crank.stroke * made.speed;
  options.displacement = made.crank.displacement();
  options.clearance = made.crank.clearance();
  if (model == "none") return;
  EngineHeatLaw& law = options.heat;
  if (model == "woschni") law = woschniLaw();
  if (model == "hohenberg") law = hohenbergLaw();
  if (model == "nusselt") law = nusseltLaw();
  if (model == "constant") {
    law.model = EngineHeatLaw::Model::constant;
    if (!deck.has("walls.factor")) throw deck.error("walls", "a constant coefficient needs the key 'factor'");
  }
  const std::pair<const char*, double*> constants[] = {{"factor", &law.factor},
                                                       {"pressure_power", &law.pressurePower},
                                                       {"temperature_power", &law.temperaturePower},
                                                       {"speed_power", &law.speedPower},
                                                       {"size_power", &law.sizePower},
                                                       {"piston_speed", &law.pistonSpeedFactor},
                                                       {"swirl_speed", &law.swirlFactor},
                                                       {"combustion_speed", &law.combustionFactor},
                                                       {"speed_offset", &law.speedOffset},
                                                       {"reynolds_power", &law.reynoldsPower},
                                                       {"prandtl_power", &law.prandtlPower}};
  for (const auto& [name, value] : constants)
    *value = deck.optionalNumber(std::string("walls.") + name).value_or(*value);
  law.swirl = deck.number("walls.swirl");
  const double section = std::numbers::pi * made.crank.bore * made.crank.bore / 4;
  options.endArea = deck.optionalQuantity("walls.head_area").value_or(section) +
                    deck.optionalQuantity("walls.piston_area").value_or(section);
  options.wallTemperature = deck.quantity("walls.temperature");
  options.jumpConstant = deck.number("walls.jumps");
  if (options.jumpConstant > 0 && !(options.jumpConstant > 1))
    throw deck.error("walls.jumps", "expected more than 1, or 0 for an even loss: a jump may not go beyond the walls");
  options.motoredExponent = deck.number("walls.motored_exponent");
}

void readMixing(const Deck& deck, EngineCase& made) {
  if (!deck.has("mixing")) return;
  const std::string model = deck.choice("mixing.model");
  made.options.mixing = model == "none"   ? EngineMixingModel::none
                        : model == "iem"  ? EngineMixingModel::iem
                        : model == "curl" ? EngineMixingModel::curl
                                          : EngineMixingModel::modifiedCurl;
  if (made.options.mixing == EngineMixingModel::none) return;
  made.options.mixingConstant = deck.number("mixing.constant");
  made.options.mixingTime = readAngleTable(deck, made, "mixing.angles", "mixing.time");
}

void readInjection(const Deck& deck, EngineCase& made) {
  if (!deck.has("injection")) return;
  const Thermo thermo(*made.mechanism);
  EngineInjection::Options spray;
  spray.massFractions.resize(made.mechanism->numSpecies());
  thermo.moleToMass(
      deck.at("injection.fuel", [&] { return parseComposition(*made.mechanism, deck.string("injection.fuel")); }),
      spray.massFractions);
  spray.enthalpy = thermo.enthalpyMass(deck.quantity("injection.temperature"), spray.massFractions) -
                   deck.quantity("injection.latent_heat");
  spray.dilution = deck.number("injection.dilution");
  spray.mostParticles = deck.optionalInteger<std::size_t>("injection.most_particles").value_or(2 * made.particles);
  if (spray.mostParticles < made.particles)
    throw deck.error("injection.most_particles", "expected at least as many as there are at the start");
  made.options.injection = spray;
  made.options.injectionRate = readAngleTable(deck, made, "injection.angles", "injection.rates");
  const auto& rate = made.options.injectionRate;
  if (rate.values.front() != 0 || rate.values.back() != 0)
    throw deck.error("injection.rates", "expected rates that begin and end with zero");
  if (rate.times.front() < 0 || rate.times.back() > made.timeOf(made.end))
    throw deck.error("injection.angles", "expected angles between engine.start and engine.end");
}

void readNumerics(const Deck& deck, EngineCase& made) {
  made.particles = deck.integer<std::size_t>("sample.particles");
  made.repeats = deck.integer<std::uint64_t>("sample.repeats");
  made.seed = made.options.seed = deck.integer<std::uint64_t>("sample.seed");
  EngineOptions& options = made.options;
  options.step = degrees(deck, "step.angle") / (360 * made.speed);
  options.pressureTolerance = deck.number("step.pressure_change");
  options.temperatureTolerance = deck.optionalQuantity("step.temperature_change").value_or(0);
  options.mostHalvings = deck.integer<int>("step.halvings");
  options.reacts = deck.boolean("step.reactions");
  options.reactions.relativeTolerance = deck.number("step.relative_tolerance");
  options.reactions.absoluteTolerance = deck.number("step.absolute_tolerance");
  const SliderCrank crank = made.crank;
  options.volume = [crank, start = made.start, speed = made.speed](double time) {
    return crank.volume((start + 360 * speed * time) * degree);
  };
  made.every = degrees(deck, "output.every");
  if (degrees(deck, "step.angle") > made.every * (1 + 1e-12))
    throw deck.error("step.angle", "steps end at each row; give an 'output.every' as long as this or longer");
  if (!((made.end - made.start) / made.every < 1e6)) throw deck.error("output.every", "these are too many rows");
  for (const double angle : deck.quantities("output.particles_at")) {
    made.particlesAt.push_back(angle / degree);
    if (made.particlesAt.back() < made.start || made.particlesAt.back() > made.end ||
        (made.particlesAt.size() > 1 && !(made.particlesAt.back() > made.particlesAt[made.particlesAt.size() - 2])))
      throw deck.error("output.particles_at", "expected angles that rise, between engine.start and engine.end");
  }
  made.species = readSpeciesList(deck, "output.species", *made.mechanism);
  made.checkpoints = checkpointKeys("more repeats").read(deck);
  requireMemory(deck, "sample.particles", fmt::format("{} particles", made.particles),
                24.0 * static_cast<double>(made.particles * made.mechanism->numSpecies()));
}

void readSoot(const Deck& deck, EngineCase& made) {
  const Mechanism& mechanism = *made.mechanism;
  if (auto model = readSootModel(deck, mechanism)) {
    if (deck.isGiven("particles.diffusion"))
      throw deck.error("particles.diffusion",
                       "particles of gas have no place, nothing diffuses between them; leave this key out");
    made.soot = std::make_shared<CarriedParticles>(mechanism, std::move(model));
    deck.at(particleSection, [&] { const ReactorGas gas(mechanism, made.soot->exchanged()); });
    if (carriedModel(deck) == "sectional") made.sootAtLimit = deck.number("particles.sectional.overflow");
  }
  if (hasPopulation(deck)) made.population = readPopulation(deck, made.mechanism);
  if (!made.soot && !made.population) return;
  if (deck.isGiven("output.species"))
    throw deck.error(
        "output.species",
        "with 'particles' the history has all species, which soot along the mean gas sees; leave this key out");
  for (const char* key : {"particles.bins", "particles.smallest", "particles.largest"})
    if (deck.isGiven(key))
      throw deck.error(key,
                       "an engine writes no size distributions; leave this key out, or follow its history.csv by "
                       "'problem: prescribed_gas'");
  // Soot along the mean gas sees what the history tells.
  made.species.clear();
  for (std::size_t k = 0; k < mechanism.numSpecies(); ++k) made.species.push_back(k);
}

}  // namespace

std::vector<double> EngineCase::angles() const {
  std::vector<double> all;
  const auto rows = static_cast<std::size_t>(std::ceil((end - start) / every * (1 - 1e-12)));
  for (std::size_t k = 0; k < rows; ++k) all.push_back(start + every * static_cast<double>(k));
  all.push_back(end);
  return all;
}

EngineCase readEngineCase(const Deck& deck) {
  EngineCase made;
  made.title = deck.string("title");
  made.mechanism = readMechanism(deck);
  readGeometry(deck, made);
  readCharge(deck, made);
  readNumerics(deck, made);
  readWalls(deck, made);
  readMixing(deck, made);
  readInjection(deck, made);
  if (deck.has(particleSection)) readSoot(deck, made);
  // Of each repeat on the first rank, as it is gathered and as it is written.
  requireMemory(deck, "sample.repeats", fmt::format("the rows of {} repeats", made.repeats),
                16.0 * static_cast<double>(made.repeats) *
                    static_cast<double>(made.angles().size() * engineQuantities(made).size()));
  return made;
}

}  // namespace lampblack::app
