// Size distributions of packed populations, and of regions: what is in the bins is what is in the particles, and the
// same bits on any number of ranks.
#include "coupling/ensemble_sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "core/random.hpp"
#include "particles/ensemble/packed_ensemble.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/coupling/plain_mesh.hpp"

namespace lampblack::coupling {
namespace {

constexpr double density = 1800.0;
const SizeBins bins{-9.2, -6.0, 40};

EnsembleOptions options(bool coalescing) {
  EnsembleOptions all;
  all.method = EnsembleMethod::sammc;
  all.particles = 200;
  all.shape = coalescing ? SootShape::spheres : SootShape::aggregates;
  all.soot.sootDensity = density;
  return all;
}

// Aggregates or spheres of 1 to 30 nm, numbers over four powers of ten; some cells have none.
std::vector<GivenParticle> particlesOf(std::int64_t cell, bool coalescing) {
  std::vector<GivenParticle> all;
  if (cell % 5 == 3) return all;
  RandomStream random(11, static_cast<std::uint64_t>(cell), 1);
  for (int i = 0; i < 100; ++i) {
    const double d = 1e-9 * std::pow(30.0, random.uniform());
    const double primaries = coalescing ? 1.0 : std::floor(std::pow(300.0, random.uniform()));
    const double mass = density * constants::pi / 6.0 * d * d * d * primaries;
    all.push_back({0.98 * mass, 0.02 * mass, primaries, 1e10 * std::pow(1e4, random.uniform())});
  }
  return all;
}

std::vector<double> packed(const std::vector<GivenParticle>& particles, bool coalescing) {
  if (particles.empty()) return {};
  const auto ensemble = makeEnsemble(options(coalescing));
  ensemble->initialise(particles);
  return ensemble->pack();
}

std::vector<std::vector<double>> populations(const Mesh& mesh, bool coalescing) {
  std::vector<std::vector<double>> all;
  for (int c = 0; c < mesh.owned; ++c)
    all.push_back(packed(particlesOf(mesh.naturalCell[static_cast<std::size_t>(c)], coalescing), coalescing));
  return all;
}

TEST(EnsembleSizes, AreThoseOfTheEnsemble) {
  for (const bool coalescing : {true, false}) {
    const SootAggregate type(density, coalescing);
    const auto ensemble = makeEnsemble(options(coalescing));
    ensemble->initialise(particlesOf(1, coalescing));
    const std::vector<double> population = ensemble->pack();
    std::vector<double> found(bins.count, 0.0);
    const RowSizes sizes{type, {packedHead}};
    addSizes(sizes, bins, population, found);
    std::vector<double> expected(bins.count, 0.0);
    for (const GivenParticle& p : ensemble->particles())
      if (const std::size_t b = bins.of(type.mobilityDiameter(type.make(p.carbon, p.hydrogen, p.primaries)));
          b < bins.count)
        expected[b] += p.number / bins.width();
    for (std::size_t b = 0; b < bins.count; ++b) EXPECT_NEAR(found[b], expected[b], 1e-12 * expected[b]) << b;
    const double number = std::accumulate(found.begin(), found.end(), 0.0) * bins.width();
    EXPECT_NEAR(number / ensemble->totals().number, 1.0, 1e-12);
    EXPECT_NEAR(geometricDeviation(sizes, population), ensemble->geometricDeviation(), 1e-12);
    EXPECT_EQ(geometricDeviation(sizes, {}), 1.0);
  }
}

TEST(EnsembleSizes, OfARegionAreTheSameBitsOnAnyRanks) {
  const Mesh alone(MPI_COMM_SELF, test::plainBox(12, 9)), shared(MPI_COMM_WORLD, test::plainBox(12, 9));
  const Vector3 from{2e-3, 1e-3, 0.0}, to{8.2e-3, 5.1e-3, 0.0};
  for (const bool coalescing : {true, false}) {
    const RowSizes of{SootAggregate(density, coalescing), {packedHead}};
    const auto whole = populations(alone, coalescing), parts = populations(shared, coalescing);
    const MeshRegion one(alone, from, to), same(shared, from, to);
    const std::vector<double> sizes = regionSizeRows(of, bins, one, whole),
                              joint = regionJointRows(of, bins, one, whole);
    EXPECT_EQ(regionSizeRows(of, bins, same, parts), sizes);
    EXPECT_EQ(regionJointRows(of, bins, same, parts), joint);
    // Against the particles, one by one.
    double volume = 0.0, number = 0.0, mass = 0.0, surface = 0.0, large = 0.0;
    for (int c = 0; c < alone.owned; ++c) {
      const Vector3& x = alone.centre[static_cast<std::size_t>(c)];
      if (x[0] < from[0] || x[0] > to[0] || x[1] < from[1] || x[1] > to[1]) continue;
      volume += 1e-6;
      for (const GivenParticle& p : particlesOf(alone.naturalCell[static_cast<std::size_t>(c)], coalescing)) {
        const double m = p.carbon + p.hydrogen, d = std::cbrt(6.0 * m / (constants::pi * density * p.primaries));
        number += 1e-6 * p.number;
        mass += 1e-6 * p.number * m;
        surface += 1e-6 * p.number * p.primaries * constants::pi * d * d;
        if (p.primaries >= 100.0) large += 1e-6 * p.number;
      }
    }
    double found = 0.0;
    for (std::size_t row = 0; row < sizes.size(); row += 3) {
      found += sizes[row + 2] * bins.width();
      EXPECT_NEAR(std::log10(sizes[row + 1] / sizes[row]), bins.width(), 1e-12);
    }
    EXPECT_NEAR(found * volume / number, 1.0, 1e-12);
    std::vector<double> sums(4, 0.0);
    ASSERT_EQ(joint.size() % 7, 0U);
    for (std::size_t row = 0; row < joint.size(); row += 7) {
      for (std::size_t a = 0; a < 3; ++a) sums[a] += joint[row + 4 + a];
      EXPECT_GT(joint[row + 4], 0.0) << "only bins with particles";
      if (joint[row + 2] > 99.9) sums[3] += joint[row + 4];
      // Mass and surface are those of particles within the bin.
      const double mean = joint[row + 5] / joint[row + 4] * 6.0 / (constants::pi * density);
      EXPECT_GE(mean, std::pow(joint[row], 3) * joint[row + 2] * (1.0 - 1e-9));
      EXPECT_LE(mean, std::pow(joint[row + 1], 3) * joint[row + 3] * (1.0 + 1e-9));
      if (coalescing) {
        EXPECT_EQ(joint[row + 2], 1.0);
      }
    }
    EXPECT_NEAR(sums[0] * volume / number, 1.0, 1e-12);
    EXPECT_NEAR(sums[1] * volume / mass, 1.0, 1e-12);
    EXPECT_NEAR(sums[2] * volume / surface, 1.0, 1e-12);
    EXPECT_NEAR(sums[3] * volume, large, 1e-12 * number);
  }
  EXPECT_TRUE(MeshRegion(shared, {2.1e-3, 1e-3, 0.0}, {2.4e-3, 5e-3, 0.0}).isEmpty());
}

}  // namespace
}  // namespace lampblack::coupling
