// Exact solutions on cells that grow from one end to the other, to the last cell: planar and axisymmetric.
#include "flow_exact.hpp"
#include "graded_stream.hpp"

namespace lampblack::test {
namespace {

using GradedStreamLong = GradedStream;

TEST_F(GradedStreamLong, DiffusionAgainstConvectionIsOfSecondOrderToTheLastCell) {
  for (const Geometry geometry : {Geometry::Planar, Geometry::Axisymmetric})
    for (const bool ofComposition : {false, true}) {
      std::array<double, 3> found{};
      for (std::size_t level = 0; level < levels(); ++level)
        found[level] = error({geometry, ofComposition}, 10 << level);
      expectOrders(fmt::format("{} against convection on graded cells, {}, 10, 20, 40 cells",
                               ofComposition ? "diffusion" : "conduction",
                               geometry == Geometry::Planar ? "planar" : "axisymmetric"),
                   found, 1.85);
    }
}

using FlowGradedLong = FlowExact;

// The developed flow through a pipe whose cells shrink towards the wall and grow along it, in all cells.
TEST_F(FlowGradedLong, DevelopedPipeFlow) {
  const double radius = 1e-3, length = 3e-3, mean = 2.0 * viscosity() / (2.0 * radius);
  const auto v = [&](const Place& x, double) { return 2.0 * mean * (1.0 - x[0] * x[0] / (radius * radius)); };
  const auto none = [](const Place&, double) { return 0.0; };
  std::array<double, 3> along{}, across{};
  for (std::size_t level = 0; level < levels(); ++level) {
    const int cells = 8 << level;
    Side wall = side(BoundaryKind::Wall, 0, true);
    wall.condition.slip = false;
    Box box(Geometry::Axisymmetric, {gradedAxis(0.0, {{radius, cells, 0.25}}), gradedAxis(0.0, {{length, cells, 3.0}})},
            {side(BoundaryKind::Symmetry, 0, false), wall, stream(1, false, v, none),
             opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, n2)});
    bringToLife(box);
    State state = box.state([&](const Place& x) { return Box::Local{{0.0, v(x, 0.0)}, 300.0, n2}; });
    const double dt = 0.2 * radius / cells / (2.0 * mean);
    TransportOperator transport(box.context, state);
    transport.initialise(state, dt);
    for (int step = 0; step < 40 * cells; ++step) transport.advance(state, 0.0, dt);
    along[level] = largest(box.mesh, [&](int c) {
      return std::abs(state.velocity[at(2 * c + 1)] - v(box.mesh.centre[at(c)], 0.0)) / mean;
    });
    across[level] = largest(box.mesh, [&](int c) { return std::abs(state.velocity[at(2 * c)]) / mean; });
  }
  expectOrders("pipe on graded cells, 8, 16, 32 over the radius, v, largest", along, 1.85);
  expectOrders("pipe on graded cells, u, largest", across, 1.85);
}

// From an annulus's inner to its outer surface: r v_r is constant.
TEST_F(FlowGradedLong, LineSource) {
  const double inner = 2e-3, outer = 6e-3, speed = 0.05;
  std::array<double, 3> found{};
  for (std::size_t level = 0; level < levels(); ++level) {
    const int cells = 10 << level;
    Box box(Geometry::Axisymmetric, {gradedAxis(inner, {{outer, cells, 3.0}}), uniformAxis(1e-3, 2)},
            {opening(BoundaryKind::Inlet, 0, false, speed, 300.0, n2),
             opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, n2), side(BoundaryKind::Symmetry, 1, false),
             side(BoundaryKind::Symmetry, 1, true)});
    State state = box.state([&](const Place& x) { return Box::Local{{speed * inner / x[0], 0.0}, 300.0, n2}; });
    const double dt = 0.2 * (outer - inner) / cells / speed;
    TransportOperator transport(box.context, state);
    transport.initialise(state, dt);
    for (int step = 0; step < 40 * cells; ++step) transport.advance(state, 0.0, dt);
    found[level] = largest(box.mesh, [&](int c) {
      return std::abs(state.velocity[at(2 * c)] * box.mesh.centre[at(c)][0] / (speed * inner) - 1.0);
    });
  }
  expectOrders("line source on graded cells, 10, 20, 40, largest", found, 1.85);
}

// On cells that grow along both axes.
TEST_F(FlowGradedLong, KovasznayOnGradedCells) {
  expectKovasznay("Kovasznay on graded cells",
                  [](int cells) {
                    return Axes{gradedAxis(0.0, {{1.5, 3 * cells / 2, 3.0}}), gradedAxis(0.0, {{0.5, cells / 2, 2.0}})};
                  },
                  80, {1.8, 1.9, 1.8, 1.6});
}

}  // namespace
}  // namespace lampblack::test
