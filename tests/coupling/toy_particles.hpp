// Particles that take up acetylene whole: w = A exp(-B/T) c (1 + b n) mol/m3/s of it, n the particles' carbon in kg/m3.
// Once as a phase in the equations of a reactor, with the derivatives written out, and once for splitting, by the
// closed solution in a gas that does not change.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/closed_reactor.hpp"
#include "chemistry/reactor/stiff_integrator.hpp"
#include "coupling/split_reactor.hpp"
#include "particles/models/soot_model.hpp"
#include "tests/every_module.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::test {

struct Toy {
  std::size_t acetylene = 0;                    // species
  double A = 0, B = 0;                          // 1/s, K
  double b = 0;                                 // m3/kg
  double carbonWeight = 0, hydrogenWeight = 0;  // kg/mol

  Toy(const Mechanism& mechanism, double rate, double temperature, double growth)
      : acetylene(mechanism.speciesIndex("C2H2")),
        A(rate),
        B(temperature),
        b(growth),
        carbonWeight(mechanism.atomicWeight(mechanism.elementIndex("C"))),
        hydrogenWeight(mechanism.atomicWeight(mechanism.elementIndex("H"))) {}
  [[nodiscard]] double k(double T) const { return A * std::exp(-B / T); }
};

class ToyPhase final : public CarriedPhase {
 public:
  explicit ToyPhase(const Toy& toy) : toy_(toy), species_{toy.acetylene} {}
  static constexpr double unit = 1e-3;  // kg

  [[nodiscard]] std::size_t size() const override { return 2; }
  [[nodiscard]] const std::vector<std::size_t>& exchanged() const override { return species_; }
  void sources(double T, double, std::span<const double> c, std::span<const double> n, std::span<double> rates,
               std::span<double> exchange) override {
    const double w = toy_.k(T) * c[toy_.acetylene] * (1 + toy_.b * unit * n[0]);
    rates[0] = 2 * toy_.carbonWeight * w / unit;
    rates[1] = 2 * toy_.hydrogenWeight * w / unit;
    exchange[0] = -w;
  }
  void jacobian(double T, double, std::span<const double> c, std::span<const double> n,
                std::span<double> values) override {
    const double grown = 1 + toy_.b * unit * n[0], k = toy_.k(T), x = c[toy_.acetylene];
    const double slopes[4] = {k * x * toy_.b * unit, 0, k * grown, k * x * grown * toy_.B / (T * T)};
    const double rows[3] = {2 * toy_.carbonWeight / unit, 2 * toy_.hydrogenWeight / unit, -1};
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t s = 0; s < 4; ++s) values[4 * r + s] = rows[r] * slopes[s];
  }
  void enthalpies(double T, std::span<double> h, std::span<double> slope) override {
    std::tie(h[0], slope[0]) = sootCarbonEnthalpy(T);
    std::tie(h[1], slope[1]) = sootHydrogenEnthalpy(T);
    for (std::size_t s = 0; s < 2; ++s) {
      h[s] *= unit;
      slope[s] *= unit;
    }
  }

 private:
  Toy toy_;
  std::vector<std::size_t> species_;
};

class ToySplit final : public SplitParticles {
 public:
  explicit ToySplit(const Toy& toy) : toy_(toy), species_{toy.acetylene} {}
  [[nodiscard]] const std::vector<std::size_t>& species() const override { return species_; }
  Exchange advance(const ParticleGas& gas, double dt) override {
    const double faster = carbon > burstAt ? 30 : 1;
    const double rate = faster * 2 * toy_.carbonWeight * toy_.k(gas.temperature) * gas.concentrations[0];
    const double gained = toy_.b > 0 ? (carbon + 1 / toy_.b) * std::expm1(rate * toy_.b * dt) : rate * dt;
    const double moles = gained / (2 * toy_.carbonWeight);
    carbon += gained;
    if (losesSome) ++lost;
    return {{-moles}, {gained, 2 * toy_.hydrogenWeight * moles}};
  }
  [[nodiscard]] std::optional<double> rateOf(std::size_t, const ParticleGas& gas) const override {
    if (!knowsItsRate) return std::nullopt;
    return -toy_.k(gas.temperature) * gas.concentrations[0] * (1 + toy_.b * carbon);
  }
  void dilute(double factor) override { carbon *= factor; }
  [[nodiscard]] std::vector<double> content() const override { return {carbon}; }
  void join(std::span<const double> content, double share) override { carbon += share * content[0]; }
  [[nodiscard]] std::uint64_t removals() const override { return lost; }
  [[nodiscard]] bool idle(const ParticleGas&) const override { return isIdle; }
  [[nodiscard]] std::unique_ptr<State> save() const override {
    auto saved = std::make_unique<Saved>();
    saved->carbon = carbon;
    return saved;
  }
  void restore(const State& state) override { carbon = dynamic_cast<const Saved&>(state).carbon; }

  double carbon = 0;  // kg/m3
  bool knowsItsRate = false;
  double burstAt = INFINITY;  // kg/m3, from where on they grow 30 times as fast
  bool isIdle = false;        // as if there were none
  bool losesSome = false;     // numerical particles, in each step
  std::uint64_t lost = 0;

 private:
  struct Saved final : State {
    double carbon = 0;
  };
  Toy toy_;
  std::vector<std::size_t> species_;
};

inline const Mechanism& ethylene() {
  static const Mechanism mechanism = Mechanism::fromFile(sourcePath("cases/mechanisms/ethylene_abf2000_101.yaml"));
  return mechanism;
}

inline GasState gasOf(const Mechanism& mechanism, double T, const std::string& moleFractions) {
  GasState state{T, 101325, std::vector<double>(mechanism.numSpecies())};
  Thermo(mechanism).moleToMass(parseComposition(mechanism, moleFractions), state.Y);
  return state;
}

// To `end`, by the stiff solver alone.
inline std::vector<double> integrated(OdeSystem& system, std::span<const double> start, double end, double tolerance) {
  StiffIntegrator integrator(system, {tolerance, 1e-6 * tolerance, 0, 1000000});
  integrator.start(0, start, end);
  while (integrator.time() < end) integrator.step();
  return {integrator.state().begin(), integrator.state().end()};
}

}  // namespace lampblack::test
