#include "particles/pah/pah_rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

// Constants at a temperature.
class RatesAt {
 public:
  explicit RatesAt(double temperature)
      : logT_(std::log(temperature)), inverseRT_(1 / (constants::gasConstant * temperature)) {}
  double operator()(const RateConstant& k) const { return valueAt(k, logT_, inverseRT_); }
  double operator()(const RateSum& sum) const {
    double k = 0;
    for (const RateConstant& one : sum) k += (*this)(one);
    return k;
  }

 private:
  double logT_, inverseRT_;
};

// Radical sites of all: those in steady state of what opens and what closes them, r/(1 + r).
double radicals(double opening, double closing) {
  return opening > 0 ? opening / (opening + closing) : 0.0;
}

}  // namespace

const std::array<PahRateName, 23> pahRateNames{{
    {"growth_free_edge", "C2H2 + radical free edge: a ring grows", &PahRateConstants::growthFreeEdge},
    {"loss_armchair", "H + free edge between none: its ring opens and leaves", &PahRateConstants::lossArmchair},
    {"loss_free_edge", "radical of a ring with three free edges loses C2H2 (1/s)", &PahRateConstants::lossFreeEdge},
    {"close_bay", "radical in a bay closes it (1/s)", &PahRateConstants::closeBay},
    {"bay_open_by_h", "H opens a C-H in a bay", &PahRateConstants::bayOpenByH},
    {"bay_open_by_oh", "OH opens a C-H in a bay", &PahRateConstants::bayOpenByOH},
    {"bay_close_by_h2", "H2 closes a radical in a bay", &PahRateConstants::bayCloseByH2},
    {"bay_close_by_h", "H closes a radical in a bay", &PahRateConstants::bayCloseByH},
    {"zigzag_open_by_h", "H opens a C-H of a zigzag", &PahRateConstants::zigzagOpenByH},
    {"zigzag_close_by_h2", "H2 closes a radical of a zigzag", &PahRateConstants::zigzagCloseByH2},
    {"zigzag_close_by_h", "H closes a radical of a zigzag", &PahRateConstants::zigzagCloseByH},
    {"growth_zigzag", "C2H2 + radical zigzag: a ring of five", &PahRateConstants::growthZigzag},
    {"chain_zigzag", "C2H2 + radical zigzag: an ethynyl group, after which nothing follows here",
     &PahRateConstants::chainZigzag},
    {"five_add_h", "H adds to a ring of five", &PahRateConstants::fiveAddH},
    {"five_lose_h", "H takes the added H again", &PahRateConstants::fiveLoseH},
    {"five_loss", "a ring of five with an added H leaves as C2H2 (1/s)", &PahRateConstants::fiveLoss},
    {"five_move", "a ring of five with an added H moves (1/s)", &PahRateConstants::fiveMove},
    {"five_open_by_h", "H opens a C-H of a ring of five", &PahRateConstants::fiveOpenByH},
    {"five_close_by_h2", "H2 closes a radical of a ring of five", &PahRateConstants::fiveCloseByH2},
    {"five_close_by_h", "H closes a radical of a ring of five", &PahRateConstants::fiveCloseByH},
    {"five_radical_loss", "a radical ring of five leaves (1/s)", &PahRateConstants::fiveRadicalLoss},
    {"oxidation_o2", "O2 + radical of a free edge", &PahRateConstants::oxidationO2},
    {"oxidation_oh", "OH + free edge", &PahRateConstants::oxidationOH},
}};

const std::array<PahFactorName, 5> pahFactorNames{{
    {"ways_armchair", "C-H sites of an armchair that a ring can grow from", &PahRateConstants::waysArmchair},
    {"ways_loss_armchair", "part of loss_armchair that is of one site", &PahRateConstants::waysLossArmchair},
    {"ways_bay", "C-H sites of a bay that closes", &PahRateConstants::waysBay},
    {"ways_zigzag", "part of the growth on a zigzag that is of one site", &PahRateConstants::waysZigzag},
    {"sites_per_zigzag_rate", "C-H sites that zigzag_open_by_h is the rate of all together",
     &PahRateConstants::sitesPerZigzagRate},
}};

std::vector<std::string> pahGasSpeciesNames() {
  std::vector<std::string> names = sootSpecies(SootModelOptions{});
  names.resize(pahGasSpecies);
  return names;
}

double oxidationByOH(const PahRateConstants& constants, double temperature, std::span<const double> concentrations) {
  PahRateConstants withoutOH = constants;
  withoutOH.oxidationOH = {};
  const auto place = static_cast<std::size_t>(PahProcess::O6R_FE3);
  const double all = pahRates(constants, temperature, concentrations)[place];
  return all > 0 ? 1 - pahRates(withoutOH, temperature, concentrations)[place] / all : 0;
}

PahRates pahRates(const PahRateConstants& constants, double temperature, std::span<const double> concentrations) {
  if (!(temperature > 0) || !std::isfinite(temperature))
    throw NumericsError(fmt::format("rates of molecules: {:g} K is no temperature", temperature));
  for (const double c : concentrations)
    if (!std::isfinite(c)) throw NumericsError("rates of molecules: a concentration is no number");
  const RatesAt k(temperature);
  // mol/cm3; a gas that is interpolated or integrated has tiny negative ones.
  const auto gas = [&](SootSpecies::Index species) { return 1e-6 * std::max(concentrations[species], 0.0); };
  const double H = gas(SootSpecies::H), H2 = gas(SootSpecies::H2), OH = gas(SootSpecies::OH);
  const double H2O = gas(SootSpecies::H2O), O2 = gas(SootSpecies::O2), C2H2 = gas(SootSpecies::C2H2);
  const PahRateConstants& c = constants;
  const SurfaceRateConstants& s = c.surface;
  PahRates rates{};
  const auto rate = [&](PahProcess process) -> double& { return rates[static_cast<std::size_t>(process)]; };

  // Rings of six. A radical closes by what closes it in general, or reacts.
  const double opening = k(s.openByH) * H + k(s.openByOH) * OH;
  const double byWater = k(s.closeByH2O) * H2O;
  const double closing = k(s.closeByH2) * H2 + byWater + k(s.closeByH) * H;
  const auto byRadical = [&](double reaction) { return reaction * radicals(opening, closing + reaction); };
  rate(PahProcess::G6R_AC) = c.waysArmchair * byRadical(k(s.growth) * C2H2);
  rate(PahProcess::G6R_FE) = byRadical(k(c.growthFreeEdge) * C2H2);
  rate(PahProcess::D6R_FE_AC) = c.waysLossArmchair * k(c.lossArmchair) * H;
  rate(PahProcess::D6R_FE3) = rate(PahProcess::C6R_AC_FE3) = byRadical(k(c.lossFreeEdge));
  const double bayOpening = k(c.bayOpenByH) * H + k(c.bayOpenByOH) * OH;
  const double bayClosing = k(c.bayCloseByH2) * H2 + byWater + k(c.bayCloseByH) * H;
  const double closure = k(c.closeBay);
  rate(PahProcess::L6_BY6) = c.waysBay * closure * radicals(bayOpening, bayClosing + closure);
  rate(PahProcess::O6R_FE3) = rate(PahProcess::O6R_FE_HACA) = byRadical(k(c.oxidationO2) * O2) + k(c.oxidationOH) * OH;

  // Rings of five: growth, then what those with an added H and radical ones do.
  const double ring = k(c.growthZigzag) * C2H2, chain = k(c.chainZigzag) * C2H2;
  const double zigzagOpening = k(c.zigzagOpenByH) * H / c.sitesPerZigzagRate;
  const double zigzagClosing = k(c.zigzagCloseByH2) * H2 + k(c.zigzagCloseByH) * H;
  rate(PahProcess::G5R_ZZ) = c.waysZigzag * ring * radicals(zigzagOpening, zigzagClosing + ring + chain);
  const double add = k(c.fiveAddH), leave = k(c.fiveLoss), move = k(c.fiveMove);
  const double without = add / k(c.fiveEquilibrium) + k(c.fiveLoseH) * H + leave + move;
  // Without H there are neither, whatever else is zero.
  const double withH = H > 0 ? add * H / without : 0, radicalLeaves = k(c.fiveRadicalLoss);
  const double radical =
      !(H > 0) ? 0 : k(c.fiveOpenByH) * H / (k(c.fiveCloseByH2) * H2 + k(c.fiveCloseByH) * H + radicalLeaves);
  rate(PahProcess::D5R_R5) = withH * leave + radical * radicalLeaves;
  rate(PahProcess::M5R_RZZ) = rate(PahProcess::C5R_RAC) = withH * move;
  const double grows = rate(PahProcess::G6R_FE);
  rate(PahProcess::C5R_RFE) = H > 0 ? grows * add * H / (without + grows) : 0;
  for (std::size_t p = 0; p < pahProcessCount; ++p)
    if (!(rates[p] >= 0) || !std::isfinite(rates[p]))
      throw NumericsError(fmt::format("rates of molecules: that of {} at {:g} K is no rate: {:g} 1/s",
                                      pahProcesses[p].name, temperature, rates[p]));
  return rates;
}

}  // namespace lampblack::particles
