// Work in cells that the ranks share: what is packed is what is advanced, every cell gets its own, costs go to the cell
// and the step they are of, and a failure names the cell that failed.
#include "flow/models/shared_cell_work.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/state_backup.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// In the order in which they are not needed.
struct Packed {
  double count, number, factor;
};
struct Found {
  double sum, cost, number;
};

class CellWork : public testing::Test {
 protected:
  Box box{Geometry::Planar,
          {uniformAxis(0.008, 8), uniformAxis(0.006, 6)},
          {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
           side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)}};

  [[nodiscard]] double numberOf(int cell) const { return static_cast<double>(box.mesh.naturalCell[at(cell)]); }
  // Two cells in three, the dearest with the highest numbers, so that ranks have to share.
  [[nodiscard]] std::vector<SharedCellWork::Item> items(const SharedCellWork& work) const {
    std::vector<SharedCellWork::Item> all;
    for (int c = 0; c < box.mesh.owned; ++c)
      if (box.mesh.naturalCell[at(c)] % 3 != 1) all.push_back({c, work.expectedCost(c)});
    return all;
  }
  static double costOf(double number) { return 1.0 + number * number; }
  // A row of number % 4 values number, number + 1, ...; their sum, and each times the factor, come back.
  SharedCellWork::Work<Packed, Found> toy(const std::vector<SharedCellWork::Item>& all) {
    SharedCellWork::Work<Packed, Found> work;
    work.pack = [this, &all](std::size_t i, RowWriter rows) {
      const double number = numberOf(all[i].cell);
      const std::span<double> row = rows.add(static_cast<std::size_t>(number) % 4);
      for (std::size_t k = 0; k < row.size(); ++k) row[k] = number + static_cast<double>(k);
      return Packed{static_cast<double>(row.size()), number, 2.0 + number};
    };
    work.together = 5;
    work.advance = [this](const auto& tasks, const auto& results, const auto& rows) {
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        const Packed& in = tasks[i].input;
        if (in.number == fails) throw FailureInGroup("it is broken", i);
        EXPECT_EQ(tasks[i].label.number, in.number);
        EXPECT_EQ(static_cast<double>(tasks[i].rows.size()), in.count);
        results[i] = {0.0, costOf(in.number), in.number};
        const std::span<double> back = rows[i].add(tasks[i].rows.size());
        for (std::size_t k = 0; k < back.size(); ++k) {
          results[i].sum += tasks[i].rows[k];
          back[k] = in.factor * tasks[i].rows[k];
        }
        away += static_cast<int>(box.mesh.findOwned(static_cast<std::int64_t>(in.number)) < 0);
      }
    };
    work.unpack = [this, &all](std::size_t i, const Found& found, std::span<const double> rows) {
      const double number = numberOf(all[i].cell), count = std::fmod(number, 4.0);
      EXPECT_EQ(found.number, number);
      EXPECT_EQ(found.sum, count * number + 0.5 * count * (count - 1.0));
      ASSERT_EQ(static_cast<double>(rows.size()), count);
      for (std::size_t k = 0; k < rows.size(); ++k)
        EXPECT_EQ(rows[k], (2.0 + number) * (number + static_cast<double>(k)));
      ++taken;
    };
    return work;
  }
  WorkSharing::Statistics advance(SharedCellWork& work, SharedCellWork::Over over = SharedCellWork::Over::Step) {
    const auto all = items(work);
    return work.advance(all, 0.25, toy(all), over);
  }
  double fails = -1.0;
  int taken = 0, away = 0;
};

TEST_F(CellWork, EveryCellGetsItsOwnAndItsCost) {
  SharedCellWork work(box.context, {"toy", "the toy", true, 7.0});
  work.beginStep();
  advance(work);
  EXPECT_EQ(sumOverRanks(taken), 32.0);
  for (int c = 0; c < box.mesh.owned; ++c)
    EXPECT_EQ(work.expectedCost(c), std::fmod(numberOf(c), 3.0) == 1.0 ? 7.0 : costOf(numberOf(c)));
  // By these costs the next sweep is shared.
  advance(work);
  if (worldSize() > 1) {
    EXPECT_GT(sumOverRanks(away), 0.0);
  }
  CellCost cost(box.mesh.owned);
  work.addCost(cost);
  for (int c = 0; c < box.mesh.owned; ++c) {
    EXPECT_EQ(cost.shared[at(c)], std::fmod(numberOf(c), 3.0) == 1.0 ? 0.0 : 2.0 * costOf(numberOf(c)));
    EXPECT_EQ(cost.own[at(c)], 0.0);
  }
  // The next step's are counted anew, once it begins.
  work.endStep();
  work.beginStep();
  work.beginStep();
  CellCost none(box.mesh.owned);
  work.addCost(none);
  EXPECT_EQ(none.shared, none.own);
}

TEST_F(CellWork, OfPartsCountsWithTheStepAlone) {
  SharedCellWork work(box.context, {"toy", "the toy", false, 4.0, true});
  advance(work, SharedCellWork::Over::Part);
  EXPECT_FALSE(work.imbalance());
  for (int c = 0; c < box.mesh.owned; ++c) EXPECT_EQ(work.expectedCost(c), 4.0);
  advance(work);
  const auto stays = [](double number) { return std::fmod(number, 3.0) == 1.0; };
  CellCost cost(box.mesh.owned);
  work.addCost(cost);
  for (int c = 0; c < box.mesh.owned; ++c) {
    const double number = numberOf(c);
    EXPECT_EQ(work.expectedCost(c), stays(number) ? 4.0 : 0.5 * (4.0 + costOf(number))) << "smoothed";
    EXPECT_EQ(cost.own[at(c)], stays(number) ? 0.0 : 2.0 * costOf(number)) << "not shared";
    EXPECT_EQ(cost.shared[at(c)], 0.0);
  }
}

TEST_F(CellWork, AFailureNamesTheCellOnAllRanks) {
  for (const double number : {0.0, 26.0, 47.0}) {
    SharedCellWork work(box.context, {"toy", "the toy"});
    fails = number;
    const std::string message = messageOf<NumericsError>([&] { advance(work); });
    const double x = 0.0005 + 0.001 * std::fmod(number, 8.0), y = 0.0005 + 0.001 * std::floor(number / 8.0);
    EXPECT_EQ(message, fmt::format("the toy failed in cell {:.0f} at ({:.6g}, {:.6g}) m at time 0.25 s: it is broken",
                                   number, x, y));
    EXPECT_TRUE(sameOnAllRanks(message));
  }
  // One at a time: any failure is that of the cell.
  SharedCellWork alone(box.context, {"toy", "the toy"});
  fails = -1.0;
  const auto all = items(alone);
  auto one = toy(all);
  one.together = 1;
  one.advance = [](const auto& tasks, const auto&, const auto&) {
    if (tasks.front().input.number == 11.0) throw NumericsError("too hot");
  };
  one.unpack = [](std::size_t, const Found&, std::span<const double>) {};
  EXPECT_THAT(messageOf<NumericsError>([&] { alone.advance(std::span(all), 0.25, one); }),
              testing::HasSubstr("the toy failed in cell 11 at (0.0035, 0.0015) m at time 0.25 s: too hot"));
}

// What is kept goes on; what the report counts is of this run, but not less for a step that is taken back.
TEST_F(CellWork, GoesOnFromWhatIsKept) {
  SharedCellWork work(box.context, {"toy", "the toy", true, 1.0});
  const WorkSharing::Statistics first = advance(work);
  StateBackup backup(box.mesh.owned, box.mesh.faces);
  backup.save([&](StateArchive& archive) { work.saveOrLoad(archive); });
  SharedCellWork other(box.context, {"toy", "the toy", true, 1.0});
  backup.restore([&](StateArchive& archive) { other.saveOrLoad(archive); });
  for (int c = 0; c < box.mesh.owned; ++c) EXPECT_EQ(other.expectedCost(c), work.expectedCost(c));
  EXPECT_EQ(other.imbalance().value().before, first.imbalanceBefore);
  EXPECT_EQ(other.imbalance().value().after, first.imbalanceAfter);
  const WorkSharing::Statistics second = advance(other);
  EXPECT_EQ(other.imbalance().value().before, 0.5 * (first.imbalanceBefore + second.imbalanceBefore));
  // From a checkpoint.
  backup.restore([&](StateArchive& archive) { other.saveOrLoad(archive); });
  other.beginRun();
  EXPECT_FALSE(other.imbalance());
  EXPECT_EQ(advance(other).imbalanceBefore, second.imbalanceBefore);
  EXPECT_EQ(other.imbalance().value().before, second.imbalanceBefore);
}

}  // namespace
}  // namespace lampblack::test
