// Follows a branch of solutions of a system with a load through its turning points (pseudo-arc-length continuation,
// Keller 1977): a step along the tangent, then Newton's method in the plane normal to it.
//
// Lengths are measured in units of NewtonSystem::scales: the root mean square of all unknowns but the load, and the
// load beside it with a weight of its own, so that many grid points do not drown it. With relative scales of 1e-4 a
// length of 100 is a change by about one per cent.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "numerics/loaded_system.hpp"
#include "numerics/newton_solver.hpp"

namespace lampblack::numerics {

struct ContinuationOptions {
  bool towardsHigherLoad = true;  // at the start
  double firstStep = 100, smallestStep = 0.1, largestStep = 1e4;
  double loadWeight = 1;
  double bend = 0.2;          // aims at a distance from the tangent of this part of the step, rejects 2.5 times it
  std::size_t goodSteps = 8;  // Newton steps of a point; fewer lengthen the next step, more shorten it
  NewtonOptions newton = {.maximumSteps = 20};
};

struct BranchPoint {
  double load = 0;
  double arcLength = 0;  // from the start, sum of chords
  NewtonReport newton;
};

// Extremum of the parabola load(arc length) through the points index - 1, index, index + 1 of the branch; where it lies
// between the first two, of that through both with the slope of the first.
struct TurningPoint {
  std::size_t index = 0;
  double load = 0, arcLength = 0;
  bool highest = true;  // of the load: extinction; otherwise ignition
};

// Where the load turns between the last three points of a branch, b being number `index`; nothing where it goes on.
[[nodiscard]] std::optional<TurningPoint> turningPointOf(std::size_t index, const BranchPoint& a, const BranchPoint& b,
                                                         const BranchPoint& c);

class BranchTracer {
 public:
  // `system` has to live as long. While tracing its constraint is set; release() removes it.
  BranchTracer(LoadedSystem& system, ContinuationOptions options);

  // Solves for x at the load that x has, and finds the tangent there. False: no solution (reason()).
  bool start(std::span<const double> x);
  // The next point. False where even the smallest step fails (reason()); the tracer stays at its last point.
  bool advance();
  // Goes on from the same point in other unknowns (the system has another grid now): x and tangent as interpolated. x
  // is corrected normal to the tangent.
  bool resume(std::span<const double> x, std::span<const double> tangent);
  void release();

  [[nodiscard]] std::span<const double> x() const { return x_; }
  [[nodiscard]] std::span<const double> tangent() const { return tangent_; }  // of length 1
  [[nodiscard]] const std::vector<BranchPoint>& points() const { return points_; }
  [[nodiscard]] const std::vector<TurningPoint>& turningPoints() const { return turningPoints_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] double nextStep() const { return step_; }
  // Newton steps and factorisations of all points, failed ones too.
  [[nodiscard]] const NewtonReport& counts() const { return counts_; }

 private:
  // What became of a try to correct a point.
  enum class Outcome { Converged, TooFar, Failed };

  void setWeights();  // weights of the present point
  [[nodiscard]] double product(std::span<const double> a, std::span<const double> b) const;
  void constrain(double step);
  Outcome correct(std::vector<double>& candidate, double step, NewtonReport& report);
  // Solution of J t = (0 .. 0 1) with the factors at hand: along the branch, forwards, since the last row is the
  // constraint (or the load).
  void findTangent(double sign);
  void findTurningPoint();

  LoadedSystem& system_;
  ContinuationOptions options_;
  NewtonSolver solver_;
  std::vector<double> x_, tangent_, weights_;
  bool tangentIsExact_ = false;
  double step_ = 0, deviation_ = 0;
  double firstSlope_ = 0;  // of the load by arc length, at the start
  std::vector<BranchPoint> points_;
  std::vector<TurningPoint> turningPoints_;
  std::string reason_;
  NewtonReport counts_;
};

}  // namespace lampblack::numerics
