// How far fields that are formulas of time are from steady, and whether they repeat themselves.
#include "flow/steady/steadiness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/state_backup.hpp"
#include "flow/steady/periodicity.hpp"
#include "tests/flow/flow_fixture.hpp"

namespace lampblack::flow {
namespace {

using namespace lampblack::test;
using std::numbers::pi;

// Recorded at uneven times from 0 to `end`, as steps are.
std::vector<double> unevenTimes(double end, int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(end * (i + 0.3 * std::sin(7.0 * i)) / count);
  return times;
}
RecordedSignal signalOf(const std::vector<double>& times, const std::function<double(double)>& value,
                        double scale = 1.0) {
  RecordedSignal signal{{}, scale};
  for (const double t : times) signal.values.push_back(value(t));
  return signal;
}

TEST(Periodicity, IsTheTimeAfterWhichAllSignalsAreWhatTheyWere) {
  constexpr double period = 0.37;
  const std::vector<double> times = unevenTimes(2.5, 900);
  const auto wave = [](double t) { return std::sin(2.0 * pi * t / period); };
  // Of vortices that are shed by turns: momentum across, energy at twice the frequency, a pulse with two tops.
  const std::vector<RecordedSignal> shed{
      signalOf(times, [&](double t) { return 3.0 + 0.1 * wave(t); }),
      signalOf(times, [&](double t) { return wave(t) * wave(t); }),
      signalOf(times, [&](double t) { return wave(t) + 1.5 * wave(2.0 * t) + 1.2 * wave(3.0 * t); }),
      signalOf(times, [](double) { return 7.0; })};
  const auto found = periodicityOf(times, shed);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->period, period, 5e-4 * period);
  EXPECT_NEAR(found->ranges[0].low, 2.9, 1e-3);
  EXPECT_NEAR(found->ranges[0].high, 3.1, 1e-3);
  const auto pulse = periodicityOf(times, std::vector{shed[2]});
  ASSERT_TRUE(pulse) << "passes the middle more than once";
  EXPECT_NEAR(pulse->period, period, 5e-4 * period);
  const auto energy = periodicityOf(times, std::vector{shed[1]});
  ASSERT_TRUE(energy);
  EXPECT_NEAR(energy->period, 0.5 * period, 2e-3 * period);
  EXPECT_TRUE(
      periodicityOf(times, std::vector{signalOf(times, [&](double t) { return 20.0 * std::exp(-9.0 * t) + wave(t); })}))
      << "what was before the waves";
}

TEST(Periodicity, IsNotSeenWhereThereIsNone) {
  const std::vector<double> times = unevenTimes(2.5, 900);
  const auto isSeen = [&](const std::function<double(double)>& value) {
    return periodicityOf(times, std::vector{signalOf(times, value)}).has_value();
  };
  EXPECT_TRUE(isSeen([](double t) { return std::sin(20.0 * t); }));
  EXPECT_FALSE(isSeen([](double t) { return std::exp(-t); }));
  EXPECT_FALSE(isSeen([](double t) { return std::exp(t) * std::sin(20.0 * t); })) << "grows by a third each time";
  EXPECT_FALSE(isSeen([](double t) { return std::sin(20.0 * t * t); })) << "ever faster";
  EXPECT_FALSE(isSeen([](double t) { return std::sin(20.0 * t) + std::sin(20.0 * std::numbers::sqrt2 * t); }));
  EXPECT_FALSE(isSeen([](double t) { return std::sin(5.0 * t); })) << "two periods";
  EXPECT_FALSE(isSeen([](double t) { return 1e-7 * std::sin(20.0 * t); })) << "noise";
  EXPECT_FALSE(isSeen([](double) { return 1.0; }));
  EXPECT_FALSE(periodicityOf(times, std::vector{signalOf(times, [](double t) { return std::sin(20.0 * t); }),
                                                signalOf(times, [](double t) { return 0.5 * t; })}));
}

constexpr double length = 0.2, height = 0.05;  // m

// A channel with a gas whose state is set from outside.
struct Channel : Box {
  explicit Channel(Steadiness::Options options = {})
      : Box(Geometry::Planar, {uniformAxis(length, 16), uniformAxis(height, 4), {}},
            {opening(BoundaryKind::Inlet, 0, false, 1.0, 300.0, air()),
             opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, air()), side(BoundaryKind::Wall, 1, false),
             side(BoundaryKind::Wall, 1, true)}),
        present(state([&](const Vector3&) {
          return Local{{}, 300.0, air()};
        })),
        steadiness(context, present, options) {
    properties.update(context, present);
    steadiness.begin(present, 0.0);
  }
  static std::vector<double> air() { return Gas::hydrogen().massFractions("O2: 1, N2: 4"); }

  void set(const std::function<double(const Vector3&)>& temperature) {
    for (int c = 0; c < mesh.owned; ++c) present.temperature[at(c)] = temperature(mesh.centre[at(c)]);
  }
  void add(double time) {
    steadiness.add(
        present, properties, [this] { return std::vector<double>(at(mesh.owned), 0.0); }, time);
  }
  // Steps until it is steady, of temperatures over place and time.
  double steadyAt(const std::function<double(const Vector3&, double)>& temperature, double dt, double tolerance,
                  double end, Steadiness::Norm norm = Steadiness::Norm::Maximum) {
    set([&](const Vector3& x) { return temperature(x, 0.0); });
    steadiness.begin(present, 0.0);
    for (double t = dt; t < end; t += dt) {
      set([&](const Vector3& x) { return temperature(x, t); });
      add(t);
      if (steadiness.isSteady(tolerance, norm)) return t;
    }
    return end;
  }

  State present;
  GasProperties properties;
  Steadiness steadiness;
};

// A profile to which the gas decays.
double decay(const Vector3& x, double t) {
  return 300.0 + 1000.0 * x[0] / length + 400.0 * std::sin(pi * x[0] / length) * std::exp(-t);
}

TEST(Steadiness, OfADecayIsReachedWhenItsKnownRateSaysWhateverTheStep) {
  constexpr double time = 0.5, tolerance = 1e-3;
  Channel channel({time});
  const double widest = std::sin(pi * (0.5 - 0.5 / 16)), range = 1000.0 * 15.0 / 16.0;  // at the cells
  // The change over the time, relative to the range.
  const auto changeAt = [&](double t, double part) {
    return 400.0 * part * (std::exp(time) - 1.0) * std::exp(-t) / range;
  };
  for (const double dt : {0.125, 0.02, 0.005}) {
    const double steady = channel.steadyAt(decay, dt, tolerance, 20.0);
    EXPECT_LE(changeAt(steady, widest), 1.001 * tolerance) << dt;
    EXPECT_GE(changeAt(steady - time / 4 - dt, widest), tolerance) << dt;
    const auto change = channel.steadiness.change(Steadiness::Norm::Maximum);
    ASSERT_TRUE(change);
    EXPECT_NEAR(change->value, changeAt(steady, widest), (0.01 + 1.5 * dt) * tolerance);  // pieces end with a step
    EXPECT_EQ(change->field, "temperature");
    EXPECT_NEAR(change->place[0], length / 2, length / 16);
    // The root of the mean square of the sine is that of one half.
    const auto rms = channel.steadiness.change(Steadiness::Norm::Rms);
    EXPECT_NEAR(rms->value, changeAt(steady, std::sqrt(0.5)), (0.01 + 1.5 * dt) * tolerance);
  }
  const double earlier = channel.steadyAt(decay, 0.02, tolerance, 20.0, Steadiness::Norm::Rms);
  EXPECT_LE(changeAt(earlier, std::sqrt(0.5)), 1.001 * tolerance);
  EXPECT_GT(changeAt(earlier, widest), tolerance);
}

TEST(Steadiness, IsNotTakenForGranted) {
  constexpr double time = 0.5, tolerance = 1e-3;
  const auto isReached = [&](double dt, double end, const std::function<double(const Vector3&, double)>& temperature) {
    Channel channel({time});
    return channel.steadyAt(temperature, dt, tolerance, end) < end;
  };
  const auto profile = [](const Vector3& x) { return 300.0 + 1000.0 * x[0] / length; };
  EXPECT_TRUE(isReached(0.01, 0.6, [&](const Vector3& x, double) { return profile(x); }));
  EXPECT_FALSE(isReached(1e-5, 1e-3, [&](const Vector3& x, double) { return profile(x); }))
      << "steps too short to do much";
  EXPECT_FALSE(isReached(0.02, 3.0, [&](const Vector3& x, double t) {
    return profile(x) + 0.01 * std::exp(2.0 * t) * std::sin(pi * x[0] / length);
  })) << "nothing has happened yet, but it grows";
  for (const double period : {time, time / 4, time / 8, 0.3, 3.0})
    EXPECT_FALSE(isReached(
        0.01, 10.0, [&](const Vector3& x, double t) { return profile(x) + 5.0 * std::sin(2.0 * pi * t / period); }))
        << "the same whenever one looks, every " << period;
}

TEST(Steadiness, CountsTheTimeThatTheFlowGives) {
  Channel channel;
  const auto timeWith = [&](double speed, double inflow) {
    for (int c = 0; c < channel.mesh.owned; ++c) channel.present.velocity[at(2 * c)] = speed;
    for (int f = channel.mesh.interiorFaces; f < channel.mesh.faces; ++f) {
      const double normal = channel.mesh.normal[at(f)][0];
      channel.present.massFlux[at(f)] = inflow * normal * channel.mesh.area[at(f)];
    }
    channel.steadiness.begin(channel.present, 0.0);
    channel.add(1e-4);
    channel.add(3e-4);
    return channel.steadiness.time();
  };
  const double density = channel.present.density[0];
  EXPECT_NEAR(timeWith(2.0, 2.0 * density), length / 2.0, 1e-12);
  EXPECT_NEAR(channel.steadiness.leastHeat(), 3.0 * 2.0 * density * height, 1e-9 * density) << "3 J of a kilogram";
  const double size = std::sqrt(length * height);
  EXPECT_NEAR(timeWith(2.0, 0.0), size / 2.0, 1e-12);
  const double diffusivity = channel.properties.conductivity[0] / channel.properties.heatCapacity[0] / density;
  EXPECT_NEAR(timeWith(0.0, 0.0), size * size / diffusivity, 1e-9);
  EXPECT_NEAR(timeWith(1e-9, 0.0), size * size / diffusivity, 1e-9);

  // A closed can counts all around.
  Box can(Geometry::Axisymmetric, {uniformAxis(0.02, 4), uniformAxis(0.1, 8), {}},
          {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
           side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)});
  const State moving = can.state([](const Vector3&) { return Box::Local{{0.0, 2.0, 0.0}, 300.0, Channel::air()}; });
  GasProperties properties;
  properties.update(can.context, moving);
  Steadiness steadiness(can.context, moving, {});
  steadiness.begin(moving, 0.0);
  steadiness.add(
      moving, properties, [&] { return std::vector<double>(test::at(can.mesh.owned), 0.0); }, 1e-4);
  EXPECT_NEAR(steadiness.time(), std::cbrt(pi * 0.02 * 0.02 * 0.1) / 2.0, 1e-12);
}

TEST(Steadiness, LooksAtAllFieldsEachAgainstItsRange) {
  constexpr double time = 1.0;
  const auto changeWith = [&](const std::function<void(Channel&, double)>& set) {
    Channel channel({time});
    for (int c = 0; c < channel.mesh.owned; ++c)
      channel.present.temperature[at(c)] = decay(channel.mesh.centre[at(c)], 50.0);
    for (int i = 0; i <= 20; ++i) {
      set(channel, i / 20.0);
      if (i == 0)
        channel.steadiness.begin(channel.present, 0.0);
      else
        channel.add(i / 20.0);
    }
    return channel.steadiness.change(Steadiness::Norm::Maximum).value();
  };
  const auto still = changeWith([](Channel&, double) {});
  EXPECT_EQ(still.value, 0.0);
  EXPECT_TRUE(still.isWhole);
  // Of every field a profile, and one cell in which it moves by 1 % of that.
  const auto isMoved = [](const Channel& channel, int c) { return channel.mesh.naturalCell[at(c)] == 5; };
  const auto velocity = changeWith([&](Channel& channel, double t) {
    for (int c = 0; c < channel.mesh.owned; ++c)
      channel.present.velocity[at(2 * c + 1)] =
          3.0 * channel.mesh.centre[at(c)][0] / length + (isMoved(channel, c) ? 0.03 * t : 0.0);
  });
  EXPECT_EQ(velocity.field, "velocity");
  EXPECT_NEAR(velocity.value, 0.01, 2e-3);
  const auto species = changeWith([&](Channel& channel, double t) {
    for (int c = 0; c < channel.mesh.owned; ++c)
      channel.present.Y[at(c) * at(channel.present.species) + 3] =
          1e-4 * channel.mesh.centre[at(c)][0] / length + (isMoved(channel, c) ? 1e-6 * t : 0.0);
  });
  EXPECT_EQ(species.field, "mass fraction of " + Gas::hydrogen().mechanism.speciesName(3));
  EXPECT_NEAR(species.value, 0.01, 2e-3);
  const auto noise = changeWith([&](Channel& channel, double t) {
    for (int c = 0; c < channel.mesh.owned; ++c) {
      const double place = channel.mesh.centre[at(c)][0] / length;
      channel.present.Y[at(c) * at(channel.present.species) + 3] = 1e-20 * (place + t);
      channel.present.velocity[at(2 * c)] = 1e-12 * (place + t);
      channel.present.temperature[at(c)] = 300.0 + 1e-10 * (place + t);
    }
  });
  EXPECT_LT(noise.value, 1e-6) << "what is the same everywhere, at rest or a trace has no scale of its own";
  const auto pressure =
      changeWith([](Channel& channel, double t) { channel.present.thermodynamicPressure = 1e5 + 1e3 * t; });
  EXPECT_EQ(pressure.field, "thermodynamic pressure");
  EXPECT_NEAR(pressure.value, 0.01, 1e-3);
}

TEST(Steadiness, GoesOnFromWhatWasSaved) {
  Channel whole, first, second;
  const auto at = [](const Vector3& x, double t) {
    return 300.0 + 1000.0 * x[0] / length + 100.0 * std::exp(-t) + 10.0 * std::sin(9.0 * t) * x[1] / height;
  };
  for (Channel* channel : {&whole, &first, &second})
    for (int c = 0; c < channel->mesh.owned; ++c) channel->present.velocity[test::at(2 * c)] = 0.05;  // 2 s
  const auto step = [&](Channel& channel, int i) {
    channel.set([&](const Vector3& x) { return at(x, 0.02 * i); });
    channel.add(0.02 * i);
  };
  constexpr int middle = 366, end = 750;
  for (int i = 1; i <= end; ++i) step(whole, i);
  for (int i = 1; i <= middle; ++i) step(first, i);
  StateBackup kept(first.mesh.owned, first.mesh.faces);
  kept.save([&](StateArchive& archive) { first.steadiness.saveOrLoad(archive); });
  second.steadiness.begin(second.present, 0.0);
  step(second, 1);
  kept.restore([&](StateArchive& archive) { second.steadiness.saveOrLoad(archive); });
  EXPECT_EQ(second.steadiness.lines(), first.steadiness.lines());
  for (int i = middle + 1; i <= end; ++i) step(second, i);
  EXPECT_EQ(second.steadiness.lines(), whole.steadiness.lines());
  ASSERT_TRUE(whole.steadiness.periodicity());
  EXPECT_NEAR(whole.steadiness.periodicity()->period, 2.0 * pi / 9.0, 1e-3);
  EXPECT_EQ(whole.steadiness.lines().size(), 2U);
}

}  // namespace
}  // namespace lampblack::flow
