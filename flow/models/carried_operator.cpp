#include "flow/models/carried_operator.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/errors.hpp"
#include "flow/cell_errors.hpp"

namespace lampblack::flow {
namespace {

// About microseconds: rates, and the factors of a dense matrix, of RODAS3. Estimated, not measured: it weighs cells
// with particles against each other, and against the gas to a factor of two or so.
double costOfAdvance(std::size_t scalars, double steps) {
  const auto n = static_cast<double>(scalars);
  return 1.0 + steps * (1.0 + 0.3 * n + 0.01 * n * n);
}

// Where a cell's values begin, `width` of them a cell.
std::size_t at(int cell, std::size_t width) {
  return static_cast<std::size_t>(cell) * width;
}

}  // namespace

ParticleGas gasOfCell(const FlowContext& context, const State& state, int cell, double viscosity,
                      const std::vector<std::size_t>& species, std::vector<double>& concentrations) {
  const auto n = static_cast<std::size_t>(state.species);
  const double* Y = &state.Y[static_cast<std::size_t>(cell) * n];
  const auto W = context.mechanism.molecularWeights();
  const double rho = state.density[cell];
  concentrations.clear();
  for (const std::size_t k : species) concentrations.push_back(rho * Y[k] / W[k]);
  return {{state.temperature[cell], state.thermodynamicPressure, rho, viscosity,
           context.thermo.meanMolecularWeight({Y, n})},
          concentrations};
}

ScalarBlock CarriedOperator::blockOf(const CarriedModel& model, const std::vector<BoundaryCondition>& boundaries) {
  ScalarBlock block{model.material(), {}};
  for (const CarriedModel::Scalar& scalar : model.scalars()) {
    block.scalars.push_back({model.material() + "_" + scalar.density.name, scalar.density.unit,
                             scalar.density.description + ", per volume", scalar.thermophoresis});
    block.scalars.back().negligible = scalar.negligible;
  }
  return takenByWalls(std::move(block), boundaries);
}

CarriedOperator::CarriedOperator(const FlowContext& context, CarriedModel& model, std::size_t first, Options options)
    : context_(context),
      model_(model),
      first_(first),
      scalars_(model.scalars().size()),
      options_(std::move(options)),
      work_(context, {.name = "carried", .subject = model.material(), .isShared = options_.shareWork}),
      before_(static_cast<std::size_t>(context.mesh.owned) * (scalars_ + model.exchanged().size())),
      rate_(before_.size()),
      heat_(static_cast<std::size_t>(context.mesh.owned)),
      exchange_(context),
      values_(scalars_ + model.exchanged().size()),
      enthalpy_(scalars_),
      slope_(scalars_) {}

std::span<double> CarriedOperator::densities(State& state, int cell) const {
  return {&state.carried[at(cell, state.scalars.size()) + first_], scalars_};
}

std::span<const double> CarriedOperator::densities(const State& state, int cell) const {
  return {&state.carried[at(cell, state.scalars.size()) + first_], scalars_};
}

double CarriedOperator::viscosityOf(const State& state, int cell) const {
  const auto n = static_cast<std::size_t>(state.species);
  thread_local std::vector<double> X, D;
  X.resize(n);
  D.resize(n);
  context_.thermo.massToMole({&state.Y[static_cast<std::size_t>(cell) * n], n}, X);
  return context_.transport.mixture(state.temperature[cell], state.thermodynamicPressure, X, D).viscosity;
}

// Rates that go by a share of themselves are those of as much less time, in which all else is as much faster.
CarriedOperator::Result CarriedOperator::solve(double dt, const SharedCellWork::Task<Input>& task,
                                               RowWriter rows) const {
  const auto& [gas, share] = task.input;
  const std::span<double> values = rows.add(values_.size());
  const std::span<const double> supply = task.rows.subspan(values.size());
  std::ranges::copy(task.rows.first(values.size()), values.begin());
  if (!(share > 0.0)) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += dt * supply[i];
    return {costOfAdvance(scalars_, 0.0), 0.0};
  }
  std::vector<double> faster(supply.begin(), supply.end());
  for (double& rate : faster) rate /= share;
  const ParticleAdvance done =
      model_.advance(gas, share * dt, values.first(scalars_), values.subspan(scalars_), faster);
  const double steps = done.steps + done.rejected;
  return {costOfAdvance(scalars_, steps), steps};
}

void CarriedOperator::valuesOf(const State& state, int cell, std::span<double> values) const {
  std::ranges::copy(densities(state, cell), values.begin());
  const std::vector<std::size_t>& species = model_.exchanged();
  const auto W = context_.mechanism.molecularWeights();
  for (std::size_t i = 0; i < species.size(); ++i)
    values[scalars_ + i] = state.density[cell] * state.Y[at(cell, state.species) + species[i]] / W[species[i]];
}

CarriedOperator::Input CarriedOperator::pack(const State& state, const BusyCell& busy, double dt,
                                             RowWriter rows) const {
  const int c = busy.cell;
  const std::size_t n = values_.size();
  const std::span<double> values = rows.add(2 * n), start = values.first(n), supply = values.last(n);
  valuesOf(state, c, start);
  // Since the end of the last step, without what these particles did in it: at a constant rate.
  for (std::size_t i = 0; i < n; ++i) {
    const double before = before_[at(c, n) + i];
    supply[i] = (start[i] - before) / dt - rate_[at(c, n) + i];
    start[i] = before;
  }
  return {
      {state.temperature[c], state.thermodynamicPressure, state.density[c], busy.viscosity, busy.meanMolecularWeight},
      mixing_ ? mixing_->present()[c].reactingShare : 1.0};
}

void CarriedOperator::take(State& state, int cell, double dt, std::span<const double> after) {
  const std::vector<std::size_t>& species = model_.exchanged();
  valuesOf(state, cell, values_);
  double* rate = &rate_[at(cell, values_.size())];
  const double temperature = state.temperature[cell];
  model_.enthalpies(temperature, enthalpy_, slope_);
  double power = 0.0;  // W/m3, of the gas to the particles
  for (std::size_t i = 0; i < values_.size(); ++i) rate[i] += (after[i] - values_[i]) / dt;
  for (std::size_t s = 0; s < scalars_; ++s) power += rate[s] * enthalpy_[s];
  const double given = dt * (power + heat_[cell]);  // J/m3, what the balance does not hold already
  heat_[cell] = -power;
  std::copy_n(after.begin(), scalars_, densities(state, cell).begin());

  for (std::size_t i = scalars_; i < values_.size(); ++i) values_[i] = after[i] - values_[i];
  exchange_.recordExchange(state, cell, species, std::span(values_).subspan(scalars_), given);
}

void CarriedOperator::setDiffusivities(State& state, int cell, double viscosity) {
  const std::span<double> D{&state.carriedDiffusivity[at(cell, state.scalars.size()) + first_], scalars_};
  model_.diffusivities(gasOfCell(context_, state, cell, viscosity, model_.exchanged(), concentrations_),
                       densities(state, cell), D);
}

// A cell without particles, and without anything they could come of, is left alone: it gives back what the balance held
// of them.
void CarriedOperator::rest(State& state, int cell, double dt) {
  std::fill_n(&state.carriedDiffusivity[at(cell, state.scalars.size()) + first_], scalars_, 0.0);
  const std::span<double> rate{&rate_[at(cell, values_.size())], values_.size()};
  if (std::ranges::all_of(rate, [](double r) { return r == 0.0; })) return;
  std::vector<double> after(values_.size());
  valuesOf(state, cell, after);
  for (std::size_t i = 0; i < after.size(); ++i) after[i] -= dt * rate[i];
  take(state, cell, dt, after);
  std::ranges::fill(rate, 0.0);
  heat_[cell] = 0.0;
}

void CarriedOperator::advance(State& state, double time, double dt) {
  const Mesh& m = context_.mesh;
  work_.beginStep();
  std::vector<BusyCell> busy;
  std::vector<SharedCellWork::Item> items;
  collectively(m.comm, [&] {
    for (int c = 0; c < m.owned; ++c) {
      const ParticleGas still = gasOfCell(context_, state, c, 0.0, model_.exchanged(), concentrations_);
      if (model_.idle(still, densities(state, c))) {
        rest(state, c, dt);
        continue;
      }
      busy.push_back({c, viscosityOf(state, c), still.meanMolecularWeight});
      items.push_back({c, work_.expectedCost(c)});
    }
  });
  SharedCellWork::Work<Input, Result> work;
  work.pack = [&](std::size_t i, RowWriter rows) { return pack(state, busy[i], dt, rows); };
  work.advance = [&](const auto& tasks, const auto& results, const auto& rows) {
    results.front() = solve(dt, tasks.front(), rows.front());
  };
  work.unpack = [&](std::size_t i, const Result& result, std::span<const double> values) {
    steps_ += static_cast<long>(result.steps);
    take(state, busy[i].cell, dt, values);
    setDiffusivities(state, busy[i].cell, busy[i].viscosity);
  };
  work_.advance(items, time, work);
  state.updateHalo(context_.halo);
}

void CarriedOperator::endStep(State& state) {
  work_.endStep();
  for (int c = 0; c < context_.mesh.owned; ++c) valuesOf(state, c, {&before_[at(c, values_.size())], values_.size()});
}

void CarriedOperator::endSweep(State& state) {
  const std::vector<std::size_t>& species = model_.exchanged();
  const auto W = context_.mechanism.molecularWeights();
  const std::size_t n = values_.size();
  for (int c = 0; c < context_.mesh.owned; ++c) {
    const double* rate = &rate_[at(c, n)];
    for (std::size_t s = 0; s < scalars_; ++s)
      state.balance.carried[at(c, state.scalars.size()) + first_ + s] += rate[s];
    for (std::size_t i = 0; i < species.size(); ++i)
      state.balance.exchange(static_cast<std::size_t>(c), species[i], rate[scalars_ + i] * W[species[i]]);
    state.balance.enthalpy[c] += heat_[c];
  }
}

void CarriedOperator::addRates(const State& state, State::Balance& rates) {
  const std::vector<std::size_t>& species = model_.exchanged();
  const auto W = context_.mechanism.molecularWeights();
  std::vector<double> amounts(scalars_), exchanged(species.size());
  const std::span<const CellMixing> mixing = mixing_ ? mixing_->of(state) : std::span<const CellMixing>();
  for (int c = 0; c < context_.mesh.owned; ++c) {
    ParticleGas gas = gasOfCell(context_, state, c, 0.0, species, concentrations_);
    if (model_.idle(gas, densities(state, c))) continue;
    gas = gasOfCell(context_, state, c, viscosityOf(state, c), species, concentrations_);
    model_.sources(gas, densities(state, c), amounts, exchanged);
    if (mixing_)
      for (const std::span<double> made : {std::span(amounts), std::span(exchanged)})
        for (double& rate : made) rate *= mixing[c].reactingShare;
    model_.enthalpies(state.temperature[c], enthalpy_, slope_);
    for (std::size_t s = 0; s < scalars_; ++s) {
      rates.carried[at(c, state.scalars.size()) + first_ + s] += amounts[s];
      rates.enthalpy[c] -= amounts[s] * enthalpy_[s];
    }
    for (std::size_t i = 0; i < species.size(); ++i)
      rates.exchange(static_cast<std::size_t>(c), species[i], exchanged[i] * W[species[i]]);
  }
}

void CarriedOperator::addSlopes(const State& state, const Slopes& slopes) {
  const std::vector<std::size_t>& species = model_.exchanged();
  const auto W = context_.mechanism.molecularWeights();
  const std::size_t columns = values_.size() + 1, width = static_cast<std::size_t>(state.species) + 1,
                    all = state.scalars.size();
  std::vector<double> J(values_.size() * columns);
  const std::span<const CellMixing> mixing = mixing_ ? mixing_->of(state) : std::span<const CellMixing>();
  inEachCell(context_.mesh, [&](int c) {
    ParticleGas gas = gasOfCell(context_, state, c, 0.0, species, concentrations_);
    if (model_.idle(gas, densities(state, c))) return;
    gas = gasOfCell(context_, state, c, viscosityOf(state, c), species, concentrations_);
    std::ranges::fill(J, 0.0);
    model_.jacobian(gas, densities(state, c), {J, columns});
    if (mixing_)
      for (double& slope : J) slope *= mixing[c].reactingShare;
    for (std::size_t s = 0; s < scalars_ && !slopes.carried.empty(); ++s)
      for (std::size_t by = 0; by < scalars_; ++by)
        slopes.carried[at(c, all * all) + (first_ + by) * all + first_ + s] += J[s * columns + by];
    if (slopes.gas.empty()) return;
    double* ofGas = &slopes.gas[at(c, width * width)];
    for (std::size_t i = 0; i < species.size(); ++i)
      for (std::size_t by = 0; by < species.size(); ++by)
        ofGas[species[by] * width + species[i]] +=
            W[species[i]] * J[(scalars_ + i) * columns + scalars_ + by] * state.density[c] / W[species[by]];
  });
}

void CarriedOperator::setDiffusivities(State& state) {
  inEachCell(context_.mesh, [&](int c) {
    const ParticleGas still = gasOfCell(context_, state, c, 0.0, model_.exchanged(), concentrations_);
    if (model_.idle(still, densities(state, c)))
      std::fill_n(&state.carriedDiffusivity[at(c, state.scalars.size()) + first_], scalars_, 0.0);
    else
      setDiffusivities(state, c, viscosityOf(state, c));
  });
}

void CarriedOperator::saveOrLoad(StateArchive& archive) {
  work_.saveOrLoad(archive);
  archive.cells("carried_rate", rate_, static_cast<int>(values_.size()));
  archive.cells("carried_heat", heat_, 1);
  std::array<double, 1> counted{static_cast<double>(steps_)};
  archive.sums("carried_counts", counted);
  steps_ = static_cast<long>(counted[0]);
}

}  // namespace lampblack::flow
