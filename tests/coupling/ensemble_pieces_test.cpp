// Numerical particles that go between cells in pieces, and those that do not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "coupling/ensemble_transport.hpp"
#include "particles/stochastic/particle_rows.hpp"
#include "tests/coupling/mean_of_repeats.hpp"
#include "tests/coupling/moving_particles.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::test {
namespace {

using namespace moving;

// Particles that stand for many go in pieces, so that the few that have most of the number do not make it leap; the
// mean is the same.
TEST(EnsemblePieces, ShareOutParticlesThatStandForMany) {
  constexpr int repeats = 60;
  MeanOfRepeats numbers;
  std::vector<double> expected;
  double scatter = 0.0;
  std::map<int, std::vector<double>> all;
  for (int r = 0; r < repeats; ++r) {
    Moving m(8, vortex);
    m.fill(40, hill, 0.0);
    for (auto& rows : m.populations)  // the half of the number in one
      rows[packedHead + 3] *= 39.0;
    if (expected.empty()) {
      std::vector<double> field(at(m.box.mesh.cells));
      for (int c = 0; c < m.box.mesh.owned; ++c) field[at(c)] = m.moment(c, 0.0);
      expected = fieldAfter(m, field, 2e-4, 0.0, 4);
    }
    EnsembleTransport transport = m.transport(false, 900 + static_cast<std::uint64_t>(r));
    for (int s = 0; s < 4; ++s) m.step(transport, 2e-4, static_cast<std::uint64_t>(s));
    std::vector<double> values;
    for (int c = 0; c < m.box.mesh.owned; ++c) {
      values.push_back(m.moment(c, 0.0));
      all[c].push_back(values.back() / expected[at(c)]);
    }
    numbers.add(values);
  }
  for (const auto& [cell, values] : all) scatter += std::pow(summarise(values).standardError, 2) * repeats;
  scatter = std::sqrt(sumOverRanks(scatter) / 64.0);
  const auto score = numbers.against(expected);
  report(fmt::format("half of the number in one particle: scatter {:.3f} of a cell's number, largest |z| {:.2f}",
                     scatter, score.largest));
  EXPECT_LT(scatter, 0.1);  // as wholes they scatter by half of it and more
  EXPECT_LT(score.largest, 4.6);
  EXPECT_LT(score.square, 1.6);
}

// Where all of a cell's own particles stand for equal numbers none of them goes in pieces, however little those stand
// for that have come to it; these do, and the mean is the same. Sizes beyond those of nodes, too.
TEST(EnsemblePieces, NoneAreOfACellsOwnParticlesOfEqualNumbers) {
  constexpr int repeats = 60, few = 5, light = 30;
  for (const double d : {2e-9, 1e-4}) {
    MeanOfRepeats numbers;
    std::vector<double> expected;
    std::int64_t inPart = 0;
    for (int r = 0; r < repeats; ++r) {
      Moving m(8, vortex);
      const auto pack = [&](EnsembleTransport::Rows& to, double number) {
        packDoubles(to, GivenParticle{massOf(d), 0.0, 1.0, number});
      };
      m.fill(0, hill);
      std::vector<double> field(at(m.box.mesh.cells));
      for (int c = 0; c < m.box.mesh.owned; ++c) {
        const double number = hill(m.box.mesh.centre[at(c)]);
        for (int k = 0; k < few; ++k) pack(m.populations[at(c)], number / few);
        for (int k = 0; k < light; ++k) pack(m.arrived[at(c)], 1e-3 * number / light);
        field[at(c)] = 1.001 * number;
      }
      if (expected.empty()) expected = fieldAfter(m, field, 1e-4, 0.0, 1);
      EnsembleTransport transport =
          m.transport(false, 700 + static_cast<std::uint64_t>(r), 0.55, {packedHead, false, true});
      transport.advance({m.state, m.drift, m.density, m.properties}, 2e-4, 0, EnsembleTransport::Half::First,
                        m.populations, m.arrived);
      std::vector<double> values;
      for (int c = 0; c < m.box.mesh.owned; ++c) {
        const double one = hill(m.box.mesh.centre[at(c)]) / few;
        for (const GivenParticle& p : packedParticles(m.populations[at(c)])) inPart += p.number != one ? 1 : 0;
        m.populations[at(c)].insert(m.populations[at(c)].end(), m.arrived[at(c)].begin(), m.arrived[at(c)].end());
        values.push_back(m.moment(c, 0.0));
      }
      numbers.add(values);
    }
    EXPECT_EQ(sumOverRanks(static_cast<double>(inPart)), 0.0) << d << " m";
    std::int64_t pieces = 0;  // of one that has come
    Moving m(8, vortex);
    m.fill(0, hill);
    for (auto& rows : m.arrived)
      for (int k = 0; k <= light; ++k) packDoubles(rows, GivenParticle{massOf(d), 0.0, 1.0, k == 0 ? 1e17 : 1e12});
    EnsembleTransport transport = m.transport(false, 7, 0.55, {packedHead, false, true});
    transport.advance({m.state, m.drift, m.density, m.properties}, 2e-4, 0, EnsembleTransport::Half::First,
                      m.populations, m.arrived);
    for (const auto& rows : m.arrived)
      ParticleRows{}.forEach(rows, [&](const double* row) {
        pieces += row[packedNumberAt] > 2e12 && row[packedNumberAt] < 0.99e17 ? 1 : 0;
      });
    EXPECT_GT(sumOverRanks(static_cast<double>(pieces)), 0.0) << d << " m";
    const auto score = numbers.against(expected);
    EXPECT_LT(score.largest, 4.6) << d << " m";
    EXPECT_LT(score.square, 1.6) << d << " m";
  }
}

}  // namespace
}  // namespace lampblack::test
