// What a boundary has of a carried scalar: held, fed, or drifting to it; and sinks, against exact solutions.
#include "flow/scalar_block.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/errors.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/scalar_toy.hpp"
#include "tests/messages.hpp"

namespace lampblack::test {
namespace {

void march(State& state, TransportOperator& transport, ScalarToy& toy, double dt, int steps) {
  transport.initialise(state, dt);
  toy.endSweep(state);
  for (int i = 0; i < steps; ++i) {
    transport.advance(state, i * dt, dt);
    transport.endSweep(state);
    toy.endSweep(state);
  }
}

// Per s, of this name's boundary or of all of them, behind a place along the channel.
double through(const Box& box, const TransportOperator& transport, const ScalarRange& block, std::string_view name,
               double from = 0.0) {
  double sum = 0.0;
  for (int face = box.mesh.interiorFaces; face < box.mesh.faces; ++face)
    if ((name.empty() || box.context.boundaryOf(face).name == name) && box.mesh.faceCentre[at(face)][1] >= from)
      sum += transport.carriedFlux(block, face)[0];
  return sumOverRanks(sum);
}

// What crosses the boundaries in a steady state does not depend on whether a step has led to it.
void expectAdopted(const Box& box, const State& state, const TransportOperator& marched, const ScalarRange& block,
                   const std::vector<std::string>& names) {
  TransportOperator fresh(box.context, state);
  fresh.adopt(state);
  for (const std::string& name : names)
    EXPECT_NEAR(through(box, fresh, block, name) / through(box, marched, block, name), 1.0, 1e-5) << name;
}

// Plug flow u between walls at +-h that hold cw, from an inlet that holds c0, with a source s: beside the parabola
// cw + s (h^2 - x^2)/(2 D) modes cos(l x) with l = (n + 1/2) pi/h, each of which decays as exp(r y) with
// D r^2 - u r - D l^2 = 0; no slope at the outlet.
struct PlugFlow {
  double h, length, u, D, s, c0, cw;
  // With the slope along x, times D.
  [[nodiscard]] std::array<double, 2> at(double x, double y) const {
    std::array<double, 2> c{cw + s * (h * h - x * x) / (2.0 * D), -s * x};
    for (int n = 0; n < 60; ++n) {
      const double l = (n + 0.5) * std::numbers::pi / h, sign = n % 2 == 0 ? 1.0 : -1.0;
      const double amplitude = sign * 2.0 / (l * h) * (c0 - cw - s / (D * l * l));
      const double root = std::sqrt(u * u + 4.0 * D * D * l * l), r = (u - root) / (2.0 * D),
                   R = (u + root) / (2.0 * D);
      const double back = -r / R * std::exp((r - R) * length);
      const double along =
          amplitude / (1.0 + back) * (std::exp(r * y) - r / R * std::exp(r * length - R * (length - y)));
      c[0] += std::cos(l * x) * along;
      c[1] -= D * l * std::sin(l * x) * along;
    }
    return c;
  }
};

// What an inlet brings may differ from face to face, and goes on along the stream.
TEST(ScalarBlocks, AToyVariesOverAnInlet) {
  ScalarChannel channel(1e-3, 5, 3e-3, 9);
  const Mesh& m = channel.box.mesh;
  ScalarToy toy;
  toy.diffusivity = 1e-12;
  toy.given = {
      {"ymin", {.value = 9.0, .isHeld = true, .varies = [](const Vector3& x, double) { return 1.0 + 2e3 * x[0]; }}}};
  State state = channel.stateOf({toy.block(channel.box.context)});
  TransportOperator transport(channel.box.context, state);
  march(state, transport, toy, 1e-3, 80);
  for (int c = 0; c < m.owned; ++c)
    EXPECT_NEAR(state.carried[at(c)] / state.density[at(c)], 1.0 + 2e3 * m.centre[at(c)][0], 1e-5);
  toy.given["ymin"].varies = [](const Vector3&, double) -> double { throw InputError("not here"); };
  State wrong = channel.stateOf({toy.block(channel.box.context)});
  const std::string message = messageOf<InputError>([&] { const TransportOperator other(channel.box.context, wrong); });
  EXPECT_NE(message.find("boundaries.ymin: at ("), std::string::npos) << message;
  EXPECT_NE(message.find("not here"), std::string::npos) << message;
}

// As fast as variables of turbulence are taken beside walls: the cell has what it is held at, and the others what
// diffusion brings, whose number does not depend on how fast that is.
TEST(ScalarBlocks, ASinkMayBeAsFastAsItLikes) {
  double others = 0.0;
  for (const double sink : {1e7, 1e13, 1e24}) {
    ScalarChannel channel(1e-3, 5, 3e-3, 15);
    ScalarToy toy;
    toy.diffusivity = 1e-5;
    toy.held = 3.0;
    toy.sink = sink;
    State state = channel.stateOf({toy.block(channel.box.context)});
    TransportOperator transport(channel.box.context, state);
    march(state, transport, toy, 1e-3, 4);
    double mean = 0.0;
    for (int c = 0; c < channel.box.mesh.owned; ++c) {
      const double value = state.carried[at(c)] / state.density[at(c)];
      if (c % 2 == 0) {
        EXPECT_NEAR(value, 3.0, 1e-3) << sink;
      } else {
        mean += value;
      }
    }
    mean = sumOverRanks(mean);
    if (others == 0.0) others = mean;
    EXPECT_NEAR(mean / others, 1.0, 1e-3) << sink;
  }
}

TEST(ScalarBlocks, AToyIsHeldAtInletAndWallsOfAChannel) {
  const double h = 1e-3, length = 3.0 * h, D = 1e-4;
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const int across = 5 << level, along = 3 * across;
    ScalarChannel channel(h, across, length, along);
    const Box& box = channel.box;
    ScalarToy toy;
    toy.given = {{"ymin", {.value = 5.0, .isHeld = true}}, {"xmax", {.value = 2.0, .isHeld = true}}};
    toy.diffusivity = D;
    toy.source = 900.0;
    State state = channel.stateOf({toy.block(box.context)});
    TransportOperator transport(box.context, state);
    march(state, transport, toy, 0.5 * length / along / ScalarChannel::speed, 4 * along);
    const PlugFlow exact{h, length, ScalarChannel::speed, D, toy.source, 5.0, 2.0};
    const auto perMass = [&](int c) { return state.carried[at(c)] / state.density[at(c)]; };
    const auto off = [&](int c) {
      const Vector3& x = box.mesh.centre[at(c)];
      return std::abs(perMass(c) - exact.at(x[0], x[1])[0]);
    };
    error[level] = integral(box.mesh, off) / integral(box.mesh, [](int) { return 1.0; });
    const ScalarRange& block = state.block("toy");
    double taken = 0.0;  // by the wall in the last two fifths
    for (int j = 0; j < along; ++j) {
      const double y = (j + 0.5) * length / along;
      if (y > 0.6 * length) taken -= channel.density * exact.at(h, y)[1] * length / along;
    }
    const double found = through(box, transport, block, "xmax", 0.6 * length);
    const double made = channel.density * toy.source * h * length, lost = through(box, transport, block, "");
    report(fmt::format("toy between walls, {} x {} cells: mean error {:.2e}, the wall takes {:.5f} of what it should",
                       across, along, error[level], found / taken));
    EXPECT_NEAR(lost / made, 1.0, 1e-6) << "not steady";
    EXPECT_NEAR(found / taken, 1.0, level == 0 ? 1e-2 : 3e-3);
    expectAdopted(box, state, transport, block, {"ymin", "ymax", "xmax"});
  }
  EXPECT_LT(error[1], 1.2e-2);
  EXPECT_GT(error[0] / error[1], 3.0);
}

// What comes in with the gas, and no more: u c - D c' is that of the inlet, and c' = 0 at the outlet.
TEST(ScalarBlocks, AToyIsFedAtTheInlet) {
  const double length = 4e-3, D = 1e-4, u = ScalarChannel::speed, fed = 5.0;
  for (const int sweeps : {1, 2}) {
    ScalarChannel channel(1e-3, 2, length, 20);
    const Box& box = channel.box;
    ScalarToy toy;
    toy.given["ymin"].value = fed;
    toy.diffusivity = D;
    toy.source = 100.0;
    State state = channel.stateOf({toy.block(box.context)});
    TransportOperator transport(box.context, state, {.sweeps = sweeps});
    const double dt = 0.5 * length / 20 / u;
    transport.initialise(state, dt);
    toy.endSweep(state);
    for (int i = 0; i < 250; ++i)
      for (int sweep = 0; sweep < sweeps; ++sweep) {
        transport.advance(state, i * dt, dt);
        transport.endSweep(state);
        toy.endSweep(state);
      }
    const auto exact = [&](double y) {
      return fed + D * toy.source / (u * u) + toy.source / u * (y - D / u * std::exp(u * (y - length) / D));
    };
    const double worst = largest(box.mesh, [&](int c) {
      return std::abs(state.carried[at(c)] / state.density[at(c)] - exact(box.mesh.centre[at(c)][1]));
    });
    report(fmt::format("toy fed, {} sweeps: largest error {:.2e}", sweeps, worst));
    EXPECT_LT(worst, 1e-2);
    const double came = channel.density * u * 1e-3 * fed;
    EXPECT_NEAR(through(box, transport, state.block("toy"), "ymin") / -came, 1.0, 1e-9);
    EXPECT_NEAR(sumOverRanks(transport.boundaryAmounts().carriedIn[0]) / (dt * came), 1.0, 1e-9);
  }
}

// Between a warm wall and a cold one that hold values, with a drift w from one to the other: the flux
// w (c0 e^P - c1)/(e^P - 1) with P = w L/(rho D) is the same everywhere.
TEST(ScalarBlocks, WallsHoldWhatDriftsBetweenThem) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  const double length = 0.01, cold = 300.0, warmer = 0.03, v = 0.02, peclet = 4.0, low = 1.0, high = 3.0;
  std::vector<double> X(air.size()), D(air.size());
  gas.thermo.massToMole(air, X);
  const double density = gas.thermo.density(cold, 101325.0, air);
  const double viscosity = gas.transport.mixture(cold, 101325.0, X, D).viscosity;
  std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
                          side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)};
  for (const std::size_t i : {2, 3}) {
    sides[i].condition.isothermal = true;
    sides[i].condition.temperature = i == 2 ? cold + warmer : cold;
  }
  Box box(Geometry::Planar, {uniformAxis(1e-3, 2), uniformAxis(length, 20)}, sides);
  ScalarToy toy;
  toy.given = {{"ymin", {.value = low, .isHeld = true}}, {"ymax", {.value = high, .isHeld = true}}};
  toy.diffusivity = v * length / peclet;
  ScalarBlock block = toy.block(box.context);
  block.scalars[0].thermophoresis = v * density * cold * length / (viscosity * warmer);
  State state = box.stateWith({block}, [&](const auto& x) {
    return Box::Local{{}, cold + warmer * (1.0 - x[1] / length), air};
  });
  TransportOperator transport(box.context, state);
  march(state, transport, toy, 0.4 * length / 20 / v, 300);
  const double J = v * density * (low * std::exp(peclet) - high) / std::expm1(peclet) * 1e-3;
  EXPECT_NEAR(through(box, transport, state.block("toy"), "ymin") / -J, 1.0, 1e-2);
  EXPECT_NEAR(through(box, transport, state.block("toy"), "ymax") / J, 1.0, 1e-2);
  expectAdopted(box, state, transport, state.block("toy"), {"ymin", "ymax"});
  const auto exact = [&](double y) {
    return low + (high - low) * std::expm1(peclet * y / length) / std::expm1(peclet);
  };
  EXPECT_LT(largest(box.mesh,
                    [&](int c) {
                      return std::abs(state.carried[at(c)] / state.density[at(c)] - exact(box.mesh.centre[at(c)][1]));
                    }),
            0.03);
}

}  // namespace
}  // namespace lampblack::test
