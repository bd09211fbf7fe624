#include "chemistry/reactor.hpp"

#include <cvodes/cvodes.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "chemistry/reactor_linear_solver.hpp"
#include "chemistry/reactor_system.hpp"
#include "chemistry/short_vector.hpp"
#include "chemistry/sundials_handles.hpp"
#include "core/errors.hpp"

namespace lampblack {

namespace {

// How an integration is tried; the later attempts are for cells where the first one fails.
struct Attempt {
  double firstStep;  // s; 0: the solver's choice
  double toleranceFactor;
  int stepsFactor;
  int pieces;
};

// Largest deviation of the sum of mass fractions that may be put down to round-off and removed by rescaling.
constexpr double kSumTolerance = 1e-9;

}  // namespace

struct ConstantPressureReactor::Impl {
  Impl(const Mechanism& mechanismIn, const Options& optionsIn);
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void checkInput(const Cell& cell, double dt) const;
  bool skip(Cell& cell, double dt, Result& result);
  std::optional<double> integrate(const Cell& cell, double dt, const Attempt& attempt, Result& result);
  bool integratePiece(double dt, double firstStep, int maxSteps, double toleranceFactor, double& lastStep,
                      Result& result);
  bool accept(Cell& cell);
  [[noreturn]] void giveUp(const Cell& cell, double dt) const;

  static int rhs(realtype t, N_Vector y, N_Vector f, void* data);
  static void keepMessage(int code, const char* module, const char* function, char* message, void* data);

  const Mechanism& mechanism;
  Options options;
  ReactorSystem system;
  std::size_t n;  // species
  std::vector<double> start, predicted, chemical, chemicalEnd, scratch;
  double startSum = 0, enthalpy = 0;
  std::string reason;

  sundials::Context context;
  sundials::Vector y, tolerances;
  ReactorLinearSolver linearSolver;
  sundials::Cvode cvode;
};

int ConstantPressureReactor::Impl::rhs(realtype /*t*/, N_Vector y, N_Vector f, void* data) {
  auto& self = *static_cast<Impl*>(data);
  return self.system.rates(N_VGetArrayPointer(y), N_VGetArrayPointer(f)) ? 0 : 1;
}

void ConstantPressureReactor::Impl::keepMessage(int code, const char* /*module*/, const char* function, char* message,
                                                void* data) {
  auto& self = *static_cast<Impl*>(data);
  if (code >= 0) return;
  self.reason = fmt::format("{}: {}", function, message);
  if (!self.system.refusal().empty()) self.reason += fmt::format(" ({})", self.system.refusal());
}

ConstantPressureReactor::Impl::Impl(const Mechanism& mechanismIn, const Options& optionsIn)
    : mechanism(mechanismIn),
      options(optionsIn),
      system(mechanismIn),
      n(mechanismIn.numSpecies()),
      context(sundials::makeContext()),
      linearSolver(system, context.get()) {
  using sundials::check;
  for (auto* work : {&start, &predicted, &chemical, &chemicalEnd, &scratch}) work->assign(n + 1, 0.0);
  y = sundials::makeShortVector(n + 1, context.get());
  tolerances = sundials::makeShortVector(n + 1, context.get());
  cvode.reset(CVodeCreate(CV_BDF, context.get()));
  check(cvode.get(), "CVodeCreate");
  void* memory = cvode.get();
  check(CVodeInit(memory, rhs, 0.0, y.get()), "CVodeInit");
  N_VConst(1e-12, tolerances.get());
  check(CVodeSVtolerances(memory, options.relativeTolerance, tolerances.get()), "CVodeSVtolerances");
  check(CVodeSetUserData(memory, this), "CVodeSetUserData");
  check(CVodeSetErrHandlerFn(memory, keepMessage, this), "CVodeSetErrHandlerFn");
  linearSolver.attach(memory);
}

void ConstantPressureReactor::Impl::checkInput(const Cell& cell, double dt) const {
  if (cell.Y.size() != n || (!cell.source.empty() && cell.source.size() != n))
    throw std::logic_error("ConstantPressureReactor: arrays of the cell do not have one value a species");
  bool good = dt >= 0 && std::isfinite(dt) && cell.pressure > 0 && std::isfinite(cell.pressure) &&
              cell.temperature >= Thermo::minTemperature && cell.temperature <= Thermo::maxTemperature;
  double sum = 0;
  for (const double value : cell.Y) sum += value;
  for (const double value : cell.source) good = good && std::isfinite(value);
  good = good && std::abs(sum - 1) < 1e-3;
  if (!good) giveUp(cell, dt);
}

// Explicit trapezoid where the chemistry is negligible at both ends; see Options::negligibleChange.
bool ConstantPressureReactor::Impl::skip(Cell& cell, double dt, Result& result) {
  if (options.negligibleChange <= 0) return false;
  system.setConditions(cell.pressure, cell.source);
  ++result.rhsEvaluations;
  if (!system.chemicalRates(start.data(), chemical.data())) return false;
  double largest = 0;
  for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, std::abs(chemical[k]));
  if (!(largest * dt < options.negligibleChange)) return false;
  for (std::size_t k = 0; k < n; ++k)
    predicted[k] = start[k] + dt * (chemical[k] + (cell.source.empty() ? 0.0 : cell.source[k]));
  predicted[n] = start[n];
  if (!cell.source.empty()) {
    try {
      predicted[n] = system.thermo().temperatureFromEnthalpy(enthalpy, {predicted.data(), n}, start[n]);
    } catch (const NumericsError&) {
      return false;  // too far for one step; the integrator will tell
    }
  }
  ++result.rhsEvaluations;
  if (!system.chemicalRates(predicted.data(), chemicalEnd.data())) return false;
  for (std::size_t k = 0; k < n; ++k) {
    if (!(std::abs(chemicalEnd[k]) * dt < options.negligibleChange)) return false;
    if (!(0.5 * dt * std::abs(chemicalEnd[k] - chemical[k]) < options.absoluteTolerance)) return false;
  }
  double* out = N_VGetArrayPointer(y.get());
  for (std::size_t k = 0; k < n; ++k) out[k] = predicted[k] + 0.5 * dt * (chemicalEnd[k] - chemical[k]);
  out[n] = predicted[n];
  return accept(cell);
}

bool ConstantPressureReactor::Impl::integratePiece(double dt, double firstStep, int maxSteps, double toleranceFactor,
                                                   double& lastStep, Result& result) {
  using sundials::check;
  void* memory = cvode.get();
  N_VConst(options.absoluteTolerance * toleranceFactor, tolerances.get());
  // A temperature error of the relative tolerance is enough; its absolute part only guards the weights.
  N_VGetArrayPointer(tolerances.get())[n] = options.relativeTolerance * toleranceFactor;
  check(CVodeReInit(memory, 0.0, y.get()), "CVodeReInit");
  check(CVodeSVtolerances(memory, options.relativeTolerance * toleranceFactor, tolerances.get()), "CVodeSVtolerances");
  check(CVodeSetInitStep(memory, std::min(firstStep, dt)), "CVodeSetInitStep");
  check(CVodeSetMaxNumSteps(memory, maxSteps), "CVodeSetMaxNumSteps");
  check(CVodeSetStopTime(memory, dt), "CVodeSetStopTime");
  realtype reached = 0;
  reason.clear();
  system.clearRefusal();
  const int flag = CVode(memory, dt, y.get(), &reached, CV_NORMAL);
  long steps = 0, rhsCalls = 0, jacobians = 0;
  check(CVodeGetNumSteps(memory, &steps), "CVodeGetNumSteps");
  check(CVodeGetNumRhsEvals(memory, &rhsCalls), "CVodeGetNumRhsEvals");
  check(CVodeGetNumJacEvals(memory, &jacobians), "CVodeGetNumJacEvals");
  check(CVodeGetLastStep(memory, &lastStep), "CVodeGetLastStep");
  result.steps += static_cast<int>(steps);
  result.rhsEvaluations += static_cast<int>(rhsCalls);
  result.jacobianEvaluations += static_cast<int>(jacobians);
  return flag >= 0;
}

// The last internal step if the attempt succeeded; the state is then in y.
std::optional<double> ConstantPressureReactor::Impl::integrate(const Cell& cell, double dt, const Attempt& attempt,
                                                               Result& result) {
  system.setConditions(cell.pressure, cell.source);
  std::copy(start.begin(), start.end(), N_VGetArrayPointer(y.get()));
  double lastStep = 0;
  for (int piece = 0; piece < attempt.pieces; ++piece)
    if (!integratePiece(dt / attempt.pieces, attempt.firstStep, options.maxSteps * attempt.stepsFactor,
                        attempt.toleranceFactor, lastStep, result))
      return std::nullopt;
  return lastStep;
}

// Takes y over into the cell: removes the round-off of the sum, recovers the temperature from the constant enthalpy.
bool ConstantPressureReactor::Impl::accept(Cell& cell) {
  double* out = N_VGetArrayPointer(y.get());
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) sum += out[k];
  if (!(std::abs(sum - startSum) < kSumTolerance)) {
    reason = fmt::format("the sum of mass fractions moved by {:.3g}", sum - startSum);
    return false;
  }
  const double scale = startSum / sum;
  for (std::size_t k = 0; k < n; ++k) out[k] *= scale;
  double T = 0;
  try {
    T = system.thermo().temperatureFromEnthalpy(enthalpy, {out, n}, out[n]);
  } catch (const NumericsError& error) {
    reason = error.what();
    return false;
  }
  std::copy_n(out, n, cell.Y.begin());
  cell.temperature = T;
  return true;
}

void ConstantPressureReactor::Impl::giveUp(const Cell& cell, double dt) const {
  std::string composition;
  for (std::size_t k = 0; k < n; ++k)
    if (!(std::abs(cell.Y[k]) <= 1e-6))
      composition += fmt::format("{}{}: {:.6g}", composition.empty() ? "" : ", ", mechanism.speciesName(k), cell.Y[k]);
  throw NumericsError(fmt::format(
      "the chemistry of a cell could not be advanced: T = {:.6g} K, p = {:.6g} Pa, "
      "dt = {:.6g} s, mass fractions {{{}}}; {}",
      cell.temperature, cell.pressure, dt, composition, reason.empty() ? "this is not a state of a gas" : reason));
}

ConstantPressureReactor::ConstantPressureReactor(const Mechanism& mechanism, const Options& options)
    : impl_(std::make_unique<Impl>(mechanism, options)) {}
ConstantPressureReactor::~ConstantPressureReactor() = default;
ConstantPressureReactor::ConstantPressureReactor(ConstantPressureReactor&&) noexcept = default;
ConstantPressureReactor& ConstantPressureReactor::operator=(ConstantPressureReactor&&) noexcept = default;

ConstantPressureReactor::Result ConstantPressureReactor::advance(Cell& cell, double dt) {
  auto& self = *impl_;
  const auto begin = std::chrono::steady_clock::now();
  Result result;
  self.reason.clear();
  self.checkInput(cell, dt);
  std::copy(cell.Y.begin(), cell.Y.end(), self.start.begin());
  self.start[self.n] = cell.temperature;
  self.startSum = 0;
  for (const double value : cell.Y) self.startSum += value;
  self.enthalpy = self.system.thermo().enthalpyMass(cell.temperature, cell.Y);
  const auto finish = [&] {
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
  };
  if (dt == 0) return finish();
  if (self.skip(cell, dt, result)) {
    result.skipped = true;
    return finish();
  }
  const Attempt attempts[] = {{cell.initialStep, 1.0, 1, 1}, {1e-9 * dt, 0.1, 2, 1}, {1e-9 * dt, 0.01, 2, 16}};
  std::string firstReason;
  for (const auto& attempt : attempts) {
    const auto lastStep = self.integrate(cell, dt, attempt, result);
    if (lastStep && self.accept(cell)) {
      cell.initialStep = *lastStep;
      return finish();
    }
    if (firstReason.empty()) firstReason = self.reason;
    ++result.retries;
  }
  self.reason = fmt::format("{} (first attempt: {})", self.reason, firstReason);
  self.giveUp(cell, dt);
}

}  // namespace lampblack
