// What integrates the gas of cells over an interval, with all but the reactions as a constant source. Another way to
// advance a cell is another class; ReactionOperator packs, shares and counts the cells for any.
#pragma once

#include <cstddef>
#include <span>

#include "core/modules.hpp"
#include "flow/models/combustion/cell_mixing.hpp"

namespace lampblack::flow {

class CellReactor {
 public:
  // At the beginning of the interval, beside the mass fractions. Gas and Result are what travels between ranks:
  // nothing but doubles.
  struct Gas {
    double enthalpy = 0.0;     // J/kg
    double heating = 0.0;      // W/kg, at which the enthalpy rises
    double temperature = 0.0;  // K, near that of the enthalpy
    double pressure = 0.0;     // Pa
    double firstStep = 0.0;    // s, Result::firstStep of the interval before; zero where there was none
    CellMixing mixing = {};
  };
  struct Result {
    double temperature = 0.0;   // K
    double firstStep = 0.0;     // s, for the next interval
    double cost = 0.0;          // microseconds of one processor, about; counted, not timed
    double steps = 0.0;         // of the stiff solver
    double retries = 0.0;       // of the stiff solver
    double isSkipped = 0.0;     // 1 or 0: reactions were too slow to be integrated
    double isHandedOver = 0.0;  // 1 or 0: the quick method did not do
  };
  struct Cell {
    Gas gas;
    std::span<double> Y;             // mass fractions, in and out
    std::span<const double> source;  // 1/s, of them, by all but the reactions
  };

  // Rates of the reactions in gas as it is, 1/s of the mass fractions, and where they are wanted their derivatives:
  // column-major, a row a species and one of no meaning; by mass fractions at constant pressure, then by temperature.
  struct Rates {
    std::span<double> values;
    std::span<double> slopes;  // empty: not wanted
  };
  struct Asked {
    Gas gas;  // by its temperature, pressure and mixing
    std::span<const double> Y;
    Rates rates;  // to be found
  };

  virtual ~CellReactor() = default;
  // How many cells are best advanced, or asked for their rates, at once.
  [[nodiscard]] virtual std::size_t cellsTogether() const = 0;
  // Over dt (s), a result a cell; that of a cell depends on this cell alone, to the last bit. FailureInGroup.
  virtual void advance(std::span<const Cell> cells, double dt, std::span<Result> results) = 0;
  // Those of a cell depend on this cell alone, to the last bit. NumericsError where one has none.
  virtual void rates(std::span<const Asked> cells) = 0;

 protected:
  CellReactor() = default;
  CellReactor(const CellReactor&) = default;
  CellReactor& operator=(const CellReactor&) = default;
};

}  // namespace lampblack::flow
