#include "chemistry/reactor/reactor_rosenbrock.hpp"

#include <algorithm>

namespace lampblack::chemistry {

// The reactor as the method sees it, with its evaluations counted.
class ReactorRosenbrock::Counted {
 public:
  Counted(ReactorSystem& system, NewtonMatrix& matrix, ReactorIntegrator::Work& work)
      : system_(system), matrix_(matrix), work_(work) {}

  bool rates(std::span<const double> y, std::span<double> f) {
    ++work_.rhsEvaluations;
    return system_.rates(y.data(), f.data());
  }
  bool linearise(std::span<const double> y, std::span<double> f) {
    ++work_.jacobianEvaluations;
    return matrix_.evaluate(system_, y.data(), f.data());
  }
  bool factorise(double gamma) { return matrix_.factorise(gamma); }
  void solve(std::span<double> b) { matrix_.solve(b.data()); }

 private:
  ReactorSystem& system_;
  NewtonMatrix& matrix_;
  ReactorIntegrator::Work& work_;
};

ReactorRosenbrock::ReactorRosenbrock(ReactorSystem& system) : system_(system), matrix_(system) {}

bool ReactorRosenbrock::advance(const ReactorIntegrator::Interval& interval, std::span<double> state,
                                ReactorIntegrator::Work& work, const ReactorIntegrator::Watcher& watcher,
                                std::span<double> slopes) {
  smallest_.assign(state.size(), interval.absoluteTolerance / interval.relativeTolerance);
  smallest_[system_.numSpecies()] = 1;  // K: as of CVODE
  Counted system(system_, matrix_, work);
  double reached = 0;
  const auto tell = [&](std::span<const double> y, double size) {
    reached += size;
    if (watcher) watcher({reached, size, 3, y[system_.numSpecies()]});
    for (std::size_t begin = 0; begin < slopes.size(); begin += y.size())
      solver_.carry(system, slopes.subspan(begin, y.size()));
    return true;
  };
  RosenbrockSolver::Result result;
  const bool arrived = solver_.tryToIntegrate(system, interval.duration, interval.firstStep, state,
                                              {interval.relativeTolerance, smallest_, interval.maxSteps}, tell, result);
  work.steps += result.steps;
  nextStep_ = result.nextStep;
  return arrived;
}

}  // namespace lampblack::chemistry
