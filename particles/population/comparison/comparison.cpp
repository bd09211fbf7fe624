#include "particles/population/comparison/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <span>

#include "core/errors.hpp"
#include "core/repeats.hpp"
#include "core/stop_request.hpp"
#include "core/timers.hpp"
#include "particles/population/comparison/method_accumulator.hpp"
#include "particles/population/comparison/repeat_record.hpp"

namespace lampblack::particles {
namespace {

struct Ranks {
  MPI_Comm comm;
  int rank = 0, size = 1;

  explicit Ranks(MPI_Comm all) : comm(all) {
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
  }
};

ExactReference makeReference(const PopulationCase& populationCase, const ExactSolution* solution) {
  ExactReference reference;
  if (solution == nullptr) return reference;
  reference.name = solution->name();
  reference.gelation = solution->gelationTime();
  double last = std::numeric_limits<double>::infinity();  // s, for which the solution can be evaluated
  const auto holds = [&](double time) { return time <= last && (!reference.gelation || time < *reference.gelation); };
  double reached = 0;
  for (const double time : populationCase.times.rows()) {
    FourMoments row{noValue, noValue, noValue, noValue};
    try {
      const auto moments = holds(time) ? solution->moments(time) : std::array<std::optional<double>, 4>{};
      for (std::size_t k = 0; k < 4; ++k) row[k] = moments[k].value_or(noValue);
      reached = time;
    } catch (const InputError& error) {
      last = reached;
      reference.limit =
          fmt::format("nothing is compared with the exact solution from t = {:g} s on: {}", time, error.what());
    }
    reference.moments.push_back(row);
  }
  const PopulationBins& bins = populationCase.bins;
  for (const double time : bins.times) {
    std::vector<double> number = holds(time) ? solution->numberInBins(time, bins.edges) : std::vector<double>{};
    if (number.empty()) break;
    reference.number.push_back(std::move(number));
  }
  return reference;
}

// The records of the methods that are run once, spread over the ranks; by the number of the method, on rank 0.
// `seconds` are those of this rank for each method.
std::map<std::size_t, std::vector<double>> runOnce(const Ranks& ranks, const PopulationCase& populationCase,
                                                   std::optional<double> gelation, const RepeatRecord::Shape& shape,
                                                   RepeatProgress& progress, std::vector<double>& seconds) {
  std::map<std::size_t, std::vector<double>> records;
  std::map<std::size_t, int> owners;
  for (std::size_t m = 0; m < populationCase.methods.size(); ++m)
    if (populationCase.methods[m].deterministic()) owners.emplace(m, static_cast<int>(owners.size()) % ranks.size);
  collectively(ranks.comm, [&] {
    for (const auto& [m, owner] : owners) {
      if (owner != ranks.rank && ranks.rank != 0) continue;
      std::vector<double>& record = records.emplace(m, std::vector<double>(shape.size())).first->second;
      const double begin = MPI_Wtime();
      if (owner == ranks.rank)
        runRepeat(populationCase, populationCase.methods[m], 0, gelation, shape, progress, record);
      seconds[m] += MPI_Wtime() - begin;
    }
  });
  for (const auto& [m, owner] : owners) {
    if (owner == 0) continue;
    const auto size = static_cast<int>(shape.size());
    const auto tag = static_cast<int>(m);
    if (ranks.rank == 0) MPI_Recv(records.at(m).data(), size, MPI_DOUBLE, owner, tag, ranks.comm, MPI_STATUS_IGNORE);
    if (ranks.rank == owner) MPI_Send(records.at(m).data(), size, MPI_DOUBLE, 0, tag, ranks.comm);
  }
  return records;
}

}  // namespace

std::optional<double> PopulationStatistics::gelation() const {
  std::optional<double> earliest;
  for (const MethodStatistics& method : methods)
    if (method.gelation) earliest = std::min(earliest.value_or(*method.gelation), *method.gelation);
  return earliest;
}

PopulationStatistics runPopulation(MPI_Comm comm, const PopulationCase& populationCase, RepeatProgress& progress) {
  const Ranks ranks(comm);
  PopulationStatistics made;
  made.rows = populationCase.times.rows();
  made.bins = populationCase.bins;
  std::unique_ptr<ExactSolution> solution;
  collectively(comm, [&] {
    solution = exactSolution(populationCase);
    if (ranks.rank == 0) made.exact = makeReference(populationCase, solution.get());
  });
  const std::optional<double> gelation = solution ? solution->gelationTime() : std::nullopt;
  const RepeatRecord::Shape shape{made.rows.size(), made.bins.times.size(),
                                  made.bins.edges.empty() ? 0 : made.bins.edges.size() - 1};
  const std::uint64_t most = repeatsAtATime(comm, shape.size());
  std::vector<double> seconds(populationCase.methods.size(), 0.0);
  const auto once = runOnce(ranks, populationCase, gelation, shape, progress, seconds);
  for (std::size_t m = 0; m < populationCase.methods.size(); ++m) {
    const PopulationMethod& method = populationCase.methods[m];
    MethodAccumulator accumulator(populationCase, method, made, shape);
    int whole = 0;  // repeats that came to their end, on rank 0
    const auto add = [&](const RepeatRecord& record) {
      if (!record.whole()) return;
      accumulator.add(record);
      ++whole;
    };
    if (method.deterministic() && ranks.rank == 0) add(RepeatRecord(shape, once.at(m)));
    const std::uint64_t repeats = method.deterministic() ? 0 : populationCase.repeats;
    for (std::uint64_t first = 0; first < repeats; first += most) {
      const std::uint64_t end = std::min(repeats, first + most);
      const std::vector<double> records =
          gatherRepeats(comm, first, end, shape.size(), [&](std::uint64_t repeat, std::span<double> record) {
            const double begin = MPI_Wtime();
            runRepeat(populationCase, method, repeat, gelation, shape, progress, record);
            seconds[m] += MPI_Wtime() - begin;
          });
      int gelled = 0;
      for (std::size_t at = 0; at < records.size(); at += shape.size()) {
        const RepeatRecord record(shape, std::span(records).subspan(at, shape.size()));
        add(record);
        gelled = gelled != 0 || record.gelation() ? 1 : 0;
      }
      MPI_Bcast(&gelled, 1, MPI_INT, 0, comm);
      made.stop = agreedStopRequest(comm);
      if (gelled != 0 || made.stop != 0) break;
    }
    made.stop = std::max(made.stop, agreedStopRequest(comm));
    const Timers::Stage stage = Timers::overRanks(comm, method.name, seconds[m]);
    if (ranks.rank != 0 || whole == 0) continue;
    made.methods.push_back(accumulator.finish());
    made.methods.back().stage = stage;
  }
  return made;
}

}  // namespace lampblack::particles
