// Requests that no machine meets, refused before anything is computed: more memory than there is, more output than
// anybody keeps. The estimates handed in are lower bounds, so that nothing is refused that would fit.
#pragma once

#include <mpi.h>

#include <string>

#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::io {

// Bytes that this process may still take: what the kernel calls available, swap included, less where its control group
// or the limit of its address space leave less.
double availableMemory();

// Collective; once, when the program starts. How many machines the ranks are on: what is spread over them may take so
// much more.
void countMachines(MPI_Comm comm);

// InputError at `key` where `bytes`, summed over ranks, are more than there are. `what` opens the message: "a mesh of
// 1000000000 cells".
void requireMemory(const Deck& deck, const std::string& key, const std::string& what, double bytes);

// InputError at `key` where `count` outputs (or rows) of `bytes` each are more than largestOutput.
inline constexpr double largestOutput = 64.0 * 1024 * 1024 * 1024;  // bytes
void requireOutputs(const Deck& deck, const std::string& key, const std::string& what, double count, double bytes);

}  // namespace lampblack::io
