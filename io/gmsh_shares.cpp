#include "io/gmsh_shares.hpp"

#include <algorithm>
#include <bit>
#include <exception>

#include "io/block_exchange.hpp"
#include "io/gmsh_cells.hpp"

namespace lampblack::io {
namespace {

constexpr int gmshMessageTag = 23;

// The first value of a message.
enum class GmshMessage : std::int64_t { Nodes, Tags, Places, Elements, Periodic, End };

constexpr std::size_t valuesOfRun = 4;

void takeElements(GmshShare& share, std::span<const std::int64_t> values) {
  while (!values.empty()) {
    const GmshRun run{values[0], values[1], values[2], values[3]};
    const GmshElementType& type = *findGmshType(run.type);
    const auto length = static_cast<std::size_t>(run.count * (type.nodes + 1));
    GmshShare::Elements& elements = share.elements.at(static_cast<std::size_t>(type.dimension));
    elements.runs.push_back(run);
    const auto numbers = values.subspan(valuesOfRun, length);
    elements.numbers.insert(elements.numbers.end(), numbers.begin(), numbers.end());
    values = values.subspan(valuesOfRun + length);
  }
}

void takeNodes(GmshShare& share, std::int64_t total, int ranks, int rank) {
  share.totalNodes = total;
  share.firstNode = blockStart(total, ranks, rank);
  const auto count = static_cast<std::size_t>(blockStart(total, ranks, rank + 1) - share.firstNode);
  share.nodeTags.assign(count, 0);
  share.nodePlaces.assign(3 * count, 0.0);
}

void takeMessage(MPI_Comm comm, GmshShare& share, std::span<const std::int64_t> message) {
  const auto values = message.subspan(1);
  switch (static_cast<GmshMessage>(message[0])) {
    case GmshMessage::Nodes: {
      int ranks = 1, rank = 0;
      MPI_Comm_size(comm, &ranks);
      MPI_Comm_rank(comm, &rank);
      takeNodes(share, values[0], ranks, rank);
      break;
    }
    case GmshMessage::Tags:
      std::ranges::copy(values.subspan(1), share.nodeTags.begin() + (values[0] - share.firstNode));
      break;
    case GmshMessage::Places:
      std::ranges::transform(values.subspan(1), share.nodePlaces.begin() + 3 * (values[0] - share.firstNode),
                             [](std::int64_t bits) { return std::bit_cast<double>(bits); });
      break;
    case GmshMessage::Elements:
      takeElements(share, values);
      break;
    case GmshMessage::Periodic:
      share.periodic.insert(share.periodic.end(), values.begin(), values.end());
      break;
    case GmshMessage::End:
      break;
  }
}

std::vector<std::int64_t> messageOf(GmshMessage kind) {
  return {static_cast<std::int64_t>(kind)};
}

}  // namespace

GmshSender::GmshSender(MPI_Comm comm, GmshShare& own, std::size_t portion)
    : comm_(comm), own_(own), portion_(std::max<std::size_t>(portion, 1)) {
  MPI_Comm_size(comm, &ranks_);
  elements_ = messageOf(GmshMessage::Elements);
  periodic_ = messageOf(GmshMessage::Periodic);
}

void GmshSender::send(int rank, std::span<const std::int64_t> message) {
  if (rank == 0)
    takeMessage(comm_, own_, message);
  else
    MPI_Send(message.data(), static_cast<int>(message.size()), MPI_INT64_T, rank, gmshMessageTag, comm_);
}

void GmshSender::nodes(std::int64_t total) {
  totalNodes_ = total;
  std::vector<std::int64_t> message = messageOf(GmshMessage::Nodes);
  message.push_back(total);
  for (int rank = 0; rank < ranks_; ++rank) send(rank, message);
}

// Cuts positions first..first+count-1 where the blocks of the ranks do.
template <typename Give>
void GmshSender::byBlock(std::int64_t first, std::int64_t count, const Give& give) {
  const std::int64_t end = first + count;
  for (std::int64_t at = first; at < end;) {
    const int rank = blockOf(at, totalNodes_, ranks_);
    const std::int64_t next = std::min(end, blockStart(totalNodes_, ranks_, rank + 1));
    give(rank, at, static_cast<std::size_t>(at - first), static_cast<std::size_t>(next - at));
    at = next;
  }
}

void GmshSender::nodeTags(std::int64_t first, std::span<const std::int64_t> tags) {
  byBlock(first, static_cast<std::int64_t>(tags.size()),
          [&](int rank, std::int64_t position, std::size_t begin, std::size_t count) {
            std::vector<std::int64_t> message = messageOf(GmshMessage::Tags);
            message.push_back(position);
            message.insert(message.end(), tags.begin() + static_cast<std::ptrdiff_t>(begin),
                           tags.begin() + static_cast<std::ptrdiff_t>(begin + count));
            send(rank, message);
          });
}

void GmshSender::nodePlaces(std::int64_t first, std::span<const double> places) {
  byBlock(first, static_cast<std::int64_t>(places.size() / 3),
          [&](int rank, std::int64_t position, std::size_t begin, std::size_t count) {
            std::vector<std::int64_t> message = messageOf(GmshMessage::Places);
            message.push_back(position);
            for (const double x : places.subspan(3 * begin, 3 * count))
              message.push_back(std::bit_cast<std::int64_t>(x));
            send(rank, message);
          });
}

void GmshSender::beginRun(const GmshRun& run) {
  run_ = run;
  runStart_ = 0;
}

void GmshSender::element(std::int64_t tag, std::span<const std::int64_t> nodes) {
  if (runStart_ == 0) {
    runStart_ = elements_.size();
    elements_.insert(elements_.end(), {run_.type, run_.group, run_.first, 0});
  }
  ++elements_[runStart_ + valuesOfRun - 1];
  elements_.push_back(tag);
  elements_.insert(elements_.end(), nodes.begin(), nodes.end());
  ++run_.first;
  if (elements_.size() > portion_) sendElements();
}

void GmshSender::sendElements() {
  if (elements_.size() > 1) send(next_, elements_);
  next_ = (next_ + 1) % ranks_;
  elements_.resize(1);
  runStart_ = 0;
}

void GmshSender::periodic(std::int64_t node, std::int64_t master) {
  periodic_.insert(periodic_.end(), {node, master});
  if (periodic_.size() > portion_) sendPeriodic();
}

void GmshSender::sendPeriodic() {
  if (periodic_.size() > 1) send(next_, periodic_);
  next_ = (next_ + 1) % ranks_;
  periodic_.resize(1);
}

void GmshSender::flush() {
  sendElements();
  sendPeriodic();
}

void GmshSender::end() {
  const std::array message{static_cast<std::int64_t>(GmshMessage::End)};
  for (int rank = 1; rank < ranks_; ++rank) send(rank, message);
}

void receiveGmshShare(MPI_Comm comm, GmshShare& share) {
  // A rank that has failed goes on taking messages, for rank 0 waits until they are taken.
  std::exception_ptr failure;
  std::vector<std::int64_t> message;
  for (;;) {
    MPI_Status status;
    int length = 0;
    MPI_Probe(0, gmshMessageTag, comm, &status);
    MPI_Get_count(&status, MPI_INT64_T, &length);
    message.resize(static_cast<std::size_t>(length));
    MPI_Recv(message.data(), length, MPI_INT64_T, 0, gmshMessageTag, comm, MPI_STATUS_IGNORE);
    if (message[0] == static_cast<std::int64_t>(GmshMessage::End)) break;
    if (failure) continue;
    try {
      takeMessage(comm, share, message);
    } catch (...) {
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace lampblack::io
