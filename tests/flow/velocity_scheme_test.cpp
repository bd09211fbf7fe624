// What takes energy from vortices a few cells wide: the interpolation of the velocity that is carried, and the
// deviation of the faces' velocities from the cells'.
#include <gtest/gtest.h>

#include <numbers>

#include "flow/discretisation/limiter.hpp"
#include "flow/equations/face_velocity.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// Of `f` at the face between cells about x and x + h, both of width h, with the slopes of parabolas.
template <class F>
double centralBetween(const F& f, double x, double h, bool fromLow) {
  const double lowSlope = (f(x + h) - f(x - h)) / (2.0 * h), highSlope = (f(x + 2.0 * h) - f(x)) / (2.0 * h);
  const Upwind at{0, 1, h, h, 0.5 * h};
  return fromLow ? centralFaceValue(f(x), f(x + h), lowSlope, highSlope, at)
                 : centralFaceValue(f(x + h), f(x), -highSlope, -lowSlope, at);
}

TEST(CentralFaceValue, IsLinearBetweenUnequalCells) {
  const auto f = [](double x) { return 2.0 + 3.0 * x; };
  const Upwind at{0, 1, 1.0, 0.7, 0.3};
  EXPECT_NEAR(centralFaceValue(f(0.0), f(1.0), 3.0, 3.0, at), f(0.3), 1e-14);
}

// What leaves a cell less what enters it is the slope, with an error that falls as the cells' width to the fourth power
// but for the damping, which falls as the third.
TEST(CentralFaceValue, HasASlopeOfHighOrder) {
  const auto f = [](double x) { return std::sin(x); };
  const double x = 0.7;
  double central[2], damping[2];
  for (int i = 0; i < 2; ++i) {
    const double h = 0.1 / (1 << i);
    double slope[2];
    for (const bool fromLow : {false, true})
      slope[fromLow] = (centralBetween(f, x, h, fromLow) - centralBetween(f, x - h, h, fromLow)) / h;
    central[i] = 0.5 * (slope[0] + slope[1]) - std::cos(x);
    damping[i] = slope[1] - slope[0];
  }
  EXPECT_NEAR(std::log2(central[0] / central[1]), 4.0, 0.1);
  EXPECT_NEAR(std::log2(damping[0] / damping[1]), 3.0, 0.1);
  // Of a wave carried upwards, crests fall.
  EXPECT_GT(damping[0] * std::sin(x), 0.0);
}

TEST(CentralFaceValue, DampsTheShortestWave) {
  EXPECT_GT(centralFaceValue(1.0, -1.0, 0.0, 0.0, {0, 1, 1.0, 1.0, 0.5}), 0.05);
}

// Gas at rest in a periodic stream of cells, pressures of a function of the cells' numbers: how fast it flows through
// the faces after a time, over what a face's own pressure difference alone would make of it.
double deviation(int cells, double time, const std::function<double(int)>& pressureOf) {
  Gas& gas = Gas::hydrogen();
  MeshSpec spec;
  const double width = 1e-3;
  spec.vertices = {uniformAxis(width * cells, cells), uniformAxis(3.0 * width, 3)};
  spec.periodic = {true, true};
  const Mesh mesh(MPI_COMM_WORLD, spec);
  HaloExchange halo(mesh);
  const FlowContext context{mesh, halo, gas.mechanism, gas.thermo, gas.transport, {}};
  const auto number = [&](int c) { return static_cast<int>(std::floor(mesh.centre[at(c)][0] / width)); };
  const auto pressure = [&](int i) { return pressureOf((i + cells) % cells); };
  std::vector<double> p(at(mesh.cells)), acceleration(p.size() * 2, 0.0), none(p.size() * 4, 0.0);
  for (int c = 0; c < mesh.cells; ++c) {
    p[at(c)] = pressure(number(c));
    acceleration[at(2 * c)] = (pressure(number(c) + 1) - pressure(number(c) - 1)) / (2.0 * width);
  }
  std::vector<double> through(at(mesh.faces), 0.0);
  FaceVelocity faces(context);
  faces.predict({std::span(none).first(2 * p.size()), acceleration, std::span(none).first(p.size()), p, none},
                std::vector<double>(through.size(), 1.0), time, through);
  double most = 0.0, own = 0.0;
  for (int face = 0; face < mesh.interiorFaces; ++face) {
    most = std::max(most, std::abs(through[at(face)]));
    own = std::max(own, time / width * std::abs(p[at(mesh.high[at(face)])] - p[at(mesh.low[at(face)])]));
  }
  return maxOverRanks(most) / maxOverRanks(own);
}

// Pressures that the cells' gradients do not see drive the gas through the faces as if there were nothing else.
TEST(FaceVelocity, SeesPressuresThatGoUpAndDown) {
  EXPECT_NEAR(deviation(12, 0.1, [](int i) { return i % 2 == 0 ? 1.0 : -1.0; }), 1.0, 1e-12);
}

// Those of smooth waves drive it hardly: the deviation falls as the fourth power of the cells' width, as a share.
TEST(FaceVelocity, LeavesSmoothFlowsAlone) {
  const auto wave = [](int cells) {
    return deviation(cells, 0.1, [=](int i) { return std::cos(2.0 * std::numbers::pi * (i + 0.5) / cells); });
  };
  const double coarse = wave(12), fine = wave(24);
  EXPECT_LT(coarse, 0.005);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.1);
}

// What the faces of a rectangle have in common is taken off; a triangle's have next to nothing else, and keep it.
TEST(FaceVelocity, KeepsAllOfItOnTriangles) {
  for (const Cells cells : {Cells::Quadrilaterals, Cells::Triangles}) {
    const std::vector<Side> sides{side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true),
                                  side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)};
    const Box box(Geometry::Planar, {uniformAxis(1.0, 6), uniformAxis(1.0, 6)}, sides, Gas::hydrogen(),
                  Split{cells, 0.0});
    const Mesh& m = box.mesh;
    std::vector<double> p(at(m.cells)), none(p.size() * 4, 0.0), through(at(m.faces), 0.0);
    for (int c = 0; c < m.cells; ++c) p[at(c)] = m.centre[at(c)][0] + 2.0 * m.centre[at(c)][1];
    FaceVelocity faces(box.context);
    const std::span<const double> zero(none);
    faces.predict({zero.first(2 * p.size()), zero.first(2 * p.size()), zero.first(p.size()), p, zero},
                  std::vector<double>(through.size(), 1.0), 0.1, through);
    double most = 0.0;
    for (int face = 0; face < m.interiorFaces; ++face) {
      const double whole = 0.1 * (p[at(m.low[at(face)])] - p[at(m.high[at(face)])]) / m.distance[at(face)];
      most = std::max(most, std::abs(through[at(face)] - (cells == Cells::Triangles ? whole : 0.0)));
    }
    EXPECT_LT(maxOverRanks(most), 1e-12);
  }
}

// A vortex carried once through a periodic box in a stream three times as fast: the share of its energy that is left.
double energyLeft(VelocityScheme scheme, int cells) {
  Gas& gas = Gas::hydrogen();
  const auto air = gas.massFractions("O2: 0.21, N2: 0.79");
  const double size = 0.02, speed = 10.0, stream = 3.0 * speed;
  MeshSpec spec;
  spec.vertices = {uniformAxis(size, cells), uniformAxis(size, cells)};
  spec.periodic = {true, true};
  const Mesh mesh(MPI_COMM_WORLD, spec);
  HaloExchange halo(mesh);
  const FlowContext context{mesh, halo, gas.mechanism, gas.thermo, gas.transport, {}};
  State state(mesh, air.size(), {});
  const double k = 2.0 * std::numbers::pi / size;
  for (int c = 0; c < mesh.cells; ++c) {
    const Vector3& x = mesh.centre[at(c)];
    state.velocity[at(2 * c)] = stream + speed * std::sin(k * x[0]) * std::cos(k * x[1]);
    state.velocity[at(2 * c + 1)] = -speed * std::cos(k * x[0]) * std::sin(k * x[1]);
    state.temperature[at(c)] = 300.0;
    state.density[at(c)] = gas.thermo.density(300.0, state.thermodynamicPressure, air);
    state.enthalpy[at(c)] = gas.thermo.enthalpyMass(300.0, air);
    std::copy(air.begin(), air.end(), state.Y.begin() + c * static_cast<std::ptrdiff_t>(air.size()));
  }
  const auto energy = [&] {
    return integral(mesh, [&](int c) {
      const double u = state.velocity[at(2 * c)] - stream, v = state.velocity[at(2 * c + 1)];
      return u * u + v * v;
    });
  };
  const double before = energy();
  const int steps = 4 * cells;
  const double time = size / stream, dt = time / steps;
  TransportOperator transport(context, state, {1.0, 2, scheme});
  transport.initialise(state, dt);
  for (int i = 0; i < steps; ++i)
    for (int sweep = 0; sweep < 2; ++sweep) transport.advance(state, i * dt, dt);
  const double viscosity = transport.properties().viscosity[0] / state.density[0];
  return energy() / before / std::exp(-4.0 * k * k * viscosity * time);
}

TEST(VelocityScheme, KeepsVorticesWhereItIsCentral) {
  const double limited = energyLeft(VelocityScheme::Limited, 12), central = energyLeft(VelocityScheme::Central, 12);
  report(fmt::format("a vortex of 6 cells carried once through the box keeps {:.4f} of its energy, central {:.4f}",
                     limited, central));
  EXPECT_LT(limited, 0.85);
  EXPECT_NEAR(central, 0.9605, 0.0015);  // slopes of the wrong cells: 0.9636
}

}  // namespace
}  // namespace lampblack::test
