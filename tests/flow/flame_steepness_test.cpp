// How few cells a flame has across itself.
#include "flow/steady/flame_steepness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

#include "flow_fixture.hpp"

namespace lampblack::test {
namespace {

class FlameSteepnesses : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  Box box{Geometry::Planar,
          {uniformAxis(1.0, 4), uniformAxis(1.0, 3)},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)}};
  // Of columns 300, 600, 1500 and 2100 K, the last of the upper row 300 K.
  State state = box.state([&](const auto& place) {
    const std::array column{300.0, 600.0, 1500.0, 2100.0};
    const auto i = static_cast<std::size_t>(place[0] / 0.25);
    return Box::Local{{0.0, 0.0}, i == 3 && place[1] > 0.7 ? 300.0 : column.at(i), air};
  });
  void burn(std::int64_t natural, double rate) {  // kg/m3/s, of water
    const int c = box.mesh.findOwned(natural);
    if (c >= 0) state.balance.reactions[at(c) * air.size() + gas.mechanism.speciesIndex("H2O")] = rate;
  }
};

TEST_F(FlameSteepnesses, IsThatOfCellsThatBurn) {
  burn(6, 10.0);  // the second row has 4 to 7
  const auto found = flameSteepness(box.context, state);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->difference, 900.0, 1e-9);
  EXPECT_NEAR(found->cells, 2.0, 1e-12) << "of 1800 K";
  EXPECT_EQ(found->place, (Vector3{0.625, 0.5, 0.0}));
}

TEST_F(FlameSteepnesses, IsTheLargestAmongThem) {
  burn(4, 10.0);
  burn(7, 5.0);
  EXPECT_NEAR(flameSteepness(box.context, state)->difference, 1800.0, 1e-9) << "to the cold cell above";
  burn(7, 1.0);
  EXPECT_NEAR(flameSteepness(box.context, state)->difference, 300.0, 1e-9) << "a cell of little heat release is none";
}

TEST_F(FlameSteepnesses, LooksAtAllSidesOfACell) {
  burn(5, 10.0);
  for (const std::int64_t beside : {1, 4, 6, 9}) {
    const int c = box.mesh.findOwned(beside);
    const double before = c >= 0 ? std::exchange(state.temperature[at(c)], 2700.0) : 0.0;
    EXPECT_NEAR(flameSteepness(box.context, state)->difference, 2100.0, 1e-9) << beside;
    if (c >= 0) state.temperature[at(c)] = before;
  }
}

TEST_F(FlameSteepnesses, IsNoneWhereNothingBurns) {
  EXPECT_FALSE(flameSteepness(box.context, state));
  burn(6, 1e-4);
  EXPECT_FALSE(flameSteepness(box.context, state)) << "a kilowatt";
  burn(6, 1e-2);
  EXPECT_TRUE(flameSteepness(box.context, state));
  std::fill(state.temperature.begin(), state.temperature.end(), 500.0);
  EXPECT_FALSE(flameSteepness(box.context, state)) << "as hot everywhere";
}

}  // namespace
}  // namespace lampblack::test
