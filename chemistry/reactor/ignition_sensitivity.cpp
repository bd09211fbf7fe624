#include "chemistry/reactor/ignition_sensitivity.hpp"

#include <algorithm>
#include <array>

namespace lampblack::chemistry {

namespace {

// Of the points around tau: small against the width of the maximum, for the formulas are of fourth order, and large
// against the errors of the integration.
constexpr double kSpacing = 0.05;

// A point of time at which the quantity of a criterion and its sensitivities are wanted.
struct Sample {
  double time = 0;
  std::size_t criterion = 0;
  int position = 0;  // -2..2 spacings from tau
};

// What is known around one tau. Of the largest dT/dt or dp/dt: that rate and its derivatives by the parameters at five
// points. Of the others, at tau alone: the derivatives by the parameters and by time of what is zero there.
struct Stencil {
  double spacing = 0;
  std::array<double, 5> value{};
  std::array<std::vector<double>, 5> byParameter;
  double byTime = 0;
};

double spacingOf(const IgnitionEvent& event) {
  return kSpacing * std::min(event.width, event.time);
}

// d tau/dp of the largest a: -(d a'/dp)/a'' by five-point formulas.
double byMaximum(const Stencil& s, std::size_t p) {
  const auto& d = s.byParameter;
  const double slopeByParameter = (d[0][p] - 8 * d[1][p] + 8 * d[3][p] - d[4][p]) / (12 * s.spacing);
  const auto& a = s.value;
  const double second = (-a[0] + 16 * a[1] - 30 * a[2] + 16 * a[3] - a[4]) / (12 * s.spacing * s.spacing);
  return -slopeByParameter / second;
}

class Sampler {
 public:
  Sampler(const Mechanism& mechanism, ClosedReactor& reactor, const std::vector<IgnitionCriterion>& criteria)
      : reactor_(reactor),
        criteria_(criteria),
        quantity_(mechanism, reactor),
        stencils_(criteria.size()),
        y_(reactor.size()),
        f_(reactor.size()),
        sDot_(reactor.size()),
        J_(reactor.size() * reactor.size()) {}

  void take(const StiffIntegrator& integrator, const Sample& sample) {
    const IgnitionCriterion& criterion = criteria_[sample.criterion];
    Stencil& stencil = stencils_[sample.criterion];
    const auto at = static_cast<std::size_t>(sample.position + 2);
    const double* y = y_.data();
    integrator.interpolate(sample.time, y_);
    integrator.interpolateSensitivities(sample.time, s_);
    quantity_.prepare(sample.time, y, true);
    reactor_.jacobian(sample.time, y, f_.data(), J_.data(), reactor_.size());
    reactor_.prepareParameters(sample.time, y);
    stencil.value[at] = quantity_.of(criterion, y).value;
    timesJacobian(f_);
    stencil.byTime = quantity_.change(criterion, y, f_.data(), sDot_.data());
    stencil.byParameter[at].resize(s_.size());
    for (std::size_t p = 0; p < s_.size(); ++p) {
      timesJacobian(s_[p]);
      reactor_.addByParameter(p, sDot_.data());
      stencil.byParameter[at][p] = quantity_.change(criterion, y, s_[p].data(), sDot_.data());
    }
  }

  Stencil& stencil(std::size_t criterion) { return stencils_[criterion]; }

 private:
  // sDot = J s
  void timesJacobian(const std::vector<double>& s) {
    const std::size_t n = reactor_.size();
    std::fill(sDot_.begin(), sDot_.end(), 0.0);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) sDot_[i] += J_[i + j * n] * s[j];
  }

  ClosedReactor& reactor_;
  const std::vector<IgnitionCriterion>& criteria_;
  IgnitionQuantity quantity_;
  std::vector<Stencil> stencils_;
  std::vector<double> y_, f_, sDot_, J_;
  std::vector<std::vector<double>> s_;
};

std::vector<Sample> samplesAround(const std::vector<IgnitionCriterion>& criteria,
                                  const std::vector<std::optional<IgnitionEvent>>& events) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (!events[i]) continue;
    const int reach = criteria[i].ofRate() ? 2 : 0;
    for (int position = -reach; position <= reach; ++position)
      samples.push_back({events[i]->time + position * spacingOf(*events[i]), i, position});
  }
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.time < b.time; });
  return samples;
}

}  // namespace

IgnitionSensitivities ignitionSensitivities(const Mechanism& mechanism, ClosedReactor& reactor,
                                            const StiffIntegrator::Options& options,
                                            const std::vector<IgnitionCriterion>& criteria,
                                            const std::vector<std::optional<IgnitionEvent>>& events,
                                            const std::function<bool(double time, double end)>& goesOn) {
  IgnitionSensitivities result;
  result.values.resize(criteria.size());
  const std::vector<Sample> samples = samplesAround(criteria, events);
  if (samples.empty()) return result;

  StiffIntegrator integrator(reactor, options);
  integrator.start(0.0, reactor.initialState(), samples.back().time, reactor);
  Sampler sampler(mechanism, reactor, criteria);
  for (const Sample& sample : samples) {
    while (integrator.time() < sample.time) {
      if (goesOn && !goesOn(integrator.time(), samples.back().time)) return result;
      integrator.step();
    }
    sampler.take(integrator, sample);
  }
  for (std::size_t i = 0; i < criteria.size(); ++i) {
    if (!events[i]) continue;
    Stencil& stencil = sampler.stencil(i);
    stencil.spacing = spacingOf(*events[i]);
    for (std::size_t p = 0; p < reactor.numParameters(); ++p) {
      const double byParameter =
          criteria[i].ofRate() ? byMaximum(stencil, p) : -stencil.byParameter[2][p] / stencil.byTime;
      result.values[i].push_back(byParameter / events[i]->time);
    }
  }
  result.statistics = integrator.statistics();
  return result;
}

}  // namespace lampblack::chemistry
