#include "io/gmsh_reader.hpp"

#include <cmath>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <string>

#include "core/errors.hpp"
#include "io/gmsh_assembly.hpp"
#include "io/gmsh_sections.hpp"
#include "io/gmsh_shares.hpp"

namespace lampblack::io {
namespace {

GmshPlan planOf(const GmshSections& sections) {
  GmshPlan plan;
  plan.dimension = sections.dimension();
  plan.groupedOnly = sections.grouped(plan.dimension) > 0;
  plan.cells = plan.groupedOnly ? sections.grouped(plan.dimension) : sections.elements(plan.dimension);
  for (const auto& [group, name] : sections.groups(plan.dimension - 1)) {
    plan.groups.push_back(group);
    plan.groupNames.push_back(name);
  }
  plan.notes = sections.notes();
  return plan;
}

// Of rank 0.
GmshPlan readAndSend(MPI_Comm comm, const std::filesystem::path& file, std::size_t portion, GmshShare& share) {
  GmshSender sender(comm, share, portion);
  std::exception_ptr failure;
  GmshPlan plan;
  try {
    GmshSections sections(file, sender);
    sections.read();
    plan = planOf(sections);
  } catch (...) {
    failure = std::current_exception();
  }
  sender.end();
  if (failure) std::rethrow_exception(failure);
  return plan;
}

// Collective: what rank 0 knows, to all.
void broadcastPlan(MPI_Comm comm, GmshPlan& plan) {
  std::string names;  // which have no ends of lines
  for (const std::string& name : plan.groupNames) names += name + '\n';
  for (const std::string& note : plan.notes) names += note + '\n';
  std::int64_t numbers[5] = {plan.dimension, plan.groupedOnly ? 1 : 0, plan.cells,
                             static_cast<std::int64_t>(plan.groups.size()), static_cast<std::int64_t>(names.size())};
  MPI_Bcast(numbers, 5, MPI_INT64_T, 0, comm);
  plan.dimension = static_cast<int>(numbers[0]);
  plan.groupedOnly = numbers[1] != 0;
  plan.cells = numbers[2];
  plan.groups.resize(static_cast<std::size_t>(numbers[3]));
  names.resize(static_cast<std::size_t>(numbers[4]));
  MPI_Bcast(plan.groups.data(), static_cast<int>(plan.groups.size()), MPI_INT64_T, 0, comm);
  MPI_Bcast(names.data(), static_cast<int>(names.size()), MPI_CHAR, 0, comm);
  plan.groupNames.clear();
  plan.notes.clear();
  std::istringstream lines(names);
  for (std::string line; std::getline(lines, line);)
    (plan.groupNames.size() < plan.groups.size() ? plan.groupNames : plan.notes).push_back(line);
}

}  // namespace

MeshBlock readGmsh(MPI_Comm comm, const std::filesystem::path& file, double scale, std::size_t portion,
                   std::vector<std::string>* notes) {
  if (!(scale > 0) || !std::isfinite(scale)) throw std::logic_error("the scale of a mesh file is not a length above 0");
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  GmshShare share;
  GmshPlan plan;
  collectively(comm, [&] {
    if (rank == 0)
      plan = readAndSend(comm, file, portion, share);
    else
      receiveGmshShare(comm, share);
  });
  broadcastPlan(comm, plan);
  if (notes != nullptr) *notes = plan.notes;
  try {
    return assembleGmsh(comm, share, plan, scale);
  } catch (const InputError& error) {
    // Raised on all ranks; the file's name is added on all of them.
    const std::string message = file.string() + ": " + error.what();
    collectively(comm, [&] { throw InputError(message); });
    throw;
  }
}

}  // namespace lampblack::io
