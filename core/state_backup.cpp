#include "core/state_backup.hpp"

#include <algorithm>
#include <stdexcept>

namespace lampblack {

class StateBackup::Writer : public StateArchive {
 public:
  explicit Writer(StateBackup& kept) : kept_(kept) {}
  [[nodiscard]] bool loading() const override { return false; }
  void cells(const std::string& name, std::vector<double>& values, int width) override {
    put(name, {values.data(), kept_.cells_ * static_cast<std::size_t>(width)}, Piece::Of::Cells, width);
  }
  void faces(const std::string& name, std::vector<double>& values, int width) override {
    put(name, {values.data(), kept_.faces_ * static_cast<std::size_t>(width)}, Piece::Of::Faces, width);
  }
  void rows(const std::string& name, std::vector<std::vector<double>>& values) override {
    PackedRows& kept = next(name, Piece::Of::Rows, 0);
    for (std::size_t cell = 0; cell < kept_.cells_; ++cell) kept.add(values[cell]);
  }
  void sums(const std::string& name, std::span<double> values) override { put(name, values, Piece::Of::Sums); }
  void shared(const std::string& name, std::vector<double>& values) override { put(name, values); }

 private:
  void put(const std::string& name, std::span<const double> values, Piece::Of of = Piece::Of::Shared, int width = 0) {
    next(name, of, width).values.assign(values.begin(), values.end());
  }
  // An empty piece.
  PackedRows& next(const std::string& name, Piece::Of of, int width) {
    if (kept_.count_ == kept_.pieces_.size()) kept_.pieces_.emplace_back();
    Piece& piece = kept_.pieces_[kept_.count_++];
    piece.name = name;
    piece.of = of;
    piece.width = width;
    piece.kept.clear();
    return piece.kept;
  }

  StateBackup& kept_;
};

class StateBackup::Reader : public StateArchive {
 public:
  explicit Reader(const StateBackup& kept) : kept_(kept) {}
  [[nodiscard]] bool loading() const override { return true; }
  void cells(const std::string& name, std::vector<double>& values, int) override {
    std::ranges::copy(take(name).values, values.begin());
  }
  void faces(const std::string& name, std::vector<double>& values, int) override {
    std::ranges::copy(take(name).values, values.begin());
  }
  void rows(const std::string& name, std::vector<std::vector<double>>& values) override {
    const PackedRows& kept = take(name);
    auto from = kept.values.begin();
    for (std::size_t cell = 0; cell < kept_.cells_; ++cell) {
      const auto to = from + kept.lengths[cell];
      values[cell].assign(from, to);
      from = to;
    }
  }
  void sums(const std::string& name, std::span<double> values) override {
    std::ranges::copy(take(name).values, values.begin());
  }
  void shared(const std::string& name, std::vector<double>& values) override { values = take(name).values; }

 private:
  const PackedRows& take(const std::string& name) {
    if (next_ == kept_.count_ || kept_.pieces_[next_].name != name)
      throw std::logic_error("StateBackup: '" + name + "' was not saved in this place");
    return kept_.pieces_[next_++].kept;
  }

  const StateBackup& kept_;
  std::size_t next_ = 0;
};

StateBackup::StateBackup(int ownedCells, int faces)
    : cells_(static_cast<std::size_t>(ownedCells)), faces_(static_cast<std::size_t>(faces)) {}

void StateBackup::save(const Owners& owners) {
  count_ = 0;
  Writer writer(*this);
  owners(writer);
}

void StateBackup::restore(const Owners& owners) {
  Reader reader(*this);
  owners(reader);
}

void StateBackup::saveOrLoad(StateArchive& archive, const std::string& prefix) {
  for (std::size_t i = 0; i < count_; ++i) {
    auto& [name, kept, of, width] = pieces_[i];
    switch (of) {
      case Piece::Of::Cells:
        archive.cells(prefix + name, kept.values, width);
        break;
      case Piece::Of::Faces:
        archive.faces(prefix + name, kept.values, width);
        break;
      case Piece::Of::Rows: {
        std::vector<std::vector<double>> rows(cells_);
        auto from = kept.values.begin();
        for (std::size_t cell = 0; cell < cells_; ++cell) {
          const auto to = from + kept.lengths[cell];
          rows[cell].assign(from, to);
          from = to;
        }
        archive.rows(prefix + name, rows);
        kept.clear();
        for (const std::vector<double>& row : rows) kept.add(row);
        break;
      }
      case Piece::Of::Sums:
        archive.sums(prefix + name, kept.values);
        break;
      case Piece::Of::Shared:
        archive.shared(prefix + name, kept.values);
        break;
    }
  }
}

void StateBackup::rearrange(int ownedCells, int faces, const Move& moveCells, const Move& moveFaces,
                            const MoveRows& moveRows) {
  for (std::size_t i = 0; i < count_; ++i) {
    Piece& piece = pieces_[i];
    if (piece.of == Piece::Of::Cells) piece.kept.values = moveCells(piece.kept.values, piece.width);
    if (piece.of == Piece::Of::Faces) piece.kept.values = moveFaces(piece.kept.values, piece.width);
    if (piece.of == Piece::Of::Rows) piece.kept = moveRows(piece.kept);
  }
  cells_ = static_cast<std::size_t>(ownedCells);
  faces_ = static_cast<std::size_t>(faces);
}

std::size_t StateBackup::bytes() const {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const PackedRows& kept = pieces_[i].kept;
    sum += sizeof(double) * kept.values.size() + sizeof(std::int64_t) * kept.lengths.size();
  }
  return sum;
}

}  // namespace lampblack
