// A flow that is given, with smooth variables of a turbulence model in it and the sources that these leave over: a
// stream between a plane of symmetry, or an axis, and a side through which more gas comes in. Strain, density and the
// distance from walls change along and across it; about an axis the gas moves outwards or inwards and the hoop has
// strain.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "../flow/flow_fixture.hpp"
#include "flow/models/turbulence/turbulence_model.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

using Tensor = std::array<Vector3, 3>;

// A variable that makes nothing of itself: what convection and diffusion alone err by.
struct Passive {
  static constexpr bool needsWallDistance = false, needsStrainGradient = false;
  const char* called;
  double diffusivity;  // m^2/s
  [[nodiscard]] std::string name() const { return called; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return {{called, "m^2/s", "", 1.0}}; }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const { return {stream.eddyViscosity}; }
  [[nodiscard]] TurbulentRates at(const TurbulentCell&) const { return {.diffusivity = {diffusivity}}; }
};

// By the name of a row of turbulenceModels(), or of the two that make nothing.
inline std::shared_ptr<const TurbulenceModel> manufacturedModel(const std::string& name) {
  for (const Passive& passive : {Passive{"mixed", 3.2e-4}, Passive{"hardly_mixed", 3.2e-6}})
    if (name == passive.called) return std::make_shared<PointwiseModel<Passive>>(passive);
  return turbulenceModel(name);
}

struct ManufacturedTurbulence {
  using Values = std::array<double, TurbulentCell::most>;
  static constexpr double length = 0.05, cold = 300.0;  // m, of a side; K
  // A value with its first and second derivatives, or its gradient.
  struct Profile {
    double value, slope, bend;
  };
  struct Field {
    double value;
    Vector3 gradient;
  };

  std::shared_ptr<const TurbulenceModel> model;
  Geometry geometry;
  double hotter;  // of the temperature, by how much of itself it rises
  Gas& gas;
  Values least{}, rise{};
  double coldDensity;  // kg/m^3

  ManufacturedTurbulence(const std::string& name, Geometry geometryOfIt, bool isHeated, Gas& gasOfIt)
      : model(manufacturedModel(name)), geometry(geometryOfIt), hotter(isHeated ? 0.6 : 0.0), gas(gasOfIt) {
    coldDensity = density(cold);
    const std::string last = model->variables().back().name;
    const double nu = viscosity(cold) / coldDensity;
    if (last == "omega_root")
      least = {0.02, 0.09}, rise = {0.02, 0.03};
    else if (last == "turbulent_dissipation")
      least = {0.02, 0.2}, rise = {0.02, 0.2};
    else
      least = {15.0 * nu}, rise = {15.0 * nu};
  }

  [[nodiscard]] double density(double temperature) const {  // kg/m^3
    return gas.thermo.density(temperature, constants::oneAtmosphere, std::array{1.0});
  }
  [[nodiscard]] double viscosity(double temperature) const {  // Pa s
    std::array<double, 1> D;
    return gas.transport.mixture(temperature, constants::oneAtmosphere, std::array{1.0}, D).viscosity;
  }
  [[nodiscard]] Field temperature(const Vector3& x) const {
    constexpr double wave = std::numbers::pi / length;
    const double across = 0.5 * (1.0 - std::cos(wave * x[0])), along = 0.7 + 0.3 * std::cos(wave * x[1]);
    return {cold * (1.0 + hotter * across * along),
            {cold * hotter * 0.5 * wave * std::sin(wave * x[0]) * along,
             -cold * hotter * across * 0.3 * wave * std::sin(wave * x[1]), 0.0}};
  }

  // The stream function (kg/s per metre or radian) is -rho_cold x^n/n F(x) G(y) m/s, n = 1 in a plane and 2 about an
  // axis.
  [[nodiscard]] double power() const { return geometry == Geometry::Axisymmetric ? 2.0 : 1.0; }
  static Profile across(double x) {  // F
    constexpr double share = 0.3 / (length * length);
    return {1.0 + share * x * x, 2.0 * share * x, 2.0 * share};
  }
  static Profile along(double y) {  // G
    const double t = 2.0 * y / length;
    return {1.0 + 0.25 * t + 0.2 * std::sin(t), (0.5 + 0.4 * std::cos(t)) / length,
            -0.8 * std::sin(t) / (length * length)};
  }
  [[nodiscard]] double streamFunction(const Vector3& x) const {
    return -coldDensity * std::pow(x[0], power()) / power() * across(x[0]).value * along(x[1]).value;
  }
  [[nodiscard]] Vector3 velocity(const Vector3& x) const {
    const Profile F = across(x[0]), G = along(x[1]);
    const double n = power(), share = coldDensity / density(temperature(x).value);
    return {-share * x[0] / n * F.value * G.slope, share * (F.value + x[0] / n * F.slope) * G.value, 0.0};
  }
  // du_i/dx_j, 1/s; in the third place the hoop's.
  [[nodiscard]] Tensor velocityGradient(const Vector3& x) const {
    const Profile F = across(x[0]), G = along(x[1]);
    const Field T = temperature(x);
    const Vector3 u = velocity(x);
    const double n = power(), share = coldDensity / density(T.value);
    Tensor slope{};
    slope[0] = {-share / n * (F.value + x[0] * F.slope) * G.slope, -share * x[0] / n * F.value * G.bend, 0.0};
    slope[1] = {share * ((n + 1.0) * F.slope + x[0] * F.bend) / n * G.value,
                share * (F.value + x[0] / n * F.slope) * G.slope, 0.0};
    for (const std::size_t i : {0U, 1U})
      for (const std::size_t j : {0U, 1U}) slope[i][j] += u[i] * T.gradient[j] / T.value;
    if (geometry == Geometry::Axisymmetric) slope[2][2] = -share / n * F.value * G.slope;
    return slope;
  }

  // Strain, vorticity and their like of a cell there.
  void setShear(const Vector3& x, TurbulentCell& cell) const {
    const Tensor slope = velocityGradient(x);
    cell.dilatation = slope[0][0] + slope[1][1] + slope[2][2];
    Tensor S{}, W{};
    double squares = 0.0, turns = 0.0, cubes = 0.0, stretching = 0.0;
    const auto overAll = [](const auto& add) {
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          for (std::size_t k = 0; k < 3; ++k) add(i, j, k);
    };
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        S[i][j] = 0.5 * (slope[i][j] + slope[j][i]) - (i == j ? cell.dilatation / 3.0 : 0.0);
        W[i][j] = 0.5 * (slope[i][j] - slope[j][i]);
        squares += S[i][j] * S[i][j];
        turns += W[i][j] * W[i][j];
      }
    overAll([&](auto i, auto j, auto k) { cubes += S[i][j] * S[j][k] * S[k][i]; });
    // Without half of the dilatation in place of a third of it: W_ij W_jk sums to -2 W_12^2 over i = k.
    overAll([&](auto i, auto j, auto k) {
      stretching += W[i][j] * W[j][k] * (S[k][i] - (k == i ? cell.dilatation / 6.0 : 0.0));
    });
    cell.strain = std::sqrt(2.0 * squares);
    cell.vorticity = std::sqrt(2.0 * turns);
    cell.strainShape = cubes / std::pow(squares, 1.5);
    cell.stretching = std::abs(stretching);
  }
  [[nodiscard]] double strain(const Vector3& x) const {
    TurbulentCell cell;
    setShear(x, cell);
    return cell.strain;
  }
  static double wallDistance(const Vector3& x) { return 0.01 + 2.0 * x[0] + 0.5 * x[1]; }

  // No slope at the axis, nor where the gas leaves.
  [[nodiscard]] Field variable(std::size_t v, const Vector3& x) const {
    constexpr double wave = std::numbers::pi / length;
    const double s = (v == 0 ? 0.9 : 0.6) * wave, t = (v == 0 ? 1.0 : 2.0) * wave;
    const double ofX = 0.5 * (1.0 + std::cos(s * x[0])), ofY = 0.6 - 0.4 * std::cos(t * x[1]);
    return {least[v] + rise[v] * ofX * ofY,
            {-0.5 * rise[v] * s * std::sin(s * x[0]) * ofY, 0.4 * rise[v] * ofX * t * std::sin(t * x[1]), 0.0}};
  }
  [[nodiscard]] Values values(const Vector3& x) const {
    Values found{};
    for (std::size_t v = 0; v < model->variables().size(); ++v) found[v] = variable(v, x).value;
    return found;
  }

  [[nodiscard]] TurbulentCell at(const Vector3& x) const {
    TurbulentCell cell;
    setShear(x, cell);
    const Field T = temperature(x);
    cell.distance = wallDistance(x);
    cell.viscosity = viscosity(T.value) / density(T.value);
    cell.densityGradient = scaled(T.gradient, -1.0 / T.value);
    for (std::size_t v = 0; v < model->variables().size(); ++v) {
      cell.values[v] = variable(v, x).value;
      cell.gradients[v] = variable(v, x).gradient;
    }
    if (!model->needsStrainGradient()) return cell;
    constexpr double small = 1e-3 * length;
    for (const std::size_t axis : {0U, 1U}) {
      Vector3 before = x, after = x;
      before[axis] -= small;
      after[axis] += small;
      const double low = strain(before) / cell.strain, high = strain(after) / cell.strain;
      cell.strainSlope[axis] = (high - low) / (2.0 * small);
      cell.strainBend += (high - 2.0 + low) / (small * small);
    }
    if (geometry == Geometry::Axisymmetric) cell.strainBend += cell.strainSlope[0] / x[0];
    return cell;
  }
  [[nodiscard]] TurbulentRates rates(const TurbulentCell& cell) const {
    std::array<TurbulentRates, 1> found;
    model->evaluate({&cell, 1}, found);
    return found[0];
  }

  // Per m^3 and s, by which the variables stay as they are: rho u . grad q - div(rho D grad q) - rho rates.
  [[nodiscard]] Values source(const Vector3& x) const {
    constexpr double small = 1e-4 * length;
    const TurbulentCell cell = at(x);
    const TurbulentRates made = rates(cell);
    const Vector3 u = velocity(x);
    const double rho = density(temperature(x).value);
    const std::size_t count = model->variables().size();
    Values found{};
    for (std::size_t v = 0; v < count; ++v)
      found[v] = rho * (dot(u, cell.gradients[v]) - made.source[v] + made.sink[v] * cell.values[v]);
    for (const std::size_t axis : {0U, 1U})
      for (const double sign : {-1.0, 1.0}) {
        Vector3 beside = x;
        beside[axis] += sign * small;
        const TurbulentCell there = at(beside);
        const TurbulentRates of = rates(there);
        const double metric = density(temperature(beside).value) * std::pow(beside[0] / x[0], power() - 1.0);
        for (std::size_t v = 0; v < count; ++v)
          found[v] -= sign * metric * of.diffusivity[v] * there.gradients[v][axis] / (2.0 * small);
      }
    return found;
  }
};

}  // namespace lampblack::test
