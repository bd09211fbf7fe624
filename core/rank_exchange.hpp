// Sends values to other ranks and replies to the senders. The pattern of messages is found once and serves any number
// of exchanges.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <span>
#include <type_traits>
#include <vector>

#include "core/packed_rows.hpp"
#include "core/shares.hpp"

namespace lampblack {

class RankExchange {
 public:
  // Collective. `destinations`: the rank that receives each item of this rank.
  RankExchange(MPI_Comm comm, std::span<const int> destinations);

  [[nodiscard]] std::size_t items() const { return order_.size(); }  // of this rank
  [[nodiscard]] std::size_t received() const { return received_; }   // items from all ranks

  // Collective. `values`: `width` for each item of this rank. Returns the values received, in the order of the sending
  // ranks and of the items of each.
  template <std::ranges::contiguous_range Values, typename T = std::ranges::range_value_t<Values>>
  [[nodiscard]] std::vector<T> send(const Values& values, int width) const {
    const auto w = static_cast<std::size_t>(width);
    checkSize(std::ranges::size(values), items() * w);
    std::vector<T> sent(items() * w), result(received_ * w);
    for (std::size_t i = 0; i < order_.size(); ++i)
      for (std::size_t c = 0; c < w; ++c) sent[i * w + c] = std::ranges::data(values)[order_[i] * w + c];
    pass(sent.data(), sendCounts_, result.data(), receiveCounts_, w * sizeOf<T>());
    return result;
  }

  // Collective. `values`: `width` for each item received. Returns the values for the items of this rank.
  template <std::ranges::contiguous_range Values, typename T = std::ranges::range_value_t<Values>>
  [[nodiscard]] std::vector<T> reply(const Values& values, int width) const {
    const auto w = static_cast<std::size_t>(width);
    checkSize(std::ranges::size(values), received_ * w);
    std::vector<T> answers(items() * w), result(answers.size());
    pass(std::ranges::data(values), receiveCounts_, answers.data(), sendCounts_, w * sizeOf<T>());
    for (std::size_t i = 0; i < order_.size(); ++i)
      for (std::size_t c = 0; c < w; ++c) result[order_[i] * w + c] = answers[i * w + c];
    return result;
  }

  // Collective. The same for rows of any lengths, one for each item.
  [[nodiscard]] PackedRows send(const PackedRows& rows) const;
  [[nodiscard]] PackedRows reply(const PackedRows& rows) const;

 private:
  template <typename T>
  static constexpr std::size_t sizeOf() {
    static_assert(std::is_trivially_copyable_v<T>);
    return sizeof(T);
  }
  static void checkSize(std::size_t given, std::size_t expected);
  // Items of so many bytes, `from` of them to each rank, by rank, and `to` from each.
  void pass(const void* sent, const std::vector<std::size_t>& from, void* received, const std::vector<std::size_t>& to,
            std::size_t bytes) const;
  // The values of rows, in the order of ranks, `from` of them to each; of those that come the lengths are there.
  void passRows(const PackedRows& sent, const std::vector<std::size_t>& from, PackedRows& received,
                const std::vector<std::size_t>& to) const;

  MPI_Comm comm_;
  std::size_t received_ = 0;
  std::vector<std::size_t> order_;          // this rank's items sorted by the rank they go to
  std::vector<std::size_t> sendCounts_;     // items to each rank
  std::vector<std::size_t> receiveCounts_;  // items from each rank
};

// What travels for every cell of a mesh goes in portions of about so many values a rank, so that a rank never holds it
// all at once beside what it is made from.
constexpr std::size_t valuesInPortion = std::size_t{1} << 18U;
// Collective. How many portions it takes where this rank has `values`: the most of any rank, one at least.
std::size_t portionsOf(MPI_Comm comm, std::size_t values);

// Collective. Asks the owners of numbers, by `shares`, for what they have: `answer(number)` on the owner. Answers are
// in the order of `numbers`, which may repeat.
template <typename T, typename Answer>
std::vector<T> ask(MPI_Comm comm, const Shares& shares, std::span<const std::int64_t> numbers, const Answer& answer) {
  std::vector<T> ordered;
  ordered.reserve(numbers.size());
  for (std::size_t portion = 0, portions = portionsOf(comm, numbers.size()); portion < portions; ++portion) {
    const auto some = numbers.subspan(ordered.size(), std::min(valuesInPortion, numbers.size() - ordered.size()));
    std::vector<int> owners;
    owners.reserve(some.size());
    for (const std::int64_t number : some) owners.push_back(shares.rankOf(number));
    const RankExchange exchange(comm, owners);
    std::vector<T> answers;
    answers.reserve(exchange.received());
    for (const std::int64_t number : exchange.send(some, 1)) answers.push_back(answer(number));
    answers = exchange.reply(answers, 1);
    ordered.insert(ordered.end(), answers.begin(), answers.end());
  }
  return ordered;
}

}  // namespace lampblack
