// A study in parts, for the job arrays of a batch system: each job carries out one part, and the study's own command
// makes the table of what they left.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/shell/study/sweep_study.hpp"
#include "core/modules.hpp"

namespace lampblack::app {

// One of so many parts, counted from 1.
struct StudyPart {
  std::size_t place = 1, count = 1;
};

// "3/10". InputError.
StudyPart readPart(const std::string& text);

// The runs of a part, in the study's order; whole chains, and none in parts beyond the number of chains. Parts differ
// by a chain at most.
SweepStudy partOf(SweepStudy study, const StudyPart& part);

// What the command of a part has besides its part.
struct JobsOptions {
  std::string study;
  std::filesystem::path folder;
  std::vector<std::string> words;  // more of its command line: --set, a.b=c
  int jobs = 1, ranks = 1;
};

// The script of an array of jobs, of no more than the study has chains, for `sbatch`; it runs in bash with
// SLURM_ARRAY_TASK_ID as well.
std::string jobsScript(const SweepStudy& study, const JobsOptions& options);

}  // namespace lampblack::app
