// Reads a whole text file. Only a regular file has an end: a folder, a pipe or a device is refused before it is opened.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace lampblack {

inline constexpr std::uintmax_t largestText = 256U << 20U;  // bytes; the largest mechanism published has 20 MB

// The file's text, in UTF-8 also where it is in UTF-16 with a byte-order mark (as spreadsheets and shells of Windows
// write), without this mark; lines that end with a carriage return alone, as on old Macintoshes, end with a line feed.
// InputError where it is missing, no regular file, larger than `limit` (bytes), empty or cannot be read; `what` says
// what the file is to be: "a deck".
std::string readTextFile(const std::filesystem::path& path, const std::string& what,
                         std::uintmax_t limit = largestText);

}  // namespace lampblack
