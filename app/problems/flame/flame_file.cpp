#include "app/problems/flame/flame_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/errors.hpp"
#include "io/hdf5_reader.hpp"

namespace lampblack::app {
namespace {

const std::string group = "/flame/restart";

}  // namespace

void writeFlameProfile(ResultsWriter& results, const NamedFlameProfile& flame) {
  const FlameProfile& profile = flame.profile;
  const auto points = static_cast<std::int64_t>(profile.points());
  const auto width = static_cast<std::int64_t>(profile.layout.width());
  const std::span<const double> x(profile.x);
  results.dataset(group + "/z", {points}, profile.z, "m", "grid");
  results.dataset(
      group + "/unknowns", {points, width}, x.first(static_cast<std::size_t>(points * width)), "SI",
      "of each point: mass flux through the face to the next, V, T, mass fractions, scalars a kg of gas over "
      "their scale");
  results.dataset(group + "/globals", {static_cast<std::int64_t>(numFlameGlobals)},
                  x.subspan(static_cast<std::size_t>(points * width)), "SI",
                  "mass flux at z = 0, pressure gradient Lambda, factor on the strain");
  results.texts(group + "/species", flame.species, "names of the mass fractions, in order");
  results.texts(group + "/scalars", flame.scalars, "names of the scalars, in order");
}

NamedFlameProfile readFlameProfile(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  if (!file.has(group))
    throw InputError(fmt::format("{}: these are no results of a flame (problem: flame1d)", file.name()));
  NamedFlameProfile flame;
  FlameProfile& profile = flame.profile;
  flame.species = file.texts(group + "/species");
  flame.scalars = file.texts(group + "/scalars");
  profile.layout = {flame.species.size(), flame.scalars.size()};
  profile.z = file.numbers(group + "/z");
  const auto points = static_cast<std::int64_t>(profile.points());
  profile.x = file.numbers(group + "/unknowns", {points, static_cast<std::int64_t>(profile.layout.width())});
  const auto globals = file.numbers(group + "/globals", {static_cast<std::int64_t>(numFlameGlobals)});
  profile.x.insert(profile.x.end(), globals.begin(), globals.end());
  const bool rising = std::adjacent_find(profile.z.begin(), profile.z.end(), std::greater_equal<>()) == profile.z.end();
  const auto finite = [](const std::vector<double>& v) {
    return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
  };
  if (points < 3 || profile.layout.species == 0 || !rising || !finite(profile.z) || !finite(profile.x))
    throw InputError(
        fmt::format("{}: the flame in it is damaged (its grid has to rise, its numbers to be finite)", file.name()));
  return flame;
}

}  // namespace lampblack::app
