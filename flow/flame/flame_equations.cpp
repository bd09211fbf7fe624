// FlameEquations: the problem, its grid, and the systems that Newton's method and the integration in time solve.
#include "flow/flame/flame_equations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "flow/flame/flame_equations_data.hpp"
#include "flow/flame/flame_jacobian.hpp"

namespace lampblack::flow {
namespace {

double streamDensity(const Mechanism& mechanism, double pressure, const FlameStream& stream) {
  double moles = 0;
  for (std::size_t k = 0; k < stream.Y.size(); ++k) moles += stream.Y[k] / mechanism.molecularWeights()[k];
  return pressure / (constants::gasConstant * stream.temperature * moles);
}

void check(const Mechanism& mechanism, const FlameProblem& problem) {
  const auto stream = [&](const FlameStream& s, const char* name) {
    if (s.Y.size() != mechanism.numSpecies())
      throw InputError(fmt::format("the {} stream of the flame has {} mass fractions, the mechanism {} species", name,
                                   s.Y.size(), mechanism.numSpecies()));
    if (!(s.temperature > 0)) throw InputError(fmt::format("the {} stream of the flame needs a temperature", name));
  };
  stream(problem.left, "left");
  if ((problem.type == FlameType::Counterflow) != problem.right.has_value())
    throw InputError("a counterflow flame has two streams, every other flame one");
  if (problem.right) stream(*problem.right, "right");
  if (!(problem.pressure > 0) || !(problem.length > 0))
    throw InputError("a flame needs a pressure and a length above zero");
  const bool spreads = problem.type == FlameType::Counterflow || problem.type == FlameType::Wall;
  if (spreads && problem.nozzles == FlameNozzles::Potential && !(problem.strainRate > 0))
    throw InputError("a flame in a potential flow needs a strain rate above zero");
  if (problem.type != FlameType::Free && problem.nozzles == FlameNozzles::Plug && !(problem.left.massFlux > 0))
    throw InputError("the left stream of the flame needs a velocity or mass flux above zero");
  if (problem.type == FlameType::Counterflow && problem.nozzles == FlameNozzles::Plug && !(problem.right->massFlux > 0))
    throw InputError("the right stream of the flame needs a velocity or mass flux above zero");
  if (problem.given && problem.type == FlameType::Free)
    throw InputError("a freely propagating flame has no given temperature: its speed follows from the energy equation");
}

}  // namespace

double GivenTemperature::at(double place) const {
  const auto above = static_cast<std::size_t>(std::upper_bound(z.begin(), z.end(), place) - z.begin());
  if (above == 0) return T.front();
  if (above == z.size()) return T.back();
  const double share = (place - z[above - 1]) / (z[above] - z[above - 1]);
  return T[above - 1] + share * (T[above] - T[above - 1]);
}

GivenTemperature GivenTemperature::smoothed(double width, double length) const {
  constexpr int samples = 50;                                  // on either side of a mean
  constexpr double perWidth = 20, fewest = 200, most = 20000;  // points of the result
  const auto extended = [&](double place) {
    if (place < 0) return 2 * at(0) - at(-place);
    return place > length ? 2 * at(length) - at(2 * length - place) : at(place);
  };
  const double intervals = std::clamp(std::ceil(perWidth * length / width), fewest, most);
  GivenTemperature result;
  for (double i = 0; i <= intervals; ++i) {
    const double place = length * i / intervals;
    double sum = 0, weights = 0;
    for (int s = -samples; s <= samples; ++s) {
      const double weight = 1.0 - std::abs(s) / (samples + 1.0);
      sum += weight * extended(place + width * s / (samples + 1.0));
      weights += weight;
    }
    result.z.push_back(place);
    result.T.push_back(sum / weights);
  }
  return result;
}

FlameEquations::Data::Data(MPI_Comm communicator, std::shared_ptr<const Mechanism> gasMechanism, FlameProblem flame,
                           CarriedModel* carriedModel, FlameTolerances sizes)
    : comm(communicator),
      mechanism(std::move(gasMechanism)),
      problem((check(*mechanism, flame), std::move(flame))),
      carried(carriedModel),
      tolerances(sizes),
      layout{mechanism->numSpecies(), carriedModel != nullptr ? carriedModel->scalars().size() : 0},
      gas(*mechanism, problem, carriedModel),
      kinetics(*mechanism) {
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  spreading = problem.type == FlameType::Counterflow || problem.type == FlameType::Wall;
  if (problem.type == FlameType::Counterflow) rightEnd = FlameEnd::Stream;
  if (problem.type == FlameType::Wall) rightEnd = FlameEnd::Wall;
  leftDensity = streamDensity(*mechanism, problem.pressure, problem.left);
  rightDensity = problem.right ? streamDensity(*mechanism, problem.pressure, *problem.right) : leftDensity;
  profile.layout = layout;
}

void FlameEquations::Data::evaluate(std::size_t first, std::size_t last) {
  if (first >= last) return;
  const std::size_t n = points();
  gas.composition(profile, first > 0 ? first - 1 : 0, std::min(last + 1, n));
  gas.fluxes(profile, first > 0 ? first - 1 : 0, std::min(last, n - 1));
  gas.sources(profile, first, last, exchange ? &*exchange : nullptr);
}

// Every rank for all faces: seldom, and the same everywhere.
void FlameEquations::Data::chooseBlend() {
  if (blendIsChosen) return;
  gas.chooseBlend(profile);
  blendIsChosen = true;
}

FlameEquations::FlameEquations(MPI_Comm comm, std::shared_ptr<const Mechanism> mechanism, FlameProblem problem,
                               CarriedModel* carried, FlameTolerances tolerances)
    : data_(std::make_unique<Data>(comm, std::move(mechanism), std::move(problem), carried, tolerances)) {}
FlameEquations::~FlameEquations() = default;

const FlameProblem& FlameEquations::problem() const {
  return data_->problem;
}
const FlameLayout& FlameEquations::layout() const {
  return data_->layout;
}
std::span<const double> FlameEquations::grid() const {
  return data_->profile.z;
}
std::size_t FlameEquations::size() const {
  return data_->unknowns();
}
const FlameEquations::Counters& FlameEquations::counters() const {
  return data_->counters;
}

void FlameEquations::setGrid(std::span<const double> z) {
  Data& d = *data_;
  if (z.size() < 3) throw std::logic_error("the grid of a flame has at least three points");
  const std::size_t n = z.size();
  d.profile.z.assign(z.begin(), z.end());
  d.profile.x.assign(d.profile.size(), 0.0);
  d.volume.resize(n);
  for (std::size_t i = 0; i < n; ++i) d.volume[i] = 0.5 * ((i + 1 < n ? z[i + 1] : z[i]) - (i > 0 ? z[i - 1] : z[i]));
  if (d.problem.given) {
    d.given.resize(n);
    for (std::size_t i = 0; i < n; ++i) d.given[i] = d.problem.given->at(z[i]);
  }
  d.gas.resize(n);
  d.blendIsChosen = false;
  const auto startOf = [&](int r) { return n * static_cast<std::size_t>(r) / static_cast<std::size_t>(d.ranks); };
  d.begin = startOf(d.rank);
  d.end = startOf(d.rank + 1);
  d.counts.resize(d.ranks);
  d.displacements.resize(d.ranks);
  for (int r = 0; r < d.ranks; ++r) {
    d.displacements[r] = static_cast<int>(startOf(r) * d.width());
    d.counts[r] = static_cast<int>((startOf(r + 1) - startOf(r)) * d.width());
  }
  d.steadyFactors = false;
  d.matrix.reset();  // the largest there is: not twice
  d.matrix = std::make_unique<BlockTridiagonal>(
      d.comm, n, d.width(), numFlameGlobals,
      d.gas.multicomponent() ? NeighbourTerms() : NeighbourTerms(numFlameNeighbourTerms));
  d.anchor = std::min(d.anchor, n - 1);
}

void FlameEquations::setAnchor(std::size_t point, double temperature) {
  data_->anchor = point;
  data_->anchorTemperature = temperature;
}

void FlameEquations::hold(std::function<bool(std::size_t)> which, std::span<const double> held) {
  data_->holds = std::move(which);
  data_->held.assign(held.begin(), held.end());
}
void FlameEquations::release() {
  data_->holds = nullptr;
}
void FlameEquations::beginStep() {
  data_->blendIsChosen = false;
}
void FlameEquations::freezeTransport(bool frozen) {
  data_->gas.frozen = frozen;
}
void FlameEquations::setLoad(double load) {
  data_->loadValue = load;
}
void FlameEquations::setConstraint(std::optional<LoadConstraint> constraint) {
  data_->constraint = std::move(constraint);
}
void FlameEquations::setExchange(std::optional<GivenExchange> exchange) {
  data_->exchange = std::move(exchange);
}

void FlameEquations::Data::endIfAsked() const {
  if (const int signal = agreedStopRequest(comm); signal != 0) raiseStopped(comm, signal, "in the solution of a flame");
}

void FlameEquations::residual(std::span<const double> x, std::span<double> F) {
  Data& d = *data_;
  const double start = MPI_Wtime();
  d.endIfAsked();  // here, where all ranks pass together and which costs far more than asking
  d.setUnknowns(x);
  const auto work = [&] {
    d.chooseBlend();
    d.evaluate(d.begin, d.end);
    for (std::size_t i = d.begin; i < d.end; ++i) d.pointResidual(i, &F[i * d.width()]);
  };
  if (d.ranks == 1) {
    work();
  } else {
    collectively(d.comm, work);
    MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, F.data(), d.counts.data(), d.displacements.data(), MPI_DOUBLE,
                   d.comm);
  }
  d.globalResidual(&F[d.points() * d.width()]);
  ++d.counters.residuals;
  d.counters.residualSeconds += MPI_Wtime() - start;
}

void FlameEquations::timeWeights(std::span<const double> x, std::span<double> M) {
  Data& d = *data_;
  d.setUnknowns(x);
  d.gas.composition(d.profile, 0, d.points());
  d.gas.heatCapacities(d.profile);
  for (std::size_t i = 0; i < d.points(); ++i) d.pointTimeWeights(i, &M[i * d.width()]);
  std::fill(M.end() - numFlameGlobals, M.end(), 0.0);
}

bool FlameEquations::factorise(std::span<const double> x, double inverseTimeStep) {
  Data& d = *data_;
  const double start = MPI_Wtime();
  d.setUnknowns(x);
  d.steadyFactors = false;
  const auto work = [&] {
    const std::size_t begin = d.matrix->ownedBegin(), end = d.matrix->ownedEnd();
    d.matrix->clear();
    d.chooseBlend();
    d.evaluate(begin, end);
    Data::JacobianWork buffers(d);
    for (std::size_t i = begin; i < end; ++i) d.fillRow(i, inverseTimeStep, buffers);
    d.fillGlobals();
  };
  if (d.ranks == 1)
    work();
  else
    collectively(d.comm, work);
  ++d.counters.jacobians;
  d.counters.jacobianPoints += d.points();
  const double filled = MPI_Wtime();
  d.counters.jacobianSeconds += filled - start;
  const bool regular = d.matrix->factorise();
  d.steadyFactors = regular && inverseTimeStep == 0 && !d.holds;
  d.counters.factoriseSeconds += MPI_Wtime() - filled;
  return regular;
}

void FlameEquations::solve(std::span<double> b) {
  const double start = MPI_Wtime();
  data_->matrix->solve(b);
  data_->counters.solveSeconds += MPI_Wtime() - start;
}

bool FlameEquations::hasSteadyFactors() const {
  return data_->steadyFactors;
}

int FlameEquations::determinantSign() const {
  return data_->matrix->determinantSign();
}

bool FlameEquations::factoriseUnsteady(std::span<const double> x, double shift) {
  struct Reset {
    bool& flag;
    ~Reset() { flag = false; }
  } const reset{data_->unsteady};
  data_->unsteady = true;
  return factorise(x, shift);
}

void FlameEquations::storage(std::span<const double> x, std::span<const double> rate, std::span<double> F) {
  Data& d = *data_;
  d.setUnknowns(x);
  d.gas.composition(d.profile, 0, d.points());
  for (std::size_t i = 0; i < d.points(); ++i) {
    const double* dot = &rate[i * d.width()];
    double change = -dot[FlameLayout::temperature] / d.profile.temperature(i);
    for (std::size_t k = 0; k < d.species(); ++k)
      change -= dot[FlameLayout::firstSpecies + k] * d.gas.nodes.weight[i] / d.gas.weights[k];
    F[i * d.width() + FlameLayout::massFlux] += d.volume[i] * d.gas.nodes.density[i] * change;
  }
}

}  // namespace lampblack::flow
