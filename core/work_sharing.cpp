#include "core/work_sharing.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"

namespace lampblack {
namespace {

constexpr int itemsTag = 21;
constexpr int resultsTag = 22;

double imbalance(const std::vector<double>& cost) {
  if (cost.empty()) return 1.0;
  const double sum = std::accumulate(cost.begin(), cost.end(), 0.0);
  const double most = *std::max_element(cost.begin(), cost.end());
  return sum > 0.0 ? most * static_cast<double>(cost.size()) / sum : 1.0;
}

// Items on their way to another rank.
struct Parcel {
  int peer;
  std::vector<std::size_t> item;
  std::vector<double> values, results;
};

// The values of several items in one message: of each how many, then the values; `noValues` for one that failed.
constexpr double noValues = -1;

void append(std::vector<double>& message, std::span<const double> values) {
  message.push_back(static_cast<double>(values.size()));
  message.insert(message.end(), values.begin(), values.end());
}

class MessageReader {
 public:
  explicit MessageReader(std::span<const double> message) : rest_(message) {}
  [[nodiscard]] bool done() const { return rest_.empty(); }
  // Of the next item; empty optional for one that failed.
  std::optional<std::span<const double>> next() {
    const double count = rest_.front();
    rest_ = rest_.subspan(1);
    if (count == noValues) return std::nullopt;
    const auto values = rest_.first(static_cast<std::size_t>(count));
    rest_ = rest_.subspan(values.size());
    return values;
  }

 private:
  std::span<const double> rest_;
};

std::vector<double> receive(int from, int tag, MPI_Comm comm) {
  MPI_Status status;
  MPI_Probe(from, tag, comm, &status);
  int count = 0;
  MPI_Get_count(&status, MPI_DOUBLE, &count);
  std::vector<double> message(static_cast<std::size_t>(count));
  MPI_Recv(message.data(), count, MPI_DOUBLE, from, tag, comm, MPI_STATUS_IGNORE);
  return message;
}

void send(const std::vector<double>& message, int to, int tag, MPI_Comm comm, std::vector<MPI_Request>& requests) {
  MPI_Isend(message.data(), static_cast<int>(message.size()), MPI_DOUBLE, to, tag, comm, &requests.emplace_back());
}

// Keeps the first failure and skips everything after it: the run is lost, only the communication has to be completed.
class FirstFailure {
 public:
  template <typename Work>
  bool unlessFailed(Work&& work) {  // whether it was done
    if (error_) return false;
    try {
      work();
      return true;
    } catch (...) {
      error_ = std::current_exception();
      return false;
    }
  }
  [[nodiscard]] const std::exception_ptr& error() const { return error_; }

 private:
  std::exception_ptr error_;
};

// Items that are advanced together.
class Group {
 public:
  explicit Group(const WorkSharing::Items& items)
      : items_(items),
        capacity_(items.advanceGroup ? std::max<std::size_t>(items.groupSize, 1) : 1),
        outputs_(capacity_) {
    copies_.resize(capacity_);
  }
  void add(std::span<const double> input) { inputs_.push_back(input); }
  void addCopy(std::span<const double> input) {
    auto& copy = copies_[inputs_.size()];
    copy.assign(input.begin(), input.end());
    inputs_.emplace_back(copy);
  }
  void clear() { inputs_.clear(); }
  [[nodiscard]] bool isFull() const { return inputs_.size() == capacity_; }
  void advance() {
    for (auto& output : outputs()) output.clear();
    if (inputs_.empty()) return;
    if (items_.advanceGroup) return items_.advanceGroup(inputs_, outputs());
    items_.advance(inputs_.front(), outputs_.front());
  }
  [[nodiscard]] std::span<std::vector<double>> outputs() { return {outputs_.data(), inputs_.size()}; }

 private:
  const WorkSharing::Items& items_;
  std::size_t capacity_;
  std::vector<std::span<const double>> inputs_;
  std::vector<std::vector<double>> copies_, outputs_;
};

// This rank's total cost; not a number when its items are not valid, which every rank then notices.
double totalCost(const WorkSharing::Items& items) {
  const auto& cost = items.cost;
  const bool valid = std::all_of(cost.begin(), cost.end(), [](double c) { return c >= 0.0 && std::isfinite(c); });
  return valid ? std::accumulate(cost.begin(), cost.end(), 0.0) : std::numeric_limits<double>::quiet_NaN();
}

// Chooses the items that leave this rank and marks them in `away`: the dearest, so that few of them travel.
std::vector<Parcel> chooseParcels(const SharingPlan& plan, int rank, const std::vector<double>& cost,
                                  std::vector<char>& away) {
  std::vector<Parcel> parcels;
  std::vector<std::size_t> byCost;
  for (const auto& transfer : plan.transfers) {
    if (transfer.from != rank) continue;
    if (byCost.empty()) {
      byCost.resize(cost.size());
      std::iota(byCost.begin(), byCost.end(), std::size_t{0});
      std::stable_sort(byCost.begin(), byCost.end(), [&](std::size_t a, std::size_t b) { return cost[a] > cost[b]; });
    }
    Parcel parcel{transfer.to, {}, {}, {}};
    double left = transfer.cost;
    for (std::size_t item : byCost) {
      if (!(left > 0.0) || !(cost[item] > 0.0)) break;
      if (away[item] || cost[item] > left * 1.5) continue;  // the latter would overshoot; a cheaper one fits better
      left -= cost[item];
      away[item] = 1;
      parcel.item.push_back(item);
    }
    parcels.push_back(std::move(parcel));
  }
  return parcels;
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

  const double ownCost = totalCost(items);
  std::vector<double> costOfRank(static_cast<std::size_t>(ranks));
  MPI_Allgather(&ownCost, 1, MPI_DOUBLE, costOfRank.data(), 1, MPI_DOUBLE, comm_);
  for (double cost : costOfRank)
    if (!std::isfinite(cost)) throw std::invalid_argument("WorkSharing: a cost is negative or not finite");
  SharingPlan plan = planSharing(costOfRank);
  if (!enabled_) plan.transfers.clear();

  FirstFailure guard;
  std::vector<double> input;
  const auto pack = [&](std::size_t item) {
    input.clear();
    return guard.unlessFailed([&] { items.pack(item, input); });
  };
  Group group(items);

  std::vector<char> away(items.cost.size(), 0);
  std::vector<Parcel> sent = chooseParcels(plan, rank, items.cost, away);
  std::vector<MPI_Request> requests;
  for (Parcel& parcel : sent) {
    for (const std::size_t item : parcel.item) {
      if (pack(item))
        append(parcel.values, input);
      else
        parcel.values.push_back(noValues);
    }
    send(parcel.values, parcel.peer, itemsTag, comm_, requests);
  }

  // Others' items first, so that they travel back while this rank advances its own.
  double busy = 0.0, work = 0.0;
  const auto count = [&](std::span<const double> output) {
    if (items.work) work += items.work(output);
  };
  std::vector<std::vector<double>> returned;
  returned.reserve(plan.transfers.size());  // MPI keeps pointers to the elements' values
  for (const auto& transfer : plan.transfers) {
    if (transfer.to != rank) continue;
    const std::vector<double> received = receive(transfer.from, itemsTag, comm_);
    std::vector<double>& results = returned.emplace_back();
    const double start = MPI_Wtime();
    const auto advance = [&] {
      // Nobody reads results where any item failed.
      if (guard.unlessFailed([&] { group.advance(); }))
        for (const auto& output : group.outputs()) {
          append(results, output);
          count(output);
        }
      group.clear();
    };
    for (MessageReader message(received); !message.done();) {
      if (const auto values = message.next()) group.add(*values);
      if (group.isFull()) advance();
    }
    advance();
    busy += MPI_Wtime() - start;
    send(results, transfer.from, resultsTag, comm_, requests);
  }

  int allArrived = requests.empty() ? 1 : 0;
  const double start = MPI_Wtime();
  std::vector<std::size_t> own;  // in the group
  const auto advanceOwn = [&] {
    if (guard.unlessFailed([&] { group.advance(); }))
      for (std::size_t i = 0; i < own.size(); ++i)
        guard.unlessFailed([&] {
          count(group.outputs()[i]);
          items.unpack(own[i], group.outputs()[i]);
        });
    group.clear();
    own.clear();
    // MPI moves large parcels only while it is called: without this, the receivers would wait for this loop's end.
    if (!allArrived) MPI_Testall(static_cast<int>(requests.size()), requests.data(), &allArrived, MPI_STATUSES_IGNORE);
  };
  for (std::size_t item = 0; item < items.cost.size(); ++item) {
    if (away[item] || !pack(item)) continue;
    group.addCopy(input);
    own.push_back(item);
    if (group.isFull()) advanceOwn();
  }
  advanceOwn();
  busy += MPI_Wtime() - start;
  for (Parcel& parcel : sent) parcel.results = receive(parcel.peer, resultsTag, comm_);
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  raiseCollectively(comm_, guard.error());

  Statistics statistics;
  for (const Parcel& parcel : sent) {
    statistics.itemsSent += parcel.item.size();
    MessageReader message(parcel.results);
    for (const std::size_t item : parcel.item) guard.unlessFailed([&] { items.unpack(item, message.next().value()); });
  }
  raiseCollectively(comm_, guard.error());
  statistics.imbalanceBefore = plan.imbalanceBefore;
  if (items.work) busy = work;
  std::vector<double> busyOfRank(static_cast<std::size_t>(ranks));
  MPI_Allgather(&busy, 1, MPI_DOUBLE, busyOfRank.data(), 1, MPI_DOUBLE, comm_);
  statistics.imbalanceAfter = imbalance(busyOfRank);
  return statistics;
}

}  // namespace lampblack
