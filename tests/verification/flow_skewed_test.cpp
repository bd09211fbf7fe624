// Orders of accuracy on cells without order: triangles, both, tetrahedra, prisms, hexahedra and pyramids whose vertices
// are moved by up to a fifth of a cell.
#include "flow_exact.hpp"
#include "graded_stream.hpp"

namespace lampblack::test {
namespace {

const char* nameOf(Cells cells) {
  static constexpr std::array names{"quadrilaterals", "triangles", "triangles and quadrilaterals", "hexahedra",
                                    "tetrahedra",     "prisms",    "hexahedra, prisms, pyramids"};
  return names.at(static_cast<std::size_t>(cells));
}

// Of the error on cells of one width and of half of it, or of another share.
void expectOrder(const std::string& what, const std::array<double, 2>& error, double least, int refinement = 2) {
  const double order = std::log2(error[0] / error[1]) / std::log2(refinement);
  report(fmt::format("{}: {:.2e} {:.2e}, order {:.2f}", what, error[0], error[1], order));
  EXPECT_GT(order, least) << what;
}

class FlowSkewed : public GradedStream {
 protected:
  // Vortices between planes of symmetry (Taylor and Green 1937), in a plane or along the third axis.
  struct Vortex {
    double velocity, across, pressure;  // mean errors over the velocity or its dynamic pressure
  };
  Vortex vortex(Cells cells, int n) {
    const double length = 1e-3;
    const Vortices flow = vortices(5.0, length);
    const double speed = flow.speed, duration = 0.5 / flow.decay;
    Axes axes{uniformAxis(length, n), uniformAxis(length, n), {}};
    if (cells >= Cells::Hexahedra) axes[2] = uniformAxis(length, n);
    std::vector<Side> sides;
    for (int axis = 0; axis < (axes[2].empty() ? 2 : 3); ++axis)
      for (const bool atMax : {false, true}) sides.push_back(side(BoundaryKind::Symmetry, axis, atMax));
    Box box(Geometry::Planar, axes, sides, gas, Split{cells});
    const int d = box.mesh.dimension;
    State state = box.state([&](const Place& x) {
      return Box::Local{{flow.u(x, 0.0), flow.v(x, 0.0), 0.0}, 300.0, n2};
    });
    const int steps = static_cast<int>(std::ceil(duration * speed / (0.1 * length / n)));
    const double dt = duration / steps;
    TransportOperator transport(box.context, state, {0.5, 2});
    transport.initialise(state, dt);
    for (int i = 0; i < steps; ++i)
      for (int sweep = 0; sweep < 2; ++sweep) transport.advance(state, i * dt, dt);
    // Velocities stand half a step before the gas, pressures are those in the middle of what moves them.
    const double time = duration - 0.5 * dt, timeOfPressure = duration - dt;
    const Mesh& m = box.mesh;
    const double size = integral(m, [](int) { return 1.0; });
    const double mean = integral(m, [&](int c) { return state.pressure[at(c)]; }) / size;
    return {meanError(box, [&](int c) { return state.velocity[at(d * c)] - flow.u(m.centre[at(c)], time); }) / speed,
            d == 2 ? 0.0 : meanError(box, [&](int c) { return state.velocity[at(d * c + 2)]; }) / speed,
            meanError(box, [&](int c) {
              return state.pressure[at(c)] - mean - flow.p(m.centre[at(c)], timeOfPressure);
            }) / (density * speed * speed)};
  }

  void expectVortex(Cells cells, int n, double least) {
    const Vortex coarse = vortex(cells, n), fine = vortex(cells, 2 * n);
    const std::string what = fmt::format("vortex on {}, {} and {} cells", nameOf(cells), n, 2 * n);
    expectOrder(what + ", velocity", {coarse.velocity, fine.velocity}, least);
    if (coarse.across > 0.0) expectOrder(what + ", velocity across", {coarse.across, fine.across}, 1.3);
    expectOrder(what + ", pressure", {coarse.pressure, fine.pressure}, 0.9);
  }

  // On n cells and `refinement` times as many: where the cells change their kind from place to place, the order from
  // one mesh to the next comes out between 1.7 and 2.3.
  void expectStream(Cells cells, bool ofComposition, int n, double least, int refinement = 2) {
    std::array<double, 2> mean{};
    for (std::size_t level = 0; level < 2; ++level) {
      const int along = level == 0 ? n : refinement * n;
      Axes axes{uniformAxis(0.01, along), uniformAxis(5e-3, along / 2), {}};
      if (cells >= Cells::Hexahedra) axes[2] = uniformAxis(5e-3, along / 2);
      error({Geometry::Planar, ofComposition}, axes, Split{cells}, &mean[level]);
    }
    expectOrder(fmt::format("{} against convection on {}, {} and {} cells", ofComposition ? "diffusion" : "conduction",
                            nameOf(cells), n, refinement * n),
                mean, least, refinement);
  }

  // `most`: the mean error of v on the finer cells.
  void expectKovasznayOn(Cells cells, int n, double least, double leastOfV, double most) {
    std::array<double, 2> u{}, v{};
    for (std::size_t level = 0; level < 2; ++level) {
      const int wave = n << level;
      const Errors found =
          kovasznay({uniformAxis(1.5, 3 * wave / 2), uniformAxis(0.5, wave / 2), {}}, 25 * wave, Split{cells});
      u[level] = found.mean[0];
      v[level] = found.mean[1];
    }
    const std::string what = fmt::format("Kovasznay on {}, {} and {} cells a wave", nameOf(cells), n, 2 * n);
    expectOrder(what + ", u", u, least);
    expectOrder(what + ", v", v, leastOfV);
    EXPECT_LT(v[1], most) << what;
  }
};

using FlowSkewedCoarseLong = FlowSkewed;

TEST_F(FlowSkewed, VorticesInAPlane) {
  for (const Cells cells : {Cells::Quadrilaterals, Cells::Triangles, Cells::MixedPlane}) expectVortex(cells, 12, 1.75);
}

TEST_F(FlowSkewedCoarseLong, VorticesInSpace) {
  for (const Cells cells : {Cells::Hexahedra, Cells::Tetrahedra, Cells::Prisms, Cells::MixedSpace})
    expectVortex(cells, 4, 1.75);
}

TEST_F(FlowSkewedCoarseLong, StreamsOnTriangles) {
  for (const bool ofComposition : {false, true}) expectStream(Cells::Triangles, ofComposition, 8, 1.8);
}

using FlowSkewedLong = FlowSkewed;

TEST_F(FlowSkewedLong, Kovasznay) {
  for (const Cells cells : {Cells::Quadrilaterals, Cells::Triangles, Cells::MixedPlane})
    // Measured (docs/theory/flow.md): 1.8 and 2.0 on quadrilaterals, where v errs by 1.5e-4, 1.6 to 1.8 with triangles.
    if (cells == Cells::Quadrilaterals)
      expectKovasznayOn(cells, 24, 1.85, 1.75, 2e-4);
    else
      expectKovasznayOn(cells, 24, 1.55, 1.55, 6e-4);
}

TEST_F(FlowSkewedLong, VorticesInSpace) {
  expectVortex(Cells::Tetrahedra, 8, 1.9);
  expectVortex(Cells::MixedSpace, 8, 1.9);
}

TEST_F(FlowSkewedLong, VorticesInAPlane) {
  for (const Cells cells : {Cells::Quadrilaterals, Cells::Triangles, Cells::MixedPlane}) expectVortex(cells, 24, 1.85);
}

TEST_F(FlowSkewedLong, Streams) {
  for (const bool ofComposition : {false, true}) {
    for (const Cells cells : {Cells::Quadrilaterals, Cells::Triangles, Cells::MixedPlane})
      expectStream(cells, ofComposition, 8, 1.9, 4);
    for (const Cells cells : {Cells::Tetrahedra, Cells::MixedSpace}) expectStream(cells, ofComposition, 8, 1.9);
  }
}

}  // namespace
}  // namespace lampblack::test
