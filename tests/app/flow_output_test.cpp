// The mesh as the results file gets it, and the history's rows and columns.
#include "app/problems/flow/flow_output.hpp"

#include <algorithm>
#include <map>

#include "core/modules.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/core/mpi_support.hpp"

namespace lampblack::app {
namespace {

using test::at;

TEST(MeshOutput, HasCounterClockwiseQuadrilateralsInGlobalNumbers) {
  const FlowCase flowCase = readFlowCase(test::flameDeck());
  const Mesh mesh(MPI_COMM_WORLD, flowCase.mesh);
  const MeshOutput out = meshOutput(mesh);
  EXPECT_EQ(out.dimension, 2);
  EXPECT_EQ(out.totalCells, 60);
  EXPECT_EQ(out.totalVertices, 7 * 11);
  ASSERT_EQ(out.globalCell.size(), at(mesh.owned));
  ASSERT_EQ(out.connectivity.size(), 4 * at(mesh.owned));
  ASSERT_EQ(out.vertexCoordinates.size(), 3 * out.globalVertex.size());
  EXPECT_TRUE(std::is_sorted(out.globalVertex.begin(), out.globalVertex.end()));

  std::map<std::int64_t, std::array<double, 2>> vertices;
  for (std::size_t v = 0; v < out.globalVertex.size(); ++v)
    vertices[out.globalVertex[v]] = {out.vertexCoordinates[3 * v], out.vertexCoordinates[3 * v + 1]};
  for (std::size_t c = 0; c < at(mesh.owned); ++c) {
    double area = 0.0;
    std::array<double, 2> middle{};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int64_t here = out.connectivity[4 * c + k];
      const std::int64_t next = out.connectivity[4 * c + (k + 1) % 4];
      ASSERT_TRUE(vertices.contains(here)) << "a corner this rank does not send";
      const auto& a = vertices[here];
      const auto& b = vertices[next];
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
      for (std::size_t axis = 0; axis < 2; ++axis) middle[axis] += 0.25 * a[axis];
      // Vertices are numbered along the first axis first.
      EXPECT_EQ(a[0], mesh.box->vertices[0][static_cast<std::size_t>(here % 7)]);
      EXPECT_EQ(a[1], mesh.box->vertices[1][static_cast<std::size_t>(here / 7)]);
    }
    EXPECT_NEAR(area, mesh.planarArea[c], 1e-12 * mesh.planarArea[c]) << "positive: counter-clockwise";
    for (std::size_t axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(middle[axis], mesh.centre[c][axis], 1e-15);
      EXPECT_EQ(out.cellCentre[3 * c + axis], mesh.centre[c][axis]);
    }
    EXPECT_EQ(out.cellVolume[c], mesh.volume[c]);
    EXPECT_EQ(out.globalCell[c], mesh.naturalCell[c]);
  }
  // All ranks together: each cell once, the volume of the cylinder per radian.
  std::vector<std::int64_t> cells = test::gatherAll(out.globalCell);
  std::sort(cells.begin(), cells.end());
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(cells[i], static_cast<std::int64_t>(i));
  double volume = 0.0;
  for (double v : out.cellVolume) volume += v;
  EXPECT_NEAR(test::sumOverRanks(volume), 0.5 * 14e-3 * 14e-3 * 8e-3, 1e-18);
}

// A new operator is its own file and nothing else: a spark that heats every cell at a rate.
class Spark final : public Operator {
 public:
  [[nodiscard]] const char* name() const override { return "spark"; }
  void advance(State& state, double, double dt) override {
    for (double& T : state.temperature) T += 1e6 * dt;
    ++sparks_;
  }
  [[nodiscard]] std::vector<Quantity> historyColumns() const override { return {{"sparks", "1", "so far"}}; }
  [[nodiscard]] std::vector<double> historyValues(const State&) override { return {sparks_}; }
  void fields(const State& state, const FieldSink& sink) const override {
    sink({"spark", "K", "temperature after it"}, state.temperature);
  }

 private:
  double sparks_ = 0;
};

TEST(History, HasAValueForEveryColumnOfEveryOperator) {
  const Mesh mesh(MPI_COMM_WORLD, readFlowCase(test::flameDeck()).mesh);
  State state(mesh, 2, {});
  Spark spark;
  spark.advance(state, 0.0, 1e-6);
  HistoryRow row;
  row.budget = {{"mass", 1.0, 0.0, 0.0, 0.0}};
  row.operators = spark.historyValues(state);
  const std::vector<Quantity> columns = historyColumns(mesh, {&spark}, row.budget);
  const std::vector<double> values = historyValues(row);
  ASSERT_EQ(columns.size(), values.size());
  const auto place = std::ranges::find(columns, "sparks", &Quantity::name) - columns.begin();
  EXPECT_EQ(values.at(static_cast<std::size_t>(place)), 1);
  const auto content = std::ranges::find(columns, "mass_content", &Quantity::name);
  ASSERT_NE(content, columns.end());
  EXPECT_EQ(content->unit, "kg/rad");
  std::vector<std::string> fields;
  spark.fields(state, [&](const Quantity& field, std::span<const double>) { fields.push_back(field.name); });
  EXPECT_EQ(fields, std::vector<std::string>{"spark"});
}

}  // namespace
}  // namespace lampblack::app
