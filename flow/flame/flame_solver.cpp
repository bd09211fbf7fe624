// The way to a steady flame, stage by stage.
#include "flow/flame/flame_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "flow/flame/flame_scalars.hpp"
#include "flow/flame/flame_solver_data.hpp"

namespace lampblack::flow {

FlameSolver::FlameSolver(MPI_Comm comm, std::shared_ptr<const Mechanism> mechanism, FlameProblem problem,
                         CarriedModel* carried, FlameSolverOptions options)
    : data_(std::make_unique<Data>()) {
  data_->comm = comm;
  data_->mechanism = std::move(mechanism);
  data_->problem = std::move(problem);
  data_->carried = carried;
  data_->options = options;
}
FlameSolver::~FlameSolver() = default;

void FlameSolver::onStage(std::function<void(const FlameStage&, const FlameProfile&)> report) {
  data_->report = std::move(report);
}
void FlameSolver::setExchange(std::optional<GivenExchange> exchange) {
  data_->exchange = std::move(exchange);
}

namespace {

std::string whatMayHelp(const FlameProblem& problem) {
  const bool free = problem.type == FlameType::Free;
  const char* exists = free                                    ? "with this mixture, or is it too lean or too rich"
                       : problem.type == FlameType::Burner     ? "at this mass flux, or does it blow off"
                       : problem.nozzles == FlameNozzles::Plug ? "at these velocities, or are they beyond extinction"
                                                               : "at this strain rate, or is it beyond extinction";
  const char* kinks =
      problem.given ? "a given temperature without kinks and steps of rounding ('temperature_profile.smoothing'), "
                    : "";
  return fmt::format(
      "What may help: {}{}a start from a flame that is like it ('initial'), more points to begin with "
      "('grid.initial_points'), a shorter first time step ('solver.first_time_step'); does the flame "
      "exist {}?",
      kinks, free ? "a guess of its speed ('inlet.velocity'), " : "", exists);
}

}  // namespace

void FlameSolver::Data::fail(const FlameStage& stage) {
  solution.stages.push_back(stage);
  throw FlameFailure(
      fmt::format("the flame did not converge in the stage '{}' ({} points): {}; the residual is largest "
                  "in {}. {}",
                  stage.name, stage.points, stage.newton.reason, stage.newton.worst, whatMayHelp(problem)),
      solution);
}

// The composition at the temperature of the first guess: without radicals a flame would cool before it burns.
void FlameSolver::Data::reactAtFixedTemperature(FlameEquations& equations, NewtonSolver& solver) {
  const std::size_t width = solution.profile.layout.width();
  const bool free = problem.type == FlameType::Free;
  equations.hold(
      [width, free](std::size_t component) {
        return component == FlameLayout::temperature || (free && component == width + leftMassFlux);
      },
      solution.profile.x);
  NewtonReport reacting;
  double dt = 1e-6;
  for (std::size_t attempts = 0; attempts < 12 && dt < 1e-3; ++attempts) {
    const bool ok = solver.timeStep(equations, solution.profile.x, dt, reacting);
    equations.clipNegativeAmounts(solution.profile.x);
    dt *= ok ? 3 : 0.2;
  }
  equations.release();
}

void FlameSolver::Data::inStage(FlameStage& stage, double start, NewtonSolver& solver,
                                const std::function<void()>& work) {
  try {
    work();
  } catch (const Stopped& stop) {
    stage.newton = solver.report();
    stage.newton.converged = false;
    stage.newton.reason = stop.what();
    stage.points = solution.profile.points();
    stage.seconds = MPI_Wtime() - start;
    solution.stages.push_back(stage);
    throw;
  }
}

void FlameSolver::Data::finish(FlameStage& stage, double start) {
  stage.points = solution.profile.points();
  stage.seconds = MPI_Wtime() - start;
  if (!stage.newton.converged) fail(stage);
  solution.stages.push_back(stage);
  if (report) report(stage, solution.profile);
}

void FlameSolver::Data::steady(FlameEquations& equations, NewtonSolver& solver, const std::string& name) {
  const double start = MPI_Wtime();
  FlameStage stage;
  stage.name = name;
  setGridAndAnchor(equations);
  std::size_t failures = 0;
  inStage(stage, start, solver, [&] {
    stage.newton = solver.steady(equations, solution.profile.x, [&] {
      watchFlux();
      if (failures++ > 0)
        moveGridToFlame(equations);
      else if (solution.stages.empty())
        reactAtFixedTemperature(equations, solver);
    });
  });
  finish(stage, start);
}

void FlameSolver::Data::gasAlone(const FlameProblem& flame, NewtonSolver& solver, const std::string& name) {
  const FlameLayout full = solution.profile.layout;
  FlameLayout bare = full;
  bare.scalars = 0;
  solution.profile = withLayout(solution.profile, bare);
  FlameEquations gas(comm, mechanism, flame, nullptr, options.tolerances);
  gas.setExchange(exchange);
  counted(gas, [&] { refine(gas, solver, name); });
  solution.profile = withLayout(solution.profile, full);
}

// Of all points: mass of what is carried over that of the gas.
double FlameSolver::Data::largestLoad() const {
  double largest = 0;
  for (std::size_t i = 0; i < solution.profile.points(); ++i) {
    double load = 0;
    for (std::size_t s = 0; s < solution.profile.layout.scalars; ++s) {
      const CarriedModel::Scalar& scalar = carried->scalars()[s];
      const double unit = std::accumulate(scalar.elements.begin(), scalar.elements.end(), 0.0);
      load += unit * scalar.scale * solution.profile.scalars(i)[s];
    }
    largest = std::max(largest, load);
  }
  return largest;
}

// In a gas that they do not use up, particles may grow to more than the gas ever had: no start for the two together.
void FlameSolver::Data::scalarsAlone(FlameEquations& equations, NewtonSolver& solver) {
  const double start = MPI_Wtime();
  constexpr double mostLoad = 0.5;
  FlameStage stage;
  stage.name = "scalars in the gas";
  setGridAndAnchor(equations);
  FlameScalars scalars(equations, solution.profile);
  std::vector<double> x = scalars.start();
  inStage(stage, start, solver, [&] { stage.newton = solver.steady(scalars, x); });
  const std::vector<double> without = solution.profile.x;
  scalars.put(x, solution.profile);
  if (largestLoad() > mostLoad) {
    solution.profile.x = without;
    stage.name = "scalars in the gas: too many to start from";
  }
  finish(stage, start);
}

void FlameSolver::Data::counted(const FlameEquations& equations, const std::function<void()>& work) {
  try {
    work();
  } catch (...) {
    addCounters(equations);
    throw;
  }
  addCounters(equations);
}

void FlameSolver::Data::addCounters(const FlameEquations& equations) {
  FlameEquations::Counters& sum = solution.counters;
  const FlameEquations::Counters& more = equations.counters();
  sum.residuals += more.residuals;
  sum.jacobians += more.jacobians;
  sum.residualSeconds += more.residualSeconds;
  sum.jacobianSeconds += more.jacobianSeconds;
  sum.factoriseSeconds += more.factoriseSeconds;
  sum.solveSeconds += more.solveSeconds;
  sum.jacobianPoints += more.jacobianPoints;
}

namespace {

constexpr std::size_t mostPasses = 20;
constexpr std::size_t timeStepsOfAttempt = 150;  // of one of several starts; most flames take 10 to 40
constexpr double mostFactorOnFlux = 1e3;

// Of any scalar at any point, over the largest of that scalar.
double largestScalarChange(const FlameProfile& before, const FlameProfile& after) {
  double result = 0;
  for (std::size_t s = 0; s < after.layout.scalars; ++s) {
    double change = 0, largest = 0;
    for (std::size_t i = 0; i < after.points(); ++i) {
      change = std::max(change, std::abs(after.scalars(i)[s] - before.scalars(i)[s]));
      largest = std::max(largest, std::abs(after.scalars(i)[s]));
    }
    if (largest > 0) result = std::max(result, change / largest);
  }
  return result;
}

}  // namespace

FlameSolution FlameSolver::solve(FlameProfile start) {
  return solve(std::vector<FlameProfile>{std::move(start)});
}

FlameSolution FlameSolver::solve(const std::vector<FlameProfile>& starts) {
  Data& d = *data_;
  try {
    d.solveFromOneOf(starts);
  } catch (const Stopped& stop) {
    throw FlameStopped(stop, d.solution);
  } catch (const FlameFailure&) {
    throw;
  } catch (const NumericsError& error) {
    throw FlameFailure(error.what(), d.solution);
  }
  return d.solution;
}

// The last attempt is the first start again, with all the time steps there may be.
void FlameSolver::Data::solveFromOneOf(const std::vector<FlameProfile>& starts) {
  for (std::size_t attempt = 0; attempt <= starts.size(); ++attempt) {
    const bool last = attempt == starts.size() || starts.size() == 1;
    solution = {};
    solution.starts = attempt + 1;
    solution.profile = starts[last ? 0 : attempt];
    transient = options.transient;
    if (!last) transient.maximumSteps = std::min(transient.maximumSteps, timeStepsOfAttempt);
    firstFlux = starts.size() > 1 ? std::optional(solution.profile.global(leftMassFlux)) : std::nullopt;
    try {
      return solve();
    } catch (const NumericsError&) {
      // Once it burns on a first grid, another start leads to the same.
      if (last || (!solution.stages.empty() && solution.stages.front().newton.converged)) throw;
    }
  }
}

void FlameSolver::Data::watchFlux() const {
  if (!firstFlux || !solution.stages.empty()) return;
  const double factor = solution.profile.global(leftMassFlux) / *firstFlux;
  if (factor < 1 / mostFactorOnFlux || factor > mostFactorOnFlux)
    throw NumericsError(
        fmt::format("the free flame is lost: its mass flux has gone from the first guess of {:.3g} to "
                    "{:.3g} kg/m^2/s. {}",
                    *firstFlux, factor * *firstFlux, whatMayHelp(problem)));
}

void FlameSolver::Data::toLastSteps(FlameEquations& equations, NewtonSolver& solver, const std::string& name) {
  refine(equations, solver, name);
  if (options.polish <= 0) return;
  NewtonOptions last = options.newton;
  last.polish = options.polish;
  NewtonSolver polishing(last, options.transient);
  // Again and again where the values of scalars at faces follow the profile: until that does not matter any more.
  for (std::size_t pass = 1;; ++pass) {
    const FlameProfile before = solution.profile;
    steady(equations, polishing, name + ", last steps");
    solution.scalarChange = largestScalarChange(before, solution.profile);
    if (pass == mostPasses || solution.scalarChange <= options.scalarChange) break;
  }
}

void FlameSolver::Data::solve() {
  NewtonSolver solver(options.newton, transient);
  FlameEquations equations(comm, mechanism, problem, carried, options.tolerances);
  equations.setExchange(exchange);
  const FlameLayout layout = equations.layout();
  if (!(layout == solution.profile.layout))
    throw std::logic_error("the start of a flame has other unknowns than its problem");
  anchorIn(solution.profile);

  counted(equations, [&] {
    const bool multicomponent = problem.transport.isMulticomponent();
    if (multicomponent) {
      // Most of the way with coefficients that cost a hundredth.
      FlameProblem averaged = problem;
      averaged.transport.diffusion = TransportModel::Diffusion::MixtureAveraged;
      gasAlone(averaged, solver, "mixture-averaged gas");
    }
    if (layout.scalars > 0 && withoutScalars()) {
      if (!multicomponent) gasAlone(problem, solver, "gas");
      scalarsAlone(equations, solver);
    }
    const std::string name = layout.scalars > 0 ? "gas and scalars" : "flame";
    toLastSteps(equations, solver, name);
    if (options.preferStable) preferStable(equations, solver, name);
  });
  solution.budgets = equations.budgets(solution.profile.x);
  if (problem.type == FlameType::Burner) solution.burnerHeatFlux = equations.burnerHeatFlux(solution.profile.x);
  if (problem.type == FlameType::Wall && equations.layout().scalars > 0)
    solution.deposition = equations.wallDeposition(solution.profile.x);
}

}  // namespace lampblack::flow
