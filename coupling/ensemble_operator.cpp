#include "coupling/ensemble_operator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/errors.hpp"
#include "particles/collisions/collision_physics.hpp"

namespace lampblack::coupling {
namespace {

// How a cell is packed for the trip to another rank: place, number, gas, step, and how many values have arrived; then
// the concentrations, the population, and what has arrived.
struct Task {
  double x, y, z, cell, temperature, pressure, density, viscosity, molecularWeight, dt, arrived;
};
constexpr std::size_t taskWidth = sizeof(Task) / sizeof(double);

// And back come the cost, what the gas gets (mol/m3), what the particles gained of each element and what was resampled
// of it (kg/m3), and the population.

// Microseconds, about, of a cell. Estimated as CellParticles::costPerParticle(), to weigh cells against each other and,
// to a factor of two or so, against the gas.
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
  return particles.absorption(temperature, particles.volumeOf(amounts));
}

EnsembleOperator::EnsembleOperator(const FlowContext& context, const TransportOperator& flow,
                                   std::shared_ptr<CellParticles> particles, Options options)
    : context_(context),
      flow_(flow),
      options_(std::move(options)),
      particles_(std::move(particles)),
      amounts_(particles_->amounts()),
      transport_(context, {particles_->sizes().type, waldmannThermophoresis(), options_.diffusion, options_.secondOrder,
                           options_.seed, particles_->rows()}),
      exchange_(context),
      sharing_(context.mesh.comm, options_.shareWork),
      populations_(static_cast<std::size_t>(context.mesh.owned)),
      arrived_(populations_.size()),
      waiting_(populations_.size(), 0.0),
      reserve_(populations_.size() * reserveWidth()),
      rate_(reserve_.size()),
      cost_(populations_.size()),
      outflow_(amounts_.count()),
      resampled_(amounts_.held),
      resampledBefore_(amounts_.held) {
  if (options_.statistics)
    statistics_.emplace(context.mesh, particles_->material(), *options_.statistics,
                        options_.sizes ? std::optional(options_.bins) : std::nullopt);
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
  const std::span<double> amount(&state.carried[static_cast<std::size_t>(cell) * state.scalars.size()],
                                 amounts_.owedElement(0));
  std::ranges::fill(amount, 0.0);
  particles_->addAmounts(populations_[cell], amount);
}

void EnsembleOperator::setOwed(State& state, int cell) const {
  double* amount = &state.carried[static_cast<std::size_t>(cell) * state.scalars.size()];
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

void EnsembleOperator::solve(double time, std::span<const double> in, std::vector<double>& out) {
  PackedDoubles packed(in);
  const auto task = packed.next<Task>();
  const std::size_t species = particles_->species().size();
  const ParticleGas gas{{task.temperature, task.pressure, task.density, task.viscosity, task.molecularWeight},
                        in.subspan(taskWidth, species)};
  const std::span<const double> rows = in.subspan(taskWidth + species);
  const auto arrivedSize = static_cast<std::size_t>(task.arrived);
  CellParticles::Change change;
  try {
    particles_->unpack(rows.first(rows.size() - arrivedSize));
    if (arrivedSize > 0) particles_->join(rows.last(arrivedSize));
    change = particles_->advance(gas, task.dt);
  } catch (const NumericsError& error) {
    throw NumericsError(fmt::format("the ensemble of cell {:.0f} at {} failed at time {:.6g} s: {}", task.cell,
                                    placeText({task.x, task.y, task.z}, context_.mesh.dimension), time, error.what()));
  }
  out.push_back(costOfCell + particles_->costPerParticle() * particles_->cost());
  for (const std::vector<double>* values : {&change.gas, &change.elements, &change.resampled})
    out.insert(out.end(), values->begin(), values->end());
  const std::vector<double> population = particles_->pack();
  out.insert(out.end(), population.begin(), population.end());
}

void EnsembleOperator::unpack(State& state, int cell, bool isHeld, std::span<const double> out) {
  const std::vector<std::size_t>& species = particles_->species();
  const std::size_t held = amounts_.held;
  cost_[cell] = out[0];
  const std::span<const double> change = out.subspan(1, species.size());
  const std::span<const double> gained = out.subspan(1 + species.size(), held);
  const std::span<const double> resampled = out.subspan(1 + species.size() + held, held);
  const std::span<const double> population = out.subspan(1 + species.size() + 2 * held);
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
  const bool isHeld = isGasFrozen(time);
  if (isHeld)
    state.start.density.assign(state.density.begin(), state.density.begin() + m.owned);
  else  // transport and chemistry have paid out of the reserves
    for (std::size_t i = 0; i < reserve_.size(); ++i) reserve_[i] -= dt * rate_[i];
  separateArrivals();
  move(state, dt, EnsembleTransport::Half::First);

  std::vector<int> busy;
  WorkSharing::Items items;
  for (int cell = 0; cell < m.owned; ++cell) {
    const double before = std::exchange(cost_[cell], 0.0);
    const ParticleRows& rows = particles_->rows();
    const std::size_t count = rows.count(rows.of(populations_[cell])) + rows.count(arrived_[cell]);
    if (count == 0 && !particles_->hasPrecursors(gasOf(state, cell, concentrations_))) {
      populations_[cell] = {};
      setOwed(state, cell);
      continue;
    }
    busy.push_back(cell);
    // What it cost in the last step, or once each particle.
    items.cost.push_back(before > 0.0 ? before
                                      : costOfCell + particles_->costPerParticle() * static_cast<double>(count));
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
  storeArrivals(state);
}

void EnsembleOperator::move(const State& state, double dt, EnsembleTransport::Half half) {
  transport_.advance(
      {state, flow_.driftFlux(), flow_.faceDensity(), flow_.properties().viscosity, flow_.properties().molecularWeight},
      dt, static_cast<std::uint64_t>(steps_), half, populations_, arrived_);
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

void EnsembleOperator::countOutflow() {
  std::ranges::fill(outflow_, 0.0);
  goneThrough_.assign(static_cast<std::size_t>(context_.mesh.boundaryFaces()), 0.0);
  std::vector<double> amounts(outflow_.size());
  auto face = transport_.goneThrough().begin();
  particles_->rows().forEach(transport_.gone(), [&](const double* row) {
    std::ranges::fill(amounts, 0.0);
    particles_->addAmounts(row, row[packedNumberAt], amounts);
    for (std::size_t i = 0; i < amounts.size(); ++i) outflow_[i] += amounts[i];
    double& mass = goneThrough_[static_cast<std::size_t>(*face++ - context_.mesh.interiorFaces)];
    for (std::size_t e = 0; e < amounts_.held; ++e) mass += amounts[amounts_.element(e)];
  });
}

void EnsembleOperator::addToStatistics(const State& state) {
  if (!statistics_) return;
  const auto amountsOf = [&](int cell) {
    const double* amount = &state.carried[static_cast<std::size_t>(cell) * state.scalars.size()];
    return EnsembleStatistics::CellAmounts{
        amount[AmountPlaces::number], particles_->volumeOf({amount, amounts_.count()}), amount[amounts_.primaries()],
        amount[amounts_.surface()], amount[amounts_.diameters()]};
  };
  const auto sizesOf = [&](int cell, std::span<double> sizes) {
    addSizes(particles_->sizes(), options_.bins, populations_[cell], sizes);
  };
  statistics_->addStep(stepEnd_, lastStep_, {amountsOf, sizesOf});
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
  }
  inStep_ = false;
  if (!(options_.average > 0.0)) return;
  const double over = std::max(options_.average, lastStep_);
  for (std::size_t i = 0; i < reserve_.size(); ++i) rate_[i] = reserve_[i] / over;
}

void EnsembleOperator::endSweep(State& state) {
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
  archive.cells("ensemble_cost", cost_, 1);
  archive.sums("ensemble_resampled", resampled_);
  if (archive.loading()) resampledBefore_ = resampled_;
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
