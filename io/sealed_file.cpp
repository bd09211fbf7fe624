#include "io/sealed_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <vector>

#include "core/errors.hpp"
#include "io/disk_space.hpp"

namespace lampblack::io {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t sealSize = 64;
constexpr std::int64_t word = 8;

// A bijection of 64-bit words that spreads every bit over all others (the finaliser of SplitMix64; Steele, Lea, Flood
// 2014, fig. 17).
std::uint64_t spread(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

// Collective. The sum over all 8-byte words of a hash of word and place: the same on any number of ranks, each of which
// reads a part. One changed word always changes it. Nothing on all ranks where a rank cannot read the file.
std::optional<std::uint64_t> checksum(MPI_Comm comm, const fs::path& path, std::int64_t size) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  const std::int64_t words = (size + word - 1) / word;
  std::int64_t at = words * rank / ranks;
  const std::int64_t end = words * (rank + 1) / ranks;
  std::ifstream file(path, std::ios::binary);
  file.seekg(at * word);
  std::vector<std::uint64_t> buffer(std::size_t{1} << 17);
  std::uint64_t result[2] = {0, file ? 0U : 1U};  // sum, whether reading failed
  while (at < end && file) {
    const auto count = std::min<std::int64_t>(end - at, static_cast<std::int64_t>(buffer.size()));
    buffer[static_cast<std::size_t>(count - 1)] = 0;  // the last word of a file may be a part of one
    const std::int64_t bytes = std::min(count * word, size - at * word);
    file.read(reinterpret_cast<char*>(buffer.data()), bytes);
    if (file.gcount() != bytes) result[1] = 1;
    for (std::int64_t i = 0; i < count; ++i, ++at)
      result[0] += spread(buffer[static_cast<std::size_t>(i)] ^ spread(static_cast<std::uint64_t>(at) + 1));
  }
  MPI_Allreduce(MPI_IN_PLACE, result, 2, MPI_UINT64_T, MPI_SUM, comm);
  if (result[1] != 0) return std::nullopt;
  return result[0];
}

std::string sealOf(std::int64_t size, std::uint64_t sum) {
  return fmt::format("{:<{}}\n", fmt::format("\nlampblack seal {:020} {:016x}", size, sum), sealSize - 1);
}

std::int64_t fromRankZero(MPI_Comm comm, std::int64_t value) {
  MPI_Bcast(&value, 1, MPI_INT64_T, 0, comm);
  return value;
}

// 0, or the errno of what went wrong.
int appendAndSync(const fs::path& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file < 0) return errno;
  errno = 0;
  int error = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? 0 : errno;
  if (error == 0 && ::fsync(file) != 0) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

void sealAndRename(MPI_Comm comm, const fs::path& temporary, const fs::path& path) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::error_code error;
  const std::int64_t size =
      fromRankZero(comm, rank == 0 ? static_cast<std::int64_t>(fs::file_size(temporary, error)) : 0);
  const auto sum = checksum(comm, temporary, size);
  collectively(comm, [&] {
    if (rank != 0) return;
    if (!sum) refuseWrite(temporary, EIO);
    const int failure = appendAndSync(temporary, sealOf(size, *sum));
    if (failure != 0) refuseWrite(path, failure);
    std::error_code renaming;
    fs::rename(temporary, path, renaming);
    if (renaming) refuseWrite(path, renaming.value());
  });
}

std::string sealProblem(MPI_Comm comm, const fs::path& path) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::error_code error;
  std::int64_t size = -1;
  if (rank == 0 && fs::is_regular_file(path, error)) size = static_cast<std::int64_t>(fs::file_size(path, error));
  size = fromRankZero(comm, size);
  if (size < 0) return "is missing";
  if (size < sealSize) return "is cut off";
  const auto sum = checksum(comm, path, size - sealSize);
  if (!sum) return "cannot be read";
  std::string seal(sealSize, '\0');
  if (rank == 0) {
    std::ifstream file(path, std::ios::binary);
    file.seekg(size - sealSize);
    file.read(seal.data(), sealSize);
  }
  MPI_Bcast(seal.data(), sealSize, MPI_CHAR, 0, comm);
  if (seal == sealOf(size - sealSize, *sum)) return "";
  return seal.starts_with("\nlampblack seal ") ? "is damaged: its bytes do not fit their checksum"
                                               : "is cut off, or no checkpoint of Lampblack";
}

}  // namespace lampblack::io
