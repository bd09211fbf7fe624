#include "app/run/shipped_files.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <vector>

#include "core/errors.hpp"
#include "core/nearest_name.hpp"
#include "core/system_error.hpp"

namespace lampblack::app {
namespace {

namespace fs = std::filesystem;

fs::path sharedFolder() {
  if (const char* chosen = std::getenv("LAMPBLACK_SHARE"); chosen != nullptr) return chosen;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : (program.parent_path() / LAMPBLACK_SHARE_FROM_PROGRAM).lexically_normal();
}

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) names.push_back(entry.path().filename());
  return names;
}

// The shipped files whose names have the words of a name that others use, as 'gri30.yaml' of methane_gri30_53.yaml, or
// the nearest one.
std::string shippedLike(const std::string& name, const std::vector<std::string>& shippedNames) {
  const std::string stem = fs::path(name).stem().string();
  std::string meant;
  for (const std::string& known : shippedNames)
    if (stem.size() > 2 && ("_" + known).find("_" + stem + "_") != std::string::npos)
      meant += fmt::format("{}'{}'", meant.empty() ? "; did you mean " : " or ", known);
  return meant.empty() ? didYouMean(name, shippedNames) : meant + "?";
}

}  // namespace

fs::path shippedIfThere(const std::string& part) {
  const fs::path folder = sharedFolder() / part;
  std::error_code error;
  return fs::is_directory(folder, error) ? folder : fs::path();
}

fs::path shipped(const std::string& part) {
  if (const fs::path folder = shippedIfThere(part); !folder.empty()) return folder;
  throw SystemError(
      fmt::format("{}: there is no such folder; what ships with the program lies there. Install Lampblack again, or "
                  "name the folder "
                  "above it in LAMPBLACK_SHARE",
                  (sharedFolder() / part).string()));
}

fs::path findMechanism(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / name;
  std::error_code error;
  if (fs::exists(file, error) || fs::path(name).has_parent_path()) return file;
  const fs::path mechanisms = shippedIfThere("cases/mechanisms");
  if (mechanisms.empty()) return file;
  if (fs::exists(mechanisms / name, error)) return mechanisms / name;
  throw InputError(fmt::format("{}: there is no such file; expected a mechanism, and none of that name is in {}{}",
                               file.string(), mechanisms.string(), shippedLike(name, namesIn(mechanisms))));
}

}  // namespace lampblack::app
