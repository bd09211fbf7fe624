// Values over one or more coordinates from a CSV table, linear between its points and constant beyond them. The columns
// that have the name of a coordinate span a grid, and there is a row for each of its points, in any order. A name may
// have its unit behind it, "velocity [cm/s]"; without one the column is in SI.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "io/units.hpp"

namespace lampblack::io {

class GridTable {
 public:
  static constexpr std::size_t maxCoordinates = 4;

  // `coordinates`: names and what they are measured in; a table has at least one of them. `dimensionOf`: the dimension
  // of any other column, or nothing for columns that are left out. InputError where the file is no such table.
  struct Coordinate {
    std::string name;
    units::Dimension dimension;
  };
  using DimensionOf = std::function<std::optional<units::Dimension>(const std::string& name)>;
  GridTable(const std::filesystem::path& file, std::vector<Coordinate> coordinates, const DimensionOf& dimensionOf);

  // The same of numbers in SI that are read already.
  struct Numbers {
    std::vector<std::vector<double>> places;  // of each coordinate a value for every row; empty: does not depend on it
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;  // a value for every row
  };
  GridTable(std::vector<Coordinate> coordinates, const Numbers& numbers);

  // Names of the columns of values.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] bool has(const std::string& name) const;
  // Whether the table depends on a coordinate; the others do not change its values.
  [[nodiscard]] bool dependsOn(const std::string& coordinate) const;
  // Value of a column at a place given by all coordinates, in their order, in SI.
  [[nodiscard]] double value(std::size_t column, std::span<const double> place) const;
  // Smallest and largest of a coordinate's points that the table depends on.
  [[nodiscard]] std::pair<double, double> range(const std::string& coordinate) const;

 private:
  struct Axis {
    std::size_t coordinate;  // its place among the coordinates
    std::vector<double> points;
  };
  void build(const Numbers& numbers, const std::string& there = {});  // `there`: for messages, the columns there are

  std::vector<Coordinate> coordinates_;
  std::vector<Axis> axes_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> values_;  // of each column, the last axis fastest
};

// Of rows in a plane, some of whose places are missing: there the values are those of a row next to them, so that the
// rows span a grid.
void fillHoles(GridTable::Numbers& numbers);

}  // namespace lampblack::io
