// Ensembles in gas that flows through a pipe: what leaves is told, and coagulation on the way is what the exact
// solution says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "particles/models/soot_model.hpp"
#include "tests/coupling/soot_in_cells.hpp"
#include "tests/effort.hpp"
#include "tests/flow/flow_fixture.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::test {
namespace {

// A pipe of hot nitrogen in which particles do nothing but coagulate, if that.
struct Pipe {
  static constexpr int cells = 24;
  static constexpr double length = 0.012, speed = 1.0, dt = 0.4 * length / cells / speed;
  explicit Pipe(const SootOptions& o)
      : N2(ethylene().massFractions("N2: 1")),
        box(Geometry::Planar, {uniformAxis(length, cells), uniformAxis(0.001, 1), {}},
            {opening(BoundaryKind::Inlet, 0, false, speed, 1500.0, N2),
             opening(BoundaryKind::Outlet, 0, true, 0.0, 1500.0, N2), side(BoundaryKind::Symmetry, 1, false),
             side(BoundaryKind::Symmetry, 1, true)},
            ethylene()),
        state(box.state(
            [&](const Vector3&) {
              return Box::Local{{speed, 0.0}, 1500.0, N2};
            },
            sootOf(o)->scalars())),
        transport(box.context, state),
        soot(sootOf(o)),
        ensembles(box.context, transport, soot, o) {
    transport.initialise(state, 1e-5);
  }
  static SootOptions onlyCoagulating(std::size_t particles, double rate) {
    SootOptions o = sootOptions(Exchange::OneWay);
    o.diffusion = false;
    o.ensemble.particles = particles;
    o.ensemble.kernel = {.type = CollisionKernelType::constant, .rate = rate};
    o.ensemble.soot.coagulation = rate > 0.0;
    for (bool SootModelOptions::*process : {&SootModelOptions::inception, &SootModelOptions::condensation,
                                            &SootModelOptions::surfaceGrowth, &SootModelOptions::oxidation})
      o.ensemble.soot.*process = false;
    return o;
  }
  void fill(int upTo, const std::vector<GivenParticle>& fresh) {
    for (int c = 0; c < box.mesh.owned; ++c)
      if (box.mesh.centre[at(c)][0] < upTo * length / cells)
        ensembles.initialise(state, c, soot->packed(fresh, numberOf(box.mesh, c)));
  }
  void step() {
    state.keepStart();
    ensembles.advance(state, 0.0, dt);
    ensembles.endStep(state);
  }
  std::vector<double> N2;
  Box box;
  State state;
  TransportOperator transport;
  std::shared_ptr<CellSoot> soot;
  EnsembleOperator ensembles;
};

// What leaves with the gas is told to whoever watches: with it nothing is missing.
TEST(EnsemblesInAPipe, AreToldAsTheyLeave) {
  Pipe pipe(Pipe::onlyCoagulating(60, 0.0));
  if (pipe.box.mesh.ranks > 2) GTEST_SKIP() << "a row of cells";
  std::vector<GivenParticle> fresh;
  for (int k = 0; k < 60; ++k) fresh.push_back({1e-23 * (1 + k), 1e-25 * k, 1.0 + k % 3, 1e14 * (1 + k % 5)});
  pipe.fill(Pipe::cells, fresh);
  using A = CellSoot;
  const auto content = [&](A::Amount amount) {
    return integral(pipe.box.mesh,
                    [&](int c) { return pipe.state.carried[at(c) * pipe.state.scalars.size() + amount]; });
  };
  std::vector<double> left(pipe.soot->amounts().count());
  pipe.ensembles.watchAmounts([&](std::span<const double>, std::span<const double> outflow) {
    for (std::size_t k = 0; k < left.size(); ++k) left[k] += outflow[k];
  });
  double mass = 0.0, time = 0.0;
  pipe.ensembles.watchFaces([&](double dt, std::span<const double> gone) {
    time += dt;
    for (std::size_t b = 0; b < gone.size(); ++b) {
      const bool isOutlet =
          pipe.box.context.boundaryOf(pipe.box.mesh.interiorFaces + static_cast<int>(b)).kind == BoundaryKind::Outlet;
      EXPECT_TRUE(isOutlet || gone[b] == 0.0) << b;
      mass += gone[b];
    }
  });
  const auto watched = {A::number, A::carbon, A::hydrogen, A::primaries};
  std::vector<double> before;
  for (const A::Amount amount : watched) before.push_back(content(amount));
  for (int s = 0; s < 20; ++s) pipe.step();
  std::size_t k = 0;
  for (const A::Amount amount : watched) {
    const double gone = sumOverRanks(left[amount]);
    EXPECT_GT(gone, 0.2 * before[k]);
    EXPECT_NEAR((content(amount) + gone) / before[k], 1.0, 1e-12) << k;
    ++k;
  }
  EXPECT_NEAR(sumOverRanks(mass) / sumOverRanks(left[A::carbon] + left[A::hydrogen]), 1.0, 1e-12);
  EXPECT_NEAR(time, 20.0 * Pipe::dt, 1e-12);
}

// With a constant kernel, behind the first cells, where the particles are put in, each cell follows from the one before
// by the time between them: N = N1 / (1 + K N1 t / 2) (Smoluchowski 1917), and the second moment of the volume by
// M2 = M2_1 + K M1^2 t.
TEST(EnsemblesInAPipe, CoagulateAsTheExactSolution) {
  constexpr int cells = Pipe::cells, filled = 4, first = 6;
  constexpr double length = Pipe::length, speed = Pipe::speed, N0 = 1e16, K = 1e-13;
  const SootOptions o = Pipe::onlyCoagulating(400, K);
  Pipe pipe(o);
  const Box& box = pipe.box;
  if (box.mesh.ranks > 2) GTEST_SKIP() << "a row of cells";
  const double v0 = 1e-26;
  const std::vector<GivenParticle> fresh(400, {v0 * o.ensemble.soot.sootDensity, 0.0, 1.0, N0 / 400});
  std::vector<std::vector<double>> number(cells), square(cells);
  for (int s = 0; s < fewOrMany(400, 1200); ++s) {
    pipe.fill(filled, fresh);
    pipe.step();
    if (s < 100 || s % 20 != 0) continue;  // from the inlet to the outlet in 60 steps
    for (int i = 0; i < cells; ++i) {
      double sums[2] = {0.0, 0.0};
      for (int c = 0; c < box.mesh.owned; ++c) {
        if (std::abs(box.mesh.centre[at(c)][0] - (i + 0.5) * length / cells) > 1e-6) continue;
        for (const GivenParticle& p : packedParticles(pipe.ensembles.populations()[at(c)])) {
          const double v = p.carbon / o.ensemble.soot.sootDensity / v0;
          sums[0] += p.number;
          sums[1] += p.number * v * v;
        }
      }
      number[at(i)].push_back(sumOverRanks(sums[0]));
      square[at(i)].push_back(sumOverRanks(sums[1]));
    }
  }
  const auto relative = [&](const std::vector<std::vector<double>>& of, int i, const auto& exact) {
    const Sample here = summarise(of[at(i)]);
    return std::pair((here.mean - exact) / exact, here.standardError / exact);
  };
  const double N1 = summarise(number[first]).mean, S1 = summarise(square[first]).mean;
  double worst = 0.0, worstSquare = 0.0;
  for (int i = first + 1; i < cells; ++i) {
    const double t = (i - first) * length / cells / speed;
    const auto [n, errorN] = relative(number, i, N1 / (1.0 + 0.5 * K * N1 * t));
    const auto [q, errorQ] = relative(square, i, S1 + K * N0 * N0 * t);
    // The discrete cells of second order, and 55 samples (15 in the fast tier) that are not quite independent.
    EXPECT_LT(std::abs(n), 0.01 + 4.0 * errorN) << i;
    EXPECT_LT(std::abs(q), 0.02 + 4.0 * errorQ) << i;
    worst = std::max(worst, std::abs(n));
    worstSquare = std::max(worstSquare, std::abs(q));
  }
  report(fmt::format(
      "pipe: number falls to {:.3f} of what comes in; largest difference {:.2f} % of the number, {:.1f} % of M2",
      summarise(number[cells - 1]).mean / N0, 100.0 * worst, 100.0 * worstSquare));
}

}  // namespace
}  // namespace lampblack::test
