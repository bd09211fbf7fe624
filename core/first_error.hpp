// Errors that come up on several ranks: which of them is told, the same on any number of ranks.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <exception>

namespace lampblack {

// Collective, one reduction. As raiseCollectively, with the error of the smallest `order` (not negative) of any rank.
void raiseFirst(MPI_Comm comm, const std::exception_ptr& error, std::int64_t order);

// Collective: where all ranks come to the same error. The error is raised on all of them, which may go on together.
template <typename Error>
[[noreturn]] void raiseTogether(MPI_Comm comm, const Error& error) {
  raiseFirst(comm, std::make_exception_ptr(error), 0);
  throw error;  // not reached
}

}  // namespace lampblack
