// The XDMF file of a run that goes on. A step that is new is written over the tags that end the file, with the same
// tags behind it, so that what is written for a step does not grow with the steps before.
//
// What a reader, or whoever looks after a crash, may find: after each update the whole file, which is on the disk
// (fsync). During one: the file before it, or that up to a place within the new steps; the kernel may leave a process
// that is killed within its one call of write() with a part of the pages. Such a file misses its end, and nothing of
// the results: the next update, or the next part of the run, writes it whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "io/xdmf.hpp"

namespace lampblack::io {

class XdmfFile {
 public:
  XdmfFile(std::filesystem::path path, const XdmfMesh& mesh) : path_(std::move(path)), mesh_(mesh) {}

  // Brings the file to xdmfText(file, mesh, steps), where `steps` are those of the last call and what came behind them.
  // All of it is written, under a temporary name, the first time, for another `file`, and where the file on the disk is
  // not as long as it was left. Not collective. Returns the bytes written. SystemError on a full disk, InputError where
  // the file cannot be written otherwise; it is then as it was before.
  std::size_t update(const std::string& file, const std::vector<XdmfStep>& steps);

 private:
  [[nodiscard]] bool isUnchanged() const;

  std::filesystem::path path_;
  XdmfMesh mesh_;
  std::string file_;
  std::size_t told_ = 0;  // steps
  std::int64_t end_ = 0;  // bytes of the file; 0: not written yet
};

}  // namespace lampblack::io
