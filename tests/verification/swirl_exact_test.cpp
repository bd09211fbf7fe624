// Exact solutions with swirl at constant density: a pipe that has been stopped, the vortex of Burgers (1948), the disk
// of von Karman (1921).
#include "flow_exact.hpp"

namespace lampblack::test {
namespace {

class SwirlExact : public FlowExact {
 protected:
  State swirling(Box& box, const std::function<Place(const Place&)>& velocity,
                 const std::function<double(const Place&)>& swirl) {
    State state = box.state([&](const Place& x) { return Box::Local{velocity(x), 300.0, n2}; }, {}, true);
    for (int c = 0; c < box.mesh.cells; ++c) state.swirl[at(c)] = swirl(box.mesh.centre[at(c)]);
    return state;
  }
  static void march(TransportOperator& transport, State& state, int steps, double dt) {
    transport.initialise(state, dt);
    for (int step = 0; step < steps; ++step)
      for (int sweep = 0; sweep < 2; ++sweep) transport.advance(state, step * dt, dt);
  }
};

// The wall holds the gas, w = J1(k r) exp(-nu k^2 t): steps in proportion to the mesh's width.
TEST_F(SwirlExact, StoppedPipe) {
  const double radius = 1e-3, k = 3.8317059702075125 / radius, speed = 0.1;
  const double duration = 0.5 / (viscosity() * k * k);
  const auto w = [&](const Place& x, double t) {
    return speed * std::cyl_bessel_j(1.0, k * x[0]) * std::exp(-viscosity() * k * k * t);
  };
  std::array<double, 3> error{};
  for (std::size_t level = 0; level < levels(); ++level) {
    Side wall = side(BoundaryKind::Wall, 0, true);
    wall.condition.slip = false;
    Box box(Geometry::Axisymmetric, {uniformAxis(radius, 12 << level), uniformAxis(radius, 3)},
            {side(BoundaryKind::Symmetry, 0, false), wall, side(BoundaryKind::Symmetry, 1, false),
             side(BoundaryKind::Symmetry, 1, true)});
    State state = swirling(
        box,
        [](const Place&) {
          return Place{0.0, 0.0, 0.0};
        },
        [&](const Place& x) { return w(x, 0.0); });
    const int steps = 10 << level;
    const double dt = duration / steps;
    TransportOperator transport(box.context, state, {0.5, 2});
    march(transport, state, steps, dt);
    const double end = duration - 0.5 * dt;
    error[level] = meanError(box, [&](int c) { return (state.swirl[at(c)] - w(box.mesh.centre[at(c)], end)) / speed; });
  }
  expectOrders("stopped pipe, 12, 24, 48 cells over the radius", error, 1.9);
}

// Gas that streams in from all around, u = -a r/2, v = a z, draws its swirl together until viscosity holds it,
// w = W R/r (1 - exp(-a r^2/(4 nu))) / (1 - exp(-a R^2/(4 nu))). The start is another: a solid body.
TEST_F(SwirlExact, BurgersVortex) {
  const double radius = 1e-2, height = 5e-3, speed = 0.1;
  const double a = 4.0 * viscosity() / (3e-3 * 3e-3);
  const auto core = [&](double r) { return -std::expm1(-a * r * r / (4.0 * viscosity())); };
  const auto w = [&](const Place& x, double) { return speed * radius / x[0] * core(x[0]) / core(radius); };
  std::array<double, 3> error{};
  for (std::size_t level = 0; level < levels(); ++level) {
    const int cells = 12 << level;
    Side around = stream(
        0, true, [&](const Place&, double) { return 0.5 * a * radius; },
        [&](const Place& x, double) { return a * x[1]; });
    around.condition.varies.swirl = w;
    const Side top = stream(
        1, true, [&](const Place&, double) { return -a * height; },
        [&](const Place& x, double) { return -0.5 * a * x[0]; });
    Box box(Geometry::Axisymmetric, {uniformAxis(radius, cells), uniformAxis(height, cells / 4)},
            {side(BoundaryKind::Symmetry, 0, false), around, side(BoundaryKind::Symmetry, 1, false), top});
    bringToLife(box);
    State state = swirling(
        box,
        [&](const Place& x) {
          return Place{-0.5 * a * x[0], a * x[1], 0.0};
        },
        [&](const Place& x) { return speed * x[0] / radius; });
    const double dt = 0.5 / (a * cells);
    TransportOperator transport(box.context, state, {0.5, 2});
    march(transport, state, static_cast<int>(8.0 / (a * dt)), dt);
    error[level] = meanError(box, [&](int c) { return (state.swirl[at(c)] - w(box.mesh.centre[at(c)], 0.0)) / speed; });
  }
  expectOrders("Burgers' vortex, 12, 24, 48 cells over the radius", error, 1.8);
}

// Solid bodies that turn at different rates, one behind the other, pass a pipe of slip walls and leave it through its
// outlet: w = r W(z, t), W = exp(-nu k^2 t) sin(k (z - V t)).
TEST_F(SwirlExact, WaveThatLeavesAPipe) {
  const double length = 1e-2, k = 2.0 * pi / length, along = 0.1, turning = 10.0;
  const auto w = [&](const Place& x, double t) {
    return turning * x[0] * std::exp(-viscosity() * k * k * t) * std::sin(k * (x[1] - along * t));
  };
  std::array<double, 3> error{}, atOutlet{};
  for (std::size_t level = 0; level < levels(); ++level) {
    const int cells = 16 << level;
    Side in = opening(BoundaryKind::Inlet, 1, false, along, 300.0, n2);
    in.condition.varies.swirl = w;
    Box box(Geometry::Axisymmetric, {uniformAxis(1e-3, 3), uniformAxis(length, cells)},
            {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true), in,
             opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, n2)});
    bringToLife(box);
    State state = swirling(
        box,
        [&](const Place&) {
          return Place{0.0, along, 0.0};
        },
        [&](const Place& x) { return w(x, 0.0); });
    const double dt = 0.25 * length / cells / along;
    const int steps = 4 * cells;
    TransportOperator transport(box.context, state, {0.5, 2});
    march(transport, state, steps, dt);
    const auto errorOf = [&](int c) {
      const Place& x = box.mesh.centre[at(c)];
      return (state.swirl[at(c)] - w(x, (steps - 0.5) * dt)) / (turning * x[0]);
    };
    error[level] = meanError(box, errorOf);
    atOutlet[level] = largest(box.mesh, [&](int c) {
      return box.mesh.centre[at(c)][1] > length * (1.0 - 1.0 / cells) ? std::abs(errorOf(c)) : 0.0;
    });
  }
  expectOrders("wave that leaves a pipe, 16, 32, 64 cells a wave", error, 1.8);
  expectOrders("wave that leaves a pipe, in the last cells", atOutlet, 1.8);
}

// Gas blown outwards from a cylinder that turns, u = Q/r, keeps its angular momentum, w = C/r, up to its outlet. The
// start turns as a solid body.
TEST_F(SwirlExact, VortexWithASource) {
  const double inner = 1e-3, outer = 2e-3, speed = 0.1;
  const double source = 3.0 * viscosity();
  std::array<double, 3> error{};
  for (std::size_t level = 0; level < levels(); ++level) {
    const int cells = 8 << level;
    Side in = opening(BoundaryKind::Inlet, 0, false, source / inner, 300.0, n2);
    in.condition.varies.swirl = [&](const Place&, double) { return speed; };
    Box box(Geometry::Axisymmetric, {gradedAxis(inner, {{outer, cells, 1.0}}), uniformAxis(1e-3, 3)},
            {in, opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, n2), side(BoundaryKind::Symmetry, 1, false),
             side(BoundaryKind::Symmetry, 1, true)});
    bringToLife(box);
    State state = swirling(
        box,
        [&](const Place& x) {
          return Place{source / x[0], 0.0, 0.0};
        },
        [&](const Place& x) { return speed * x[0] / inner; });
    const double dt = 0.4 * (outer - inner) / cells * inner / source;
    TransportOperator transport(box.context, state, {0.5, 2});
    march(transport, state, 40 * cells, dt);
    error[level] = largest(box.mesh, [&](int c) {
      return std::abs(state.swirl[at(c)] - speed * inner / box.mesh.centre[at(c)][0]) / speed;
    });
  }
  expectOrders("vortex with a source, largest error, 8, 16, 32 cells", error, 1.8);
}

// Rings of gas that turn over in a can of slip walls, in along its middle and out along its ends, carry the angular
// momentum that they find beside the wall: that of its cells against the mean of the same place on a mesh twice as
// fine.
TEST_F(SwirlExact, RingsBesideASlipWall) {
  const double radius = 1e-2, turning = 10.0, speed = 0.02, duration = 0.05;
  // Mean angular momentum, over the start's at the wall, of as many pieces of the can's outermost layer as `cells`.
  const auto besideWall = [&](const Box& box, const State& state, int cells) {
    std::vector<double> sums(at(2 * cells), 0.0);
    for (int c = 0; c < box.mesh.owned; ++c) {
      const Place& x = box.mesh.centre[at(c)];
      if (x[0] < radius * (1.0 - 1.0 / cells)) continue;
      const int piece = static_cast<int>(x[1] / radius * cells);
      sums[at(piece)] += box.mesh.volume[at(c)] * x[0] * state.swirl[at(c)] / (turning * radius * radius);
      sums[at(cells + piece)] += box.mesh.volume[at(c)];
    }
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2 * cells, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    for (int i = 0; i < cells; ++i) sums[at(i)] /= sums[at(cells + i)];
    sums.resize(at(cells));
    return sums;
  };
  std::array<double, 3> change{};
  std::vector<double> coarser;
  for (std::size_t level = 0; level <= levels(); ++level) {
    const int cells = 8 << level;
    Box box(Geometry::Axisymmetric, {uniformAxis(radius, cells), uniformAxis(radius, cells)},
            {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
             side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)});
    State state = swirling(
        box,
        [&](const Place& x) {
          const double s = x[0] / radius, a = pi * x[1] / radius;
          return Place{-pi * speed * s * (1.0 - s * s) * std::cos(a), speed * (2.0 - 4.0 * s * s) * std::sin(a), 0.0};
        },
        [&](const Place& x) { return turning * x[0]; });
    const int steps = 2 * cells;
    TransportOperator transport(box.context, state, {0.5, 2});
    march(transport, state, steps, duration / steps);
    if (level > 0) {
      const std::vector<double> finer = besideWall(box, state, cells / 2);
      for (std::size_t i = 0; i < finer.size(); ++i)
        change[level - 1] = std::max(change[level - 1], std::abs(finer[i] - coarser[i]));
    }
    coarser = besideWall(box, state, cells);
  }
  expectOrders("rings beside a slip wall, 8, 16, 32 cells", change, 1.8);
  if (isLongRun()) {
    EXPECT_LT(change[2], 1e-3);  // 1.8e-3 where the cells beside the wall see no slope
  }
}

// A disk that turns throws the gas beside it outwards, which draws in gas along the axis. With z in units of
// sqrt(nu/W): u = r W F, w = r W G, v = sqrt(nu W) H, where F'' = F^2 - G^2 + H F', G'' = 2 F G + H G', H' = -2 F.
TEST_F(SwirlExact, TurningDisk) {
  const double turning = 50.0, length = std::sqrt(viscosity() / turning), radius = 20.0 * length;
  struct Similar {
    double F, dF, G, dG, H;
  };
  // The slopes at the disk with which all goes to rest far away (Rogers and Lance 1960).
  std::vector<Similar> table{{0.0, 0.5102326, 1.0, -0.6159220, 0.0}};
  const double step = 1e-3, far = 4.0;
  const auto rate = [](const Similar& s) {
    return Similar{s.dF, s.F * s.F - s.G * s.G + s.H * s.dF, s.dG, 2.0 * s.F * s.G + s.H * s.dG, -2.0 * s.F};
  };
  const auto moved = [](const Similar& s, const Similar& d, double h) {
    return Similar{s.F + h * d.F, s.dF + h * d.dF, s.G + h * d.G, s.dG + h * d.dG, s.H + h * d.H};
  };
  while (static_cast<double>(table.size()) * step < far + 1.0)
    table.push_back(moved(table.back(), rate(moved(table.back(), rate(table.back()), 0.5 * step)), step));
  const double drawn = 0.8844741 * std::sqrt(viscosity() * turning);

  std::array<double, 3> radial{}, swirl{}, axial{};
  for (std::size_t level = 0; level < levels(); ++level) {
    Side disk = side(BoundaryKind::Wall, 1, false);
    disk.condition.slip = false;
    disk.condition.varies.swirl = [&](const Place& x, double) { return turning * x[0]; };
    Box box(Geometry::Axisymmetric,
            {uniformAxis(radius, 10 << level), gradedAxis(0.0, {{12.0 * length, 12 << level, 4.0}})},
            {side(BoundaryKind::Symmetry, 0, false), opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, n2), disk,
             opening(BoundaryKind::Inlet, 1, true, drawn, 300.0, n2)});
    bringToLife(box);
    State state = swirling(
        box,
        [&](const Place& x) {
          return Place{0.0, -drawn * std::min(1.0, x[1] / length), 0.0};
        },
        [](const Place&) { return 0.0; });
    TransportOperator transport(box.context, state, {0.5, 2});
    transport.initialise(state, 1e-4);
    double time = 0.0;
    while (time < 15.0 / turning) {
      const double dt = std::min(transport.largestStep(state), 0.2 / turning);
      ASSERT_GT(dt, 1e-4 / turning) << "the gas runs away";
      for (int sweep = 0; sweep < 2; ++sweep) transport.advance(state, time, dt);
      time += dt;
    }
    for (int c = 0; c < box.mesh.owned; ++c) {
      const Place& x = box.mesh.centre[at(c)];
      if (x[0] > 0.5 * radius || x[1] > far * length) continue;
      const Similar& exact = table[at(std::lround(x[1] / length / step))];
      radial[level] = std::max(radial[level], std::abs(state.velocity[at(2 * c)] / (turning * x[0]) - exact.F));
      swirl[level] = std::max(swirl[level], std::abs(state.swirl[at(c)] / (turning * x[0]) - exact.G));
      axial[level] =
          std::max(axial[level], std::abs(state.velocity[at(2 * c + 1)] / std::sqrt(viscosity() * turning) - exact.H));
    }
    for (double* error : {&radial[level], &swirl[level], &axial[level]}) *error = maxOverRanks(*error);
  }
  expectOrders("turning disk, u", radial, 1.85);
  expectOrders("turning disk, w", swirl, 1.85, 0.6);  // the layer on the disk has a few cells only
  expectOrders("turning disk, v", axial, 1.85);
}

}  // namespace
}  // namespace lampblack::test
