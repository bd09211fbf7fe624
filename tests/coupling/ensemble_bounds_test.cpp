// Who is looked at: no probability to leave is above the bound by which particles are drawn, at walls and of those that
// came in an earlier part of the step.
#include <gtest/gtest.h>

#include <cmath>

#include "core/running_mean.hpp"
#include "coupling/ensemble_transport.hpp"
#include "particles/collisions/sphere.hpp"
#include "tests/coupling/moving_particles.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flow_fixture.hpp"

namespace lampblack::test {
namespace {

using moving::massOf;
using moving::Moving;
using moving::sootDensity;

// So many particles in each of the cells of which this is true, none elsewhere.
template <class Where>
void fillAlone(Moving& m, int count, const Where& isThere) {
  for (int c = 0; c < m.box.mesh.owned; ++c) {
    m.populations[at(c)].assign(packedHead, 0.0);
    if (!isThere(m.box.mesh.centre[at(c)])) continue;
    for (int k = 0; k < count; ++k) packDoubles(m.populations[at(c)], GivenParticle{massOf(3e-9), 0.0, 1.0, 1e10});
  }
}

// A column beside the wall, and none before it: a line through both has 1.5 times as many at the wall, to which they
// drift. Evenly spread points hit the share to far less than the error of as many throws.
TEST(EnsembleTransport, DriftsToAWallByTheSlopeBesideIt) {
  constexpr int count = 20000;
  Moving m(
      3, [](const Vector3&) { return Vector3{}; }, MPI_COMM_SELF);
  m.letWallsTake();
  m.driftAt(1.0);
  const double h = 0.01 / 3, force = 0.55, share = 0.1;
  fillAlone(m, count, [](const Vector3& x) { return x[0] > 0.007; });
  EnsembleTransport transport(m.box.context, {{sootDensity, SootShape::aggregates}, force, false, true, 5});
  transport.advance({m.state, m.drift, m.density, m.properties}, 2 * share * h / (1.5 * force), 0,
                    EnsembleTransport::Half::First, m.populations, m.arrived);
  EXPECT_EQ(transport.limited(), 0);
  int columns = 0;
  for (int c = 0; c < m.box.mesh.owned; ++c)
    if (const auto left = packedParticles(m.populations[at(c)]).size(); left > 0) {
      ++columns;
      EXPECT_NEAR(1 - static_cast<double>(left) / count, share, 0.02 * share);
    }
  EXPECT_EQ(columns, 3);
}

// Many parts of one half: those that came go on in the next part, so that the mean moves with the gas. The teeth of a
// comb hit particles of one size together: what they do scatters as if they were a few.
TEST(EnsembleTransport, WhoHasComeGoesOnInTheNextPart) {
  constexpr int cells = 12, count = 40, repeats = 300;
  constexpr double speed = 1.0, h = 0.01 / cells, moved = 4.0;
  RunningMean moves;
  for (int r = 0; r < repeats; ++r) {
    Moving m(
        cells,
        [](const Vector3&) {
          return Vector3{speed, 0.0, 0.0};
        },
        MPI_COMM_SELF);
    fillAlone(m, count, [](const Vector3& x) { return std::abs(x[0] - 1.5 * h) < 0.1 * h && x[1] < h; });
    EnsembleTransport transport(
        m.box.context, {{sootDensity, SootShape::aggregates}, 0.0, false, false, 100U + static_cast<std::uint64_t>(r)});
    transport.advance({m.state, m.drift, m.density, m.properties}, 2 * moved * h / speed, 0,
                      EnsembleTransport::Half::First, m.populations, m.arrived);
    ASSERT_GE(transport.parts(), 4);
    double sum = 0.0, place = 0.0;
    for (int c = 0; c < m.box.mesh.owned; ++c)
      for (const auto* rows : {&m.populations[at(c)], &m.arrived[at(c)]}) {
        const std::size_t head = rows == &m.arrived[at(c)] ? 0 : packedHead;
        for (std::size_t i = head; i < rows->size(); i += packedParticle) {
          sum += (*rows)[i + packedNumberAt];
          place += (*rows)[i + packedNumberAt] * m.box.mesh.centre[at(c)][0];
        }
      }
    ASSERT_NEAR(sum, 1e10 * count, 1e-9 * 1e10 * count);
    moves.add(place / sum / h - 1.5);
  }
  ASSERT_LT(moves.standardError(), 0.1);
  EXPECT_NEAR(moves.mean(), moved, 4.5 * moves.standardError());
}

}  // namespace
}  // namespace lampblack::test
