// The section time.steady of a flow's deck: when a run in time is steady, and how a steady state is sought.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "app/deck/particles_deck.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/problems/flow/flow_case_parts.hpp"
#include "coupling/block_statistics.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app::flowcase {
namespace {

constexpr const char* mode = "time.mode";
constexpr const char* steadySection = "time.steady";
constexpr const char* stabilitySection = "time.steady.stability";
constexpr int usualAttempts = 2;
// Iterations without gain where they are steps of one time until the flame stands.
constexpr int patienceInOneTime = 400;

// Of a mesh on which a flame is sought from the deck's own start; on finer ones from that of a coarser.
constexpr int mostCellsAlone = 3000, mostCoarserMeshes = 5;

// A vessel without an outlet keeps its mass, and what its gas is heated by its pressure. The equations of a state know
// neither: where any of it can change, no residual tells of it.
void requirePressure(const Deck& deck, const FlowCase& flowCase) {
  const auto isOf = [](BoundaryKind kind) {
    return [kind](const BoundaryCondition& boundary) { return boundary.kind == kind; };
  };
  if (std::ranges::any_of(flowCase.boundaries, isOf(BoundaryKind::Outlet))) return;
  const Stream &low = flowCase.initial.low, &high = flowCase.initial.high;
  const bool isOneGas = flowCase.initialFields.gas.isEmpty() && low.temperature == high.temperature &&
                        low.Y == high.Y && deck.choice("initial.layer") == "none";
  const auto changes = [&](const BoundaryCondition& boundary) {
    return boundary.kind == BoundaryKind::Inlet || boundary.heatFlux != 0.0 || boundary.varies.heatFlux ||
           !boundary.varies.gas.isEmpty() || (boundary.isothermal && boundary.temperature != low.temperature);
  };
  if (!isOneGas || flowCase.radiation.on || std::ranges::any_of(flowCase.boundaries, changes))
    throw deck.error(mode,
                     "a vessel without an outlet, in which gas comes in or is heated, has a pressure that follows from "
                     "what has happened in it, and not from its steady state alone; expected an outlet, or 'transient' "
                     "with 'time.steady'");
}

// Of a run in time.
DeckKeys<SteadyControl> steadyKeys() {
  const DeckCondition inTime{mode, {"transient"}};
  DeckKeys<SteadyControl> keys(steadySection);
  keys.section(
      Presence::optional,
      "When a flow is steady. A run in time ends, before time.end, once over a whole residence time no field "
      "(velocity, temperature, mass fractions, what particles are carried) has changed by more than the tolerance, "
      "and the changes do not grow; absent: the run goes on to time.end; its closing report says how steady it "
      "is in either case. With 'time.mode: steady' what is left of the equations counts. Not with ensembles in the "
      "cells, which fluctuate.");
  keys.number("tolerance", &SteadyControl::tolerance, rules().byDefault("1e-3").above(0).below(1).onlyWith(inTime),
              "Largest change of a field in any cell over a residence time, as a share of the range of the "
              "field in the domain.");
  keys.quantity("time", units::time, &SteadyControl::time, rules().above(0),
                "Time over which changes are counted, and that makes residuals relative. Absent: the residence "
                "time, which is what is in the "
                "domain over what flows through it; without a flow through it the domain's size over its RMS "
                "velocity, or over the conduction of heat where that is faster.");
  keys.choice("norm", &SteadyControl::norm, {{"maximum", Steadiness::Norm::Maximum}, {"rms", Steadiness::Norm::Rms}},
              rules().onlyWith(inTime),
              "maximum: the change of the cell that changes most counts; rms: the root of the mean square over "
              "the domain, which a small part that moves to and fro does not keep up.");
  keys.quantity("after", units::time, &SteadyControl::after, rules().atLeast(0).onlyWith(inTime),
                "Time before which the run does not end: until what boundaries do over time is over, or "
                "something slow has begun.");
  return keys;
}

// Of the search for a steady state, all of which count with 'time.mode: steady' alone.
DeckKeys<TimeControl::Search> searchKeys() {
  using Search = TimeControl::Search;
  DeckKeys<Search> keys(steadySection);
  keys.number("residual", &Search::residual, rules().above(0).below(1),
              "Residual below which the flow is steady: what is left of the rates of each equation, summed over "
              "the cells, as a share of what goes through the domain or is made in it.");
  keys.integer("iterations", &Search::iterations, rules().atLeast(1).atMost(1e6),
               "Iterations after which a search that has not come to its end is given up.");
  keys.integer("returns", &Search::returns, rules().atLeast(0).atMost(20),
               "How often the search may go back from iterations that do not converge to steps in time, twice "
               "as many each time, before it is given up.");
  keys.integer("attempts", &Search::attempts, rules().optional().atLeast(0).atMost(5),
               fmt::format("Attempts to find the state by iterations before the flow is established: after 20 "
                           "steps in time, and each after twice as many. What burns and has no residual is taken; "
                           "an attempt that fails is taken back, and the steps go on as without it. Absent: {} "
                           "where a flame burns or the gas could burn, none else; a number holds for any gas.",
                           usualAttempts));
  keys.integer("steps", &Search::steps, rules().optional().atLeast(1).atMost(1e5),
               "Steps in time before the first iterations, in place of as many as the heat release takes to "
               "become quiet (50 to 300; at least 10 in a gas without reactions). With 20 most flames are found "
               "in a third to a tenth of the time; a "
               "flame that can stand in two ways may be found in the other. From the steady state of a coarser mesh at "
               "most 50 of a number given here are taken.");
  keys.boolean("light", &Search::lights, rules(),
               "Lights the flow where nothing burns once the steps in time are over, or in the steady state that "
               "iterations find, though the start had gas of more than 1000 K: each cell whose mixture burns to "
               "a gas at least 500 K hotter becomes that gas. At most twice; the run says so. false: what is not "
               "lit stays cold.");
  keys.boolean(
      "one_time", &Search::oneTime, rules(),
      "true: until a flame in eddies stands, iterations are implicit steps of one time for all cells; for a flame "
      "that was just lit or whose end still moves, as iterations in pseudo-times of the cells' own run away "
      "from it. false: iterations in pseudo-times from the first on, by which a flame that stands beside slow "
      "air is found sooner.");
  keys.integer(
      "coarser_meshes", &Search::coarserMeshes, rules().optional().atLeast(0).atMost(mostCoarserMeshes),
      fmt::format(
          "Number of coarser meshes, each of half the cells of the next in every direction (of a "
          "plane box, bent or not), on which the steady state is sought first: what is found on one is the start "
          "on the next. A run that is stopped on one of them begins anew. Absent: as many as lead to "
          "no more than {} cells where the mechanism has reactions and the start is the deck's own, "
          "none with turbulence.",
          mostCellsAlone));
  return keys;
}

// Of gas and ensembles in turn; as those of the search.
DeckKeys<SteadyRounds::Options> roundsKeys() {
  using Rounds = SteadyRounds::Options;
  DeckKeys<Rounds> keys(steadySection);
  keys.integer("rounds", &Rounds::most, rules().atLeast(1).onlyWith(ofPopulations()),
               "Most rounds of gas and particles in turn: in each first the gas becomes steady with what the "
               "particles take of it in the mean (nothing in the first), then the particles have their averages in "
               "that gas.");
  keys.number("agreement", &Rounds::tolerance, rules().above(0).onlyWith(ofPopulations()),
              "Change of temperature, mass fractions and velocity of the gas from one "
              "round to the next, of the range of each in the domain, with which the rounds end. What the gas "
              "feels of the particles has the noise of their averages, by which it differs from round to round.");
  keys.integer("blocks", &Rounds::blocks, rules().atLeast(static_cast<double>(leastBlocks)).onlyWith(ofPopulations()),
               "Blocks (particles.statistics.block) of the averages of the last round; "
               "those before, while "
               "the gas still changes by more than three times 'agreement', have the least number.");
  return keys;
}

DeckKeys<TimeControl::Stability> stabilityKeys() {
  using Stability = TimeControl::Stability;
  DeckKeys<Stability> keys(stabilitySection);
  keys.section(Presence::optional,
               "Whether the steady state that was found lasts: growth rates and frequencies of its disturbances, which "
               "take marches of the flow in time, in steps of two sweeps. Absent: not looked at.",
               {{mode, {"steady"}}});
  keys.quantity("time", units::time, &Stability::time, rules().above(0),
                "Time over which each disturbance is marched. Frequencies above one over twice that time are "
                "told as lower ones. Absent: a fortieth of the residence time.");
  keys.integer("vectors", inner(&Stability::modes, &ModeOptions::vectors), rules().atLeast(2).atMost(1000),
               "Disturbances that are marched at most; fewer where the one that leads is known before.");
  keys.number("disturbance", inner(&Stability::modes, &ModeOptions::disturbance), rules().above(0).below(1),
              "The largest change of any field in any cell that a disturbance has, of the field's range.");
  return keys;
}

}  // namespace

bool isSearched(const Deck& deck) {
  return deck.choice(mode) == "steady";
}

std::optional<SteadyControl> readSteady(const Deck& deck, const FlowCase& flowCase) {
  if (!deck.has(steadySection)) return {};
  if (flowCase.ensembles)
    throw deck.error(steadySection,
                     "ensembles in the cells fluctuate, and with them the gas: their fields never come to rest. Leave "
                     "this out; averages that start by themselves tell when the soot has no trend "
                     "(particles.statistics)");
  return steadyKeys().read(deck);
}

namespace {

// Meshes of plane boxes, bent or not, can be made coarser.
bool isPlaneBox(const FlowCase& flowCase) {
  return !flowCase.meshFile && flowCase.dimension == 2;
}

void requireOneTime(const Deck& deck, TimeControl::Search& search, const FlowCase& flowCase) {
  const auto refuse = [&](const char* why) { throw deck.error("time.steady.one_time", why); };
  if (!search.reacts || !deck.has("turbulence"))
    refuse("steps of one time are for a gas that reacts in eddies; this flow has none");
  if (search.branch) refuse("steps of one time do not know a load that is sought, too; leave this or that out");
  if (std::ranges::none_of(flowCase.boundaries, [](const auto& b) { return b.kind == BoundaryKind::Outlet; }))
    refuse("steps of one time need an outlet, as the pressure of a closed vessel is an unknown, too");
  search.patience = patienceInOneTime;
}

int usualCoarserMeshes(const Deck& deck, const FlowCase& flowCase) {
  if (!isPlaneBox(flowCase) || flowCase.mechanism->numReactions() == 0 || deck.has("initial.flow") ||
      deck.has("turbulence"))
    return 0;
  const auto& vertices = flowCase.mesh.vertices;
  auto cells = static_cast<int>((vertices[0].size() - 1) * (vertices[1].size() - 1));
  int coarser = 0;
  for (; cells > mostCellsAlone; cells /= 4) ++coarser;
  return std::min(coarser, mostCoarserMeshes);
}

}  // namespace

TimeControl::Search readSearch(const Deck& deck, const FlowCase& flowCase) {
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.varies.inTime)
      throw deck.error("boundaries." + boundary.name,
                       "what this boundary has depends on the time t, and with it the flow, which then has no steady "
                       "state; expected formulas and tables over place alone, or 'time.mode: transient'");
  requirePressure(deck, flowCase);
  if (deck.choice("convection.velocity") != "limited")
    throw deck.error("convection.velocity",
                     "a steady state is sought with 'limited'; expected that, or 'time.mode: "
                     "transient' with two sweeps");
  TimeControl::Search search;
  search.attempts = usualAttempts;
  search.reacts = flowCase.mechanism->numReactions() > 0;
  search.coarserMeshes = usualCoarserMeshes(deck, flowCase);
  if (!deck.has(steadySection)) return search;
  searchKeys().read(deck, search, steadySection);
  search.triesWithoutFlame = deck.isGiven("time.steady.attempts");
  if (search.coarserMeshes > 0 && !isPlaneBox(flowCase))
    throw deck.error("time.steady.coarser_meshes",
                     "coarser meshes are made of plane boxes only, bent or not; leave this out");
  search.time = deck.optionalQuantity("time.steady.time");
  if (deck.has(stabilitySection)) search.stability = stabilityKeys().read(deck);
  search.branch = readBranch(deck, search, flowCase);
  if (search.oneTime) requireOneTime(deck, search, flowCase);
  return search;
}

void addSteadyKeys(DeckSchema& schema) {
  schema.add(steadyKeys().schema());
  for (const DeckSchema& sought : {searchKeys().schema(), roundsKeys().schema()})
    schema.add(sought, {mode, {"steady"}});
  schema.add(stabilityKeys().schema());
  addBranchKeys(schema);
}

void readRounds(const Deck& deck, FlowCase& flowCase) {
  for (const auto& [key, why] : std::initializer_list<std::pair<const char*, const char*>>{
           {"particles.statistics.start", "averages start by themselves once the particles are stationary"},
           {"particles.frozen_gas", "the gas rests while the particles change, and they while it does"},
           {"particles.averaging_time", "the gas has the mean of what the particles take"},
           {"time.steady.stability", "disturbances of a gas with particles that fluctuate are not marched"},
           {"time.steady.continuation", "branches with ensembles are not followed"}})
    if (deck.isGiven(key))
      throw deck.error(key, fmt::format("with ensembles in 'time.mode: steady' {}; leave this out", why));
  EnsembleOperator::Options& ensembles = *flowCase.ensembles;
  ensembles.inTurn = true;
  ensembles.average = 0.0;
  if (!ensembles.statistics) ensembles.statistics.emplace();
  SteadyRounds::Options& rounds = flowCase.time.search->rounds.emplace();
  rounds.leastBlocks = leastBlocks;
  rounds.actsOnGas = ensembles.exchange == EnsembleOperator::Exchange::TwoWay;
  if (!deck.has(steadySection)) return;
  roundsKeys().read(deck, rounds, steadySection);
}

}  // namespace lampblack::app::flowcase
