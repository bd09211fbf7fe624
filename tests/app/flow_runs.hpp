// Decks of flows with a shipped mechanism, and runs of them in process.
#pragma once

#include <mpi.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/problems/flow/flow_loop.hpp"
#include "io/checkpoint_folder.hpp"
#include "io/hdf5_reader.hpp"
#include "tests/app/app_fixture.hpp"

namespace lampblack::test {

// `text`: all of the deck but the problem and the mechanism, which is a file of cases/mechanisms.
inline Deck flowDeck(const std::string& mechanism, const std::string& text, const std::vector<std::string>& overrides) {
  return Deck::parse("problem: flow\nmechanism: " + sourcePath("cases/mechanisms/" + mechanism) + "\n" + text,
                     "deck.yaml", overrides, flowSchema());
}

// On all ranks, to its end, with results in the folder. `restart`: a checkpoint or a folder with some; `more`: an
// operator beside those of the deck.
inline RunRecord runFlow(const Deck& deck, const std::filesystem::path& path,
                         const std::optional<std::filesystem::path>& restart = {}, Operator* more = nullptr) {
  FlowLoop loop(MPI_COMM_WORLD, readFlowCase(deck));
  if (more != nullptr) loop.addOperator(*more);
  if (restart)
    loop.load(restart->extension() == ".h5" ? wholeCheckpoint(MPI_COMM_WORLD, *restart)
                                            : newestCheckpoint(MPI_COMM_WORLD, *restart));
  loop.run(RunFolder::prepare(path, false, MPI_COMM_WORLD), {"test", "none", {}, "now"});
  RunRecord record;
  loop.report(1.0, record);
  return record;
}

// A field of the last state that a run wrote.
inline std::vector<double> lastOf(const Hdf5Reader& results, const std::string& field) {
  return results.numbers("/steps/" + results.names("/steps").back() + "/" + field);
}

}  // namespace lampblack::test
