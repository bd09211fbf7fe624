// Exact axisymmetric flows of constant density: the developed flow through a pipe, and the flow from a line source.
#include "flow_exact.hpp"

namespace lampblack::test {
namespace {

class FlowAxisymmetric : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  std::vector<double> n2 = gas.massFractions("N2: 1");
  double viscosity() {
    std::vector<double> X(n2.size());
    std::vector<double> D(n2.size());
    gas.thermo.massToMole(n2, X);
    return gas.transport.mixture(300.0, 101325.0, X, D).viscosity / gas.thermo.density(300.0, 101325.0, n2);  // m2/s
  }
};

// A plug enters; behind the entrance (3 diameters at a Reynolds number of 2, where what differs from the developed
// profile has decayed as exp(-4.4 z/R), by 3e-8 half a diameter before the outlet) the profile is 2 U (1 - (r/R)^2).
TEST_F(FlowAxisymmetric, DevelopedPipeFlowIsParabolicToSecondOrder) {
  const double radius = 1e-3;
  const double length = 5e-3;
  const double mean = 2.0 * viscosity() / (2.0 * radius);
  std::array<double, 3> error{};
  for (std::size_t level = 0; level < levels(); ++level) {
    const int cells = 4 << level;
    Side wall = side(BoundaryKind::Wall, 0, true);
    wall.condition.slip = false;
    Box box(Geometry::Axisymmetric, {uniformAxis(radius, cells), uniformAxis(length, 20)},
            {side(BoundaryKind::Symmetry, 0, false), wall, opening(BoundaryKind::Inlet, 1, false, mean, 300.0, n2),
             opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, n2)});
    const auto exact = [&](double r) { return 2.0 * mean * (1.0 - r * r / (radius * radius)); };
    State state = box.state([&](const auto& x) { return Box::Local{{0.0, exact(x[0])}, 300.0, n2}; });
    const double change = settle(box, state, 0.4 * length / 20 / (2.0 * mean), 400, 1e-7 * mean);
    EXPECT_LE(change, 1e-6 * mean) << "not steady";
    error[level] = largest(box.mesh, [&](int c) {
      const auto& x = box.mesh.centre[at(c)];
      if (x[1] < 0.7 * length || x[1] > 0.85 * length) return 0.0;
      return std::abs(state.velocity[at(2 * c + 1)] - exact(x[0])) / mean;
    });
  }
  expectOrders("pipe, 4, 8, 16 cells over the radius", error, 1.7, 0.0);
}

// From an annulus's inner to its outer surface: r v_r is constant, whatever the viscosity.
TEST_F(FlowAxisymmetric, RadialSourceFlowKeepsTheFluxAndIsSecondOrder) {
  const double inner = 2e-3;
  const double outer = 6e-3;
  const double speed = 0.05;
  double error[3], atInlet[3], nearOutlet[3];
  for (int level = 0; level < 3; ++level) {
    const int cells = 10 << level;
    Box box(Geometry::Axisymmetric, {gradedAxis(inner, {{outer, cells, 1.0}}), uniformAxis(1e-3, 2)},
            {opening(BoundaryKind::Inlet, 0, false, speed, 300.0, n2),
             opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, n2), side(BoundaryKind::Symmetry, 1, false),
             side(BoundaryKind::Symmetry, 1, true)});
    const Mesh& m = box.mesh;
    State state = box.state([&](const auto& x) { return Box::Local{{speed * inner / x[0], 0.0}, 300.0, n2}; });
    const double dt = 0.4 * (outer - inner) / cells / speed;
    const double change = settle(box, state, dt, 20 * cells, 1e-8 * speed);
    EXPECT_LE(change, 1e-6 * speed) << "not steady";
    // The mass flux through every cylinder is the inlet's: each ring of cells adds at most the projection's tolerance,
    // 1e-9 of the largest face flow.
    const double density = gas.thermo.density(300.0, 101325.0, n2);
    for (int face = 0; face < m.faces; ++face) {
      if (axisOf(m, face) != 0) continue;
      const double rv =
          m.normal[at(face)][0] * state.massFlux[at(face)] / density * m.faceCentre[at(face)][0] / m.area[at(face)];
      EXPECT_NEAR(rv / (speed * inner), 1.0, 2.0 * cells * 1e-9) << "r = " << m.faceCentre[at(face)][0];
    }
    const auto deviation = [&](double from, double to) {
      return largest(m, [&](int c) {
        const double r = m.centre[at(c)][0];
        if (r < from || r > to) return 0.0;
        return std::abs(state.velocity[at(2 * c)] * r / (speed * inner) - 1.0);
      });
    };
    const double secondCell = inner + (outer - inner) / cells;
    atInlet[level] = deviation(inner, secondCell);
    error[level] = deviation(secondCell, 5e-3);
    nearOutlet[level] = deviation(5e-3, outer);
  }
  for (const auto& [where, e] :
       {std::pair{"within", error}, std::pair{"in the inlet's cells", atInlet}, std::pair{"at the outlet", nearOutlet}})
    report(fmt::format("radial source, 10, 20, 40 cells, {}: errors {:.2e} {:.2e} {:.2e}, orders {:.2f} {:.2f}", where,
                       e[0], e[1], e[2], std::log2(e[0] / e[1]), std::log2(e[1] / e[2])));
  EXPECT_GT(std::log2(error[0] / error[1]), 1.8);
  EXPECT_GT(std::log2(error[1] / error[2]), 1.8);
  // The slope of the pressure in the inlet's cells is that on their other side.
  EXPECT_GT(std::log2(atInlet[1] / atInlet[2]), 1.2);
  // The outlet takes the velocity of the cell before it and no viscous flux: first order in the last few cells, of
  // which 0.5 allows for the mixture with second-order terms on such meshes.
  EXPECT_GT(std::log2(nearOutlet[1] / nearOutlet[2]), 0.5);
}

}  // namespace
}  // namespace lampblack::test
