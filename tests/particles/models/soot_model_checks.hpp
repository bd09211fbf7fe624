// What every soot model is held to, on random states from empty to dense: elements are conserved to round-off, nothing
// becomes negative at zero, and the Jacobian is the derivative.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/constants.hpp"
#include "particles/models/soot_model.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// Atoms of C, H and O.
using Atoms = std::array<double, 3>;

inline const std::map<std::string, Atoms>& atomsOfSpecies() {
  static const std::map<std::string, Atoms> table{
      {"H", {0, 1, 0}},   {"H2", {0, 2, 0}},   {"OH", {0, 1, 1}},   {"H2O", {0, 2, 1}},  {"O", {0, 0, 1}},
      {"O2", {0, 0, 2}},  {"CO", {1, 0, 1}},   {"C2H2", {2, 2, 0}}, {"C6H6", {6, 6, 0}}, {"A1", {6, 6, 0}},
      {"A2", {10, 8, 0}}, {"A3", {14, 10, 0}}, {"A4", {16, 10, 0}}};
  return table;
}

struct ModelWeights {
  double carbon = 12.011e-3, hydrogen = 1.008e-3;  // kg/mol
};

// Everything a model is given at a point.
struct ModelState {
  ParticleGas gas;
  std::vector<double> concentrations, densities;
  void connect() { gas.concentrations = concentrations; }
};

// A sooting gas with every species present, and soot from none to dense.
class RandomStates {
 public:
  explicit RandomStates(unsigned seed) : random_(seed) {}

  ModelState next(const SootModel& model) {
    ModelState s;
    s.gas.temperature = 400 + 2100 * uniform();
    s.gas.pressure = constants::oneAtmosphere * std::pow(10, uniform());
    s.gas.meanMolecularWeight = 0.02 + 0.01 * uniform();
    s.gas.density = s.gas.pressure * s.gas.meanMolecularWeight / (constants::gasConstant * s.gas.temperature);
    s.gas.viscosity = 1.8e-5 * std::pow(s.gas.temperature / 300, 0.7);
    const double total = s.gas.pressure / (constants::gasConstant * s.gas.temperature);
    for (std::size_t i = 0; i < model.gasSpecies().size(); ++i)
      s.concentrations.push_back(total * std::pow(10, -1 - 11 * uniform()));
    const double amount = std::pow(10, 4 - 16 * uniform());
    for (const ParticleScalar& scalar : model.scalars())
      s.densities.push_back(amount * scalar.scale * std::pow(10, 2 * uniform() - 1));
    return s;
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  std::mt19937_64 random_;
};

// kg/m3/s of C and H and mol/m3/s of O that appear from nowhere, over the sum of what moves.
inline Atoms imbalance(const SootModel& model, const ModelState& s, const ModelWeights& weights = {}) {
  const std::size_t n = model.scalars().size(), m = model.gasSpecies().size();
  std::vector<double> rates(n), exchange(m);
  ParticleGas gas = s.gas;
  gas.concentrations = s.concentrations;
  model.sources(gas, s.densities, rates, exchange);
  Atoms sum{}, moved{};
  const auto add = [&](std::size_t e, double amount) {
    sum[e] += amount;
    moved[e] += std::abs(amount);
  };
  for (std::size_t i = 0; i < n; ++i) {
    add(0, rates[i] * model.scalars()[i].massOf("C") / weights.carbon);
    add(1, rates[i] * model.scalars()[i].massOf("H") / weights.hydrogen);
  }
  for (std::size_t i = 0; i < m; ++i) {
    const Atoms& atoms = atomsOfSpecies().at(model.gasSpecies()[i]);
    for (std::size_t e = 0; e < 3; ++e) add(e, atoms[e] * exchange[i]);
  }
  for (std::size_t e = 0; e < 3; ++e) sum[e] = moved[e] > 0 ? std::abs(sum[e]) / moved[e] : 0;
  return sum;
}

// `tolerance`: of the sum of some hundred rounded terms for models of many scalars, of ten for others.
inline void expectConserved(const SootModel& model, unsigned seed, double tolerance = 1e-14) {
  RandomStates states(seed);
  for (int i = 0; i < 300; ++i) {
    ModelState s = states.next(model);
    if (i % 10 == 1) std::fill(s.densities.begin(), s.densities.end(), 0.0);
    if (i % 10 == 2) s.densities[static_cast<std::size_t>(i) % s.densities.size()] *= -1;
    if (i % 10 == 3) s.concentrations[static_cast<std::size_t>(i) % s.concentrations.size()] *= -1;
    const Atoms lost = imbalance(model, s);
    for (std::size_t e = 0; e < 3; ++e) ASSERT_LE(lost[e], tolerance) << "state " << i << ", element " << e;
  }
}

// Where a scalar or a species is zero or below, nothing takes from it.
inline void expectNothingTakenFromZero(const SootModel& model, unsigned seed) {
  RandomStates states(seed);
  const std::size_t n = model.scalars().size(), m = model.gasSpecies().size();
  std::vector<double> rates(n), exchange(m);
  for (int i = 0; i < 200; ++i) {
    for (std::size_t j = 0; j < n + m; ++j) {
      ModelState s = states.next(model);
      (j < n ? s.densities[j] : s.concentrations[j - n]) = i % 2 == 0 ? 0.0 : -1e-6;
      s.connect();
      model.sources(s.gas, s.densities, rates, exchange);
      for (double r : rates) ASSERT_TRUE(std::isfinite(r));
      for (double r : exchange) ASSERT_TRUE(std::isfinite(r));
      if (j < n)
        ASSERT_GE(rates[j], 0) << model.scalars()[j].name;
      else
        ASSERT_GE(exchange[j - n], 0) << model.gasSpecies()[j - n];
    }
  }
}

// The Jacobian against central differences, whose error is some 1e-8 (step 1e-4 of the state, third derivatives of
// order one) and that of the default differences 1e-6. In scaled variables; entries count against the largest of their
// row. Values below 1e-4 of typical ones are left out: there the default takes longer steps.
inline void expectJacobian(const SootModel& model, unsigned seed, double tolerance) {
  RandomStates states(seed);
  const std::size_t n = model.scalars().size(), m = model.gasSpecies().size(), rows = n + m, columns = rows + 1;
  std::vector<double> values(rows * columns), up(rows), down(rows);
  for (int i = 0; i < 30; ++i) {
    ModelState s = states.next(model);
    s.connect();
    model.jacobian(s.gas, s.densities, values);
    std::vector<double> entry(rows * columns), reference(rows * columns);
    for (std::size_t j = 0; j < columns; ++j) {
      ModelState t = s;
      t.connect();
      double& x = j < n ? t.densities[j] : j < rows ? t.concentrations[j - n] : t.gas.temperature;
      const double centre = x, h = 1e-4 * centre;
      x = centre + h;
      model.sources(t.gas, t.densities, {up.data(), n}, {up.data() + n, m});
      x = centre - h;
      model.sources(t.gas, t.densities, {down.data(), n}, {down.data() + n, m});
      for (std::size_t r = 0; r < rows; ++r) {
        reference[r * columns + j] = (up[r] - down[r]) / (2 * h) * centre;
        entry[r * columns + j] = values[r * columns + j] * centre;
      }
    }
    const double total = s.gas.pressure / (constants::gasConstant * s.gas.temperature);
    const auto small = [&](std::size_t j) {
      if (j < n) return s.densities[j] < 1e-4 * model.scalars()[j].scale * s.gas.density;
      return j < rows && s.concentrations[j - n] < 1e-4 * total;
    };
    for (std::size_t r = 0; r < rows; ++r) {
      double largest = 0;
      for (std::size_t j = 0; j < columns; ++j) largest = std::max(largest, std::abs(reference[r * columns + j]));
      for (std::size_t j = 0; j < columns; ++j)
        if (!small(j)) {
          ASSERT_NEAR(entry[r * columns + j], reference[r * columns + j], tolerance * largest)
              << "state " << i << ", row " << r << ", column " << j;
        }
    }
  }
}

}  // namespace lampblack::test
