// Manufactured solutions of the equations of each turbulence model (manufactured_turbulence.hpp) on boxes, bent boxes,
// skewed quadrilaterals and triangles, plane and about an axis, of one density and of several. The gas flows as it is
// given. What is tested is all between a model's rates in a cell and the solution: gradients, products of them, strain,
// its slope and bend, the density's slope, diffusivities at faces, convection and diffusion together.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "flow/equations/flow_residual.hpp"
#include "flow/models/turbulence/turbulence_operator.hpp"
#include "flow/steady/carried_update.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_exact.hpp"
#include "manufactured_turbulence.hpp"
#include "tests/effort.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

using Values = ManufacturedTurbulence::Values;

enum class Shape { Boxes, Bent, Skewed, Triangles };

// Sources that are given.
class GivenSources : public Operator {
 public:
  explicit GivenSources(std::vector<double> sources) : sources_(std::move(sources)) {}
  [[nodiscard]] const char* name() const override { return "given"; }
  void advance(State&, double, double) override {}
  void addRates(const State&, State::Balance& rates) override {
    for (std::size_t i = 0; i < sources_.size(); ++i) rates.carried[i] += sources_[i];
  }
  [[nodiscard]] bool actsOnCarried() const override { return true; }

 private:
  std::vector<double> sources_;
};

class ManufacturedFlow {
 public:
  ManufacturedFlow(ManufacturedTurbulence exact, Shape shape, int cells)
      : exact_(std::move(exact)), box_(boxOf(exact_, shape, cells)), count_(exact_.model->variables().size()) {
    const Mesh& m = box_.mesh;
    box_.context.varying = std::make_shared<BoundaryValues>(m, box_.context.boundaries, exact_.gas.thermo);
    box_.context.varying->set(0.0, 0.0);
    for (int c = 0; c < m.owned; ++c)
      box_.context.wallDistance.push_back(ManufacturedTurbulence::wallDistance(m.centre[test::at(c)]));
  }

  struct Settled {
    Values error{}, change{};  // means over the variable's rise: off the solution; in the last iteration
    int iterations = 0;
  };
  Settled settle() {
    const Mesh& m = box_.mesh;
    State state = stateOf();
    TransportOperator transport(box_.context, state);
    transport.adopt(state);
    TurbulenceOperator turbulence(box_.context, state, exact_.model, transport.properties());
    GivenSources given(sources());
    const std::vector<Operator*> operators{&transport, &turbulence, &given};
    FlowResidual residual(box_.context, state, VelocityScheme::Limited, operators);
    turbulence.setDiffusivities(state);
    state.updateHalo(box_.halo);
    residual.evaluate(state);
    CarriedUpdate update(box_.context, state, residual, operators);
    const std::vector<double> inertia = inertiaOf(state);
    Settled settled;
    for (int i = 0; i < mostIterations; ++i) {
      const std::vector<double> before = state.carried;
      update.advance(state, residual, inertia);
      residual.evaluateCarried(state, FlowResidual::Gas::Same);
      bool isSettled = true;
      for (std::size_t v = 0; v < count_; ++v) {
        const auto mean = [&](const auto& off) {
          return meanError(box_, [&](int c) {
            const std::size_t i = test::at(c) * count_ + v;
            return off(c, i) / state.density[test::at(c)] / exact_.rise[v];
          });
        };
        settled.change[v] = mean([&](int, std::size_t i) { return state.carried[i] - before[i]; });
        settled.error[v] = mean([&](int c, std::size_t i) {
          return state.carried[i] - state.density[test::at(c)] * exact_.variable(v, m.centre[test::at(c)]).value;
        });
        isSettled = isSettled && settled.change[v] < 1e-3 * settled.error[v];
      }
      settled.iterations = i + 1;
      if (isSettled) break;
    }
    return settled;
  }

 private:
  static constexpr int mostIterations = 60;

  static Box boxOf(const ManufacturedTurbulence& exact, Shape shape, int cells) {
    constexpr double length = ManufacturedTurbulence::length;
    const std::vector<double> one{1.0};
    const auto stream = [&](int axis, bool atMax) {
      Side s = opening(BoundaryKind::Inlet, axis, atMax, 0.0, ManufacturedTurbulence::cold, one);
      const auto across = static_cast<std::size_t>(axis), along = 1 - across;
      s.condition.varies.speed = [=](const Vector3& x, double) {
        return (atMax ? -1.0 : 1.0) * exact.velocity(x)[across];
      };
      s.condition.varies.tangential = [=](const Vector3& x, double) { return exact.velocity(x)[along]; };
      s.condition.varies.gas.temperature = [=](const Vector3& x, double) { return exact.temperature(x).value; };
      return s;
    };
    // An outlet's triangles leave as they are, of first order: there the exact flow is drawn out.
    const Side end = shape == Shape::Triangles
                         ? stream(1, true)
                         : opening(BoundaryKind::Outlet, 1, true, 0.0, ManufacturedTurbulence::cold, one);
    MeshSpec spec;
    spec.geometry = exact.geometry;
    spec.vertices = {uniformAxis(length, cells), uniformAxis(length, cells), {}};
    if (shape == Shape::Bent)
      spec.map = [](const std::array<double, 3>& x) {
        const double bend = 0.08 * length * std::sin(pi * x[0] / length) * std::sin(pi * x[1] / length);
        return std::array<double, 3>{x[0] + bend, x[1] - bend, 0.0};
      };
    std::vector<BoundaryCondition> conditions;
    for (const Side& s : {side(BoundaryKind::Symmetry, 0, false), stream(0, true), stream(1, false), end}) {
      spec.patches.push_back(s.patch);
      conditions.push_back(s.condition);
    }
    std::optional<Split> split;
    if (shape == Shape::Skewed) split = Split{Cells::Quadrilaterals};
    if (shape == Shape::Triangles) split = Split{Cells::Triangles};
    return {spec, conditions, split, MPI_COMM_WORLD, exact.gas};
  }

  [[nodiscard]] State stateOf() {
    const Mesh& m = box_.mesh;
    ScalarBlock block = TurbulenceOperator::blockOf(*exact_.model, box_.context.boundaries,
                                                    std::vector<FreeStream>(4, {1e-5, 1e-5, 1.0}));
    for (std::size_t v = 0; v < count_; ++v)
      for (ScalarBoundary& boundary : block.scalars[v].boundaries)
        if (boundary.isHeld)
          boundary.varies = [this, v](const Vector3& x, double) { return exact_.variable(v, x).value; };
    State state = box_.stateWith({block}, [&](const Vector3& x) {
      return Box::Local{exact_.velocity(x), exact_.temperature(x).value, {1.0}};
    });
    for (int c = 0; c < m.cells; ++c)
      for (std::size_t v = 0; v < count_; ++v)
        state.carried[test::at(c) * count_ + v] =
            state.density[test::at(c)] * exact_.variable(v, m.centre[test::at(c)]).value;
    // What flows between the two ends of a face is the difference of the stream function there.
    for (int face = 0; face < m.faces; ++face) {
      const Vector3& n = m.normal[test::at(face)];
      const Vector3 half = scaled({-n[1], n[0], 0.0}, 0.5 * m.size(face));
      const Vector3& middle = m.faceCentre[test::at(face)];
      state.massFlux[test::at(face)] =
          exact_.streamFunction(sum(middle, half)) - exact_.streamFunction(difference(middle, half));
    }
    return state;
  }

  [[nodiscard]] std::vector<double> sources() const {
    std::vector<double> found;
    for (int c = 0; c < box_.mesh.owned; ++c) {
      const Values there = exact_.source(box_.mesh.centre[test::at(c)]);
      found.insert(found.end(), there.begin(), there.begin() + static_cast<std::ptrdiff_t>(count_));
    }
    return found;
  }

  // kg/s: a cell's mass over five times the time in which it is replaced.
  [[nodiscard]] std::vector<double> inertiaOf(const State& state) const {
    std::vector<double> inertia(test::at(box_.mesh.owned));
    for (int face = 0; face < box_.mesh.faces; ++face)
      for (const int cell : {box_.mesh.low[test::at(face)], box_.mesh.high[test::at(face)]})
        if (cell >= 0 && cell < box_.mesh.owned)
          inertia[test::at(cell)] += 0.1 * std::abs(state.massFlux[test::at(face)]);
    return inertia;
  }

  ManufacturedTurbulence exact_;
  Box box_;
  std::size_t count_;
};

struct Case {
  std::string model;
  Geometry geometry;
  bool isHeated;
  Shape shape;
  [[nodiscard]] std::string name() const {
    static constexpr std::array shapes{"boxes", "bent", "skewed", "triangles"};
    return fmt::format("{}_{}_{}_{}", model, geometry == Geometry::Planar ? "plane" : "round",
                       isHeated ? "heated" : "even", shapes[static_cast<std::size_t>(shape)]);
  }
};

class TurbulenceManufactured : public testing::TestWithParam<Case> {};

// Over all meshes, as errors of both signs meet between two of them. What is below 1.8, and why as far as it is known,
// stands in docs/verification.md ("Turbulence models by manufactured solutions").
double leastOrder(const Case& of, std::size_t variable) {
  const auto isOne = [&](std::initializer_list<std::string_view> models) {
    return std::ranges::find(models, of.model) != models.end();
  };
  if (of.shape == Shape::Triangles) return isOne({"hardly_mixed"}) ? 1.15 : isOne({"wang"}) ? 1.25 : 1.35;
  if (isOne({"wang"})) return 1.6;  // the bend of the strain beside openings
  const bool isRoundAndHeated = of.geometry == Geometry::Axisymmetric && of.isHeated;
  if (isOne({"sst", "sst1994", "k_omega", "k_omega1988"}) && variable == 0 && isRoundAndHeated) return 1.6;
  if (isOne({"hardly_mixed"}) && of.shape == Shape::Skewed) return 1.75;
  return 1.8;
}

// Of the variable's rise, on 8, 16, 32 cells a side: a quarter above the largest of all models.
double mostError(std::size_t level) {
  constexpr double onTheCoarsest = 0.04;
  return onTheCoarsest / std::pow(4.0, static_cast<double>(level));
}

TEST_P(TurbulenceManufactured, HasItsOrder) {
  static Gas gas("perfect_gas_1.yaml");
  const Case& of = GetParam();
  std::vector<ManufacturedFlow::Settled> found;
  for (std::size_t level = 0; level < levels(); ++level)
    found.push_back(ManufacturedFlow({of.model, of.geometry, of.isHeated, gas}, of.shape, 8 << level).settle());
  const auto variables = manufacturedModel(of.model)->variables();
  for (std::size_t v = 0; v < variables.size(); ++v) {
    std::string line = fmt::format("{} {}: mean errors", of.name(), variables[v].name);
    for (const ManufacturedFlow::Settled& one : found) line += fmt::format(" {:.2e}", one.error[v]);
    const auto halvings = static_cast<double>(found.size() - 1);
    const double order = std::log2(found.front().error[v] / found.back().error[v]) / halvings;
    report(line + fmt::format(", order {:.2f}; still changing by {:.1e}, {} iterations", order, found.back().change[v],
                              found.back().iterations));
    EXPECT_GE(order, leastOrder(of, v)) << variables[v].name;
    EXPECT_LT(found.back().error[v], mostError(found.size() - 1)) << variables[v].name;
    EXPECT_LT(found.back().change[v], 0.05 * found.back().error[v]) << "not steady";
  }
}

std::vector<Case> allCases() {
  std::vector<Case> cases;
  std::vector<std::string> models{"mixed", "hardly_mixed"};
  for (const TurbulenceRow& row : turbulenceModels()) models.emplace_back(row.name);
  for (const std::string& model : models)
    for (const Geometry geometry : {Geometry::Planar, Geometry::Axisymmetric})
      for (const bool isHeated : {false, true})
        for (const Shape shape : {Shape::Boxes, Shape::Bent, Shape::Skewed, Shape::Triangles})
          cases.push_back({model, geometry, isHeated, shape});
  return cases;
}

std::string manufacturedName(const testing::TestParamInfo<Case>& parameter) {
  return parameter.param.name();
}

INSTANTIATE_TEST_SUITE_P(Some, TurbulenceManufactured,
                         testing::Values(Case{"sa", Geometry::Axisymmetric, true, Shape::Bent},
                                         Case{"wang", Geometry::Axisymmetric, false, Shape::Boxes},
                                         Case{"wang", Geometry::Planar, true, Shape::Skewed},
                                         Case{"k_omega", Geometry::Axisymmetric, true, Shape::Boxes},
                                         Case{"sst", Geometry::Planar, true, Shape::Triangles}),
                         manufacturedName);
INSTANTIATE_TEST_SUITE_P(Long, TurbulenceManufactured, testing::ValuesIn(allCases()), manufacturedName);

}  // namespace
}  // namespace lampblack::test
