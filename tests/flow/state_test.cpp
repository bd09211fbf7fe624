// What operators tell the transport of a flow.
#include "flow/state.hpp"

#include <gtest/gtest.h>

#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

TEST(StateBalance, AddsWhatIsExchangedToTheReactions) {
  Box box(Geometry::Planar, {uniformAxis(1e-3, 4), uniformAxis(1e-3, 3)},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)});
  const std::size_t n = box.gas.mechanism.numSpecies();
  State state(box.mesh, n, {});
  auto& balance = state.balance;
  for (std::size_t i = 0; i < balance.reactions.size(); ++i) balance.reactions[i] = static_cast<double>(i);
  // A second species gets its place beside the first; two that exchange the same one add up.
  balance.exchange(1, 4, 0.5);
  balance.exchange(1, 4, 0.25);
  balance.exchange(0, 2, 8.0);
  balance.exchange(1, 2, 2.0);
  std::vector<double> rate(n);
  for (std::size_t cell = 0; cell < 3; ++cell) {
    balance.ofSpecies(cell, rate);
    for (std::size_t k = 0; k < n; ++k) {
      const double exchanged = k == 4 && cell == 1 ? 0.75 : k == 2 && cell < 2 ? (cell == 0 ? 8.0 : 2.0) : 0.0;
      EXPECT_EQ(rate[k], static_cast<double>(cell * n + k) + exchanged) << "cell " << cell << ", species " << k;
    }
  }
  balance.clear();
  balance.ofSpecies(1, rate);
  EXPECT_EQ(rate[4], static_cast<double>(n + 4));  // the reactions stay
}

}  // namespace
}  // namespace lampblack::test
