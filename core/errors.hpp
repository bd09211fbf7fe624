// The two ways a run may end in error, and how an error on one rank becomes the error of all. Anything else that is
// thrown is a bug in Lampblack.
#pragma once

#include <mpi.h>

#include <exception>
#include <functional>
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

// Collective. If any rank passes an exception, every rank throws the one of the lowest such rank, with its message and,
// for InputError and NumericsError, its type (std::runtime_error otherwise). Does nothing when no rank failed. Before
// MPI starts, the process is the only rank.
void raiseCollectively(MPI_Comm comm, const std::exception_ptr& error);

// Whether this error was raised on all ranks together, by raiseCollectively or collectively.
bool isCollective(const std::exception& error);

// Collective. Runs `work`, which must not communicate, and raises its failure on all ranks.
void collectively(MPI_Comm comm, const std::function<void()>& work);

}  // namespace lampblack
