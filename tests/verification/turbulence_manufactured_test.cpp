// Manufactured solutions of the equations of each turbulence model: a parallel stream with shear that varies across it,
// whose velocity eddies are kept from changing, smooth variables that are given, and the sources that these leave over.
// What is tested is all between a model's rates in a cell and the solution: gradients, products of them, strain, wall
// distance, diffusivities at faces, convection and diffusion together.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "flow/models/turbulence/turbulence_operator.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_exact.hpp"
#include "tests/effort.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

using Values = std::array<double, TurbulentCell::most>;

// A model whose eddies have no part in the momentum, and whose walls are not met.
class WithoutMomentum : public TurbulenceModel {
 public:
  explicit WithoutMomentum(const std::string& name) : model_(turbulenceModel(name)) {}
  [[nodiscard]] std::string name() const override { return model_->name(); }
  [[nodiscard]] std::vector<Variable> variables() const override { return model_->variables(); }
  [[nodiscard]] bool needsWallDistance() const override { return model_->needsWallDistance(); }
  [[nodiscard]] bool needsStrainGradient() const override { return model_->needsStrainGradient(); }
  [[nodiscard]] std::optional<double> dissipation(std::span<const double> variables) const override {
    return model_->dissipation(variables);
  }
  [[nodiscard]] Values freeStream(const FreeStream& stream) const override { return model_->freeStream(stream); }
  void evaluate(std::span<const TurbulentCell> cells, std::span<TurbulentRates> rates) const override {
    model_->evaluate(cells, rates);
    for (TurbulentRates& of : rates) of.eddyViscosity = 0.0;
  }

 private:
  std::shared_ptr<const TurbulenceModel> model_;
};

// Along y: V(x) = 1 + 20 x + 200 x^2 m/s, in a square.
struct ShearedStream {
  static constexpr double length = 0.05, nearest = 0.01;  // m
  std::shared_ptr<const TurbulenceModel> model;
  double viscosity;  // m^2/s
  Values least{}, rise{};

  ShearedStream(const std::string& name, double nu) : model(std::make_shared<WithoutMomentum>(name)), viscosity(nu) {
    const std::string last = model->variables().back().name;
    if (last == "omega_root")
      least = {0.01, 0.2}, rise = {0.02, 0.05};
    else if (last == "turbulent_dissipation")
      least = {0.01, 0.03}, rise = {0.02, 0.03};
    else
      least = {20.0 * nu}, rise = {30.0 * nu};
  }
  static double speed(double x) { return 1.0 + 20.0 * x + 200.0 * x * x; }

  // The value where gas comes in and at both sides, and no slope where it goes.
  [[nodiscard]] TurbulentCell at(const Vector3& x) const {
    constexpr double wave = std::numbers::pi / length;
    const double across = std::sin(wave * x[0]), along = std::pow(std::sin(0.5 * wave * x[1]), 2);
    const double shear = 20.0 + 400.0 * x[0];
    TurbulentCell cell{.strain = shear,
                       .vorticity = shear,
                       .distance = nearest + x[0],
                       .viscosity = viscosity,
                       .strainSlope = {400.0 / shear, 0.0}};
    for (std::size_t v = 0; v < TurbulentCell::most; ++v) {
      cell.values[v] = least[v] + rise[v] * across * along;
      cell.gradients[v] = {rise[v] * wave * std::cos(wave * x[0]) * along,
                           0.5 * rise[v] * across * wave * std::sin(wave * x[1])};
    }
    return cell;
  }
  [[nodiscard]] TurbulentRates ratesAt(const Vector3& x) const {
    const TurbulentCell cell = at(x);
    std::array<TurbulentRates, 1> rates;
    model->evaluate({&cell, 1}, rates);
    return rates[0];
  }
  // Per kg and s, by which the variables stay as they are.
  [[nodiscard]] Values source(const Vector3& x) const {
    constexpr double small = 1e-4 * length;
    const TurbulentCell cell = at(x);
    const TurbulentRates rates = ratesAt(x);
    Values found{};
    for (std::size_t v = 0; v < model->variables().size(); ++v)
      found[v] = speed(x[0]) * cell.gradients[v][1] - rates.source[v] + rates.sink[v] * cell.values[v];
    for (const std::size_t axis : {0U, 1U})
      for (const double sign : {-1.0, 1.0}) {
        Vector3 beside = x;
        beside[axis] += sign * small;
        const TurbulentRates of = ratesAt(beside);
        const TurbulentCell there = at(beside);
        for (std::size_t v = 0; v < model->variables().size(); ++v)
          found[v] -= sign * of.diffusivity[v] * there.gradients[v][axis] / (2.0 * small);
      }
    return found;
  }
};

struct Settled {
  Values error{}, change{};  // means over their rise: off the solution; in the last step, per passage
};

Settled settleTurbulence(const std::string& name, int cells) {
  static Gas gas("perfect_gas_1.yaml");
  constexpr double length = ShearedStream::length, temperature = 300.0;
  const std::vector<double> one{1.0};
  const auto moving = [&](bool atMax) {
    Side s = opening(BoundaryKind::Inlet, 0, atMax, 0.0, temperature, one);
    s.condition.tangential = ShearedStream::speed(atMax ? length : 0.0);
    return s;
  };
  Side in = opening(BoundaryKind::Inlet, 1, false, 1.0, temperature, one);
  in.condition.varies.speed = [](const Vector3& x, double) { return ShearedStream::speed(x[0]); };
  Box box(Geometry::Planar, {uniformAxis(length, cells), uniformAxis(length, cells)},
          {moving(false), moving(true), in, opening(BoundaryKind::Outlet, 1, true, 0.0, temperature, one)}, gas);
  const Mesh& m = box.mesh;
  box.context.varying = std::make_shared<BoundaryValues>(m, box.context.boundaries, gas.thermo);
  box.context.varying->set(0.0, 0.0);
  for (int c = 0; c < m.owned; ++c) box.context.wallDistance.push_back(ShearedStream::nearest + m.centre[at(c)][0]);
  std::vector<double> X(1), D(1);
  const double density = gas.thermo.density(temperature, 101325.0, one);
  gas.thermo.massToMole(one, X);
  const double viscosity = gas.transport.mixture(temperature, 101325.0, X, D).viscosity;
  // What bends the profile of a viscous stream.
  box.context.gravity = {0.0, -400.0 * viscosity / density};
  const ShearedStream exact(name, viscosity / density);
  const std::size_t count = exact.model->variables().size();
  ScalarBlock block =
      TurbulenceOperator::blockOf(*exact.model, box.context.boundaries,
                                  std::vector<FreeStream>(4, {viscosity / density, viscosity / density, 1.0}));
  for (std::size_t v = 0; v < count; ++v)
    for (ScalarBoundary& boundary : block.scalars[v].boundaries) boundary.value = exact.least[v];
  State state = box.stateWith({block}, [&](const Vector3& x) {
    return Box::Local{{0.0, ShearedStream::speed(x[0])}, temperature, one};
  });
  std::vector<Values> sources, solution;
  for (int c = 0; c < m.cells; ++c) {
    solution.push_back(exact.at(m.centre[at(c)]).values);
    sources.push_back(exact.source(m.centre[at(c)]));
    for (std::size_t v = 0; v < count; ++v) state.carried[at(c) * count + v] = density * solution.back()[v];
  }
  TransportOperator transport(box.context, state);
  TurbulenceOperator turbulence(box.context, state, exact.model, transport.properties());
  const double dt = 0.4 * length / cells / ShearedStream::speed(length);
  const auto endSweep = [&] {
    turbulence.endSweep(state);
    for (int c = 0; c < m.owned; ++c)
      for (std::size_t v = 0; v < count; ++v)
        state.balance.carried[at(c) * count + v] += state.density[at(c)] * sources[at(c)][v];
  };
  transport.initialise(state, dt);
  endSweep();
  Settled settled;
  std::vector<double> before;
  for (int i = 0; i * dt < 2.0 * length; ++i) {  // at 1 m/s, the slowest
    before = state.carried;
    transport.advance(state, i * dt, dt);
    turbulence.advance(state, i * dt, dt);
    transport.endSweep(state);
    endSweep();
  }
  for (std::size_t v = 0; v < count; ++v) {
    const double scale = exact.rise[v] * m.owned;
    for (int c = 0; c < m.owned; ++c) {
      const std::size_t i = at(c) * count + v;
      settled.error[v] += std::abs(state.carried[i] / state.density[at(c)] - solution[at(c)][v]) / scale;
      settled.change[v] += std::abs(state.carried[i] - before[i]) / (density * scale) * length / dt;
    }
  }
  return settled;
}

class TurbulenceManufactured : public testing::TestWithParam<std::string> {};

TEST_P(TurbulenceManufactured, IsOfSecondOrder) {
  std::vector<Settled> of;
  for (std::size_t level = 0; level < levels(); ++level) of.push_back(settleTurbulence(GetParam(), 8 << level));
  const auto variables = turbulenceModel(GetParam())->variables();
  for (std::size_t v = 0; v < variables.size(); ++v) {
    std::string line = fmt::format("{} of {}: mean errors", variables[v].name, GetParam());
    for (const Settled& one : of) line += fmt::format(" {:.2e}", one.error[v]);
    const double order = std::log2(of[of.size() - 2].error[v] / of.back().error[v]);
    report(line + fmt::format(", order {:.2f}; still changing by {:.1e}", order, of.back().change[v]));
    EXPECT_GE(order, 1.8) << variables[v].name;
    EXPECT_LT(of.back().error[v], 0.03);
    EXPECT_LT(of.back().change[v], 0.1 * of.back().error[v]) << "not steady";
  }
}

std::string manufacturedName(const testing::TestParamInfo<std::string>& parameter) {
  return parameter.param;
}

INSTANTIATE_TEST_SUITE_P(Some, TurbulenceManufactured, testing::Values("sst", "wang"), manufacturedName);
INSTANTIATE_TEST_SUITE_P(Long, TurbulenceManufactured, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const TurbulenceRow& row : turbulenceModels()) names.emplace_back(row.name);
                           return names;
                         }()),
                         manufacturedName);

}  // namespace
}  // namespace lampblack::test
