// The tables of BatchKinetics (batch_kinetics_view.hpp) from those of Kinetics.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "chemistry/kinetics/batch_kinetics_view.hpp"
#include "chemistry/kinetics/kinetics_tables.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class BatchTables {
 public:
  BatchTables(const Mechanism& mechanism, const KineticsTables& tables);

  // Points into this object.
  BatchView view() const;

  std::size_t numSpecies() const { return numSpecies_; }
  std::size_t numEntries() const { return numEntries_; }

 private:
  struct Shape {
    std::size_t reactants = 0, products = 0;
    bool reversible = false;
    bool operator<(const Shape& other) const {
      return std::tie(reactants, products, reversible) < std::tie(other.reactants, other.products, other.reversible);
    }
  };
  struct Record {
    double A = 0;
    std::vector<std::uint32_t> rows;
  };
  struct Group {
    std::vector<std::uint32_t> rows;
    std::vector<double> A;
  };

  static std::uint32_t row(std::size_t i) { return static_cast<std::uint32_t>(i * batchLanes); }
  std::uint32_t newEntry() { return row(numEntries_++); }
  void setSpecies(const Mechanism& mechanism);
  void setExponentials(const KineticsTables& tables);
  void setGiven(const KineticsTables& tables);
  void setThirdBodies(const KineticsTables& tables);
  void setFalloff(const KineticsTables& tables);
  void setPressureRates(const KineticsTables& tables);
  void setReactions(const KineticsTables& tables);
  void orderRecords(const Shape& shape, std::vector<Record>& records);
  bool addToGroup(const KineticsTables& tables, std::size_t reaction);
  void addGeneral(const KineticsTables& tables, std::size_t reaction);
  std::uint32_t addTerms(const std::vector<StoichiometricTerm>& terms);
  void setProductRange(const KineticsTables& tables);
  bool productsAreSafe(const KineticsTables& tables, double T) const;
  double gibbs(std::size_t species, double T) const;

  std::size_t numSpecies_ = 0, numEntries_ = 0;
  double minProductTemperature_ = 0, maxProductTemperature_ = 0, logStandard_ = 0;
  std::vector<BatchNasa7> nasa7_;
  std::vector<BatchNasa9Range> nasa9_;
  std::vector<BatchThirdBody> thirdBodies_;
  std::vector<BatchExponential> exponentials_;
  std::vector<BatchGiven> given_;
  std::vector<BatchThreeBody> threeBody_;
  std::vector<BatchFactorExponential> factorExponentials_;
  std::vector<BatchFalloff> lindemann_, broadened_;
  std::vector<BatchPressureLevel> levels_;
  std::vector<BatchPressureRate> pressureRates_;
  std::vector<BatchPressureLog> pressureLog_;
  std::vector<BatchChebyshev> chebyshev_;
  std::vector<double> chebyshevCoefficients_;
  std::map<Shape, std::vector<Record>> records_;
  std::vector<Group> groups_;
  std::vector<BatchGroup> groupViews_;
  std::vector<BatchGeneral> general_;
  std::vector<BatchTerm> terms_;

  // Per reaction: the factor of its entry (A, or one where the entry has all of k), and the entry.
  std::vector<double> A_;
  std::vector<std::uint32_t> entry_;
};

}  // namespace lampblack::chemistry
