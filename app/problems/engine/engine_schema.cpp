#include <algorithm>

#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "app/problems/engine/engine_case.hpp"

namespace lampblack::app {
namespace {

using Keys = DeckKeys<EngineCase>;

constexpr auto ofOptions = [](auto member) { return inner(&EngineCase::options, member); };
constexpr auto ofHeat = [](auto member) { return ofOptions(inner(&EngineOptions::heat, member)); };

void addEngine(Keys& keys) {
  constexpr auto crank = [](auto member) { return inner(&EngineCase::crank, member); };
  keys.section("engine", Presence::required, "The engine, and the part of a cycle in which its valves are closed.");
  keys.quantity("engine.bore", units::length, crank(&SliderCrank::bore), rules().required().above(0),
                "Bore of the cylinder.");
  keys.quantity("engine.stroke", units::length, crank(&SliderCrank::stroke), rules().required().above(0),
                "Stroke of the piston.");
  keys.quantity("engine.rod", units::length, crank(&SliderCrank::rod), rules().required().above(0),
                "Length of the connecting rod.");
  keys.number("engine.compression_ratio", crank(&SliderCrank::compressionRatio), rules().required().above(1),
              "Largest over smallest volume.");
  keys.quantity("engine.speed", units::angularVelocity, &EngineCase::speed, rules().required().above(0),
                "Speed of the crank, '1000 rpm'.");
  keys.quantity("engine.start", units::angle, &EngineCase::start, rules().required(),
                "Crank angle from the upper dead centre at which the inlet closes, '-142 deg'.");
  keys.quantity("engine.end", units::angle, &EngineCase::end, rules().required(),
                "Crank angle at which the exhaust opens.");
}

void addCharge(Keys& keys) {
  keys.section("charge", Presence::required, "The gas as the inlet closes.");
  keys.quantity("charge.temperature", units::temperature, &EngineCase::temperature, rules().required().above(0),
                "Temperature of the charge, fresh and burnt gas alike.");
  keys.quantity("charge.pressure", units::pressure, &EngineCase::pressure, rules().required().above(0),
                "Pressure of the charge as the inlet closes.");
  addMixtureKeys(keys.schema(), "charge");
  keys.quantity("charge.temperature_deviation", units::temperature, &EngineCase::temperatureDeviation,
                rules().atLeast(0), "Standard deviation of the particles' temperatures, normal.");
  keys.number("charge.ratio_deviation", &EngineCase::ratioDeviation, rules().atLeast(0),
              "Standard deviation of the particles' equivalence ratios, normal; of a charge given by them.");
  keys.number("charge.exhaust", &EngineCase::exhaust, rules().atLeast(0).below(1),
              "Part of the charge that is cooled exhaust of the same mixture.");
  keys.choice("charge.exhaust_by", &EngineCase::isExhaustByMole, {{"mass", false}, {"mole", true}}, rules(),
              "What that part is counted by.");
  keys.quantity("charge.exhaust_frozen", units::temperature, &EngineCase::exhaustFrozen, rules().above(200),
                "The exhaust has the composition of equilibrium at this temperature.");
  keys.section("cycles", Presence::optional, "Cycles, each with a part of the gas that the last one left.");
  keys.number("cycles.residual", &EngineCase::residual, rules().required().atLeast(0).below(1),
              "Part by mass that stays from the cycle before, expanded to the pressure of the charge.");
  keys.integer("cycles.most", &EngineCase::mostCycles, rules().byDefault("20").atLeast(2).atMost(1000),
               "Number of cycles after which the run ends, steady or not.");
  keys.quantity("cycles.angle_tolerance", units::angle, &EngineCase::angleTolerance,
                rules().byDefault("0.1 deg").above(0),
                "Largest difference of the angle at which half of the heat is free, from cycle to cycle, with "
                "which cycles end.");
  keys.quantity("cycles.temperature_tolerance", units::temperature, &EngineCase::temperatureTolerance,
                rules().byDefault("0.5 K").above(0),
                "Largest difference of the temperature at the start, from cycle to cycle, with which cycles end.");
}

void addMixing(Keys& keys) {
  const auto mixes = [] { return rules().onlyWith("mixing.model", {"iem", "curl", "modified_curl"}); };
  using Model = EngineMixingModel;
  keys.section("mixing", Presence::optional, "How particles mix.");
  keys.choice(
      "mixing.model", ofOptions(&EngineOptions::mixing),
      {{"none", Model::none}, {"iem", Model::iem}, {"curl", Model::curl}, {"modified_curl", Model::modifiedCurl}},
      rules().byDefault("modified_curl"),
      "none; iem: all with their mean; curl: pairs become their mean; modified_curl: pairs come a "
      "uniformly drawn part of the way to it.");
  keys.number("mixing.constant", ofOptions(&EngineOptions::mixingConstant), mixes().above(0),
              "C of the decay of a variance, exp(-C t/tau).");
  keys.quantity("mixing.time", units::time, ofOptions(inner(&EngineOptions::mixingTime, &EngineTable::values)),
                mixes().byDefault("[15 ms]").above(0), "Time scale tau of the turbulence: one, or one for each angle.");
  keys.quantity("mixing.angles", units::angle, ofOptions(inner(&EngineOptions::mixingTime, &EngineTable::times)),
                mixes().optional(), "Crank angles of these times, linear in between.");
}

void addWalls(Keys& keys) {
  using Law = EngineHeatLaw;
  const auto of = [](std::vector<std::string> models) {
    return rules().optional().onlyWith("walls.model", std::move(models));
  };
  keys.section("walls", Presence::optional, "Loss of heat to the walls.");
  DeckKey model = rules().byDefault("woschni");
  for (const auto& [name, law] : engineHeatLaws()) model.choices.push_back(name);
  // The first of them: what follows changes the constants of that law.
  keys.other("walls.model", KeyType::choice, model, "Correlation of the heat transfer coefficient.",
             [](const Deck& deck, const std::string& key, EngineCase& made) {
               made.options.heat = std::ranges::find(engineHeatLaws(), deck.choice(key), &NamedHeatLaw::first)->second;
             });
  keys.quantity("walls.temperature", units::temperature, ofOptions(&EngineOptions::wallTemperature), rules().above(0),
                "Temperature of the walls.");
  keys.quantity("walls.head_area", units::area, &EngineCase::headArea, rules().above(0),
                "Area of the head; that of the bore if not given.");
  keys.quantity("walls.piston_area", units::area, &EngineCase::pistonArea, rules().above(0),
                "Area of the piston; that of the bore if not given.");
  keys.number("walls.jumps", ofOptions(&EngineOptions::jumpConstant), rules().byDefault("15").atLeast(0),
              "C_h: a particle loses one C_h-th of its difference to the walls at once, C_h times as often; 0: "
              "all lose heat evenly.");
  keys.number("walls.factor", ofHeat(&Law::factor), rules().optional().above(0),
              "Factor of the correlation; 3.26, 129.8 and 0.035 if not given; of constant in W/m^2/K.");
  keys.number("walls.pressure_power", ofHeat(&Law::pressurePower), of({"woschni", "hohenberg"}),
              "Power of the pressure.");
  keys.number("walls.temperature_power", ofHeat(&Law::temperaturePower), of({"woschni", "hohenberg"}),
              "Power of the temperature.");
  keys.number("walls.speed_power", ofHeat(&Law::speedPower), of({"woschni", "hohenberg"}),
              "Power of the speed of the gas in the coefficient.");
  keys.number("walls.size_power", ofHeat(&Law::sizePower), of({"woschni", "hohenberg"}),
              "Power of the bore, of hohenberg of the volume.");
  keys.number("walls.piston_speed", ofHeat(&Law::pistonSpeedFactor), of({"woschni", "nusselt"}).atLeast(0),
              "Gas's speed over the mean speed of the piston.");
  keys.number("walls.swirl_speed", ofHeat(&Law::swirlFactor), of({"woschni", "nusselt"}).atLeast(0),
              "Gas's speed by swirl, over that times walls.swirl.");
  keys.number("walls.combustion_speed", ofHeat(&Law::combustionFactor), of({"woschni", "nusselt"}).atLeast(0),
              "Factor in m/s/K of the gas's speed by combustion.");
  keys.number("walls.speed_offset", ofHeat(&Law::speedOffset), of({"hohenberg"}).atLeast(0),
              "Speed in m/s that hohenberg adds to the piston's.");
  keys.number("walls.reynolds_power", ofHeat(&Law::reynoldsPower), of({"nusselt"}), "a of Nu = factor Re^a Pr^b.");
  keys.number("walls.prandtl_power", ofHeat(&Law::prandtlPower), of({"nusselt"}), "b of Nu = factor Re^a Pr^b.");
  keys.number("walls.swirl", ofHeat(&Law::swirl), rules().atLeast(0).onlyWith("walls.model", {"woschni", "nusselt"}),
              "Speed of swirl over that of the piston.");
  keys.number("walls.motored_exponent", ofOptions(&EngineOptions::motoredExponent),
              rules().above(1).onlyWith("walls.model", {"woschni", "nusselt"}),
              "Polytropic exponent of the pressure without combustion.");
}

void addNumerics(Keys& keys) {
  keys.integer("sample.particles", &EngineCase::particles, rules().atLeast(1).atMost(1e6),
               "Particles of gas at the start.");
  keys.integer("sample.repeats", &EngineCase::repeats, rules().atLeast(1).atMost(1e5),
               "Independent repeats, of which means and intervals are.");
  keys.integer("sample.seed", ofOptions(&EngineOptions::seed), rules().atLeast(0),
               "Start of the random numbers: another seed gives another sample, the same seed the same result.");
  keys.quantity("step.angle", units::angle, &EngineCase::step, rules().byDefault("0.5 deg").above(0),
                "Longest step, as an angle of the crank.");
  keys.number("step.pressure_change", ofOptions(&EngineOptions::pressureTolerance), rules().above(0),
              "A step that changes the pressure by a larger part is halved.");
  keys.quantity("step.temperature_change", units::temperature, ofOptions(&EngineOptions::temperatureTolerance),
                rules().optional().above(0),
                "A step in which reactions change a particle's temperature by more is halved; no matter if not given.");
  keys.integer("step.halvings", ofOptions(&EngineOptions::mostHalvings), rules().atLeast(0).atMost(30),
               "How often a step is halved at most.");
  keys.boolean("step.reactions", ofOptions(&EngineOptions::reacts), rules(),
               "Whether the gas reacts; false: a motored engine.");
  constexpr auto reactions = [](auto member) { return ofOptions(inner(&EngineOptions::reactions, member)); };
  keys.number("step.relative_tolerance", reactions(&ConstantPressureReactor::Options::relativeTolerance),
              rules().byDefault("1e-6").above(0).below(1), "Relative error of the reactions in a step.");
  keys.number("step.absolute_tolerance", reactions(&ConstantPressureReactor::Options::absoluteTolerance),
              rules().above(0), "Absolute error of a mass fraction.");
  keys.quantity("output.every", units::angle, &EngineCase::every, rules().byDefault("0.5 deg").above(0),
                "Crank angle from a row of the history to the next.");
  keys.quantity("output.particles_at", units::angle, &EngineCase::particlesAt, rules(),
                "Crank angles at which all particles are written.");
  keys.text("output.species", rules().list().byDefault("[]"),
            "Species of the history, the particles and the emissions.");
}

}  // namespace

const std::vector<NamedHeatLaw>& engineHeatLaws() {
  static const std::vector<NamedHeatLaw> laws{{"woschni", woschniLaw()},
                                              {"hohenberg", hohenbergLaw()},
                                              {"nusselt", nusseltLaw()},
                                              {"constant", {.model = EngineHeatLaw::Model::constant}},
                                              {"none", {}}};
  return laws;
}

DeckKeys<EngineSpray> engineSprayKeys() {
  DeckKeys<EngineSpray> keys("injection");
  keys.section(Presence::optional, "Fuel sprayed into the cylinder.");
  keys.text("fuel", &EngineSpray::fuel, rules().required(), "Mole fractions of the fuel.");
  keys.quantity("angles", units::angle, inner(&EngineSpray::rate, &EngineTable::times), rules().required(),
                "Crank angles of the rates, linear in between.");
  keys.quantity("rates", units::massFlow, inner(&EngineSpray::rate, &EngineTable::values),
                rules().required().atLeast(0), "Mass of fuel per time at each of them.");
  keys.quantity("temperature", units::temperature, &EngineSpray::temperature, rules().above(0),
                "Temperature of the liquid.");
  keys.quantity("latent_heat", units::specificEnergy, &EngineSpray::latentHeat, rules().atLeast(0),
                "Heat that evaporates it there.");
  keys.number("dilution", &EngineSpray::dilution, rules().atLeast(0),
              "Mass of gas, of all particles alike, in which a mass of fuel evaporates.");
  keys.integer("most_particles", &EngineSpray::mostParticles, rules().atLeast(4).atMost(1e6),
               "Most particles: the nearest merge beyond that; twice those at the start if not given.");
  return keys;
}

DeckKeys<EngineCase> engineKeys() {
  Keys keys("");
  keys.choice("problem", {"engine"}, rules(), "What is solved.");
  keys.text("title", &EngineCase::title, rules(), "One line for reports and pictures.");
  addMechanismKeys(keys.schema());
  addEngine(keys);
  addCharge(keys);
  addMixing(keys);
  addWalls(keys);
  keys.schema().add(engineSprayKeys().schema());
  addNumerics(keys);
  return keys;
}

DeckSchema engineSchema() {
  DeckSchema schema = engineKeys().schema();
  schema.add(checkpointKeys("more repeats").schema());
  addParticleKeys(schema,
                  {.description = "Soot: a model whose scalars each particle of gas carries, or an ensemble, trees "
                                  "or molecules along the mean gas, as which they leave it, and both "
                                  "(particles.carried). The history then has all species.",
                   .besideModel = true});
  addRepeatKeys(schema);
  addTreeRunKeys(schema);
  return schema;
}

}  // namespace lampblack::app
