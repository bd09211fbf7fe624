#include "coupling/ensemble_operator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "coupling/ensemble_species.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/models/soot_model.hpp"

namespace lampblack::coupling {
namespace {

// How a cell is packed for the trip to another rank: place, number, gas, step, and how many values have arrived; then
// the concentrations, the population, and what has arrived.
struct Task {
  double x, y, z, cell, temperature, pressure, density, viscosity, molecularWeight, dt, arrived;
};
constexpr std::size_t taskWidth = sizeof(Task) / sizeof(double);

// And back; then what the gas gets (mol/m3), and the population.
struct Done {
  double cost, resampled, gainedCarbon, gainedHydrogen;  // kg/m3
};
constexpr std::size_t doneWidth = sizeof(Done) / sizeof(double);

// Microseconds, about, of a numerical particle that is looked at in a splitting step or of an event; and of a cell.
// Estimated, to weigh cells against each other and, to a factor of two or so, against the gas.
constexpr double costOfLook = 0.06, costOfCell = 5.0;

EnsembleTransport::Options transportOptions(const EnsembleOperator::Options& o) {
  const EnsembleOptions& e = o.ensemble;
  return {{e.soot.sootDensity, e.coalescing}, waldmannThermophoresis(), o.diffusion, o.secondOrder, e.seed};
}

}  // namespace

std::vector<CarriedScalar> EnsembleOperator::scalars() {
  return {{"soot_number", "1/m^3", "particles, per volume", 0.0, false},
          {"soot_carbon", "kg/m^3", "carbon in particles, per volume", 0.0, false},
          {"soot_hydrogen", "kg/m^3", "hydrogen in particles, per volume", 0.0, false},
          {"soot_primaries", "1/m^3", "primary particles, per volume", 0.0, false},
          {"soot_surface", "m^2/m^3", "surface of particles, per volume", 0.0, false},
          {"soot_mobility_diameters", "m/m^3", "sum of mobility diameters, per volume", 0.0, false},
          {"soot_owed_carbon", "kg/m^3", "carbon that the gas is still to get from the reserve", 0.0, false},
          {"soot_owed_hydrogen", "kg/m^3", "hydrogen that the gas is still to get from the reserve", 0.0, false},
          {"soot_owed_oxygen", "kg/m^3", "oxygen that the gas is still to get from the reserve", 0.0, false}};
}

std::vector<std::vector<double>> EnsembleOperator::unitElements(const Mechanism& mechanism, Exchange exchange) {
  std::vector<std::vector<double>> elements(amounts, std::vector<double>(mechanism.numElements(), 0.0));
  if (exchange == Exchange::OneWay) return elements;  // what such particles have came from nowhere
  elements[carbon][mechanism.elementIndex("C")] = elements[owedC][mechanism.elementIndex("C")] = 1.0;
  elements[hydrogen][mechanism.elementIndex("H")] = elements[owedH][mechanism.elementIndex("H")] = 1.0;
  elements[owedO][mechanism.elementIndex("O")] = 1.0;
  return elements;
}

double EnsembleOperator::absorption(const Options& options, double temperature, std::span<const double> amount) {
  if (options.exchange == Exchange::OneWay) return 0.0;
  return sootAbsorption(temperature, (amount[carbon] + amount[hydrogen]) / options.ensemble.soot.sootDensity);
}

EnsembleOperator::EnsembleOperator(const FlowContext& context, const TransportOperator& flow, Options options)
    : context_(context),
      flow_(flow),
      options_(std::move(options)),
      type_(options_.ensemble.soot.sootDensity, options_.ensemble.coalescing),
      species_(indicesOfSootSpecies(context.mechanism, options_.ensemble.soot)),
      engine_(makeEnsemble(options_.ensemble)),
      blank_(engine_->pack()),
      transport_(context, transportOptions(options_)),
      exchange_(context),
      sharing_(context.mesh.comm, options_.shareWork),
      populations_(static_cast<std::size_t>(context.mesh.owned)),
      arrived_(populations_.size()),
      waiting_(populations_.size(), 0.0),
      reserve_(populations_.size() * reserveWidth()),
      rate_(reserve_.size()),
      cost_(populations_.size()),
      outflow_(amounts) {
  for (const std::size_t element :
       {context.mechanism.elementIndex("C"), context.mechanism.elementIndex("H"), context.mechanism.elementIndex("O")})
    for (const std::size_t k : species_)
      massOfAtoms_.push_back(context.mechanism.atoms(k, element) * context.mechanism.atomicWeight(element));
  if (options_.statistics)
    statistics_.emplace(context.mesh, *options_.statistics,
                        options_.sizes ? std::optional(options_.bins) : std::nullopt);
}

ParticleGas EnsembleOperator::gasOf(const State& state, int cell, std::vector<double>& concentrations) const {
  const auto W = context_.mechanism.molecularWeights();
  concentrations.clear();
  for (const std::size_t k : species_)
    concentrations.push_back(state.density[cell] * state.Y[static_cast<std::size_t>(cell) * state.species + k] / W[k]);
  const GasProperties& properties = flow_.properties();
  return {{state.temperature[cell], state.thermodynamicPressure, state.density[cell], properties.viscosity[cell],
           properties.molecularWeight[cell]},
          concentrations};
}

void EnsembleOperator::initialise(State& state, int cell, std::span<const GivenParticle> population) {
  EnsembleOptions own = options_.ensemble;
  own.owner = static_cast<std::uint64_t>(context_.mesh.naturalCell[cell]);
  const auto ensemble = makeEnsemble(own);
  ensemble->initialise(population);
  populations_[cell] = ensemble->pack();
  waiting_[cell] = 0.0;
  setAmounts(state, cell);
}

void EnsembleOperator::setAmounts(State& state, int cell) const {
  const Ensemble::Totals t = packedTotals(type_, populations_[cell]);
  double* amount = &state.carried[static_cast<std::size_t>(cell) * state.scalars.size()];
  amount[number] = t.number;
  amount[carbon] = t.carbon;
  amount[hydrogen] = t.hydrogen;
  amount[primaries] = t.primaries;
  amount[surface] = t.surface;
  amount[diameters] = t.diameters;
}

void EnsembleOperator::setOwed(State& state, int cell) const {
  double* amount = &state.carried[static_cast<std::size_t>(cell) * state.scalars.size()];
  const double* reserve = &reserve_[static_cast<std::size_t>(cell) * reserveWidth()];
  for (std::size_t element = 0; element < 3; ++element) {
    double& owed = amount[owedC + element];
    owed = 0.0;
    for (std::size_t i = 0; i < species_.size(); ++i) owed += massOfAtoms_[element * species_.size() + i] * reserve[i];
  }
}

std::vector<double>& EnsembleOperator::openPopulation(int cell) {
  std::vector<double>& population = populations_[cell];
  if (population.empty()) {
    population = blank_;
    std::ranges::copy(packedOwner(static_cast<std::uint64_t>(context_.mesh.naturalCell[cell])),
                      &population[packedOwnerAt]);
  }
  return population;
}

void EnsembleOperator::pack(const State& state, int cell, double dt, std::vector<double>& in) {
  const Mesh& m = context_.mesh;
  const ParticleGas gas = gasOf(state, cell, concentrations_);
  const std::vector<double>& arrived = arrived_[cell];
  packDoubles(in, Task{m.centre[cell][0], m.centre[cell][1], m.centre[cell][2],
                       static_cast<double>(m.naturalCell[cell]), gas.temperature, gas.pressure, gas.density,
                       gas.viscosity, gas.meanMolecularWeight, dt, static_cast<double>(arrived.size())});
  in.insert(in.end(), concentrations_.begin(), concentrations_.end());
  const std::vector<double>& population = openPopulation(cell);
  in.insert(in.end(), population.begin(), population.end());
  in.insert(in.end(), arrived.begin(), arrived.end());
}

void EnsembleOperator::solve(double time, std::span<const double> in, std::vector<double>& out) const {
  PackedDoubles packed(in);
  const auto task = packed.next<Task>();
  const ParticleGas gas{{task.temperature, task.pressure, task.density, task.viscosity, task.molecularWeight},
                        in.subspan(taskWidth, species_.size())};
  const std::span<const double> rows = in.subspan(taskWidth + species_.size());
  const auto arrivedSize = static_cast<std::size_t>(task.arrived);
  EnsembleExchange taken;
  try {
    engine_->unpack(rows.first(rows.size() - arrivedSize));
    if (arrivedSize > 0) {
      std::vector<GivenParticle> arrived;
      for (PackedDoubles left(rows.last(arrivedSize)); left.left() > 0;) arrived.push_back(left.next<GivenParticle>());
      engine_->join(arrived, 1.0);
    }
    engine_->advance(gas, 0.0, task.dt);
    taken = engine_->takeExchange();
  } catch (const NumericsError& error) {
    throw NumericsError(fmt::format("the ensemble of cell {:.0f} at {} failed at time {:.6g} s: {}", task.cell,
                                    placeText({task.x, task.y, task.z}, context_.mesh.dimension), time, error.what()));
  }
  packDoubles(out, Done{costOfCell + costOfLook * engine_->cost(), taken.resampledCarbon + taken.resampledHydrogen,
                        taken.carbon, taken.hydrogen});
  out.insert(out.end(), taken.gas.begin(), taken.gas.begin() + static_cast<std::ptrdiff_t>(species_.size()));
  const std::vector<double> population = engine_->pack();
  out.insert(out.end(), population.begin(), population.end());
}

void EnsembleOperator::unpack(State& state, int cell, bool isHeld, std::span<const double> out) {
  const auto done = PackedDoubles(out).next<Done>();
  const std::span<const double> population = out.subspan(doneWidth + species_.size());
  populations_[cell].assign(population.begin(), population.end());
  cost_[cell] = done.cost;
  resampled_ += context_.mesh.volume[cell] * done.resampled;
  if (options_.exchange == Exchange::OneWay) return;
  const double temperature = state.temperature[cell];
  const double heat = done.gainedCarbon * sootCarbonEnthalpy(temperature).first +
                      done.gainedHydrogen * sootHydrogenEnthalpy(temperature).first;  // J/m3
  const std::span<const double> change = out.subspan(doneWidth, species_.size());
  if (!(options_.average > 0.0) && !isHeld) {
    exchange_.book(state, cell, species_, change, heat);
    return;
  }
  double* reserve = &reserve_[static_cast<std::size_t>(cell) * reserveWidth()];
  for (std::size_t i = 0; i < species_.size(); ++i) reserve[i] += change[i];
  reserve[species_.size()] -= heat;
  setOwed(state, cell);
}

void EnsembleOperator::advance(State& state, double time, double dt) {
  const Mesh& m = context_.mesh;
  if (options_.sweeps > 1) {
    if (!inStep_) {
      startPopulations_ = populations_;
      startWaiting_ = waiting_;
      startReserve_ = reserve_;
      startResampled_ = resampled_;
    } else {
      populations_ = startPopulations_;
      waiting_ = startWaiting_;
      reserve_ = startReserve_;
      resampled_ = startResampled_;
    }
  }
  inStep_ = true;
  lastStep_ = dt;
  stepEnd_ = time + dt;
  const bool isHeld = isGasHeld(time);
  if (isHeld)
    state.start.density.assign(state.density.begin(), state.density.begin() + m.owned);
  else  // transport and chemistry have paid out of the reserves
    for (std::size_t i = 0; i < reserve_.size(); ++i) reserve_[i] -= dt * rate_[i];
  takeOutWaiting();
  move(state, dt, EnsembleTransport::Half::First);

  std::vector<int> busy;
  WorkSharing::Items items;
  for (int cell = 0; cell < m.owned; ++cell) {
    const double before = std::exchange(cost_[cell], 0.0);
    const bool isEmpty = populations_[cell].size() <= packedHead && arrived_[cell].empty();
    if (isEmpty && !hasPrecursors(gasOf(state, cell, concentrations_))) {
      populations_[cell] = {};
      setOwed(state, cell);
      continue;
    }
    busy.push_back(cell);
    const std::size_t values = populations_[cell].size() + arrived_[cell].size();
    // What it cost in the last step, or once each particle.
    items.cost.push_back(before > 0.0 ? before
                                      : costOfCell + costOfLook * static_cast<double>(values) / packedParticle);
  }
  items.pack = [&](std::size_t i, std::vector<double>& in) { pack(state, busy[i], dt, in); };
  items.advance = [&](std::span<const double> in, std::vector<double>& out) { solve(time, in, out); };
  items.unpack = [&](std::size_t i, std::span<const double> out) { unpack(state, busy[i], isHeld, out); };
  items.work = [](std::span<const double> out) { return out[0]; };
  const WorkSharing::Statistics statistics = sharing_.run(items);
  imbalances_.before += statistics.imbalanceBefore;
  imbalances_.after += statistics.imbalanceAfter;
  ++stages_;
  state.updateHalo(context_.halo);
  for (std::vector<double>& rows : arrived_) rows.clear();
  move(state, dt, EnsembleTransport::Half::Second);
  countOutflow();
  letArrivedWait(state);
}

void EnsembleOperator::move(const State& state, double dt, EnsembleTransport::Half half) {
  transport_.advance(
      {state, flow_.driftFlux(), flow_.faceDensity(), flow_.properties().viscosity, flow_.properties().molecularWeight},
      dt, static_cast<std::uint64_t>(steps_), half, populations_, arrived_);
}

void EnsembleOperator::takeOutWaiting() {
  for (std::size_t cell = 0; cell < populations_.size(); ++cell) {
    const auto values = static_cast<std::ptrdiff_t>(waiting_[cell]) * static_cast<std::ptrdiff_t>(packedParticle);
    arrived_[cell].assign(populations_[cell].end() - values, populations_[cell].end());
    populations_[cell].resize(populations_[cell].size() - static_cast<std::size_t>(values));
  }
}

// Collective.
void EnsembleOperator::letArrivedWait(State& state) {
  for (int cell = 0; cell < context_.mesh.owned; ++cell) {
    waiting_[cell] = static_cast<double>(arrived_[cell].size() / packedParticle);
    if (!arrived_[cell].empty()) {
      std::vector<double>& population = openPopulation(cell);
      population.reserve(population.size() + arrived_[cell].size());
      population.insert(population.end(), arrived_[cell].begin(), arrived_[cell].end());
    }
    // Room for half as much again may stay, which the next step needs.
    if (std::vector<double>& kept = populations_[cell]; kept.capacity() > kept.size() + kept.size() / 2)
      kept.shrink_to_fit();
    setAmounts(state, cell);
  }
  context_.halo.update(state.carried, state.carriedCount());
}

void EnsembleOperator::countOutflow() {
  std::ranges::fill(outflow_, 0.0);
  for (const GivenParticle& p : transport_.gone()) {
    outflow_[number] += p.number;
    outflow_[carbon] += p.number * p.carbon;
    outflow_[hydrogen] += p.number * p.hydrogen;
    outflow_[primaries] += p.number * p.primaries;
  }
}

void EnsembleOperator::addToStatistics(const State& state) {
  if (!statistics_) return;
  const auto amountsOf = [&](int cell) {
    const double* amount = &state.carried[static_cast<std::size_t>(cell) * state.scalars.size()];
    return EnsembleStatistics::CellAmounts{amount[number],
                                           (amount[carbon] + amount[hydrogen]) / options_.ensemble.soot.sootDensity,
                                           amount[primaries], amount[surface], amount[diameters]};
  };
  const auto sizesOf = [&](int cell, std::span<double> sizes) {
    addSizes(type_, options_.bins, populations_[cell], sizes);
  };
  statistics_->addStep(stepEnd_, lastStep_, {amountsOf, sizesOf});
}

void EnsembleOperator::endStep(State& state) {
  if (inStep_) {
    ++steps_;
    for (const auto& watcher : watchers_) watcher(outflow_);
    addToStatistics(state);
  }
  inStep_ = false;
  if (!(options_.average > 0.0)) return;
  const double over = std::max(options_.average, lastStep_);
  for (std::size_t i = 0; i < reserve_.size(); ++i) rate_[i] = reserve_[i] / over;
}

void EnsembleOperator::endSweep(State& state) {
  if (!(options_.average > 0.0)) return;
  const auto W = context_.mechanism.molecularWeights();
  for (int cell = 0; cell < context_.mesh.owned; ++cell) {
    const auto c = static_cast<std::size_t>(cell);
    const double* rate = &rate_[c * reserveWidth()];
    for (std::size_t i = 0; i < species_.size(); ++i) state.balance.exchange(c, species_[i], rate[i] * W[species_[i]]);
    state.balance.enthalpy[c] += rate[species_.size()];
  }
}

void EnsembleOperator::saveOrLoad(StateArchive& archive) {
  if (archive.loading()) inStep_ = false;
  archive.rows("ensembles", populations_);
  archive.cells("ensemble_waiting", waiting_, 1);
  archive.cells("ensemble_reserve", reserve_, static_cast<int>(reserveWidth()));
  archive.cells("ensemble_cost", cost_, 1);
  std::array<double, 1> counted{resampled_};
  archive.sums("ensemble_resampled", counted);
  resampled_ = counted[0];
  std::vector<double> shared{static_cast<double>(steps_), lastStep_, imbalances_.before, imbalances_.after,
                             static_cast<double>(stages_)};
  archive.shared("ensemble_steps", shared);
  steps_ = static_cast<std::int64_t>(shared.at(0));
  lastStep_ = shared.at(1);
  imbalances_ = {shared.at(2), shared.at(3)};
  stages_ = static_cast<int>(shared.at(4));
  EnsembleStatistics::saveOrLoad(archive, statistics_ ? &*statistics_ : nullptr);
}

void EnsembleOperator::addCost(const Mesh&, CellCost& cost) const {
  std::vector<double>& to = options_.shareWork ? cost.shared : cost.own;
  for (std::size_t cell = 0; cell < to.size(); ++cell) to[cell] += cost_[cell];
}

}  // namespace lampblack::coupling
