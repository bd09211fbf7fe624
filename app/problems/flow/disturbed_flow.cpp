#include "app/problems/flow/disturbed_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace lampblack::app {
namespace {

constexpr int sweeps = 2;
// What a run has kept of earlier steps is forgotten after so many steps of the last length.
constexpr int settlingSteps = 20;
// The least that is a large change: of the largest temperature; a mass fraction; of the largest range of carried
// scalars of one unit.
constexpr double leastOfTemperature = 1e-2, leastFraction = 1e-6, leastOfCarried = 1e-3;
// Of these, the first disturbance.
constexpr double first = 1e-3;

const std::set<std::string>& unknowns() {
  static const std::set<std::string> names{"temperature",
                                           "density",
                                           "velocity",
                                           "pressure",
                                           "swirl",
                                           "enthalpy",
                                           "Y",
                                           "carried",
                                           "mass_flux",
                                           "reaction_rates",
                                           "face_velocity_deviation",
                                           "expansion_correction",
                                           "expansion_gained",
                                           "thermodynamic_pressure"};
  return names;
}

FlowCase ofTwoSweeps(FlowCase flowCase) {
  flowCase.flow.sweeps = sweeps;
  return flowCase;
}

void saveOrLoad(FlowDomain& domain, StateArchive& archive) {
  domain.state.saveOrLoad(archive);
  for (Operator* op : domain.operators) op->saveOrLoad(archive);
}

// Waves over the box around the domain, of different lengths and phases for each of what is disturbed.
double wave(const Vector3& place, const Vector3& low, const Vector3& high, int number) {
  double phase = 0.7 + 1.9 * number;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const double length = high[axis] - low[axis]; length > 0.0)
      phase += std::numbers::pi * (1.3 + 0.37 * number + 0.61 * static_cast<double>(axis)) * (place[axis] - low[axis]) /
               length;
  return std::cos(phase);
}

}  // namespace

// Goes over those pieces that are unknowns and leaves all others as they are.
class DisturbedFlow::Unknowns : public StateArchive {
 public:
  Unknowns(const Mesh& mesh, bool loading, const Take& take) : mesh_(mesh), loading_(loading), take_(take) {}
  [[nodiscard]] bool loading() const override { return loading_; }
  void cells(const std::string& name, std::vector<double>& values, int width) override {
    give(name, values, static_cast<std::size_t>(mesh_.owned), width, true);
  }
  void faces(const std::string& name, std::vector<double>& values, int width) override {
    give(name, values, static_cast<std::size_t>(mesh_.faces), width, false);
  }
  void rows(const std::string&, std::vector<std::vector<double>>&) override {}
  void sums(const std::string&, std::span<double>) override {}
  void shared(const std::string& name, std::vector<double>& values) override {
    if (unknowns().contains(name)) take_(name, values, 1, false);
  }

 private:
  void give(const std::string& name, std::vector<double>& values, std::size_t count, int width, bool ofCells) {
    if (unknowns().contains(name))
      take_(name, {values.data(), count * static_cast<std::size_t>(width)}, width, ofCells);
  }

  const Mesh& mesh_;
  bool loading_;
  const Take& take_;
};

DisturbedFlow::DisturbedFlow(FlowDomain& found, const FlowCase& flowCase, const Thermo& thermo, Transport& transport,
                             double time, double slow)
    : case_(ofTwoSweeps(flowCase)),
      domain_(found.mesh, case_, thermo, transport, case_.chemistry),
      base_(found.mesh.owned, found.mesh.faces),
      time_(time),
      slow_(slow) {
  base_.save([&](StateArchive& archive) { saveOrLoad(found, archive); });
  base_.restore([&](StateArchive& archive) { saveOrLoad(domain_, archive); });
  begin();
  settle();
  base_.save([&](StateArchive& archive) { saveOrLoad(domain_, archive); });
}

void DisturbedFlow::begin() {
  domain_.state.updateHalo(domain_.halo);
  for (Operator* op : domain_.operators) op->endStep(domain_.state);
  for (Operator* op : domain_.operators) op->endSweep(domain_.state);
}

void DisturbedFlow::advance(double dt) {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (Operator* op : domain_.operators) op->advance(domain_.state, 0.0, dt);
    if (sweep + 1 < sweeps)
      for (Operator* op : domain_.operators) op->endSweep(domain_.state);
  }
  for (Operator* op : domain_.operators) op->endStep(domain_.state);
  for (Operator* op : domain_.operators) op->endSweep(domain_.state);
}

void DisturbedFlow::settle() {
  const auto largest = [&] {
    double dt = std::min(case_.time.maximumStep, time_);
    for (Operator* op : domain_.operators) dt = std::min(dt, op->largestStep(domain_.state));
    return dt;
  };
  for (double dt = case_.time.firstStep; dt < largest(); dt *= case_.time.growth) advance(dt);
  steps_ = static_cast<int>(std::ceil(time_ / largest()));
  dt_ = time_ / steps_;
  for (int step = 0; step < settlingSteps; ++step) advance(dt_);
}

void DisturbedFlow::forEachUnknown(bool loading, const Take& take) {
  Unknowns archive(domain_.mesh, loading, take);
  saveOrLoad(domain_, archive);
}

std::vector<double> DisturbedFlow::gathered() {
  std::vector<double> all;
  forEachUnknown(false, [&](const std::string&, std::span<double> values, int, bool) {
    all.insert(all.end(), values.begin(), values.end());
  });
  return all;
}

void DisturbedFlow::march(std::vector<double>& values) {
  base_.restore([&](StateArchive& archive) { saveOrLoad(domain_, archive); });
  auto from = values.cbegin();
  forEachUnknown(true, [&](const std::string&, std::span<double> to, int, bool) {
    std::copy_n(from, to.size(), to.begin());
    from += static_cast<std::ptrdiff_t>(to.size());
  });
  begin();
  for (int step = 0; step < steps_; ++step) advance(dt_);
  values = gathered();
}

std::vector<double> DisturbedFlow::rangesOf(const std::string& name, std::span<const double> values, int width) const {
  const auto components = static_cast<std::size_t>(width);
  std::vector<double> ends(2 * components, -1e300);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t component = i % components;
    ends[component] = std::max(ends[component], values[i]);
    ends[components + component] = std::max(ends[components + component], -values[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, ends.data(), static_cast<int>(ends.size()), MPI_DOUBLE, MPI_MAX, domain_.mesh.comm);
  std::vector<double> ranges(components, 0.0);
  for (std::size_t i = 0; i < components; ++i) ranges[i] = ends[i] + ends[components + i];
  const double most = std::ranges::max(ranges);
  if (name == "temperature") ranges[0] = std::max(ranges[0], leastOfTemperature * ends[0]);
  if (name == "velocity" || name == "swirl") std::ranges::fill(ranges, std::max(most, slow_));
  if (name == "Y")
    for (double& range : ranges) range = std::max(range, leastFraction);
  if (name == "carried") {
    const std::vector<CarriedScalar>& scalars = domain_.state.scalars;
    std::vector<double> least(components, 0.0);
    for (std::size_t i = 0; i < components; ++i)
      for (std::size_t j = 0; j < components; ++j)
        if (scalars[i].unit == scalars[j].unit) least[i] = std::max(least[i], leastOfCarried * ranges[j]);
    for (std::size_t i = 0; i < components; ++i) ranges[i] = std::max(ranges[i], least[i]);
  }
  return ranges;
}

MarchedFlow DisturbedFlow::marched() {
  const Mesh& m = domain_.mesh;
  MarchedFlow flow{[this](std::vector<double>& values) { march(values); }, time_, {}, {}, {}};
  base_.restore([&](StateArchive& archive) { saveOrLoad(domain_, archive); });
  double volume = 0.0;
  for (int c = 0; c < m.owned; ++c) volume += m.volume[c];
  MPI_Allreduce(MPI_IN_PLACE, &volume, 1, MPI_DOUBLE, MPI_SUM, m.comm);
  static const std::set<std::string> ofTheirOwn{"temperature", "velocity", "swirl", "Y", "carried"};
  forEachUnknown(false, [&](const std::string& name, std::span<double> values, int width, bool ofCells) {
    flow.state.insert(flow.state.end(), values.begin(), values.end());
    const bool counts = ofCells && ofTheirOwn.contains(name);
    const std::vector<double> ranges = counts ? rangesOf(name, values, width) : std::vector<double>();
    const auto components = static_cast<std::size_t>(width);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double range = counts ? ranges[i % components] : 0.0;
      flow.scales.push_back(range > 0.0 ? 1.0 / range : 0.0);
      flow.shares.push_back(counts ? m.volume[i / components] / volume : 0.0);
    }
  });
  return flow;
}

std::vector<double> DisturbedFlow::start() {
  const Mesh& m = domain_.mesh;
  State& state = domain_.state;
  base_.restore([&](StateArchive& archive) { saveOrLoad(domain_, archive); });
  std::vector<double> before = gathered();

  const auto n = static_cast<std::size_t>(state.species), d = static_cast<std::size_t>(state.dimension);
  const auto owned = static_cast<std::size_t>(m.owned);
  const double warmer = rangesOf("temperature", {state.temperature.data(), owned}, 1)[0];
  const double faster = rangesOf("velocity", {state.velocity.data(), owned * d}, static_cast<int>(d))[0];
  std::vector<double> mean(n + 1, 0.0);
  std::array<double, 6> ends{};
  ends.fill(-1e300);
  for (std::size_t c = 0; c < owned; ++c) {
    const double mass = state.density[c] * m.volume[c];
    for (std::size_t k = 0; k < n; ++k) mean[k] += mass * state.Y[c * n + k];
    mean[n] += mass;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ends[axis] = std::max(ends[axis], m.centre[c][axis]);
      ends[3 + axis] = std::max(ends[3 + axis], -m.centre[c][axis]);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, mean.data(), static_cast<int>(n + 1), MPI_DOUBLE, MPI_SUM, m.comm);
  MPI_Allreduce(MPI_IN_PLACE, ends.data(), 6, MPI_DOUBLE, MPI_MAX, m.comm);
  const Vector3 high{ends[0], ends[1], ends[2]}, low{-ends[3], -ends[4], -ends[5]};
  for (std::size_t c = 0; c < owned; ++c) {
    const std::span<double> Y{&state.Y[c * n], n};
    const double share = 0.5 * first * (1.0 + wave(m.centre[c], low, high, 0));
    for (std::size_t k = 0; k < n; ++k) Y[k] += share * (mean[k] / mean[n] - Y[k]);
    state.temperature[c] += first * warmer * wave(m.centre[c], low, high, 1);
    state.density[c] = domain_.context.thermo.density(state.temperature[c], state.thermodynamicPressure, Y);
    state.enthalpy[c] = domain_.context.thermo.enthalpyMass(state.temperature[c], Y);
    for (std::size_t axis = 0; axis < d; ++axis)
      state.velocity[c * d + axis] += first * faster * wave(m.centre[c], low, high, 2 + static_cast<int>(axis));
    if (state.swirls) state.swirl[c] += first * faster * wave(m.centre[c], low, high, 5) * m.centre[c][0] / high[0];
  }
  std::vector<double> disturbance = gathered();
  for (std::size_t i = 0; i < disturbance.size(); ++i) disturbance[i] -= before[i];
  return disturbance;
}

}  // namespace lampblack::app
