// Rate constants and species; reactions are in batch_kinetics_reactions.cpp.
#include "chemistry/kinetics/batch_kinetics_tables.hpp"

#include <cmath>
#include <optional>

#include "chemistry/kinetics/kinetics_powers.hpp"
#include "core/constants.hpp"

namespace lampblack::chemistry {

namespace {

constexpr double kLog2E = 1.44269504088896340736;
constexpr double kLn2 = 0.69314718055994530942;
constexpr double kNoRate = -5000;  // ln A below is that of A = 0
constexpr double kLog10Of2 = 0.30102999566398119521;

template <class T>
BatchArray<T> viewOf(const std::vector<T>& values) {
  return {values.data(), values.size()};
}

}  // namespace

BatchTables::BatchTables(const Mechanism& mechanism, const KineticsTables& tables)
    : numSpecies_(mechanism.numSpecies()) {
  setSpecies(mechanism);
  setExponentials(tables);
  setGiven(tables);
  setThirdBodies(tables);
  setFalloff(tables);
  setPressureRates(tables);
  setReactions(tables);
  setProductRange(tables);
}

BatchView BatchTables::view() const {
  BatchView view{};
  view.numSpecies = numSpecies_;
  view.minProductTemperature = minProductTemperature_;
  view.maxProductTemperature = maxProductTemperature_;
  view.gasConstant = constants::gasConstant;
  view.logStandard = logStandard_;
  view.smallestConcentration = smallestConcentration;
  view.nasa7 = viewOf(nasa7_);
  view.nasa9 = viewOf(nasa9_);
  view.thirdBodies = viewOf(thirdBodies_);
  view.exponentials = viewOf(exponentials_);
  view.given = viewOf(given_);
  view.threeBody = viewOf(threeBody_);
  view.factorExponentials = viewOf(factorExponentials_);
  view.lindemann = viewOf(lindemann_);
  view.broadened = viewOf(broadened_);
  view.pressureLog = viewOf(pressureLog_);
  view.chebyshev = viewOf(chebyshev_);
  view.groups = viewOf(groupViews_);
  view.general = viewOf(general_);
  view.terms = terms_.data();
  view.levels = levels_.data();
  view.pressureRates = pressureRates_.data();
  view.chebyshevCoefficients = chebyshevCoefficients_.data();
  return view;
}

// g/RT = a0 (1 - ln T) - a1 T/2 - a2 T^2/6 - a3 T^3/12 - a4 T^4/20 + a5/T - a6, times log2(e).
void BatchTables::setSpecies(const Mechanism& mechanism) {
  logStandard_ = std::log2(constants::oneAtmosphere / constants::gasConstant);
  constexpr double byGibbs[7] = {1.0, -1.0 / 2, -1.0 / 6, -1.0 / 12, -1.0 / 20, 1.0, -1.0};
  for (std::size_t k = 0; k < numSpecies_; ++k) {
    const auto& species = mechanism.species(k);
    BatchNasa7 data{};
    data.mid = species.thermo.midTemperature;
    for (std::size_t i = 0; i < 7; ++i) {
      data.low[i] = kLog2E * byGibbs[i] * species.thermo.low[i];
      data.high[i] = kLog2E * byGibbs[i] * species.thermo.high[i];
    }
    nasa7_.push_back(data);
    if (!species.nasa9) continue;
    // a1..a7 of T^-2..T^4, then b1/T and b2; the first range has no lower bound.
    for (std::size_t r = 0; r < species.nasa9->ranges.size(); ++r) {
      const auto& a = species.nasa9->ranges[r];
      BatchNasa9Range range{row(k), r == 0 ? 0.0 : species.nasa9->temperatures[r], {}};
      const double inNasa7[7] = {a[2], a[3], a[4], a[5], a[6], a[7], a[8]};
      for (std::size_t i = 0; i < 7; ++i) range.c[i] = kLog2E * byGibbs[i] * inNasa7[i];
      range.c[7] = -0.5 * kLog2E * a[0];
      range.c[8] = kLog2E * a[1];
      nasa9_.push_back(range);
    }
  }
}

// Reactions with the same b and Ta share an exponential; those of pressure have none here.
void BatchTables::setExponentials(const KineticsTables& tables) {
  const std::size_t n = tables.numReactions;
  std::vector<bool> skipped(n, false);
  for (const auto r : tables.pressureLog.reaction) skipped[r] = true;
  for (const auto r : tables.chebyshev.reaction) skipped[r] = true;
  std::map<std::pair<double, double>, std::size_t> known;
  std::vector<std::optional<std::size_t>> found(n);
  for (std::size_t r = 0; r < n; ++r) {
    if (skipped[r] || (tables.b[r] == 0 && tables.Ta[r] == 0)) continue;
    const auto [at, isNew] = known.try_emplace({tables.b[r], tables.Ta[r]}, exponentials_.size());
    // A whole number, so that no digit of A is lost.
    const double logA = tables.lnA[r] < kNoRate ? 0.0 : std::round(kLog2E * tables.lnA[r]);
    if (isNew) exponentials_.push_back({logA, tables.b[r], -kLog2E * tables.Ta[r]});
    found[r] = at->second;
  }
  numEntries_ = exponentials_.size();
  const std::uint32_t one = newEntry();
  for (std::size_t r = 0; r < n; ++r) {
    const double logA = found[r] ? exponentials_[*found[r]].logA : 0.0;
    entry_.push_back(found[r] ? row(*found[r]) : one);
    A_.push_back(skipped[r] ? 1.0 : tables.sign[r] * std::exp(tables.lnA[r] - kLn2 * logA));
  }
}

// In the order in which BatchKinetics computes the factors.
void BatchTables::setGiven(const KineticsTables& tables) {
  const auto add = [this](std::size_t reaction) {
    given_.push_back({newEntry(), entry_[reaction]});
    entry_[reaction] = given_.back().entry;
  };
  for (const auto& one : tables.enthalpyDependent) add(one.reaction);
  for (const auto& one : tables.linearBurke) add(one.reaction);
}

void BatchTables::setThirdBodies(const KineticsTables& tables) {
  for (const auto& set : tables.sets) {
    const std::uint32_t begin = addTerms(set.excess);
    thirdBodies_.push_back({set.base, begin, static_cast<std::uint32_t>(terms_.size()), false});
  }
  for (const auto& use : tables.threeBody) {
    threeBody_.push_back({newEntry(), entry_[use.reaction], row(use.set)});
    entry_[use.reaction] = threeBody_.back().entry;
  }
}

void BatchTables::setFalloff(const KineticsTables& tables) {
  const auto& f = tables.falloff;
  for (std::size_t i = 0; i < f.reaction.size(); ++i) {
    const std::size_t r = f.reaction[i];
    BatchFalloff falloff{};
    falloff.entry = newEntry();
    falloff.base = entry_[r];
    falloff.set = row(f.set[i]);
    entry_[r] = falloff.entry;
    const double direction = f.direction[i];
    falloff.activated = direction < 0;
    falloff.ratio = {kLog2E * direction * (f.lnA[i] - tables.lnA[r]), direction * (f.b[i] - tables.b[r]),
                     -kLog2E * direction * (f.Ta[i] - tables.Ta[r]), 0.0};
    falloff.first = row(factorExponentials_.size());
    factorExponentials_.push_back(falloff.ratio);
    falloff.shift0 = f.shift0[i];
    falloff.shift1 = f.shift1[i] * kLog10Of2;
    falloff.width0 = f.width0[i];
    falloff.width1 = f.width1[i] * kLog10Of2;
    falloff.slope = f.slope[i];
    falloff.logScale = kLog2E * f.lnScale[i];
    falloff.scaleExponent = f.scaleExponent[i];
    const auto addTerm = [&](double weight, double byT, double byInverse) {
      if (weight == 0) return;
      falloff.weight[falloff.numTerms++] = weight;
      factorExponentials_.push_back({0.0, 0.0, kLog2E * byInverse, kLog2E * byT});
    };
    falloff.byT = f.byT[i];
    addTerm(f.w3[i], -f.inverseT3[i], 0.0);
    addTerm(f.w1[i], -f.inverseT1[i], 0.0);
    addTerm(f.w2[i], 0.0, -f.T2[i]);
    const auto& last = factorExponentials_.back();
    const bool centreIsOne = falloff.numTerms == 1 && falloff.weight[0] == 1 && last.Ta == 0 && last.byT == 0 &&
                             falloff.byT == 0 && falloff.logScale == 0 && falloff.scaleExponent == 0;
    if (centreIsOne) {
      factorExponentials_.pop_back();
      lindemann_.push_back(falloff);
    } else {
      broadened_.push_back(falloff);
      thirdBodies_[f.set[i]].logarithm = true;
    }
  }
}

void BatchTables::setPressureRates(const KineticsTables& tables) {
  const auto& p = tables.pressureLog;
  for (std::size_t e = 0; e < p.lnA.size(); ++e)
    pressureRates_.push_back({p.sign[e], kLog2E * p.lnA[e], p.b[e], -kLog2E * p.Ta[e]});
  for (std::size_t i = 0; i < p.reaction.size(); ++i) {
    for (std::size_t j = p.points[i]; j < p.points[i + 1]; ++j) {
      const double logP = kLog2E * p.lnPressure[j];
      const double width = j == p.points[i] ? 1.0 : kLog2E * (p.lnPressure[j] - p.lnPressure[j - 1]);
      levels_.push_back(
          {logP, 1.0 / width, static_cast<std::uint32_t>(p.rates[j]), static_cast<std::uint32_t>(p.rates[j + 1])});
    }
    entry_[p.reaction[i]] = newEntry();
    pressureLog_.push_back(
        {entry_[p.reaction[i]], static_cast<std::uint32_t>(p.points[i]), static_cast<std::uint32_t>(p.points[i + 1])});
  }
  const auto& c = tables.chebyshev;
  for (const double a : c.coefficients) chebyshevCoefficients_.push_back(kLog2E * a);
  for (std::size_t i = 0; i < c.reaction.size(); ++i) {
    entry_[c.reaction[i]] = newEntry();
    chebyshev_.push_back({entry_[c.reaction[i]], static_cast<std::uint32_t>(c.numT[i]),
                          static_cast<std::uint32_t>(c.numP[i]), static_cast<std::uint32_t>(c.first[i]), c.scaleT[i],
                          c.shiftT[i], kLn2 * c.scaleP[i], c.shiftP[i]});
  }
}

std::uint32_t BatchTables::addTerms(const std::vector<StoichiometricTerm>& terms) {
  const auto begin = static_cast<std::uint32_t>(terms_.size());
  for (const auto& term : terms) terms_.push_back({row(term.species), term.coefficient});
  return begin;
}

}  // namespace lampblack::chemistry
