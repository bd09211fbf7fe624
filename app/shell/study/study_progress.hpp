// How far a study is and how long it will still take: a line after each run of the first group. The other groups have
// as many runs, and what its own took stands for all. Runs that are there already take no time.
#pragma once

#include <cstddef>

#include "core/modules.hpp"

namespace lampblack::app {

class StudyProgress {
 public:
  // `runs` of the study, of which the first group has `own`; `speaks` on one rank of it.
  StudyProgress(bool speaks, std::size_t runs, std::size_t own);
  void ended(bool isTaken);

 private:
  bool speaks_;
  std::size_t runs_, own_, done_ = 0, taken_ = 0;
  double begun_;
};

}  // namespace lampblack::app
