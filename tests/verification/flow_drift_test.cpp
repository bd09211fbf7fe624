// How far the pressure of the equation of state is from that of the gas as a whole after ten steps, and how it falls
// with the steps.
#include "flow_order.hpp"

namespace lampblack::test {
namespace {

struct Drift {
  double afterTenSteps = 0.0;  // largest |p_eos - p0|/p0 from the tenth step to the last
  double atTime = 0.0;         // after ten of the longest steps
};

// Of twenty of the longest steps' time, with steps of half, a quarter and an eighth of those of FlowOrder.
std::array<Drift, 3> measureDrift(Problem& problem, int sweeps) {
  State start = problem.stateAtStart();
  if (problem.prelude > 0.0) advance(problem, start, 2, 2 * problem.steps, problem.prelude);
  std::array<Drift, 3> found{};
  for (std::size_t level = 0; level < found.size(); ++level) {
    const int parts = 2 << level;
    State state = start;
    int step = 0;
    advance(problem, state, sweeps, 20 * parts, 20.0 * problem.duration / problem.steps,
            [&](TransportOperator& transport, const State& now) {
              const double drift = transport.pressureDrift(now);
              if (++step >= 10) found[level].afterTenSteps = std::max(found[level].afterTenSteps, drift);
              if (step == 10 * parts) found[level].atTime = drift;
            });
  }
  const auto order = [](double coarse, double fine) { return std::log2(coarse / fine); };
  report(
      fmt::format("{}, {} sweeps, |p_eos - p0|/p0 after ten steps: {:.1e} {:.1e} {:.1e}; at one time {:.1e} {:.1e} "
                  "{:.1e}, orders {:.2f} {:.2f}",
                  problem.name, sweeps, found[0].afterTenSteps, found[1].afterTenSteps, found[2].afterTenSteps,
                  found[0].atTime, found[1].atTime, found[2].atTime, order(found[0].atTime, found[1].atTime),
                  order(found[1].atTime, found[2].atTime)));
  return found;
}

void expectSmallAndOfSecondOrder(Problem& problem, int sweeps, double most = 1e-4) {
  const std::array<Drift, 3> found = measureDrift(problem, sweeps);
  for (const Drift& drift : found) EXPECT_LT(drift.afterTenSteps, most) << problem.name << ' ' << sweeps;
  // What the solvers' tolerances leave has no order.
  constexpr double tolerance = 1e-10;
  for (std::size_t level = 0; level < 2; ++level)
    EXPECT_LT(found[level + 1].atTime, found[level].atTime / std::pow(2.0, 1.9) + tolerance)
        << problem.name << ' ' << sweeps;
}

TEST(FlowDriftLong, FallsWithTheSquareOfTheStepInAHotSpot) {
  Problem problem = hotSpotInAStream();
  for (const int sweeps : {1, 2, 3}) expectSmallAndOfSecondOrder(problem, sweeps);
}

TEST(FlowDriftLong, FallsWithTheSquareOfTheStepInALayerRichInHydrogen) {
  Problem problem = layerRichInHydrogen();
  for (const int sweeps : {1, 2, 3}) expectSmallAndOfSecondOrder(problem, sweeps);
}

TEST(FlowDriftLong, FallsWithTheSquareOfTheStepInAPremixedFlame) {
  Gas gas("methane_drm19_21.yaml");
  Problem problem = premixedFlame(gas);
  // One sweep guesses the reactions' rates from the last step.
  expectSmallAndOfSecondOrder(problem, 1, 1e-3);
  for (const int sweeps : {2, 3}) expectSmallAndOfSecondOrder(problem, sweeps);
}

}  // namespace
}  // namespace lampblack::test
