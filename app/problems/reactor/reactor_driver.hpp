// One kind of reactor run. It is computed, by rank 0 or by all; then all ranks write together, and rank 0 says what
// came out.
#pragma once

#include <mpi.h>

#include <memory>

#include "app/problems/reactor/reactor_kind.hpp"
#include "app/run/recorded_run.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {

class ReactorDriver {
 public:
  virtual ~ReactorDriver() = default;

  // Collective: solves and writes the files of text. NumericsError on all ranks.
  virtual void run(MPI_Comm comm, const RunFolder& folder) = 0;
  // Collective: the tables of the results file.
  virtual void write(ResultsWriter& results) const = 0;
  // On rank 0: fields of the record's object "results", and the summary on the console.
  virtual void record(JsonWriter& json) const = 0;
  virtual void print() const = 0;
  virtual long steps() const = 0;
  virtual double simulatedTime() const = 0;  // s

 protected:
  ReactorDriver() = default;
  ReactorDriver(const ReactorDriver&) = default;
  ReactorDriver& operator=(const ReactorDriver&) = default;
};

// What one rank solves.
class ReactorOfOneRank : public ReactorDriver {
 public:
  void run(MPI_Comm comm, const RunFolder& folder) final {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    collectively(comm, [&] {
      if (rank == 0) compute(folder);
    });
  }

 protected:
  virtual void compute(const RunFolder& folder) = 0;
};

// Collective, of a recorded run: computes, writes the results and says what came out.
void runDriver(MPI_Comm comm, ReactorDriver& driver, const RunFolder& folder, const RunInfo& info, RunRecord& record);

// The drivers refer to the case and its kind, which have to live as long.
std::unique_ptr<ReactorDriver> closedReactorDriver(const ReactorCase& reactorCase, const ClosedKind& closed);
std::unique_ptr<ReactorDriver> plugFlowDriver(const ReactorCase& reactorCase, const PlugFlowKind& duct);
std::unique_ptr<ReactorDriver> stirredTransientDriver(const ReactorCase& reactorCase, const StirredKind& stirred);
std::unique_ptr<ReactorDriver> steadyNetworkDriver(const ReactorCase& reactorCase, const StirredKind& stirred);
std::unique_ptr<ReactorDriver> ensembleReactorDriver(const ReactorCase& reactorCase);

}  // namespace lampblack::app
