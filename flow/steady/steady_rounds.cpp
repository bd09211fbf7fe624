#include "flow/steady/steady_rounds.hpp"

#include <limits>
#include <vector>

namespace lampblack::flow {

namespace {

// With a change below so many tolerances the next round may be the last.
constexpr double timesTolerance = 3.0;

}  // namespace

void SteadyRounds::addGas(std::optional<double> change) {
  change_ = change;
  isDone_ = rounds_ >= options_.most || (isLong_ && agrees());
  if (isDone_) return;
  isLong_ =
      rounds_ + 1 >= options_.most || !options_.actsOnGas || (change && *change <= timesTolerance * options_.tolerance);
  turn_ = Turn::Particles;
}

void SteadyRounds::addParticles() {
  ++rounds_;
  isDone_ = !options_.actsOnGas;
  turn_ = Turn::Gas;
}

void SteadyRounds::saveOrLoad(StateArchive& archive) {
  std::vector<double> values{turn_ == Turn::Particles ? 1.0 : 0.0, isDone_ ? 1.0 : 0.0, static_cast<double>(rounds_),
                             isLong_ ? 1.0 : 0.0, change_.value_or(std::numeric_limits<double>::infinity())};
  archive.shared("steady_rounds", values);
  turn_ = values.at(0) != 0.0 ? Turn::Particles : Turn::Gas;
  isDone_ = values.at(1) != 0.0;
  rounds_ = static_cast<int>(values.at(2));
  isLong_ = values.at(3) != 0.0;
  change_.reset();
  if (values.at(4) < std::numeric_limits<double>::infinity()) change_ = values.at(4);
}

}  // namespace lampblack::flow
