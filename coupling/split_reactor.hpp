// A reactor whose particles are not unknowns of the Newton matrix, such as an ensemble: symmetric splitting of gas and
// particles (Strang 1968). In each step the gas reacts for the first half with the particles at rest, the particles
// change for the whole step in a constant gas, and the gas reacts for the second half. The constant gas is that of the
// middle of the exchange, predicted by the exchange of the step before, which keeps the second order. The exchange is
// added to the gas at once. Elements and energy of gas and particles together are conserved: to round-off in the
// exchange, to the tolerance of the stiff solver in the reactions. While the gas reacts, particles take part with their
// heat, expand with the gas, and leave with the outflow.
//
// The equations may be those of a network of reactors, each with its own particles. The gas of each reactor carries a
// mark for every reactor. After a part of a step the marks say which part of the mass came from which reactor, and so
// how many particles each reactor gets from each other.
//
// The length of a step follows from the changes in it. A step with more than twice the aimed change is rejected, unless
// numerical particles were removed at random in it.
//
// The gas may be prescribed (GasAlong): species that are held follow the equations, whatever the particles exchange.
//
// Predictor and corrector, for species that live shorter than the population changes: the gas reacts over the step
// together with the predicted exchange (ExchangeInGas), the particles change in the mean of this gas over the step, and
// the gas gets the difference between the actual and the predicted exchange. Of second order as well, and a step may be
// much longer than a species lives (after Celnik, Patterson, Kraft, Wagner 2009, who take the particles' rates at the
// beginning and at the end of a step).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/ode_system.hpp"
#include "chemistry/reactor/stiff_integrator.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "coupling/exchange_in_gas.hpp"
#include "coupling/particles_at_rest.hpp"
#include "coupling/reactor_particles.hpp"
#include "particles/stochastic/stochastic_population.hpp"

namespace lampblack::coupling {

// Particles of some elements, such as carbon and hydrogen, that change in a given gas.
class SplitParticles {
 public:
  using Exchange = StochasticPopulation::Exchange;
  using State = StochasticPopulation::State;
  virtual ~SplitParticles() = default;
  [[nodiscard]] virtual const std::vector<std::string>& elements() const { return sootElements(); }
  [[nodiscard]] static const std::vector<std::string>& sootElements();  // C, H
  // The source of the viscosity of the gas.
  [[nodiscard]] virtual GasViscosity viscosity() const { return GasViscosity::transport; }
  // Of the mechanism, in the order of the gas that `advance` is given.
  [[nodiscard]] virtual const std::vector<std::size_t>& species() const = 0;
  virtual Exchange advance(const ParticleGas& gas, double dt) = 0;
  // Rate (mol/m3/s) at which the particles gain the i-th species, where a law gives the rate. Without a value the
  // exchange of the last step, which is noisy, predicts the next one.
  [[nodiscard]] virtual std::optional<double> rateOf(std::size_t, const ParticleGas&) const { return std::nullopt; }
  // Multiplies all amounts per volume.
  virtual void dilute(double factor) = 0;
  // The population, as join() of another object of the same type takes it.
  [[nodiscard]] virtual std::vector<double> content() const = 0;
  // Particles of another reactor come in: `share` times its amounts per volume.
  virtual void join(std::span<const double> content, double share) = 0;
  // Whether there are no particles and no inception in this gas.
  [[nodiscard]] virtual bool idle(const ParticleGas& gas) const = 0;
  // Number of numerical particles removed at random, to limit their number, since the beginning.
  [[nodiscard]] virtual std::uint64_t removals() const { return 0; }
  // Everything that a step may change, for restore() after a rejected step.
  [[nodiscard]] virtual std::unique_ptr<State> save() const = 0;
  virtual void restore(const State& state) = 0;

 protected:
  SplitParticles() = default;
  SplitParticles(const SplitParticles&) = default;
  SplitParticles& operator=(const SplitParticles&) = default;
};

class SplitReactor {
 public:
  // The gas's equations, which carry ParticlesAtRest, in the unknowns (Y, T, carbon, hydrogen, marks, ...) of each
  // reactor over time or place; functions of these of one reactor; and what is held, a value a reactor.
  struct Gas {
    OdeSystem* system = nullptr;
    // kg/m3 of gas and particles, and Pa, in the state y at x.
    std::function<double(double x, const double*y)> density, pressure;
    // s, of the independent variable, which is time unless this says otherwise.
    std::function<double(const double* y)> timePerUnit = [](const double*) { return 1.0; };
    enum class Kept { temperature, enthalpy, internalEnergy };
    std::vector<Kept> kept{Kept::enthalpy};
    std::function<double(double x)> nextStop;  // a kink of the equations behind x; may be empty
    // Of all species: those that stay as the equations have them, whatever particles take; empty: none.
    std::vector<bool> held;
    // For the predictor and corrector: the phase that the equations carry, of one reactor. Splitting otherwise.
    ExchangeInGas* expected = nullptr;
  };
  struct Options {
    StiffIntegrator::Options integrator;
    // What may change in a step: concentrations that the particles see, relative, by the particles alone and
    // altogether, and the temperature over 200 K.
    double change = 0.05;
    double largestStep = 0;  // 0: no limit. Fixed, with `fixedStep`
    bool fixedStep = false;
  };
  // A step after one with hardly any change cannot be rejected: the particles are not copied, which saves memory. A
  // step in which numerical particles were removed at random is not rejected either: removal is right in the mean over
  // all outcomes, not over those that change the gas little. Such steps with too large a change are counted as
  // `unchecked`.
  struct Work {
    long steps = 0, rejected = 0, gasSteps = 0, unchecked = 0;
  };

  // The particles of each reactor, of one kind. All have to live as long.
  SplitReactor(const Mechanism& mechanism, Gas gas, std::vector<SplitParticles*> particles, const Options& options);
  SplitReactor(const Mechanism& mechanism, Gas gas, SplitParticles& particles, const Options& options)
      : SplitReactor(mechanism, std::move(gas), std::vector{&particles}, options) {}

  void start(double x, std::span<const double> y);
  // To x, exactly. NumericsError.
  void advance(double x);

  [[nodiscard]] double position() const { return x_; }
  [[nodiscard]] std::span<const double> state() const { return y_; }
  [[nodiscard]] std::span<const double> state(std::size_t reactor) const {
    return std::span(y_).subspan(reactor * block_, block_);
  }
  // The gas of a reactor as its particles see it, until the next call.
  [[nodiscard]] const ParticleGas& gas(std::size_t reactor);
  [[nodiscard]] const Work& work() const { return work_; }

 private:
  double step(double h);
  [[nodiscard]] std::uint64_t allRemovals() const;
  double splitStep(double h);
  double predictedStep(double h);
  double correctedStep(double h);
  void predictExchange();
  [[nodiscard]] std::vector<std::optional<double>> currentRates(const std::vector<double>& concentrations);
  void react(double h);
  // The particles to where the marks say that their gas is. Densities (kg/m3) at the beginning of the part.
  void moveParticles(const std::vector<double>& before);
  // The particles of a reactor over h; the largest part of a concentration that they take or give.
  double exchange(std::size_t reactor, double h);
  // Adds moles (mol/kg) to the gas and kg/kg to the particles' elements; what is held stays.
  void recordExchange(std::size_t reactor, std::span<const double> gas, std::span<const double> elements);
  [[nodiscard]] bool isHeld(std::size_t species) const { return !gas_.held.empty() && gas_.held[species]; }
  // The largest change of a temperature (by its scale) and of concentrations that particles see.
  [[nodiscard]] double change(std::size_t reactor, double T, std::span<const double> before,
                              std::span<const double> after) const;
  [[nodiscard]] double negligible(std::size_t reactor) const;  // mol/m3
  // Of gas and particles with the unknowns `block`.
  [[nodiscard]] double energy(Gas::Kept kept, const double* block, double T);
  [[nodiscard]] double heatCapacity(Gas::Kept kept, const double* block, double T);

  const Mechanism& mechanism_;
  Gas gas_;
  std::vector<SplitParticles*> particles_;
  std::size_t block_;  // unknowns of a reactor
  Options options_;
  StiffIntegrator integrator_;
  ParticlesAtRest atRest_;
  Thermo thermo_;
  ReactorGas seen_;
  double x_ = 0, h_ = 0;
  double lastRate_ = 0;  // change in the last step over its length
  std::vector<double> y_;
  // Of the particles' last step: the change of the unknowns by it, a unit of x; or what is expected of the next, and
  // the mean concentrations, and the particles' own rates over these.
  std::vector<double> exchanged_;
  std::vector<ExchangeInGas::Rate> expected_;
  std::vector<double> means_;
  std::vector<std::optional<double>> known_;
  Work work_;
};

}  // namespace lampblack::coupling
