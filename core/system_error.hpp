// The third way a run may end in error, beside those of errors.hpp: the machine fails it. raiseCollectively keeps its
// type, and makes it of std::bad_alloc.
#pragma once

#include <stdexcept>

namespace lampblack {

// A full disk, no memory: the message says what was wanted and what is left. Exit code 3.
class SystemError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What std::bad_alloc means to the user.
SystemError outOfMemory();

}  // namespace lampblack
