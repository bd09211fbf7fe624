#include "app/problems/engine/engine_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/deck/soot_deck.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::app {
namespace {

constexpr std::size_t heatReleaseColumn = 12;  // of engineQuantities(); the net one stands behind it

double deviation(const std::vector<double>& values, const std::vector<double>& mass, double mean, double all) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += mass[i] / all * (values[i] - mean) * (values[i] - mean);
  return std::sqrt(sum);
}

// The value below which this part of the mass is.
double quantile(const std::vector<double>& values, const std::vector<double>& mass, double part, double all) {
  std::vector<std::size_t> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(values[i], i); });
  double below = 0;
  for (const std::size_t i : order)
    if ((below += mass[i]) >= part * all * (1 - 1e-12)) return values[i];
  return values[order.back()];
}

// Amounts of all of the gas.
std::vector<double> carriedBy(const EngineGas& gas) {
  std::vector<double> amounts(gas.scalars, 0);
  for (std::size_t i = 0; i < gas.count(); ++i)
    for (std::size_t s = 0; s < gas.scalars; ++s) amounts[s] += gas.mass[i] * gas.amounts(i)[s];
  return amounts;
}

double massOf(const CarriedParticles& soot, std::span<const double> amounts) {
  double mass = 0;
  for (std::size_t s = 0; s < amounts.size(); ++s)
    for (const double element : soot.scalars()[s].elements) mass += amounts[s] * element;
  return mass;
}

}  // namespace

std::vector<Quantity> engineQuantities(const EngineCase& made) {
  std::vector<Quantity> all{
      {"pressure", "Pa", "pressure"},
      {"volume", "m^3", "volume of the cylinder"},
      {"mass", "kg", "mass of the gas"},
      {"particles", "1", "particles of gas"},
      {"temperature", "K", "mean temperature by mass"},
      {"temperature_deviation", "K", "standard deviation of the temperatures by mass"},
      {"temperature_10", "K", "temperature below which 10 % of the mass are"},
      {"temperature_50", "K", "temperature below which half of the mass is"},
      {"temperature_90", "K", "temperature below which 90 % of the mass are"},
      {"equivalence_ratio", "1", "mean of (2 C + H/2)/O of the elements by mass"},
      {"equivalence_ratio_deviation", "1", "its standard deviation by mass"},
      {"gamma", "1", "ratio of the heat capacities"},
      {"heat_release", "J/deg", "heat set free by the reactions"},
      {"net_heat_release", "J/deg", "heat release from pressure and volume, less that to the walls"},
      {"chemical_heat", "J", "heat set free since the start"},
      {"wall_heat", "J", "heat to the walls since the start"},
      {"work", "J", "work on the piston since the start"}};
  for (const std::size_t k : made.species)
    all.push_back({"X_" + made.mechanism->speciesName(k), "1", "mole fraction in all of the gas"});
  if (!made.soot) return all;
  const std::string material = made.soot->material() + "_";
  all.push_back({material + "mass", "kg", "of all particles of gas"});
  all.push_back({material + "mass_deviation", "1", "standard deviation of its part of the gas, over the mean"});
  for (const auto& p : particlePropertyNames)
    all.push_back({material + p.name, p.unit, std::string(p.description) + ", of the whole cylinder"});
  return all;
}

std::vector<Quantity> engineSummaryQuantities(const EngineCase& made) {
  std::vector<Quantity> all{
      {"cycle", "1", "number of the cycle"},
      {"start_temperature", "K", "mean temperature as the inlet closes"},
      {"ca10", "deg", "angle at which 10 % of the heat are free"},
      {"ca50", "deg", "angle at which half of the heat is free"},
      {"ca90", "deg", "angle at which 90 % of the heat are free"},
      {"burn_duration", "deg", "from ca10 to ca90"},
      {"work", "J", "work while the valves are closed"},
      {"imep", "Pa", "that work over the displaced volume"},
      {"chemical_heat", "J", "heat set free"},
      {"wall_heat", "J", "heat to the walls"},
      {"largest_pressure", "Pa", "highest pressure of all steps"},
      {"largest_pressure_at", "deg", "its angle"},
      {"largest_temperature", "K", "highest mean temperature"},
      {"pressure_rise", "Pa/deg", "steepest rise of the pressure over step.angle"},
      {"ringing", "W/m^2", "ringing intensity"},
      {"steps", "1", "steps of the splitting"},
      {"rejected_steps", "1", "steps that were halved"},
      {"steps_too_large", "1", "steps that were as large as the section step forbids, halved as often as it says"},
      {"step_error", "1", "part of the volume by which reactions grew otherwise than foreseen, largest"},
      {"energy_error", "1", "what the balance of energy lacks over the heat in the gas"},
      {"element_error", "1", "what the balance of an element lacks over its amount"}};
  for (const std::size_t k : made.species) {
    const std::string& name = made.mechanism->speciesName(k);
    all.push_back({"ppm_" + name, "1e-6", "mole fraction as the exhaust opens"});
    all.push_back({"specific_" + name, "g/kWh", "mass as the exhaust opens over the work"});
  }
  if (!made.soot) return all;
  const std::string material = made.soot->material();
  all.push_back({"largest_" + material + "_volume_fraction", "1", "of the whole cylinder"});
  all.push_back({material + "_mass", "kg", "as the exhaust opens"});
  all.push_back({"specific_" + material, "g/kWh", "mass as the exhaust opens over the work"});
  return all;
}

std::vector<Quantity> engineParticleQuantities(const EngineCase& made) {
  std::vector<Quantity> all{{"mass", "kg", "mass"},
                            {"temperature", "K", "temperature"},
                            {"equivalence_ratio", "1", "(2 C + H/2)/O of its elements"}};
  for (const std::size_t k : made.species) all.push_back({"X_" + made.mechanism->speciesName(k), "1", "mole fraction"});
  if (made.soot) all.push_back({made.soot->material() + "_volume_fraction", "1", "volume of it per volume of gas"});
  return all;
}

EngineRows::EngineRows(const EngineCase& made, const Thermo& thermo) : made_(made), thermo_(thermo) {
  if (made.soot) seen_.emplace(*made.mechanism, made.soot->exchanged());
}

void EngineRows::clear() {
  trace_ = {};
  rows_.clear();
  mostSoot_ = mostAtLimit_ = 0;
}

void EngineRows::add(const EngineCylinder& cylinder, double angle) {
  const EngineGas& gas = cylinder.gas();
  const EngineTotals all = totalsOf(thermo_, gas);
  const EngineLedger& ledger = cylinder.ledger();
  std::vector<double> ratios;
  for (std::size_t i = 0; i < gas.count(); ++i) ratios.push_back(equivalenceRatioOf(*made_.mechanism, gas.Y(i)));
  double meanRatio = 0;
  for (std::size_t i = 0; i < gas.count(); ++i) meanRatio += gas.mass[i] / all.mass * ratios[i];
  const double R = gas.pressure * all.volume / (all.mass * all.temperature);
  const double gamma = all.capacity / (all.capacity - all.mass * R);
  trace_.angle.push_back(angle);
  trace_.time.push_back(made_.timeOf(angle));
  trace_.volume.push_back(all.volume);
  trace_.pressure.push_back(gas.pressure);
  trace_.temperature.push_back(all.temperature);
  trace_.gamma.push_back(gamma);
  trace_.chemical.push_back(ledger.chemical);
  const auto& T = gas.temperature;
  const auto& m = gas.mass;
  std::vector<double> row{gas.pressure,
                          all.volume,
                          all.mass,
                          static_cast<double>(gas.count()),
                          all.temperature,
                          deviation(T, m, all.temperature, all.mass),
                          quantile(T, m, 0.1, all.mass),
                          quantile(T, m, 0.5, all.mass),
                          quantile(T, m, 0.9, all.mass),
                          meanRatio,
                          deviation(ratios, m, meanRatio, all.mass),
                          gamma,
                          0,
                          0,
                          ledger.chemical,
                          ledger.heat,
                          ledger.work};
  std::vector<double> X(gas.species);
  thermo_.massToMole(all.massFractions, X);
  for (const std::size_t k : made_.species) row.push_back(X[k]);
  if (made_.soot) addSoot(gas, all, row);
  rows_.insert(rows_.end(), row.begin(), row.end());
  lastMoles_ = X;
  lastMasses_ = all.massFractions;
  mass_ = all.mass;
}

void EngineRows::addSoot(const EngineGas& gas, const EngineTotals& all, std::vector<double>& row) {
  const CarriedParticles& soot = *made_.soot;
  std::vector<double> amounts = carriedBy(gas), parts;
  sootMass_ = massOf(soot, amounts);
  for (std::size_t i = 0; i < gas.count(); ++i) parts.push_back(massOf(soot, gas.amounts(i)));
  const double mean = sootMass_ / all.mass;
  row.push_back(sootMass_);
  row.push_back(mean > 0 ? deviation(parts, gas.mass, mean, all.mass) / mean : 0);
  for (double& amount : amounts) amount /= all.volume;
  const ParticleProperties has = soot.model().propertiesForResults(
      seen_->atComposition(all.temperature, gas.pressure, all.massFractions), amounts);
  for (const auto& p : particlePropertyNames) row.push_back(has.*p.value);
  mostSoot_ = std::max(mostSoot_, has.volumeFraction);
  mostAtLimit_ = std::max(mostAtLimit_, soot.volumeFractionAtLimit(amounts));
}

void EngineRows::requireSizeRangeCovered() const {
  if (mostAtLimit_ > made_.sootAtLimit * mostSoot_)
    throw NumericsError(
        fmt::format("a fraction {:.2g} of the largest volume fraction is in the largest particles of the model; the "
                    "limit is {:.2g}. {}",
                    mostAtLimit_ / mostSoot_, made_.sootAtLimit, tooFewSections));
}

std::vector<double> EngineRows::rows() const {
  const std::vector<double> net = netHeatRelease(trace_);
  std::vector<double> all = rows_;
  const std::size_t count = trace_.angle.size(), width = engineQuantities(made_).size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t a = k == 0 ? 0 : k - 1, b = k + 1 == count ? k : k + 1;
    double* row = &all[k * width];
    row[heatReleaseColumn] =
        b > a ? (trace_.chemical[b] - trace_.chemical[a]) / (trace_.angle[b] - trace_.angle[a]) : 0;
    row[heatReleaseColumn + 1] = net[k];
  }
  return all;
}

std::vector<double> EngineRows::summary(const EngineCylinder& cylinder, std::size_t cycle) const {
  const EngineLedger& ledger = cylinder.ledger();
  const EnginePeaks& peaks = cylinder.peaks();
  const double ca10 = burntAngle(trace_, 0.1), ca90 = burntAngle(trace_, 0.9);
  std::vector<double> all{static_cast<double>(cycle + 1),
                          trace_.temperature.front(),
                          ca10,
                          burntAngle(trace_, 0.5),
                          ca90,
                          ca90 - ca10,
                          ledger.work,
                          ledger.work / made_.crank.displacement(),
                          ledger.chemical,
                          ledger.heat,
                          peaks.pressure(),
                          made_.start + 360 * made_.speed * peaks.time(),
                          *std::ranges::max_element(trace_.temperature),
                          peaks.rise() / (360 * made_.speed),
                          peaks.ringing(),
                          static_cast<double>(ledger.steps),
                          static_cast<double>(ledger.rejected),
                          static_cast<double>(ledger.tooLarge),
                          ledger.largestDefect,
                          cylinder.energyError(),
                          cylinder.elementError()};
  constexpr double perKilowattHour = 3.6e6 * 1e3;  // g/kWh from kg/J
  for (const std::size_t k : made_.species) {
    all.push_back(1e6 * lastMoles_[k]);
    all.push_back(ledger.work > 0 ? lastMasses_[k] * mass_ / ledger.work * perKilowattHour : std::nan(""));
  }
  if (made_.soot) {
    all.push_back(mostSoot_);
    all.push_back(sootMass_);
    all.push_back(ledger.work > 0 ? sootMass_ / ledger.work * perKilowattHour : std::nan(""));
  }
  return all;
}

void EngineRows::saveOrLoad(StateArchive& archive) {
  const std::pair<const char*, std::vector<double>*> parts[] = {{"trace_angle", &trace_.angle},
                                                                {"trace_time", &trace_.time},
                                                                {"trace_volume", &trace_.volume},
                                                                {"trace_pressure", &trace_.pressure},
                                                                {"trace_temperature", &trace_.temperature},
                                                                {"trace_gamma", &trace_.gamma},
                                                                {"trace_chemical_heat", &trace_.chemical},
                                                                {"rows", &rows_},
                                                                {"last_mole_fractions", &lastMoles_},
                                                                {"last_mass_fractions", &lastMasses_}};
  for (const auto& [name, values] : parts) archive.shared(name, *values);
  archive.shared("last_mass", mass_);
  archive.shared("soot_mass", sootMass_);
  archive.shared("largest_soot", mostSoot_);
  archive.shared("largest_soot_at_limit", mostAtLimit_);
}

void addEngineParticles(const EngineCase& made, const Thermo& thermo, const EngineGas& gas, double angle,
                        std::vector<double>& rows) {
  std::vector<double> X(gas.species);
  for (std::size_t i = 0; i < gas.count(); ++i) {
    thermo.massToMole(gas.Y(i), X);
    rows.insert(rows.end(), {angle, static_cast<double>(i), gas.mass[i], gas.temperature[i],
                             equivalenceRatioOf(*made.mechanism, gas.Y(i))});
    for (const std::size_t k : made.species) rows.push_back(X[k]);
    if (!made.soot) continue;
    std::vector<double> densities(gas.amounts(i).begin(), gas.amounts(i).end());
    for (double& amount : densities) amount *= thermo.density(gas.temperature[i], gas.pressure, gas.Y(i));
    rows.push_back(made.soot->volumeFraction(densities));
  }
}

}  // namespace lampblack::app
