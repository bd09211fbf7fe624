// A premixed front in eddies that stay: its speed by the steps and the cells of a flow, against its equation by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "combustion_fixture.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/stepping/transport_operator.hpp"

namespace lampblack::test {
namespace {

// A + 2 B => 3 B makes rate (1 - Y)Y^2 of B, of which kappa goes. The gas rests: both weigh the same and no heat is set
// free. Without mixing the front's speed is (D rate/2)^(1/2) and its shape 1/(1 + exp(x (rate/(2 D))^(1/2))).
class Front : public testing::Test {
 protected:
  static constexpr double rate = 4e3, energy = 20.0, dissipation = 2400.0, temperature = 600.0;
  static constexpr double length = 0.1, start = 0.03, begin = 2e-3, end = 5e-3;
  static constexpr double eddies = 0.09 * energy * energy / dissipation, molecules = 7e-5;  // the latter about
  static constexpr double diffusivity = eddies / 0.9 + molecules, mixing = 0.3 * energy / dissipation;

  static double burnt(double x) { return 1.0 / (1.0 + std::exp((x - start) * std::sqrt(rate / (2.0 * diffusivity)))); }
  // Of what burns in all of the gas: three molecules are made where one reacts.
  static double kappa(double Y) { return 1.0 / (1.0 + 3.0 * mixing * rate * (1.0 - Y) * Y * Y); }

  // m/s, of the equation by itself, explicit on fine cells.
  static double expected(bool isMixed) {
    const int cells = 400;
    const double dx = length / cells, dt = 0.2 * dx * dx / diffusivity;
    std::vector<double> Y, next(at(cells));
    for (int i = 0; i < cells; ++i) Y.push_back(burnt((i + 0.5) * dx));
    double before = 0.0;
    bool hasBegun = false;
    double time = 0.0;
    for (; time < end; time += dt) {
      if (!hasBegun && time >= begin) {
        before = std::accumulate(Y.begin(), Y.end(), 0.0) * dx;
        hasBegun = true;
      }
      for (std::size_t i = 0; i < Y.size(); ++i) {
        const double low = Y[i > 0 ? i - 1 : i], high = Y[std::min(i + 1, Y.size() - 1)];
        const double reacts = rate * (1.0 - Y[i]) * Y[i] * Y[i] * (isMixed ? kappa(Y[i]) : 1.0);
        next[i] = Y[i] + dt * (diffusivity * (low - 2.0 * Y[i] + high) / (dx * dx) + reacts);
      }
      Y.swap(next);
    }
    return (std::accumulate(Y.begin(), Y.end(), 0.0) * dx - before) / (end - begin);
  }

  static double found(int cells, double dt, bool isMixed) {
    // mol/m3, of which two react with a third.
    const double concentration = 101325.0 / (8.31446 * temperature);
    Gas two(twoGases({becomes(rate / std::pow(1e-3 * concentration, 2), false, "A + 2 B => 3 B")}));
    const std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
                                  side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
    Box box(Geometry::Planar, {uniformAxis(length, cells), uniformAxis(0.001, 1)}, sides, two);
    const auto model = std::make_shared<PointwiseModel<StillEddies>>();
    State state = box.stateWith({TurbulenceOperator::blockOf(*model, box.context.boundaries,
                                                             std::vector<FreeStream>(4, {5e-5, eddies, energy}))},
                                [&](const Vector3& x) {
                                  return Box::Local{{}, temperature, {1.0 - burnt(x[0]), burnt(x[0])}};
                                });
    TransportOperator transport(box.context, state);
    ReactionOperator chemistry(box.context, {});
    TurbulenceOperator turbulence(box.context, state, model, transport.properties());
    CombustionOperator::Options options;
    options.mixingTime = MixingTime::Integral;
    if (!isMixed) options.laminarBelow = 1e9;
    CombustionOperator combustion(box.context, options, turbulence,
                                  [&](const State& of) { return chemistry.heatReleases(of); });
    chemistry.mixBy(combustion);
    turbulence.setStart(state, {5e-5, eddies, energy});
    const std::vector<Operator*> all{&transport, &chemistry, &turbulence, &combustion};
    transport.initialise(state, dt);
    const auto finish = [&] {
      for (Operator* op : all) op->endStep(state);
      for (Operator* op : all) op->endSweep(state);
    };
    finish();
    const auto amount = [&] { return integral(box.mesh, [&](int c) { return state.Y[at(c) * 2 + 1]; }) / 0.001; };
    double before = 0.0;
    for (int step = 0; step < static_cast<int>(std::lround(end / dt)); ++step) {
      if (step == static_cast<int>(std::lround(begin / dt))) before = amount();
      for (Operator* op : all) op->advance(state, step * dt, dt);
      finish();
    }
    return (amount() - before) / (end - begin);
  }
};

TEST_F(Front, MovesAsItsEquationSays) {
  for (const bool isMixed : {false, true}) {
    const double speed = expected(isMixed);
    const double coarse = found(50, 1e-4, isMixed), fine = found(100, 5e-5, isMixed);
    report(fmt::format("kappa {}: speed {:.4f} m/s, 50 cells and steps of 0.1 ms {:.4f}, 100 and 0.05 ms {:.4f}",
                       isMixed ? "of mixing" : "1", speed, coarse, fine));
    if (!isMixed) {
      EXPECT_NEAR(speed, std::sqrt(0.5 * diffusivity * rate), 0.01 * speed);
    } else {
      EXPECT_LT(speed, 0.7 * std::sqrt(0.5 * diffusivity * rate));
    }
    EXPECT_NEAR(fine, speed, 6e-3 * speed);
    EXPECT_NEAR(coarse, speed, 1e-2 * speed);
    EXPECT_LT(std::abs(fine - speed), std::abs(coarse - speed));
  }
}

}  // namespace
}  // namespace lampblack::test
