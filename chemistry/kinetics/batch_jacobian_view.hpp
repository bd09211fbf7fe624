// What the kernel of derivatives in lanes loops over (batch_jacobian.hpp), beside the tables of the rates
// (batch_kinetics_view.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "chemistry/kinetics/batch_kinetics_view.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// Reactions of one shape. A record of `rows` is the entry of its constant, the column of its set of efficiencies (or
// noColumn), the reactants, if reversible the products, where their rates are summed up as in BatchGroup, and for each
// reactant, if reversible for each product, the places of the derivatives of those sums by its concentration.
struct BatchJacobianGroup {
  std::uint32_t numReactants, numProducts;  // 1 to 3; of the sums
  bool reversible;
  std::uint32_t count;
  const std::uint32_t* rows;
  const double* A;
};

// A reaction of more species or of any whole coefficients: ranges of a list of rows, a molecule each, of terms of the
// net coefficients, and of places by reactant, product, term.
struct BatchJacobianGeneral {
  std::uint32_t entry, column;
  double A;
  bool reversible;
  std::uint32_t reactants, reactantsEnd, products, productsEnd;
  std::uint32_t net, netEnd;
  std::uint32_t places;
};

// A set of efficiencies: what it adds by the rows that its reactions change, in all columns and in those of the
// colliders named. `places` by collider, row.
struct BatchJacobianSet {
  double base;
  std::uint32_t column;
  std::uint32_t rows, rowsEnd;            // range of rowList
  std::uint32_t colliders, collidersEnd;  // range of excess
  std::uint32_t places;
};

inline constexpr std::uint32_t noColumn = UINT32_MAX;

struct BatchJacobianView {
  std::size_t numEntries;  // of rate constants
  BatchArray<BatchJacobianGroup> groups;
  BatchArray<BatchJacobianGeneral> general;
  BatchArray<BatchJacobianSet> sets;
  BatchArray<std::uint32_t> valueList;  // places of all derivatives
  std::size_t columns;                  // rows of work.columns
  const std::uint32_t *rowList, *placeList;
  const BatchTerm* terms;
  const double* excess;
};

// Rows of a block.
struct BatchJacobianWork {
  double *slope, *byM;       // of each entry: d ln E/dT, and dE/d[M] where it has a set
  double* columns;           // d wdot/d[M] of each set, one row more than species
  double *h, *cp, *cpSlope;  // of each species: enthalpy and heat capacity over R, K, 1, 1/K
  double *wdot, *byT;        // one row more than species: production rates and their derivatives by T
  double* common;            // of each species: the part of d wdot/dc that all columns have
  double* values;            // the rest, at the places given, where one more is written without being used
};

}  // namespace lampblack::chemistry
