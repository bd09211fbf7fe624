// Blocks of carried scalars: what a boundary has of them, and that they stand side by side without knowing each other.
#include "flow/scalar_block.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "flow/equations/flow_residual.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// A passive scalar with values at boundaries, by their names, and a source: all that a new owner has to bring.
struct Toy : Operator {
  std::map<std::string, ScalarBoundary> given;
  double diffusivity = 0.0, source = 0.0;  // m^2/s; per kg of gas and s
  double held = 0.0, sink = 0.0;           // in every other cell: a value, and how fast it is held, 1/s

  [[nodiscard]] ScalarBlock block(const FlowContext& context) const {
    CarriedScalar scalar{.name = "toy", .unit = "1/m^3", .description = "nothing"};
    for (const BoundaryCondition& boundary : context.boundaries)
      scalar.boundaries.push_back(given.contains(boundary.name) ? given.at(boundary.name) : ScalarBoundary{});
    return {name(), {scalar}};
  }
  [[nodiscard]] const char* name() const override { return "toy"; }
  void advance(State&, double, double) override {}
  void endSweep(State& state) override {
    const auto first = at(state.block(name()).first), all = state.scalars.size();
    for (std::size_t c = 0; c < state.density.size(); ++c) state.carriedDiffusivity[c * all + first] = diffusivity;
    for (std::size_t c = 0; c < state.balance.enthalpy.size(); ++c)
      state.balance.carried[c * all + first] += state.density[c] * source;
    for (std::size_t c = 0; c < state.balance.enthalpy.size(); c += 2) {
      state.balance.carried[c * all + first] += state.density[c] * sink * held;
      state.balance.carriedSink[c * all + first] += sink;
    }
  }
};

struct Channel {
  static constexpr double speed = 0.1, temperature = 300.0;
  Gas& gas = Gas::hydrogen();
  std::vector<double> N2 = gas.massFractions("N2: 1");
  Box box;
  double density = gas.thermo.density(temperature, 101325.0, N2);

  Channel(double half, int across, double length, int along)
      : box(Geometry::Planar, {uniformAxis(half, across), uniformAxis(length, along)},
            {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
             opening(BoundaryKind::Inlet, 1, false, speed, temperature, N2),
             opening(BoundaryKind::Outlet, 1, true, 0.0, temperature, N2)}) {}
  State stateOf(const std::vector<ScalarBlock>& blocks) {
    return box.stateWith(blocks, [&](const auto&) { return Box::Local{{0.0, speed}, temperature, N2}; });
  }
};

void march(State& state, TransportOperator& transport, Toy& toy, double dt, int steps) {
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

// As fast as variables of turbulence are taken beside walls: the cell has what it is held at, and the others what
// diffusion brings, whose number does not depend on how fast that is.
TEST(ScalarBlocks, ASinkMayBeAsFastAsItLikes) {
  double others = 0.0;
  for (const double sink : {1e7, 1e13, 1e24}) {
    Channel channel(1e-3, 5, 3e-3, 15);
    Toy toy;
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
    Channel channel(h, across, length, along);
    const Box& box = channel.box;
    Toy toy;
    toy.given = {{"ymin", {.value = 5.0, .isHeld = true}}, {"xmax", {.value = 2.0, .isHeld = true}}};
    toy.diffusivity = D;
    toy.source = 900.0;
    State state = channel.stateOf({toy.block(box.context)});
    TransportOperator transport(box.context, state);
    march(state, transport, toy, 0.5 * length / along / Channel::speed, 4 * along);
    const PlugFlow exact{h, length, Channel::speed, D, toy.source, 5.0, 2.0};
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
  const double length = 4e-3, D = 1e-4, u = Channel::speed, fed = 5.0;
  for (const int sweeps : {1, 2}) {
    Channel channel(1e-3, 2, length, 20);
    const Box& box = channel.box;
    Toy toy;
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
  Toy toy;
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

// Particles of two sizes in a gas that is warmer than its walls, beside another block, before it and alone.
struct Beside {
  std::vector<double> particles, toy, gas, through;
};
Beside particlesBeside(bool isToyFirst, bool isToyThere, int sweeps, std::optional<Split> split,
                       bool areParticlesThere = true) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79"), fuel = gas.massFractions("H2: 1, N2: 4");
  std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
                          opening(BoundaryKind::Inlet, 1, false, 0.5, 400.0, air),
                          opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)};
  sides[1].condition.isothermal = sides[1].condition.takesParticles = true;
  sides[1].condition.temperature = 350.0;
  Box box(Geometry::Planar, {uniformAxis(0.006, 6), uniformAxis(0.012, 12)}, sides, gas, split);
  Toy toy;
  toy.given = {{"ymin", {.value = 3.0, .isHeld = true}}};
  toy.diffusivity = 3e-3;
  toy.source = 10.0;
  std::vector<ScalarBlock> blocks{
      takenByWalls({"soot", {{"small", "1/m^3", "", 0.55}, {"large", "1/m^3", "", 0.55}}}, box.context.boundaries)};
  // Also one that its owner moves.
  ScalarBlock others = toy.block(box.context);
  others.scalars.push_back({.name = "moved",
                            .unit = "1/m^3",
                            .description = "",
                            .thermophoresis = 0.55,
                            .isTransported = false,
                            .boundaries = blocks[0].scalars[0].boundaries});
  // And one that drifts to a wall which takes the particles, but nothing of it.
  others.scalars.push_back({.name = "drifting", .unit = "1/m^3", .description = "", .thermophoresis = 0.55});
  if (isToyThere) blocks.insert(isToyFirst ? blocks.begin() : blocks.end(), others);
  if (!areParticlesThere) std::erase_if(blocks, [](const ScalarBlock& block) { return block.owner == "soot"; });
  State state = box.stateWith(blocks, [&](const Vector3& x) {
    return Box::Local{{0.0, 0.5}, 400.0 + 1e4 * x[0], x[1] < 0.005 ? air : fuel};
  });
  const ScalarRange soot = areParticlesThere ? state.block("soot") : ScalarRange{};
  const auto of = [&](int c, int s) { return at(c) * state.scalars.size() + at(soot.first + s); };
  std::ranges::fill(state.carried, 1.0);
  std::ranges::fill(state.carriedDiffusivity, 1e-4);
  for (int c = 0; c < box.mesh.cells; ++c)
    for (int s = 0; s < soot.count; ++s) {
      state.carried[of(c, s)] = 1.0 + std::sin(700.0 * box.mesh.centre[at(c)][0] + s) * (s + 1.0);
      state.carriedDiffusivity[of(c, s)] = s == 0 ? 2e-4 : 1e-6;
    }
  TransportOperator transport(box.context, state, {.sweeps = sweeps});
  const double dt = 1e-4;
  transport.initialise(state, dt);
  for (int i = 0; i < 4; ++i)
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      if (isToyThere) toy.endSweep(state);
      transport.advance(state, i * dt, dt);
      transport.endSweep(state);
    }
  Beside found;
  for (int c = 0; c < box.mesh.owned; ++c)
    for (int s = 0; s < soot.count; ++s) found.particles.push_back(state.carried[of(c, s)]);
  found.gas = state.temperature;
  for (int face = box.mesh.interiorFaces; face < box.mesh.faces; ++face)
    for (const double flux : transport.carriedFlux(soot, face)) found.through.push_back(flux);
  if (!isToyThere) return found;
  const std::size_t moved = at(state.block("toy").first + 1), all = state.scalars.size();
  EXPECT_EQ(transport.boundaryAmounts().carriedOut[moved] + transport.boundaryAmounts().carriedIn[moved], 0.0);
  for (std::size_t c = 0; c < at(box.mesh.owned); ++c) EXPECT_EQ(state.carried[c * all + moved], 1.0);
  for (int face = box.mesh.interiorFaces; face < box.mesh.faces; ++face)
    if (box.context.takesParticles(face)) {
      EXPECT_EQ(transport.carriedFlux(state.block("toy"), face)[2], 0.0);
    }
  EXPECT_GT(largest(box.mesh, [&](int c) { return std::abs(state.carried[at(c) * all + moved - 1] - 1.0); }), 0.01);
  for (std::size_t c = 0; c < at(box.mesh.owned); ++c)
    for (std::size_t s = moved - 1; s < moved + 2; ++s) found.toy.push_back(state.carried[c * all + s]);
  return found;
}

TEST(ScalarBlocks, StandSideBySideAndDoNotDisturbEachOther) {
  for (const auto& split : {std::optional<Split>(), std::optional<Split>(Split{Cells::Triangles})})
    for (const int sweeps : {1, 2}) {
      SCOPED_TRACE(fmt::format("{} sweeps, {}", sweeps, split ? "triangles" : "rectangles"));
      const Beside alone = particlesBeside(false, false, sweeps, split);
      const Beside toyAlone = particlesBeside(false, true, sweeps, split, false);
      for (const bool isFirst : {false, true}) {
        const Beside beside = particlesBeside(isFirst, true, sweeps, split);
        EXPECT_EQ(beside.particles, alone.particles) << isFirst;
        EXPECT_EQ(beside.toy, toyAlone.toy) << isFirst;
        EXPECT_EQ(beside.gas, alone.gas) << isFirst;
        EXPECT_EQ(beside.through, alone.through) << isFirst;
      }
    }
}

// Cells next to an inlet fall away from it, along a line. A value there that is far above it bends the slope of the
// first cell where it is held; what is fed alone counts no further than the line leads: diffusion may have taken it
// away.
TEST(ScalarBlocks, CellsSeeWhatAnInletHolds) {
  for (const bool isHeld : {false, true}) {
    Channel channel(1e-3, 2, 4e-3, 4);
    const Box& box = channel.box;
    Toy toy;
    toy.given["ymin"] = {.value = 9.0, .isHeld = isHeld};
    State state = channel.stateOf({toy.block(box.context)});
    for (int c = 0; c < box.mesh.cells; ++c)
      state.carried[at(c)] = state.density[at(c)] * (5.0 - 1e3 * box.mesh.centre[at(c)][1]);
    FaceState faces(box.context, state);
    faces.prepare(state, state.Y);
    for (int face = 0; face < box.mesh.interiorFaces; ++face) {
      if (box.mesh.low[at(face)] >= box.mesh.owned || std::abs(box.mesh.faceCentre[at(face)][1] - 1e-3) > 1e-6)
        continue;
      const double found = faces.carriedPerMass(face, 0, 1.0);
      EXPECT_TRUE(isHeld ? found < 3.95 : std::abs(found - 4.0) < 1e-12) << isHeld << ' ' << found;
    }
  }
}

// Amounts that fall along a line towards a wall which holds them: to something at the wall, along the line to the face;
// to nothing before the wall, no more than the cell beside it has, and nothing of a cell that has nothing.
TEST(ScalarBlocks, ACellBesideAWallGivesNoMoreThanItHas) {
  Channel channel(4e-3, 4, 2e-3, 2);
  const Box& box = channel.box;
  Toy toy;
  toy.given["xmax"] = {.value = 0.0, .isHeld = true};
  State state = channel.stateOf({toy.block(box.context)});
  const auto faceValue = [&](double beside, double direction) {
    for (int c = 0; c < box.mesh.cells; ++c) {
      const double along = (3.5e-3 - box.mesh.centre[at(c)][0]) / 1e-3;  // cells from the one beside the wall
      state.carried[at(c)] = state.density[at(c)] * (beside + along);
    }
    FaceState faces(box.context, state);
    faces.prepare(state, state.Y);
    double found = 0.0;
    for (int face = 0; face < box.mesh.interiorFaces; ++face)
      if (box.mesh.low[at(face)] < box.mesh.owned && std::abs(box.mesh.faceCentre[at(face)][0] - 3e-3) < 1e-6)
        found = std::max(found, faces.carriedPerMass(face, 0, direction));
    MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return found;
  };
  EXPECT_NEAR(faceValue(0.6, -1.0), 1.1, 1e-12) << "0.1 at the wall";
  EXPECT_EQ(faceValue(0.0, -1.0), 0.0);
  for (const double beside : {1e-6, 0.1, 0.3}) {
    EXPECT_GE(faceValue(beside, -1.0), beside);
    EXPECT_LT(faceValue(beside, -1.0), 3.0 * beside) << beside;
  }
  // The gradient leads to zero at the wall, half a cell away: 0.6, the mean of 1 ahead and 0.2 behind, whose harmonic
  // mean is a third.
  EXPECT_NEAR(faceValue(0.3, -1.0), 0.3 + 0.5 / 3.0, 1e-12);
  EXPECT_NEAR(faceValue(0.1, 1.0), 0.6, 1e-12) << "from the other side";
}

// An equation of its own, whose diffusivity and implicit sink go by the strain of the flow: D = b S and a S c. All that
// a further equation has to bring.
struct StrainedToy : Operator {
  static constexpr double spread = 2e-7, burnt = 3.0;  // b, m^2; a
  const FlowContext& context;
  TransportOperator& transport;
  StrainedToy(const FlowContext& of, TransportOperator& by) : context(of), transport(by) {}

  static ScalarBlock block(double low, double high) {
    return {"strained", {{.name = "c", .unit = "1/m^3", .description = "", .boundaries = {{low, true}, {high, true}}}}};
  }
  [[nodiscard]] const char* name() const override { return "strained"; }
  void advance(State&, double, double) override {}
  [[nodiscard]] static double strain(const VelocityGradient& gradient, int cell) {
    return std::abs(gradient.of(cell, 0)[1] + gradient.of(cell, 1)[0]);
  }
  void endSweep(State& state) override {
    addRates(state, state.balance);
    const VelocityGradient& gradient = transport.velocityGradient(state);
    for (int c = 0; c < context.mesh.owned; ++c) state.carriedDiffusivity[at(c)] = spread * strain(gradient, c);
    context.halo.update(state.carriedDiffusivity, 1);
  }
  void addRates(const State& state, State::Balance& rates) override {
    const VelocityGradient& gradient = transport.velocityGradient(state);
    for (int c = 0; c < context.mesh.owned; ++c) rates.carriedSink[at(c)] += burnt * strain(gradient, c);
  }
};

// Between a wall that moves and one that does not: c'' = a/b c whatever the strain, between values at the walls. A step
// of a thousand times the sink's time is no hindrance, and the rates of the end state are none.
TEST(ScalarBlocks, AnEquationOfTheStrainIsOneStructAndOneRow) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> N2 = gas.massFractions("N2: 1");
  const double h = 1e-3, speed = 0.5, low = 4.0, high = 1.0;
  double error[2];
  for (int level = 0; level < 2; ++level) {
    Side still = side(BoundaryKind::Wall, 1, false), moving = side(BoundaryKind::Wall, 1, true);
    still.condition.slip = moving.condition.slip = false;
    moving.condition.tangential = speed;
    MeshSpec spec;
    spec.geometry = Geometry::Planar;
    spec.vertices = {uniformAxis(h, 3), uniformAxis(h, 10 << level), {}};
    spec.periodic[0] = true;
    spec.patches = {still.patch, moving.patch};
    Box box(spec, {still.condition, moving.condition});
    State state = box.stateWith({StrainedToy::block(low, high)}, [&](const Vector3& x) {
      return Box::Local{{speed * x[1] / h, 0.0}, 300.0, N2};
    });
    TransportOperator transport(box.context, state);
    StrainedToy toy(box.context, transport);
    const double dt = 0.3;
    EXPECT_GT(dt * StrainedToy::burnt * speed / h, 400.0);
    transport.initialise(state, dt);
    toy.endSweep(state);
    for (int i = 0; i < 4; ++i) {
      transport.advance(state, i * dt, dt);
      transport.endSweep(state);
      toy.endSweep(state);
    }
    const double root = std::sqrt(StrainedToy::burnt / StrainedToy::spread);
    error[level] = largest(box.mesh, [&](int c) {
      const double y = box.mesh.centre[at(c)][1];
      const double exact = (low * std::sinh(root * (h - y)) + high * std::sinh(root * y)) / std::sinh(root * h);
      return std::abs(state.carried[at(c)] / state.density[at(c)] - exact);
    });
    FlowResidual residual(box.context, state, VelocityScheme::Limited, {&toy});
    const FlowResidual::Rates& rates = residual.evaluate(state);
    const double taken = StrainedToy::burnt * speed / h * state.density[0] * low * h * h / 10;
    EXPECT_LT(largest(box.mesh, [&](int c) { return std::abs(rates.carried[at(c)]); }), 1e-4 * taken);
  }
  report(fmt::format("a toy of the strain: errors {:.2e} {:.2e}", error[0], error[1]));
  EXPECT_LT(error[1], 0.02);
  EXPECT_GT(error[0] / error[1], 3.4);
}

TEST(ScalarBlocks, AreFoundByTheirOwners) {
  Channel channel(1e-3, 2, 1e-3, 4);
  const FlowContext& context = channel.box.context;
  Toy toy;
  const ScalarBlock two{"two", {{"a", "1/m^3", ""}, {"b", "1/m^3", ""}}};
  const State state = channel.stateOf({two, toy.block(context)});
  EXPECT_EQ(state.block("toy").first, 2);
  EXPECT_EQ(state.block("toy").count, 1);
  EXPECT_EQ(state.block("two").first, 0);
  EXPECT_THROW((void)state.block("three"), std::logic_error);
  EXPECT_THROW(channel.stateOf({two, two}), std::logic_error);
  ScalarBlock wrong = two;
  wrong.scalars[1].boundaries.resize(2);
  EXPECT_THROW(TransportOperator(context, channel.stateOf({wrong})), std::logic_error);
  toy.given["ymax"].isHeld = true;  // an outlet
  EXPECT_THROW(TransportOperator(context, channel.stateOf({toy.block(context)})), std::logic_error);
}

}  // namespace
}  // namespace lampblack::test
