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

void toDegrees(double& radians) {
  radians /= degree;
}

// Angles (rad) that become times; a single value needs none.
void finishTable(const Deck& deck, const EngineCase& made, const std::string& angles, const std::string& values,
                 EngineTable& table) {
  if (table.values.empty()) throw deck.error(values, "expected one value or more");
  if (deck.has(angles))
    for (double& angle : table.times) angle = made.timeOf(angle / degree);
  else if (table.values.size() == 1)
    table.times = {0};
  if (table.times.size() != table.values.size())
    throw deck.error(values, fmt::format("there are {} values for {} angles ('{}'); give one for each",
                                         table.values.size(), table.times.size(), angles));
  for (std::size_t k = 1; k < table.times.size(); ++k)
    if (!(table.times[k] > table.times[k - 1])) throw deck.error(angles, "expected angles that rise");
}

void finishGeometry(const Deck& deck, EngineCase& made) {
  if (!(2 * made.crank.rod > made.crank.stroke))
    throw deck.error("engine.rod", "the rod has to be longer than half of the stroke, the radius of the crank");
  made.speed /= 2 * std::numbers::pi;
  for (double* angle : {&made.start, &made.end, &made.angleTolerance, &made.step, &made.every}) toDegrees(*angle);
  for (double& angle : made.particlesAt) toDegrees(angle);
  if (!(made.start >= -180 && made.start < made.end && made.end <= 180))
    throw deck.error("engine.end", "expected angles from -180 deg on that rise, up to 180 deg");
}

void readCharge(const Deck& deck, EngineCase& made) {
  const Mechanism& mechanism = *made.mechanism;
  made.fresh = readMixture(deck, "charge", mechanism);
  if (deck.has("charge.fuel")) {
    made.fuel = parseComposition(mechanism, deck.string("charge.fuel"));
    made.oxidizer = parseComposition(mechanism, deck.string("charge.oxidizer"));
    made.ratio = deck.number("charge.equivalence_ratio");
  } else if (made.ratioDeviation > 0) {
    throw deck.error("charge.ratio_deviation",
                     "it is one of equivalence ratios; give the charge by fuel, oxidizer and equivalence_ratio");
  }
}

void finishWalls(const Deck& deck, EngineCase& made) {
  EngineOptions& options = made.options;
  options.bore = made.crank.bore;
  options.pistonSpeed = 2 * made.crank.stroke * made.speed;
  options.displacement = made.crank.displacement();
  options.clearance = made.crank.clearance();
  const double section = std::numbers::pi * made.crank.bore * made.crank.bore / 4;
  options.endArea = made.headArea.value_or(section) + made.pistonArea.value_or(section);
  if (options.heat.model == EngineHeatLaw::Model::none) {
    options.jumpConstant = 0;
    return;
  }
  if (options.heat.model == EngineHeatLaw::Model::constant && !deck.has("walls.factor"))
    throw deck.error("walls", "a constant coefficient needs the key 'factor'");
  if (options.jumpConstant > 0 && !(options.jumpConstant > 1))
    throw deck.error("walls.jumps", "expected more than 1, or 0 for an even loss: a jump may not go beyond the walls");
}

void readInjection(const Deck& deck, EngineCase& made) {
  if (!deck.has("injection")) return;
  const EngineSpray liquid = engineSprayKeys().read(deck);
  const Thermo thermo(*made.mechanism);
  EngineInjection::Options spray;
  spray.massFractions.resize(made.mechanism->numSpecies());
  thermo.moleToMass(deck.at("injection.fuel", [&] { return parseComposition(*made.mechanism, liquid.fuel); }),
                    spray.massFractions);
  spray.enthalpy = thermo.enthalpyMass(liquid.temperature, spray.massFractions) - liquid.latentHeat;
  spray.dilution = liquid.dilution;
  spray.mostParticles = liquid.mostParticles.value_or(2 * made.particles);
  if (spray.mostParticles < made.particles)
    throw deck.error("injection.most_particles", "expected at least as many as there are at the start");
  made.options.injection = spray;
  EngineTable& rate = made.options.injectionRate = liquid.rate;
  finishTable(deck, made, "injection.angles", "injection.rates", rate);
  if (rate.values.front() != 0 || rate.values.back() != 0)
    throw deck.error("injection.rates", "expected rates that begin and end with zero");
  if (rate.times.front() < 0 || rate.times.back() > made.timeOf(made.end))
    throw deck.error("injection.angles", "expected angles between engine.start and engine.end");
}

void finishNumerics(const Deck& deck, EngineCase& made) {
  EngineOptions& options = made.options;
  options.step = made.step / (360 * made.speed);
  const SliderCrank crank = made.crank;
  options.volume = [crank, start = made.start, speed = made.speed](double time) {
    return crank.volume((start + 360 * speed * time) * degree);
  };
  if (made.step > made.every * (1 + 1e-12))
    throw deck.error("step.angle", "steps end at each row; give an 'output.every' as long as this or longer");
  if (!((made.end - made.start) / made.every < 1e6)) throw deck.error("output.every", "these are too many rows");
  const std::vector<double>& at = made.particlesAt;
  for (std::size_t k = 0; k < at.size(); ++k)
    if (at[k] < made.start || at[k] > made.end || (k > 0 && !(at[k] > at[k - 1])))
      throw deck.error("output.particles_at", "expected angles that rise, between engine.start and engine.end");
  made.species = readSpeciesList(deck, "output.species", *made.mechanism);
  made.checkpoints = checkpointKeys("more repeats").read(deck);
  requireMemory(deck, "sample.particles", fmt::format("{} particles", made.particles),
                24.0 * static_cast<double>(made.particles * made.mechanism->numSpecies()));
}

void readSoot(const Deck& deck, EngineCase& made) {
  const Mechanism& mechanism = *made.mechanism;
  if (auto model = readSootModel(deck, mechanism)) {
    if (!made.options.reacts)
      throw deck.error("step.reactions", "soot comes of reactions; leave this key out, or the section 'particles'");
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
  EngineCase made = engineKeys().read(deck);
  made.mechanism = readMechanism(deck);
  finishGeometry(deck, made);
  readCharge(deck, made);
  finishNumerics(deck, made);
  finishWalls(deck, made);
  if (made.options.mixing != EngineMixingModel::none)
    finishTable(deck, made, "mixing.angles", "mixing.time", made.options.mixingTime);
  readInjection(deck, made);
  if (deck.has(particleSection)) readSoot(deck, made);
  // Of each repeat on the first rank, as it is gathered and as it is written.
  requireMemory(deck, "sample.repeats", fmt::format("the rows of {} repeats", made.repeats),
                16.0 * static_cast<double>(made.repeats) *
                    static_cast<double>(made.angles().size() * engineQuantities(made).size()));
  return made;
}

}  // namespace lampblack::app
