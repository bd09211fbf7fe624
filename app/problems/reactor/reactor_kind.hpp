// A kind of reactor behind one interface: what a run with it needs to know, whether the gas carries a model of
// particles or populations have repeats of it. Each kind is a class with what a deck says of it.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/problems/reactor/reactor_case.hpp"
#include "chemistry/reactor/closed_reactor.hpp"
#include "chemistry/reactor/ignition.hpp"
#include "chemistry/reactor/network_solver.hpp"
#include "chemistry/reactor/reactor_network.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "coupling/split_reactor.hpp"

namespace lampblack::app {

class ReactorDriver;

// The equations of the gas of one repeat, beside populations.
struct RepeatGas {
  std::shared_ptr<void> equations;  // that the others refer to
  SplitReactor::Gas gas;
  std::vector<double> start;
  // s, where the unknowns are y at x
  std::function<double(double x, std::span<const double> y)> time = [](double x, std::span<const double>) { return x; };
};

class ReactorKind {
 public:
  virtual ~ReactorKind() = default;

  // Runs it without a population. Both have to live as long.
  [[nodiscard]] virtual std::unique_ptr<ReactorDriver> driver(const ReactorCase& reactorCase) const = 0;
  // With the phase that it carries; `population`: the first one, which may have been elsewhere before; null: none.
  [[nodiscard]] virtual RepeatGas repeatGas(const ReactorCase& reactorCase, ParticlesAtRest& carried,
                                            SplitParticles* population) const = 0;
  // InputError where it can have no population, or not in the way of the deck.
  virtual void checkPopulation(const Deck& /*deck*/) const {}

  // The number of reactors, and of the names of a reactor's columns.
  [[nodiscard]] virtual std::size_t reactors() const { return 1; }
  [[nodiscard]] virtual std::string prefix(std::size_t /*reactor*/) const { return ""; }
  // s, of a plug flow m.
  [[nodiscard]] virtual double begin() const { return 0; }
  [[nodiscard]] virtual double end() const = 0;
  // Where rows have to be; empty: at regular places.
  [[nodiscard]] virtual std::vector<double> rows() const { return {}; }
  // Of the place and what goes with it, which rows begin with.
  [[nodiscard]] virtual std::vector<Quantity> placeColumns() const { return {{"time", "s", "time"}}; }
  [[nodiscard]] virtual std::string intervalKey() const { return "output.interval"; }

  // What flows through it; null: nothing.
  [[nodiscard]] virtual const ReactorNetwork* network() const { return nullptr; }
  // The state that stirred reactors begin with, where it is given.
  [[nodiscard]] virtual const GasState* givenStart() const { return nullptr; }
  // Whether the temperature of all of it is given, apart from a profile; whether the gas itself is.
  [[nodiscard]] virtual bool hasGivenTemperature() const { return false; }
  [[nodiscard]] virtual bool isGiven() const { return false; }

 protected:
  ReactorKind() = default;
  ReactorKind(const ReactorKind&) = default;
  ReactorKind& operator=(const ReactorKind&) = default;
};

struct ClosedKind final : ReactorKind {
  ReactorSystem::Held held = ReactorSystem::Held::Pressure;
  GasState initial;
  std::optional<VolumeLaw> volume;
  std::optional<double> startAngle, angularSpeed;  // rad after top dead centre, rad/s, of a piston
  double ignitionFrom = 0;                         // s, what delays count from
  double duration = 0;                             // s
  std::vector<IgnitionCriterion> ignition;
  std::vector<std::size_t> sensitivities;  // reactions

  [[nodiscard]] std::unique_ptr<ReactorDriver> driver(const ReactorCase& reactorCase) const override;
  [[nodiscard]] RepeatGas repeatGas(const ReactorCase& reactorCase, ParticlesAtRest& carried,
                                    SplitParticles* population) const override;
  void checkPopulation(const Deck& deck) const override;
  [[nodiscard]] double end() const override { return duration; }
};

// One or a network.
struct StirredKind final : ReactorKind {
  ReactorNetwork vessels;
  NetworkStart start;
  double duration = 0;  // s of a transient, 0 where the steady state is wanted
  bool isNetwork = false;

  [[nodiscard]] std::unique_ptr<ReactorDriver> driver(const ReactorCase& reactorCase) const override;
  [[nodiscard]] RepeatGas repeatGas(const ReactorCase& reactorCase, ParticlesAtRest& carried,
                                    SplitParticles* population) const override;
  void checkPopulation(const Deck& deck) const override;
  [[nodiscard]] std::size_t reactors() const override { return vessels.reactors.size(); }
  [[nodiscard]] std::string prefix(std::size_t reactor) const override {
    return isNetwork ? vessels.reactors[reactor].name + "_" : "";
  }
  [[nodiscard]] double end() const override { return duration; }
  [[nodiscard]] const ReactorNetwork* network() const override { return &vessels; }
  [[nodiscard]] const GasState* givenStart() const override { return start.given ? &*start.given : nullptr; }
  [[nodiscard]] bool hasGivenTemperature() const override;
};

// With a stirred reactor before the duct, `inlet` is what flows into that one; populations have `upstreamTime` (s) in
// it.
struct PlugFlowKind final : ReactorKind {
  std::optional<ReactorNetwork> upstream;
  double upstreamTime = 0;
  GasState inlet;
  double massFlux = 0, length = 0;  // kg/m2/s, m

  [[nodiscard]] std::unique_ptr<ReactorDriver> driver(const ReactorCase& reactorCase) const override;
  [[nodiscard]] RepeatGas repeatGas(const ReactorCase& reactorCase, ParticlesAtRest& carried,
                                    SplitParticles* population) const override;
  [[nodiscard]] double end() const override { return length; }
  [[nodiscard]] std::vector<Quantity> placeColumns() const override;
  [[nodiscard]] std::string intervalKey() const override { return "output.spacing"; }
};

}  // namespace lampblack::app
