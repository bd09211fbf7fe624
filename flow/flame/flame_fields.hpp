// What is looked at in a flame: fields over z made from its unknowns, and the few numbers that name it (speed, strain
// rates, thickness).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_problem.hpp"
#include "flow/flame/flame_profile.hpp"

namespace lampblack::flow {

// One value a point, SI. X and Y are point-major.
struct FlameFields {
  std::vector<double> z, temperature, density, velocity, massFlux, spread;
  std::vector<double> viscosity, conductivity, cp, meanMolecularWeight, soundSpeed;
  std::vector<double> heatRelease;  // W/m3, of the gas reactions: -sum h_k wdot_k
  std::vector<double> X, Y;
};

// The mass flux lives on faces; at points it is interpolated between the faces of the control volume. Conductivity is
// that of the problem's transport model. NumericsError outside the range of temperature of the transport properties.
[[nodiscard]] FlameFields flameFields(const Mechanism& mechanism, const FlameProblem& problem,
                                      const FlameProfile& profile);

// Strain rates of a counterflow flame, 1/s.
struct FlameStrain {
  // (2 u_R / L)(1 + u_L sqrt(rho_L) / (u_R sqrt(rho_R))) of the velocities at the nozzles: plug flow towards the right
  // stream, which by custom is the oxidiser (Seshadri and Williams 1978). Only of plug-flow nozzles.
  std::optional<double> global;
  double mean = 0;             // |u_R - u_L| / L with the velocities at both ends
  double maximum = 0;          // largest |du/dz|
  double left = 0, right = 0;  // sqrt(-Lambda / rho) of either stream: of the potential flow with that Lambda
};

struct FlameSummary {
  double maximumTemperature = 0, positionOfMaximum = 0;  // K, m
  // Largest difference of temperature over largest slope, m.
  double thermalThickness = 0;
  double heatRelease = 0;                 // W/m2, integrated
  double leftVelocity = 0;                // m/s, at z = 0; of a free flame its speed
  double maximumMach = 0;                 // largest axial velocity over the speed of sound of the same point
  double pressureGradient = 0;            // Lambda, N/m4
  std::optional<double> stagnationPlane;  // m, where the velocity changes sign
  std::optional<FlameStrain> strain;      // of flames against something
};

[[nodiscard]] FlameSummary flameSummary(const FlameProblem& problem, const FlameProfile& profile,
                                        const FlameFields& fields);

}  // namespace lampblack::flow
