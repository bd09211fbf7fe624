// What is carried fails on one rank alone: all ranks see the same failure, and none waits for another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_continuation.hpp"
#include "flow/flame/flame_equations.hpp"
#include "flow/flame/flame_solver.hpp"
#include "flow/flame/initial_flame.hpp"
#include "flow/flame/unsteady_flame.hpp"
#include "tests/flow/flame/flame_fixture.hpp"

namespace lampblack::flow {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* message = "soot of the last rank failed";

// One scalar without sources, which the last rank fails to compute so many times.
class Failing final : public CarriedModel {
 public:
  Failing() {
    int rank = 0, ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    last_ = rank == ranks - 1;
    scalars_.push_back({{"inert", "1/m^3", ""}, 1, 0, std::vector<double>(hydrogenMechanism()->numElements())});
  }
  [[nodiscard]] std::string material() const override { return "inert"; }
  [[nodiscard]] const std::vector<Scalar>& scalars() const override { return scalars_; }
  [[nodiscard]] const std::vector<std::size_t>& exchanged() const override { return exchanged_; }
  void sources(const ParticleGas&, std::span<const double>, std::span<double> rates, std::span<double>) override {
    std::ranges::fill(rates, 0.0);
    if (!last_ || failures == 0) return;
    --failures;
    throw NumericsError(message);
  }
  ParticleAdvance advance(const CarrierGas&, double, std::span<double>, std::span<double>,
                          std::span<const double>) override {
    return {};
  }
  void jacobian(const ParticleGas&, std::span<const double>, const CarriedJacobian& out) override {
    std::ranges::fill(out.values, 0.0);
  }
  void diffusivities(const ParticleGas&, std::span<const double>, std::span<double> D) override {
    std::ranges::fill(D, 1e-5);
  }
  void enthalpies(double, std::span<double> h, std::span<double> slope) override {
    std::ranges::fill(h, 0.0);
    std::ranges::fill(slope, 0.0);
  }
  double absorption(double, std::span<const double>) override { return 0; }

  std::size_t failures = 0;
  static constexpr std::size_t always = static_cast<std::size_t>(-1);

 private:
  bool last_ = false;
  std::vector<Scalar> scalars_;
  std::vector<std::size_t> exchanged_;
};

struct OneRankFailure : testing::Test {
  FlameProblem problem = hydrogenProblem(FlameType::Counterflow);
  Failing model;

  FlameProfile steady() {
    FlameSolverOptions options;
    options.grid.slope = 0.3;
    options.grid.curve = 0.5;
    FlameSolver solver(MPI_COMM_WORLD, hydrogenMechanism(), problem, &model, options);
    return solver.solve(initialFlame(*hydrogenMechanism(), problem, 1)).profile;
  }
  void expectFailedOnTheLastRank() const {
    int failed = model.failures == 0 ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(failed, 1);
  }
  // What each rank holds is that of rank 0.
  static void expectSameOnAllRanks(const std::string& text) {
    auto size = static_cast<int>(text.size());
    MPI_Bcast(&size, 1, MPI_INT, 0, MPI_COMM_WORLD);
    std::string first = text;
    first.resize(static_cast<std::size_t>(size));
    MPI_Bcast(first.data(), size, MPI_CHAR, 0, MPI_COMM_WORLD);
    EXPECT_EQ(text, first);
  }
  static void expectSameOnAllRanks(const std::vector<double>& values) {
    std::string bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
    expectSameOnAllRanks(bytes);
  }
  template <typename Work>
  static std::string failureOf(const Work& work) {
    try {
      work();
    } catch (const NumericsError& error) {
      return error.what();
    }
    ADD_FAILURE() << "there was no NumericsError";
    return "";
  }
};

TEST_F(OneRankFailure, EndsASteadyFlame) {
  model.failures = Failing::always;
  const std::string why = failureOf([&] { steady(); });
  EXPECT_THAT(why, HasSubstr(message));
  expectSameOnAllRanks(why);
}

TEST_F(OneRankFailure, EndsABranchWhereItIs) {
  const FlameProfile start = steady();
  const FlameBranch branch = followFlame(MPI_COMM_WORLD, hydrogenMechanism(), problem, &model, start, {},
                                         [&, points = 0](const FlameBranchPoint&, const FlameProfile&) mutable {
                                           if (++points == 3) model.failures = Failing::always;
                                         });
  EXPECT_FALSE(branch.complete);
  EXPECT_EQ(branch.points.size(), 3u);
  EXPECT_THAT(branch.reason, HasSubstr(message));
  expectSameOnAllRanks(branch.reason);
  expectSameOnAllRanks(branch.last.x);
}

TEST_F(OneRankFailure, ThatPassesDoesNotEndABranch) {
  const FlameProfile start = steady();
  FlameContinuationOptions options;
  options.maximumPoints = 5;
  options.pointsBetweenGrids = 0;
  const FlameBranch branch = followFlame(MPI_COMM_WORLD, hydrogenMechanism(), problem, &model, start, options,
                                         [&, points = 0](const FlameBranchPoint&, const FlameProfile&) mutable {
                                           if (++points == 3) model.failures = 1;
                                         });
  EXPECT_TRUE(branch.complete) << branch.reason;
  expectFailedOnTheLastRank();
  expectSameOnAllRanks(branch.last.x);
}

TEST_F(OneRankFailure, EndsAFlameInTime) {
  FlameProfile flame = steady();
  FlameEquations equations(MPI_COMM_WORLD, hydrogenMechanism(), problem, &model);
  equations.setGrid(flame.z);
  UnsteadyOptions options;
  options.end = 1e-2;
  options.outputTimes = {1e-4};
  const std::string why = failureOf([&] {
    integrateInTime(equations, flame.x, options,
                    [&](double, std::span<const double>) { model.failures = Failing::always; });
  });
  EXPECT_THAT(why, AllOf(HasSubstr("time steps became shorter"), HasSubstr(message)));
  expectSameOnAllRanks(why);
}

TEST_F(OneRankFailure, ThatPassesDoesNotEndAFlameInTime) {
  FlameProfile flame = steady();
  FlameEquations equations(MPI_COMM_WORLD, hydrogenMechanism(), problem, &model);
  equations.setGrid(flame.z);
  UnsteadyOptions options;
  options.end = 1e-3;
  options.outputTimes = {1e-4};
  const UnsteadyReport report =
      integrateInTime(equations, flame.x, options, [&](double, std::span<const double>) { model.failures = 1; });
  EXPECT_GE(report.rejected, 1u);
  expectFailedOnTheLastRank();
  expectSameOnAllRanks(flame.x);
}

}  // namespace
}  // namespace lampblack::flow
