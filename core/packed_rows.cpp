#include "core/packed_rows.hpp"

#include <stdexcept>

namespace lampblack {

void PackedRows::clear() {
  lengths.clear();
  values.clear();
}

void PackedRows::add(std::span<const double> row) {
  lengths.push_back(static_cast<std::int64_t>(row.size()));
  values.insert(values.end(), row.begin(), row.end());
}

PackedRows gathered(const PackedRows& rows, std::span<const std::size_t> order) {
  std::vector<std::size_t> starts{0};
  starts.reserve(rows.lengths.size() + 1);
  for (const std::int64_t length : rows.lengths) starts.push_back(starts.back() + static_cast<std::size_t>(length));
  if (starts.back() != rows.values.size())
    throw std::logic_error("PackedRows: the lengths are not those of the values");
  PackedRows result;
  result.lengths.reserve(order.size());
  result.values.reserve(rows.values.size());
  for (const std::size_t row : order)
    result.add(std::span(rows.values).subspan(starts.at(row), starts.at(row + 1) - starts[row]));
  return result;
}

PackedRows scattered(const PackedRows& rows, std::span<const std::size_t> places) {
  const std::size_t none = rows.lengths.size();
  std::vector<std::size_t> order(places.size(), none);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (order.at(places[i]) != none) throw std::logic_error("PackedRows: two rows for one place");
    order[places[i]] = i;
  }
  return gathered(rows, order);
}

}  // namespace lampblack
