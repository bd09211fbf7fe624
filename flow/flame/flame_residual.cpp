// The residual of a point and of the unknowns of the whole flame.
#include "core/constants.hpp"
#include "flow/boundaries/wall_flux.hpp"
#include "flow/flame/flame_equations_data.hpp"

namespace lampblack::flow {

double FlameEquations::Data::speciesFluxLeft(std::size_t i, std::size_t k) const {
  return i == 0 ? profile.global(leftMassFlux) * problem.left.Y[k] : gas.faces.flux[(i - 1) * species() + k];
}

double FlameEquations::Data::speciesFluxRight(std::size_t i, std::size_t k) const {
  if (i + 1 < points()) return gas.faces.flux[i * species() + k];
  const double m = profile.at(i, FlameLayout::massFlux);
  return m * (rightEnd == FlameEnd::Stream ? problem.right->Y[k] : profile.massFractions(i)[k]);
}

double FlameEquations::Data::endDrift(std::size_t s, bool right) const {
  const std::size_t face = right ? points() - 2 : 0;
  const double m = right ? profile.at(points() - 1, FlameLayout::massFlux) : profile.global(leftMassFlux);
  const double w = m + gas.scalarThermophoresis[s] * gas.faces.drift[face];
  if (right && rightEnd == FlameEnd::Wall) return takenAtWall(w, gas.faces.scalarConductance[face * scalars() + s]);
  return right ? std::max(w, 0.0) : std::min(w, 0.0);
}

double FlameEquations::Data::scalarFluxLeft(std::size_t i, std::size_t s) const {
  if (i > 0) return gas.faces.scalarFlux[(i - 1) * scalars() + s];
  return endDrift(s, false) * profile.scalars(0)[s] * gas.scalarScale[s];
}

double FlameEquations::Data::scalarFluxRight(std::size_t i, std::size_t s) const {
  if (i + 1 < points()) return gas.faces.scalarFlux[i * scalars() + s];
  return endDrift(s, true) * profile.scalars(i)[s] * gas.scalarScale[s];
}

bool FlameEquations::Data::temperatureIsGiven(std::size_t i) const {
  return problem.given || i == 0 || (i + 1 == points() && rightEnd != FlameEnd::Outlet);
}

double FlameEquations::Data::temperatureGiven(std::size_t i) const {
  if (problem.given) return given[i];
  if (i == 0) return problem.left.temperature;
  return rightEnd == FlameEnd::Wall ? problem.wallTemperature : problem.right->temperature;
}

bool FlameEquations::Data::spreadIsGiven(std::size_t i) const {
  return !spreading || i == 0 || i + 1 == points();
}

double FlameEquations::Data::spreadGivenPerLoad(std::size_t i) const {
  if (!spreading || problem.nozzles == FlameNozzles::Plug) return 0;
  if (i == 0) return problem.strainRate * std::sqrt(rightDensity / leftDensity);
  return rightEnd == FlameEnd::Stream ? problem.strainRate : 0;
}

double FlameEquations::Data::spreadGiven(std::size_t i) const {
  return spreadGivenPerLoad(i) * profile.global(load);
}

double FlameEquations::Data::energyResidual(std::size_t i) const {
  const std::size_t n = species(), S = scalars(), last = points() - 1;
  const double* h = &gas.nodes.enthalpy[i * n];
  const double* hs = S > 0 ? &gas.nodes.scalarEnthalpy[i * S] : nullptr;
  double sum = gas.nodes.loss[i] * volume[i];
  double reaction = 0;
  for (std::size_t k = 0; k < n; ++k) reaction += h[k] * gas.nodes.source[i * n + k];
  for (std::size_t s = 0; s < S; ++s) reaction += hs[s] * gas.nodes.scalarRate[i * S + s];
  sum += reaction * volume[i];
  // Through both surfaces: enthalpy above that of the point's own temperature, and conduction.
  for (const bool right : {false, true}) {
    if (right ? i == last : i == 0) continue;
    const std::size_t f = right ? i : i - 1;
    const double dz = profile.z[f + 1] - profile.z[f];
    const double* face = &gas.faces.enthalpy[f * n];
    double flux = -gas.faces.conductivity[f] * (profile.temperature(f + 1) - profile.temperature(f)) / dz;
    for (std::size_t k = 0; k < n; ++k) flux += gas.faces.flux[f * n + k] * (face[k] - h[k]);
    for (std::size_t s = 0; s < S; ++s)
      flux += gas.faces.scalarFlux[f * S + s] * (gas.faces.scalarEnthalpy[f * S + s] - hs[s]);
    sum += right ? flux : -flux;
  }
  return sum;
}

double FlameEquations::Data::scalarResidual(std::size_t i, std::size_t s) const {
  const double net = profile.at(i, FlameLayout::massFlux) - leftFlux(i) - volume[i] * gas.nodes.exchanged[i];
  const double made = volume[i] * gas.nodes.scalarRate[i * scalars() + s];
  return (scalarFluxRight(i, s) - scalarFluxLeft(i, s) - made) / gas.scalarScale[s] - profile.scalars(i)[s] * net;
}

std::pair<double, double> FlameEquations::Data::scalarSlopes(std::size_t f, std::size_t s) const {
  const double v = profile.at(f, FlameLayout::massFlux) + gas.scalarThermophoresis[s] * gas.faces.drift[f];
  const double a = gas.faces.scalarConductance[f * scalars() + s];
  const double share = 1 + gas.faces.scalarLift[f * scalars() + s];
  return {share * std::max(v, 0.0) + a, share * std::min(v, 0.0) - a};
}

void FlameEquations::Data::pointResidual(std::size_t i, double* F) const {
  const std::size_t n = species(), S = scalars();
  const double mLeft = leftFlux(i), mRight = profile.at(i, FlameLayout::massFlux);
  const double V = profile.at(i, FlameLayout::spread), T = profile.temperature(i);
  const double rho = gas.nodes.density[i], dv = volume[i], gained = gas.nodes.exchanged[i];
  const auto Y = profile.massFractions(i);

  F[FlameLayout::massFlux] = mRight - mLeft + dv * (2 * rho * V - gained);

  if (spreadIsGiven(i)) {
    F[FlameLayout::spread] = V - spreadGiven(i);
  } else {
    double sum = dv * (rho * V * V + profile.global(pressureGradient));
    for (const bool right : {false, true}) {
      const std::size_t f = right ? i : i - 1;
      const double m = profile.at(f, FlameLayout::massFlux);
      const double a = profile.at(f, FlameLayout::spread), b = profile.at(f + 1, FlameLayout::spread);
      // Central at any spacing: fast streams spread smoothly, and leaning upwind there costs an order of accuracy.
      const double face = 0.5 * (a + b);
      const double flux = m * (face - V) - gas.faces.viscosity[f] * (b - a) / (profile.z[f + 1] - profile.z[f]);
      sum += right ? flux : -flux;
    }
    F[FlameLayout::spread] = sum;
  }

  F[FlameLayout::temperature] = temperatureIsGiven(i) ? T - temperatureGiven(i) : energyResidual(i);

  // What flows out less what flows in and is made, less Y times the same of the whole gas.
  const double net = mRight - mLeft;
  for (std::size_t k = 0; k < n; ++k)
    F[FlameLayout::firstSpecies + k] = speciesFluxRight(i, k) - speciesFluxLeft(i, k) - Y[k] * net +
                                       dv * (Y[k] * gained - gas.nodes.source[i * n + k]);
  for (std::size_t s = 0; s < S; ++s) F[layout.firstScalar() + s] = scalarResidual(i, s);
  if (holds) {
    for (std::size_t c = 0; c < width(); ++c)
      if (isHeld(c)) F[c] = profile.at(i, c) - held[i * width() + c];
  }
}

FlameEquations::Data::Plane FlameEquations::Data::stagnationPlane() const {
  // Faces lie between points; the mass flux is linear between them.
  const auto faceAt = [&](std::size_t f) { return 0.5 * (profile.z[f] + profile.z[f + 1]); };
  std::size_t f = 0;
  while (f + 3 < points() && faceAt(f + 1) < problem.stagnationPlane) ++f;
  return {f, std::clamp((problem.stagnationPlane - faceAt(f)) / (faceAt(f + 1) - faceAt(f)), 0.0, 1.0)};
}

void FlameEquations::Data::globalResidual(double* F) const {
  const double factor = profile.global(load);
  const double m = profile.global(leftMassFlux), lambda = profile.global(pressureGradient);
  const double mEnd = profile.at(points() - 1, FlameLayout::massFlux);
  if (problem.type == FlameType::Free) {
    F[leftMassFlux] = profile.temperature(anchor) - anchorTemperature;
  } else if (spreading && problem.nozzles == FlameNozzles::Potential) {
    if (rightEnd == FlameEnd::Wall) {
      F[leftMassFlux] = mEnd;
    } else {
      const Plane plane = stagnationPlane();
      F[leftMassFlux] = (1 - plane.share) * profile.at(plane.face, FlameLayout::massFlux) +
                        plane.share * profile.at(plane.face + 1, FlameLayout::massFlux);
    }
  } else {
    F[leftMassFlux] = m - factor * problem.left.massFlux;
  }
  if (!spreading) {
    F[pressureGradient] = lambda;
  } else if (problem.nozzles == FlameNozzles::Plug) {
    F[pressureGradient] = mEnd + (rightEnd == FlameEnd::Stream ? factor * problem.right->massFlux : 0.0);
  } else {
    const double a = factor * problem.strainRate;
    F[pressureGradient] = lambda + rightDensity * a * a;
  }
  if (constraint) {
    double sum = -constraint->value;
    for (std::size_t i = 0; i < unknowns(); ++i) sum += constraint->coefficients[i] * profile.x[i];
    F[load] = sum;
  } else {
    F[load] = factor - loadValue;
  }
  for (std::size_t g = 0; g < numFlameGlobals; ++g)
    if (isHeld(width() + g)) F[g] = profile.x[points() * width() + g] - held[points() * width() + g];
}

void FlameEquations::Data::pointTimeWeights(std::size_t i, double* M) const {
  const double mass = gas.nodes.density[i] * volume[i];
  M[FlameLayout::massFlux] = 0;
  M[FlameLayout::spread] = spreadIsGiven(i) ? 0 : mass;
  M[FlameLayout::temperature] = temperatureIsGiven(i) ? 0 : mass * gas.nodes.cp[i];
  for (std::size_t c = FlameLayout::firstSpecies; c < width(); ++c) M[c] = mass;
  for (std::size_t c = 0; c < width(); ++c)
    if (isHeld(c)) M[c] = 0;
}

}  // namespace lampblack::flow
