// Inside of FlameEquations: the Newton matrix, from derivatives of the fluxes through a face and of the sources at a
// point, with transport coefficients frozen but for their growth with temperature. Not for other modules.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "flow/flame/flame_equations_data.hpp"

namespace lampblack::flow {

// Of the species' fluxes through face f. Matrices are column-major, species by species.
struct FaceDerivatives {
  std::vector<double> left, right;                        // with mass fractions of point f, f + 1
  std::vector<double> leftTemperature, rightTemperature;  // with their temperatures
  std::vector<double> massFlux;                           // with the mass flux: mass fractions of the face
  void compute(const FlameEquations::Data& data, std::size_t f);

 private:
  void side(const FlameEquations::Data& data, std::size_t f, bool right);
  std::vector<double> sum_, scaled_;
};

struct FlameEquations::Data::JacobianWork {
  explicit JacobianWork(const Data& data);
  FaceDerivatives before, after;  // of the faces left and right of the point
  bool beforeIsThere = false;
  std::vector<double> rates, rateJacobian, rateTemperature, concentrations, sumByConcentration;
  std::vector<double> carried, carriedConcentrations, densities, difference, timeWeights;
  std::vector<double> gain;  // of the whole gas, kg/m2/s, with each unknown of the point
  double* D = nullptr;       // blocks of the row
  double* L = nullptr;
  double* U = nullptr;
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
