// A reactor whose particles stand in no Newton matrix, such as an ensemble: gas and particles in turn, by symmetric
// splitting (Strang 1968). In each step the gas reacts for the first half with the particles at rest, the particles
// change for all of it in a gas that does not change, and the gas reacts for the second half. The gas that they see is
// that of the middle of their own exchange, by what they exchanged in the step before, which keeps the second order.
// What the particles exchange with the gas is booked at once: elements and energy are those of both together, to
// round-off in that part, to the tolerance of the stiff solver in the other. While the gas reacts, particles take part
// with their heat, expand with it, and leave with what flows out.
//
// The equations may be those of a network of reactors, each with particles of its own. Each reactor's gas carries a
// mark for every reactor: after a part of a step they say what part of its mass was where at the beginning, and so how
// many of which particles are there now. Those that went from one reactor to another join the particles there.
//
// The step follows from what changes in it; a step in which more changes than twice the aim is taken back, unless
// numerical particles have gone at random in it.
//
// The gas may be given (GasAlong): species that are held are as its equations say, whatever particles exchange of them.
//
// Or by a predictor and a corrector, where the particles' species live shorter than the population changes: the gas
// reacts over the step together with the exchange that the step before leads to expect (ExchangeInGas), the particles
// change in the mean of this gas over the step, and the gas gets the difference of what they exchanged to what was
// expected. Of second order as well, and a step may be much longer than a species lives (after Celnik, Patterson,
// Kraft, Wagner 2009, who take the particles' rates at the beginning and at the end of a step).
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

namespace lampblack::coupling {

// Particles of some elements, such as carbon and hydrogen, that change in a given gas.
class SplitParticles {
 public:
  struct Exchange {
    std::vector<double> gas;       // mol/m3, of the species
    std::vector<double> elements;  // kg/m3, gained by the particles: the same atoms
  };
  virtual ~SplitParticles() = default;
  [[nodiscard]] virtual const std::vector<std::string>& elements() const { return sootElements(); }
  [[nodiscard]] static const std::vector<std::string>& sootElements();  // C, H
  // Where the gas's viscosity comes from, as they see it.
  [[nodiscard]] virtual GasViscosity viscosity() const { return GasViscosity::transport; }
  // Of the mechanism, in the order of the gas that `advance` is given.
  [[nodiscard]] virtual const std::vector<std::size_t>& species() const = 0;
  virtual Exchange advance(const ParticleGas& gas, double dt) = 0;
  // mol/m3/s, at which they gain of the i-th species now: of kinds that know it, and of species for which they do. What
  // the last step exchanged is expected of the next otherwise, with its noise.
  [[nodiscard]] virtual std::optional<double> rateOf(std::size_t, const ParticleGas&) const { return std::nullopt; }
  // Multiplies all amounts per volume.
  virtual void dilute(double factor) = 0;
  // What there is, as join() of others of the same kind takes it.
  [[nodiscard]] virtual std::vector<double> content() const = 0;
  // Particles of another reactor come in: `share` times its amounts per volume.
  virtual void join(std::span<const double> content, double share) = 0;
  // There are none, and none can be born of this gas.
  [[nodiscard]] virtual bool idle(const ParticleGas& gas) const = 0;
  // How many numerical particles have gone at random, to make room, since the beginning.
  [[nodiscard]] virtual std::uint64_t removals() const { return 0; }
  // All that a step may change, for one that is taken back.
  struct State {
    virtual ~State() = default;
  };
  [[nodiscard]] virtual std::unique_ptr<State> save() const = 0;
  virtual void restore(const State& state) = 0;

 protected:
  SplitParticles() = default;
  SplitParticles(const SplitParticles&) = default;
  SplitParticles& operator=(const SplitParticles&) = default;
};

// The state of particles that are packed in numbers.
struct PackedSplitState final : SplitParticles::State {
  explicit PackedSplitState(std::vector<double> packed) : values(std::move(packed)) {}
  std::vector<double> values;
};

class SplitReactor {
 public:
  // The gas's equations, which carry ParticlesAtRest, in the unknowns (Y, T, carbon, hydrogen, marks, ...) of each
  // reactor over time or place; functions of these of one reactor; and what is held, a value a reactor.
  struct Gas {
    OdeSystem* system = nullptr;
    // kg/m3 of gas and particles, and Pa, in the state y at x.
    std::function<double(double x, const double*y)> density, pressure;
    std::function<double(const double* y)> timePerUnit;  // s, of the independent variable
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
  // A step before which hardly anything changed is not prepared to be taken back, which would take the memory of all
  // particles again. Nor is one taken back in which numerical particles have gone at random: what they stood for is
  // right in the mean over all outcomes, not over those that change the gas little. Where such a step changes too much,
  // that is counted as `unchecked`.
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
