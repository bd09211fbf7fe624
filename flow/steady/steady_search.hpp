// The way to the steady state of a flow, as a plan that is told what came of each part: steps in time, which light a
// flame and are robust, until it is established; from there iterations on the residual, which need a thousandth of the
// time that the flow takes to come to rest; and where these do not converge steps in time again, longer each time (as
// Newton's method and steps in time alternate for one-dimensional flames: Kee, Grcar, Smooke, Miller 1985).
#pragma once

#include <deque>
#include <string>

#include "core/modules.hpp"
#include "core/state_archive.hpp"

namespace lampblack::flow {

class SteadySearch {
 public:
  struct Options {
    double residual = 1e-7;  // of each equation, of its throughflow (ResidualNorm), below which the flow is steady
    int iterations = 1000;   // in all, before the search is given up
    int returns = 5;         // from iterations that fail to steps in time, before the search is given up
    int steps = 0;           // before the first iterations, twice as many with each return; 0: until the heat is quiet
    bool reacts = true;      // false: there is no flame to wait for; ten steps are enough where little is left
    // Attempts to iterate before that, after 20 steps and each after twice as many: an attempt that fails is taken
    // back, and the search goes on as if it had not been.
    int attempts = 0;
    // Iterations without gain before they end in vain; steps of one time (ImplicitStep) are iterations, too, and the
    // residuals of a flame on its way rise before they fall.
    int patience = 100;
  };
  enum class Phase { Steps, Iterations };
  // The largest residual of any equation, and those that carry the flame, of momentum (or swirl) and of enthalpy: a
  // trace's may fall while these run away, and that of momentum falls in any case after a short step.
  struct Residual {
    double largest = 0.0, ofMomentum = 0.0, ofEnthalpy = 0.0;
    Residual(double all) : Residual(all, all, all) {}
    Residual(double all, double momentum, double enthalpy) : largest(all), ofMomentum(momentum), ofEnthalpy(enthalpy) {}
  };

  explicit SteadySearch(const Options& options) : options_(options) {}

  [[nodiscard]] Phase phase() const { return phase_; }
  [[nodiscard]] bool isSteady() const { return isSteady_; }
  // Whether nothing is left of momentum, as far as the search asks for it.
  [[nodiscard]] bool isFlowAtRest() const { return latest_.ofMomentum <= options_.residual; }
  // Whether iterations may be combined (SteadyIteration): no more where the flow is at rest, but for a while where
  // those by themselves then lead nowhere.
  [[nodiscard]] bool mayAccelerate() const { return !isFlowAtRest() || combined_ > 0; }
  // Whether they may be Newton's: besides, until nothing is left of enthalpy, either; an iteration by itself would
  // bring back more of both than it takes away of the radicals.
  [[nodiscard]] bool mayBeNewtons() const { return mayAccelerate() || latest_.ofEnthalpy > options_.residual; }
  // Whether iterations and returns are used up.
  [[nodiscard]] bool isGivenUp() const { return isGivenUp_; }
  // Whether the residual of the state after the last step has to be told before the next.
  [[nodiscard]] bool wantsResidual() const;
  // Whether the iterations that have just ended in vain left nothing to go on from, as the flame has gone out or a
  // residual, the largest or that of the flame above the limit, is no smaller: the flow is then to be what it was
  // before the first.
  [[nodiscard]] bool takesBack() const { return takesBack_; }

  // What came of a step in time: heat that reactions release in the domain (W, or per metre of depth or radian), and
  // whether the step was tried more than once.
  void addStep(double heatRelease, bool wasRetried);
  // Of the state that the steps have led to. `burns`: as for an iteration; nothing is attempted where nothing burns.
  void addResidualOfStep(const Residual& residual, bool burns = true);
  // What came of an iteration that was taken. `burns`: whether there is a flame in the state, or could be none; asked
  // where the residual is low enough.
  void addIteration(const Residual& residual, double heatRelease, bool burns = true);
  // An iteration that was not taken, and why; the next may be, as it tries less.
  void addFailure(const std::string& why);
  // What acts on the flow has changed, of which that is left in the state that was found: iterations go on from there,
  // as many as at the start.
  void resume(const Residual& residual, double heatRelease);
  // The flow has been lit: the steps in time begin anew, as at the start of the search.
  void addLighting();
  // The iterations cannot go on, and the state is not to be relied on.
  void endIterations(const std::string& why);

  [[nodiscard]] const Options& options() const { return options_; }
  [[nodiscard]] int iterations() const { return iterations_; }
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] int returns() const { return returns_; }
  [[nodiscard]] int lightings() const { return lightings_; }
  // Attempts that have failed, and their part of the iterations; whether the present iterations are one.
  [[nodiscard]] int attempts() const { return attempts_; }
  [[nodiscard]] int iterationsTakenBack() const { return attempted_; }
  [[nodiscard]] bool isAttempt() const { return isAttempt_; }
  // With which the first iterations began; zero before.
  [[nodiscard]] double firstResidual() const { return first_; }
  // How far the residual has fallen since then, of what it has to fall on a logarithmic scale: 0 to 1.
  [[nodiscard]] double progress() const;
  // Why the last iterations ended in vain; empty where none did.
  [[nodiscard]] const std::string& whyNot() const { return whyNot_; }

  void saveOrLoad(StateArchive& archive);

 private:
  void beginIterations(const Residual& residual, double heatRelease);
  void chooseKind();
  [[nodiscard]] int leastNow() const;  // steps before iterations
  [[nodiscard]] bool isEstablished() const;
  [[nodiscard]] bool isNear() const;
  [[nodiscard]] bool isAttemptDue() const;
  [[nodiscard]] bool hasNoIterationsLeft() const;
  void goBack(const std::string& why);
  // Whether the iterations have left no less of an equation that carries the flame; adds to why they ended.
  [[nodiscard]] bool hasLostFlame();

  Options options_;
  Phase phase_ = Phase::Steps;
  bool isSteady_ = false, isGivenUp_ = false, takesBack_ = false;
  int steps_ = 0, iterations_ = 0, returns_ = 0, lightings_ = 0;
  int iterationsBefore_ = 0;          // it was resumed the last time
  int stepsNow_ = 0;                  // of the present phase
  std::deque<double> heat_;           // W, of the last steps, the present at the back
  int undisturbed_ = 0;               // steps since one that was tried again
  double first_ = 0.0, least_ = 0.0;  // largest residuals: of the first iterations' begin, since
  Residual latest_{0.0};
  // Of the present iterations: the residual and the heat that they began with, the least residual since, when it was.
  Residual began_{0.0};
  double heatAtBegin_ = 0.0, mostHeat_ = 0.0;
  Residual best_{0.0};  // the least of each since iterations began
  int iterationsNow_ = 0, bestAt_ = 0;
  // In a flow at rest: iterations by themselves since one that left less, with the largest residual then; combined ones
  // that are to come.
  int alone_ = 0, combined_ = 0;
  double leastAlone_ = 0.0;
  int failures_ = 0, dark_ = 0;  // in a row: failures, iterations with a small part of that heat
  int attempts_ = 0, attempted_ = 0;
  bool isAttempt_ = false;
  std::string whyNot_;
};

}  // namespace lampblack::flow
