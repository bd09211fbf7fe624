#include "app/problems/engine/engine_repeat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/reactor/engine/engine_indicators.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::app {
namespace {

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

class CycleRows {
 public:
  CycleRows(const EngineCase& made, const Thermo& thermo) : made_(made), thermo_(thermo) {}

  void add(const EngineCylinder& cylinder, double angle) {
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
    trace_.gasConstant.push_back(R);
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
    rows_.push_back(std::move(row));
    last_ = X;
    lastY_ = all.massFractions;
    mass_ = all.mass;
  }

  [[nodiscard]] std::vector<double> rows() {
    const std::vector<double> net = netHeatRelease(trace_);
    std::vector<double> all;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const std::size_t a = k == 0 ? 0 : k - 1, b = k + 1 == rows_.size() ? k : k + 1;
      rows_[k][12] = b > a ? (trace_.chemical[b] - trace_.chemical[a]) / (trace_.angle[b] - trace_.angle[a]) : 0;
      rows_[k][13] = net[k];
      all.insert(all.end(), rows_[k].begin(), rows_[k].end());
    }
    return all;
  }

  [[nodiscard]] std::vector<double> summary(const EngineCylinder& cylinder, std::size_t cycle) const {
    const EngineLedger& ledger = cylinder.ledger();
    const auto top = static_cast<std::size_t>(std::ranges::max_element(trace_.pressure) - trace_.pressure.begin());
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
                            trace_.pressure[top],
                            trace_.angle[top],
                            *std::ranges::max_element(trace_.temperature),
                            steepestRise(trace_).perAngle,
                            ringingIntensity(trace_),
                            static_cast<double>(ledger.steps),
                            static_cast<double>(ledger.rejected),
                            static_cast<double>(ledger.tooLarge),
                            ledger.largestDefect,
                            cylinder.energyError(),
                            cylinder.elementError()};
    constexpr double perKilowattHour = 3.6e6 * 1e3;  // g/kWh from kg/J
    for (const std::size_t k : made_.species) {
      all.push_back(1e6 * last_[k]);
      all.push_back(ledger.work > 0 ? lastY_[k] * mass_ / ledger.work * perKilowattHour : std::nan(""));
    }
    return all;
  }

  [[nodiscard]] double halfBurnt() const { return burntAngle(trace_, 0.5); }
  [[nodiscard]] double startTemperature() const { return trace_.temperature.front(); }
  [[nodiscard]] const std::vector<double>& massFractions() const { return lastY_; }

 private:
  const EngineCase& made_;
  const Thermo& thermo_;
  EngineTrace trace_;
  std::vector<std::vector<double>> rows_;
  std::vector<double> last_, lastY_;
  double mass_ = 0;
};

void addParticles(const EngineCase& made, const Thermo& thermo, const EngineGas& gas, double angle,
                  std::vector<double>& rows) {
  std::vector<double> X(gas.species);
  for (std::size_t i = 0; i < gas.count(); ++i) {
    thermo.massToMole(gas.Y(i), X);
    rows.insert(rows.end(), {angle, static_cast<double>(i), gas.mass[i], gas.temperature[i],
                             equivalenceRatioOf(*made.mechanism, gas.Y(i))});
    for (const std::size_t k : made.species) rows.push_back(X[k]);
  }
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
      {"largest_pressure", "Pa", "highest pressure"},
      {"largest_pressure_at", "deg", "its angle"},
      {"largest_temperature", "K", "highest mean temperature"},
      {"pressure_rise", "Pa/deg", "steepest rise of the pressure"},
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
  return all;
}

std::vector<Quantity> engineParticleQuantities(const EngineCase& made) {
  std::vector<Quantity> all{{"mass", "kg", "mass"},
                            {"temperature", "K", "temperature"},
                            {"equivalence_ratio", "1", "(2 C + H/2)/O of its elements"}};
  for (const std::size_t k : made.species) all.push_back({"X_" + made.mechanism->speciesName(k), "1", "mole fraction"});
  return all;
}

EngineRepeat runEngine(MPI_Comm comm, const EngineCase& made, std::uint64_t repeat,
                       const std::function<void(std::size_t cycle, double angle)>& onRow) {
  const Thermo thermo(*made.mechanism);
  EngineOptions options = made.options;
  options.repeat = repeat;
  EngineCylinder cylinder(comm, *made.mechanism, thermo, options);
  // Rows, and angles at which particles are written.
  std::vector<double> rows = made.angles(), stops = rows;
  stops.insert(stops.end(), made.particlesAt.begin(), made.particlesAt.end());
  std::ranges::sort(stops);
  stops.erase(std::ranges::unique(stops, [](double a, double b) { return std::abs(a - b) < 1e-9; }).begin(),
              stops.end());
  EngineRepeat done;
  EngineResidual left;
  double halfBefore = std::nan(""), temperatureBefore = std::nan("");
  for (std::size_t cycle = 0; cycle < made.mostCycles; ++cycle) {
    CycleRows said(made, thermo);
    done.particles.clear();
    cylinder.start(engineCharge(made, repeat, left), 0);
    for (const double angle : stops) {
      try {
        cylinder.advanceTo(made.timeOf(angle));
      } catch (const NumericsError& error) {
        throw NumericsError(fmt::format("cycle {}, before {:.4g} deg: {}", cycle + 1, angle, error.what()));
      }
      const auto isAmong = [angle](const std::vector<double>& some) {
        return std::ranges::any_of(some, [angle](double a) { return std::abs(a - angle) < 1e-9; });
      };
      if (isAmong(rows)) {
        said.add(cylinder, angle);
        onRow(cycle, angle);
      }
      if (isAmong(made.particlesAt)) addParticles(made, thermo, cylinder.gas(), angle, done.particles);
    }
    done.summary = said.summary(cylinder, cycle);
    done.cycles.insert(done.cycles.end(), done.summary.begin(), done.summary.end());
    done.rows = said.rows();
    if (!(made.residual > 0)) break;
    const EngineTotals all = totalsOf(thermo, cylinder.gas());
    left = {thermo.temperatureFromEnthalpy(all.enthalpy / all.mass, all.massFractions, all.temperature),
            cylinder.gas().pressure, all.massFractions};
    const bool isSame = std::abs(said.startTemperature() - temperatureBefore) < made.temperatureTolerance &&
                        (std::abs(said.halfBurnt() - halfBefore) < made.angleTolerance ||
                         (std::isnan(halfBefore) && std::isnan(said.halfBurnt())));
    if (isSame && cycle > 0) break;
    done.isConverged = cycle + 1 < made.mostCycles;
    halfBefore = said.halfBurnt();
    temperatureBefore = said.startTemperature();
  }
  return done;
}

}  // namespace lampblack::app
