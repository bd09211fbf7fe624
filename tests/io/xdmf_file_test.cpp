// The XDMF file of a run that goes on: the text of all steps after each of them, for what one step costs.
#include "io/xdmf_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/errors.hpp"
#include "core/system_error.hpp"
#include "tests/every_module.hpp"
#include "tests/scratch.hpp"

namespace lampblack::io {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

ino_t inodeOf(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(stat(path.c_str(), &status), 0);
  return status.st_ino;
}

class XdmfFileTest : public testing::Test {
 protected:
  // Numbers of as many digits in each, so that all steps are texts of one length.
  void addStep() {
    const auto number = static_cast<int>(steps.size()) + 100;
    steps.push_back({"/steps/000" + std::to_string(number),
                     static_cast<double>(number),
                     {{"temperature"}, {"a<b", 3}, {"level", 1, true}}});
  }
  static constexpr XdmfMesh mesh{2, 4, 35, 48};
  const test::ScratchFolder folder;
  const fs::path path = folder.path() / "results.xdmf";
  std::vector<XdmfStep> steps;
  XdmfFile file{path, mesh};
};

TEST_F(XdmfFileTest, IsTheTextOfAllStepsAfterEachAndAStepCostsTheSame) {
  addStep();
  EXPECT_EQ(file.update("r.h5.part", steps), xdmfText("r.h5.part", mesh, steps).size());
  const ino_t first = inodeOf(path);
  const std::size_t once = xdmfStepText("r.h5.part", mesh, steps[0]).size() + xdmfTail().size();
  for (int i = 1; i < 50; ++i) {
    addStep();
    EXPECT_EQ(file.update("r.h5.part", steps), once);
    ASSERT_EQ(contentOf(path), xdmfText("r.h5.part", mesh, steps));
  }
  EXPECT_EQ(inodeOf(path), first);  // it was never another file
  // Nothing new, two steps at once, another name.
  EXPECT_EQ(file.update("r.h5.part", steps), 0U);
  addStep();
  addStep();
  EXPECT_EQ(file.update("r.h5.part", steps), 2 * once - xdmfTail().size());
  EXPECT_EQ(contentOf(path), xdmfText("r.h5.part", mesh, steps));
  file.update("r.h5", steps);
  EXPECT_EQ(contentOf(path), xdmfText("r.h5", mesh, steps));
}

TEST_F(XdmfFileTest, OfNoStepsIsWholeAsWell) {
  file.update("r.h5.part", steps);
  EXPECT_EQ(contentOf(path), xdmfText("r.h5.part", mesh, {}));
  addStep();
  file.update("r.h5.part", steps);
  EXPECT_EQ(contentOf(path), xdmfText("r.h5.part", mesh, steps));
}

// Cut at each byte that the next step would have been written to, gone, or longer than it was left.
TEST_F(XdmfFileTest, ThatIsNotAsItWasLeftIsWrittenWhole) {
  addStep();
  file.update("r.h5.part", steps);
  const std::string before = contentOf(path);
  const auto ended = before.size() - xdmfTail().size();
  for (std::size_t cut = ended; cut < before.size(); ++cut) {
    fs::resize_file(path, cut);
    addStep();
    file.update("r.h5.part", steps);
    ASSERT_EQ(contentOf(path), xdmfText("r.h5.part", mesh, steps));
  }
  fs::remove(path);
  addStep();
  file.update("r.h5.part", steps);
  EXPECT_EQ(contentOf(path), xdmfText("r.h5.part", mesh, steps));
  std::ofstream(path, std::ios::app) << "more";
  addStep();
  file.update("r.h5.part", steps);
  EXPECT_EQ(contentOf(path), xdmfText("r.h5.part", mesh, steps));
}

// The limit cuts the write in the middle of the new step.
TEST_F(XdmfFileTest, ThatHasNoRoomForAStepStaysWhole) {
  addStep();
  file.update("r.h5.part", steps);
  const std::string before = contentOf(path);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit unlimited{};
  getrlimit(RLIMIT_FSIZE, &unlimited);
  const rlimit small{before.size() + 100, unlimited.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  addStep();
  EXPECT_THROW(file.update("r.h5.part", steps), SystemError);
  EXPECT_EQ(contentOf(path), before);
  setrlimit(RLIMIT_FSIZE, &unlimited);
  file.update("r.h5.part", steps);
  EXPECT_EQ(contentOf(path), xdmfText("r.h5.part", mesh, steps));
}

}  // namespace
}  // namespace lampblack::io
