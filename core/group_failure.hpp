// How one of several that are advanced together fails.
#pragma once

#include <cstddef>
#include <string>

#include "core/errors.hpp"

namespace lampblack {

class FailureInGroup : public NumericsError {
 public:
  FailureInGroup(const std::string& message, std::size_t place) : NumericsError(message), place_(place) {}
  [[nodiscard]] std::size_t place() const { return place_; }  // among them

 private:
  std::size_t place_;
};

}  // namespace lampblack
