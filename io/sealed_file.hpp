// Files that are whole or not there: a finished file gets a last line with its size and a checksum of every byte before
// it, and only then its name. A file that was cut off, or of which one bit has changed, does not fit its seal, and is
// refused before anything reads its contents.
#pragma once

#include <mpi.h>

#include <filesystem>
#include <string>

#include "core/modules.hpp"

namespace lampblack::io {

// Collective. Seals the finished file `temporary`, makes sure that it is on the disk, and renames it to `path`.
// SystemError or InputError, as refuseWrite(), where that fails.
void sealAndRename(MPI_Comm comm, const std::filesystem::path& temporary, const std::filesystem::path& path);

// Collective. Empty where the file is whole, else what is wrong with it, in words that follow its name ("is cut off").
std::string sealProblem(MPI_Comm comm, const std::filesystem::path& path);

}  // namespace lampblack::io
