// A quantity as results name it: a column of a table, a field, a scalar.
#pragma once

#include <string>

namespace lampblack {

struct Quantity {
  std::string name, unit, description;
};

}  // namespace lampblack
