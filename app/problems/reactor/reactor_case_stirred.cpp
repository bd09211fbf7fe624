// Stirred reactors and their networks in a reactor deck.
#include <fmt/format.h>

#include <algorithm>

#include "app/deck/gas_input.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/problems/reactor/reactor_case_parts.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"
#include "io/deck_keys.hpp"
#include "numerics/dense_lu.hpp"

namespace lampblack::app::reactorcase {
namespace {

// What a stirred reactor has, alone or in a network.
DeckKeys<StirredReactor> vesselKeys(const std::string& section, const std::string& type = "") {
  DeckKeys<StirredReactor> keys(section);
  keys.quantity("volume", units::volume, &StirredReactor::volume,
                rules().optional().above(0).onlyWith("reactor.type", {type}),
                "Volume of the reactor; either this or residence_time.");
  keys.quantity(
      "residence_time", units::time, &StirredReactor::residenceTime,
      rules().optional().above(0).onlyWith("reactor.type", {type}),
      "Residence time, the mass inside over the mass flow; the volume follows from it. Either this or volume.");
  keys.section("heat_loss", Presence::optional, "Where there is an energy equation.", {{"reactor.type", {type}}});
  keys.quantity("heat_loss.conductance", units::watt / units::temperature, &StirredReactor::conductance,
                rules().required().atLeast(0),
                "Heat lost per time and kelvin above the surroundings, in W/K: bigger cools more.");
  keys.quantity("heat_loss.surroundings", units::temperature, &StirredReactor::surroundings,
                rules().atLeast(0).byDefault("300 K"), "Temperature of the surroundings that heat is lost to.");
  return keys;
}

StirredReactor readVessel(const Deck& deck, const std::string& section, std::string name) {
  StirredReactor reactor = vesselKeys(section).read(deck);
  reactor.name = std::move(name);
  if (reactor.volume.has_value() == reactor.residenceTime.has_value())
    throw deck.error(section, "a stirred reactor needs either 'volume' or 'residence_time'");
  return reactor;
}

void refuseHeatLoss(const Deck& deck, const std::string& section, const StirredReactor& reactor) {
  if (reactor.temperature && deck.has(section + ".heat_loss"))
    throw deck.error(section + ".heat_loss",
                     "the temperature of this reactor is given, so that a loss of heat would change nothing; leave "
                     "this section out");
}

std::size_t reactorNamed(const Deck& deck, const std::string& key, const ReactorNetwork& network) {
  const std::string name = deck.string(key);
  std::vector<std::string> names;
  for (std::size_t r = 0; r < network.reactors.size(); ++r) {
    if (network.reactors[r].name == name) return r;
    names.push_back(network.reactors[r].name);
  }
  throw deck.error(key, fmt::format("no reactor '{}' in network.reactors{}", name, didYouMean(name, names)));
}

// A connection of the deck: a share of what flows through a reactor, or a mass flow.
struct Connection {
  std::size_t from = 0, to = 0;
  std::optional<double> fraction, massFlow;

  // kg/s, of so much that flows through the reactor it leaves.
  [[nodiscard]] double flow(double through) const { return massFlow ? *massFlow : fraction.value_or(1.0) * through; }
};

DeckKeys<Connection> connectionKeys() {
  DeckKeys<Connection> keys("network.connections[]");
  keys.number("fraction", &Connection::fraction, rules().optional().above(0).atMost(1),
              "Part of all that flows through the reactor it leaves that takes this connection; 1 if neither this nor "
              "mass_flow is given.");
  keys.quantity("mass_flow", units::massFlow, &Connection::massFlow, rules().optional().above(0),
                "Mass flow of the connection, in place of a fraction.");
  return keys;
}

std::vector<Connection> readConnections(const Deck& deck, const ReactorNetwork& network) {
  std::vector<Connection> connections;
  for (std::size_t i = 0; i < deck.size("network.connections"); ++i) {
    const std::string item = fmt::format("network.connections[{}]", i);
    Connection connection = connectionKeys().read(deck, item);
    connection.from = reactorNamed(deck, item + ".from", network);
    connection.to = reactorNamed(deck, item + ".to", network);
    if (connection.fraction && connection.massFlow)
      throw deck.error(item, "expected 'fraction' or 'mass_flow', found both");
    if (connection.from == connection.to)
      throw deck.error(item, "this connection leads from a reactor to itself; expected another reactor");
    connections.push_back(connection);
  }
  return connections;
}

// What flows through each reactor when all are in balance: F_r = inflows + sum over connections to r of
// (fraction F_from + mass flow).
std::vector<double> balancedFlows(const Deck& deck, const ReactorNetwork& network,
                                  const std::vector<Connection>& connections) {
  const std::size_t count = network.reactors.size();
  DenseLu lu(count);
  std::vector<double> flow(count, 0.0);
  for (std::size_t r = 0; r < count; ++r) lu.column(r)[r] = 1.0;
  for (const InflowStream& stream : network.inflows) flow[stream.to] += stream.massFlow;
  for (const Connection& connection : connections) {
    if (!connection.massFlow) lu.column(connection.from)[connection.to] -= connection.fraction.value_or(1.0);
    flow[connection.to] += connection.massFlow.value_or(0.0);
  }
  if (!lu.factorise())
    throw deck.error("network.connections", "the mass flows have no balance: a loop lets nothing out");
  lu.solve(flow.data());
  for (std::size_t r = 0; r < count; ++r) {
    const std::string key = "network.reactors." + network.reactors[r].name;
    if (!(flow[r] > 0)) throw deck.error(key, "nothing flows into this reactor");
    double out = 0;
    for (const Connection& connection : connections)
      if (connection.from == r) out += connection.flow(flow[r]);
    if (out > flow[r] * (1 + 1e-9))
      throw deck.error(key, fmt::format("{:.6g} kg/s leave this reactor by its connections, but only {:.6g} kg/s flow "
                                        "through it",
                                        out, flow[r]));
  }
  return flow;
}

}  // namespace

void addVesselKeys(DeckSchema& schema, const std::string& section, const std::string& type) {
  schema.add(vesselKeys(section, type).schema());
}

void addNetworkKeys(DeckSchema& schema) {
  SectionKeys keys("network");
  keys.section(Presence::optional, "Stirred reactors of one pressure and the streams between them.",
               {{"reactor.type", {"network"}}});
  keys.section("reactors", Presence::required, "Named reactors.");
  keys.quantity("reactors.*.temperature", units::temperature, temperatureRules().optional(),
                "Temperature at which this reactor is held; absent: it follows from the energy equation.");
  addVesselKeys(keys.schema(), "network.reactors.*", "network");
  keys.section("inlets", Presence::required, "Named streams from outside.");
  keys.text("inlets.*.to", rules(), "Name of the reactor that the stream flows into.");
  keys.quantity("inlets.*.mass_flow", units::massFlow, rules().above(0), "Mass flow of the stream.");
  keys.quantity("inlets.*.temperature", units::temperature, temperatureRules(), "Temperature of the gas.");
  addMixtureKeys(keys.schema(), "network.inlets.*");
  keys.section("connections", Presence::optional,
               "Streams between reactors. What a reactor does not pass on leaves the network.");
  keys.text("connections[].from", rules(), "Name of the reactor that the stream leaves.");
  keys.text("connections[].to", rules(), "Name of the reactor that the stream flows into.");
  keys.schema().add(connectionKeys().schema());
  schema.add(keys.schema());
}

StirredKind readStirred(const Deck& deck, const Mechanism& mechanism) {
  if (!deck.has("inlet")) throw deck.error("inlet", "a stirred reactor needs the section 'inlet'");
  const double pressure = deck.quantity("pressure");
  const double temperature = readTemperature(deck, "inlet.temperature", mechanism, TemperatureUse::reactor);
  StirredReactor reactor = readVessel(deck, "reactor", "reactor");
  if (deck.choice("reactor.energy") == "isothermal")
    reactor.temperature = deck.has("reactor.temperature")
                              ? readTemperature(deck, "reactor.temperature", mechanism, TemperatureUse::reactor)
                              : temperature;
  refuseHeatLoss(deck, "reactor", reactor);
  // By residence time alone the mass flow does not matter, unless heat is lost.
  const auto massFlow = deck.optionalQuantity("inlet.mass_flow");
  if (!massFlow && reactor.volume)
    throw deck.error("inlet", "a stirred reactor with a volume needs the key 'mass_flow'");
  if (!massFlow && reactor.conductance > 0)
    throw deck.error("inlet", "a stirred reactor that loses heat needs the key 'mass_flow'");
  StirredKind stirred;
  stirred.vessels = {
      pressure, {reactor}, {{0, massFlow.value_or(1.0), temperature, readMixture(deck, "inlet", mechanism)}}, {}};
  stirred.start.burnt = deck.choice("reactor.start") == "burnt";
  stirred.duration = deck.optionalQuantity("time.end").value_or(0.0);
  if (!deck.has("initial")) return stirred;
  if (deck.isGiven("reactor.start"))
    throw deck.error(
        "reactor.start",
        "the section 'initial' already says from where the steady state is searched; leave one of the two out");
  stirred.start.given = {readTemperature(deck, "initial.temperature", mechanism, TemperatureUse::reactor), pressure,
                         readMixture(deck, "initial", mechanism)};
  return stirred;
}

StirredKind readNetwork(const Deck& deck, const Mechanism& mechanism) {
  if (!deck.has("network")) throw deck.error("network", "a network needs the section 'network'");
  StirredKind stirred;
  stirred.isNetwork = true;
  ReactorNetwork& network = stirred.vessels;
  network.pressure = deck.quantity("pressure");
  for (const std::string& name : deck.children("network.reactors")) {
    const std::string section = "network.reactors." + name;
    network.reactors.push_back(readVessel(deck, section, name));
    if (deck.has(section + ".temperature"))
      network.reactors.back().temperature =
          readTemperature(deck, section + ".temperature", mechanism, TemperatureUse::reactor);
    refuseHeatLoss(deck, section, network.reactors.back());
  }
  for (const std::string& name : deck.children("network.inlets")) {
    const std::string section = "network.inlets." + name;
    network.inflows.push_back({reactorNamed(deck, section + ".to", network), deck.quantity(section + ".mass_flow"),
                               readTemperature(deck, section + ".temperature", mechanism, TemperatureUse::reactor),
                               readMixture(deck, section, mechanism)});
  }
  const auto connections = readConnections(deck, network);
  const auto flow = balancedFlows(deck, network, connections);
  for (const Connection& connection : connections)
    network.streams.push_back({connection.from, connection.to, connection.flow(flow[connection.from])});
  stirred.start.burnt = deck.choice("reactor.start") == "burnt";
  stirred.duration = deck.optionalQuantity("time.end").value_or(0.0);
  return stirred;
}

void readUpstream(const Deck& deck, const Mechanism& mechanism, PlugFlowKind& duct) {
  if (!deck.has("upstream")) return;
  StirredReactor vessel = readVessel(deck, "upstream", "upstream");
  if (deck.has("upstream.temperature"))
    vessel.temperature = readTemperature(deck, "upstream.temperature", mechanism, TemperatureUse::reactor);
  refuseHeatLoss(deck, "upstream", vessel);
  const auto massFlow = deck.optionalQuantity("inlet.mass_flow");
  if (!massFlow && (vessel.volume || vessel.conductance > 0))
    throw deck.error("inlet",
                     "a stirred reactor before the duct that has a volume, or loses heat, needs the key "
                     "'mass_flow'");
  if (deck.choice("reactor.energy") == "isothermal" && !deck.has("reactor.temperature"))
    throw deck.error("reactor.energy",
                     "behind a stirred reactor an isothermal duct needs the key 'reactor.temperature'");
  const GasState& inlet = duct.inlet;
  duct.upstream = {inlet.pressure, {vessel}, {{0, massFlow.value_or(1.0), inlet.temperature, inlet.Y}}, {}};
  // Enough for any population: with a volume, the residence time is that of the cold gas at most.
  const double residence =
      vessel.residenceTime
          ? *vessel.residenceTime
          : *vessel.volume * Thermo(mechanism).density(inlet.temperature, inlet.pressure, inlet.Y) / *massFlow;
  duct.upstreamTime = deck.number("upstream.residence_times") * residence;
}

}  // namespace lampblack::app::reactorcase
