// The third way a run may end in error, beside those of errors.hpp: the machine fails it. raiseCollectively keeps its
// type, and makes it of std::bad_alloc.
#pragma once

#include <stdexcept>

namespace lampblack {

// A full disk, no memory, a file that cannot be written any more: nothing is wrong with the input or the numbers. The
// message says what was wanted, what is left and what was lost. Exit code 3.
class SystemError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What std::bad_alloc means to the user.
SystemError outOfMemory();

}  // namespace lampblack
