#include "io/grid_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/errors.hpp"
#include "core/text_file.hpp"
#include "io/csv.hpp"
#include "io/table_columns.hpp"

namespace lampblack::io {

GridTable::GridTable(const std::filesystem::path& file, std::vector<Coordinate> coordinates,
                     const DimensionOf& dimensionOf)
    : coordinates_(std::move(coordinates)) {
  const TextTable table = readCsv(readTextFile(file, "a table"));
  Numbers numbers;
  numbers.places.resize(coordinates_.size());
  try {
    const TableColumns columns(table);
    for (std::size_t column = 0; column < columns.size(); ++column) {
      const std::string& name = columns.name(column);
      const auto coordinate =
          std::ranges::find_if(coordinates_, [&](const Coordinate& known) { return known.name == name; });
      const bool isCoordinate = coordinate != coordinates_.end();
      const auto dimension = isCoordinate ? coordinate->dimension : dimensionOf(name);
      if (!dimension) continue;
      static_cast<void>(columns.find({name}));  // refuses another of this name
      std::vector<double> values = columns.read(column, *dimension);
      if (isCoordinate) {
        numbers.places[static_cast<std::size_t>(coordinate - coordinates_.begin())] = std::move(values);
      } else {
        numbers.names.push_back(name);
        numbers.columns.push_back(std::move(values));
      }
    }
    build(numbers, fmt::format("; found {}", columns.listed()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

GridTable::GridTable(std::vector<Coordinate> coordinates, const Numbers& numbers)
    : coordinates_(std::move(coordinates)) {
  build(numbers);
}

void GridTable::build(const Numbers& numbers, const std::string& there) {
  if (coordinates_.size() > maxCoordinates) throw std::logic_error("GridTable: too many coordinates");
  names_ = numbers.names;
  if (names_.empty()) throw InputError("no column has a name that counts here" + there);
  const std::size_t rows = numbers.columns[0].size();
  if (rows == 0) throw InputError("the table has no rows");

  std::size_t points = 1;
  for (std::size_t i = 0; i < numbers.places.size(); ++i) {
    if (numbers.places[i].empty()) continue;
    Axis axis{i, numbers.places[i]};
    std::ranges::sort(axis.points);
    axis.points.erase(std::unique(axis.points.begin(), axis.points.end()), axis.points.end());
    points *= axis.points.size();
    axes_.push_back(std::move(axis));
  }
  if (axes_.empty()) {
    std::vector<std::string> known;
    for (const Coordinate& coordinate : coordinates_) known.push_back(coordinate.name);
    throw InputError(fmt::format("expected a column of one of: {}{}", fmt::join(known, ", "), there));
  }
  if (points != rows)
    throw InputError(fmt::format(
        "its coordinates span a grid of {} points, but there are {} rows; expected a row for each", points, rows));
  values_.assign(names_.size(), std::vector<double>(points, NAN));
  for (std::size_t row = 0; row < points; ++row) {
    std::size_t at = 0;
    for (const Axis& axis : axes_) {
      const auto found = std::ranges::lower_bound(axis.points, numbers.places[axis.coordinate][row]);
      at = at * axis.points.size() + static_cast<std::size_t>(found - axis.points.begin());
    }
    if (!std::isnan(values_[0][at])) throw InputError(fmt::format("row {} has the place of another row", row + 1));
    for (std::size_t column = 0; column < names_.size(); ++column) values_[column][at] = numbers.columns[column][row];
  }
}

bool GridTable::has(const std::string& name) const {
  return std::ranges::find(names_, name) != names_.end();
}

bool GridTable::dependsOn(const std::string& coordinate) const {
  return std::ranges::any_of(axes_, [&](const Axis& axis) { return coordinates_[axis.coordinate].name == coordinate; });
}

std::pair<double, double> GridTable::range(const std::string& coordinate) const {
  for (const Axis& axis : axes_)
    if (coordinates_[axis.coordinate].name == coordinate) return {axis.points.front(), axis.points.back()};
  return {0.0, 0.0};
}

double GridTable::value(std::size_t column, std::span<const double> place) const {
  // Of each axis the point before the place and the share of the one after it.
  std::array<std::pair<std::size_t, double>, maxCoordinates> cell;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Axis& axis = axes_[i];
    const std::vector<double>& points = axis.points;
    const double x = std::clamp(place[axis.coordinate], points.front(), points.back());
    const auto after = std::ranges::upper_bound(points, x);
    const auto last = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - points.begin() - 1, 0));
    const std::size_t before = std::min(last, points.size() < 2 ? 0 : points.size() - 2);
    const double share = points.size() < 2 ? 0.0 : (x - points[before]) / (points[before + 1] - points[before]);
    cell[i] = {before, share};
  }
  double sum = 0.0;
  for (std::size_t corner = 0; corner < (std::size_t{1} << axes_.size()); ++corner) {
    double weight = 1.0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const bool isAfter = (corner >> i) & 1U;
      weight *= isAfter ? cell[i].second : 1.0 - cell[i].second;
      at = at * axes_[i].points.size() + cell[i].first + (isAfter && weight > 0.0 ? 1 : 0);
    }
    if (weight > 0.0) sum += weight * values_[column][at];
  }
  return sum;
}

void fillHoles(GridTable::Numbers& numbers) {
  std::array<std::vector<double>, 2> points;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    points[axis] = numbers.places[axis];
    std::ranges::sort(points[axis]);
    points[axis].erase(std::unique(points[axis].begin(), points[axis].end()), points[axis].end());
  }
  const std::size_t rows = numbers.places[0].size(), across = points[1].size(), all = points[0].size() * across;
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> rowAt(all, none), found;
  for (std::size_t row = 0; row < rows; ++row) {
    std::size_t at = 0;
    for (std::size_t axis = 0; axis < 2; ++axis)
      at = at * across + static_cast<std::size_t>(std::ranges::lower_bound(points[axis], numbers.places[axis][row]) -
                                                  points[axis].begin());
    rowAt[at] = row;
    found.push_back(at);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::size_t at = found[i];
    const auto visit = [&](bool isThere, std::size_t next) {
      if (!isThere || rowAt[next] != none) return;
      rowAt[next] = rowAt[at];
      found.push_back(next);
      numbers.places[0].push_back(points[0][next / across]);
      numbers.places[1].push_back(points[1][next % across]);
      for (std::vector<double>& column : numbers.columns) column.push_back(column[rowAt[at]]);
    };
    visit(at % across > 0, at - 1);
    visit(at % across + 1 < across, at + 1);
    visit(at >= across, at - across);
    visit(at + across < all, at + across);
  }
}

}  // namespace lampblack::io
