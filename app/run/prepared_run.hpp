// What a deck comes to before its first step. `lampblack check` makes it and says what it is, `lampblack run` makes it
// and goes on: what the one refuses is refused by the other, with the same words, and before there is a folder.
#pragma once

#include <string>
#include <vector>

#include "app/run/recorded_run.hpp"
#include "core/modules.hpp"

namespace lampblack::app {

class PreparedRun {
 public:
  virtual ~PreparedRun() = default;

  // What is there, in a few words ("47 species, ...").
  [[nodiscard]] virtual std::string summary() const = 0;
  // What more there is to know of it, a line each.
  [[nodiscard]] virtual std::vector<std::string> details() const { return {}; }
  // Collective, once. From the first step to the report. InputError where the folder cannot be used, NumericsError as
  // they come; the run folder then says so.
  virtual void run(const RunOptions& options) = 0;

 protected:
  PreparedRun() = default;
  PreparedRun(const PreparedRun&) = delete;
  PreparedRun& operator=(const PreparedRun&) = delete;
};

}  // namespace lampblack::app
