// What is kept in memory comes back as it was, and nothing but that.
#include "core/state_backup.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// Three cells, two of them owned, and four faces.
struct Owner {
  std::vector<double> cells{1, 2, 3, 4, 5, 6}, faces{7, 8, 9, 10}, sums{11, 12}, shared{13, 14};
  double number = 15;
  std::vector<std::vector<double>> rows{{21, 22, 23}, {}, {24}};
  std::string name = "cells";

  void saveOrLoad(StateArchive& archive) {
    archive.cells(name, cells, 2);
    archive.faces("faces", faces, 1);
    archive.rows("rows", rows);
    archive.sums("sums", sums);
    archive.shared("shared", shared);
    archive.shared("number", number);
  }
};

TEST(StateBackup, GivesBackWhatItWasGivenLast) {
  Owner owner;
  const StateBackup::Owners owners = [&](StateArchive& archive) { owner.saveOrLoad(archive); };
  StateBackup kept(2, 4);
  for (const double offset : {0.0, 100.0}) {
    owner.cells[0] += offset;
    owner.shared = {offset};
    owner.rows[0].resize(offset > 0 ? 1 : 3, 23);
    owner.rows[1].assign(offset > 0 ? 2 : 0, 25);
    kept.save(owners);
    const Owner before = owner;
    owner = {{0, 0, 0, 0, -5, -6}, {0, 0, 0, 0}, {0, 0}, {1, 2, 3, 4}, 0};
    owner.rows = {{1}, {2}, {-24}};
    kept.restore(owners);
    // What follows the owned cells is left alone.
    EXPECT_EQ(owner.cells, (std::vector<double>{1 + offset, 2, 3, 4, -5, -6}));
    EXPECT_EQ(owner.faces, before.faces);
    EXPECT_EQ(owner.sums, before.sums);
    EXPECT_EQ(owner.shared, before.shared);
    EXPECT_EQ(owner.number, 15);
    EXPECT_EQ(owner.rows, (std::vector<std::vector<double>>{before.rows[0], before.rows[1], {-24}}));
    // Of the rows three values and two lengths.
    EXPECT_EQ(kept.bytes(), sizeof(double) * (4 + 4 + 2 + before.shared.size() + 1 + 3 + 2));
  }
}

// To a mesh of which this rank owns the second cell and a new one, and sees three faces.
TEST(StateBackup, GoesAlongToOtherCellsAndFaces) {
  Owner owner;
  const StateBackup::Owners owners = [&](StateArchive& archive) { owner.saveOrLoad(archive); };
  StateBackup kept(2, 4);
  kept.save(owners);
  kept.rearrange(
      2, 3,
      [](const std::vector<double>& values, int width) {
        EXPECT_EQ(width, 2);
        EXPECT_EQ(values, (std::vector<double>{1, 2, 3, 4}));
        return std::vector<double>{3, 4, 20, 21};
      },
      [](const std::vector<double>& values, int width) {
        EXPECT_EQ(width, 1);
        EXPECT_EQ(values, (std::vector<double>{7, 8, 9, 10}));
        return std::vector<double>{10, 9, 8};
      },
      [](const PackedRows& rows) {
        EXPECT_EQ(rows.lengths, (std::vector<std::int64_t>{3, 0}));
        EXPECT_EQ(rows.values, (std::vector<double>{21, 22, 23}));
        return PackedRows{{0, 2}, {31, 32}};
      });
  const Owner before = owner;
  owner = {{0, 0, 0, 0}, {0, 0, 0}, {0, 0}, {}, 0};
  owner.rows = {{1}, {}};
  kept.restore(owners);
  EXPECT_EQ(owner.cells, (std::vector<double>{3, 4, 20, 21}));
  EXPECT_EQ(owner.faces, (std::vector<double>{10, 9, 8}));
  EXPECT_EQ(owner.sums, before.sums);
  EXPECT_EQ(owner.shared, before.shared);
  EXPECT_EQ(owner.rows, (std::vector<std::vector<double>>{{}, {31, 32}}));
  kept.save(owners);
  owner.cells.assign(4, 0.0);
  kept.restore(owners);
  EXPECT_EQ(owner.cells, (std::vector<double>{3, 4, 20, 21}));
}

// As a checkpoint has what the step, or the iterations, began with.
TEST(StateBackup, IsSavedInAnotherArchiveAndFilledFromThere) {
  Owner owner;
  const StateBackup::Owners owners = [&](StateArchive& archive) { owner.saveOrLoad(archive); };
  StateBackup kept(2, 4), checkpoint(2, 4);
  const StateBackup::Owners keeper = [&](StateArchive& archive) { kept.saveOrLoad(archive, "begin_"); };
  kept.save(owners);
  const Owner before = owner;
  checkpoint.save(keeper);
  owner = {{0, 0, 0, 0, 5, 6}, {0, 0, 0, 0}, {0, 0}, {1, 2, 3, 4}, 0};
  owner.rows = {{1}, {2, 3}, {24}};
  kept.save(owners);
  checkpoint.restore(keeper);
  kept.restore(owners);
  EXPECT_EQ(owner.cells, before.cells);
  EXPECT_EQ(owner.faces, before.faces);
  EXPECT_EQ(owner.sums, before.sums);
  EXPECT_EQ(owner.shared, before.shared);
  EXPECT_EQ(owner.number, before.number);
  EXPECT_EQ(owner.rows, before.rows);
}

TEST(StateBackup, KnowsOtherPieces) {
  Owner owner;
  const StateBackup::Owners owners = [&](StateArchive& archive) { owner.saveOrLoad(archive); };
  StateBackup kept(2, 4);
  EXPECT_THROW(kept.restore(owners), std::logic_error) << "nothing was kept";
  kept.save(owners);
  owner.name = "others";
  EXPECT_THROW(kept.restore(owners), std::logic_error);
}

}  // namespace
}  // namespace lampblack::test
