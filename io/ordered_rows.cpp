#include "io/ordered_rows.hpp"

#include <algorithm>
#include <numeric>

#include "core/packed_rows.hpp"
#include "core/rank_exchange.hpp"

namespace lampblack::io {
namespace {

constexpr auto piece = static_cast<std::int64_t>(valuesInPortion);

template <typename Part>
RankExchange exchangeOf(MPI_Comm comm, const std::vector<Part>& parts) {
  std::vector<int> ranks;
  ranks.reserve(parts.size());
  for (const Part& part : parts) ranks.push_back(part.rank);
  return {comm, ranks};
}

}  // namespace

OrderedRows::OrderedRows(MPI_Comm comm, const BlockExchange& cells, std::span<const std::int64_t> lengths)
    : comm_(comm) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &ranks_);
  const std::int64_t own = std::accumulate(lengths.begin(), lengths.end(), std::int64_t{0});
  std::int64_t before = 0;
  MPI_Exscan(&own, &before, 1, MPI_INT64_T, MPI_SUM, comm);
  if (rank_ == 0) before = 0;  // MPI leaves it undefined there
  MPI_Allreduce(&own, &total_, 1, MPI_INT64_T, MPI_SUM, comm);
  std::vector<std::int64_t> starts(lengths.size());
  std::exclusive_scan(lengths.begin(), lengths.end(), starts.begin(), before);
  lengths_ = cells.fromBlock(lengths, 1);
  starts_ = cells.fromBlock(starts, 1);
  for (std::size_t row = 0; row < lengths_.size(); ++row)
    if (lengths_[row] > 0) order_.push_back(row);
  std::ranges::sort(order_, {}, [this](std::size_t row) { return starts_[row]; });
}

std::int64_t OrderedRows::portions() const {
  const std::int64_t portion = piece * ranks_;
  return (total_ + portion - 1) / portion;
}

std::int64_t OrderedRows::first(std::int64_t portion) const {
  return std::min(total_, (portion * ranks_ + rank_) * piece);
}

std::int64_t OrderedRows::count(std::int64_t portion) const {
  return std::min(piece, total_ - first(portion));
}

std::vector<OrderedRows::Part> OrderedRows::partsOf(std::int64_t portion) const {
  const std::int64_t begin = portion * ranks_ * piece, end = begin + ranks_ * piece;
  std::vector<Part> parts;
  // The last row that begins here or before may reach into the portion.
  auto next = std::ranges::upper_bound(order_, begin, {}, [this](std::size_t row) { return starts_[row]; });
  if (next != order_.begin()) --next;
  for (; next != order_.end() && starts_[*next] < end; ++next) {
    const std::int64_t start = starts_[*next], stop = std::min(end, start + lengths_[*next]);
    for (std::int64_t at = std::max(begin, start); at < stop;) {
      const std::int64_t number = at / piece, until = std::min(stop, (number + 1) * piece);
      parts.push_back({*next, static_cast<std::size_t>(at - start), static_cast<std::size_t>(until - at),
                       static_cast<int>(number % ranks_), static_cast<std::size_t>(at % piece)});
      at = until;
    }
  }
  return parts;
}

std::vector<double> OrderedRows::toPiece(std::int64_t portion, std::span<const std::vector<double>> rows) const {
  const std::vector<Part> parts = partsOf(portion);
  const RankExchange exchange = exchangeOf(comm_, parts);
  std::vector<std::size_t> places;
  PackedRows sent;
  for (const Part& part : parts) {
    places.push_back(part.place);
    sent.add(std::span(rows[part.row]).subspan(part.from, part.count));
  }
  places = exchange.send(places, 1);
  const PackedRows came = exchange.send(sent);
  std::vector<double> values(static_cast<std::size_t>(count(portion)));
  const double* read = came.values.data();
  for (std::size_t i = 0; i < places.size(); read += came.lengths[i++])
    std::copy_n(read, came.lengths[i], values.data() + places[i]);
  return values;
}

void OrderedRows::fromPiece(std::int64_t portion, std::span<const double> values,
                            std::span<std::vector<double>> rows) const {
  const std::vector<Part> parts = partsOf(portion);
  const RankExchange exchange = exchangeOf(comm_, parts);
  std::vector<std::size_t> wanted;  // place and count of each part
  for (const Part& part : parts) wanted.insert(wanted.end(), {part.place, part.count});
  wanted = exchange.send(wanted, 2);
  PackedRows answers;
  for (std::size_t i = 0; i < wanted.size(); i += 2) answers.add(values.subspan(wanted[i], wanted[i + 1]));
  const PackedRows came = exchange.reply(answers);
  const double* read = came.values.data();
  for (const Part& part : parts) {
    std::copy_n(read, part.count, rows[part.row].data() + part.from);
    read += part.count;
  }
}

}  // namespace lampblack::io
