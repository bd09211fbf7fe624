// Integration of the two-equation model in one cell: an exponential midpoint rule in the extents of the events. Gas
// reactants and soot decay exponentially at their loss rate, number follows the exact solution of its Riccati equation,
// and what one side loses the other gains, so that positivity and conservation hold for any step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/errors.hpp"
#include "particles/models/two_equation/two_equation.hpp"
#include "particles/models/two_equation/two_equation_state.hpp"

namespace lampblack::particles {
namespace {

// (1 - exp(-x)) / x for x >= 0.
double meanDecay(double x) {
  return x < 1e-6 ? 1 - 0.5 * x : -std::expm1(-x) / x;
}

// N(dt) of dN/dt = source - coagulation N^2, exactly.
double riccati(double number, double source, double coagulation, double dt) {
  const double q = std::sqrt(source * coagulation);
  const double qt = q * dt;
  const double t = qt < 1e-4 ? dt * (1 - qt * qt / 3) : std::tanh(qt) / q;
  return (number + source * t) / (1 + coagulation * number * t);
}

}  // namespace

TwoEquationSoot::Extents TwoEquationSoot::extents(const Frozen& frozen, const Rates& r, const State& start,
                                                  double dt) const {
  Extents x;
  using S = SootSpecies;
  const std::size_t n = dimers_.size();
  const std::span<const double> pah = start.pah(n);
  PahArray consumption{};
  for (std::size_t i = 0; i < n; ++i) {
    x.pah[i] = -pah[i] * std::expm1(-r.pahLoss[i] * dt);
    consumption[i] = x.pah[i] / dt;
  }
  const DimerProduction dimer = dimers_.production(frozen.temperature, {consumption.data(), n});
  double nucleationRate = 0;
  if (dimer.rate > 0) {
    const double self = options_.inception ? dimer.selfCollision : 0;
    const double withParticles =
        options_.condensation && r.diameter > 0
            ? r.number * DimerModel::particleCollision(dimer, frozen.freeMolecular, r.particleMass, r.diameter)
            : 0;
    if (self + withParticles > 0) {
      x.dimerNumber = steadyDimers(dimer.rate, self, withParticles);
      x.condensedShare = withParticles * x.dimerNumber / dimer.rate;
      nucleationRate = 0.5 * self * x.dimerNumber * x.dimerNumber;
      x.nucleated = nucleationRate * dt;
      for (std::size_t i = 0; i < n; ++i) {
        x.pahCarbon += dimers_.carbonAtoms(i) * x.pah[i];
        x.pahHydrogen += dimers_.hydrogenAtoms(i) * x.pah[i];
      }
    } else {
      x.pah.fill(0);
    }
  }
  x.finalNumber = riccati(start.number, nucleationRate, r.coagulation, dt);
  x.growth = -start.gas[S::C2H2] * std::expm1(-r.growth * dt);

  // Oxidation: reactants deplete at their own rate, and soot at the rate that this leaves.
  const double byO2 = r.oxidationO2 * start.gas[S::O2] * meanDecay(r.oxidationO2 * dt);
  const double byOH = r.oxidationOH * start.gas[S::OH] * meanDecay(r.oxidationOH * dt);
  const double loss = 2 * byO2 + byOH;  // mol C/m3/s
  if (loss > 0 && r.carbon > 0) {
    const double decay = loss * dt / r.carbon;
    const double kept = std::exp(-decay), keptOfGain = meanDecay(decay);
    double carbonLost = -start.carbon * std::expm1(-decay) + (x.pahCarbon + 2 * x.growth) * (1 - keptOfGain);
    const double hydrogenLost = start.hydrogen * (1 - kept) + x.pahHydrogen * (1 - keptOfGain);
    const double unlimited = carbonLost;
    const double shareO2 = 2 * byO2 / loss;
    if (0.5 * shareO2 * carbonLost > start.gas[S::O2]) carbonLost = 2 * start.gas[S::O2] / shareO2;
    if ((1 - shareO2) * carbonLost > start.gas[S::OH]) carbonLost = start.gas[S::OH] / (1 - shareO2);
    x.limited = carbonLost < unlimited;
    x.O2 = 0.5 * shareO2 * carbonLost;
    x.OH = (1 - shareO2) * carbonLost;
    x.hydrogenLost = unlimited > 0 ? hydrogenLost * (carbonLost / unlimited) : 0;
  }
  return x;
}

TwoEquationSoot::State TwoEquationSoot::apply(const State& start, const Extents& x) const {
  // Round-off can leave a species that is used up at minus one unit in the last place of what it was.
  const auto rest = [](double value) { return std::max(value, 0.0); };
  using S = SootSpecies;
  State end = start;
  for (std::size_t i = 0; i < dimers_.size(); ++i) end.gas[S::fixed + i] = rest(start.gas[S::fixed + i] - x.pah[i]);
  end.carbon = rest(start.carbon + x.pahCarbon + 2 * x.growth - (2 * x.O2 + x.OH));
  end.hydrogen = rest(start.hydrogen + x.pahHydrogen - x.hydrogenLost);
  end.gas[S::C2H2] = rest(start.gas[S::C2H2] - x.growth);
  end.gas[S::O2] = rest(start.gas[S::O2] - x.O2);
  end.gas[S::OH] = rest(start.gas[S::OH] - x.OH);
  end.gas[S::CO] += 2 * x.O2 + x.OH;
  end.gas[S::H] += x.OH;
  end.gas[S::H2] += x.growth + 0.5 * x.hydrogenLost;
  end.number = std::min(x.finalNumber, end.carbon / nucleusCarbon_);
  return end;
}

double TwoEquationSoot::error(const State& start, const State& low, const State& high) const {
  using S = SootSpecies;
  const auto relative = [](double from, double a, double b, double floor) {
    return std::abs(a - b) / (std::max({from, a, b}) + floor);
  };
  // Floors: what is of no account in a flame (number 1/m3, moles/m3).
  double e = relative(start.number, low.number, high.number, 1e8);
  e = std::max(e, relative(start.carbon, low.carbon, high.carbon, 1e-11));
  e = std::max(e, relative(start.gas[S::C2H2], low.gas[S::C2H2], high.gas[S::C2H2], 1e-9));
  e = std::max(e, relative(start.gas[S::O2], low.gas[S::O2], high.gas[S::O2], 1e-9));
  e = std::max(e, relative(start.gas[S::OH], low.gas[S::OH], high.gas[S::OH], 1e-9));
  for (std::size_t i = 0; i < dimers_.size(); ++i) {
    const std::size_t k = S::fixed + i;
    e = std::max(e, relative(start.gas[k], low.gas[k], high.gas[k], 1e-11));
  }
  return e / options_.relativeTolerance;
}

TwoEquationSoot::Report TwoEquationSoot::integrate(const Frozen& frozen, State& state, double dt) const {
  using S = SootSpecies;
  constexpr int maximumSubSteps = 100000;
  Report report;
  double done = 0, step = dt;
  Rates atStart = rates(frozen, state);
  while (done < dt) {
    if (report.subSteps + report.rejected >= maximumSubSteps) {
      throw NumericsError(fmt::format("soot: {} sub-steps reach only {} of {} s", maximumSubSteps, done, dt));
    }
    const bool last = done + step >= dt * (1 - 1e-12);
    if (last) step = dt - done;
    const State low = apply(state, extents(frozen, atStart, state, step));
    State middle = state;
    const auto half = [](double& to, double other) { to = 0.5 * (to + other); };
    half(middle.number, low.number);
    half(middle.carbon, low.carbon);
    half(middle.hydrogen, low.hydrogen);
    for (std::size_t k = 0; k < S::fixed + dimers_.size(); ++k) half(middle.gas[k], low.gas[k]);
    const Extents x = extents(frozen, rates(frozen, middle), state, step);
    const State high = apply(state, x);
    const double e = error(state, low, high);
    if (e > 1) {
      ++report.rejected;
      step *= std::max(0.1, 0.85 / std::sqrt(e));
      continue;
    }
    ++report.subSteps;
    const double wc = options_.carbonWeight, wh = options_.hydrogenWeight;
    const double fromPah = x.pahCarbon * wc + x.pahHydrogen * wh;
    report.condensed += x.condensedShare * fromPah;
    report.nucleated += (1 - x.condensedShare) * fromPah;
    report.grown += 2 * x.growth * wc;
    report.oxidised += (2 * x.O2 + x.OH) * wc + x.hydrogenLost * wh;
    report.numberNucleated += x.nucleated;
    report.numberCoagulated += std::max(0.0, state.number + x.nucleated - x.finalNumber);
    report.numberOxidised += std::max(0.0, x.finalNumber - high.number);
    report.limitedOxidation += x.limited ? 1 : 0;
    state = high;
    done += step;
    if (last) break;
    atStart = rates(frozen, state);
    step *= std::min(4.0, 0.85 / std::sqrt(std::max(e, 1e-4)));
  }
  return report;
}

TwoEquationSoot::Report TwoEquationSoot::advance(const CarrierGas& gas, double dt, Population& population,
                                                 std::span<double> concentrations) const {
  const std::size_t species = SootSpecies::fixed + dimers_.size();
  if (concentrations.size() != species) throw std::invalid_argument("soot: the gas has other species than the model");
  const auto positive = [](double v) { return std::max(v, 0.0); };
  double totalPah = 0;
  for (std::size_t k = SootSpecies::fixed; k < species; ++k) totalPah += positive(concentrations[k]);
  if (!(dt > 0) || (totalPah < negligiblePah && population.carbon < negligibleCarbon)) return {};

  const Frozen frozen = freeze(gas);
  State start;
  start.number = positive(population.number);
  start.carbon = positive(population.carbon) / options_.carbonWeight;
  start.hydrogen = positive(population.hydrogen) / options_.hydrogenWeight;
  for (std::size_t k = 0; k < species; ++k) start.gas[k] = positive(concentrations[k]);

  State end = start;
  const Report report = integrate(frozen, end, dt);

  // A non-negative entry takes its end value, which is not negative; a negative one keeps its deficit.
  const auto store = [](double& to, double from, double value) { to = to < 0 ? to + (value - from) : value; };
  store(population.number, start.number, end.number);
  store(population.carbon, start.carbon * options_.carbonWeight, end.carbon * options_.carbonWeight);
  store(population.hydrogen, start.hydrogen * options_.hydrogenWeight, end.hydrogen * options_.hydrogenWeight);
  for (std::size_t k = 0; k < species; ++k) store(concentrations[k], start.gas[k], end.gas[k]);
  return report;
}

}  // namespace lampblack::particles
