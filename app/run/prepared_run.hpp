// What a deck comes to before its first step. `lampblack check` makes it and says what it is, `lampblack run` makes it
// and goes on: what the one refuses is refused by the other, with the same words, and before there is a folder.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/run/recorded_run.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"

namespace lampblack::app {

class PreparedRun {
 public:
  virtual ~PreparedRun() = default;

  // What is there, in a few words ("47 species, ...").
  [[nodiscard]] virtual std::string summary() const = 0;
  // What more there is to know of it, a line each.
  [[nodiscard]] virtual std::vector<std::string> details() const { return {}; }
  // Collective, once. From the first step to the report. InputError where the folder cannot be used, NumericsError as
  // they come; the run folder then says so.
  virtual void run(const RunOptions& options) = 0;

 protected:
  PreparedRun() = default;
  PreparedRun(const PreparedRun&) = delete;
  PreparedRun& operator=(const PreparedRun&) = delete;
};

// A run whose deck comes to a case that `read` reads, on each rank.
template <typename Case>
class PreparedRunOf : public PreparedRun {
 protected:
  PreparedRunOf(MPI_Comm comm, const Deck& deck, Case (*read)(const Deck&)) : comm_(comm), deck_(deck) {
    MPI_Comm_rank(comm, &rank_);
    MPI_Comm_size(comm, &ranks_);
    collectively(comm, [&] { case_ = read(deck); });
  }

  MPI_Comm comm_;
  const Deck& deck_;
  int rank_ = 0, ranks_ = 1;
  Case case_;
};

// What a row of the table of problems has, where the run is made of communicator and deck alone.
template <typename Run>
std::unique_ptr<PreparedRun> preparedAs(MPI_Comm comm, const Deck& deck) {
  return std::make_unique<Run>(comm, deck);
}

}  // namespace lampblack::app
