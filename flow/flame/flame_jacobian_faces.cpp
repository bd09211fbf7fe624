// What the fluxes through a face put into the rows of a point.
#include "flow/flame/flame_jacobian.hpp"
#include "numerics/dot.hpp"

namespace lampblack::flow::flamejacobian {
namespace {

// What goes into the block of a neighbour, dense or thin.
class NeighbourEntries {
 public:
  NeighbourEntries(const NeighbourBlock& block, std::size_t width) : block_(block), width_(width) {
    if (block_.isDense()) return;
    block_.row(byMassFlux, M) = block_.row(byTemperature, T) = 1;
    block_.column(ofTemperature)[T] = 1;
  }

  // On the diagonal, in the columns of mass flux and temperature, and in the row of temperature.
  void add(std::size_t row, std::size_t column, double value) const {
    if (block_.isDense())
      block_.entries()[column * width_ + row] += value;
    else if (row == column)
      block_.diagonal()[row] += value;
    else if (column == M || column == T)
      block_.column(column == M ? byMassFlux : byTemperature)[row] += value;
    else
      block_.row(ofTemperature, column) += value;
  }

  // Of all species with all species, once a block.
  void addSpecies(double sign, std::size_t n, const FluxDerivatives& flux) const {
    if (block_.isDense()) {
      for (std::size_t j = 0; j < n; ++j) {
        double* entries = block_.entries() + (Y + j) * width_ + Y;
        for (std::size_t k = 0; k < n; ++k) entries[k] += sign * flux.entries[j * n + k];
      }
      return;
    }
    for (std::size_t k = 0; k < n; ++k) {
      block_.diagonal()[Y + k] += sign * flux.diagonal[k];
      block_.column(byMeanWeight)[Y + k] = sign * flux.meanWeight[k];
      block_.row(byMeanWeight, Y + k) = flux.meanWeightWith[k];
      block_.column(byAllFluxes)[Y + k] = sign * flux.ofSum[k];
      block_.row(byAllFluxes, Y + k) = flux.sumWith[k];
    }
  }

 private:
  NeighbourBlock block_;
  std::size_t width_;
};

}  // namespace

void addFace(const FlameEquations::Data& data, std::size_t i, bool isRight, const FaceDerivatives& face,
             FlameEquations::Data::JacobianWork& work) {
  const std::size_t n = data.species(), S = data.scalars(), w = data.width(), first = data.layout.firstScalar();
  const std::size_t f = isRight ? i : i - 1;
  const double sign = isRight ? 1 : -1;
  const NeighbourEntries other(isRight ? *work.U : *work.L, w);
  // The mass flux of the face is an unknown of point f.
  const auto addMassFlux = [&](std::size_t row, double value) {
    if (isRight)
      work.D[M * w + row] += value;
    else
      other.add(row, M, value);
  };
  const FluxDerivatives& own = isRight ? face.left : face.right;
  const FluxDerivatives& far = isRight ? face.right : face.left;
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
    for (std::size_t k = 0; k < n; ++k) d[k] += sign * own.entries[j * n + k];
  }
  other.addSpecies(sign, n, far);
  const auto fractions = data.profile.massFractions(i);
  for (std::size_t k = 0; k < n; ++k) {
    work.D[T * w + Y + k] += sign * ownT[k];
    other.add(Y + k, T, sign * farT[k]);
    addMassFlux(Y + k, sign * (face.massFlux[k] - fractions[k]));
  }

  if (!data.temperatureIsGiven(i)) {
    double* dh = work.difference.data();
    double ownSlope = 0, farSlope = 0, massFluxSlope = 0;
    for (std::size_t k = 0; k < n; ++k) {
      dh[k] = faces.enthalpy[f * n + k] - data.gas.nodes.enthalpy[i * n + k];
      const double flux = faces.flux[f * n + k];
      ownSlope += flux * (ownShare * faces.heat[f * n + k] - data.gas.nodes.heat[i * n + k]) + dh[k] * ownT[k];
      farSlope += flux * (1 - ownShare) * faces.heat[f * n + k] + dh[k] * farT[k];
      massFluxSlope += dh[k] * face.massFlux[k];
    }
    const double conductance = faces.conductivity[f] / h;
    const double growth = -0.5 * conductanceExponent * conductance * (Tr - Tl) / Tm;
    ownSlope += (isRight ? conductance : -conductance) + growth;
    farSlope += (isRight ? -conductance : conductance) + growth;
    work.D[T * w + T] += sign * ownSlope;
    other.add(T, T, sign * farSlope);
    addMassFlux(T, sign * massFluxSlope);
    for (std::size_t j = 0; j < n; ++j) {
      work.D[(Y + j) * w + T] += sign * dot(dh, &own.entries[j * n], n);
      other.add(T, Y + j, sign * dot(dh, &far.entries[j * n], n));
    }
  }

  if (!data.spreadIsGiven(i)) {
    const double a = data.profile.at(f, V), b = data.profile.at(f + 1, V);
    const double conductance = faces.viscosity[f] / h;
    work.D[V * w + V] += sign * (-0.5 * m + (isRight ? conductance : -conductance));
    other.add(V, V, sign * (0.5 * m + (isRight ? -conductance : conductance)));
    addMassFlux(V, sign * (0.5 * (a + b) - data.profile.at(i, V)));
    const double growth = -0.5 * conductanceExponent * conductance * (b - a) / Tm;
    work.D[T * w + V] += sign * growth;
    other.add(V, T, sign * growth);
  }

  const double driftSlope = faces.viscosity[f] / (h * Tm), bend = 0.5 * (Tr - Tl) / Tm;
  for (std::size_t s = 0; s < S; ++s) {
    const double c = data.gas.scalarThermophoresis[s], v = m + c * faces.drift[f];
    const auto [left, right] = data.scalarSlopes(f, s);
    const double upstream = (1 + faces.scalarLift[f * S + s]) * data.profile.scalars(v > 0 ? f : f + 1)[s];
    const std::size_t row = first + s;
    work.D[row * w + row] += sign * (isRight ? left : right);
    other.add(row, row, sign * (isRight ? right : left));
    addMassFlux(row, sign * (upstream - data.profile.scalars(i)[s]));
    const double byRight = -c * driftSlope * (1 - bend) * upstream, byLeft = c * driftSlope * (1 + bend) * upstream;
    work.D[T * w + row] += sign * (isRight ? byLeft : byRight);
    other.add(row, T, sign * (isRight ? byRight : byLeft));
  }
}

}  // namespace lampblack::flow::flamejacobian
