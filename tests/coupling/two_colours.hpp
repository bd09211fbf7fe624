// A toy kind of stochastic particles: spheres of carbon, red or blue, that take up acetylene and give back hydrogen.
// Nothing of it is known outside of this file.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/constants.hpp"
#include "core/packed_doubles.hpp"
#include "particles/stochastic/stochastic_population.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

class TwoColours final : public StochasticPopulation {
 public:
  static constexpr double red = 0.0, blue = 1.0;
  struct Particle {
    double carbon = 0, number = 0;  // kg, 1/m3
    double colour = red;
  };
  static constexpr double density = 1800.0;

  // Four red and eight blue.
  static constexpr double carbonAtStart = 1e-20, eachNumber = 2e15;
  [[nodiscard]] static std::vector<Particle> someParticles() {
    std::vector<Particle> all;
    for (int k = 0; k < 12; ++k) all.push_back({carbonAtStart, eachNumber, k < 4 ? red : blue});
    return all;
  }
  [[nodiscard]] static std::unique_ptr<TwoColours> some(const Mechanism& mechanism, double uptake) {
    return std::make_unique<TwoColours>(mechanism, uptake, someParticles());
  }

  // A red particle takes up `uptake` (m3/s) times the concentration of acetylene, a blue one a third of it.
  TwoColours(const Mechanism& mechanism, double uptake, std::vector<Particle> start = {})
      : StochasticPopulation({"paint",
                              {mechanism.speciesIndex("C2H2"), mechanism.speciesIndex("H2")},
                              {"C"},
                              {SootAggregate(density, SootShape::spheres), {headLength, true}}}),
        uptake_(uptake),
        perMole_(2.0 * mechanism.atomicWeight(mechanism.elementIndex("C"))),
        particles_(std::move(start)) {}

  [[nodiscard]] double absorption(double, double) const override { return 0.0; }
  [[nodiscard]] bool hasPrecursors(const ParticleGas&) const override { return false; }
  // In a gas that stays as it is.
  void advance(const ParticleGas& gas, double dt) override {
    double all = 0.0;
    for (const Particle& p : particles_) all += p.number * uptakeOf(p);
    const double taken = gas.concentrations[0] * all * dt;
    for (Particle& p : particles_) p.carbon += perMole_ * gas.concentrations[0] * uptakeOf(p) * dt;
    taken_ += taken;
    cost_ = static_cast<double>(particles_.size());
  }
  Exchange takeExchange() override {
    const double taken = std::exchange(taken_, 0.0);
    return {{-taken, taken}, {perMole_ * taken}};
  }
  [[nodiscard]] std::vector<double> resampled() const override { return {0.0}; }
  void dilute(double factor) override {
    for (Particle& p : particles_) p.number *= factor;
  }
  [[nodiscard]] std::size_t size() const override { return particles_.size(); }
  [[nodiscard]] std::uint64_t removals() const override { return 0; }
  [[nodiscard]] double cost() const override { return cost_; }
  [[nodiscard]] double costPerParticle() const override { return 0.01; }

  [[nodiscard]] std::vector<double> pack() const override { return packed(particles_, owner_); }
  [[nodiscard]] static std::vector<double> packed(std::span<const Particle> particles, const PackedOwner& owner) {
    std::vector<double> state(packedOwnerAt, 0.0);
    packDoubles(state, owner);
    for (const Particle& p : particles) packDoubles(state, rowOf(p));
    return state;
  }
  void unpack(std::span<const double> state) override {
    owner_ = {state[packedOwnerAt], state[packedOwnerAt + 1]};
    particles_.clear();
    join(rows().of(state), 1.0);
  }
  [[nodiscard]] std::vector<double> content() override {
    const std::vector<double> state = pack();
    const auto all = rows().of(state);
    return {all.begin(), all.end()};
  }
  void join(std::span<const double> rows, double share) override {
    this->rows().forEach(rows, [&](const double* row) {
      particles_.push_back({row[0], share * row[packedNumberAt], colourOf(row)});
    });
  }
  void addAmounts(const double* row, double number, std::span<double> amounts) const override {
    const AmountsOfParticles at{1};
    const double d = diameterOf(row[0]);
    amounts[AmountsOfParticles::number] += number;
    amounts[at.element(0)] += number * row[0];
    amounts[at.primaries()] += number;
    amounts[at.surface()] += number * constants::pi * d * d;
    amounts[at.diameters()] += number * d;
  }

  [[nodiscard]] std::vector<Quantity> columns() const override {
    return {{"paint_volume_fraction", "1", "volume"},
            {"paint_number_density", "1/m^3", "number"},
            {"paint_mean_diameter", "m", "of the sphere of mean volume"},
            {"paint_uptake", "mol/m^3/s", "of acetylene"}};
  }
  [[nodiscard]] std::vector<double> values(const ParticleGas& gas) const override {
    double number = 0.0, mass = 0.0, all = 0.0;
    for (const Particle& p : particles_) {
      number += p.number;
      mass += p.number * p.carbon;
      all += p.number * uptakeOf(p);
    }
    return {mass / density, number, number > 0.0 ? diameterOf(mass / number) : 0.0, gas.concentrations[0] * all};
  }
  [[nodiscard]] std::vector<std::pair<std::string, double>> counts() const override {
    double number = 0.0;
    for (const Particle& p : particles_) number += p.number;
    return {{"particles_in_a_cubic_centimetre", 1e-6 * number}};
  }
  [[nodiscard]] std::vector<ParticleFunctional> functionals() const override {
    using Use = ParticleFunctional::Use;
    return {{{"sphere_diameter", "m", "diameter"}, Use::size},
            {{"shade", "1", "0 red, 1 blue"}, Use::share, true},
            {{"carbon", "kg", "carbon"}}};
  }
  [[nodiscard]] double functional(std::size_t which, const double* row) const override {
    return std::array{diameterOf(row[0]), colourOf(row), row[0]}[which];
  }
  void forEachRow(const std::function<void(const double* row)>& f) const override {
    for (const Particle& p : particles_) f(rowOf(p).data());
  }
  [[nodiscard]] static double colourOf(const double* row) { return row[packedParticle + 1]; }

 private:
  static constexpr std::size_t headLength = packedOwnerAt + 2, rowLength = packedParticle + 2;
  [[nodiscard]] double uptakeOf(const Particle& p) const { return p.colour == red ? uptake_ : uptake_ / 3.0; }
  [[nodiscard]] static double diameterOf(double carbon) { return std::cbrt(6.0 / constants::pi * carbon / density); }
  [[nodiscard]] static std::array<double, rowLength> rowOf(const Particle& p) {
    return {p.carbon, 0.0, 1.0, p.number, static_cast<double>(rowLength), p.colour};
  }

  double uptake_, perMole_;
  std::vector<Particle> particles_;
  PackedOwner owner_{};
  double taken_ = 0.0, cost_ = 0.0;
};

}  // namespace lampblack::test
