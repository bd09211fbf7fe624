// Mass fluxes and spreading of a profile that agree with continuity, d(rho u)/dz + 2 rho V = 0, in finite volumes
// around its points.
#pragma once

#include <span>

#include "core/modules.hpp"
#include "flow/flame/flame_profile.hpp"

namespace lampblack::flow {

// Sets the mass fluxes that `left` (rho u at the first point, kg/m2/s) and the spreading of the profile leave, with the
// densities of the points (kg/m3).
void setMassFlux(FlameProfile& profile, std::span<const double> density, double left);

// The same with the spreading and the pressure gradient scaled so that the last flux is `right` (towards larger z). The
// factor of the spreading is returned. NumericsError where the profile has no spreading to be scaled.
double scaleSpreading(FlameProfile& profile, std::span<const double> density, double left, double right);

}  // namespace lampblack::flow
