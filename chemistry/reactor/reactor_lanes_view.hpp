// What the kernel of reactors in lanes works on (reactor_lanes.hpp): plain arrays, as it is compiled for several
// instruction sets. Rows are arrays of one double a lane; those of the unknowns (Y_1..Y_N, T) stand in that order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "chemistry/kinetics/batch_jacobian_view.hpp"
#include "chemistry/kinetics/batch_kinetics_view.hpp"
#include "core/modules.hpp"
#include "numerics/lane_lu_view.hpp"

namespace lampblack::chemistry {

// An entry of the block of the species, d(dY_k/dt)/dY_j, in its row k.
struct LaneEntry {
  std::uint32_t place;   // among the values of the matrix
  std::uint32_t column;  // row j of the unknowns
  double weightRatio;    // W_k/W_j
};

struct ReactorLanesView {
  BatchView rates;
  BatchJacobianView jacobian;
  LaneLuView lu;
  std::size_t numSpecies;
  double minTemperature, maxTemperature;                  // K, of the data
  double minStepTemperature, maxStepTemperature;          // K, at which steps can be taken
  double leastFraction;                                   // as of ReactorSystem
  double gasConstant;                                     // J/mol/K
  const double *weights, *inverseWeights, *gasConstants;  // kg/mol, mol/kg, R/W in J/kg/K
  const LaneEntry* entries;
  const std::uint32_t* entriesBegin;  // of each row, and the end
  // Places of the matrix's full parts: the row of the temperature by species, its column and that of the product u v^T
  // (ReactorSystem::SparseJacobian) by unknown.
  const std::uint32_t *temperatureRow, *temperatureColumn, *product;
  double largestMultiplier;  // of SparseLu
};

struct ReactorLanesWork {
  BatchWork rates;
  BatchJacobianWork jacobian;
  LaneLuWork lu;
  // In: a row each, the unknowns, the source of the species.
  double *pressure, *heating, *rateFactor, *stepSize;
  double *y, *source;
  double* diagonal;  // of the matrix; its last row is set by the kernel, the others are one
  // Out: the state after the step, the sum of the squares of its errors over their tolerances, one where the step could
  // be taken and zero elsewhere.
  double *end, *errorSum, *isGood;
  double *start, *f;          // dy/dt
  double *k1, *k2, *k3, *k4;  // one row more than unknowns
};

// The error of unknown i is measured in relative * (|y| + smallest).
struct LaneTolerance {
  double relative, smallestMassFraction, smallestTemperature;
};

// dY_k/dt of the chemistry alone at y, to f, and isGood.
using ReactorLanesRates = void (*)(const ReactorLanesView&, const ReactorLanesWork&);
// One step of RODAS3 from y.
using ReactorLanesStep = void (*)(const ReactorLanesView&, const ReactorLanesWork&, const LaneTolerance&);

struct ReactorLanesTarget {
  ReactorLanesRates chemicalRates;
  ReactorLanesStep step;
};

ReactorLanesTarget reactorLanesGeneric();
ReactorLanesTarget reactorLanesAvx2();
ReactorLanesTarget reactorLanesAvx512();

}  // namespace lampblack::chemistry
