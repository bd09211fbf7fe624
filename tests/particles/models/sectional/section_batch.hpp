// Sections in a gas that does not change, integrated by CVODES with the model's own Jacobian.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "chemistry/reactor/ode_system.hpp"
#include "chemistry/reactor/stiff_integrator.hpp"
#include "particles/models/soot_model.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

class SectionBatch final : public OdeSystem {
 public:
  SectionBatch(const SootModel& model, const ParticleGas& gas)
      : model_(model), gas_(gas), exchange_(model.gasSpecies().size()) {
    const std::size_t rows = size() + exchange_.size();
    jacobian_.resize(rows * (rows + 1));
  }
  std::size_t size() const override { return model_.scalars().size(); }
  bool rates(double /*t*/, const double* y, double* f) override {
    model_.sources(gas_, {y, size()}, {f, size()}, exchange_);
    return true;
  }
  bool jacobian(double t, const double* y, double* f, double* J, std::size_t ld) override {
    model_.jacobian(gas_, {y, size()}, jacobian_);
    const std::size_t columns = size() + exchange_.size() + 1;
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t j = 0; j < size(); ++j) J[i + ld * j] = jacobian_[i * columns + j];
    return rates(t, y, f);
  }
  double toleranceScale(std::size_t i) const override { return 0.2 * model_.scalars()[i].scale; }
  std::string describe(double /*t*/, const double* /*y*/) const override { return "sections"; }

 private:
  const SootModel& model_;
  ParticleGas gas_;
  std::vector<double> exchange_, jacobian_;
};

inline std::vector<double> evolve(const SootModel& model, const ParticleGas& gas, std::vector<double> y, double time,
                                  double tolerance = 1e-6) {
  SectionBatch system(model, gas);
  StiffIntegrator::Options options;
  options.relativeTolerance = tolerance;
  options.absoluteTolerance = 1e-10;
  StiffIntegrator integrator(system, options);
  integrator.start(0, y, time);
  while (integrator.time() < time) integrator.step();
  const auto end = integrator.state();
  return {end.begin(), end.end()};
}

}  // namespace lampblack::test
