#include "particles/pah/growth_path.hpp"

#include <algorithm>
#include <cmath>

namespace lampblack::particles {
namespace {

constexpr int mostHalvings = 16;
constexpr double negligibleEvents = 1e-6;  // of a site, on the whole path

class Division {
 public:
  Division(const PahRateConstants& constants, const std::array<bool, pahProcessCount>& active, double rateChange,
           double duration, std::vector<GrowthInterval>& intervals)
      : constants_(constants),
        active_(active),
        rateChange_(rateChange),
        negligible_(duration > 0 ? negligibleEvents / duration : 0),
        intervals_(intervals) {}

  [[nodiscard]] PahRates ratesAt(const GasSample& sample) const {
    PahRates rates = pahRates(constants_, sample.gas.temperature, sample.concentrations);
    for (std::size_t p = 0; p < pahProcessCount; ++p)
      if (!active_[p]) rates[p] = 0;
    return rates;
  }

  void divide(const GasSample& from, const GasSample& to, double first, double last, const PahRates& atFirst,
              const PahRates& atLast, int halvings) {
    const double middle = 0.5 * (first + last);
    const PahRates rates = ratesAt(mixed(from, to, middle));
    if (halvings == mostHalvings || (alike(atFirst, atLast) && alike(atFirst, rates) && alike(rates, atLast))) {
      intervals_.push_back({(last - first) * (to.time - from.time), rates});
      return;
    }
    divide(from, to, first, middle, atFirst, rates, halvings + 1);
    divide(from, to, middle, last, rates, atLast, halvings + 1);
  }

 private:
  [[nodiscard]] bool alike(const PahRates& a, const PahRates& b) const {
    for (std::size_t p = 0; p < pahProcessCount; ++p) {
      const double larger = std::max(a[p], b[p]);
      if (larger > negligible_ && std::abs(a[p] - b[p]) > rateChange_ * larger) return false;
    }
    return true;
  }

  const PahRateConstants& constants_;
  const std::array<bool, pahProcessCount>& active_;
  double rateChange_, negligible_;
  std::vector<GrowthInterval>& intervals_;
};

}  // namespace

GrowthPath growthPath(const ParticlePath& path, const std::vector<std::size_t>& recorded,
                      const PahRateConstants& constants, const std::array<bool, pahProcessCount>& active,
                      double rateChange) {
  GrowthPath result;
  const std::vector<GasSample>& points = path.points;
  const double duration = points.back().time - points.front().time;
  Division division(constants, active, rateChange, duration, result.intervals);
  std::size_t next = 0;
  PahRates before{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PahRates rates = division.ratesAt(points[i]);
    if (i > 0 && points[i].time > points[i - 1].time) division.divide(points[i - 1], points[i], 0, 1, before, rates, 0);
    before = rates;
    for (; next < recorded.size() && recorded[next] == i; ++next) result.records.push_back(result.intervals.size());
  }
  return result;
}

}  // namespace lampblack::particles
