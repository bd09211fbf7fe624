// What a repeat of a reactor with stochastic particles leaves: the columns of a row, and a row of numbers with all that
// is summed up over the repeats.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "app/problems/reactor/reactor_kind.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"

namespace lampblack::app {

// Bins of the distributions of numbers from zero to one.
inline constexpr std::size_t shareBins = 50;

// Whether gas and particles together keep their energy.
[[nodiscard]] bool keepsEnergy(const ReactorCase& reactorCase);

// Of a whole row, `hasElements` with the balance of elements.
[[nodiscard]] std::vector<Quantity> ensembleColumns(const ReactorCase& reactorCase, bool hasElements);
// Numbers of the columns for the console, of each reactor.
[[nodiscard]] std::vector<std::size_t> shownColumns(const ReactorCase& reactorCase,
                                                    const std::vector<Quantity>& columns);

// Where the numbers of a repeat stand.
struct ReactorRepeatShape {
  enum Work : std::size_t { isWhole, steps, rejected, gasSteps, unchecked, time, works };
  std::size_t rows = 0;
  std::size_t columns = 0;    // of a row
  std::size_t densities = 0;  // bins of all distributions of all reactors, of a row
  std::size_t classes = 0;    // numbers of all classes of all reactors, of a row
  std::size_t counts = 0;

  [[nodiscard]] std::size_t rowSize() const { return columns + densities + classes; }
  [[nodiscard]] std::size_t size() const { return works + counts + rows * rowSize(); }
};

// The parts of a repeat's numbers, to be read or written.
template <class Number>
class ReactorRepeatNumbers {
 public:
  ReactorRepeatNumbers(const ReactorRepeatShape& shape, std::span<Number> numbers) : shape_(shape), numbers_(numbers) {}
  [[nodiscard]] Number& work(ReactorRepeatShape::Work which) const { return numbers_[which]; }
  [[nodiscard]] std::span<Number> counts() const { return numbers_.subspan(ReactorRepeatShape::works, shape_.counts); }
  [[nodiscard]] std::span<Number> columns(std::size_t row) const { return part(row, 0, shape_.columns); }
  [[nodiscard]] std::span<Number> densities(std::size_t row) const {
    return part(row, shape_.columns, shape_.densities);
  }
  [[nodiscard]] std::span<Number> classes(std::size_t row) const {
    return part(row, shape_.columns + shape_.densities, shape_.classes);
  }

 private:
  [[nodiscard]] std::span<Number> part(std::size_t row, std::size_t from, std::size_t count) const {
    return numbers_.subspan(ReactorRepeatShape::works + shape_.counts + row * shape_.rowSize() + from, count);
  }
  ReactorRepeatShape shape_;
  std::span<Number> numbers_;
};

}  // namespace lampblack::app
