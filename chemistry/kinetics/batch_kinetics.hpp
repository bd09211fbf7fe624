// Net production rates of many states at once, one state a vector lane: the batch counterpart of Kinetics for the same
// mechanisms, several times faster (Blowers-Masel and linear-Burke constants are computed one state after the other).
// The vector instructions (AVX-512, AVX2 and FMA, or what any processor has) are chosen when the program runs. An
// object holds its workspace, so use one per thread or rank.
//
// The rates of a state depend on its temperature and concentrations alone: not on its place in the batch, on the other
// states or on their number, to the last bit. Rates agree with Kinetics to round-off, and between instruction sets.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class BatchTables;

class BatchKinetics {
 public:
  enum class Instructions { Generic, Avx2, Avx512 };

  // States computed together: multiples make the best use of the processor.
  static constexpr std::size_t blockSize = 8;

  // Whether this processor (and this build) has them, and the best it has.
  static bool available(Instructions instructions);
  static Instructions best();
  static const char* name(Instructions instructions);
  // InputError where they are not available.
  static void demand(Instructions instructions);

  // Throws InputError for a reaction whose rate cannot be computed, or for instructions that are not available.
  explicit BatchKinetics(const Mechanism& mechanism, Instructions instructions = best());
  ~BatchKinetics();
  BatchKinetics(BatchKinetics&&) noexcept;
  BatchKinetics& operator=(BatchKinetics&&) noexcept;

  std::size_t numSpecies() const;
  Instructions instructions() const { return instructions_; }

  // Net molar production rates, mol/m3/s, of T.size() states (any number) with temperatures T in K and concentrations
  // in mol/m3: species k of state i is at [k * stride + i] of both arrays, stride >= T.size(); 0 means T.size().
  // Nothing else of the arrays is read or written; they must not overlap. Throws InputError if an array is too small,
  // and NumericsError where Kinetics does.
  void netProductionRates(std::span<const double> T, std::span<const double> concentrations, std::span<double> wdot,
                          std::size_t stride = 0);

 private:
  Instructions instructions_;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lampblack::chemistry
