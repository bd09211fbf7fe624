// Reference tables of tests/chemistry/data: a first line with the source, a header, then comma-separated values.
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "tests/every_module.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::test {

// A mechanism that ships, by its name.
inline Mechanism shipped(const std::string& name) {
  return Mechanism::fromFile(sourcePath("cases/mechanisms/" + name + ".yaml"));
}

inline const Mechanism& hydrogen() {
  static const auto mechanism = shipped("hydrogen_h2o2_10");
  return mechanism;
}

inline const Mechanism& ethylene() {
  static const auto mechanism = shipped("ethylene_bisetti2012_47");
  return mechanism;
}

class Table {
 public:
  explicit Table(const std::string& name) {
    std::ifstream file(sourcePath("tests/chemistry/data/" + name));
    if (!file) throw std::runtime_error("cannot open reference table " + name);
    std::string line;
    std::getline(file, line);  // source
    std::getline(file, line);
    header_ = split(line);
    while (std::getline(file, line)) rows_.push_back(split(line));
  }

  std::size_t size() const { return rows_.size(); }
  const std::string& text(std::size_t row, const std::string& column) const { return rows_[row][index(column)]; }
  double number(std::size_t row, const std::string& column) const {
    return std::strtod(text(row, column).c_str(), nullptr);
  }
  // Columns "X_<species>" of one row, negative values cut off, normalised.
  std::vector<double> moleFractions(std::size_t row, const Mechanism& mechanism) const {
    std::vector<double> X(mechanism.numSpecies());
    double sum = 0;
    for (std::size_t k = 0; k < X.size(); ++k) {
      X[k] = std::max(0.0, number(row, "X_" + mechanism.speciesName(k)));
      sum += X[k];
    }
    for (double& x : X) x /= sum;
    return X;
  }

 private:
  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
  }
  std::size_t index(const std::string& column) const {
    for (std::size_t i = 0; i < header_.size(); ++i)
      if (header_[i] == column) return i;
    throw std::runtime_error("no column " + column);
  }

  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace lampblack::test
