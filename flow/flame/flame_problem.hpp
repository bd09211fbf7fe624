// What a one-dimensional flame is: configuration, streams, pressure, what is solved for. Plain data in SI; the deck is
// read elsewhere.
//
// All flames are solutions of the similarity equations of a stagnation flow (Kee, Coltrin, Glarborg 2003, chapter 6),
// of which flames without spreading (V = 0) are the special case:
//   d(rho u)/dz + 2 rho V = S_gas,     V = v_r / r
//   rho u dV/dz + rho V^2 = d/dz(mu dV/dz) - Lambda
//   rho u dY_k/dz = -dj_k/dz + W_k wdot_k + S_k - Y_k S_gas
//   energy: total enthalpy of gas and carried matter, convected, conducted, carried by diffusion, lost by radiation.
#pragma once

#include <optional>
#include <vector>

#include "core/modules.hpp"
#include "flow/models/radiation.hpp"
#include "flow/properties/transport_model.hpp"

namespace lampblack::flow {

enum class FlameType {
  Free,         // premixed, freely propagating: the mass flux is the eigenvalue
  Burner,       // premixed, on a burner with given mass flux
  Wall,         // a stream against a wall of given temperature
  Counterflow,  // two streams against each other; diffusion or premixed
};

enum class FlameNozzles {
  Plug,       // both velocities given, no spreading at the nozzles; Lambda is the eigenvalue
  Potential,  // strain rate of the oncoming potential flow given; Lambda = -rho_right a^2, stagnation plane given
};

struct FlameStream {
  double temperature = 298;  // K
  std::vector<double> Y;
  double massFlux = 0;  // kg/m2/s, into the domain, positive; free: a first guess; potential flow: not used
};

// A temperature given by points, straight lines between them and constant beyond.
struct GivenTemperature {
  std::vector<double> z, T;  // m (rising), K
  [[nodiscard]] double at(double place) const;
  // The mean over `width` (m) to either side, with weights that fall linearly to its ends: no kinks and no steps of
  // rounding. Beyond the ends of the domain [0, length] it goes on point-symmetrically, so that its values there stay.
  [[nodiscard]] GivenTemperature smoothed(double width, double length) const;
};

struct FlameProblem {
  FlameType type = FlameType::Free;
  FlameNozzles nozzles = FlameNozzles::Plug;
  double pressure = 101325;               // Pa
  double length = 0.02;                   // m; free flames may widen it
  FlameStream left;                       // at z = 0; counterflow: by custom the fuel
  std::optional<FlameStream> right;       // counterflow, at z = length
  double wallTemperature = 300;           // K, Wall
  double strainRate = 0;                  // 1/s, Potential: of the stream at the right end
  double stagnationPlane = 0;             // m, Potential
  std::optional<GivenTemperature> given;  // where the energy equation is not solved (burner, wall)
  TransportModel transport;
  RadiationOptions radiation;
};

}  // namespace lampblack::flow
