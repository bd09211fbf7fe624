#include "flow/flame/flame_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flow/flame/flame_scalars.hpp"

namespace lampblack {

namespace {

// The profile as the criteria of the grid see it: of what is carried, the sums that decide.
FlameProfile seenByGrid(const FlameProfile& profile, const CarriedModel* carried) {
  if (carried == nullptr || profile.layout.scalars == 0) return profile;
  const auto sums = carried->gridSums();
  if (sums.empty()) return profile;
  FlameLayout layout = profile.layout;
  layout.scalars = 0;
  FlameProfile seen = withLayout(profile, layout);
  layout.scalars = sums.size();
  seen = withLayout(seen, layout);
  for (std::size_t i = 0; i < profile.points(); ++i) {
    const auto values = profile.scalars(i);
    for (std::size_t k = 0; k < sums.size(); ++k) {
      double& sum = seen.at(i, layout.firstScalar() + k);
      for (std::size_t s = 0; s < values.size(); ++s) sum += sums[k][s] * carried->scalars()[s].scale * values[s];
    }
  }
  return seen;
}

}  // namespace

struct FlameSolver::Data {
  MPI_Comm comm;
  std::shared_ptr<const Mechanism> mechanism;
  FlameProblem problem;
  CarriedModel* carried;
  FlameSolverOptions options;
  std::function<void(const FlameStage&, const FlameProfile&)> report;
  std::optional<GivenExchange> exchange;

  FlameSolution solution;  // as far as it has come

  // One stage: the steady flame on the grid of the profile.
  void steady(FlameEquations& equations, NewtonSolver& solver, const std::string& name);
  void fail(const FlameStage& stage);
  // Stages on ever better grids until none is needed.
  void refine(FlameEquations& equations, NewtonSolver& solver, const std::string& name, const GridOptions& grid);
  void place(FlameEquations& equations);
  void follow(FlameEquations& equations);
  void ripen(FlameEquations& equations, NewtonSolver& solver);
  bool widen();
  [[nodiscard]] std::vector<std::size_t> anchorPoint() const;
  void anchorIn(const FlameProfile& profile);
  void gasAlone(const FlameProblem& flame, NewtonSolver& solver, const std::string& name);
  void scalarsAlone(FlameEquations& equations, NewtonSolver& solver);
  void count(const FlameEquations& equations);
  [[nodiscard]] bool withoutScalars() const {
    for (std::size_t i = 0; i < solution.profile.points(); ++i)
      for (double value : solution.profile.scalars(i))
        if (value != 0) return false;
    return true;
  }

  double anchorZ = 0, anchorTemperature = 0;
};

FlameSolver::FlameSolver(MPI_Comm comm, std::shared_ptr<const Mechanism> mechanism, FlameProblem problem,
                         CarriedModel* carried, FlameSolverOptions options)
    : data_(std::make_unique<Data>()) {
  data_->comm = comm;
  data_->mechanism = std::move(mechanism);
  data_->problem = std::move(problem);
  data_->carried = carried;
  data_->options = std::move(options);
}
FlameSolver::~FlameSolver() = default;

void FlameSolver::onStage(std::function<void(const FlameStage&, const FlameProfile&)> report) {
  data_->report = std::move(report);
}
void FlameSolver::setExchange(std::optional<GivenExchange> exchange) {
  data_->exchange = std::move(exchange);
}

void FlameSolver::Data::fail(const FlameStage& stage) {
  solution.stages.push_back(stage);
  throw FlameFailure(
      fmt::format("the flame did not converge in the stage '{}' ({} points): {}; the residual is largest in {}. "
                  "What may help: a start from a flame that is like it ('initial'), more points to begin with "
                  "('grid.initial_points'), a shorter first time step ('solver.first_time_step'); does the flame exist "
                  "at this strain or mass flux?",
                  stage.name, stage.points, stage.newton.reason, stage.newton.worst),
      solution);
}

void FlameSolver::Data::anchorIn(const FlameProfile& profile) {
  if (problem.type != FlameType::Free) return;
  const std::size_t last = profile.points() - 1;
  double hottest = profile.temperature(0);
  for (std::size_t i = 0; i <= last; ++i) hottest = std::max(hottest, profile.temperature(i));
  anchorTemperature = options.anchorTemperature > 0 ? options.anchorTemperature
                                                    : profile.temperature(0) + 0.4 * (hottest - profile.temperature(0));
  std::size_t best = 1;
  while (best < last && profile.temperature(best) < anchorTemperature) ++best;
  anchorZ = profile.z[best];
  anchorTemperature = profile.temperature(best);
}

std::vector<std::size_t> FlameSolver::Data::anchorPoint() const {
  std::vector<std::size_t> keep;
  if (problem.type == FlameType::Free)
    for (std::size_t i = 0; i < solution.profile.points(); ++i)
      if (solution.profile.z[i] == anchorZ) keep.push_back(i);
  return keep;
}

void FlameSolver::Data::place(FlameEquations& equations) {
  const FlameProfile& p = solution.profile;
  equations.setGrid(p.z);
  if (problem.type != FlameType::Free) return;
  const auto at = std::min_element(p.z.begin(), p.z.end(),
                                   [&](double a, double b) { return std::abs(a - anchorZ) < std::abs(b - anchorZ); });
  equations.setAnchor(static_cast<std::size_t>(at - p.z.begin()), anchorTemperature);
}

// Points where the flame has gone to: a front in coarse cells moves from one to the next by ignitions, each of which
// takes many small time steps.
void FlameSolver::Data::follow(FlameEquations& equations) {
  if (!options.refine) return;
  GridOptions coarse = options.grid;
  coarse.slope = std::max(coarse.slope, 0.2);
  coarse.curve = std::max(coarse.curve, 0.3);
  coarse.prune = std::max(coarse.prune, 0.02);
  const std::size_t width = solution.profile.layout.width();
  const auto active = std::make_unique<bool[]>(width);
  std::fill(active.get(), active.get() + width, true);
  active[FlameLayout::massFlux] = false;
  try {
    const GridChange change = refineGrid(solution.profile, coarse, {active.get(), width}, anchorPoint());
    if (!change.changed()) return;
    solution.profile = onGrid(solution.profile, change.z);
  } catch (const NumericsError&) {
    return;  // no more points are allowed: on with these
  }
  place(equations);
}

// The composition at the temperature of the first guess: without radicals a flame would cool before it burns.
void FlameSolver::Data::ripen(FlameEquations& equations, NewtonSolver& solver) {
  const std::size_t width = solution.profile.layout.width();
  const bool free = problem.type == FlameType::Free;
  equations.hold(
      [width, free](std::size_t component) {
        return component == FlameLayout::temperature || (free && component == width + leftMassFlux);
      },
      solution.profile.x);
  NewtonReport ripening;
  double dt = 1e-6;
  for (std::size_t attempts = 0; attempts < 12 && dt < 1e-3; ++attempts) {
    const bool ok = solver.timeStep(equations, solution.profile.x, dt, ripening);
    equations.settle(solution.profile.x);
    dt *= ok ? 3 : 0.2;
  }
  equations.release();
}

void FlameSolver::Data::steady(FlameEquations& equations, NewtonSolver& solver, const std::string& name) {
  const double start = MPI_Wtime();
  FlameStage stage{name, solution.profile.points(), {}, 0};
  place(equations);
  std::size_t failures = 0;
  stage.newton = solver.steady(equations, solution.profile.x, [&] {
    if (failures++ > 0)
      follow(equations);
    else if (solution.stages.empty())
      ripen(equations, solver);
  });
  stage.points = solution.profile.points();
  stage.seconds = MPI_Wtime() - start;
  if (!stage.newton.converged) fail(stage);
  solution.stages.push_back(stage);
  if (report) report(stage, solution.profile);
}

bool FlameSolver::Data::widen() {
  if (problem.type != FlameType::Free) return false;
  const FlameProfile& p = solution.profile;
  const std::size_t last = p.points() - 1;
  double steepest = 0;
  for (std::size_t i = 0; i < last; ++i)
    steepest = std::max(steepest, std::abs(p.temperature(i + 1) - p.temperature(i)) / (p.z[i + 1] - p.z[i]));
  const auto slope = [&](std::size_t i) {
    return std::abs(p.temperature(i + 1) - p.temperature(i)) / (p.z[i + 1] - p.z[i]) / steepest;
  };
  const double length = p.z.back() - p.z.front();
  const double left = slope(0) > 1e-3 ? 0.5 * length : 0, right = slope(last - 1) > 1e-3 ? 0.5 * length : 0;
  if (left == 0 && right == 0) return false;
  if (length > 1000 * problem.length) return false;
  solution.profile = widened(p, left, right);
  anchorZ += left;
  return true;
}

void FlameSolver::Data::refine(FlameEquations& equations, NewtonSolver& solver, const std::string& name,
                               const GridOptions& grid) {
  for (std::size_t pass = 0;; ++pass) {
    steady(equations, solver, pass == 0 ? name : fmt::format("{}, grid {}", name, pass + 1));
    if (!options.refine) return;
    if (widen()) continue;
    const std::vector<std::size_t> keep = anchorPoint();
    const auto giveUp = [&](const std::string& reason) {
      FlameStage stage = solution.stages.back();
      stage.newton.reason = reason;
      solution.stages.pop_back();
      fail(stage);
    };
    const FlameProfile seen = seenByGrid(solution.profile, carried);
    const std::size_t width = seen.layout.width();
    const auto active = std::make_unique<bool[]>(width);
    std::fill(active.get(), active.get() + width, true);
    active[FlameLayout::massFlux] = false;
    GridChange change;
    try {
      change = refineGrid(seen, grid, {active.get(), width}, keep);
    } catch (const NumericsError& error) {
      giveUp(error.what());
    }
    if (!change.changed()) return;
    if (pass + 1 == options.maximumGrids)
      giveUp(fmt::format("the grid still changes after {} refinements", options.maximumGrids));
    solution.profile = onGrid(solution.profile, change.z);
  }
}

void FlameSolver::Data::gasAlone(const FlameProblem& flame, NewtonSolver& solver, const std::string& name) {
  const FlameLayout full = solution.profile.layout;
  FlameLayout bare = full;
  bare.scalars = 0;
  solution.profile = withLayout(solution.profile, bare);
  FlameEquations gas(comm, mechanism, flame, nullptr, options.tolerances);
  gas.setExchange(exchange);
  refine(gas, solver, name, options.grid);
  count(gas);
  solution.profile = withLayout(solution.profile, full);
}

void FlameSolver::Data::scalarsAlone(FlameEquations& equations, NewtonSolver& solver) {
  const double start = MPI_Wtime();
  FlameStage stage{"scalars in the gas", solution.profile.points(), {}, 0};
  place(equations);
  FlameScalars scalars(equations, solution.profile);
  std::vector<double> x = scalars.start();
  stage.newton = solver.steady(scalars, x);
  scalars.put(x, solution.profile);
  stage.seconds = MPI_Wtime() - start;
  if (!stage.newton.converged) fail(stage);
  solution.stages.push_back(stage);
  if (report) report(stage, solution.profile);
}

void FlameSolver::Data::count(const FlameEquations& equations) {
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
  Data& d = *data_;
  d.solution = {};
  d.solution.profile = std::move(start);
  NewtonSolver solver(d.options.newton, d.options.transient);
  FlameEquations equations(d.comm, d.mechanism, d.problem, d.carried, d.options.tolerances);
  equations.setExchange(d.exchange);
  const FlameLayout layout = equations.layout();
  if (!(layout == d.solution.profile.layout))
    throw std::logic_error("the start of a flame has other unknowns than its problem");
  d.anchorIn(d.solution.profile);

  const bool multicomponent = d.problem.transport.model == FlameTransport::Model::Multicomponent;
  if (multicomponent) {
    // Most of the way with coefficients that cost a hundredth.
    FlameProblem averaged = d.problem;
    averaged.transport.model = FlameTransport::Model::MixtureAveraged;
    d.gasAlone(averaged, solver, "mixture-averaged gas");
  }
  if (layout.scalars > 0 && d.withoutScalars()) {
    if (!multicomponent) d.gasAlone(d.problem, solver, "gas");
    d.scalarsAlone(equations, solver);
  }
  const std::string name = layout.scalars > 0 ? "gas and scalars" : "flame";
  d.refine(equations, solver, name, d.options.grid);
  if (d.options.polish > 0) {
    NewtonOptions last = d.options.newton;
    last.polish = d.options.polish;
    NewtonSolver polishing(last, d.options.transient);
    // Again and again where the values of scalars at faces follow the profile: until that does not matter any more.
    for (std::size_t pass = 1;; ++pass) {
      const FlameProfile before = d.solution.profile;
      d.steady(equations, polishing, name + ", last steps");
      if (pass == mostPasses || largestScalarChange(before, d.solution.profile) <= d.options.scalarChange) break;
    }
  }
  d.count(equations);
  d.solution.budgets = equations.budgets(d.solution.profile.x);
  return d.solution;
}

}  // namespace lampblack
