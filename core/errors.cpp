#include "core/errors.hpp"

#include <limits>
#include <new>
#include <vector>

#include "core/first_error.hpp"
#include "core/parallel_session.hpp"
#include "core/stop_request.hpp"
#include "core/system_error.hpp"

namespace lampblack {
namespace {

enum class Kind : int { bug = 1, input = 2, numerics = 3, system = 4, stopped = 5 };

struct Failure {
  Kind kind = Kind::bug;
  std::string message;
  int signal = 0;  // of Kind::stopped
};

Failure describe(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const InputError& e) {
    return {Kind::input, e.what()};
  } catch (const NumericsError& e) {
    return {Kind::numerics, e.what()};
  } catch (const SystemError& e) {
    return {Kind::system, e.what()};
  } catch (const std::bad_alloc&) {
    return {Kind::system, outOfMemory().what()};
  } catch (const Stopped& e) {
    return {Kind::stopped, e.what(), e.signal()};
  } catch (const std::exception& e) {
    return {Kind::bug, e.what()};
  } catch (...) {
    return {Kind::bug, "an exception that is not a std::exception"};
  }
}

// An error that every rank has raised: the error it is, and a mark to know it by.
struct CollectiveMark {
  virtual ~CollectiveMark() = default;
};
template <typename Error>
struct Collective : Error, CollectiveMark {
  using Error::Error;
};

}  // namespace

SystemError outOfMemory() {
  return SystemError("out of memory: this machine has no more to give; a smaller case or another machine is needed");
}

bool isCollective(const std::exception& error) {
  return dynamic_cast<const CollectiveMark*>(&error) != nullptr;
}

void raiseCollectively(MPI_Comm comm, const std::exception_ptr& error) {
  raiseFirst(comm, error, 0);
}

void raiseFirst(MPI_Comm comm, const std::exception_ptr& error, std::int64_t order) {
  if (!ParallelSession::runs()) {  // a process by itself, in a command that needs no MPI
    if (error) std::rethrow_exception(error);
    return;
  }
  int rank = 0;
  int size = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  std::int64_t first = error ? order * size + rank : none;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT64_T, MPI_MIN, comm);
  if (first == none) return;
  const auto firstFailing = static_cast<int>(first % size);

  Failure failure;
  if (rank == firstFailing) failure = describe(error);
  int header[3] = {static_cast<int>(failure.kind), static_cast<int>(failure.message.size()), failure.signal};
  MPI_Bcast(header, 3, MPI_INT, firstFailing, comm);
  failure.message.resize(static_cast<std::size_t>(header[1]));
  MPI_Bcast(failure.message.data(), header[1], MPI_CHAR, firstFailing, comm);
  switch (static_cast<Kind>(header[0])) {
    case Kind::input:
      throw Collective<InputError>(failure.message);
    case Kind::numerics:
      throw Collective<NumericsError>(failure.message);
    case Kind::system:
      throw Collective<SystemError>(failure.message);
    case Kind::stopped:
      throw Collective<Stopped>(header[2], failure.message);
    case Kind::bug:
      break;
  }
  throw Collective<std::runtime_error>(failure.message);
}

void collectively(MPI_Comm comm, const std::function<void()>& work) {
  std::exception_ptr error;
  try {
    work();
  } catch (...) {
    error = std::current_exception();
  }
  raiseCollectively(comm, error);
}

}  // namespace lampblack
