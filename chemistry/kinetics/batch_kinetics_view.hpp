// What the kernels of BatchKinetics loop over: plain arrays, built by BatchTables. The kernels are compiled with
// instruction sets of their own, so nothing here may bring inline functions along.
//
// States are taken in blocks of `batchLanes`. A row is an array of as many doubles, one a state of the block; rows are
// named by their offsets in doubles. Logarithms and exponents are to base 2, and coefficients of thermodynamics and
// activation temperatures are scaled accordingly.
//
// A reaction's constant is A times the row E of its entry. Entries: the distinct exponentials 2^(logA + b log2 T +
// Ta/T) first, logA the order of magnitude of the first constant that has it, then one that is always one, then those
// with a factor ([M], fall-off) or a function of pressure.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/modules.hpp"

namespace lampblack::chemistry {

inline constexpr std::size_t batchLanes = 8;

// log2 (RT/p0) + g/RT log2(e) = log2 (RT/p0) + c0 (1 - ln T) + c1 T + c2 T^2 + c3 T^3 + c4 T^4 + c5/T + c6
struct BatchNasa7 {
  double mid;  // K; low up to and including it
  double low[7], high[7];
};

// The same with + c7/T^2 + c8 (1 + ln T)/T; a range holds from its lower bound on.
struct BatchNasa9Range {
  std::uint32_t species;  // row
  double lowerBound;      // K
  double c[9];
};

struct BatchTerm {
  std::uint32_t row;
  double coefficient;
};

// base * sum c + sum of terms
struct BatchThirdBody {
  double base;
  std::uint32_t begin, end;  // terms
  bool logarithm;            // whether log2 [M] is needed
};

struct BatchExponential {
  double logA, b, Ta;
};

// E[entry] = E[base] times a factor that is given for every state
struct BatchGiven {
  std::uint32_t entry, base;  // rows
};

// E[entry] = E[base] [M]
struct BatchThreeBody {
  std::uint32_t entry, base, set;  // rows
};

// 2^(logA + b log2 T + Ta/T + byT T)
struct BatchFactorExponential {
  double logA, b, Ta, byT;
};

// E[entry] = E[base] F Pr/(1 + Pr), or E[base] F/(1 + Pr) if chemically activated. The row `first` of factor
// exponentials is Pr/[M], and numTerms more follow. With Fcent = byT T + sum_i weight_i of them,
//   u = shift0 + shift1 log2 Fcent + log10 Pr,  v = width0 + width1 log2 Fcent - slope u,
//   log2 F = logScale + scaleExponent log2 T + log2 Fcent/(1 + (u/v)^2).
struct BatchFalloff {
  std::uint32_t entry, base, set, first;  // rows
  std::uint32_t numTerms;
  bool activated;
  BatchFactorExponential ratio;  // that of `first`
  double weight[3], byT;
  double shift0, shift1, width0, width1, slope, logScale, scaleExponent;
};

// log2 k is linear in log2 p between the levels; a level's k is the sum of its rates.
struct BatchPressureLevel {
  double logP, inverseWidth;  // of the interval below
  std::uint32_t begin, end;   // rates
};
struct BatchPressureRate {
  double sign, logA, b, Ta;
};
struct BatchPressureLog {
  std::uint32_t entry, begin, end;  // row, levels
};

// log2 k = sum_ij a_ij T_i(x) T_j(y), x = scaleT/T + shiftT, y = scaleP log2 p + shiftP, j fastest
struct BatchChebyshev {
  std::uint32_t entry, numT, numP, begin;  // row, sizes, coefficients
  double scaleT, shiftT, scaleP, shiftP;
};

// Reactions of one shape. A record of `rows` is the entry, the reactants, the products, then where their rates are
// summed up: a species that a reaction does not change leads to the row after the last species.
struct BatchGroup {
  std::uint32_t numReactants, numProducts;  // 1 to 3
  bool reversible;
  std::uint32_t count;
  const std::uint32_t* rows;
  const double* A;
};

// A reaction of any stoichiometry and orders; term ranges.
struct BatchGeneral {
  std::uint32_t entry;
  double A;
  bool reversible;
  std::uint32_t forwardBegin, forwardEnd, reverseBegin, reverseEnd, netBegin, netEnd;
};

template <class T>
struct BatchArray {
  const T* data;
  std::size_t size;
};

struct BatchView {
  std::size_t numSpecies;
  // Within these temperatures no product of 2^(g/RT) or of a rate constant comes near the limits of a double.
  double minProductTemperature, maxProductTemperature;  // K
  double gasConstant;                                   // J/mol/K
  double logStandard;                                   // log2 of p0/R in mol K/m3
  double smallestConcentration;                         // mol/m3, of kinetics_powers.hpp
  BatchArray<BatchNasa7> nasa7;
  BatchArray<BatchNasa9Range> nasa9;
  BatchArray<BatchThirdBody> thirdBodies;
  BatchArray<BatchExponential> exponentials;
  BatchArray<BatchGiven> given;
  BatchArray<BatchThreeBody> threeBody;
  BatchArray<BatchFactorExponential> factorExponentials;
  BatchArray<BatchFalloff> lindemann;  // F = 1
  BatchArray<BatchFalloff> broadened;
  BatchArray<BatchPressureLog> pressureLog;
  BatchArray<BatchChebyshev> chebyshev;
  BatchArray<BatchGroup> groups;
  BatchArray<BatchGeneral> general;
  const BatchTerm* terms;
  const BatchPressureLevel* levels;
  const BatchPressureRate* pressureRates;
  const double* chebyshevCoefficients;
};

// Rows of a block, aligned to 64 bytes.
struct BatchWork {
  double* c;  // concentrations
  double* g;  // log2 (RT/p0 exp(g/RT))
  double* s;  // 2^-g: p0/RT exp(-g/RT)
  double* inverseS;
  double* z;        // c/s
  double* given;    // factors of the entries `given`
  double* M;        // of each third-body set
  double* logM;     // log2 of it, where a fall-off reaction asks
  double* factors;  // of each factor exponential
  double* centre;   // of each fall-off reaction with broadening: log2 Fcent, then log2 F
  double* E;        // of each entry: the rate constant without A
  double* X;        // log2 of it without the factor, and the factor: where products might overflow
  double* F;
  double* wdot;        // one row more than species
  double* wdotByLogs;  // the same
};

// Production rates of n states, see BatchKinetics::netProductionRates.
struct BatchStates {
  std::size_t n;
  const double* T;
  const double* c;
  std::size_t stride;
  double* wdot;
  std::size_t wdotStride;
  const double* given;  // the factors: that of entry i for state j at i * n + j
};

}  // namespace lampblack::chemistry
