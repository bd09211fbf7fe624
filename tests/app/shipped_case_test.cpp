// Cases that ship: found by name, and copied with all that their decks name.
#include "app/run/shipped_case.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"
#include "tests/scratch.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::app {
namespace {

namespace fs = std::filesystem;

ShippedCase freeMethane() {
  return {"flame1d/free_methane", "", test::sourceFolder / "cases/flame1d/free_methane"};
}

TEST(ShippedCases, ACopyHasTheFilesOfTheCaseAndItsMechanism) {
  const test::ScratchFolder scratch;
  const fs::path copy = scratch.path() / "mine";
  copyCase(freeMethane(), copy);
  EXPECT_TRUE(fs::exists(copy / "README.md"));
  ASSERT_EQ(decksIn(copy).size(), decksIn(freeMethane().folder).size());
  EXPECT_TRUE(fs::exists(copy / "methane_gri30_53.yaml"));
}

TEST(ShippedCases, AFolderThatIsThereIsLeftAsItIs) {
  const test::ScratchFolder scratch;
  EXPECT_NE(test::messageOf<InputError>([&] { copyCase(freeMethane(), scratch.path()); }).find("already"),
            std::string::npos);
  EXPECT_TRUE(fs::is_empty(scratch.path()));
}

}  // namespace
}  // namespace lampblack::app
