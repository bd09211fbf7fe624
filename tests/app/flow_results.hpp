// What runs of flows have written, and comparisons of it: to the last bit, or to what ranks may differ in.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/hdf5_reader.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

struct Ran {
  std::map<std::string, std::vector<double>> fields, history, tables;
  std::int64_t partitions = 0;
};

inline Ran readBack(const std::filesystem::path& results) {
  const Hdf5Reader file(results);
  Ran ran;
  for (const std::string& step : file.names("/steps"))
    for (const std::string& field : file.names("/steps/" + step))
      ran.fields[step + "/" + field] = file.numbers("/steps/" + step + "/" + field);
  for (const std::string& column : file.names("/history")) {
    std::vector<double>& values = ran.history[column] = file.numbers("/history/" + column);
    std::ranges::replace_if(
        values, [](double value) { return std::isnan(value); }, -1.0);  // to compare them
  }
  for (const std::string group : {"/probes", "/boundaries"})
    for (const std::string& table : file.names(group))
      for (const std::string& column : file.names(group + "/" + table)) {
        const std::string path = group + "/" + table + "/" + column;
        if (column == "deposit") continue;  // a group
        ran.tables[path] = file.numbers(path);
      }
  return ran;
}

// What ranks differ in, and what is round-off.
inline bool isOwn(const std::string& name) {
  for (const char* part : {"imbalance", "error", "iterations", "steps", "cells", "minimum_mass_fraction", "undershoot",
                           "diameter", "retries", "pressure"})
    if (name.find(part) != std::string::npos) return true;
  return false;
}

// `tolerance`: of the largest value; the solvers' own are 1e-9 of the pressure and 1e-6 of the chemistry, whose steps
// fall otherwise.
inline void expectSameFields(const Ran& found, const Ran& expected, double tolerance = 1e-5) {
  ASSERT_EQ(found.fields.size(), expected.fields.size());
  ASSERT_EQ(found.history.size(), expected.history.size());
  ASSERT_EQ(found.tables.size(), expected.tables.size());
  ASSERT_FALSE(expected.tables.empty());
  for (const auto of : {&Ran::fields, &Ran::history, &Ran::tables})
    for (const auto& [name, values] : expected.*of) {
      if (isOwn(name)) continue;
      const std::vector<double>& others = (found.*of).at(name);
      ASSERT_EQ(others.size(), values.size()) << name;
      double scale = 0.0, difference = 0.0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        scale = std::max(scale, std::abs(values[i]));
        difference = std::max(difference, std::abs(others[i] - values[i]));
      }
      EXPECT_LE(difference, tolerance * scale + 1e-12) << name;
    }
  for (const auto& [name, values] : found.history)
    if (name.ends_with("budget_error")) {
      EXPECT_LT(*std::ranges::max_element(values), 1e-12) << name;
    }
}

inline void expectSameBits(const Ran& found, const Ran& expected) {
  for (const auto of : {&Ran::fields, &Ran::history, &Ran::tables}) {
    EXPECT_EQ((found.*of).size(), (expected.*of).size());
    for (const auto& [name, values] : expected.*of) {
      const auto at = (found.*of).find(name);
      EXPECT_TRUE(at != (found.*of).end() && at->second == values) << name;
    }
  }
}

}  // namespace lampblack::test
