// Stirred reactors and their networks in a reactor deck.
#include <fmt/format.h>

#include <algorithm>

#include "app/deck/gas_input.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/problems/reactor/reactor_case_parts.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"
#include "numerics/dense_lu.hpp"

namespace lampblack::app::reactorcase {
namespace {

StirredReactor readVessel(const Deck& deck, const std::string& section, std::string name) {
  StirredReactor reactor;
  reactor.name = std::move(name);
  reactor.volume = deck.optionalQuantity(section + ".volume");
  reactor.residenceTime = deck.optionalQuantity(section + ".residence_time");
  if (reactor.volume.has_value() == reactor.residenceTime.has_value())
    throw deck.error(section, "a stirred reactor needs either 'volume' or 'residence_time'");
  if (deck.has(section + ".heat_loss")) {
    reactor.conductance = deck.quantity(section + ".heat_loss.conductance");
    reactor.surroundings = deck.quantity(section + ".heat_loss.surroundings");
  }
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
  double fraction = 0, massFlow = 0;
};

std::vector<Connection> readConnections(const Deck& deck, const ReactorNetwork& network) {
  std::vector<Connection> connections;
  for (std::size_t i = 0; i < deck.size("network.connections"); ++i) {
    const std::string item = fmt::format("network.connections[{}]", i);
    Connection connection{reactorNamed(deck, item + ".from", network), reactorNamed(deck, item + ".to", network)};
    const auto fraction = deck.optionalNumber(item + ".fraction");
    const auto massFlow = deck.optionalQuantity(item + ".mass_flow");
    if (fraction && massFlow) throw deck.error(item, "expected 'fraction' or 'mass_flow', found both");
    if (connection.from == connection.to)
      throw deck.error(item, "this connection leads from a reactor to itself; expected another reactor");
    connection.massFlow = massFlow.value_or(0.0);
    if (!massFlow) connection.fraction = fraction.value_or(1.0);
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
    lu.column(connection.from)[connection.to] -= connection.fraction;
    flow[connection.to] += connection.massFlow;
  }
  if (!lu.factorise())
    throw deck.error("network.connections", "the mass flows have no balance: a loop lets nothing out");
  lu.solve(flow.data());
  for (std::size_t r = 0; r < count; ++r) {
    const std::string key = "network.reactors." + network.reactors[r].name;
    if (!(flow[r] > 0)) throw deck.error(key, "nothing flows into this reactor");
    double out = 0;
    for (const Connection& connection : connections)
      if (connection.from == r) out += connection.fraction * flow[r] + connection.massFlow;
    if (out > flow[r] * (1 + 1e-9))
      throw deck.error(key, fmt::format("{:.6g} kg/s leave this reactor by its connections, but only {:.6g} kg/s flow "
                                        "through it",
                                        out, flow[r]));
  }
  return flow;
}

}  // namespace

void readStirred(const Deck& deck, ReactorCase& reactorCase) {
  if (!deck.has("inlet")) throw deck.error("inlet", "a stirred reactor needs the section 'inlet'");
  const Mechanism& mechanism = *reactorCase.mechanism;
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
  reactorCase.network = {pressure,
                         {reactor},
                         {{0, massFlow.value_or(1.0), temperature, readMixture(deck, "inlet", *reactorCase.mechanism)}},
                         {}};
  reactorCase.start.burnt = deck.choice("reactor.start") == "burnt";
  reactorCase.end = deck.optionalQuantity("time.end").value_or(0.0);
  if (!deck.has("initial")) return;
  if (deck.isGiven("reactor.start"))
    throw deck.error(
        "reactor.start",
        "the section 'initial' already says from where the steady state is searched; leave one of the two out");
  reactorCase.start.given = {readTemperature(deck, "initial.temperature", mechanism, TemperatureUse::reactor), pressure,
                             readMixture(deck, "initial", *reactorCase.mechanism)};
}

void readNetwork(const Deck& deck, ReactorCase& reactorCase) {
  if (!deck.has("network")) throw deck.error("network", "a network needs the section 'network'");
  ReactorNetwork& network = reactorCase.network;
  network.pressure = deck.quantity("pressure");
  for (const std::string& name : deck.children("network.reactors")) {
    const std::string section = "network.reactors." + name;
    network.reactors.push_back(readVessel(deck, section, name));
    if (deck.has(section + ".temperature"))
      network.reactors.back().temperature =
          readTemperature(deck, section + ".temperature", *reactorCase.mechanism, TemperatureUse::reactor);
    refuseHeatLoss(deck, section, network.reactors.back());
  }
  for (const std::string& name : deck.children("network.inlets")) {
    const std::string section = "network.inlets." + name;
    network.inflows.push_back(
        {reactorNamed(deck, section + ".to", network), deck.quantity(section + ".mass_flow"),
         readTemperature(deck, section + ".temperature", *reactorCase.mechanism, TemperatureUse::reactor),
         readMixture(deck, section, *reactorCase.mechanism)});
  }
  const auto connections = readConnections(deck, network);
  const auto flow = balancedFlows(deck, network, connections);
  for (const Connection& connection : connections)
    network.streams.push_back(
        {connection.from, connection.to, connection.fraction * flow[connection.from] + connection.massFlow});
  reactorCase.start.burnt = deck.choice("reactor.start") == "burnt";
}

void readUpstream(const Deck& deck, ReactorCase& reactorCase) {
  if (!deck.has("upstream")) return;
  StirredReactor vessel = readVessel(deck, "upstream", "upstream");
  if (deck.has("upstream.temperature"))
    vessel.temperature = readTemperature(deck, "upstream.temperature", *reactorCase.mechanism, TemperatureUse::reactor);
  refuseHeatLoss(deck, "upstream", vessel);
  const auto massFlow = deck.optionalQuantity("inlet.mass_flow");
  if (!massFlow && (vessel.volume || vessel.conductance > 0))
    throw deck.error("inlet",
                     "a stirred reactor before the duct that has a volume, or loses heat, needs the key "
                     "'mass_flow'");
  if (deck.choice("reactor.energy") == "isothermal" && !deck.has("reactor.temperature"))
    throw deck.error("reactor.energy",
                     "behind a stirred reactor an isothermal duct needs the key 'reactor.temperature'");
  const GasState& inlet = reactorCase.inlet;
  reactorCase.upstream = {inlet.pressure, {vessel}, {{0, massFlow.value_or(1.0), inlet.temperature, inlet.Y}}, {}};
  // Enough for any population: with a volume, the residence time is that of the cold gas at most.
  const double residence =
      vessel.residenceTime
          ? *vessel.residenceTime
          : *vessel.volume * Thermo(*reactorCase.mechanism).density(inlet.temperature, inlet.pressure, inlet.Y) /
                *massFlow;
  reactorCase.upstreamTime = deck.number("upstream.residence_times") * residence;
}

}  // namespace lampblack::app::reactorcase
