// Face values as convection takes them, whichever way it goes.
#include "flow/equations/face_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

constexpr double width = 0.01;  // m

// Cells that grow along both axes, and the same seen in a mirror.
std::vector<double> axis(int refinement, bool isMirrored) {
  std::vector<double> vertices = gradedAxis(0.0, {{width, 12, 4.0}}, refinement);
  if (!isMirrored) return vertices;
  std::reverse(vertices.begin(), vertices.end());
  for (double& x : vertices) x = width - x;
  return vertices;
}

double mirrored(double x, bool isMirrored) {
  return isMirrored ? width - x : x;
}

double temperatureAt(double x, double y) {
  return 900.0 + 300.0 * std::sin(150.0 * x) + 200.0 * std::cos(180.0 * y);
}

struct Faces {
  double sum = 0.0;    // of temperatures and mass fractions, each with a weight of its place
  double error = 0.0;  // K, mean over the faces inside, of a smooth field
};

// Carried to growing coordinates, or in the mirror to falling ones.
Faces facesOf(int refinement, bool isMirrored) {
  Gas& gas = Gas::hydrogen();
  const auto low = gas.massFractions("O2: 0.21, N2: 0.79"), high = gas.massFractions("H2: 0.3, N2: 0.7");
  Box box(Geometry::Planar, {axis(refinement, isMirrored), axis(refinement, isMirrored)},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)});
  const Mesh& m = box.mesh;
  State state = box.state([&](const auto& place) {
    const double x = mirrored(place[0], isMirrored), y = mirrored(place[1], isMirrored);
    const double share = 0.5 + 0.4 * std::sin(200.0 * (x + 0.5 * y));
    std::vector<double> Y(low.size());
    for (std::size_t k = 0; k < Y.size(); ++k) Y[k] = share * low[k] + (1.0 - share) * high[k];
    return Box::Local{{0.0, 0.0}, temperatureAt(x, y), Y};
  });
  state.updateHalo(box.halo);
  FaceState faces(box.context, state);
  faces.prepare(state, state.Y);
  Faces result;
  double count = 0.0;
  for (int face = 0; face < m.interiorFaces; ++face) {
    if (m.low[at(face)] >= m.owned) continue;  // counted by the neighbour
    std::vector<double> Y(low.size());
    faces.interpolate(state, face, isMirrored ? -1.0 : 1.0, Y);
    const double x = mirrored(m.faceCentre[at(face)][0], isMirrored),
                 y = mirrored(m.faceCentre[at(face)][1], isMirrored);
    const double weight = std::exp(100.0 * x - 70.0 * y) * (1.0 + axisOf(m, face));
    result.sum += weight * faces.temperature[at(face)] * Y[gas.mechanism.speciesIndex("H2")];
    if (std::min(x, y) < 0.1 * width || std::max(x, y) > 0.9 * width) continue;
    result.error += std::abs(faces.temperature[at(face)] - temperatureAt(x, y));
    ++count;
  }
  result.sum = sumOverRanks(result.sum);
  result.error = sumOverRanks(result.error) / sumOverRanks(count);
  return result;
}

TEST(FaceState, IsTheSameInAMirror) {
  const Faces straight = facesOf(1, false), reversed = facesOf(1, true);
  EXPECT_NEAR(reversed.sum / straight.sum, 1.0, 1e-11);
}

// At crests and troughs the limiter is of first order, in ever fewer of the faces.
TEST(FaceState, IsOfSecondOrderOnGradedMeshesEitherWay) {
  for (const bool isMirrored : {false, true}) {
    const double coarse = facesOf(2, isMirrored).error, fine = facesOf(4, isMirrored).error;
    EXPECT_GT(std::log2(coarse / fine), 1.7) << isMirrored;
  }
}

// Beside an inlet that is fed with a given flux of its species diffusion may have changed the gas: what is linear in
// the cells goes on linear, however far away the feed is, and steps from the feed make no new extremum.
TEST(FaceState, AFeedLeadsNoFurtherThanTheSlopeBehindIt) {
  Gas& gas = Gas::hydrogen();
  const std::size_t h2 = gas.mechanism.speciesIndex("H2"), n2 = gas.mechanism.speciesIndex("N2");
  constexpr int cells = 8;
  const auto of = [&](double Y) {
    std::vector<double> mixture(gas.mechanism.numSpecies(), 0.0);
    mixture[h2] = Y;
    mixture[n2] = 1.0 - Y;
    return mixture;
  };
  const auto faceAfterTheFirstCell = [&](double fed, double first, double slope) {
    Box box(Geometry::Planar, {uniformAxis(width, cells), uniformAxis(width, 3)},
            {opening(BoundaryKind::Inlet, 0, false, 0.1, 300.0, of(fed)), side(BoundaryKind::Wall, 0, true),
             side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)});
    const Mesh& m = box.mesh;
    State state = box.state([&](const auto& x) {
      return Box::Local{{0.0, 0.0}, 300.0, of(first + slope * (x[0] / width * cells - 0.5))};
    });
    state.updateHalo(box.halo);
    FaceState faces(box.context, state);
    faces.prepare(state, state.Y);
    double found = 0.0;
    std::vector<double> Y(gas.mechanism.numSpecies());
    for (int face = 0; face < m.interiorFaces; ++face) {
      if (axisOf(m, face) != 0 || std::abs(m.faceCentre[at(face)][0] - width / cells) > 1e-9) continue;
      faces.massFractions(face, 1.0, Y);
      found = std::max(found, Y[h2]);
    }
    return maxOverRanks(found);
  };
  EXPECT_NEAR(faceAfterTheFirstCell(0.0, 0.2, 0.01), 0.205, 1e-12);  // diffusion has brought hydrogen to the inlet
  EXPECT_NEAR(faceAfterTheFirstCell(0.2, 0.2, 0.01), 0.2, 1e-12);    // as fed: a step would make a new minimum
  EXPECT_NEAR(faceAfterTheFirstCell(0.3, 0.2, 0.01), 0.2, 1e-12);    // a trough
}

}  // namespace
}  // namespace lampblack::test
