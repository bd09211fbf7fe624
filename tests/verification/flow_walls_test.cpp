// Particles that laminar flows lose to walls: by diffusion between plates, and by thermophoresis in a cooled tube.
#include "flow_exact.hpp"

namespace lampblack::test {
namespace {

class FlowExactLong : public FlowExact {};

// Steady after a flow of so many seconds: particles come into the cells below `band` as the gas flows through them.
void feed(Box& box, State& state, TransportOperator& transport, double band, double time, double courant) {
  const double dt = courant * [&] {
    double shortest = 1.0;
    for (int c = 0; c < box.mesh.owned; ++c) {
      double through = 0.0;
      for (int i = box.mesh.faceStart[at(c)]; i < box.mesh.faceStart[at(c) + 1]; ++i)
        through += std::abs(state.massFlux[at(box.mesh.faceOfCell[at(i)])]);
      if (through > 0.0) shortest = std::min(shortest, 2.0 * box.mesh.volume[at(c)] * state.density[at(c)] / through);
    }
    return shortest;
  }();
  for (int step = 0; step * dt < time; ++step) {
    for (int c = 0; c < box.mesh.owned; ++c)
      state.balance.carried[at(c)] =
          box.mesh.centre[at(c)][1] < band ? state.density[at(c)] * state.velocity[at(2 * c + 1)] : 0.0;
    transport.advance(state, step * dt, dt);
  }
}

// Far from the inlet particles decay along the plates with the Sherwood number 4 h J/(rho D c) = 7.5407, c being the
// mean over the flow: the Nusselt number of plates of one temperature (Shah and London 1978).
TEST_F(FlowExactLong, PlatesThatTakeParticles) {
  const double h = 1e-3, length = 32.0 * h, mean = 1.0, D = mean * h / 50.0, station = 27.0 * h;
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const int across = 8 << level, along = 32 << level;
    const Velocity parabola = [&](const Place& x, double) { return 1.5 * mean * (1.0 - x[0] * x[0] / (h * h)); };
    Side wall = side(BoundaryKind::Wall, 0, true);
    wall.condition.slip = false;
    wall.condition.takesParticles = true;
    Box box(Geometry::Planar, {uniformAxis(h, across), uniformAxis(length, along)},
            {side(BoundaryKind::Symmetry, 0, false), wall, stream(1, false, parabola, {}),
             opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, n2)});
    bringToLife(box);
    State state = box.state(
        [&](const Place& x) {
          return Box::Local{{0.0, parabola(x, 0.0)}, 300.0, n2};
        },
        {{"dust", "1/m3", "", 0.0}});
    std::fill(state.carriedDiffusivity.begin(), state.carriedDiffusivity.end(), D);
    TransportOperator transport(box.context, state);
    transport.initialise(state, 1e-5);
    feed(box, state, transport, 2.0 * h, 5.0 * length / mean, 0.5);
    double flux = 0.0, flow = 0.0, carried = 0.0, area = 0.0;
    const double from = station - 0.51 * length / along, to = station + 0.51 * length / along;
    for (int face = box.mesh.interiorFaces; face < box.mesh.faces; ++face) {
      const double y = box.mesh.faceCentre[at(face)][1];
      if (box.mesh.patch[at(face - box.mesh.interiorFaces)] != 1 || y < from || y > to) continue;
      flux += transport.carriedFlux()[at(face)];
      area += box.mesh.area[at(face)];
    }
    for (int c = 0; c < box.mesh.owned; ++c) {
      if (box.mesh.centre[at(c)][1] < from || box.mesh.centre[at(c)][1] > to) continue;
      const double through = box.mesh.volume[at(c)] * state.velocity[at(2 * c + 1)];
      flow += through;
      carried += through * state.carried[at(c)];
    }
    const double sherwood = 4.0 * h * flux / area / (D * carried / flow);
    report(fmt::format("plates, {} x {} cells: Sherwood number {:.4f}, exact 7.5407", across, along, sherwood));
    error[level] = std::abs(sherwood / 7.5407 - 1.0);
  }
  for (const double one : error) EXPECT_LT(one, 5e-4);
}

// Gas of 600 K that cools down in a tube of 300 K: in the end a part E of the particles is on the wall, which depends
// on Pr K and the temperatures alone. Of a gas that is mixed over the section, dc/c = Pr K dT/T and E = 1 - (Tw/T0)^(Pr
// K); of a laminar one about Pr K t (1 + (1 - Pr K) t) with t = 1 - Tw/T0 (Batchelor and Shen 1985). Both are of
// constant properties: no more is asked than to be as far from them as they are from each other.
TEST_F(FlowExactLong, TubeThatCoolsTakesParticles) {
  const double R = 2e-3, length = 44e-3, cooled = 8e-3, hot = 600.0, cold = 300.0, mean = 0.5, K = 0.5385;
  std::vector<double> X(n2.size()), D(n2.size());
  gas.thermo.massToMole(n2, X);
  const auto film = gas.transport.mixture(450.0, 101325.0, X, D);
  const double PrK = K * film.viscosity * gas.thermo.cpMass(450.0, n2) / film.conductivity, t = 1.0 - cold / hot;
  const double mixed = 1.0 - std::pow(cold / hot, PrK), batchelor = PrK * t * (1.0 + (1.0 - PrK) * t);
  double share[2];
  for (int level = 0; level < 2; ++level) {
    const int across = 8 << level, along = 33 << level;
    const Velocity parabola = [&](const Place& x, double) { return 2.0 * mean * (1.0 - x[0] * x[0] / (R * R)); };
    Side warm = side(BoundaryKind::Wall, 0, true), wall = warm, inlet = stream(1, false, parabola, {});
    warm.condition.slip = wall.condition.slip = false;
    warm.patch.to = wall.patch.from = cooled;
    wall.condition.isothermal = wall.condition.takesParticles = true;
    wall.condition.temperature = cold;
    inlet.condition.temperature = hot;
    Box box(Geometry::Axisymmetric, {uniformAxis(R, across), uniformAxis(length, along)},
            {side(BoundaryKind::Symmetry, 0, false), warm, wall, inlet,
             opening(BoundaryKind::Outlet, 1, true, 0.0, cold, n2)});
    bringToLife(box);
    State state = box.state(
        [&](const Place& x) {
          return Box::Local{{0.0, parabola(x, 0.0)}, x[1] < 2.0 * cooled ? hot : cold, n2};
        },
        {{"dust", "1/m3", "", K}});
    TransportOperator transport(box.context, state);
    transport.initialise(state, 1e-5);
    feed(box, state, transport, 0.5 * cooled, 6.0 * length / mean, 0.5);
    double taken = 0.0, out = 0.0;
    for (int face = box.mesh.interiorFaces; face < box.mesh.faces; ++face) {
      const int patch = box.mesh.patch[at(face - box.mesh.interiorFaces)];
      (patch == 2 ? taken : out) += patch == 2 || patch == 4 ? transport.carriedFlux()[at(face)] : 0.0;
    }
    const double came = integral(box.mesh, [&](int c) { return state.balance.carried[at(c)]; });
    share[level] = taken / came;
    report(
        fmt::format("cooled tube, {} x {} cells, Pr K = {:.3f}: {:.4f} of the particles are taken; {:.4f} were "
                    "the gas mixed, {:.4f} by Batchelor and Shen",
                    across, along, PrK, share[level], mixed, batchelor));
    EXPECT_NEAR((taken + out) / came, 1.0, 1e-2) << "not steady";
  }
  EXPECT_LT(std::abs(share[1] - share[0]), 0.02 * share[1]);
  EXPECT_GT(share[1], 2.0 * std::min(mixed, batchelor) - std::max(mixed, batchelor));
  EXPECT_LT(share[1], 2.0 * std::max(mixed, batchelor) - std::min(mixed, batchelor));
}

}  // namespace
}  // namespace lampblack::test
