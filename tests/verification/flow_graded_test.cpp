// Exact solutions on cells that grow from one end to the other, to the last cell: planar and axisymmetric.
#include "flow_exact.hpp"

namespace lampblack::test {
namespace {

// Gas is drawn in through an open end, with what it has there, and sucked out at the other, where a temperature or a
// composition is held: what diffuses against the stream is what is carried less what came in. With the distance along
// the stream, or the logarithm of the radius, and the stream through unity of the one or per radian of the other,
//   lambda dT/ds = m (h - h0),    rho D dY/ds = m (Y - Y0).
class GradedStream : public FlowExact {
 protected:
  std::vector<double> held = gas.massFractions("O2: 0.8, N2: 0.2");

  struct Setting {
    Geometry geometry;
    bool ofComposition;
  };

  const std::size_t oxygen = gas.mechanism.speciesIndex("O2"), nitrogen = gas.mechanism.speciesIndex("N2");

  // Of a temperature or a mass fraction of oxygen.
  [[nodiscard]] std::vector<double> mixture(const Setting& setting, double value) const {
    std::vector<double> Y = n2;
    if (setting.ofComposition) Y[oxygen] = value, Y[nitrogen] = 1.0 - value;
    return Y;
  }

  // Largest error over the difference of the ends.
  double error(const Setting& setting, int cells) {
    const bool axisymmetric = setting.geometry == Geometry::Axisymmetric;
    const double inner = axisymmetric ? 5e-3 : 0.0, outer = inner + 0.01;
    const double T0 = 300.0, T1 = setting.ofComposition ? 300.0 : 450.0;
    const std::vector<double>& Y1 = setting.ofComposition ? held : n2;
    const double speed = axisymmetric ? 0.025 : 0.04;  // at the held end
    Side out = opening(BoundaryKind::Inlet, 0, true, -speed, T1, Y1);
    out.condition.fixedComposition = true;
    Box box(setting.geometry, {gradedAxis(inner, {{outer, cells, 0.25}}), uniformAxis(1e-3, 1)},
            {opening(BoundaryKind::Outlet, 0, false, 0.0, T0, n2), out, side(BoundaryKind::Symmetry, 1, false),
             side(BoundaryKind::Symmetry, 1, true)});
    const double m = gas.thermo.density(T1, 101325.0, Y1) * speed * (axisymmetric ? outer : 1.0);
    const auto along = [&](double x) { return axisymmetric ? std::log(x / outer) : x - outer; };
    const double h0 = gas.thermo.enthalpyMass(T0, n2);
    std::vector<double> X(n2.size()), D(n2.size());
    // Slope along s of the temperature or the mass fraction of oxygen.
    const auto slope = [&](double value) {
      const std::vector<double> Y = mixture(setting, value);
      const double T = setting.ofComposition ? T0 : value;
      gas.thermo.massToMole(Y, X);
      const auto found = gas.transport.mixture(T, 101325.0, X, D);
      if (!setting.ofComposition) return m * (gas.thermo.enthalpyMass(T, Y) - h0) / found.conductivity;
      // The mixture-averaged coefficient of a gas in another is that of the pair times 1 - Y over 1 - X.
      const double pair = D[oxygen] * (1.0 - X[oxygen]) / (1.0 - Y[oxygen]);
      return m * value / (gas.thermo.density(T, 101325.0, Y) * pair);
    };
    const double end = setting.ofComposition ? held[oxygen] : T1;
    const auto exact = [&](double x) {
      constexpr int parts = 200;
      const double ds = along(x) / parts;
      double value = end;
      for (int i = 0; i < parts; ++i) {
        const double a = slope(value), b = slope(value + 0.5 * ds * a), c = slope(value + 0.5 * ds * b);
        value += ds / 6.0 * (a + 2.0 * b + 2.0 * c + slope(value + ds * c));
      }
      return value;
    };
    State state = box.state([&](const Place& x) {
      const double value = exact(x[0]);
      return Box::Local{{0.6 * speed, 0.0}, setting.ofComposition ? T0 : value, mixture(setting, value)};
    });
    TransportOperator transport(box.context, state);
    double smallest = outer;
    for (int c = 0; c < box.mesh.owned; ++c) smallest = std::min(smallest, box.mesh.planarArea[at(c)] / 1e-3);
    const double dt = 0.4 * minOverRanks(smallest) / speed;
    transport.initialise(state, dt);
    const auto valueOf = [&](int c) {
      return setting.ofComposition ? state.Y[at(c) * n2.size() + oxygen] : state.temperature[at(c)];
    };
    double change = 1.0;
    std::vector<double> before(at(box.mesh.owned));
    for (int step = 0; step < 200 * cells && change > 1e-11; ++step) {
      for (int c = 0; c < box.mesh.owned; ++c) before[at(c)] = valueOf(c);
      transport.advance(state, 0.0, dt);
      change = largest(box.mesh, [&](int c) { return std::abs(valueOf(c) - before[at(c)]); }) /
               (setting.ofComposition ? 1.0 : T1 - T0);
    }
    EXPECT_LT(change, 1e-9) << "not steady";
    return largest(box.mesh, [&](int c) { return std::abs(valueOf(c) - exact(box.mesh.centre[at(c)][0])); }) /
           (setting.ofComposition ? 1.0 : T1 - T0);
  }
};

TEST_F(GradedStream, DiffusionAgainstConvectionIsOfSecondOrderToTheLastCell) {
  for (const Geometry geometry : {Geometry::Planar, Geometry::Axisymmetric})
    for (const bool ofComposition : {false, true}) {
      std::array<double, 3> found{};
      for (std::size_t level = 0; level < 3; ++level) found[level] = error({geometry, ofComposition}, 10 << level);
      expectOrders(fmt::format("{} against convection on graded cells, {}, 10, 20, 40 cells",
                               ofComposition ? "diffusion" : "conduction",
                               geometry == Geometry::Planar ? "planar" : "axisymmetric"),
                   found, 1.85);
    }
}

using FlowGraded = FlowExact;

// The developed flow through a pipe whose cells shrink towards the wall and grow along it, in all cells.
TEST_F(FlowGraded, DevelopedPipeFlow) {
  const double radius = 1e-3, length = 3e-3, mean = 2.0 * viscosity() / (2.0 * radius);
  const auto v = [&](const Place& x, double) { return 2.0 * mean * (1.0 - x[0] * x[0] / (radius * radius)); };
  const auto none = [](const Place&, double) { return 0.0; };
  std::array<double, 3> along{}, across{};
  for (std::size_t level = 0; level < 3; ++level) {
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
TEST_F(FlowGraded, LineSource) {
  const double inner = 2e-3, outer = 6e-3, speed = 0.05;
  std::array<double, 3> found{};
  for (std::size_t level = 0; level < 3; ++level) {
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
TEST_F(FlowExact, KovasznayOnGradedCells) {
  expectKovasznay(
      "Kovasznay on graded cells",
      [](int cells) {
        return std::array{gradedAxis(0.0, {{1.5, 3 * cells / 2, 3.0}}), gradedAxis(0.0, {{0.5, cells / 2, 2.0}})};
      },
      80, {1.8, 1.9, 1.8, 1.6});
}

}  // namespace
}  // namespace lampblack::test
