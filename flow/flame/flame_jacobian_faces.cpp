// What the fluxes through a face put into the rows of a point.
#include "chemistry/numerics/dot.hpp"
#include "flow/flame/flame_jacobian.hpp"

namespace lampblack::flow::flamejacobian {

void addFace(const FlameEquations::Data& data, std::size_t i, bool isRight, const FaceDerivatives& face,
             FlameEquations::Data::JacobianWork& work) {
  const std::size_t n = data.species(), S = data.scalars(), w = data.width(), first = data.layout.firstScalar();
  const std::size_t f = isRight ? i : i - 1;
  const double sign = isRight ? 1 : -1;
  double* other = isRight ? work.U : work.L;   // the block of the neighbour
  double* mBlock = isRight ? work.D : work.L;  // the mass flux of the face is an unknown of point f
  const std::vector<double>& own = isRight ? face.left : face.right;
  const std::vector<double>& far = isRight ? face.right : face.left;
  const std::vector<double>& ownT = isRight ? face.leftTemperature : face.rightTemperature;
  const std::vector<double>& farT = isRight ? face.rightTemperature : face.leftTemperature;
  const FlameFaces& faces = data.gas.faces;
  const double h = data.profile.z[f + 1] - data.profile.z[f];
  const double Tl = data.profile.temperature(f), Tr = data.profile.temperature(f + 1), Tm = 0.5 * (Tl + Tr);
  const double m = data.profile.at(f, M);
  const double lean = faces.lean(f, m);
  const double ownShare = isRight ? 0.5 + lean : 0.5 - lean;

  for (std::size_t j = 0; j < n; ++j) {
    double* d = work.D + (Y + j) * w + Y;
    double* o = other + (Y + j) * w + Y;
    for (std::size_t k = 0; k < n; ++k) {
      d[k] += sign * own[j * n + k];
      o[k] += sign * far[j * n + k];
    }
  }
  const auto fractions = data.profile.massFractions(i);
  for (std::size_t k = 0; k < n; ++k) {
    work.D[T * w + Y + k] += sign * ownT[k];
    other[T * w + Y + k] += sign * farT[k];
    mBlock[M * w + Y + k] += sign * (face.massFlux[k] - fractions[k]);
  }

  if (!data.temperatureIsGiven(i)) {
    double* dh = work.difference.data();
    double ownSlope = 0, farSlope = 0, byMassFlux = 0;
    for (std::size_t k = 0; k < n; ++k) {
      dh[k] = faces.enthalpy[f * n + k] - data.gas.nodes.enthalpy[i * n + k];
      const double flux = faces.flux[f * n + k];
      ownSlope += flux * (ownShare * faces.heat[f * n + k] - data.gas.nodes.heat[i * n + k]) + dh[k] * ownT[k];
      farSlope += flux * (1 - ownShare) * faces.heat[f * n + k] + dh[k] * farT[k];
      byMassFlux += dh[k] * face.massFlux[k];
    }
    const double conductance = faces.conductivity[f] / h;
    const double growth = -0.5 * conductanceExponent * conductance * (Tr - Tl) / Tm;
    ownSlope += (isRight ? conductance : -conductance) + growth;
    farSlope += (isRight ? -conductance : conductance) + growth;
    work.D[T * w + T] += sign * ownSlope;
    other[T * w + T] += sign * farSlope;
    mBlock[M * w + T] += sign * byMassFlux;
    for (std::size_t j = 0; j < n; ++j) {
      work.D[(Y + j) * w + T] += sign * dot(dh, &own[j * n], n);
      other[(Y + j) * w + T] += sign * dot(dh, &far[j * n], n);
    }
  }

  if (!data.spreadIsGiven(i)) {
    const double a = data.profile.at(f, V), b = data.profile.at(f + 1, V);
    const double conductance = faces.viscosity[f] / h;
    work.D[V * w + V] += sign * (-0.5 * m + (isRight ? conductance : -conductance));
    other[V * w + V] += sign * (0.5 * m + (isRight ? -conductance : conductance));
    mBlock[M * w + V] += sign * (0.5 * (a + b) - data.profile.at(i, V));
    const double growth = -0.5 * conductanceExponent * conductance * (b - a) / Tm;
    work.D[T * w + V] += sign * growth;
    other[T * w + V] += sign * growth;
  }

  const double driftSlope = faces.viscosity[f] / (h * Tm), bend = 0.5 * (Tr - Tl) / Tm;
  for (std::size_t s = 0; s < S; ++s) {
    const double c = data.gas.scalarThermophoresis[s], v = m + c * faces.drift[f];
    const auto [left, right] = data.scalarSlopes(f, s);
    const double upstream = (1 + faces.scalarLift[f * S + s]) * data.profile.scalars(v > 0 ? f : f + 1)[s];
    const std::size_t row = first + s;
    work.D[row * w + row] += sign * (isRight ? left : right);
    other[row * w + row] += sign * (isRight ? right : left);
    mBlock[M * w + row] += sign * (upstream - data.profile.scalars(i)[s]);
    const double byRight = -c * driftSlope * (1 - bend) * upstream, byLeft = c * driftSlope * (1 + bend) * upstream;
    work.D[T * w + row] += sign * (isRight ? byLeft : byRight);
    other[T * w + row] += sign * (isRight ? byRight : byLeft);
  }
}

}  // namespace lampblack::flow::flamejacobian
