// Ensembles are shared between ranks as the chemistry of cells is: what a population becomes does not depend on where
// it was advanced, and the dear ones travel.
#include <gtest/gtest.h>
#include <mpi.h>

#include <memory>
#include <vector>

#include "core/work_sharing.hpp"
#include "tests/particles/soot_fixtures.hpp"
#include "tests/world.hpp"

namespace lampblack::particles {
namespace {

// Populations in gases of rising naphthalene, each with as many numerical particles as it has by now.
class Populations {
 public:
  static constexpr std::size_t count = 6;

  // All of them belong to rank 0.
  Populations() : cost_(count, 1.0) {
    if (test::worldRank() != 0) return;
    for (std::size_t id = 0; id < count; ++id) own_.push_back(makeEnsemble(optionsOf(id)));
  }

  WorkSharing::Statistics advance(bool shared) {
    WorkSharing::Items items;
    if (!own_.empty()) items.cost = cost_;
    items.pack = [&](std::size_t id, std::vector<double>& input) {
      input.push_back(static_cast<double>(id));
      const std::vector<double> state = own_[id]->pack();
      input.insert(input.end(), state.begin(), state.end());
    };
    items.advance = [](std::span<const double> input, std::vector<double>& output) {
      const auto id = static_cast<std::size_t>(input[0]);
      const auto visitor = makeEnsemble(optionsOf(id));
      visitor->unpack(input.subspan(1));
      visitor->advance(gasOf(id).state, 0, 2e-4);
      output = visitor->pack();
    };
    items.unpack = [&](std::size_t id, std::span<const double> output) {
      own_[id]->unpack(output);
      cost_[id] = own_[id]->cost();
    };
    return WorkSharing(MPI_COMM_WORLD, shared).run(items);
  }

  [[nodiscard]] std::vector<std::vector<double>> packed() const {
    std::vector<std::vector<double>> all;
    for (const auto& one : own_) all.push_back(one->pack());
    return all;
  }
  [[nodiscard]] const std::vector<double>& cost() const { return cost_; }

 private:
  static EnsembleOptions optionsOf(std::size_t id) {
    EnsembleOptions options;
    options.method = EnsembleMethod::sammc;
    options.particles = 100 + 50 * id;
    options.owner = id;
    options.soot = test::threePah();
    options.splitTolerance = 0.05;
    return options;
  }
  static test::FlameGas gasOf(std::size_t id) {
    return {1700, 1e-3, 0.03, 1e-4, 0.08, 1e-4, 0.03, {2e-6 * static_cast<double>(id + 1), 3e-7, 2e-7}};
  }

  std::vector<std::unique_ptr<Ensemble>> own_;
  std::vector<double> cost_;
};

TEST(SharedEnsembles, BecomeTheSameBitsWhereverTheyAreAdvanced) {
  Populations apart, together;
  std::size_t sent = 0;
  for (int step = 0; step < 4; ++step) {
    apart.advance(false);
    sent += together.advance(true).itemsSent;
  }
  EXPECT_EQ(apart.packed(), together.packed());
  EXPECT_EQ(apart.cost(), together.cost());
  if (test::worldRank() == 0 && test::worldSize() > 1) {
    EXPECT_GT(sent, 4U);
  }
}

// Larger samples in a gas that feeds them more: more particles, steps and events.
TEST(SharedEnsembles, CostRisesWithParticlesAndEvents) {
  Populations populations;
  for (int step = 0; step < 4; ++step) populations.advance(false);
  if (test::worldRank() != 0) return;
  for (std::size_t id = 1; id < Populations::count; ++id)
    EXPECT_GT(populations.cost()[id], populations.cost()[id - 1]) << id;
}

TEST(SharedEnsembles, CostIsThatOfTheLastAdvance) {
  EnsembleOptions options;
  options.soot = test::threePah();
  const auto soot = makeEnsemble(options);
  EXPECT_EQ(soot->cost(), 0);
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 1e-4, 0.03, {2e-5, 3e-6, 2e-6});
  soot->advance(gas.state, 0, 1e-3);
  const double first = soot->cost();
  EXPECT_GT(first, static_cast<double>(soot->size()));
  soot->advance(gas.state, 0, 1e-5);
  EXPECT_LT(soot->cost(), 0.2 * first);
}

}  // namespace
}  // namespace lampblack::particles
