// The two ways a run may end in error. Anything else that is thrown is a bug in Lampblack.
#pragma once

#include <stdexcept>
#include <string>

namespace lampblack {

// The user's input is wrong: the message says where (file, line, key where known) and what was expected. Exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The numbers failed: the message says what failed, where and at which time. Exit code 3.
class NumericsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace lampblack
