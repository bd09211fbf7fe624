// Budgets: what the streams bring, what leaves at the ends and sideways, what is conducted and radiated.
#include "core/errors.hpp"
#include "flow/flame/flame_equations_data.hpp"

namespace lampblack::flow {
namespace {

// The content of a kilogram of gas with given mass fractions, and of a unit of each scalar.
using Content = std::vector<double>;

FlameBudget budgetOf(const FlameEquations::Data& d, const std::string& name, const Content& species,
                     const Content& scalar) {
  const std::size_t n = d.species(), S = d.scalars(), last = d.points() - 1;
  const auto content = [&](std::span<const double> Y) {
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += species[k] * Y[k];
    return sum;
  };
  FlameBudget budget;
  budget.name = name;
  budget.in = d.profile.global(leftMassFlux) * content(d.problem.left.Y);
  const double mEnd = d.profile.at(last, FlameLayout::massFlux);
  if (d.rightEnd == FlameEnd::Stream) budget.in -= mEnd * content(d.problem.right->Y);
  if (d.rightEnd != FlameEnd::Stream) budget.out += mEnd * content(d.profile.massFractions(last));
  for (std::size_t i = 0; i <= last; ++i) {
    const double sideways = 2 * d.gas.nodes.density[i] * d.profile.at(i, FlameLayout::spread) * d.volume[i];
    double inside = content(d.profile.massFractions(i));
    for (std::size_t s = 0; s < S; ++s) inside += scalar[s] * d.profile.scalars(i)[s] * d.gas.scalarScale[s];
    budget.out += sideways * inside;
    if (d.exchange) {
      const GivenExchange::Sample given = d.exchange->at(d.profile.z[i]);
      for (std::size_t k = 0; k < n; ++k) budget.given += species[k] * given.species(k) * d.volume[i];
    }
  }
  for (std::size_t s = 0; s < S; ++s) {
    budget.wall -= scalar[s] * d.scalarFluxLeft(0, s);
    const double right = scalar[s] * d.scalarFluxRight(last, s);
    (d.rightEnd == FlameEnd::Outlet ? budget.out : budget.wall) += right;
  }
  return budget;
}

// Energy: every point has its own enthalpies.
FlameBudget energyBudget(const FlameEquations::Data& d) {
  const std::size_t n = d.species(), S = d.scalars(), last = d.points() - 1;
  const auto content = [&](std::size_t i, std::span<const double> Y) {
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += d.gas.nodes.enthalpy[i * n + k] * Y[k];
    return sum;
  };
  const auto carriedAt = [&](std::size_t i, std::size_t s) { return d.gas.nodes.scalarEnthalpy[i * S + s]; };
  FlameBudget budget;
  budget.name = "energy";
  budget.in = d.profile.global(leftMassFlux) * content(0, d.problem.left.Y);
  const double mEnd = d.profile.at(last, FlameLayout::massFlux);
  if (d.rightEnd == FlameEnd::Stream) budget.in -= mEnd * content(last, d.problem.right->Y);
  if (d.rightEnd != FlameEnd::Stream) budget.out += mEnd * content(last, d.profile.massFractions(last));
  for (std::size_t i = 0; i <= last; ++i) {
    const double sideways = 2 * d.gas.nodes.density[i] * d.profile.at(i, FlameLayout::spread) * d.volume[i];
    double inside = content(i, d.profile.massFractions(i));
    for (std::size_t s = 0; s < S; ++s) inside += carriedAt(i, s) * d.profile.scalars(i)[s] * d.gas.scalarScale[s];
    budget.out += sideways * inside;
    // What an exchange gives is part of the loss; what species bring or take with them stays in the gas.
    const double given = d.exchange ? d.exchange->at(d.profile.z[i]).enthalpy() : 0;
    budget.given += given * d.volume[i];
    budget.radiated += (d.gas.nodes.loss[i] + given) * d.volume[i];
    // Where the temperature is given, heat is taken away (or brought) to keep it.
    if (d.temperatureIsGiven(i)) budget.wall -= d.energyResidual(i);
  }
  for (std::size_t s = 0; s < S; ++s) {
    budget.wall -= carriedAt(0, s) * d.scalarFluxLeft(0, s);
    const double right = carriedAt(last, s) * d.scalarFluxRight(last, s);
    (d.rightEnd == FlameEnd::Outlet ? budget.out : budget.wall) += right;
  }
  return budget;
}

}  // namespace

std::vector<FlameBudget> FlameEquations::budgets(std::span<const double> x) {
  Data& d = *data_;
  d.setUnknowns(x);
  std::vector<FlameBudget> result;
  // Every rank evaluates all points: once a flame, and the sums are alike.
  collectively(d.comm, [&] {
    d.chooseBlend();
    d.evaluate(0, d.points());
  });
  const std::size_t n = d.species(), S = d.scalars();
  Content species(n, 1.0), scalar(S, 0.0);
  for (std::size_t s = 0; s < S; ++s)
    for (double mass : d.gas.scalarElements[s]) scalar[s] += mass;
  result.push_back(budgetOf(d, "mass", species, scalar));
  for (std::size_t e = 0; e < d.mechanism->numElements(); ++e) {
    for (std::size_t k = 0; k < n; ++k)
      species[k] = d.mechanism->atoms(k, e) * d.mechanism->atomicWeight(e) / d.gas.weights[k];
    for (std::size_t s = 0; s < S; ++s) scalar[s] = d.gas.scalarElements[s][e];
    result.push_back(budgetOf(d, d.mechanism->elementName(e), species, scalar));
  }
  result.push_back(energyBudget(d));
  return result;
}

WallDeposition FlameEquations::wallDeposition(std::span<const double> x) {
  Data& d = *data_;
  const std::size_t S = d.scalars(), last = d.points() - 1;
  d.setUnknowns(x);
  collectively(d.comm, [&] {
    d.chooseBlend();
    d.evaluate(last - 1, d.points());
  });
  WallDeposition taken;
  for (std::size_t s = 0; s < S; ++s) {
    double mass = 0;
    for (const double part : d.gas.scalarElements[s]) mass += part;
    taken.rate += mass * d.scalarFluxRight(last, s);
    taken.thermophoresis = std::max(
        taken.thermophoresis, d.gas.scalarThermophoresis[s] * d.gas.faces.drift[last - 1] / d.gas.nodes.density[last]);
  }
  return taken;
}

double FlameEquations::burnerHeatFlux(std::span<const double> x) {
  Data& d = *data_;
  d.setUnknowns(x);
  collectively(d.comm, [&] {
    d.chooseBlend();
    d.evaluate(0, 1);
  });
  return -d.energyResidual(0);
}

}  // namespace lampblack::flow
