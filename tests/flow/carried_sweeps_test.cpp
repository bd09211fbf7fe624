// What a flow carries, brought to rest cell by cell: across the whole flow at once, where amounts fall by decades from
// cell to cell too, and to the same end as by one linear system of all cells.
#include "flow/steady/carried_sweeps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "flow/steady/carried_update.hpp"
#include "flow/steady/residual_norms.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// Sources of two scalars by their amounts alone, different before and behind a place along the channel.
class DustInCells : public Operator {
 public:
  struct Law {
    double made, lost;  // 1/m3/s, 1/s; of the second: made by the first, in 1/s
  };
  DustInCells(const Mesh& mesh, Law first, Law second, bool told) : mesh_(mesh), laws_{first, second}, isTold_(told) {}
  [[nodiscard]] const char* name() const override { return "dust"; }
  void advance(State&, double, double) override {}
  void addRates(const State& state, State::Balance& rates) override {
    for (int c = 0; c < mesh_.owned; ++c)
      add(c, std::span(state.carried).subspan(2 * at(c), 2), std::span(rates.carried).subspan(2 * at(c), 2), {});
  }
  [[nodiscard]] bool actsOnCarried() const override { return true; }
  void addSlopes(const State& state, const Slopes& slopes) override {
    std::array<double, 2> rates{};
    for (int c = 0; c < mesh_.owned && !slopes.carried.empty(); ++c)
      add(c, std::span(state.carried).subspan(2 * at(c), 2), rates, slopes.carried.subspan(4 * at(c), 4));
  }
  [[nodiscard]] std::unique_ptr<CarriedInCells> carriedInCells(const State&) override {
    class Cells : public CarriedInCells {
     public:
      explicit Cells(const DustInCells& dust) : dust_(dust) {}
      void add(int cell, std::span<const double> amounts, std::span<double> rates, std::span<double> slopes) override {
        dust_.add(cell, amounts, rates, slopes);
      }

     private:
      const DustInCells& dust_;
    };
    if (!isTold_) return {};
    return std::make_unique<Cells>(*this);
  }
  static constexpr double place = 0.006;  // m

 private:
  // The second burns as the root of itself: where there is little, fast.
  void add(int cell, std::span<const double> amounts, std::span<double> rates, std::span<double> slopes) const {
    const Law& law = laws_[mesh_.centre[at(cell)][1] < place ? 0 : 1];
    const double small = 1e-12, second = std::max(amounts[1], 0.0), root = std::sqrt(second * second + small * second);
    rates[0] += law.made - law.lost * amounts[0];
    rates[1] += law.made * amounts[0] - law.lost * root;
    if (slopes.empty()) return;
    slopes[0] -= law.lost;
    slopes[1] += law.made;
    slopes[3] -= law.lost * (second + 0.5 * small) / std::max(root, 1e-30);
  }
  const Mesh& mesh_;
  std::array<Law, 2> laws_;
  bool isTold_;
};

struct CarriedAtRest {
  Gas& gas = Gas::hydrogen();
  std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  Side wall = side(BoundaryKind::Wall, 0, true);
  Box b{Geometry::Planar,
        {gradedAxis(0.0, {{0.006, 5, 2.0}}), uniformAxis(0.012, 16)},
        {side(BoundaryKind::Symmetry, 0, false), wall, opening(BoundaryKind::Inlet, 1, false, 0.5, 300.0, air),
         opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)}};
  State state = b.state(
      [&](const auto&) {
        return Box::Local{{0.0, 0.5}, 300.0, air};
      },
      {{"first", "1/m3", "", 0.55}, {"second", "1/m3", "", 0.55}});
  TransportOperator transport{b.context, state};
  DustInCells dust;
  std::vector<Operator*> operators{&transport, &dust};
  FlowResidual residual{b.context, state, VelocityScheme::Limited, operators};
  std::optional<CarriedUpdate> update;
  std::vector<double> inertia;

  CarriedAtRest(DustInCells::Law first, DustInCells::Law second, bool told)
      : dust(b.mesh, first, second, told), inertia(at(b.mesh.owned), 0.0) {
    for (double& D : state.carriedDiffusivity) D = 1e-8;
    state.updateHalo(b.halo);
    transport.initialise(state, 1e-4);
    residual.evaluate(state);
    update.emplace(b.context, state, residual, operators);
  }
  // Updates until each cell's equations have less left than so much of what passes it of its own amounts, and 1e-12.
  int settle(double enough, int most) {
    int count = 0;
    for (; count < most && left() > enough; ++count) {
      update->advance(state, residual, inertia);
      residual.evaluateCarried(state);
    }
    return count;
  }
  double left() {
    return largest(b.mesh, [&](int c) {
      double all = 0.0;
      for (std::size_t i = 2 * at(c); i < 2 * at(c) + 2; ++i) {
        const double passes = 0.5 * b.mesh.volume[c] / (0.012 / 16) * (state.carried[i] + 1e-12);
        all = std::max(all, std::abs(residual.rates().carried[i]) / passes);
      }
      return all;
    });
  }
};

// Nothing is there at first, and all of the channel is filled by one update but for what the limited scheme moves.
TEST(CarriedSweeps, CrossTheFlowAtOnce) {
  CarriedAtRest flow({1.0, 10.0}, {0.5, 5.0}, true);
  ASSERT_TRUE(flow.update->isByCell());
  flow.update->advance(flow.state, flow.residual, flow.inertia);
  const std::vector<double> once = flow.state.carried;
  flow.residual.evaluateCarried(flow.state);
  const int updates = flow.settle(1e-8, 60);
  double most = 0.0, differs = 0.0;
  for (int c = 0; c < flow.b.mesh.owned; ++c) {
    most = std::max(most, flow.state.carried[2 * at(c)]);
    differs = std::max(differs, std::abs(flow.state.carried[2 * at(c)] - once[2 * at(c)]));
  }
  report(fmt::format("first update {:.2g} of {:.2g} off, {} more until 1e-8", differs, most, updates));
  EXPECT_LT(differs, 0.1 * most);
  EXPECT_LT(updates, 50);
}

// Behind the middle it burns thirty times as fast as it passes a cell, and no amount is below zero.
TEST(CarriedSweeps, FollowWhatFallsByDecades) {
  CarriedAtRest flow({1.0, 1.0}, {0.0, 2e4}, true);
  double least = 1.0;
  int updates = 0;
  for (; updates < 60 && (updates == 0 || flow.left() > 1e-8); ++updates) {
    flow.update->advance(flow.state, flow.residual, flow.inertia);
    flow.residual.evaluateCarried(flow.state);
    for (int i = 0; i < 2 * flow.b.mesh.owned; ++i) least = std::min(least, flow.state.carried[at(i)]);
  }
  report(fmt::format("{} updates, left {:.2g}, least {:.2g}", updates, flow.left(), least));
  EXPECT_LT(flow.left(), 1e-8);
  EXPECT_GE(least, 0.0);
  EXPECT_LT(updates, 50);
}

TEST(CarriedSweeps, EndAsTheLinearSystemDoes) {
  CarriedAtRest one({1.0, 100.0}, {0.5, 300.0}, true), other({1.0, 100.0}, {0.5, 300.0}, false);
  ASSERT_FALSE(other.update->isByCell());
  for (int face = 0; face < one.b.mesh.faces; ++face)
    for (const int cell : {one.b.mesh.low[face], one.b.mesh.high[face]})
      if (cell >= 0 && cell < one.b.mesh.owned) one.inertia[at(cell)] += 0.05 * std::abs(one.state.massFlux[face]);
  other.inertia = one.inertia;
  EXPECT_LT(one.settle(1e-11, 100), 100);
  EXPECT_LT(other.settle(1e-11, 200), 200);
  for (std::size_t i = 0; i < 2 * at(one.b.mesh.owned); ++i)
    EXPECT_NEAR(one.state.carried[i], other.state.carried[i], 1e-9 * std::abs(other.state.carried[i])) << i;
  for (CarriedAtRest* of : {&one, &other}) EXPECT_EQ(of->update->advance(of->state, of->residual, of->inertia), 0);
}

// A step of a cell leaves ten times what there was at most. From next to nothing the limits hold all cells back to the
// end of the last sweep, from a hundredth of what they come to none.
TEST(CarriedSweeps, CountTheCellsThatAreHeld) {
  CarriedAtRest flow({1.0, 100.0}, {1.0, 100.0}, true);
  flow.settle(1e-11, 100);
  const State rest = flow.state;
  const auto cells = static_cast<std::int64_t>(std::llround(sumOverRanks(flow.b.mesh.owned)));
  for (const double share : {1e-2, 1e-40}) {
    flow.state = rest;
    for (double& amount : flow.state.carried) amount *= share;
    flow.residual.evaluate(flow.state);
    const std::int64_t held = flow.update->advance(flow.state, flow.residual, flow.inertia);
    double most = 0.0;
    for (std::size_t i = 0; i < 2 * at(flow.b.mesh.owned); ++i)
      most = std::max(most, flow.state.carried[i] / rest.carried[i]);
    report(fmt::format("from {:g}: {} of {} cells held, {:g} reached", share, held, cells, most));
    EXPECT_EQ(held, share < 1e-3 ? cells : 0);
  }
}

// What is far less than what counts as nothing has no residual to speak of, and all of it where that is not known.
TEST(CarriedSweeps, NothingIsLeftOfNextToNothing) {
  CarriedAtRest flow({0.0, 0.0}, {0.0, 0.0}, true);
  for (int c = 0; c < flow.b.mesh.cells; ++c)
    for (std::size_t s = 0; s < 2; ++s) flow.state.carried[2 * at(c) + s] = 1e-12 * (c % 3);
  flow.state.scalars[0].negligible = 1.0;
  flow.residual.evaluate(flow.state);
  for (const ResidualNorm& norm : residualNorms(flow.b.context, flow.state, flow.residual, 0.024)) {
    if (norm.equation == "first") {
      EXPECT_LT(norm.value, 1e-4);
    } else if (norm.equation == "second") {
      EXPECT_GT(norm.value, 0.1);
    }
  }
}

}  // namespace
}  // namespace lampblack::test
