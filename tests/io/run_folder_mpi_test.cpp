#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <fstream>

#include "core/modules.hpp"
#include "io/run_folder.hpp"
#include "io/run_record.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RunFolders : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) const {
    if (test::worldRank() == 0) {
      fs::create_directories(folder);
      std::ofstream(folder / name) << text;
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  [[nodiscard]] std::string refusal() const {
    try {
      (void)RunFolder::prepare(folder, false, MPI_COMM_WORLD);
    } catch (const InputError& error) {
      EXPECT_TRUE(isCollective(error));
      return error.what();
    }
    return "accepted";
  }
  test::SharedScratchFolder scratch;
  fs::path folder = scratch.path() / "run";  // not there at first
};

TEST_F(RunFolders, AreMadeWithTheFoldersAbove) {
  const RunFolder run = RunFolder::prepare(folder / "a" / "b", false, MPI_COMM_WORLD);
  EXPECT_TRUE(fs::is_directory(folder / "a" / "b"));
  EXPECT_EQ(run.results(), folder / "a" / "b" / "results.h5");
}

TEST_F(RunFolders, ThatHoldOtherThingsAreUsed) {
  put("notes.txt", "mine");
  EXPECT_EQ(refusal(), "accepted");
}

TEST_F(RunFolders, ThatHoldAFinishedRunAreRefusedWithAdvice) {
  RunRecord record;
  record.status = RunStatus::done;
  put("run.json", toJson(record));
  EXPECT_EQ(refusal(), folder.string() +
                           ": this folder holds a finished run already. Choose another with --out DIR, or replace that "
                           "run with --force");
}

TEST_F(RunFolders, ThatHoldAFailedOrUnfinishedRunSaySo) {
  RunRecord record;
  put("run.json", toJson(record));
  EXPECT_THAT(refusal(), HasSubstr("a run that was cut off"));
  record.status = RunStatus::failed;
  put("run.json", toJson(record));
  EXPECT_THAT(refusal(), HasSubstr("a run that failed"));
}

TEST_F(RunFolders, ThatHoldOnlyAPartialFileAreRefused) {
  put("results.h5.part", "x");
  EXPECT_THAT(refusal(), HasSubstr("parts of a run"));
}

TEST_F(RunFolders, LoseTheOldRunAndNothingElseWithForce) {
  put("run.json", "{}");
  put("results.h5", "x");
  put("notes.txt", "mine");
  (void)RunFolder::prepare(folder, true, MPI_COMM_WORLD);
  EXPECT_FALSE(fs::exists(folder / "run.json"));
  EXPECT_FALSE(fs::exists(folder / "results.h5"));
  EXPECT_TRUE(fs::exists(folder / "notes.txt"));
}

// What some runs alone leave goes too, but where no run was.
TEST_F(RunFolders, KeepNoTableOfAnotherRun) {
  for (const bool hasRun : {false, true}) {
    const auto someLeave = {"size_distributions.csv", "classes_primaries.csv", "soot.csv", "spectrum.csv",
                            "closure.csv"};
    for (const char* name : someLeave) put(name, "x");
    put("mine.csv", "x");
    for (const char* below : {"tables", "coarser_1/tables", "coarser_2"})
      if (test::worldRank() == 0) fs::create_directories(folder / below);
    for (const char* name : {"tables/wall_low.csv", "tables/deposit_low.csv", "tables/line_a.csv",
                             "tables/streamline_7.csv", "coarser_1/history.csv", "coarser_1/results.h5",
                             "coarser_1/tables/line_a.csv", "coarser_2/history.csv", "coarser_2/mine.csv"})
      put(name, "x");
    if (hasRun) put("run.json", "{}");
    (void)RunFolder::prepare(folder, true, MPI_COMM_WORLD);
    for (const char* name : someLeave) EXPECT_EQ(fs::exists(folder / name), !hasRun) << name;
    EXPECT_FALSE(fs::exists(folder / "tables"));
    EXPECT_EQ(fs::exists(folder / "coarser_1"), !hasRun);
    EXPECT_EQ(fs::exists(folder / "coarser_2/history.csv"), !hasRun);
    for (const char* name : {"mine.csv", "coarser_2/mine.csv"}) EXPECT_TRUE(fs::exists(folder / name)) << name;
    MPI_Barrier(MPI_COMM_WORLD);
  }
}

TEST_F(RunFolders, MayNotBeFiles) {
  if (test::worldRank() == 0) std::ofstream(folder) << "x";
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THAT(refusal(), HasSubstr("run: this is a file; the output has to go to a folder"));
  folder /= "below";
  EXPECT_THAT(refusal(), HasSubstr("run: this is a file; the output has to go to a folder"));
}

TEST_F(RunFolders, FilesAreReplacedWhole) {
  put("a.txt", "old");
  if (test::worldRank() == 0) {
    writeFileAtomically(folder / "a.txt", "new");
    std::ifstream file(folder / "a.txt");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "new");
    EXPECT_FALSE(fs::exists(folder / "a.txt.tmp"));
    EXPECT_THROW(writeFileAtomically(folder / "none" / "a.txt", "x"), InputError);
  }
}

}  // namespace
}  // namespace lampblack::io
