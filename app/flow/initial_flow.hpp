// The results of an earlier run of a flow, laid over the mesh of another.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/flow/flow_case_parts.hpp"
#include "core/modules.hpp"
#include "flow/initial_fields.hpp"
#include "io/deck.hpp"

namespace lampblack::app::flowcase {

// Keys `initial.flow.*`.
void addInitialFlowKeys(DeckSchema& schema);

// Gas, velocity and carried scalars of an earlier flow, between cells linearly. `scalars`: names of those that this run
// carries. InputError where the file holds no such results, or those of another geometry, a smaller domain, other
// species or other scalars.
InitialFields readInitialFlow(const Deck& deck, const FlowCase& flowCase, const std::vector<std::string>& scalars);

// The same of the results of a run, or the part of them that it wrote; `time` in s, nothing: the last output.
InitialFields readEarlierFlow(const std::filesystem::path& file, std::optional<double> time, const FlowCase& flowCase,
                              const std::vector<std::string>& scalars);
// Names of what the case's model of particles carries.
std::vector<std::string> carriedNames(const FlowCase& flowCase);

}  // namespace lampblack::app::flowcase
