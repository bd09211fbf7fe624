// The steady states of a flow along a change of its load, round the turning points at which a flame goes out or
// ignites: as a flame of one dimension is followed (flow/flame/flame_continuation.hpp), by the iterations that find a
// steady state. From the second state on the load is an unknown, and the step along the branch is given by the
// temperatures (LoadControl). docs/theory/flow.md, "Branches".
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/steady/load_control.hpp"
#include "flow/steady/steady_iteration.hpp"
#include "numerics/branch_tracer.hpp"

namespace lampblack::flow {

class FlowBranch {
 public:
  struct Options {
    Load load;
    bool towardsHigherLoad = true;  // at the start
    double firstStep = 0.05;        // of the load
    // The branch ends with the first state beyond any of these.
    double lowestLoad = 0.0, highestLoad = std::numeric_limits<double>::infinity();
    double lowestPeakTemperature = 0.0;  // K
    int turningPoints = 1, points = 100;
    double residual = 1e-7;  // below which a state is steady (ResidualNorm)
    int iterations = 300;    // for a state, before a shorter step is tried
  };
  struct Point {
    double load = 1.0;
    double peakTemperature = 0.0;  // K
    double heatRelease = 0.0;      // W, per metre or radian
    double residual = 0.0;         // the largest of all equations
    int iterations = 0;            // taken to find it, those of failed steps too
    double arcLength = 0.0;        // K, along the branch (LoadControl::lengthOf)
  };

  // Collective. From a steady state, of a load of 1. `time`: s, that residuals are told for there. All have to
  // live as long; the state and what the flow is given become those of the last point.
  FlowBranch(FlowContext& context, State& state, VelocityScheme scheme, std::vector<Operator*> operators, double time,
             Options options);

  // Collective. `onPoint` sees each state, the first as well, and whether the branch is to end with it.
  void follow(const std::function<bool(const Point&)>& onPoint);

  // Collective. What the flow is given becomes that of a load of one again, the state's pressure too.
  void unload() { control_.setLoad(state_, 1.0); }

  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] const std::vector<TurningPoint>& turningPoints() const { return turns_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }  // why it ends there
  [[nodiscard]] bool isComplete() const { return isComplete_; }        // as asked for

 private:
  struct Found {
    bool isSteady = false;
    double residual = 0.0;
    int iterations = 0;
    std::string why;  // it is not
  };
  Found iterate(LoadControl* control);
  [[nodiscard]] Point pointNow(double residual) const;
  [[nodiscard]] std::vector<double> temperatures(const State& state) const;
  [[nodiscard]] bool isEnd();
  // The next state; false where even the shortest step finds none.
  bool advance();
  // Along the secant of the last two states, by a part of it.
  void predict(double part);
  void add(Point point, double length);
  void chooseStep(int iterations);

  FlowContext& context_;
  State& state_;
  VelocityScheme scheme_;
  std::vector<Operator*> operators_;
  double time_;
  Options options_;
  LoadControl control_;
  double step_;                         // of the load before the second state, then K
  bool isUnknown_ = false;              // whether the last state was found with the load as an unknown
  int failed_ = 0;                      // iterations of steps that have found nothing, since the last state
  std::optional<State> last_, before_;  // states; before_: none yet behind the first
  std::vector<Point> points_;
  std::vector<TurningPoint> turns_;
  std::string reason_;
  bool isComplete_ = false;
};

}  // namespace lampblack::flow
