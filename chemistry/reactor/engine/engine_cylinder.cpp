#include "chemistry/reactor/engine/engine_cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace lampblack::chemistry {
namespace {

// What random numbers are for: RandomStream.
constexpr std::uint32_t enginePurpose = 0x73726d;

}  // namespace

EngineCylinder::EngineCylinder(MPI_Comm comm, const Mechanism& mechanism, const Thermo& thermo, EngineOptions options)
    : mechanism_(mechanism),
      thermo_(thermo),
      options_(std::move(options)),
      compression_(thermo),
      mixing_(thermo, options_.mixing, options_.mixingConstant),
      loss_(thermo, options_.jumpConstant),
      reactions_(comm, mechanism, thermo, options_.reactions) {
  if (options_.injection) injection_.emplace(mechanism, thermo, *options_.injection);
}

void EngineCylinder::start(EngineGas gas, double time) {
  gas_ = std::move(gas);
  gas_.scalars = carried_ != nullptr ? carried_->size() : 0;
  gas_.carried.assign(gas_.count() * gas_.scalars, 0);
  ledger_ = {};
  time_ = time;
  size_ = options_.step;
  growthRate_ = 0;
  attempts_ = 0;
  compression_.moveTo(options_.volume(time), gas_);
  const EngineTotals all = totalsOf(thermo_, gas_);
  startPressure_ = gas_.pressure;
  startTemperature_ = all.temperature;
  startVolume_ = all.volume;
  startEnergy_ = all.energy;
  startElements_ = allElements();
  peaks_.begin(options_.step, time, gas_.pressure);
  notePeak();
}

void EngineCylinder::notePeak() {
  const EngineTotals all = totalsOf(thermo_, gas_);
  const double R = gas_.pressure * all.volume / (all.mass * all.temperature);
  peaks_.setGas(all.temperature, all.capacity / (all.capacity - all.mass * R), R);
}

void EngineCylinder::advanceTo(double time) {
  const double smallest = options_.step * std::exp2(-options_.mostHalvings);
  while (time - time_ > 1e-9 * options_.step) {
    // As many equal steps as it takes at the present size.
    const double parts = std::ceil((time - time_) / size_ * (1 - 1e-9)), size = (time - time_) / parts;
    const State before{gas_, ledger_, growthRate_};
    RandomStream random(options_.seed, options_.repeat << 40U | attempts_++, enginePurpose);
    step(size, random);
    const bool isLarge = isTooLarge(before.gas.pressure);
    if (isLarge && 0.5 * size >= smallest) {
      gas_ = before.gas;
      ledger_ = before.ledger;
      growthRate_ = before.growthRate;
      ++ledger_.rejected;
      size_ = 0.5 * size;
      continue;
    }
    ++ledger_.steps;
    if (isLarge) ++ledger_.tooLarge;
    ledger_.largestDefect = std::max(ledger_.largestDefect, defect_);
    time_ = parts == 1 ? time : time_ + size;
    if (peaks_.add(time_, gas_.pressure)) notePeak();
    size_ = std::min(options_.step, 2 * size_);
  }
}

// What is no number is too large.
bool EngineCylinder::isTooLarge(double pressureBefore) const {
  if (!(std::abs(gas_.pressure / pressureBefore - 1) <= options_.pressureTolerance)) return true;
  if (!(defect_ <= options_.pressureTolerance)) return true;
  return options_.temperatureTolerance > 0 && !(hotter_ <= options_.temperatureTolerance);
}

// Between its ends everything is at constant pressure, at one that has half of what reactions and the others do to it
// on either side.
void EngineCylinder::step(double size, RandomStream& random) {
  const double end = time_ + size, middle = time_ + 0.5 * size, foreseen = growthRate_ * size;
  const double growth = others(time_, 0.5 * size, true, random);
  compressTo(options_.volume(middle) - 0.5 * foreseen);
  double happened = 0;
  if (options_.reacts) {
    const double volume = volumeOf(thermo_, gas_);
    const std::vector<double> before = gas_.temperature;
    react(size);
    hotter_ = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
      hotter_ = std::max(hotter_, std::abs(gas_.temperature[i] - before[i]));
    happened = volumeOf(thermo_, gas_) - volume;
    ledger_.work += gas_.pressure * happened;
    growthRate_ = happened / size;
    defect_ = std::abs(happened - foreseen) / volume;
  }
  compressTo(options_.volume(end) - growth);
  others(middle, 0.5 * size, false, random);
  compressTo(options_.volume(end));
}

void EngineCylinder::react(double size) {
  std::vector<char> isDone(gas_.count(), 0);
  if (carried_ != nullptr) {
    const EngineCarried::Work done = carried_->react(size, gas_, isDone);
    ledger_.carriedEnthalpy += done.given;
    ledger_.chemical += done.heat;
    ledger_.chemistrySteps += done.steps;
  }
  const EngineReactions::Work done = reactions_.advance(size, gas_, isDone);
  ledger_.chemical += done.heat;
  ledger_.chemistrySteps += done.steps;
}

// Injection, mixing, loss of heat, the second time in reverse: by how much the volume grows.
double EngineCylinder::others(double from, double size, bool isFirst, RandomStream& random) {
  const double before = volumeOf(thermo_, gas_), middle = from + 0.5 * size;
  const auto inject = [&] {
    if (!injection_) return;
    const EngineInjection::Work work = injection_->inject(options_.injectionRate.integral(from, from + size), gas_);
    ledger_.injectedMass += work.mass;
    ledger_.injectedEnthalpy += work.enthalpy;
  };
  const auto mix = [&] {
    if (options_.mixing != EngineMixingModel::none) mixing_.advance(size, options_.mixingTime.at(middle), random, gas_);
  };
  if (isFirst) {
    inject();
    mix();
  }
  ledger_.heat += loss_.advance(size, conductance(middle, size), options_.wallTemperature, random, gas_);
  if (!isFirst) {
    mix();
    inject();
  }
  const double growth = volumeOf(thermo_, gas_) - before;
  ledger_.work += gas_.pressure * growth;
  return growth;
}

double EngineCylinder::conductance(double time, double duration) const {
  if (options_.heat.model == EngineHeatLaw::Model::none) return 0;
  const double volume = options_.volume(time);
  double mass = 0, capacity = 0, temperature = 0;
  for (std::size_t i = 0; i < gas_.count(); ++i) {
    mass += gas_.mass[i];
    temperature += gas_.mass[i] * gas_.temperature[i];
    capacity += gas_.mass[i] * thermo_.cpMass(gas_.temperature[i], gas_.Y(i));
  }
  EngineHeatState state;
  state.pressure = gas_.pressure;
  state.temperature = temperature / mass;
  state.volume = volume;
  state.density = mass / volume;
  state.capacity = capacity / mass;
  state.bore = options_.bore;
  state.pistonSpeed = options_.pistonSpeed;
  state.displacement = options_.displacement;
  state.referencePressure = startPressure_;
  state.referenceTemperature = startTemperature_;
  state.referenceVolume = startVolume_;
  state.motoredPressure = startPressure_ * std::pow(startVolume_ / volume, options_.motoredExponent);
  const double area = options_.endArea + 4 * (volume - options_.clearance) / options_.bore;
  const double atStart = heatCoefficient(options_.heat, state) * area;
  if (!(duration > 0)) return atStart;
  const double wall = options_.wallTemperature;
  state.temperature = wall + (state.temperature - wall) * std::exp(-0.5 * atStart * duration / capacity);
  return heatCoefficient(options_.heat, state) * area;
}

double EngineCylinder::energyError() const {
  const EngineTotals all = totalsOf(thermo_, gas_);
  const double lacks =
      all.energy - startEnergy_ + ledger_.work + ledger_.heat + ledger_.carriedEnthalpy - ledger_.injectedEnthalpy;
  return std::abs(lacks) / (all.capacity * all.temperature);
}

std::vector<double> EngineCylinder::allElements() const {
  std::vector<double> moles = elementsOf(mechanism_, gas_);
  if (carried_ == nullptr) return moles;
  const auto& unit = carried_->unitElements();
  for (std::size_t i = 0; i < gas_.count(); ++i)
    for (std::size_t s = 0; s < gas_.scalars; ++s)
      for (std::size_t e = 0; e < moles.size(); ++e)
        if (unit[s][e] != 0) moles[e] += gas_.mass[i] * gas_.amounts(i)[s] * unit[s][e] / mechanism_.atomicWeight(e);
  return moles;
}

double EngineCylinder::elementError() const {
  const std::vector<double> now = allElements();
  std::vector<double> brought(now.size(), 0);
  if (injection_)
    for (std::size_t k = 0; k < gas_.species; ++k)
      for (std::size_t e = 0; e < now.size(); ++e)
        brought[e] += ledger_.injectedMass * options_.injection->massFractions[k] /
                      mechanism_.species(k).molecularWeight * mechanism_.atoms(k, e);
  // Of an element that is not there integrators may leave traces.
  const double there = 1e-12 * std::accumulate(now.begin(), now.end(), 0.0);
  double most = 0;
  for (std::size_t e = 0; e < now.size(); ++e)
    if (const double size = std::max(now[e], startElements_[e] + brought[e]); size > there)
      most = std::max(most, std::abs(now[e] - startElements_[e] - brought[e]) / size);
  return most;
}

}  // namespace lampblack::chemistry
