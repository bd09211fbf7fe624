// A system of stiff ordinary differential equations dy/dt = f(t, y) as the StiffIntegrator wants it: rates with an
// analytic Jacobian, and, for sensitivities, the derivatives with respect to parameters.
#pragma once

#include <cstddef>
#include <string>

#include "core/modules.hpp"

namespace lampblack::chemistry {

class OdeSystem {
 public:
  virtual ~OdeSystem() = default;

  virtual std::size_t size() const = 0;
  // f = dy/dt. False, with f undefined, where the state is outside the range of the data or not finite.
  virtual bool rates(double t, const double* y, double* f) = 0;
  // J[i + ld*j] = d f_i / d y_j for all i, j < size(); also leaves f.
  virtual bool jacobian(double t, const double* y, double* f, double* J, std::size_t ld) = 0;
  // Whether the rates of a state are other ones at another time.
  virtual bool dependsOnTime() const { return false; }
  // Puts into y what is a given function of time and only carried along, such as a given temperature.
  virtual void prescribe(double /*t*/, double* /*y*/) const {}
  // What the absolute tolerance is multiplied with for unknown i: one for mass fractions, and for what is only carried
  // along, which must not steer the steps, carriedScale.
  static constexpr double carriedScale = 1e30;
  virtual double toleranceScale(std::size_t /*i*/) const { return 1.0; }
  // For unknowns that change by decades: whether the absolute tolerance follows the state, with the scales at y (above
  // zero) instead of toleranceScale.
  virtual bool hasMovingScales() const { return false; }
  virtual void toleranceScales(const double* /*y*/, double* /*scales*/) const {}
  // The state in words, for messages.
  virtual std::string describe(double t, const double* y) const = 0;

 protected:
  OdeSystem() = default;
  OdeSystem(const OdeSystem&) = default;
  OdeSystem& operator=(const OdeSystem&) = default;
};

// The parameters p that the sensitivities dy/dp are about.
class OdeParameters {
 public:
  virtual ~OdeParameters() = default;

  virtual std::size_t numParameters() const = 0;
  // Prepares the derivatives at a state; false as in OdeSystem.
  virtual bool prepareParameters(double t, const double* y) = 0;
  // f[i] += d f_i / d p at the prepared state.
  virtual void addByParameter(std::size_t parameter, double* f) const = 0;

 protected:
  OdeParameters() = default;
  OdeParameters(const OdeParameters&) = default;
  OdeParameters& operator=(const OdeParameters&) = default;
};

}  // namespace lampblack::chemistry
