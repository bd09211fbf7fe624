#include "core/kept_state.hpp"

#include <algorithm>
#include <stdexcept>

namespace lampblack {

class KeptState::Writer : public StateArchive {
 public:
  explicit Writer(KeptState& kept) : kept_(kept) {}
  [[nodiscard]] bool loading() const override { return false; }
  void cells(const std::string& name, std::vector<double>& values, int width) override {
    put(name, {values.data(), kept_.cells_ * static_cast<std::size_t>(width)}, Piece::Of::Cells, width);
  }
  void faces(const std::string& name, std::vector<double>& values, int width) override {
    put(name, {values.data(), kept_.faces_ * static_cast<std::size_t>(width)}, Piece::Of::Faces, width);
  }
  void sums(const std::string& name, std::span<double> values) override { put(name, values); }
  void shared(const std::string& name, std::vector<double>& values) override { put(name, values); }

 private:
  void put(const std::string& name, std::span<const double> values, Piece::Of of = Piece::Of::Rank, int width = 0) {
    if (kept_.count_ == kept_.pieces_.size()) kept_.pieces_.emplace_back();
    Piece& piece = kept_.pieces_[kept_.count_++];
    piece.name = name;
    piece.of = of;
    piece.width = width;
    piece.values.assign(values.begin(), values.end());
  }

  KeptState& kept_;
};

class KeptState::Reader : public StateArchive {
 public:
  explicit Reader(const KeptState& kept) : kept_(kept) {}
  [[nodiscard]] bool loading() const override { return true; }
  void cells(const std::string& name, std::vector<double>& values, int) override {
    std::ranges::copy(take(name), values.begin());
  }
  void faces(const std::string& name, std::vector<double>& values, int) override {
    std::ranges::copy(take(name), values.begin());
  }
  void sums(const std::string& name, std::span<double> values) override {
    std::ranges::copy(take(name), values.begin());
  }
  void shared(const std::string& name, std::vector<double>& values) override { values = take(name); }

 private:
  const std::vector<double>& take(const std::string& name) {
    if (next_ == kept_.count_ || kept_.pieces_[next_].name != name)
      throw std::logic_error("KeptState: '" + name + "' was not kept in this place");
    return kept_.pieces_[next_++].values;
  }

  const KeptState& kept_;
  std::size_t next_ = 0;
};

KeptState::KeptState(int ownedCells, int faces)
    : cells_(static_cast<std::size_t>(ownedCells)), faces_(static_cast<std::size_t>(faces)) {}

void KeptState::keep(const Owners& owners) {
  count_ = 0;
  Writer writer(*this);
  owners(writer);
}

void KeptState::giveBack(const Owners& owners) {
  Reader reader(*this);
  owners(reader);
}

void KeptState::rearrange(int ownedCells, int faces, const Move& moveCells, const Move& moveFaces) {
  for (std::size_t i = 0; i < count_; ++i) {
    Piece& piece = pieces_[i];
    if (piece.of == Piece::Of::Cells) piece.values = moveCells(piece.values, piece.width);
    if (piece.of == Piece::Of::Faces) piece.values = moveFaces(piece.values, piece.width);
  }
  cells_ = static_cast<std::size_t>(ownedCells);
  faces_ = static_cast<std::size_t>(faces);
}

std::size_t KeptState::bytes() const {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < count_; ++i) sum += sizeof(double) * pieces_[i].values.size();
  return sum;
}

}  // namespace lampblack
