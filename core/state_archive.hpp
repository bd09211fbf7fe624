// What a run keeps from step to step, named piece by piece. One function of an owner (an operator, a state, a budget)
// names its pieces for both ways: a checkpoint that is written reads them, one that is read fills them. So what is
// saved and what is loaded cannot differ. Everything is collective, in the same order on all ranks.
#pragma once

#include <concepts>
#include <span>
#include <string>
#include <vector>

namespace lampblack {

class StateArchive {
 public:
  virtual ~StateArchive() = default;

  // Whether values are filled; otherwise they are read.
  [[nodiscard]] virtual bool loading() const = 0;

  // `width` values for each owned cell, or each local face. The vector has its size already and may be longer: what
  // follows the owned cells (the halo) is left alone.
  virtual void cells(const std::string& name, std::vector<double>& values, int width) = 0;
  virtual void faces(const std::string& name, std::vector<double>& values, int width) = 0;
  // A row of doubles of any length, none perhaps, for each owned cell. The vector has its size already, as above; the
  // rows get theirs where they are filled.
  virtual void rows(const std::string& name, std::vector<std::vector<double>>& values) = 0;
  // Each rank's part of sums over all ranks. Another number of ranks gets the sums on rank 0, and zero elsewhere.
  virtual void sums(const std::string& name, std::span<double> values) = 0;
  // The same on all ranks, of any length; rank 0's are saved.
  virtual void shared(const std::string& name, std::vector<double>& values) = 0;

  void shared(const std::string& name, double& value) {
    std::vector<double> values{value};
    shared(name, values);
    value = values.at(0);
  }
  // Counts and flags, below 2^53.
  template <std::integral Number>
  void shared(const std::string& name, Number& number) {
    auto value = static_cast<double>(number);
    shared(name, value);
    number = static_cast<Number>(value);
  }

 protected:
  StateArchive() = default;
  StateArchive(const StateArchive&) = default;
  StateArchive& operator=(const StateArchive&) = default;
};

}  // namespace lampblack
