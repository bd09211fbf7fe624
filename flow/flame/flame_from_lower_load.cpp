#include "flow/flame/flame_from_lower_load.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/stop_request.hpp"
#include "flow/flame/flame_continuation.hpp"
#include "flow/flame/flame_state.hpp"

namespace lampblack::flow {
namespace {

constexpr std::array startLoads{0.3, 0.1, 0.03, 0.01, 0.001};
constexpr double firstRaise = 2, leastRaise = 1.05;

FlameProblem atLoad(FlameProblem problem, double load) {
  problem.strainRate *= load;
  problem.left.massFlux *= load;
  if (problem.right) problem.right->massFlux *= load;
  return problem;
}

class Raise {
 public:
  Raise(MPI_Comm comm, const std::shared_ptr<const Mechanism>& mechanism, const FlameProblem& problem,
        FlameSolverOptions options, const std::function<void(double, double)>& report,
        const std::function<void(double)>& tries)
      : comm_(comm),
        mechanism_(mechanism),
        problem_(problem),
        options_(std::move(options)),
        report_(report),
        tries_(tries) {
    options_.polish = 0;  // a way, not an end
  }

  [[nodiscard]] bool start(const InitialFlameOptions& options) {
    for (const double load : startLoads) {
      const FlameProblem problem = atLoad(problem_, load);
      if (solve(problem, initialFlame(*mechanism_, problem, 0, options), load)) return true;
    }
    return false;
  }

  RaisedFlame raise() {
    double factor = firstRaise;
    while (load_ < 1 && factor > leastRaise) {
      const double next = std::min(1.0, factor * load_);
      if (!solve(atLoad(problem_, next), profile_, next)) factor = std::sqrt(factor);
    }
    RaisedFlame raised;
    if (load_ < 1) follow(raised);
    if (load_ >= 1) raised.profile = profile_;
    return raised;
  }

 private:
  // Keeps a flame that burns and lasts.
  bool solve(const FlameProblem& problem, FlameProfile start, double load) {
    if (tries_) tries_(load);
    try {
      FlameSolution solution = FlameSolver(comm_, mechanism_, problem, nullptr, options_).solve(std::move(start));
      if (!isWarm(problem, solution.profile) || solution.growthRate) return false;
      profile_ = std::move(solution.profile);
    } catch (const FlameFailure&) {
      return false;
    }
    load_ = load;
    if (report_) report_(load_, profile_.peakTemperature());
    return true;
  }

  // Along the branch, in loads of the flame at hand.
  void follow(RaisedFlame& raised) {
    FlameContinuationOptions options;
    options.grid = options_.grid;
    options.tolerances = options_.tolerances;
    options.highestLoad = 1 / load_;
    options.maximumTurningPoints = 1;
    const FlameBranch branch = followFlame(comm_, mechanism_, atLoad(problem_, load_), nullptr, profile_, options,
                                           [&](const FlameBranchPoint& point, const FlameProfile&) {
                                             if (report_) report_(load_ * point.load, point.peakTemperature);
                                           });
    if (branch.stop != 0) raiseStopped(comm_, branch.stop, "in the search for a flame from lower velocities");
    if (!branch.turningPoints.empty()) {
      raised.extinctionLoad = load_ * branch.turningPoints.front().load;
    } else if (branch.complete && branch.last.global(load) > options.highestLoad) {
      profile_ = branch.last;
      profile_.global(load) = 1;
      load_ = 1;
    }
  }

  MPI_Comm comm_;
  std::shared_ptr<const Mechanism> mechanism_;
  const FlameProblem& problem_;
  FlameSolverOptions options_;
  const std::function<void(double, double)>& report_;
  const std::function<void(double)>& tries_;
  FlameProfile profile_;
  double load_ = 0;
};

}  // namespace

RaisedFlame flameFromLowerLoad(MPI_Comm comm, const std::shared_ptr<const Mechanism>& mechanism,
                               const FlameProblem& problem, const FlameSolverOptions& options,
                               const InitialFlameOptions& start, const std::function<void(double, double)>& report,
                               const std::function<void(double)>& tries) {
  if (problem.type == FlameType::Free) throw std::logic_error("a free flame has no load to raise");
  Raise raise(comm, mechanism, problem, options, report, tries);
  return raise.start(start) ? raise.raise() : RaisedFlame{};
}

}  // namespace lampblack::flow
