// Halo exchange: every halo value becomes its owner's, for any number of fields in one message a neighbour.
#include "core/halo_exchange.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "mpi_support.hpp"
#include "tests/every_module.hpp"
#include "tests/gather.hpp"

namespace {
int messagesSent = 0;
}  // namespace

// Counts messages through MPI's profiling interface.
extern "C" int MPI_Isend(const void* buffer, int count, MPI_Datatype type, int destination, int tag, MPI_Comm comm,
                         MPI_Request* request) {
  ++messagesSent;
  return PMPI_Isend(buffer, count, type, destination, tag, comm, request);
}

namespace lampblack::test {
namespace {

double valueAt(std::int64_t natural, int field, int component) {
  return 1.0 / (1.0 + static_cast<double>(natural)) + 1000.0 * field + 10.0 * component;
}

std::vector<double> ownedOnly(const Mesh& mesh, int field, int components) {
  std::vector<double> values(at(mesh.cells * components), std::numeric_limits<double>::quiet_NaN());
  for (int c = 0; c < mesh.owned; ++c)
    for (int k = 0; k < components; ++k) values[at(c * components + k)] = valueAt(mesh.naturalCell[at(c)], field, k);
  return values;
}

void expectFilled(const Mesh& mesh, const std::vector<double>& values, int field, int components) {
  for (int c = 0; c < mesh.cells; ++c)
    for (int k = 0; k < components; ++k)
      EXPECT_EQ(values[at(c * components + k)], valueAt(mesh.naturalCell[at(c)], field, k))
          << "field " << field << ", cell " << mesh.naturalCell[at(c)] << ", component " << k;
}

class Halo : public testing::Test {
 protected:
  Mesh mesh{MPI_COMM_WORLD, gradedBox(Geometry::Planar)};
  HaloExchange halo{mesh};
};

TEST_F(Halo, OneFieldIsFilledFromItsOwners) {
  auto values = ownedOnly(mesh, 1, 1);
  halo.update(values, 1);
  expectFilled(mesh, values, 1, 1);
}

TEST_F(Halo, SeveralFieldsOfDifferentWidthAreFilledTogether) {
  auto pressure = ownedOnly(mesh, 1, 1);
  auto velocity = ownedOnly(mesh, 2, 2);
  auto species = ownedOnly(mesh, 3, 37);
  const std::vector<FieldView> fields{{pressure, 1}, {species, 37}, {velocity, 2}};
  halo.update(fields);
  expectFilled(mesh, pressure, 1, 1);
  expectFilled(mesh, velocity, 2, 2);
  expectFilled(mesh, species, 3, 37);
}

TEST_F(Halo, SeveralFieldsTakeOneMessageANeighbour) {
  auto pressure = ownedOnly(mesh, 1, 1);
  auto velocity = ownedOnly(mesh, 2, 2);
  const std::vector<FieldView> fields{{pressure, 1}, {velocity, 2}};
  const int before = messagesSent;
  halo.update(fields);
  // Face neighbourhood is mutual, so a rank sends to those whose cells it sees.
  const std::set<int> neighbours(mesh.haloRank.begin(), mesh.haloRank.end());
  EXPECT_EQ(messagesSent - before, static_cast<int>(neighbours.size()));
}

TEST_F(Halo, RepeatedUpdatesFollowTheOwnersValues) {
  auto values = ownedOnly(mesh, 0, 3);
  halo.update(values, 3);
  for (int field = 1; field < 4; ++field) {
    for (int c = 0; c < mesh.owned; ++c)
      for (int k = 0; k < 3; ++k) values[at(c * 3 + k)] = valueAt(mesh.naturalCell[at(c)], field, k);
    halo.update(values, 3);
    expectFilled(mesh, values, field, 3);
  }
}

TEST_F(Halo, GatheredFieldIsInNaturalOrderOnEveryRank) {
  const auto all = gatherNatural(mesh, ownedOnly(mesh, 2, 3), 3);
  ASSERT_EQ(all.size(), 3 * static_cast<std::size_t>(mesh.totalCells));
  for (std::int64_t natural = 0; natural < mesh.totalCells; ++natural)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(all[static_cast<std::size_t>(natural) * 3 + at(k)], valueAt(natural, 2, k));
}

TEST_F(Halo, NoFieldsIsNoError) {
  EXPECT_NO_THROW(halo.update(std::span<const FieldView>{}));
}

}  // namespace
}  // namespace lampblack::test
