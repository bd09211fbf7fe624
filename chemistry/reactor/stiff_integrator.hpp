// Advances an OdeSystem by CVODES (BDF of variable order, Newton's method with the analytic Jacobian and a dense LU),
// one internal step at a time, with dense output between the last two times and, if wanted, forward sensitivities.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "chemistry/reactor/ode_system.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class StiffIntegrator {
 public:
  struct Options {
    double relativeTolerance = 1e-9;
    double absoluteTolerance = 1e-15;  // times OdeSystem::toleranceScale
    double maximumStep = 0;            // 0: no limit
    long maximumSteps = 1000000;       // between start() and the end
  };
  struct Statistics {
    long steps = 0, rateEvaluations = 0, jacobianEvaluations = 0, sensitivityEvaluations = 0;
  };

  // The system has to live as long.
  StiffIntegrator(OdeSystem& system, const Options& options);
  ~StiffIntegrator();
  StiffIntegrator(const StiffIntegrator&) = delete;
  StiffIntegrator& operator=(const StiffIntegrator&) = delete;

  // From here on; the integration does not look beyond `end`.
  void start(double time, std::span<const double> y, double end);
  // The same with sensitivities that start at zero, by the staggered corrector (Feehery, Tolsma, Barton 1997). They
  // take the steps of the state and do not shorten them.
  void start(double time, std::span<const double> y, double end, OdeParameters& parameters);
  // Goes on from time() to a later end than that of start(), keeping order and step size. For rates that are smooth
  // there; start() again where they are not.
  void extend(double end);
  // A nearer point the next steps stop at, for instance a kink of the rates; at most `end`.
  void stopAt(double time);

  // One internal step, which ends at the next stop at the latest. NumericsError, naming time and state, where the
  // integration cannot go on or has taken the most steps it may.
  void step();

  double time() const { return time_; }
  double previousTime() const { return previousTime_; }
  std::span<const double> state() const;  // at time()
  // The state inside the last step, by the interpolating polynomial of the method.
  void interpolate(double time, std::span<double> y) const;
  // The same of the sensitivities: s[p][i] = d y_i / d p.
  void interpolateSensitivities(double time, std::vector<std::vector<double>>& s) const;

  Statistics statistics() const;
  const Options& options() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  double time_ = 0, previousTime_ = 0;
};

}  // namespace lampblack::chemistry
