#include "io/checkpoint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <span>

#include "core/errors.hpp"
#include "io/ordered_rows.hpp"
#include "io/sealed_file.hpp"

namespace lampblack::io {
namespace {

constexpr std::int64_t formatVersion = 7;
constexpr const char* fileType = "lampblack checkpoint";

std::filesystem::path unfinishedName(const std::filesystem::path& path) {
  return path.string() + ".part";
}

std::string dataset(const std::string& name) {
  return "/state/" + name;
}

std::string lengthsDataset(const std::string& name) {
  return dataset(name) + "_lengths";
}

}  // namespace

CheckpointWriter::CheckpointWriter(MPI_Comm comm, std::filesystem::path path, const StateNumbers& numbers,
                                   const Fingerprint& fingerprint)
    : comm_(comm),
      path_(std::move(path)),
      cells_(comm, numbers.cells, numbers.totalCells),
      faces_(comm, numbers.faces, numbers.totalFaces),
      localCells_(numbers.cells.size()),
      localFaces_(numbers.faces.size()),
      file_(comm, unfinishedName(path_)),
      exceptionsAtStart_(std::uncaught_exceptions()) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &ranks_);
  file_.attribute("/", "file_type", std::string(fileType));
  file_.attribute("/", "format_version", formatVersion);
  for (const auto& [name, value] : fingerprint) file_.write("/fingerprint/" + name, {value});
}

CheckpointWriter::~CheckpointWriter() {
  if (!file_.isOpen()) return;
  // Another rank may not be here to close the file with this one, unless the disk is full, which all know.
  if (std::uncaught_exceptions() > exceptionsAtStart_ && !file_.full()) {
    file_.abandon();
    return;
  }
  try {
    file_.close();
  } catch (const std::exception&) {
    file_.abandon();
  }
  std::error_code ignored;
  if (rank_ == 0) std::filesystem::remove(unfinishedName(path_), ignored);
}

void CheckpointWriter::ordered(const BlockExchange& exchange, const std::string& name,
                               const std::vector<double>& values, int width) {
  const std::vector<double> block = exchange.toBlock(values, width);
  file_.write(dataset(name), {exchange.total(), width}, exchange.first(), exchange.count(), block.data());
}

void CheckpointWriter::cells(const std::string& name, std::vector<double>& values, int width) {
  const auto own = static_cast<std::ptrdiff_t>(localCells_) * width;
  ordered(cells_, name, {values.begin(), values.begin() + own}, width);
}

void CheckpointWriter::faces(const std::string& name, std::vector<double>& values, int width) {
  const auto own = static_cast<std::ptrdiff_t>(localFaces_) * width;
  ordered(faces_, name, {values.begin(), values.begin() + own}, width);
}

void CheckpointWriter::rows(const std::string& name, std::vector<std::vector<double>>& values) {
  const auto own = std::span(values).first(localCells_);
  std::vector<std::int64_t> lengths;
  for (const auto& row : own) lengths.push_back(static_cast<std::int64_t>(row.size()));
  lengths = cells_.toBlock(lengths, 1);
  file_.write(lengthsDataset(name), {cells_.total(), 1}, cells_.first(), cells_.count(), lengths.data());
  const OrderedRows ordered(comm_, cells_, lengths);
  file_.make(dataset(name), {ordered.total()});
  for (std::int64_t portion = 0; portion < ordered.portions(); ++portion) {
    const std::vector<double> piece = ordered.toPiece(portion, own);
    file_.fill(dataset(name), ordered.first(portion), ordered.count(portion), piece.data());
  }
}

void CheckpointWriter::sums(const std::string& name, std::span<double> values) {
  file_.write(dataset(name), {ranks_, static_cast<std::int64_t>(values.size())}, rank_, 1, values.data());
}

void CheckpointWriter::shared(const std::string& name, std::vector<double>& values) {
  auto size = static_cast<std::int64_t>(values.size());
  MPI_Bcast(&size, 1, MPI_INT64_T, 0, comm_);
  file_.write(dataset(name), {size}, 0, rank_ == 0 ? size : 0, values.data());
}

void CheckpointWriter::texts(const std::string& name, const std::vector<std::string>& values) {
  file_.write(dataset(name), values);
}

void CheckpointWriter::finish() {
  file_.close();
  try {
    sealAndRename(comm_, unfinishedName(path_), path_);
  } catch (const std::exception&) {
    std::error_code ignored;
    if (rank_ == 0) std::filesystem::remove(unfinishedName(path_), ignored);
    throw;
  }
}

CheckpointReader::CheckpointReader(MPI_Comm comm, const std::filesystem::path& path, const StateNumbers& numbers,
                                   const Fingerprint& fingerprint)
    : comm_(comm), cells_(comm, numbers.cells, numbers.totalCells), faces_(comm, numbers.faces, numbers.totalFaces) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &ranks_);
  const std::string problem = sealProblem(comm, path);
  collectively(comm, [&] {
    if (!problem.empty()) throw InputError(fmt::format("{}: this file {}", path.string(), problem));
    file_ = std::make_unique<Hdf5Reader>(path);
    if (!file_->hasAttribute("/", "file_type") || file_->textAttribute("/", "file_type") != fileType)
      throw InputError(fmt::format("{}: this is no checkpoint of Lampblack", path.string()));
    const double version = file_->numberAttribute("/", "format_version");
    if (version != static_cast<double>(formatVersion))
      throw InputError(fmt::format("{}: this checkpoint has the format version {}; this Lampblack reads version {}",
                                   path.string(), version, formatVersion));
    std::string differences;
    for (const auto& [name, value] : fingerprint) {
      const std::string place = "/fingerprint/" + name;
      const std::string found = file_->has(place) ? file_->texts(place).at(0) : "nothing";
      if (found != value)
        differences += fmt::format("{}of another {} (its own: {}; of the deck: {})", differences.empty() ? "" : ", ",
                                   name, found.empty() ? "none" : found, value.empty() ? "none" : value);
    }
    if (!differences.empty())
      throw InputError(
          fmt::format("{}: this checkpoint is {}. Restart it with the deck it was made with; only times, "
                      "steps, outputs, tolerances and what flows in may change",
                      path.string(), differences));
  });
}

std::string CheckpointReader::kept(const std::string& name) const {
  std::string place = dataset(name);
  if (!file_->has(place))
    throw InputError(fmt::format(
        "{}: this checkpoint has no {}: another version of Lampblack wrote it, or the deck has since got an "
        "option that keeps more. Restart it with the deck it was made with, or begin a new run; a flow can "
        "begin from the results of the interrupted one (initial.flow.results)",
        file_->name(), place));
  return place;
}

void CheckpointReader::renumber(const StateNumbers& numbers) {
  cells_ = BlockExchange(comm_, numbers.cells, numbers.totalCells);
  faces_ = BlockExchange(comm_, numbers.faces, numbers.totalFaces);
}

void CheckpointReader::ordered(const BlockExchange& exchange, const std::string& name, std::vector<double>& values,
                               int width) {
  std::vector<double> block;
  collectively(comm_, [&] {
    const std::string place = kept(name);
    if (file_->shape(place) != std::vector<std::int64_t>{exchange.total(), width})
      throw InputError(fmt::format("{}: {} does not have the shape that this run needs", file_->name(), place));
    block = file_->rows(place, exchange.first(), exchange.count());
  });
  std::ranges::copy(exchange.fromBlock(block, width), values.begin());
}

void CheckpointReader::cells(const std::string& name, std::vector<double>& values, int width) {
  ordered(cells_, name, values, width);
}

void CheckpointReader::faces(const std::string& name, std::vector<double>& values, int width) {
  ordered(faces_, name, values, width);
}

std::vector<std::int64_t> CheckpointReader::lengthsOfBlock(const std::string& name, std::int64_t values) const {
  const std::string place = lengthsDataset(name);
  if (file_->shape(place) != std::vector<std::int64_t>{cells_.total(), 1})
    throw InputError(fmt::format("{}: {} does not have the shape that this run needs", file_->name(), place));
  std::vector<std::int64_t> lengths;
  std::int64_t left = values;
  for (const double length : file_->rows(place, cells_.first(), cells_.count())) {
    if (!(length >= 0 && length <= static_cast<double>(left)) || length != std::floor(length))
      throw InputError(fmt::format("{}: {} has the length {}, which no row of {} can have", file_->name(), place,
                                   length, dataset(name)));
    lengths.push_back(static_cast<std::int64_t>(length));
    left -= lengths.back();
  }
  return lengths;
}

void CheckpointReader::rows(const std::string& name, std::vector<std::vector<double>>& values) {
  std::int64_t total = 0;
  std::vector<std::int64_t> lengths;
  collectively(comm_, [&] {
    const auto shape = file_->shape(kept(name));
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file_->name(), error);
    // No more than there are bytes for, so that no sum of lengths is more than there are integers.
    if (error || shape.size() != 1 || static_cast<std::uintmax_t>(shape[0]) > bytes / sizeof(double))
      throw InputError(fmt::format("{}: {} is no list of values that the file holds", file_->name(), dataset(name)));
    total = shape[0];
    lengths = lengthsOfBlock(name, total);
  });
  const OrderedRows ordered(comm_, cells_, lengths);
  collectively(comm_, [&] {
    if (ordered.total() != total)
      throw InputError(fmt::format("{}: the lengths of {} add up to {}, but it has {} values", file_->name(),
                                   dataset(name), ordered.total(), total));
    for (std::size_t cell = 0; cell < ordered.lengths().size(); ++cell)
      values[cell].resize(static_cast<std::size_t>(ordered.lengths()[cell]));
  });
  for (std::int64_t portion = 0; portion < ordered.portions(); ++portion) {
    std::vector<double> piece;
    collectively(comm_, [&] { piece = file_->rows(dataset(name), ordered.first(portion), ordered.count(portion)); });
    ordered.fromPiece(portion, piece, std::span(values));
  }
}

void CheckpointReader::sums(const std::string& name, std::span<double> values) {
  collectively(comm_, [&] {
    const auto shape = file_->shape(kept(name));
    const auto width = static_cast<std::int64_t>(values.size());
    if (shape.size() != 2 || shape[1] != width)
      throw InputError(fmt::format("{}: {} does not have the shape that this run needs", file_->name(), dataset(name)));
    std::ranges::fill(values, 0.0);
    if (shape[0] == ranks_) {
      std::ranges::copy(file_->rows(dataset(name), rank_, 1), values.begin());
    } else if (rank_ == 0) {
      const std::vector<double> parts = file_->rows(dataset(name), 0, shape[0]);
      for (std::size_t i = 0; i < parts.size(); ++i) values[i % values.size()] += parts[i];
    }
  });
}

void CheckpointReader::shared(const std::string& name, std::vector<double>& values) {
  collectively(comm_, [&] { values = file_->numbers(kept(name)); });
}

std::vector<std::string> CheckpointReader::texts(const std::string& name) const {
  std::vector<std::string> values;
  collectively(comm_, [&] { values = file_->texts(kept(name)); });
  return values;
}

std::vector<std::string> CheckpointReader::textsOf(MPI_Comm comm, const std::filesystem::path& path,
                                                   const std::string& name) {
  std::vector<std::string> values;
  collectively(comm, [&] { values = Hdf5Reader(path).texts(dataset(name)); });
  return values;
}

}  // namespace lampblack::io
