// A table of two columns from a file, for what a deck gives by points.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/units.hpp"

namespace lampblack::app {

struct TwoColumns {
  std::vector<double> points, values;  // SI; the points rise
};

// Numbers separated by commas or semicolons, as in io/csv.hpp, or blanks. The first line may be a header: one without
// any number, with units behind the names or without, also in a comment right above the first row; other lines that
// begin with # are skipped. `example`: a header, for messages. `check`: refuses a value by an InputError. InputError
// with file and line.
TwoColumns readTwoColumns(const std::filesystem::path& path, const units::Dimension& pointDimension,
                          const units::Dimension& valueDimension, const std::string& example,
                          const std::function<void(double)>& check);

}  // namespace lampblack::app
