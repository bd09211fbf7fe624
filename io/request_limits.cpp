#include "io/request_limits.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

#include "io/report.hpp"

namespace lampblack::io {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
int machines = 1;

// The sum of the lines "Name:   123 kB" of a file of /proc that have one of the names, in bytes; unlimited where the
// system does not tell.
double kilobytesIn(const char* path, std::initializer_list<std::string> names) {
  std::ifstream file(path);
  double sum = 0;
  bool found = false;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name;
    double amount = 0;
    if (!(words >> name >> amount) || std::find(names.begin(), names.end(), name) == names.end()) continue;
    sum += 1024 * amount;
    found = true;
  }
  return found ? sum : unlimited;
}

// What is left to the control group; its limit may be the word "max".
double leftOfControlGroup() {
  std::ifstream limitFile("/sys/fs/cgroup/memory.max"), usedFile("/sys/fs/cgroup/memory.current");
  double limit = 0, used = 0;
  return limitFile >> limit && usedFile >> used ? limit - used : unlimited;
}

double leftOfAddressSpace() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return static_cast<double>(limit.rlim_cur) - kilobytesIn("/proc/self/status", {"VmSize:"});
}

}  // namespace

double availableMemory() {
  const double left = std::min(
      {kilobytesIn("/proc/meminfo", {"MemAvailable:", "SwapFree:"}), leftOfControlGroup(), leftOfAddressSpace()});
  return std::max(0.0, left);
}

void countMachines(MPI_Comm comm) {
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  int rank = 0;
  MPI_Comm_rank(here, &rank);
  MPI_Comm_free(&here);
  machines = rank == 0 ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &machines, 1, MPI_INT, MPI_SUM, comm);
}

void requireMemory(const Deck& deck, const std::string& key, const std::string& what, double bytes) {
  const double available = availableMemory() * machines;
  if (bytes <= available) return;
  throw deck.error(key, fmt::format("{} needs at least {} of memory; there are {}", what, formatBytes(bytes),
                                    formatBytes(available)));
}

void requireOutputs(const Deck& deck, const std::string& key, const std::string& what, double count, double bytes) {
  if (count * bytes <= largestOutput) return;
  throw deck.error(key, fmt::format("about {:.3g} {} would be written, {} in all; at most {} are sensible", count, what,
                                    formatBytes(count * bytes), formatBytes(largestOutput)));
}

}  // namespace lampblack::io
