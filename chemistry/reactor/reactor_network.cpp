#include "chemistry/reactor/reactor_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lampblack::chemistry {

double ReactorNetwork::throughflow(std::size_t reactor) const {
  double flow = 0;
  for (const InflowStream& stream : inflows)
    if (stream.to == reactor) flow += stream.massFlow;
  for (const InnerStream& stream : streams)
    if (stream.to == reactor) flow += stream.massFlow;
  return flow;
}

NetworkSystem::NetworkSystem(const Mechanism& mechanism, ReactorNetwork network, CarriedPhase* carried)
    : mechanism_(mechanism),
      network_(std::move(network)),
      carried_(carried),
      species_(mechanism.numSpecies()),
      thermo_(mechanism),
      system_(mechanism, carried),
      source_(species_),
      carriedSource_(numCarried()),
      blockJ_(blockSize() * blockSize()),
      blockF_(blockSize()),
      h_(species_),
      upstreamH_(species_),
      carriedH_(numCarried()),
      upstreamCarriedH_(numCarried()),
      carriedCapacity_(numCarried()) {
  feed_.Y.resize(species_);
  feed_.carried.resize(numCarried());
  for (InflowStream& stream : network_.inflows) stream.carried.resize(numCarried(), 0.0);
  for (std::size_t r = 0; r < network_.reactors.size(); ++r) throughflow_.push_back(network_.throughflow(r));
  for (const InflowStream& stream : network_.inflows)
    inflowEnthalpy_.push_back(enthalpy(stream.temperature, stream.Y.data(), stream.carried.data()));
}

// J/kg, of the gas and what it carries
double NetworkSystem::enthalpy(double T, const double* Y, const double* carried) {
  double h = thermo_.enthalpyMass(T, {Y, species_});
  if (carried_ == nullptr) return h;
  carried_->enthalpies(T, carriedH_, carriedCapacity_);
  for (std::size_t s = 0; s < numCarried(); ++s) h += carried[s] * carriedH_[s];
  return h;
}

double NetworkSystem::toleranceScale(std::size_t i) const {
  return reactorToleranceScale(i % blockSize(), species_, false);
}

double NetworkSystem::density(const double* block) const {
  return thermo_.density(block[species_], network_.pressure, {block, species_});
}

// kg
double NetworkSystem::holdUp(const double* block, std::size_t reactor) const {
  const StirredReactor& vessel = network_.reactors[reactor];
  return vessel.volume ? *vessel.volume * density(block) : *vessel.residenceTime * throughflow_[reactor];
}

double NetworkSystem::residenceTime(const double* y, std::size_t reactor) const {
  return holdUp(block(y, reactor), reactor) / throughflow_[reactor];
}

double NetworkSystem::heatRelease(const double* y, std::size_t reactor) {
  const double* state = block(y, reactor);
  setConditions(state, reactor, 1.0);
  if (!system_.chemicalRates(state, blockF_.data())) return std::nan("");
  thermo_.speciesEnthalpies(state[species_], h_);
  double heat = 0;
  for (std::size_t k = 0; k < species_; ++k) heat -= h_[k] * blockF_[k];
  return heat * system_.density();
}

void NetworkSystem::gatherFeed(const double* y, std::size_t reactor) {
  std::fill(feed_.Y.begin(), feed_.Y.end(), 0.0);
  std::fill(feed_.carried.begin(), feed_.carried.end(), 0.0);
  feed_.enthalpy = 0;
  feed_.massFlow = throughflow_[reactor];
  const auto add = [&](double massFlow, const double* Y, const double* carried, double enthalpy) {
    const double share = massFlow / feed_.massFlow;
    for (std::size_t k = 0; k < species_; ++k) feed_.Y[k] += share * Y[k];
    for (std::size_t s = 0; s < numCarried(); ++s) feed_.carried[s] += share * carried[s];
    feed_.enthalpy += share * enthalpy;
  };
  for (std::size_t i = 0; i < network_.inflows.size(); ++i)
    if (network_.inflows[i].to == reactor)
      add(network_.inflows[i].massFlow, network_.inflows[i].Y.data(), network_.inflows[i].carried.data(),
          inflowEnthalpy_[i]);
  for (const InnerStream& stream : network_.streams)
    if (stream.to == reactor) {
      const double* from = block(y, stream.from);
      const double* carried = from + species_ + 1;
      add(stream.massFlow, from, carried, enthalpy(from[species_], from, carried));
    }
}

// The reactor's equations as ReactorSystem has them: S = Y_in M/m, r = M/m, q = h_in M/m - UA (T - T_s)/m.
void NetworkSystem::setConditions(const double* block, std::size_t reactor, double mass) {
  const StirredReactor& vessel = network_.reactors[reactor];
  const double rate = feed_.massFlow / mass;
  for (std::size_t k = 0; k < species_; ++k) source_[k] = rate * feed_.Y[k];
  for (std::size_t s = 0; s < numCarried(); ++s) carriedSource_[s] = rate * feed_.carried[s];
  ReactorSystem::Conditions conditions;
  conditions.value = network_.pressure;
  if (vessel.temperature) conditions.energy = ReactorSystem::Energy::GivenTemperature;
  conditions.source = source_;
  conditions.carriedSource = carriedSource_;
  conditions.removal = rate;
  conditions.heating = rate * feed_.enthalpy - vessel.conductance * (block[species_] - vessel.surroundings) / mass;
  system_.setConditions(conditions);
}

bool NetworkSystem::rates(double /*t*/, const double* y, double* f) {
  for (std::size_t r = 0; r < network_.reactors.size(); ++r) {
    const double* state = block(y, r);
    if (!(state[species_] >= Thermo::minTemperature)) return false;
    gatherFeed(y, r);
    setConditions(state, r, holdUp(state, r));
    if (!system_.rates(state, f + r * blockSize())) return false;
  }
  return true;
}

bool NetworkSystem::jacobian(double /*t*/, const double* y, double* f, double* J, std::size_t ld) {
  const std::size_t size = blockSize();
  for (std::size_t j = 0; j < this->size(); ++j) std::fill_n(J + j * ld, this->size(), 0.0);
  for (std::size_t r = 0; r < network_.reactors.size(); ++r) {
    const double* state = block(y, r);
    if (!(state[species_] >= Thermo::minTemperature)) return false;
    gatherFeed(y, r);
    const double mass = holdUp(state, r);
    setConditions(state, r, mass);
    if (!system_.jacobian(state, f + r * size, blockJ_.data(), size)) return false;
    for (std::size_t j = 0; j < size; ++j)
      std::copy_n(blockJ_.data() + j * size, size, J + r * size + (r * size + j) * ld);
    addFlowDerivatives(y, r, mass, J + r * size, ld);
  }
  return true;
}

// What ReactorSystem takes as given numbers but depends on the state: the hold-up m ~ rho V, the heat lost to the wall,
// and the streams from other reactors. J points to this reactor's rows.
void NetworkSystem::addFlowDerivatives(const double* y, std::size_t reactor, double mass, double* J, std::size_t ld) {
  const StirredReactor& vessel = network_.reactors[reactor];
  const std::size_t n = species_, first = reactor * blockSize();
  const double* state = block(y, reactor);
  const double T = state[n], rate = feed_.massFlow / mass;
  const bool energy = !vessel.temperature;
  const std::size_t count = numCarried();
  double cp = thermo_.cpMass(T, {state, n});
  thermo_.speciesEnthalpies(T, h_);
  if (carried_ != nullptr) {
    carried_->enthalpies(T, carriedH_, carriedCapacity_);
    for (std::size_t s = 0; s < count; ++s) cp += carriedCapacity_[s] * state[n + 1 + s];
  }
  if (vessel.volume) {
    // All flow terms g go with 1/m, and -d ln m/dY_j = Wbar/W_j, -d ln m/dT = 1/T.
    double heat = feed_.enthalpy;
    for (std::size_t k = 0; k < n; ++k) {
      blockF_[k] = rate * (feed_.Y[k] - state[k]);
      heat -= feed_.Y[k] * h_[k];
    }
    for (std::size_t s = 0; s < count; ++s) {
      blockF_[n + 1 + s] = rate * (feed_.carried[s] - state[n + 1 + s]);
      heat -= feed_.carried[s] * carriedH_[s];
    }
    blockF_[n] = energy ? (rate * heat - vessel.conductance * (T - vessel.surroundings) / mass) / cp : 0.0;
    const double Wbar = thermo_.meanMolecularWeight({state, n});
    for (std::size_t j = 0; j <= n; ++j) {
      const double factor = j < n ? Wbar / mechanism_.molecularWeights()[j] : 1.0 / T;
      for (std::size_t i = 0; i < blockSize(); ++i) J[i + (first + j) * ld] += factor * blockF_[i];
    }
  }
  if (energy) J[n + (first + n) * ld] -= vessel.conductance / (mass * cp);
  for (const InnerStream& stream : network_.streams) {
    if (stream.to != reactor) continue;
    const double share = stream.massFlow / mass;
    const double* from = block(y, stream.from);
    double* columns = J + stream.from * blockSize() * ld;
    for (std::size_t k = 0; k < n; ++k) columns[k + k * ld] += share;
    for (std::size_t i = n + 1; i < blockSize(); ++i) columns[i + i * ld] += share;
    if (!energy) continue;
    thermo_.speciesEnthalpies(from[n], upstreamH_);
    for (std::size_t k = 0; k < n; ++k) columns[n + k * ld] += share * (upstreamH_[k] - h_[k]) / cp;
    columns[n + n * ld] += share * thermo_.cpMass(from[n], {from, n}) / cp;
    if (carried_ == nullptr) continue;
    carried_->enthalpies(from[n], upstreamCarriedH_, carriedCapacity_);
    for (std::size_t s = 0; s < count; ++s) {
      const std::size_t i = n + 1 + s;
      columns[n + i * ld] += share * (upstreamCarriedH_[s] - carriedH_[s]) / cp;
      columns[n + n * ld] += share * carriedCapacity_[s] * from[i] / cp;
    }
  }
}

std::string NetworkSystem::describe(double t, const double* y) const {
  std::string text = fmt::format("t = {:.6g} s, p = {:.6g} Pa", t, network_.pressure);
  for (std::size_t r = 0; r < network_.reactors.size(); ++r) {
    const double* state = block(y, r);
    text += fmt::format("; {}: T = {:.6g} K, mass fractions {{{}}}", network_.reactors[r].name, state[species_],
                        compositionText(mechanism_, {state, species_}));
  }
  return text;
}

}  // namespace lampblack::chemistry
