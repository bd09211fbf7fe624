// Order of the flow in time: the same flows with steps halved again and again.
#include "flow_order.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <string>
#include <vector>

#include "core/constants.hpp"

namespace lampblack::test {
namespace {

// Mean of |a - b| over the owned cells, of component k of n.
double distance(const Box& box, const std::vector<double>& a, const std::vector<double>& b, std::size_t n,
                std::size_t k) {
  double sum = 0.0, count = 0.0;
  for (int c = 0; c < box.mesh.owned; ++c) sum += std::abs(a[at(c) * n + k] - b[at(c) * n + k]), count += 1.0;
  return sumOverRanks(sum) / sumOverRanks(count);
}

// Orders between the last two differences of runs whose steps are halved: three differences, two in the fast tier.
struct Orders {
  double u = 0.0, T = 0.0, Y = 0.0, p = 0.0, carried = 0.0;
};

Orders measure(Problem& problem, int sweeps, std::size_t differences = fewOrMany<std::size_t>(2, 3)) {
  const std::size_t n = problem.box.gas.mechanism.numSpecies();
  const std::size_t species = problem.box.gas.mechanism.speciesIndex(problem.species);
  State start = problem.stateAtStart();
  if (problem.prelude > 0.0) advance(problem, start, 2, 2 * problem.steps, problem.prelude);
  std::vector<Quantities> found;
  for (std::size_t level = 0; level <= differences; ++level) {
    State state = start;
    found.push_back(advance(problem, state, sweeps, problem.steps << level, problem.duration));
  }
  const auto order = [&](const char* name, std::vector<double> Quantities::*field, std::size_t components,
                         std::size_t component) {
    std::vector<double> d(differences);
    for (std::size_t level = 0; level < d.size(); ++level)
      d[level] = distance(problem.box, found[level].*field, found[level + 1].*field, components, component);
    const double last = std::log2(d[d.size() - 2] / d.back());
    const double whole = std::log2(d.front() / d.back()) / static_cast<double>(d.size() - 1);
    report(fmt::format("{}, {} sweeps, {}: {:.2e}, orders {:.2f} to {:.2f}", problem.name, sweeps, name,
                       fmt::join(d, " "), std::log2(d[0] / d[1]), last));
    return std::pair{last, whole};
  };
  // Of the pressure over all steps: limiters that set in leave differences of 5e-5 Pa, which three sweeps reach at
  // once.
  return {order("u", &Quantities::velocity, 2, 0).first, order("T", &Quantities::temperature, 1, 0).first,
          order("Y", &Quantities::Y, n, species).first, order("p", &Quantities::pressure, 1, 0).second,
          problem.particles ? order("particles", &Quantities::carried, 1, 0).first : 0.0};
}

// Its pressure is not looked at: it feels the moments at which a cell's limiter sets in.
TEST(FlowOrder, HotSpotInAStream) {
  Problem problem = hotSpotInAStream();
  const Orders one = measure(problem, 1), two = measure(problem, 2);
  EXPECT_NEAR(one.u, 1.0, 0.1);
  EXPECT_NEAR(one.T, 1.0, 0.1);
  EXPECT_GT(two.T, 1.8);
  EXPECT_GT(two.carried, 1.8);
  if (!isLongRun()) return;
  const Orders four = measure(problem, 4);
  EXPECT_GT(four.u, 1.9);
  EXPECT_GT(four.T, 1.9);
  EXPECT_GT(four.carried, 1.9);
}

TEST(FlowOrder, LayerRichInHydrogen) {
  Problem problem = layerRichInHydrogen();
  const Orders two = measure(problem, 2, 3), three = measure(problem, 3, 3);
  EXPECT_GT(two.u, 1.6);
  EXPECT_GT(two.Y, 1.7);
  EXPECT_GT(three.u, 1.9);
  EXPECT_GT(three.Y, 1.9);
  EXPECT_GT(three.p, 1.5);
}

// A wave of 95 % of hydrogen over two of its diffusion times in 16 steps: what is left of it, against 512 steps.
// Steps of first order in which all of the diffusion is implicit would leave 12.5 % too much.
TEST(FlowOrder, WaveOfHydrogenDecays) {
  Gas& gas = Gas::hydrogen();
  const double size = 4e-3;
  const auto mixture = gas.massFractions("H2: 0.95, N2: 0.05");
  const std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false),
                                opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, mixture),
                                side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  Problem problem{"wave",
                  Box(Geometry::Planar, {uniformAxis(size, 32), uniformAxis(1e-3, 1)}, sides),
                  [&](const Vector3& x) {
                    const double X = 0.95 + 0.01 * std::cos(std::numbers::pi * x[0] / size);
                    return Box::Local{{0.0, 0.0}, 300.0, gas.massFractions(fmt::format("H2: {}, N2: {}", X, 1.0 - X))};
                  },
                  0.0,
                  16,
                  "H2"};
  std::vector<double> X(gas.mechanism.numSpecies()), D(X.size());
  gas.thermo.massToMole(mixture, X);
  const std::size_t hydrogen = gas.mechanism.speciesIndex("H2"), other = gas.mechanism.speciesIndex("N2");
  gas.transport.mixture(300.0, constants::oneAtmosphere, X, D);
  const double diffusivity = D[other] * X[hydrogen] / (1.0 - mixture[other]);  // of the pair
  problem.duration = 2.0 * size * size / (std::numbers::pi * std::numbers::pi * diffusivity);
  const auto left = [&](int sweeps, int steps) {
    State state = problem.box.state(problem.start);
    const Quantities end = advance(problem, state, sweeps, steps, problem.duration);
    return 2.0 / (size * 1e-3) * integral(problem.box.mesh, [&](int c) {
             std::vector<double> moles(X.size());
             gas.thermo.massToMole({&end.Y[at(c) * X.size()], X.size()}, moles);
             return moles[hydrogen] * std::cos(std::numbers::pi * problem.box.mesh.centre[at(c)][0] / size);
           });
  };
  const double exact = left(3, 512);
  for (const auto& [sweeps, allowed] : {std::pair{1, 1.0}, {2, 0.125}, {3, 0.03}}) {
    const double error = left(sweeps, 16) / exact - 1.0;
    report(fmt::format("wave of hydrogen, {} sweeps: {:+.2e} of what is left of it ({:.3f} of its start)", sweeps,
                       error, exact / 0.01));
    EXPECT_LT(std::abs(error), allowed);
  }
}

TEST(FlowOrder, PremixedFlame) {
  Gas gas("methane_drm19_21.yaml");
  Problem problem = premixedFlame(gas);
  for (int sweeps = 2; sweeps <= fewOrMany(2, 3); ++sweeps) {
    const Orders found = measure(problem, sweeps);
    EXPECT_GT(found.u, 1.9);
    EXPECT_GT(found.T, 1.9);
    EXPECT_GT(found.Y, 1.9);
    EXPECT_GT(found.p, 1.5);
  }
}

// An even mixture in an open box ignites as in a reactor of constant pressure while most of it leaves.
TEST(FlowOrder, EvenMixtureIgnitesAsAReactor) {
  Gas& gas = Gas::hydrogen();
  const double size = 1e-3, T0 = 1200.0, duration = 4e-5;
  const auto mixture = gas.massFractions("H2: 2, O2: 1, N2: 3.76, H: 0.01");
  const std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false),
                                opening(BoundaryKind::Outlet, 0, true, 0.0, T0, mixture),
                                side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  Problem problem{"ignition",
                  Box(Geometry::Planar, {uniformAxis(size, 4), uniformAxis(size, 1)}, sides),
                  [&](const Vector3&) {
                    return Box::Local{{0.0, 0.0}, T0, mixture};
                  },
                  duration,
                  0,
                  "H2",
                  true};
  std::vector<double> Y = mixture;
  ConstantPressureReactor reactor(gas.mechanism, {1e-10, 1e-16});
  ConstantPressureReactor::Cell cell{T0, constants::oneAtmosphere, Y, {}, 0.0};
  reactor.advance(cell, duration);
  ASSERT_GT(cell.temperature, T0 + 300.0);
  std::array<double, 3> error{};
  for (std::size_t level = 0; level < error.size(); ++level) {
    State state = problem.stateAtStart();
    const Quantities end = advance(problem, state, 2, 40 << level, duration);
    error[level] =
        largest(problem.box.mesh, [&](int c) { return std::abs(end.temperature[at(c)] - cell.temperature); });
  }
  report(fmt::format("ignition, 2 sweeps, T against {:.1f} K: {:.2e} {:.2e} {:.2e}, orders {:.2f} {:.2f}",
                     cell.temperature, error[0], error[1], error[2], std::log2(error[0] / error[1]),
                     std::log2(error[1] / error[2])));
  EXPECT_GT(std::log2(error[1] / error[2]), 1.8);
}

}  // namespace
}  // namespace lampblack::test
