// How a ParticleModel advances particles and gas in one place over a time: by an explicit step where that is enough,
// else by an implicit method.
#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "numerics/bogacki_shampine.hpp"
#include "numerics/rosenbrock_solver.hpp"
#include "particles/models/particle_model.hpp"

namespace lampblack::particles {
namespace {

constexpr double smallestMoleFraction = 1e-10;  // below which errors do not matter

// With a constant supply: a place that needs more is at an edge of the particles, where this is not the way (see
// below).
constexpr int stepsWithSupply = 200;

// Densities, then concentrations, of one model; its memory serves the next place.
class Integration {
 public:
  void prepare(const ParticleModel& model, const CarrierGas& gas, double relative) {
    model_ = &model;
    gas_ = {gas, {}};
    scalars_ = model.scalars().size();
    smallest_.clear();
    for (const ParticleScalar& scalar : model.scalars())
      smallest_.push_back(ParticleModel::smallestShare * scalar.scale * gas.density);
    smallest_.resize(scalars_ + model.gasSpecies().size(),
                     smallestMoleFraction * gas.pressure / (constants::gasConstant * gas.temperature));
    relative_ = relative;
  }

  [[nodiscard]] std::size_t size() const { return smallest_.size(); }

  // Particles alone. NumericsError.
  ParticleAdvance advance(double dt, std::span<double> state) {
    return integrate(dt, state, {}, {relative_, smallest_}, [](std::span<const double>, double) { return true; });
  }

  // With a constant supply. False where more would become missing of something than was at the start, and than the
  // supply alone would leave, or without convergence.
  bool advance(double dt, std::span<double> state, std::span<const double> supply, ParticleAdvance& done) {
    lowest_.resize(size());
    for (std::size_t i = 0; i < size(); ++i)
      lowest_[i] = std::min({0.0, state[i], state[i] + dt * supply[i]}) - smallest_[i];
    const auto isAbove = [&](std::span<const double> y) {
      return std::equal(y.begin(), y.end(), lowest_.begin(), std::greater_equal<>());
    };
    try {
      done = integrate(dt, state, supply, {relative_, smallest_, stepsWithSupply},
                       [&](std::span<const double> y, double) { return isAbove(y); });
      return isAbove(state);
    } catch (const NumericsError&) {
      done.rejected = stepsWithSupply;
      return false;
    }
  }

 private:
  template <typename Guard>
  ParticleAdvance integrate(double dt, std::span<double> state, std::span<const double> supply,
                            const RosenbrockSolver::Tolerance& tolerance, const Guard& goesOn) {
    const auto rates = [&](std::span<const double> y, std::span<double> f) {
      gas_.concentrations = y.subspan(scalars_);
      model_->sources(gas_, y.first(scalars_), f.first(scalars_), f.subspan(scalars_));
      for (std::size_t i = 0; i < supply.size(); ++i) f[i] += supply[i];
    };
    if (explicit_.step(rates, dt, state, tolerance.relative, tolerance.smallest)) return {1, 0};
    const auto derivatives = [&](std::span<const double> y, DenseLu& J) {
      const std::size_t n = size();
      gas_.concentrations = y.subspan(scalars_);
      jacobian_.resize(n * (n + 1));
      model_->jacobian(gas_, y.first(scalars_), jacobian_);
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) J.column(j)[i] = jacobian_[i * (n + 1) + j];
    };
    const auto result = implicit_.integrate(rates, derivatives, dt, state, tolerance, goesOn);
    return {result.steps, result.rejected + 1};
  }

  const ParticleModel* model_ = nullptr;
  ParticleGas gas_;
  std::size_t scalars_ = 0;
  double relative_ = 0;
  std::vector<double> smallest_, lowest_, jacobian_;
  BogackiShampine explicit_;
  RosenbrockSolver implicit_;
};

}  // namespace

// What takes more than it leaves room for, as a flow does that carries particles out of a cell in which they burn, can
// be supplied at once only, before the particles change: that is how much there was of them.
ParticleAdvance ParticleModel::advance(const CarrierGas& gas, double dt, std::span<double> densities,
                                       std::span<double> concentrations, std::span<const double> supply) const {
  thread_local Integration integration;
  thread_local std::vector<double> state;
  integration.prepare(*this, gas, advanceTolerance_);
  const std::size_t n = densities.size();
  state.assign(densities.begin(), densities.end());
  state.insert(state.end(), concentrations.begin(), concentrations.end());
  if (n != scalars().size() || state.size() != integration.size() || (!supply.empty() && supply.size() != state.size()))
    throw std::logic_error("particles: what is to be advanced has another size than the model");
  ParticleAdvance done;
  if (supply.empty() || !integration.advance(dt, state, supply, done)) {
    for (std::size_t i = 0; i < supply.size(); ++i)
      state[i] = (i < n ? densities[i] : concentrations[i - n]) + dt * supply[i];
    const ParticleAdvance alone = integration.advance(dt, state);
    done = {done.steps + alone.steps, done.rejected + alone.rejected};
  }
  std::copy_n(state.begin(), n, densities.begin());
  std::copy_n(state.begin() + static_cast<std::ptrdiff_t>(n), concentrations.size(), concentrations.begin());
  return done;
}

}  // namespace lampblack::particles
