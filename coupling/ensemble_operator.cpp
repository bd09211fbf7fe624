#include "coupling/ensemble_operator.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/errors.hpp"
#include "coupling/load_ahead.hpp"
#include "particles/collisions/collision_physics.hpp"

namespace lampblack::coupling {
namespace {

// Microseconds, about, of a cell. Estimated as StochasticPopulation::costPerParticle(), to weigh cells against each
// other and, to a factor of two or so, against the gas.
constexpr double costOfCell = 5.0;

}  // namespace

std::vector<std::vector<double>> EnsembleOperator::unitElements(const Mechanism& mechanism,
                                                                const CellParticles& particles, Exchange exchange) {
  std::vector<std::vector<double>> elements = particles.unitElements(mechanism);
  if (exchange == Exchange::OneWay)  // what such particles have came from nowhere
    for (std::vector<double>& amount : elements) std::ranges::fill(amount, 0.0);
  return elements;
}

double EnsembleOperator::absorption(const CellParticles& particles, Exchange exchange, double temperature,
                                    std::span<const double> amounts) {
  if (exchange == Exchange::OneWay) return 0.0;
  return particles.population().absorption(temperature, particles.volumeOf(amounts));
}

EnsembleOperator::EnsembleOperator(const FlowContext& context, const TransportOperator& flow,
                                   std::shared_ptr<CellParticles> particles, Options options, std::size_t first)
    : context_(context),
      flow_(flow),
      options_(std::move(options)),
      particles_(std::move(particles)),
      amounts_(particles_->amounts()),
      first_(first),
      transport_(context, {particles_->sizes().type, waldmannThermophoresis(), options_.diffusion, options_.secondOrder,
                           options_.seed, particles_->rows()}),
      exchange_(context),
      // A cell that was never advanced is expected to cost what its particles do.
      work_(context, {.name = "ensemble", .subject = "the ensemble", .isShared = options_.shareWork, .firstCost = 0.0}),
      populations_(static_cast<std::size_t>(context.mesh.owned)),
      arrived_(populations_.size()),
      waiting_(populations_.size(), 0.0),
      reserve_(populations_.size() * reserveWidth()),
      rate_(reserve_.size()),
      outflow_(amounts_.count()),
      resampled_(amounts_.held),
      resampledBefore_(amounts_.held),
      turn_(options_.inTurn ? Turn::Gas : Turn::Both) {
  if (options_.statistics)
    statistics_.emplace(context.mesh, particles_->material(), *options_.statistics,
                        options_.sizes ? std::optional(options_.bins) : std::nullopt);
  if (options_.inTurn && options_.exchange == Exchange::TwoWay) meanExchange_.emplace(context, particles_->species());
}

ParticleGas EnsembleOperator::gasOf(const State& state, int cell, std::vector<double>& concentrations) const {
  const auto W = context_.mechanism.molecularWeights();
  concentrations.clear();
  for (const std::size_t k : particles_->species())
    concentrations.push_back(state.density[cell] * state.Y[static_cast<std::size_t>(cell) * state.species + k] / W[k]);
  const GasProperties& properties = flow_.properties();
  return {{state.temperature[cell], state.thermodynamicPressure, state.density[cell], properties.viscosity[cell],
           properties.molecularWeight[cell]},
          concentrations};
}

void EnsembleOperator::initialise(State& state, int cell, std::vector<double> population) {
  populations_[cell] = std::move(population);
  waiting_[cell] = 0.0;
  setAmounts(state, cell);
}

void EnsembleOperator::setAmounts(State& state, int cell) const {
  const std::span<double> amount(&state.carried[amountsAt(state, cell)], amounts_.owedElement(0));
  std::ranges::fill(amount, 0.0);
  particles_->addAmounts(populations_[cell], amount);
}

void EnsembleOperator::setOwed(State& state, int cell) const {
  double* amount = &state.carried[amountsAt(state, cell)];
  const double* reserve = &reserve_[static_cast<std::size_t>(cell) * reserveWidth()];
  const std::size_t species = particles_->species().size();
  for (std::size_t element = 0; element < amounts_.owed; ++element) {
    double& owed = amount[amounts_.owedElement(element)];
    owed = 0.0;
    for (std::size_t i = 0; i < species; ++i) owed += particles_->massOfAtoms()[element * species + i] * reserve[i];
  }
}

std::vector<double>& EnsembleOperator::openPopulation(int cell) {
  std::vector<double>& population = populations_[cell];
  if (population.empty()) population = particles_->empty(static_cast<std::uint64_t>(context_.mesh.naturalCell[cell]));
  return population;
}

EnsembleOperator::Packed EnsembleOperator::pack(const State& state, int cell, RowWriter rows) {
  loadAhead(populations_, cell + 1);
  const ParticleGas gas = gasOf(state, cell, concentrations_);
  rows.add(concentrations_);
  rows.add(openPopulation(cell));
  rows.add(arrived_[cell]);
  return {gas, static_cast<double>(arrived_[cell].size()), rooms_.empty() ? 0.0 : rooms_[cell]};
}

EnsembleOperator::Result EnsembleOperator::solve(double dt, const SharedCellWork::Task<Packed>& task, RowWriter rows) {
  const std::size_t species = particles_->species().size();
  const std::span<const double> particles = task.rows.subspan(species);
  const auto arrived = static_cast<std::size_t>(task.input.arrived);
  if (task.input.room > 0.0) particles_->setRoom(static_cast<std::size_t>(task.input.room));
  const CellParticles::Change change =
      particles_->advance(particles.first(particles.size() - arrived), particles.last(arrived),
                          {task.input.gas, task.rows.first(species)}, dt);
  for (const std::vector<double>* values : {&change.exchange.gas, &change.exchange.elements, &change.resampled})
    rows.add(*values);
  rows.add(particles_->pack());
  return {costOfCell + particles_->cost()};
}

void EnsembleOperator::take(State& state, int cell, bool isHeld, std::span<const double> rows) {
  const std::vector<std::size_t>& species = particles_->species();
  const std::size_t held = amounts_.held;
  PackedDoubles values(rows);
  const std::span<const double> change = values.nextRow(species.size());
  const std::span<const double> gained = values.nextRow(held), resampled = values.nextRow(held);
  const std::span<const double> population = values.nextRow(values.left());
  // With room for about as many as came to it in the last step.
  populations_[cell].clear();
  populations_[cell].reserve(population.size() + static_cast<std::size_t>(1.125 * waiting_[cell]));
  populations_[cell].assign(population.begin(), population.end());
  for (std::size_t e = 0; e < held; ++e) resampled_[e] += context_.mesh.volume[cell] * resampled[e];
  if (options_.exchange == Exchange::OneWay) return;
  const double heat = particles_->enthalpy(state.temperature[cell], gained);  // J/m3
  if (!(options_.average > 0.0) && !isHeld) {
    exchange_.recordExchange(state, cell, species, change, heat);
    return;
  }
  double* reserve = &reserve_[static_cast<std::size_t>(cell) * reserveWidth()];
  for (std::size_t i = 0; i < species.size(); ++i) reserve[i] += change[i];
  reserve[species.size()] -= heat;
  setOwed(state, cell);
}

void EnsembleOperator::advance(State& state, double time, double dt) {
  if (turn_ == Turn::Gas) return;
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
  if (!inStep_) findRooms(state);
  inStep_ = hasMoved_ = true;
  work_.beginStep();
  lastStep_ = dt;
  stepEnd_ = time + dt;
  const bool isHeld = holdsOthers(time);
  if (isHeld)
    state.start.density.assign(state.density.begin(), state.density.begin() + m.owned);
  else  // transport and chemistry have paid out of the reserves
    for (std::size_t i = 0; i < reserve_.size(); ++i) reserve_[i] -= dt * rate_[i];
  separateArrivals();
  move(state, dt, EnsembleTransport::Half::First);

  std::vector<SharedCellWork::Item> busy;
  for (int cell = 0; cell < m.owned; ++cell) {
    const ParticleRows& rows = particles_->rows();
    const std::size_t count = rows.count(rows.of(populations_[cell])) + rows.count(arrived_[cell]);
    if (count == 0 && !particles_->population().hasPrecursors(gasOf(state, cell, concentrations_))) {
      populations_[cell] = {};
      setOwed(state, cell);
      work_.setExpectedCost(cell, 0.0);
      continue;
    }
    // What it cost the last time, or once each particle.
    const double expected = work_.expectedCost(cell);
    busy.push_back({cell, expected > 0.0
                              ? expected
                              : costOfCell + particles_->population().costPerParticle() * static_cast<double>(count)});
  }
  SharedCellWork::Work<Packed, Result> work;
  work.pack = [&](std::size_t i, RowWriter rows) { return pack(state, busy[i].cell, rows); };
  work.advance = [&](const auto& tasks, const auto& results, const auto& rows) {
    results.front() = solve(dt, tasks.front(), rows.front());
  };
  work.unpack = [&](std::size_t i, const Result&, std::span<const double> rows) {
    take(state, busy[i].cell, isHeld, rows);
  };
  work_.advance(busy, time, work);
  state.updateHalo(context_.halo);
  for (std::vector<double>& rows : arrived_) rows.clear();
  move(state, dt, EnsembleTransport::Half::Second);
  countOutflow();
  storeArrivals(state);
}

void EnsembleOperator::move(const State& state, double dt, EnsembleTransport::Half half) {
  transport_.advance({state, flow_.driftFlux(), flow_.faceDensity(), flow_.properties()}, dt,
                     static_cast<std::uint64_t>(steps_), half, populations_, arrived_);
}

void EnsembleOperator::separateArrivals() {
  for (std::size_t cell = 0; cell < populations_.size(); ++cell) {
    const auto values = static_cast<std::ptrdiff_t>(waiting_[cell]);
    arrived_[cell].assign(populations_[cell].end() - values, populations_[cell].end());
    populations_[cell].resize(populations_[cell].size() - static_cast<std::size_t>(values));
  }
}

// Collective.
void EnsembleOperator::storeArrivals(State& state) {
  for (int cell = 0; cell < context_.mesh.owned; ++cell) {
    loadAhead(populations_, cell + 1);
    waiting_[cell] = static_cast<double>(arrived_[cell].size());
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

void EnsembleOperator::endStep(State& state) {
  if (inStep_) {
    ++steps_;
    std::vector<double> came(amounts_.count());
    for (std::size_t e = 0; e < amounts_.held; ++e) came[amounts_.element(e)] = resampled_[e] - resampledBefore_[e];
    for (const Watcher& watcher : watchers_) watcher(came, outflow_);
    for (const FaceWatcher& watcher : faceWatchers_) watcher(lastStep_, goneThrough_);
    resampledBefore_ = resampled_;
    addToStatistics(state);
    if (turn_ == Turn::Particles) addToMeans(state);
  }
  inStep_ = false;
  work_.endStep();
  if (!(options_.average > 0.0)) return;
  const double over = std::max(options_.average, lastStep_);
  for (std::size_t i = 0; i < reserve_.size(); ++i) rate_[i] = reserve_[i] / over;
}

void EnsembleOperator::endSweep(State& state) {
  addRates(state, state.balance);
  if (!(options_.average > 0.0)) return;
  const auto W = context_.mechanism.molecularWeights();
  const std::vector<std::size_t>& species = particles_->species();
  for (int cell = 0; cell < context_.mesh.owned; ++cell) {
    const auto c = static_cast<std::size_t>(cell);
    const double* rate = &rate_[c * reserveWidth()];
    for (std::size_t i = 0; i < species.size(); ++i) state.balance.exchange(c, species[i], rate[i] * W[species[i]]);
    state.balance.enthalpy[c] += rate[species.size()];
  }
}

void EnsembleOperator::saveOrLoad(StateArchive& archive) {
  if (archive.loading()) inStep_ = false;
  archive.rows("ensembles", populations_);
  archive.cells("ensemble_waiting", waiting_, 1);
  archive.cells("ensemble_reserve", reserve_, static_cast<int>(reserveWidth()));
  work_.saveOrLoad(archive);
  archive.sums("ensemble_resampled", resampled_);
  if (archive.loading()) resampledBefore_ = resampled_;
  std::vector<double> shared{static_cast<double>(steps_), lastStep_};
  archive.shared("ensemble_steps", shared);
  steps_ = static_cast<std::int64_t>(shared.at(0));
  lastStep_ = shared.at(1);
  if (options_.inTurn) saveOrLoadTurn(archive);
  EnsembleStatistics::saveOrLoad(archive, statistics_ ? &*statistics_ : nullptr);
}

}  // namespace lampblack::coupling
