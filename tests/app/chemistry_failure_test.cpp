// A stiff solve that fails in one cell of one rank ends the run on all ranks, with one message that says where and
// what.
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "flow/models/reaction_operator.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/core/mpi_support.hpp"

namespace lampblack::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ChemistryFailure : public testing::TestWithParam<bool> {};

TEST_P(ChemistryFailure, IsToldAlikeOnAllRanks) {
  // The cell at (1.25, 3.6) mm alone has something to burn; the other cells have no chemistry to fail in.
  const auto gas = [](const Vector3& x) {
    const bool hot = x[0] < 2e-3 && std::abs(x[1] - 3.6e-3) < 1e-4;
    return hot ? test::Gas{1750.0, "C2H4: 0.1, O2: 0.2, H: 0.002, OH: 0.002, N2: 0.696"} : test::Gas{300.0, "N2: 1"};
  };
  test::Flame flame(MPI_COMM_WORLD, gas);
  ReactionOperator::Options options;
  options.shareWork = GetParam();
  // More than double precision has.
  options.reactor.relativeTolerance = 1e-18;
  options.reactor.absoluteTolerance = 1e-40;
  ReactionOperator chemistry(flame.context, options);
  chemistry.endStep(flame.state);
  chemistry.endSweep(flame.state);
  bool collective = false;
  const std::string message = test::messageOf<NumericsError>([&] {
    try {
      chemistry.advance(flame.state, 2.5e-4, 1e-5);
    } catch (const std::exception& error) {
      collective = isCollective(error);
      throw;
    }
  });
  EXPECT_THAT(message,
              AllOf(HasSubstr("chemistry failed in cell 24 at (0.00125, 0.0036) m"), HasSubstr("time 0.00025 s"),
                    HasSubstr("T = 1750 K"), HasSubstr("p = 101325 Pa"), HasSubstr("dt = 1e-05 s"),
                    HasSubstr("C2H4: 0.0"), HasSubstr("O2: 0."), HasSubstr("CVode")));
  EXPECT_TRUE(collective);
  EXPECT_TRUE(test::sameOnAllRanks(message));
}

INSTANTIATE_TEST_SUITE_P(WorkSharing, ChemistryFailure, testing::Bool());

}  // namespace
}  // namespace lampblack::app
