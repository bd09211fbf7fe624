#include "app/problems/reactor/reactor_ensemble_repeat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/problems/reactor/reactor_output.hpp"
#include "core/errors.hpp"

namespace lampblack::app {
namespace {

using Kept = SplitReactor::Gas::Kept;

// Elements (kg/kg) of all that flows into an open reactor and of its start; empty where they differ.
std::vector<double> elementsOfInflow(const ReactorCase& reactorCase, const ReactorBalance& balance) {
  const std::vector<double> none(reactorCase.ensemble->elements.size() + reactorCase.kind->reactors(), 0.0);
  constexpr double same = 1e-14;
  std::vector<double> first;
  const auto agrees = [&](const std::vector<double>& Y) {
    const std::vector<double> elements = balance.elements(Y, none);
    if (first.empty()) first = elements;
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (std::abs(elements[e] - first[e]) > same) return false;
    return true;
  };
  for (const InflowStream& stream : reactorCase.kind->network()->inflows)
    if (!agrees(stream.Y)) return {};
  if (const GasState* start = reactorCase.kind->givenStart(); start != nullptr && !agrees(start->Y)) return {};
  return first;
}

std::vector<std::unique_ptr<ReactorPopulation>> makePopulations(const ReactorCase& reactorCase, std::uint64_t repeat) {
  const std::size_t reactors = reactorCase.kind->reactors();
  std::vector<std::unique_ptr<ReactorPopulation>> all;
  const ReactorPopulations& of = *reactorCase.ensemble;
  for (std::size_t r = 0; r < reactors; ++r)
    all.push_back(std::make_unique<ReactorPopulation>(of.make(repeat * reactors + r), of.viscosity));
  return all;
}

std::vector<SplitParticles*> pointersTo(const std::vector<std::unique_ptr<ReactorPopulation>>& populations) {
  std::vector<SplitParticles*> all;
  for (const auto& population : populations) all.push_back(population.get());
  return all;
}

}  // namespace

bool hasElementBalance(const ReactorCase& reactorCase) {
  if (reactorCase.kind->isGiven()) return false;
  if (!(reactorCase.kind->network() != nullptr)) return true;
  ParticlesAtRest particles(reactorCase.kind->reactors(), reactorCase.ensemble->elements);
  const ReactorBalance balance(*reactorCase.mechanism, particles, particles.unitElements(*reactorCase.mechanism));
  return !elementsOfInflow(reactorCase, balance).empty();
}

EnsembleRepeat::EnsembleRepeat(const ReactorCase& reactorCase, std::uint64_t repeat)
    : case_(reactorCase),
      repeat_(repeat),
      populations_(makePopulations(reactorCase, repeat)),
      gas_(reactorCase, populations_[0].get()),
      balance_(*reactorCase.mechanism, gas_.particles(), gas_.particles().unitElements(*reactorCase.mechanism)),
      thermo_(*reactorCase.mechanism),
      hasElements_(hasElementBalance(reactorCase)) {
  reactor_.emplace(*case_.mechanism, gas_.gas(), pointersTo(populations_), splitOptions(case_));
  reactor_->start(case_.kind->begin(), gas_.start());
  if ((case_.kind->network() != nullptr)) elements_ = elementsOfInflow(case_, balance_);
}

void EnsembleRepeat::run(std::span<const double> places, const ReactorRepeatNumbers<double>& numbers,
                         const AtRow& atRow) {
  using Shape = ReactorRepeatShape;
  numbers.work(Shape::isWhole) = 0;
  for (std::size_t row = 0; row < places.size(); ++row) {
    try {
      reactor_->advance(places[row]);
    } catch (const NumericsError& error) {
      throw NumericsError(fmt::format("ensemble, repeat {}: {}", repeat_ + 1, error.what()));
    }
    fill(row, numbers);
    if (!atRow(row, places[row])) return;
  }
  const SplitReactor::Work& work = reactor_->work();
  numbers.work(Shape::steps) = static_cast<double>(work.steps);
  numbers.work(Shape::rejected) = static_cast<double>(work.rejected);
  numbers.work(Shape::gasSteps) = static_cast<double>(work.gasSteps);
  numbers.work(Shape::unchecked) = static_cast<double>(work.unchecked);
  numbers.work(Shape::time) = gas_.time(reactor_->position(), reactor_->state());
  const std::span<double> counts = numbers.counts();
  std::fill(counts.begin(), counts.end(), 0.0);
  for (const auto& population : populations_) {
    const auto own = population->population().counts();
    for (std::size_t c = 0; c < counts.size(); ++c) counts[c] += own[c].second;
  }
  numbers.work(Shape::isWhole) = 1;
}

void EnsembleRepeat::fill(std::size_t row, const ReactorRepeatNumbers<double>& numbers) {
  const ReactorPopulations& asked = *case_.ensemble;
  std::vector<double> columns{reactor_->position()}, densities, classes;
  if (case_.kind->placeColumns().size() > 1)
    columns.insert(columns.end(), {gas_.time(reactor_->position(), reactor_->state()),
                                   1 / gas_.gas().timePerUnit(reactor_->state().data())});
  const auto append = [](std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  for (std::size_t r = 0; r < populations_.size(); ++r) {
    StochasticPopulation& population = populations_[r]->population();
    population.applyDeferred();
    appendReactor(r, columns);
    for (std::size_t k = 0; k < population.distributions().size(); ++k)
      append(densities, population.distribution(k, asked.bins));
    for (std::size_t k = 0; k < population.shares().size(); ++k)
      append(densities, population.shareDistribution(k, shareBins));
    for (const ReactorPopulations::Classes& by : asked.classes) append(classes, population.classSums(by.by, by.edges));
  }
  std::copy(columns.begin(), columns.end(), numbers.columns(row).begin());
  std::copy(densities.begin(), densities.end(), numbers.densities(row).begin());
  std::copy(classes.begin(), classes.end(), numbers.classes(row).begin());
}

// What the row has of a reactor.
void EnsembleRepeat::appendReactor(std::size_t reactor, std::vector<double>& row) {
  const std::span<const double> y = reactor_->state(reactor);
  const SplitReactor::Gas& gas = gas_.gas();
  const std::size_t n = case_.mechanism->numSpecies(), elements = case_.ensemble->elements.size();
  const std::span<const double> Y = y.first(n), amounts = y.subspan(n + 1, elements + populations_.size());
  const double x = reactor_->position(), T = y[n], density = gas.density(x, y.data());
  row.insert(row.end(), {T, gas.pressure(x, y.data()), density});
  const std::vector<double> values = populations_[reactor]->population().values(reactor_->gas(reactor));
  row.insert(row.end(), values.begin(), values.end());
  row.push_back(density *
                std::accumulate(amounts.begin(), amounts.begin() + static_cast<std::ptrdiff_t>(elements), 0.0));
  if (hasElements_) {
    const std::vector<double> now = balance_.elements(Y, amounts);
    if (elements_.empty()) elements_ = now;
    row.push_back(largestImbalance(elements_, now));
  }
  if (keepsEnergy(case_)) {
    const double energy =
        gas.kept[reactor] == Kept::enthalpy ? balance_.enthalpy(T, Y, amounts) : balance_.internalEnergy(T, Y, amounts);
    if (!energy_) energy_ = energy;
    row.push_back((energy - *energy_) / (thermo_.cpMass(T, Y) * T));
  }
  appendSpecies(*case_.mechanism, case_.output, Y, row);
}

}  // namespace lampblack::app
