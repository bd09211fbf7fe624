// What is said of a cycle, of a trace whose numbers are known.
#include "chemistry/reactor/engine/engine_indicators.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;

// 2 deg a ms; at constant volume the pressure rises as the heat, between 10 and 20 deg.
EngineTrace knownTrace() {
  EngineTrace trace;
  for (int k = 0; k <= 30; ++k) {
    const double angle = k, burnt = std::clamp((angle - 10) / 10, 0.0, 1.0);
    trace.angle.push_back(angle);
    trace.time.push_back(0.5e-3 * angle);
    trace.volume.push_back(1e-4);
    trace.pressure.push_back(1e6 + 4e6 * burnt);
    trace.temperature.push_back(1000 + 1000 * burnt);
    trace.gamma.push_back(1.3);
    trace.chemical.push_back(500 * burnt);
  }
  return trace;
}

TEST(EngineIndicators, AnglesOfTheHeat) {
  const EngineTrace trace = knownTrace();
  EXPECT_NEAR(burntAngle(trace, 0.1), 11, 1e-12);
  EXPECT_NEAR(burntAngle(trace, 0.5), 15, 1e-12);
  EXPECT_NEAR(burntAngle(trace, 0.95), 19.5, 1e-12);
  EngineTrace cold = trace;
  for (double& q : cold.chemical) q = 0;
  EXPECT_TRUE(std::isnan(burntAngle(cold, 0.5)));
}

TEST(EngineIndicators, NetHeat) {
  EngineTrace trace = knownTrace();
  EXPECT_NEAR(netHeatRelease(trace)[15], 1e-4 * 4e5 / 0.3, 1e-9);
  EXPECT_NEAR(netHeatRelease(trace)[5], 0, 1e-9);
  // Expansion at constant pressure.
  for (std::size_t k = 0; k < trace.angle.size(); ++k) {
    trace.pressure[k] = 2e6;
    trace.volume[k] = 1e-4 + 1e-6 * trace.angle[k];
  }
  EXPECT_NEAR(netHeatRelease(trace)[15], 1.3 / 0.3 * 2e6 * 1e-6, 1e-9);
}

// A jump within a short step counts as the rise over the window, whose begin lies between points; what comes before a
// whole window does not count.
TEST(EngineIndicators, PeaksOfUnevenSteps) {
  EnginePeaks peaks;
  peaks.begin(1e-3, 0, 1e6);
  EXPECT_TRUE(peaks.add(0.5e-3, 3e6));
  EXPECT_DOUBLE_EQ(peaks.rise(), 0);
  EXPECT_TRUE(peaks.add(1.25e-3, 3.1e6));
  EXPECT_NEAR(peaks.rise(), 1.1e9, 1e-3);  // from 2 MPa at 0.25 ms
  EXPECT_TRUE(peaks.add(1.26e-3, 4.1e6));
  EXPECT_NEAR(peaks.rise(), (4.1e6 - 2.04e6) / 1e-3, 1e-3);
  peaks.setGas(2000, 1.3, 290);
  EXPECT_FALSE(peaks.add(2.5e-3, 4.0e6));
  EXPECT_DOUBLE_EQ(peaks.pressure(), 4.1e6);
  EXPECT_DOUBLE_EQ(peaks.time(), 1.26e-3);
  const double swing = 5e-5 * 2.06e9;
  EXPECT_NEAR(peaks.ringing(), swing * swing / (2 * 1.3 * 4.1e6) * std::sqrt(1.3 * 290 * 2000), 1e-3);
  EnginePeaks copy;
  copy.unpack(peaks.packed());
  EXPECT_EQ(copy.packed(), peaks.packed());
  EXPECT_EQ(copy.add(2.6e-3, 9e6), peaks.add(2.6e-3, 9e6));
  EXPECT_DOUBLE_EQ(copy.rise(), peaks.rise());
}

}  // namespace
