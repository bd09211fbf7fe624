// Steps of the results on their way to the next part of an interrupted run: copied to files of their own while the run
// goes on, because the results file of a run that was killed may be anything.
#include <fmt/format.h>

#include <algorithm>

#include "io/hdf5_reader.hpp"
#include "io/results_writer_impl.hpp"
#include "io/sealed_file.hpp"

namespace lampblack::io {

using namespace resultswriter;

namespace {

std::string orderOf(const std::string& group) {
  return "/order" + group.substr(group.rfind('/'));
}

std::int64_t numberOf(const std::string& group) {
  return std::stoll(group.substr(group.rfind('/') + 1));
}

struct SavedField {
  std::string name, unit, description;
  std::int64_t width;
  std::vector<double> block;
};

}  // namespace

std::size_t ResultsWriter::stepCount() const {
  return self_->steps.size();
}

void ResultsWriter::saveSteps(const std::filesystem::path& path, std::size_t first) const {
  const auto temporary = partName(path);
  try {
    self_->copySteps(temporary, first);
    sealAndRename(self_->comm, temporary, path);
  } catch (const SystemError&) {
    std::error_code ignored;
    if (self_->rank == 0) std::filesystem::remove(temporary, ignored);
    throw;
  }
}

void ResultsWriter::Implementation::copySteps(const std::filesystem::path& to, std::size_t first) {
  hdf5::ParallelFile copy(comm, to, storage);
  for (std::size_t i = first; i < steps.size(); ++i) {
    const XdmfStep& step = steps[i];
    copy.group(step.group);
    copy.attribute(step.group, "step", numberOf(step.group));
    copy.attribute(step.group, "time", step.time);
    std::vector<std::string> order;
    for (const XdmfField& field : step.fields) {
      if (field.isInteger) throw std::logic_error("a field of integers is not kept for a restart");
      const std::string name = step.group + "/" + field.name;
      const auto block = file.read(name, cells.first(), cells.count(), field.components);
      std::vector<std::int64_t> dims{cells.total()};
      if (field.components > 1) dims.push_back(field.components);
      copy.write(name, dims, cells.first(), cells.count(), block.data());
      const auto& [unit, description] = words.at(field.name);
      copy.attribute(name, "unit", unit);
      copy.attribute(name, "description", description);
      order.push_back(field.name);
    }
    copy.write(orderOf(step.group), order);
  }
  copy.close();
}

void ResultsWriter::loadSteps(const std::filesystem::path& path) {
  const BlockExchange& cells = self_->cells;
  std::vector<std::string> names;
  std::unique_ptr<Hdf5Reader> reader;
  collectively(self_->comm, [&] {
    reader = std::make_unique<Hdf5Reader>(path);
    names = reader->names("/steps");
  });
  std::ranges::sort(names, {}, [](const std::string& name) { return numberOf(name); });
  const std::int64_t last = self_->steps.empty() ? -1 : numberOf(self_->steps.back().group);
  for (const std::string& name : names) {
    const std::int64_t step = numberOf(name);
    if (step <= last) continue;
    const std::string group = "/steps/" + name;
    double time = 0.0;
    std::vector<SavedField> fields;
    collectively(self_->comm, [&] {
      time = reader->numberAttribute(group, "time");
      for (const std::string& field : reader->texts(orderOf(group))) {
        const std::string place = group + "/" + field;
        const auto shape = reader->shape(place);
        if (shape.empty() || shape[0] != cells.total())
          throw InputError(fmt::format("{}: {} is of another mesh", path.string(), place));
        fields.push_back({field, reader->textAttribute(place, "unit"), reader->textAttribute(place, "description"),
                          shape.size() > 1 ? shape[1] : 1, reader->rows(place, cells.first(), cells.count())});
      }
    });
    beginStep(step, time);
    for (const SavedField& field : fields) {
      const std::string place = group + "/" + field.name;
      std::vector<std::int64_t> dims{cells.total()};
      if (field.width > 1) dims.push_back(field.width);
      self_->file.write(place, dims, cells.first(), cells.count(), field.block.data());
      self_->describe(place, field.unit, field.description);
      self_->open->fields.push_back({field.name, static_cast<int>(field.width), false});
      self_->words[field.name] = {field.unit, field.description};
    }
    endStep();
  }
}

}  // namespace lampblack::io
