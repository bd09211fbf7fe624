#include "flow/discretisation/vertex_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/rank_exchange.hpp"

namespace lampblack::flow {
namespace {

// How much what is known at a face counts for its vertices; cells have none.
enum class Standing : int { Cell = 0, Opening = 1, Tight = 2 };

// What one cell, or one face of the surface, says of a vertex, as doubles that travel: vertex, cell or face and its
// number, the way from its centre to the vertex; of each component standing, value and slopes.
struct Row {
  static constexpr std::size_t vertex = 0, isFace = 1, number = 2, way = 3, first = 6;
  static constexpr std::size_t standing = 0, value = 1, slope = 2;
  static std::size_t perComponent(int dimension) { return slope + static_cast<std::size_t>(dimension); }
};

class VertexSums {
 public:
  VertexSums(const FlowContext& context, const VertexField::Source& source)
      : context_(context),
        mesh_(context.mesh),
        source_(source),
        components_(static_cast<std::size_t>(source.components)),
        perComponent_(Row::perComponent(mesh_.dimension)),
        width_(Row::first + components_ * perComponent_),
        gradient_(static_cast<std::size_t>(mesh_.cells) * components_ * mesh_.dimension) {
    Gradient(mesh_).compute(source.values, source.boundary, source.components, gradient_, source.known);
    context.halo.update(gradient_, source.components * mesh_.dimension);
    listEntries();
  }

  std::vector<double> values() {
    std::vector<double> result(mesh_.vertex.size() * components_);
    sumInside(result);
    sumAcross(result);
    return result;
  }

 private:
  // A cell beside a vertex, or a face of the surface as one of its cells has it.
  struct Entry {
    int vertex, cell, face;  // face -1: the cell itself
  };

  [[nodiscard]] bool isPeriodic(int face) const {
    return mesh_.high[face] >= 0 && mesh_.shiftBeyond(mesh_.low[face], face) != Vector3{};
  }

  void listEntries() {
    std::vector<char> isShared(mesh_.vertex.size(), 0);
    for (int cell = 0; cell < mesh_.owned; ++cell)
      for (int i = mesh_.cornerStart[cell]; i < mesh_.cornerStart[cell + 1]; ++i)
        inside_.push_back({mesh_.corner[i], cell, -1});
    for (int face = 0; face < mesh_.faces; ++face) {
      const bool isSurface = mesh_.high[face] < 0 || isPeriodic(face);
      const bool isBetweenRanks = mesh_.low[face] >= mesh_.owned || mesh_.high[face] >= mesh_.owned;
      if (!isSurface && !isBetweenRanks) continue;
      for (const bool isLow : {true, false}) {
        const int cell = isLow ? mesh_.low[face] : mesh_.high[face];
        if (cell < 0 || cell >= mesh_.owned) continue;
        const CellSide& side = sidesOf(mesh_.shape[cell])[isLow ? mesh_.lowSide[face] : mesh_.highSide[face]];
        for (int i = 0; i < side.corners; ++i) {
          const int vertex = mesh_.corner[mesh_.cornerStart[cell] + side.corner[i]];
          isShared[vertex] = 1;
          if (isSurface) across_.push_back({vertex, cell, face});
        }
      }
    }
    // A vertex all of whose cells are here, off the surface, needs no message.
    for (const Entry& entry : inside_)
      if (isShared[entry.vertex]) across_.push_back(entry);
    std::erase_if(inside_, [&](const Entry& entry) { return isShared[entry.vertex] != 0; });
    if (source_.only)
      for (std::vector<Entry>* entries : {&inside_, &across_})
        std::erase_if(*entries, [&](const Entry& entry) {
          return !std::ranges::binary_search(*source_.only, mesh_.vertexNumber[entry.vertex]);
        });
    std::ranges::stable_sort(inside_, {}, &Entry::vertex);
    std::ranges::stable_sort(across_, {}, &Entry::vertex);
  }

  void write(const Entry& entry, double* row) const {
    const Vector3 centre = entry.face < 0 ? mesh_.centre[entry.cell] : mesh_.faceCentreOf(entry.cell, entry.face);
    const Vector3 way = difference(mesh_.vertex[entry.vertex], centre);
    row[Row::vertex] = static_cast<double>(mesh_.vertexNumber[entry.vertex]);
    row[Row::isFace] = entry.face < 0 ? 0.0 : 1.0;
    row[Row::number] =
        static_cast<double>(entry.face < 0 ? mesh_.naturalCell[entry.cell] : mesh_.faceNumber[entry.face]);
    std::ranges::copy(way, row + Row::way);
    for (std::size_t k = 0; k < components_; ++k) {
      double* out = row + Row::first + k * perComponent_;
      std::fill_n(out, perComponent_, 0.0);
      if (entry.face < 0)
        writeCell(entry.cell, k, out);
      else if (mesh_.high[entry.face] >= 0)
        writePeriodic(entry.face, k, out);
      else
        writeBoundary(entry.face, k, out);
    }
  }
  void writeCell(int cell, std::size_t k, double* out) const {
    const std::size_t at = static_cast<std::size_t>(cell) * components_ + k;
    out[Row::value] = source_.values[at];
    for (int axis = 0; axis < mesh_.dimension; ++axis) out[Row::slope + axis] = gradient_[at * mesh_.dimension + axis];
  }
  void writePeriodic(int face, std::size_t k, double* out) const {
    const auto value = [&](int cell) { return source_.values[static_cast<std::size_t>(cell) * components_ + k]; };
    const double w = mesh_.lowWeight[face];
    out[Row::standing] = static_cast<double>(Standing::Opening);
    out[Row::value] = w * value(mesh_.low[face]) + (1.0 - w) * value(mesh_.high[face]);
    const auto slope = [&](const Vector3& direction) {
      return faceSlope(mesh_, face, direction, gradient_, source_.components, static_cast<int>(k));
    };
    if (mesh_.isSkewed()) out[Row::value] += slope(mesh_.offset[face]);
    for (int axis = 0; axis < mesh_.dimension; ++axis) {
      Vector3 along{};
      along[axis] = 1.0;
      out[Row::slope + axis] = slope(along);
    }
  }
  void writeBoundary(int face, std::size_t k, double* out) const {
    const std::size_t b = static_cast<std::size_t>(face - mesh_.interiorFaces);
    const bool isEach = source_.known.size() > static_cast<std::size_t>(mesh_.boundaryFaces());
    if (source_.known[isEach ? b * components_ + k : b] != BoundaryData::Value) return;
    const BoundaryKind kind = context_.boundaryOf(face).kind;
    const bool isTight = kind == BoundaryKind::Wall || kind == BoundaryKind::Symmetry;
    out[Row::standing] = static_cast<double>(isTight ? Standing::Tight : Standing::Opening);
    out[Row::value] = source_.boundary[b * components_ + k];
  }

  // The value of one component at a vertex, of rows in the order of their numbers.
  [[nodiscard]] double combine(std::span<const double* const> rows, std::size_t k) const {
    const std::size_t at = Row::first + k * perComponent_;
    double highest = 0.0;
    bool isLedOut = false;
    for (const double* row : rows) {
      highest = std::max(highest, row[at + Row::standing]);
      isLedOut = isLedOut || (row[Row::isFace] != 0.0 && !source_.isLedOut.empty() && source_.isLedOut[k] != 0);
    }
    double weights = 0.0, mean = 0.0, led = 0.0;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    Vector3 way{}, slope{};
    for (const double* row : rows) {
      if (row[at + Row::standing] != highest || (highest == 0.0 && row[Row::isFace] != 0.0)) continue;
      const Vector3 to{row[Row::way], row[Row::way + 1], row[Row::way + 2]};
      const double w = 1.0 / length(to), value = row[at + Row::value];
      weights += w;
      mean += w * value;
      least = std::min(least, value);
      most = std::max(most, value);
      way = sum(way, scaled(to, w));
      for (int axis = 0; axis < mesh_.dimension; ++axis) {
        const double g = row[at + Row::slope + axis];
        slope[axis] += w * g;
        led += w * g * to[axis];
      }
    }
    const double value = (mean + 0.5 * (led + dot(way, slope) / weights)) / weights;
    return source_.isBounded && !isLedOut ? std::clamp(value, least, most) : value;
  }

  // Runs of rows of one vertex, sorted; `take` gets the rows of each.
  template <typename Take>
  void eachVertex(std::span<const double> rows, const Take& take) const {
    std::vector<const double*> order;
    for (std::size_t i = 0; i < rows.size(); i += width_) order.push_back(&rows[i]);
    std::ranges::sort(order, [](const double* a, const double* b) {
      return std::lexicographical_compare(a, a + Row::way, b, b + Row::way);
    });
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
      while (end < order.size() && order[end][Row::vertex] == order[begin][Row::vertex]) ++end;
      take(std::span{order}.subspan(begin, end - begin));
    }
  }

  void sumInside(std::vector<double>& result) const {
    std::vector<double> rows;
    for (std::size_t begin = 0, end = 0; begin < inside_.size(); begin = end) {
      const int vertex = inside_[begin].vertex;
      while (end < inside_.size() && inside_[end].vertex == vertex) ++end;
      rows.resize((end - begin) * width_);
      for (std::size_t i = begin; i < end; ++i) write(inside_[i], &rows[(i - begin) * width_]);
      eachVertex(rows, [&](std::span<const double* const> ofOne) {
        for (std::size_t k = 0; k < components_; ++k) result[vertex * components_ + k] = combine(ofOne, k);
      });
    }
  }

  // Vertices that other ranks may have cells at, in portions: each is summed on one rank, which sends the sums back.
  void sumAcross(std::vector<double>& result) const {
    const std::size_t portions = portionsOf(mesh_.comm, across_.size() * width_);
    std::size_t next = 0;
    for (std::size_t portion = 1; portion <= portions; ++portion) {
      const auto end = static_cast<std::int64_t>(static_cast<double>(mesh_.totalVertices) *
                                                 static_cast<double>(portion) / static_cast<double>(portions));
      const std::size_t begin = next;
      while (next < across_.size() && (portion == portions || mesh_.vertexNumber[across_[next].vertex] < end)) ++next;
      std::vector<double> rows((next - begin) * width_);
      std::vector<int> ranks;
      for (std::size_t i = begin; i < next; ++i) {
        write(across_[i], &rows[(i - begin) * width_]);
        ranks.push_back(static_cast<int>(mesh_.vertexNumber[across_[i].vertex] % mesh_.ranks));
      }
      const RankExchange exchange(mesh_.comm, ranks);
      const std::vector<double> came = exchange.send(rows, static_cast<int>(width_));
      std::vector<double> sums(exchange.received() * components_);
      eachVertex(came, [&](std::span<const double* const> ofOne) {
        for (std::size_t k = 0; k < components_; ++k) {
          const double value = combine(ofOne, k);
          for (const double* row : ofOne)
            sums[static_cast<std::size_t>(row - came.data()) / width_ * components_ + k] = value;
        }
      });
      sums = exchange.reply(sums, source_.components);
      for (std::size_t i = begin; i < next; ++i)
        for (std::size_t k = 0; k < components_; ++k)
          result[across_[i].vertex * components_ + k] = sums[(i - begin) * components_ + k];
    }
  }

  const FlowContext& context_;
  const Mesh& mesh_;
  const VertexField::Source& source_;
  std::size_t components_, perComponent_, width_;
  std::vector<double> gradient_;
  std::vector<Entry> inside_, across_;  // by vertex
};

}  // namespace

VertexField::VertexField(const FlowContext& context, Source source)
    : components_(source.components), vertices_(VertexSums(context, source).values()) {
  values_ = std::move(source.values);
}

}  // namespace lampblack::flow
