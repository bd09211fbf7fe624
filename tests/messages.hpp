// What an error says.
#pragma once

#include <exception>
#include <string>

#include "tests/every_module.hpp"

namespace lampblack::test {

// Runs `work` and returns the message of the `Error` it throws (empty: threw nothing; "other: ..." for another type).
template <typename Error, typename Work>
std::string messageOf(Work&& work) {
  try {
    work();
  } catch (const Error& e) {
    return e.what();
  } catch (const std::exception& e) {
    return std::string("other: ") + e.what();
  }
  return {};
}

}  // namespace lampblack::test
