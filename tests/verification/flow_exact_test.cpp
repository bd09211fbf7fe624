// Exact solutions of the Navier-Stokes equations at constant density: Kovasznay (1948), the decaying vortices of Taylor
// and Green (1937), the pulsating flow through a pipe of Womersley (1955).
#include "flow_exact.hpp"

#include <complex>

namespace lampblack::test {
namespace {

TEST_F(FlowExact, Kovasznay) {
  expectKovasznay("Kovasznay, 12, 24, 48 cells a wave",
                  [](int cells) {
                    return Axes{uniformAxis(1.5, 3 * cells / 2), uniformAxis(0.5, cells / 2)};
                  },
                  40, {1.85, 1.9, 1.85, 1.9});
}

// Vortices between planes of symmetry that viscosity takes away: steps in proportion to the mesh's width.
TEST_F(FlowExact, TaylorGreen) {
  const double length = 1e-3;
  const Vortices flow = vortices(5.0, length);
  const double speed = flow.speed, duration = 0.5 / flow.decay;
  std::array<double, 3> velocity{}, pressure{};
  for (std::size_t level = 0; level < levels(); ++level) {
    const int cells = 16 << level;
    Box box(Geometry::Planar, {uniformAxis(length, cells), uniformAxis(length, cells)},
            {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
             side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)});
    State state = box.state([&](const Place& x) { return Box::Local{{flow.u(x, 0.0), flow.v(x, 0.0)}, 300.0, n2}; });
    const int steps = static_cast<int>(std::ceil(duration * speed / (0.2 * length / cells)));
    const double dt = duration / steps;
    TransportOperator transport(box.context, state, {0.5, 2});
    transport.initialise(state, dt);
    for (int i = 0; i < steps; ++i)
      for (int sweep = 0; sweep < 2; ++sweep) transport.advance(state, i * dt, dt);
    // Velocities stand half a step before the gas, pressures are those in the middle of what moves them.
    const double time = duration - 0.5 * dt, timeOfPressure = duration - dt;
    velocity[level] =
        meanError(box, [&](int c) { return state.velocity[at(2 * c)] - flow.u(box.mesh.centre[at(c)], time); }) / speed;
    const double mean = integral(box.mesh, [&](int c) { return state.pressure[at(c)]; }) / (length * length);
    pressure[level] =
        meanError(
            box, [&](int c) { return state.pressure[at(c)] - mean - flow.p(box.mesh.centre[at(c)], timeOfPressure); }) /
        (density * speed * speed);
  }
  expectOrders("Taylor-Green, 16, 32, 64 cells a vortex, u", velocity, 1.8);
  expectOrders("Taylor-Green, p", pressure, 1.9);
}

// J0 of a complex argument by its series.
std::complex<double> besselJ0(std::complex<double> z) {
  std::complex<double> term = 1.0, sum = 1.0;
  for (int i = 1; i < 60; ++i) sum += term *= -z * z / (4.0 * i * i);
  return sum;
}

// A pressure gradient G cos(w t) moves the gas in a pipe; Womersley number 4, the developed flow given at the inlet.
TEST_F(FlowExact, Womersley) {
  const double womersley = 4.0, radius = 1e-3, length = 6e-3;
  const double w = womersley * womersley * viscosity() / (radius * radius);
  const double period = 2.0 * pi / w;
  const double speed = 0.05;
  const std::complex<double> i(0.0, 1.0), lambda = std::pow(i, 1.5) * womersley;
  const auto v = [&](const Place& x, double t) {
    return std::real(speed * (1.0 - besselJ0(lambda * x[0] / radius) / besselJ0(lambda)) * std::exp(i * w * t));
  };
  const auto none = [](const Place&, double) { return 0.0; };
  std::array<double, 3> error{};
  for (std::size_t level = 0; level < levels(); ++level) {
    const int cells = 8 << level;
    Side wall = side(BoundaryKind::Wall, 0, true);
    wall.condition.slip = false;
    Box box(Geometry::Axisymmetric, {uniformAxis(radius, cells), uniformAxis(length, 8)},
            {side(BoundaryKind::Symmetry, 0, false), wall, stream(1, false, v, none),
             opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, n2)});
    bringToLife(box);
    State state = box.state([&](const Place& x) { return Box::Local{{0.0, v(x, 0.0)}, 300.0, n2}; });
    const int steps = 40 << level;  // a period
    const double dt = period / steps;
    TransportOperator transport(box.context, state, {0.5, 2});
    transport.initialise(state, dt);
    double sum = 0.0;
    for (int step = 0; step < 2 * steps; ++step) {
      for (int sweep = 0; sweep < 2; ++sweep) transport.advance(state, step * dt, dt);
      if (step < steps) continue;
      sum += meanError(box,
                       [&](int c) {
                         const Place& x = box.mesh.centre[at(c)];
                         return x[1] < 0.75 * length ? state.velocity[at(2 * c + 1)] - v(x, (step + 0.5) * dt) : 0.0;
                       }) /
             speed;
    }
    error[level] = sum / steps;
  }
  expectOrders("Womersley, 8, 16, 32 cells over the radius", error, 1.9);
}

// A wall that moves to and fro along itself under a gas at rest (Stokes 1851): u = U exp(-ky) cos(wt - ky), on a
// periodic axis.
TEST_F(FlowExact, WallThatOscillates) {
  const double depth = 1e-3, k = 6.0 / depth, speed = 0.1;
  const double w = 2.0 * viscosity() * k * k, period = 2.0 * pi / w;
  const auto u = [&](const Place& x, double t) { return speed * std::exp(-k * x[1]) * std::cos(w * t - k * x[1]); };
  Side wall = side(BoundaryKind::Wall, 1, false), top = side(BoundaryKind::Wall, 1, true);
  wall.condition.slip = top.condition.slip = false;
  wall.condition.varies.tangential = u;
  top.condition.varies.tangential = u;
  // Two sweeps leave an error of first order where viscosity is stiff, nu dt/h2 = 1 to 4 here.
  for (const int sweeps : {2, 3}) {
    std::array<double, 3> error{};
    for (std::size_t level = 0; level < levels(); ++level) {
      MeshSpec spec;
      spec.vertices = {uniformAxis(depth, 3), uniformAxis(depth, 16 << level)};
      spec.periodic = {true, false};
      spec.patches = {wall.patch, top.patch};
      const Mesh mesh(MPI_COMM_WORLD, spec);
      HaloExchange halo(mesh);
      FlowContext context{mesh, halo, gas.mechanism, gas.thermo, gas.transport, {wall.condition, top.condition}};
      context.varying = std::make_shared<BoundaryValues>(mesh, context.boundaries, gas.thermo);
      State state(mesh, n2.size(), {});
      for (int c = 0; c < mesh.cells; ++c) {
        state.velocity[at(2 * c)] = u(mesh.centre[at(c)], 0.0);
        state.temperature[at(c)] = 300.0;
        state.density[at(c)] = density;
        state.enthalpy[at(c)] = gas.thermo.enthalpyMass(300.0, n2);
        std::copy(n2.begin(), n2.end(), state.Y.begin() + c * static_cast<std::ptrdiff_t>(n2.size()));
      }
      const int steps = 20 << level;
      const double dt = period / steps;
      TransportOperator transport(context, state, {0.5, sweeps});
      transport.initialise(state, dt);
      for (int step = 0; step < steps; ++step)
        for (int sweep = 0; sweep < sweeps; ++sweep) transport.advance(state, step * dt, dt);
      const double time = period - 0.5 * dt;
      error[level] =
          largest(mesh, [&](int c) { return std::abs(state.velocity[at(2 * c)] - u(mesh.centre[at(c)], time)); }) /
          speed;
    }
    expectOrders(fmt::format("oscillating wall, {} sweeps, 16, 32, 64 cells", sweeps), error, sweeps == 2 ? 1.8 : 1.95);
  }
}

}  // namespace
}  // namespace lampblack::test
