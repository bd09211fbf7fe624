#include "core/work_sharing.hpp"

#include <algorithm>
#include <numeric>

#include "core/errors.hpp"

namespace lampblack {
namespace {

constexpr int itemsTag = 21;
constexpr int resultsTag = 22;

double imbalance(const std::vector<double>& cost) {
  const double sum = std::accumulate(cost.begin(), cost.end(), 0.0);
  const double most = *std::max_element(cost.begin(), cost.end());
  return sum > 0.0 ? most * static_cast<double>(cost.size()) / sum : 1.0;
}

}  // namespace

SharingPlan planSharing(const std::vector<double>& costOfRank, double tolerance) {
  SharingPlan plan;
  plan.imbalanceBefore = plan.imbalancePlanned = imbalance(costOfRank);
  std::vector<double> load = costOfRank;
  const double mean = std::accumulate(load.begin(), load.end(), 0.0) / static_cast<double>(load.size());
  // Each transfer brings at least one rank to the mean: fewer transfers than ranks.
  for (std::size_t i = 0; i + 1 < load.size(); ++i) {
    const auto busiest = std::max_element(load.begin(), load.end());
    const auto idlest = std::min_element(load.begin(), load.end());
    if (!(*busiest > mean * (1.0 + tolerance))) break;
    const double amount = std::min(*busiest - mean, mean - *idlest);
    if (!(amount > 0.0)) break;
    plan.transfers.push_back(
        {static_cast<int>(busiest - load.begin()), static_cast<int>(idlest - load.begin()), amount});
    *busiest -= amount;
    *idlest += amount;
  }
  plan.imbalancePlanned = imbalance(load);
  return plan;
}

WorkSharing::Statistics WorkSharing::run(const Items& items) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(comm_, &rank);
  MPI_Comm_size(comm_, &ranks);
  const std::size_t count = items.cost.size();

  double localCost = std::accumulate(items.cost.begin(), items.cost.end(), 0.0);
  std::vector<double> costOfRank(static_cast<std::size_t>(ranks));
  MPI_Allgather(&localCost, 1, MPI_DOUBLE, costOfRank.data(), 1, MPI_DOUBLE, comm_);
  SharingPlan plan = planSharing(costOfRank);
  if (!enabled_) plan.transfers.clear();

  // The dearest items travel, so that few of them do.
  std::vector<std::size_t> byCost(count);
  std::iota(byCost.begin(), byCost.end(), std::size_t{0});
  std::stable_sort(byCost.begin(), byCost.end(),
                   [&](std::size_t a, std::size_t b) { return items.cost[a] > items.cost[b]; });
  std::vector<char> away(count, 0);
  struct Parcel {
    int peer;
    std::vector<std::size_t> item;
    std::vector<double> input, output;
  };
  std::vector<Parcel> sent;
  std::vector<MPI_Request> requests;
  std::size_t next = 0;
  for (const auto& transfer : plan.transfers) {
    if (transfer.from != rank) continue;
    Parcel parcel{transfer.to, {}, {}, {}};
    double left = transfer.cost;
    for (; next < count && left > 0.0; ++next) {
      const std::size_t item = byCost[next];
      if (items.cost[item] > left * 1.5) continue;  // would overshoot; a cheaper one fits better
      left -= items.cost[item];
      away[item] = 1;
      parcel.item.push_back(item);
    }
    parcel.input.resize(parcel.item.size() * items.inputSize);
    parcel.output.resize(parcel.item.size() * items.outputSize);
    for (std::size_t i = 0; i < parcel.item.size(); ++i)
      items.pack(parcel.item[i], {parcel.input.data() + i * items.inputSize, items.inputSize});
    sent.push_back(std::move(parcel));
  }
  for (Parcel& parcel : sent) {
    requests.resize(requests.size() + 2);
    MPI_Isend(parcel.input.data(), static_cast<int>(parcel.input.size()), MPI_DOUBLE, parcel.peer, itemsTag, comm_,
              &requests[requests.size() - 2]);
    MPI_Irecv(parcel.output.data(), static_cast<int>(parcel.output.size()), MPI_DOUBLE, parcel.peer, resultsTag, comm_,
              &requests[requests.size() - 1]);
  }

  double busy = 0.0;
  std::exception_ptr error;
  const auto advance = [&](std::span<const double> input, std::span<double> output) {
    if (error) return;  // the run is lost; only the communication has to be completed
    try {
      items.advance(input, output);
    } catch (...) {
      error = std::current_exception();
    }
  };

  // Others' items first, so that they travel back while this rank advances its own.
  std::vector<std::vector<double>> returned;
  std::vector<MPI_Request> returning;
  returned.reserve(plan.transfers.size());
  returning.reserve(plan.transfers.size());
  for (const auto& transfer : plan.transfers) {
    if (transfer.to != rank) continue;
    MPI_Status status;
    MPI_Probe(transfer.from, itemsTag, comm_, &status);
    int values = 0;
    MPI_Get_count(&status, MPI_DOUBLE, &values);
    std::vector<double> input(static_cast<std::size_t>(values));
    MPI_Recv(input.data(), values, MPI_DOUBLE, transfer.from, itemsTag, comm_, MPI_STATUS_IGNORE);
    const std::size_t foreign = input.size() / items.inputSize;
    std::vector<double>& output = returned.emplace_back(foreign * items.outputSize);
    const double start = MPI_Wtime();
    for (std::size_t i = 0; i < foreign; ++i)
      advance({input.data() + i * items.inputSize, items.inputSize},
              {output.data() + i * items.outputSize, items.outputSize});
    busy += MPI_Wtime() - start;
    returning.emplace_back();
    MPI_Isend(output.data(), static_cast<int>(output.size()), MPI_DOUBLE, transfer.from, resultsTag, comm_,
              &returning.back());
  }

  std::vector<double> input(items.inputSize);
  std::vector<double> output(items.outputSize);
  const double start = MPI_Wtime();
  for (std::size_t item = 0; item < count; ++item) {
    if (away[item]) continue;
    items.pack(item, input);
    advance(input, output);
    if (!error) items.unpack(item, output);
  }
  busy += MPI_Wtime() - start;

  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  MPI_Waitall(static_cast<int>(returning.size()), returning.data(), MPI_STATUSES_IGNORE);
  raiseCollectively(comm_, error);
  Statistics statistics;
  for (const Parcel& parcel : sent) {
    statistics.itemsSent += parcel.item.size();
    for (std::size_t i = 0; i < parcel.item.size(); ++i)
      items.unpack(parcel.item[i], {parcel.output.data() + i * items.outputSize, items.outputSize});
  }
  statistics.imbalanceBefore = plan.imbalanceBefore;
  std::vector<double> busyOfRank(static_cast<std::size_t>(ranks));
  MPI_Allgather(&busy, 1, MPI_DOUBLE, busyOfRank.data(), 1, MPI_DOUBLE, comm_);
  statistics.imbalanceAfter = imbalance(busyOfRank);
  return statistics;
}

}  // namespace lampblack
