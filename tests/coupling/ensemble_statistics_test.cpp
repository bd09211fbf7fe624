// Averages over time of cells whose amounts are noise with a known mean: how often the intervals have it, when they
// start, and that a run that goes on from what was saved goes on to the same bits.
#include "coupling/ensemble_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/state_backup.hpp"
#include "coupling/block_statistics.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/coupling/noise.hpp"
#include "tests/coupling/plain_mesh.hpp"

namespace lampblack::coupling {
namespace {

using test::Noise;
using Statistics = EnsembleStatistics;

// Cells with noise of their own, the same on any number of ranks. `level`: of the mean, at a time.
class NoisyCells {
 public:
  using Level = std::function<double(double time)>;
  NoisyCells(const Mesh& mesh, double memory, double deviation, Level level) : deviation_(deviation), level_(level) {
    for (int c = 0; c < mesh.owned; ++c)
      for (std::uint64_t kind = 0; kind < 2; ++kind)
        noise_.emplace_back(2 * static_cast<std::uint64_t>(mesh.naturalCell[static_cast<std::size_t>(c)]) + kind,
                            memory);
    now_.resize(noise_.size());
  }
  void step(double time) {
    time_ = time;
    for (std::size_t i = 0; i < noise_.size(); ++i) now_[i] = noise_[i].next();
  }
  [[nodiscard]] Statistics::Source source() const {
    return {[this](int cell) {
              const double number = level_(time_) * (1.0 + deviation_ * now_[2 * static_cast<std::size_t>(cell)]);
              const double size = 1.0 + deviation_ * now_[2 * static_cast<std::size_t>(cell) + 1];
              return Statistics::CellAmounts{number, 1e-18 * number * size, 3.0 * number, 2.0 * number * size,
                                             1e-9 * number * size};
            },
            [this](int cell, std::span<double> sizes) {
              for (std::size_t b = 0; b < sizes.size(); ++b)
                sizes[b] = static_cast<double>(b) + now_[2 * static_cast<std::size_t>(cell)];
            }};
  }

 private:
  double deviation_, time_ = 0.0;
  Level level_;
  std::vector<Noise> noise_;
  std::vector<double> now_;
};

const NoisyCells::Level flat = [](double) { return 1e15; };

using Fields = std::map<std::string, std::vector<double>>;
Fields fieldsOf(const Statistics& statistics, bool future = false) {
  Fields fields;
  Operator::FieldSink sink = [&](const Quantity& field, std::span<const double> values) {
    fields[field.name].assign(values.begin(), values.end());
  };
  sink.future = future;
  statistics.fields(sink);
  return fields;
}

// Steps of changing length, of about 1e-5 s.
struct Clock {
  double time = 0.0;
  int steps = 0;
  double next() {
    const double dt = 1e-5 * (1.0 + 0.5 * std::sin(0.7 * ++steps));
    time += dt;
    return dt;
  }
};

void run(Statistics& statistics, NoisyCells& cells, Clock& clock, double until) {
  while (clock.time < until) {
    const double dt = clock.next();
    cells.step(clock.time);
    statistics.addStep(clock.time, dt, cells.source());
  }
}

// Many cells are many repeats: the share of them whose interval has the true mean. Their noise forgets in five steps,
// a twentieth of a block.
TEST(EnsembleStatistics, IntervalsHaveTheMeanIn95Cases) {
  const Mesh mesh(MPI_COMM_WORLD, test::plainBox(60, 50));
  Statistics statistics(mesh, "soot", {0.0, 1e-3}, {});
  NoisyCells cells(mesh, std::exp(-0.2), 0.2, flat);
  Clock clock;
  run(statistics, cells, clock, 8.05e-3);
  ASSERT_EQ(statistics.blocks(), 8U);
  const Fields fields = fieldsOf(statistics);
  const std::map<std::string, double> exact{
      {"soot_number_density", 1e15}, {"soot_volume_fraction", 1e-3}, {"soot_mobility_diameter", 1e-9}};
  for (const auto& [name, value] : exact) {
    const std::vector<double>& mean = fields.at(name + "_mean");
    const std::vector<double>& interval = fields.at(name + "_interval");
    double inside = 0.0;
    for (std::size_t c = 0; c < mean.size(); ++c)
      if (std::abs(mean[c] - value) <= interval[c]) inside += 1.0;
    const double share = test::sumOverRanks(inside) / 3000.0;
    // 3.3 deviations of a share of 3000, and 0.005 for what correlation is left.
    EXPECT_NEAR(share, 0.95, 3.3 * std::sqrt(0.95 * 0.05 / 3000.0) + 0.005) << name;
  }
}

TEST(EnsembleStatistics, MeansAreWeightedWithTheSteps) {
  const Mesh mesh(MPI_COMM_WORLD, test::plainBox(4, 3));
  Statistics statistics(mesh, "soot", {1.0, 2.0}, SizeBins{-9.0, -6.0, 3});
  double amount = 0.0;
  const Statistics::Source source{
      [&](int) {
        return Statistics::CellAmounts{amount, 2.0 * amount, 0.0, 0.0, 3.0 * amount * amount};
      },
      [&](int, std::span<double> sizes) { sizes[1] = amount; }};
  double time = 0.0;
  // Before one second nothing counts. Blocks end with the steps that fill them: 0.5 + 1.5, 2.5, 2 and a rest.
  const std::vector<std::pair<double, double>> steps{{1.0, 7.0}, {0.5, 1.0}, {1.5, 2.0},  {1.0, 3.0},
                                                     {1.5, 4.0}, {2.0, 5.0}, {1.0, 100.0}};
  for (const auto& [dt, value] : steps) {
    amount = value;
    time += dt;
    statistics.addStep(time, dt, source);
  }
  EXPECT_EQ(statistics.since(), 1.0);
  ASSERT_EQ(statistics.blocks(), 3U);
  const double blocks[] = {(0.5 + 3.0) / 2.0, (3.0 + 6.0) / 2.5, 5.0};
  const double mean = (blocks[0] + blocks[1] + blocks[2]) / 3.0;
  const Fields fields = fieldsOf(statistics), later = fieldsOf(statistics, true);
  EXPECT_EQ(fields.count("soot_volume_fraction_interval"), 0U) << "three blocks have none";
  ASSERT_EQ(later.count("soot_volume_fraction_interval"), 1U);
  for (int c = 0; c < mesh.owned; ++c) {
    const auto cell = static_cast<std::size_t>(c);
    EXPECT_NEAR(fields.at("soot_number_density_mean")[cell], mean, 1e-14);
    EXPECT_NEAR(fields.at("soot_volume_fraction_mean")[cell], 2.0 * mean, 1e-14);
    EXPECT_TRUE(std::isnan(later.at("soot_volume_fraction_interval")[cell]));
    const double squares = ((0.5 + 6.0) / 2.0 + (9.0 + 24.0) / 2.5 + 25.0) / 3.0;
    EXPECT_NEAR(fields.at("soot_mobility_diameter_mean")[cell], 3.0 * squares / mean, 1e-13);
    // Of all steps since the start, also those of a block that has not ended.
    EXPECT_NEAR(fields.at("soot_size_distribution_mean")[3 * cell + 1], (0.5 + 3.0 + 3.0 + 6.0 + 10.0 + 100.0) / 7.5,
                1e-13);
    EXPECT_EQ(fields.at("soot_size_distribution_mean")[3 * cell], 0.0);
  }
}

TEST(EnsembleStatistics, StartByThemselvesWhenNothingGrows) {
  const Mesh mesh(MPI_COMM_WORLD, test::plainBox(8, 8));
  constexpr double grows = 12e-3;  // s
  NoisyCells cells(mesh, std::exp(-0.2), 0.2, [](double t) { return 1e15 * std::min(1.0, 0.01 + t / grows); });
  Statistics statistics(mesh, "soot", {{}, 1e-3, 0.0}, {});
  Clock clock;
  run(statistics, cells, clock, grows);
  EXPECT_FALSE(statistics.since());
  EXPECT_TRUE(fieldsOf(statistics).empty());
  ASSERT_EQ(statistics.closingLines().size(), 1U);
  EXPECT_NE(statistics.closingLines()[0].find("not stationary yet"), std::string::npos);
  run(statistics, cells, clock, 60e-3);
  ASSERT_TRUE(statistics.since());
  EXPECT_GT(*statistics.since(), grows + 4e-3) << "not with the growth in the later half of the blocks";
  EXPECT_LT(*statistics.since(), 40e-3);
  EXPECT_NEAR(static_cast<double>(statistics.blocks()), (clock.time - *statistics.since()) / 1e-3, 1.5);
  EXPECT_NE(statistics.closingLines()[0].find("found stationary"), std::string::npos);
  EXPECT_EQ(statistics.closingLines().size(), 2U) << "blocks of the growth, which are correlated, do not count";
  // The cells know nothing of the growth.
  const Fields fields = fieldsOf(statistics);
  for (int c = 0; c < mesh.owned; ++c)
    EXPECT_NEAR(fields.at("soot_number_density_mean")[static_cast<std::size_t>(c)], 1e15, 0.03e15);
}

TEST(EnsembleStatistics, WaitForVolumeAndNumber) {
  const Mesh mesh(MPI_COMM_WORLD, test::plainBox(4, 3));
  for (const bool numberGrows : {false, true}) {
    Statistics statistics(mesh, "soot", {{}, 1e-3}, {});
    Noise noise(1, 0.0);
    double growing = 0.0, steady = 0.0;
    const Statistics::Source source{
        [&](int) {
          return Statistics::CellAmounts{numberGrows ? growing : steady, numberGrows ? steady : growing, 1.0, 1.0, 1.0};
        },
        {}};
    for (int block = 1; block <= 30; ++block) {
      growing = block;
      steady = 10.0 + noise.next();
      statistics.addStep(1e-3 * block, 1e-3, source);
    }
    EXPECT_FALSE(statistics.since()) << numberGrows;
  }
}

TEST(EnsembleStatistics, WarnsOfShortBlocks) {
  const Mesh mesh(MPI_COMM_WORLD, test::plainBox(3, 3));
  for (const bool tooShort : {false, true}) {
    Statistics statistics(mesh, "soot", {0.0, tooShort ? 1e-3 : 20e-3}, {});
    NoisyCells cells(mesh, std::exp(-0.01), 0.2, flat);  // forgets in 1 ms
    Clock clock;
    run(statistics, cells, clock, tooShort ? 30e-3 : 400e-3);
    const std::vector<std::string> lines = statistics.closingLines();
    ASSERT_EQ(lines.size(), tooShort ? 3U : 2U);
    if (tooShort) {
      EXPECT_NE(lines[2].find("warning: the blocks of 1 ms are correlated"), std::string::npos);
    }
  }
}

TEST(EnsembleStatistics, GoOnFromWhatWasSavedToTheSameBits) {
  const Mesh mesh(MPI_COMM_WORLD, test::plainBox(6, 5));
  const SizeBins bins{-9.0, -6.0, 4};
  const NoisyCells::Level level = [](double t) { return 1e15 * (1.0 - std::exp(-t / 2e-3)); };
  // Before they start, and within a block after.
  for (const double middle : {4.33e-3, 33.33e-3}) {
    Statistics whole(mesh, "soot", {{}, 1e-3}, bins);
    NoisyCells cells(mesh, 0.5, 0.2, level);
    Clock clock;
    run(whole, cells, clock, middle);
    ASSERT_EQ(whole.since().has_value(), middle > 30e-3);
    StateBackup kept(mesh.owned, mesh.faces);
    kept.save([&](StateArchive& archive) { Statistics::saveOrLoad(archive, &whole); });
    NoisyCells same = cells;
    Clock sameClock = clock;
    run(whole, cells, clock, 45e-3);
    // Other blocks in the deck: those that have begun go on.
    Statistics rest(mesh, "soot", {{}, middle > 30e-3 ? 2e-3 : 1e-3}, bins);
    kept.restore([&](StateArchive& archive) { Statistics::saveOrLoad(archive, &rest); });
    run(rest, same, sameClock, 45e-3);
    EXPECT_EQ(rest.since(), whole.since());
    EXPECT_EQ(rest.blocks(), whole.blocks());
    EXPECT_GT(whole.blocks(), leastBlocks);
    EXPECT_EQ(fieldsOf(rest), fieldsOf(whole));
    EXPECT_EQ(rest.closingLines(), whole.closingLines());
  }
}

// As a checkpoint reader does, finds pieces by their names.
class Drawer final : public StateArchive {
 public:
  bool isLoading = false;
  std::map<std::string, std::vector<double>> pieces;

  [[nodiscard]] bool loading() const override { return isLoading; }
  void cells(const std::string& name, std::vector<double>& values, int) override { take(name, values); }
  void faces(const std::string& name, std::vector<double>& values, int) override { take(name, values); }
  void rows(const std::string&, std::vector<std::vector<double>>&) override {}
  void sums(const std::string& name, std::span<double> values) override {
    std::vector<double> all(values.begin(), values.end());
    take(name, all);
    std::ranges::copy(all, values.begin());
  }
  void shared(const std::string& name, std::vector<double>& values) override { take(name, values); }
  using StateArchive::shared;

 private:
  void take(const std::string& name, std::vector<double>& values) {
    if (isLoading)
      values = pieces.at(name);
    else
      pieces[name] = values;
  }
};

TEST(EnsembleStatistics, BeginAnewWhereNoneOrOthersWereSaved) {
  const Mesh mesh(MPI_COMM_WORLD, test::plainBox(4, 3));
  Statistics begun(mesh, "soot", {0.0, 1e-4}, SizeBins{-9.0, -6.0, 4});
  NoisyCells cells(mesh, 0.5, 0.2, flat);
  Clock clock;
  run(begun, cells, clock, 1e-3);
  Drawer none, some;
  Statistics::saveOrLoad(none, nullptr);
  Statistics::saveOrLoad(some, &begun);
  none.isLoading = some.isLoading = true;
  Statistics::saveOrLoad(some, nullptr);  // passed over
  for (const auto& [drawer, bins] : {std::pair{&none, SizeBins{-9.0, -6.0, 4}}, {&some, SizeBins{-9.0, -5.0, 4}}}) {
    Statistics blank(mesh, "soot", {0.0, 2e-4}, bins);
    Statistics::saveOrLoad(*drawer, &blank);
    EXPECT_FALSE(blank.since());
    EXPECT_EQ(blank.block(), 2e-4);
    EXPECT_TRUE(fieldsOf(blank).empty());
  }
}

}  // namespace
}  // namespace lampblack::coupling
