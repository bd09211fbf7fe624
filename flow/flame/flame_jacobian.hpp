// Inside of FlameEquations: the Newton matrix, from derivatives of the fluxes through a face and of the sources at a
// point, with transport coefficients frozen but for their growth with temperature. Not for other modules.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/modules.hpp"
#include "flow/flame/flame_equations_data.hpp"

namespace lampblack::flow {

// Terms of the blocks of neighbours where those are thin (numerics/neighbour_block.hpp): what the mass flux and the
// temperature of the neighbour do to all equations, what all unknowns do to the equation of temperature, and what all
// species do to the flux of each through the mean weight and through the sum of the fluxes.
enum FlameNeighbourTerm : std::size_t {
  byMassFlux,
  byTemperature,
  ofTemperature,
  byMeanWeight,
  byAllFluxes,
  numFlameNeighbourTerms
};

// Derivatives of the species' fluxes through a face with the mass fractions of a point beside it.
struct FluxDerivatives {
  std::vector<double> entries;  // column-major, species by species
  // The same as a diagonal, meanWeight[k] meanWeightWith[j] and ofSum[k] sumWith[j]; not with multicomponent diffusion.
  std::vector<double> diagonal, meanWeight, meanWeightWith, ofSum, sumWith;
};

// Of the species' fluxes through face f.
struct FaceDerivatives {
  FluxDerivatives left, right;                            // with mass fractions of point f, f + 1
  std::vector<double> leftTemperature, rightTemperature;  // with their temperatures
  std::vector<double> massFlux;                           // with the mass flux: mass fractions of the face
  void compute(const FlameEquations::Data& data, std::size_t f);

 private:
  void side(const FlameEquations::Data& data, std::size_t f, bool right);
};

struct FlameEquations::Data::JacobianWork {
  explicit JacobianWork(const Data& data);
  FaceDerivatives before, after;  // of the faces left and right of the point
  bool beforeIsThere = false;
  std::vector<double> rates, rateJacobian, rateTemperature, concentrations, sumByConcentration;
  std::vector<double> carried, carriedConcentrations, densities, difference, timeWeights;
  std::vector<double> gain;  // of the whole gas, kg/m2/s, with each unknown of the point
  double* D = nullptr;       // blocks of the row
  std::optional<NeighbourBlock> L, U;
  double* B = nullptr;
};

// The parts of Data::fillRow.
namespace flamejacobian {

// Rows and columns of the blocks of a point.
inline constexpr std::size_t M = FlameLayout::massFlux, V = FlameLayout::spread, T = FlameLayout::temperature,
                             Y = FlameLayout::firstSpecies;

// d(convection, diffusion, conduction) through one side of the control volume of point i.
void addFace(const FlameEquations::Data& data, std::size_t i, bool isRight, const FaceDerivatives& face,
             FlameEquations::Data::JacobianWork& work);
// Reactions of the gas: -volume * d(source).
void addReactions(FlameEquations::Data& data, std::size_t i, FlameEquations::Data::JacobianWork& work);
// What scalars and gas exchange: sources of both.
void addCarried(FlameEquations::Data& data, std::size_t i, FlameEquations::Data::JacobianWork& work);

}  // namespace flamejacobian
}  // namespace lampblack::flow
