#include "app/shell/study/sweep_jobs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <iterator>

#include "app/run/shipped_case.hpp"
#include "core/errors.hpp"

namespace lampblack::app {
namespace {

std::size_t chainsOf(const SweepStudy& study) {
  return (study.runs.size() + study.chain - 1) / study.chain;
}

}  // namespace

StudyPart readPart(const std::string& text) {
  StudyPart part;
  const char* end = text.data() + text.size();
  const auto [slash, first] = std::from_chars(text.data(), end, part.place);
  const bool hasSlash = first == std::errc{} && slash != end && *slash == '/';
  const auto [last, second] = std::from_chars(hasSlash ? slash + 1 : end, end, part.count);
  if (!hasSlash || second != std::errc{} || last != end || part.place < 1 || part.place > part.count)
    throw InputError(fmt::format("--part: expected one of so many parts, such as 3/10, found '{}'", text));
  return part;
}

SweepStudy partOf(SweepStudy study, const StudyPart& part) {
  const std::size_t chains = chainsOf(study);
  const auto place = [&](std::size_t parts) {
    return std::next(study.runs.begin(), static_cast<std::ptrdiff_t>(
                                             std::min(study.runs.size(), parts * chains / part.count * study.chain)));
  };
  study.runs = std::vector<SweepRun>(place(part.place - 1), place(part.place));
  return study;
}

std::string jobsScript(const SweepStudy& study, const JobsOptions& options) {
  const std::size_t jobs = std::min(static_cast<std::size_t>(options.jobs), chainsOf(study));
  std::vector<std::string> words{std::filesystem::read_symlink("/proc/self/exe").string(), "sweep",
                                 std::filesystem::absolute(options.study).string(), "--out",
                                 std::filesystem::absolute(options.folder).string()};
  words.insert(words.end(), options.words.begin(), options.words.end());
  for (std::string& word : words) word = shellWord(word);
  const std::string command = fmt::format("{}", fmt::join(words, " "));
  return fmt::format(R"(#!/usr/bin/env bash
# The runs of a study, a part of them a job: sbatch {script}
# Its table, when the jobs have ended (what they did not finish is told; without --collect it is run):
#   {command} --collect
#SBATCH --job-name=lampblack
#SBATCH --array=1-{jobs}
#SBATCH --ntasks={ranks}
set -euo pipefail
exec {command} --part "$SLURM_ARRAY_TASK_ID/{jobs}" --ranks {ranks}
)",
                     fmt::arg("script", shellWord((options.folder / "jobs.slurm").string())),
                     fmt::arg("command", command), fmt::arg("jobs", jobs), fmt::arg("ranks", options.ranks));
}

}  // namespace lampblack::app
