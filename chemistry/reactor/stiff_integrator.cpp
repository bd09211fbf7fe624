#include "chemistry/reactor/stiff_integrator.hpp"

#include <cvodes/cvodes.h>
#include <fmt/format.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/errors.hpp"
#include "numerics/dense_lu.hpp"
#include "numerics/sundials_handles.hpp"

namespace lampblack::chemistry {

namespace {

using sundials::check;

// CVODES may lengthen a step that is lost in the rounding of the time by ten at each: after so many it does not.
constexpr int kMostStill = 100;

// Vectors of one sensitivity each.
class VectorArray {
 public:
  VectorArray(std::size_t count, N_Vector like) : vectors_(count) {
    for (auto& vector : vectors_) {
      vector.reset(N_VClone(like));
      check(vector.get(), "N_VClone");
      N_VConst(0.0, vector.get());
      raw_.push_back(vector.get());
    }
  }
  N_Vector* data() { return raw_.data(); }
  std::size_t size() const { return raw_.size(); }

 private:
  std::vector<sundials::Vector> vectors_;
  std::vector<N_Vector> raw_;
};

}  // namespace

struct StiffIntegrator::Impl {
  Impl(OdeSystem& systemIn, const Options& optionsIn);
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void reinitialise(double time, std::span<const double> start, double endTime);

  static int rates(sunrealtype t, N_Vector y, N_Vector f, void* data);
  static int linearSystem(sunrealtype t, N_Vector y, N_Vector f, SUNMatrix A, sunbooleantype jacobianOk,
                          sunbooleantype* current, sunrealtype gamma, void* data, N_Vector w1, N_Vector w2,
                          N_Vector w3);
  static int sensitivityRates(int count, sunrealtype t, N_Vector y, N_Vector f, N_Vector* s, N_Vector* sDot, void* data,
                              N_Vector w1, N_Vector w2);
  static int errorWeights(N_Vector y, N_Vector weights, void* data);
  static int setUp(SUNLinearSolver solver, SUNMatrix A);
  static int solve(SUNLinearSolver solver, SUNMatrix A, N_Vector x, N_Vector b, sunrealtype tolerance);
  static void keepMessage(const char* function, const char* message, void* integrator);

  OdeSystem& system;
  Options options;
  std::size_t n;
  DenseLu lu;
  std::vector<double> J, sensitivityJ, work;
  OdeParameters* parameters = nullptr;
  std::unique_ptr<VectorArray> sensitivities;
  std::string reason;
  double end = 0;
  long steps = 0;
  int still = 0;  // steps in a row that were too small to be seen in the time

  sundials::Context context;
  sundials::Vector y, interpolated, tolerances;
  sundials::Matrix matrix;
  sundials::LinearSolver linearSolver;
  sundials::Cvode cvode;
};

int StiffIntegrator::Impl::rates(sunrealtype t, N_Vector y, N_Vector f, void* data) {
  auto& self = *static_cast<Impl*>(data);
  return self.system.rates(t, N_VGetArrayPointer(y), N_VGetArrayPointer(f)) ? 0 : 1;
}

// I - gamma J straight into the storage of the LU; the SUNMatrix is a formality of the interface.
int StiffIntegrator::Impl::linearSystem(sunrealtype t, N_Vector y, N_Vector /*f*/, SUNMatrix /*A*/,
                                        sunbooleantype jacobianOk, sunbooleantype* current, sunrealtype gamma,
                                        void* data, N_Vector w1, N_Vector /*w2*/, N_Vector /*w3*/) {
  auto& self = *static_cast<Impl*>(data);
  const std::size_t ld = self.lu.leadingDimension();
  *current = jacobianOk == SUNFALSE ? SUNTRUE : SUNFALSE;
  if (jacobianOk == SUNFALSE &&
      !self.system.jacobian(t, N_VGetArrayPointer(y), N_VGetArrayPointer(w1), self.J.data(), ld))
    return 1;
  const double* __restrict from = self.J.data();
  double* __restrict to = self.lu.column(0);
  for (std::size_t i = 0; i < ld * self.n; ++i) to[i] = -gamma * from[i];
  for (std::size_t i = 0; i < self.n; ++i) to[i * ld + i] += 1.0;
  return 0;
}

// ds/dt = J s + df/dp for all parameters at once.
int StiffIntegrator::Impl::sensitivityRates(int count, sunrealtype t, N_Vector y, N_Vector /*f*/, N_Vector* s,
                                            N_Vector* sDot, void* data, N_Vector w1, N_Vector /*w2*/) {
  auto& self = *static_cast<Impl*>(data);
  const std::size_t n = self.n, ld = self.lu.leadingDimension();
  const double* state = N_VGetArrayPointer(y);
  if (!self.system.jacobian(t, state, N_VGetArrayPointer(w1), self.sensitivityJ.data(), ld)) return 1;
  if (!self.parameters->prepareParameters(t, state)) return 1;
  for (int p = 0; p < count; ++p) {
    const double* from = N_VGetArrayPointer(s[p]);
    double* __restrict sum = self.work.data();
    std::fill(self.work.begin(), self.work.end(), 0.0);
    for (std::size_t j = 0; j < n; ++j) {
      const double value = from[j];
      if (value == 0) continue;
      const double* __restrict column = self.sensitivityJ.data() + j * ld;
      for (std::size_t i = 0; i < ld; ++i) sum[i] += column[i] * value;
    }
    double* to = N_VGetArrayPointer(sDot[p]);
    std::copy_n(sum, n, to);
    self.parameters->addByParameter(static_cast<std::size_t>(p), to);
  }
  return 0;
}

int StiffIntegrator::Impl::errorWeights(N_Vector y, N_Vector weights, void* data) {
  auto& self = *static_cast<Impl*>(data);
  const double* state = N_VGetArrayPointer(y);
  double* w = N_VGetArrayPointer(weights);
  self.system.toleranceScales(state, w);
  for (std::size_t i = 0; i < self.n; ++i) {
    const double tolerance =
        self.options.relativeTolerance * std::abs(state[i]) + self.options.absoluteTolerance * w[i];
    if (!(tolerance > 0)) return -1;
    w[i] = 1 / tolerance;
  }
  return 0;
}

int StiffIntegrator::Impl::setUp(SUNLinearSolver solver, SUNMatrix /*A*/) {
  return static_cast<Impl*>(solver->content)->lu.factorise() ? sundials::succeeded : SUNLS_LUFACT_FAIL;
}

int StiffIntegrator::Impl::solve(SUNLinearSolver solver, SUNMatrix /*A*/, N_Vector x, N_Vector b,
                                 sunrealtype /*tolerance*/) {
  auto& self = *static_cast<Impl*>(solver->content);
  const double* from = N_VGetArrayPointer(b);
  double* to = N_VGetArrayPointer(x);
  if (from != to) std::copy_n(from, self.n, to);
  self.lu.solve(to);
  return sundials::succeeded;
}

void StiffIntegrator::Impl::keepMessage(const char* function, const char* message, void* integrator) {
  static_cast<Impl*>(integrator)->reason = fmt::format("{}: {}", function, message);
}

StiffIntegrator::Impl::Impl(OdeSystem& systemIn, const Options& optionsIn)
    : system(systemIn),
      options(optionsIn),
      n(systemIn.size()),
      lu(n),
      J(lu.leadingDimension() * n, 0.0),
      work(lu.leadingDimension(), 0.0),
      context(sundials::makeContext()) {
  const auto length = static_cast<sunindextype>(n);
  for (auto* vector : {&y, &interpolated, &tolerances}) {
    vector->reset(N_VNew_Serial(length, context.get()));
    check(vector->get(), "N_VNew_Serial");
    N_VConst(0.0, vector->get());
  }
  for (std::size_t i = 0; i < n; ++i)
    N_VGetArrayPointer(tolerances.get())[i] = options.absoluteTolerance * system.toleranceScale(i);
  matrix.reset(SUNDenseMatrix(1, 1, context.get()));
  check(matrix.get(), "SUNDenseMatrix");
  linearSolver.reset(SUNLinSolNewEmpty(context.get()));
  check(linearSolver.get(), "SUNLinSolNewEmpty");
  linearSolver->content = this;
  linearSolver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  linearSolver->ops->setup = setUp;
  linearSolver->ops->solve = solve;
  linearSolver->ops->free = [](SUNLinearSolver solver) {
    solver->content = nullptr;
    SUNLinSolFreeEmpty(solver);
    return int{sundials::succeeded};
  };
  cvode.reset(CVodeCreate(CV_BDF, context.get()));
  check(cvode.get(), "CVodeCreate");
  void* memory = cvode.get();
  check(CVodeInit(memory, rates, 0.0, y.get()), "CVodeInit");
  if (system.hasMovingScales())
    check(CVodeWFtolerances(memory, errorWeights), "CVodeWFtolerances");
  else
    check(CVodeSVtolerances(memory, options.relativeTolerance, tolerances.get()), "CVodeSVtolerances");
  check(CVodeSetUserData(memory, this), "CVodeSetUserData");
  sundials::keepErrors<keepMessage>(memory, context.get(), this);
  check(CVodeSetLinearSolver(memory, linearSolver.get(), matrix.get()), "CVodeSetLinearSolver");
  check(CVodeSetLinSysFn(memory, linearSystem), "CVodeSetLinSysFn");
  check(CVodeSetMaxErrTestFails(memory, 20), "CVodeSetMaxErrTestFails");
  if (options.maximumStep > 0) check(CVodeSetMaxStep(memory, options.maximumStep), "CVodeSetMaxStep");
}

void StiffIntegrator::Impl::reinitialise(double time, std::span<const double> start, double endTime) {
  if (start.size() != n) throw std::logic_error("StiffIntegrator: the state does not fit the system");
  std::copy(start.begin(), start.end(), N_VGetArrayPointer(y.get()));
  check(CVodeReInit(cvode.get(), time, y.get()), "CVodeReInit");
  check(CVodeSetStopTime(cvode.get(), endTime), "CVodeSetStopTime");
  end = endTime;
  steps = 0;
  still = 0;
  reason.clear();
}

StiffIntegrator::StiffIntegrator(OdeSystem& system, const Options& options)
    : impl_(std::make_unique<Impl>(system, options)) {}
StiffIntegrator::~StiffIntegrator() = default;

void StiffIntegrator::start(double time, std::span<const double> y, double end) {
  impl_->reinitialise(time, y, end);
  time_ = previousTime_ = time;
}

void StiffIntegrator::start(double time, std::span<const double> y, double end, OdeParameters& parameters) {
  start(time, y, end);
  auto& self = *impl_;
  if (self.parameters != nullptr) throw std::logic_error("StiffIntegrator: sensitivities are started once");
  self.parameters = &parameters;
  self.sensitivityJ.assign(self.J.size(), 0.0);
  self.sensitivities = std::make_unique<VectorArray>(parameters.numParameters(), self.y.get());
  void* memory = self.cvode.get();
  check(CVodeSensInit(memory, static_cast<int>(self.sensitivities->size()), CV_STAGGERED, Impl::sensitivityRates,
                      self.sensitivities->data()),
        "CVodeSensInit");
  check(CVodeSensEEtolerances(memory), "CVodeSensEEtolerances");
  check(CVodeSetSensErrCon(memory, SUNFALSE), "CVodeSetSensErrCon");
}

void StiffIntegrator::extend(double end) {
  impl_->end = end;
  impl_->steps = 0;
  stopAt(end);
}

void StiffIntegrator::stopAt(double time) {
  check(CVodeSetStopTime(impl_->cvode.get(), std::min(time, impl_->end)), "CVodeSetStopTime");
}

void StiffIntegrator::step() {
  auto& self = *impl_;
  sunrealtype reached = time_;
  const double before = time_;
  int flag = CV_TOO_MUCH_WORK;
  if (self.steps++ < self.options.maximumSteps)
    flag = CVode(self.cvode.get(), self.end, self.y.get(), &reached, CV_ONE_STEP);
  else
    self.reason = fmt::format("{} steps were taken", self.options.maximumSteps);
  if (flag < 0) {
    // CVODES leaves the last good state in y.
    throw NumericsError(fmt::format("the integration cannot go on: {}; {}",
                                    self.system.describe(reached, N_VGetArrayPointer(self.y.get())), self.reason));
  }
  self.still = reached > before ? 0 : self.still + 1;
  if (self.still > kMostStill)
    throw NumericsError(fmt::format("the integration cannot go on: {}; steps are too small to be added to {:g}",
                                    self.system.describe(reached, N_VGetArrayPointer(self.y.get())), reached));
  previousTime_ = before;
  time_ = reached;
  self.system.prescribe(reached, N_VGetArrayPointer(self.y.get()));
}

std::span<const double> StiffIntegrator::state() const {
  return {N_VGetArrayPointer(impl_->y.get()), impl_->n};
}

void StiffIntegrator::interpolate(double time, std::span<double> y) const {
  check(CVodeGetDky(impl_->cvode.get(), time, 0, impl_->interpolated.get()), "CVodeGetDky");
  std::copy_n(N_VGetArrayPointer(impl_->interpolated.get()), impl_->n, y.begin());
  impl_->system.prescribe(time, y.data());
}

void StiffIntegrator::interpolateSensitivities(double time, std::vector<std::vector<double>>& s) const {
  s.resize(impl_->sensitivities->size());
  for (std::size_t p = 0; p < s.size(); ++p) {
    check(CVodeGetSensDky1(impl_->cvode.get(), time, 0, static_cast<int>(p), impl_->interpolated.get()),
          "CVodeGetSensDky1");
    const double* from = N_VGetArrayPointer(impl_->interpolated.get());
    s[p].assign(from, from + impl_->n);
  }
}

const StiffIntegrator::Options& StiffIntegrator::options() const {
  return impl_->options;
}

StiffIntegrator::Statistics StiffIntegrator::statistics() const {
  Statistics result;
  void* memory = impl_->cvode.get();
  check(CVodeGetNumSteps(memory, &result.steps), "CVodeGetNumSteps");
  check(CVodeGetNumRhsEvals(memory, &result.rateEvaluations), "CVodeGetNumRhsEvals");
  check(CVodeGetNumJacEvals(memory, &result.jacobianEvaluations), "CVodeGetNumJacEvals");
  if (impl_->parameters != nullptr)
    check(CVodeGetSensNumRhsEvals(memory, &result.sensitivityEvaluations), "CVodeGetSensNumRhsEvals");
  return result;
}

}  // namespace lampblack::chemistry
