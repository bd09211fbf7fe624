// A flame in a results file: what was written is read to the last bit; what is no flame is refused.
#include "app/problems/flame/flame_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <fstream>
#include <limits>

#include "core/errors.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FlameFile : public ::testing::Test {
 protected:
  // Two species, one scalar, four points: numbers that have no short decimal form.
  static NamedFlameProfile sample() {
    NamedFlameProfile flame;
    flame.species = {"H2", "N2"};
    flame.scalars = {"number"};
    flame.profile.layout = {2, 1};
    flame.profile.z = {0, 1.0 / 3, 2.0 / 3, 1};
    flame.profile.x.resize(flame.profile.size());
    for (std::size_t i = 0; i < flame.profile.x.size(); ++i) flame.profile.x[i] = 1.0 / (7.0 + static_cast<double>(i));
    return flame;
  }

  fs::path write(const NamedFlameProfile& flame) const {
    fs::path path = folder_.path() / "results.h5";
    ResultsWriter results(MPI_COMM_WORLD, path, {"1", "a", "", "today"});
    writeFlameProfile(results, flame);
    results.close();
    MPI_Barrier(MPI_COMM_WORLD);
    return path;
  }

  static std::string messageOf(const fs::path& path) {
    return test::messageOf<InputError>([&] { static_cast<void>(readFlameProfile(path)); });
  }

  test::SharedScratchFolder folder_;
};

TEST_F(FlameFile, IsReadToTheLastBit) {
  const NamedFlameProfile flame = sample(), back = readFlameProfile(write(flame));
  EXPECT_EQ(back.species, flame.species);
  EXPECT_EQ(back.scalars, flame.scalars);
  EXPECT_EQ(back.profile.layout, flame.profile.layout);
  EXPECT_EQ(back.profile.z, flame.profile.z);
  EXPECT_EQ(back.profile.x, flame.profile.x);
}

TEST_F(FlameFile, ADamagedFlameIsRefused) {
  NamedFlameProfile flame = sample();
  flame.profile.z[2] = flame.profile.z[1];
  EXPECT_THAT(messageOf(write(flame)), HasSubstr("the flame in it is damaged"));
  flame = sample();
  flame.profile.x[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(messageOf(write(flame)), HasSubstr("the flame in it is damaged"));
  flame = sample();
  flame.species.pop_back();
  EXPECT_THAT(messageOf(write(flame)), HasSubstr("/flame/restart/unknowns has the shape (4, 6), expected (4, 5)"));
}

TEST_F(FlameFile, ResultsOfSomethingElseAreRefused) {
  const fs::path path = folder_.path() / "other.h5";
  {
    ResultsWriter results(MPI_COMM_WORLD, path, {"1", "a", "", "today"});
    results.close();
  }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THAT(messageOf(path), HasSubstr("other.h5: these are no results of a flame"));
}

}  // namespace
}  // namespace lampblack::app
