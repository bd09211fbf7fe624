// The results of an earlier run of a flow, laid over the mesh of another.
#pragma once

#include <filesystem>
#include <optional>

#include "app/problems/flow/flow_case_parts.hpp"
#include "core/modules.hpp"
#include "flow/initial_fields.hpp"
#include "io/deck.hpp"

namespace lampblack::app::flowcase {

// Keys `initial.flow.*`.
void addInitialFlowKeys(DeckSchema& schema);

// Gas, velocity and carried scalars of an earlier flow, between cells linearly. Species are matched by name: those that
// the mechanism has and the earlier one has not are zero, those that it lacks are left out and the others scaled to sum
// one. Carried scalars are taken where all of this run's model are there. What is left out becomes notes of `flowCase`.
// Of a bent box by columns and shares of the height, as cells beside a bent wall are thinner than what it bends by.
// InputError where the file holds no such results, or those of another geometry or a smaller domain, or where more than
// a few percent of the mass of a cell would be left out.
InitialFields readInitialFlow(const Deck& deck, FlowCase& flowCase);

// Of which deck the earlier run is: of this one on a coarser mesh, so that a bent box is the same however its floor
// runs between the columns of the coarser, or of any other, whose floor and ceiling are compared.
enum class EarlierDeck { ThisOne, AnyOther };

// The same of the results of a run, or the part of them that it wrote; `time` in s, nothing: the last output.
InitialFields readEarlierFlow(const std::filesystem::path& file, std::optional<double> time, FlowCase& flowCase,
                              EarlierDeck earlierDeck);

}  // namespace lampblack::app::flowcase
