// Cell gradients and the limited interpolation to faces.
#include "flow/discretisation/gradient.hpp"

#include <gtest/gtest.h>

#include <random>

#include "flow/discretisation/limiter.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

using Function = std::function<double(double, double)>;

std::vector<Side> fourSides() {
  return {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
          side(BoundaryKind::Outlet, 1, true)};
}

// Smooth gradings whose ratio of neighbouring cells tends to one under refinement.
Box gradedBox(int refinement) {
  return {Geometry::Planar,
          {gradedAxis(0.0, {{0.4, 6, 3.0}, {1.0, 5, 0.5}}, refinement), gradedAxis(-0.5, {{0.5, 8, 0.25}}, refinement)},
          fourSides()};
}

// Largest error of both components of the gradient of `f`, whose exact derivatives are dx and dy. Boundary values are
// exact, or left out (`skip`).
double gradientError(Box& box, const Function& f, const Function& dx, const Function& dy, bool skip = false) {
  const Mesh& m = box.mesh;
  std::vector<double> values(at(m.cells));
  std::vector<double> boundary(at(m.boundaryFaces()));
  std::vector<double> gradient(at(2 * m.cells));
  for (int c = 0; c < m.cells; ++c) values[at(c)] = f(m.centre[at(c)][0], m.centre[at(c)][1]);
  for (int b = 0; b < m.boundaryFaces(); ++b) {
    const auto& x = m.faceCentre[at(m.interiorFaces + b)];
    boundary[at(b)] = skip ? std::numeric_limits<double>::quiet_NaN() : f(x[0], x[1]);
  }
  std::vector<BoundaryData> known(at(m.boundaryFaces()), BoundaryData::Nothing);
  if (!skip) known.clear();
  Gradient(m).compute(values, boundary, 1, gradient, known);
  return largest(m, [&](int c) {
    const auto& x = m.centre[at(c)];
    return std::max(std::abs(gradient[at(2 * c)] - dx(x[0], x[1])), std::abs(gradient[at(2 * c + 1)] - dy(x[0], x[1])));
  });
}

TEST(Gradient, LinearFieldIsExactOnGradedMesh) {
  Box box = gradedBox(1);
  const auto f = [](double x, double y) { return 3.0 - 2.0 * x + 5.0 * y; };
  const auto dx = [](double, double) { return -2.0; };
  const auto dy = [](double, double) { return 5.0; };
  // Differences of values below 8 over distances above 0.02: round-off is 8/0.02 epsilons, twice for both ends.
  const double tolerance = 1000.0 * epsilon;
  EXPECT_LT(gradientError(box, f, dx, dy), tolerance);
  EXPECT_LT(gradientError(box, f, dx, dy, true), tolerance) << "without the boundary's values";
}

// What is known at boundaries may be another each time, and of each component.
TEST(Gradient, HoldsToWhatIsKnownNow) {
  Box box = gradedBox(1);
  const Mesh& m = box.mesh;
  const Gradient gradient(m);
  std::vector<double> values(at(2 * m.cells)), boundary(at(2 * m.boundaryFaces()), 0.7);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<double>(i));
  const std::array all{BoundaryData::Value, BoundaryData::ZeroSlope, BoundaryData::Nothing};
  for (std::size_t turn = 0; turn < 4; ++turn)
    for (const std::size_t each : {1u, 2u}) {
      std::vector<BoundaryData> known;
      for (std::size_t i = 0; i < each * at(m.boundaryFaces()); ++i) known.push_back(all[(i + turn * turn) % 3]);
      std::vector<double> found(at(4 * m.cells)), anew(found.size());
      gradient.compute(values, boundary, 2, found, known);
      for (std::size_t k = 0; k < 2; ++k) {
        const auto component = [&](const auto& of, std::size_t width) {
          auto part = of;
          part.clear();
          for (std::size_t i = 0; i < of.size(); i += width) part.push_back(of[i + k % width]);
          return part;
        };
        std::vector<double> slope(at(2 * m.cells));
        Gradient(m).compute(component(values, 2), component(boundary, 2), 1, slope, component(known, each));
        for (std::size_t c = 0; c < at(m.owned); ++c)
          for (std::size_t i = 0; i < 2; ++i) anew[(2 * c + k) * 2 + i] = slope[2 * c + i];
      }
      EXPECT_EQ(found, anew);
    }
}

TEST(Gradient, ParabolaIsExactOnGradedMesh) {
  Box box = gradedBox(1);
  EXPECT_LT(gradientError(
                box, [](double x, double y) { return x * x - 3.0 * y * y; }, [](double x, double) { return 2.0 * x; },
                [](double, double y) { return -6.0 * y; }),
            1000.0 * epsilon);
}

// Means over the slopes to the neighbours are the products of the gradients where fields are linear; along an axis of
// even cells of width h they exceed them by (h/2)^2 a'' b'', and a rise is limited to what it may be at most.
TEST(Gradient, ProductsOfSlopesSeeWhatGradientsDoNot) {
  Box box = gradedBox(1);
  const Mesh& m = box.mesh;
  std::vector<double> values(at(2 * m.cells)), boundary(at(2 * m.boundaryFaces())), gradient(at(4 * m.cells));
  std::vector<Gradient::Beyond> beyond(at(m.owned));
  const auto fill = [&](const std::function<std::array<double, 2>(const Vector3&)>& f) {
    for (int c = 0; c < m.cells; ++c) std::ranges::copy(f(m.centre[at(c)]), &values[at(2 * c)]);
    for (int b = 0; b < m.boundaryFaces(); ++b)
      std::ranges::copy(f(m.faceCentre[at(m.interiorFaces + b)]), &boundary[at(2 * b)]);
  };
  const std::vector<BoundaryData> known(at(m.boundaryFaces()), BoundaryData::Value);
  const auto compute = [&](double mostRise) {
    Gradient(m).compute(values, boundary, 2, gradient);
    Gradient(m).beyond(values, boundary, gradient, known, mostRise, beyond);
  };
  fill([](const Vector3& x) { return std::array{3.0 - 2.0 * x[0] + 5.0 * x[1], 4.0 + x[0] - 3.0 * x[1]}; });
  compute(100.0);
  for (const Gradient::Beyond& of : beyond) {
    EXPECT_NEAR(of.product, 0.0, 1e-10);
    EXPECT_NEAR(of.square, 0.0, 1e-10);
  }
  // Slopes to both sides by the parabolas: a' -+ a'' times half of the distance.
  fill([](const Vector3& x) { return std::array{x[1] * x[1], 9.0 + x[1] - 2.0 * x[1] * x[1]}; });
  const auto expect = [&](double mostRise) {
    compute(mostRise);
    for (int c = 0; c < m.owned; ++c) {
      double product = 0.0, square = 0.0, weights = 0.0;
      const double y = m.centre[at(c)][1], b = values[at(2 * c + 1)];
      std::vector<double> steps;
      for (int i = m.faceStart[at(c)]; i < m.faceStart[at(c) + 1]; ++i) {
        const int face = m.faceOfCell[at(i)];
        if (std::abs(m.normal[at(face)][1]) > 0.5)
          steps.push_back(m.step[at(face)][1] * (m.low[at(face)] == c ? 1 : -1));
      }
      ASSERT_EQ(steps.size(), 2U);
      for (const double h : steps) {
        const double rise = h * (1.0 - 4.0 * y - 2.0 * h), counted = std::min(rise, mostRise * b) / h;
        product += (2.0 * y + h) * rise / h / std::abs(h);
        square += counted * counted / std::abs(h);
        weights += 1.0 / std::abs(h);
      }
      EXPECT_NEAR(beyond[at(c)].product, product / weights - 2.0 * y * (1.0 - 4.0 * y), 1e-10);
      EXPECT_NEAR(beyond[at(c)].square, square / weights - (1.0 - 4.0 * y) * (1.0 - 4.0 * y), 1e-10);
    }
  };
  expect(100.0);
  expect(0.001);
}

// Fields without a slope at a side have the parabola's slope in the cells there, whatever stands in the boundary's
// values; components may differ in what is known of them.
TEST(Gradient, ParabolaWithoutSlopeAtASideIsExact) {
  Box box = gradedBox(1);
  const Mesh& m = box.mesh;
  std::vector<double> values(at(2 * m.cells)), boundary(at(2 * m.boundaryFaces())), gradient(at(4 * m.cells));
  const auto first = [](double x) { return 2.0 * x * x; };  // no slope at x = 0
  const auto second = [](double x) { return 1.0 + x; };
  for (int c = 0; c < m.cells; ++c) {
    values[at(2 * c)] = first(m.centre[at(c)][0]);
    values[at(2 * c + 1)] = second(m.centre[at(c)][0]);
  }
  std::vector<BoundaryData> known;
  for (int b = 0; b < m.boundaryFaces(); ++b) {
    const auto& x = m.faceCentre[at(m.interiorFaces + b)];
    const bool isLeft = axisOf(m, m.interiorFaces + b) == 0 && x[0] < 0.5;
    known.push_back(isLeft ? BoundaryData::ZeroSlope : BoundaryData::Value);
    known.push_back(BoundaryData::Value);
    boundary[at(2 * b)] = isLeft ? std::numeric_limits<double>::quiet_NaN() : first(x[0]);
    boundary[at(2 * b + 1)] = second(x[0]);
  }
  Gradient(m).compute(values, boundary, 2, gradient, known);
  EXPECT_LT(largest(m, [&](int c) { return gradient[at(4 * c)] - 4.0 * m.centre[at(c)][0]; }), 1000.0 * epsilon);
  EXPECT_LT(largest(m, [&](int c) { return gradient[at(4 * c + 2)] - 1.0; }), 1000.0 * epsilon);
}

TEST(Gradient, SmoothFieldConvergesAtSecondOrder) {
  double error[3];
  for (int i = 0; i < 3; ++i) {
    Box box = gradedBox(1 << i);
    error[i] = gradientError(
        box, [](double x, double y) { return std::sin(3.0 * x) * std::exp(y); },
        [](double x, double y) { return 3.0 * std::cos(3.0 * x) * std::exp(y); },
        [](double x, double y) { return std::sin(3.0 * x) * std::exp(y); });
  }
  // Halving h divides a second-order error by 4, a first-order one by 2; half-way (in the order) lies 2.83.
  EXPECT_GT(error[0] / error[1], 2.83);
  EXPECT_GT(error[1] / error[2], 3.4);
}

// Three places on a line: values behind, at and ahead of the upwind cell.
struct Line {
  double behind, up, down;
  Upwind at;
  [[nodiscard]] double gradient() const {
    return ((up - behind) / at.behind * at.ahead + (down - up) / at.ahead * at.behind) / (at.ahead + at.behind);
  }
  [[nodiscard]] double faceValue() const { return limitedFaceValue(up, down, gradient(), at); }
};

TEST(LimitedFaceValue, LinearDataIsExact) {
  for (const double slope : {-3.0, 0.0, 0.7})
    for (const double toFace : {0.2, 0.5, 0.8})
      for (const double behind : {0.8, 1.0, 2.5})  // a cell reaches to its faces
        EXPECT_NEAR((Line{1.0 - slope * behind, 1.0, 1.0 + slope, {0, 1, 1.0, behind, toFace}}.faceValue()),
                    1.0 + slope * toFace, 8.0 * epsilon);
}

// On smooth data and any grading: of the face's value, and of the slope it comes from, which takes the right weights.
TEST(LimitedFaceValue, IsOfSecondOrderOnGradedData) {
  for (const double ratio : {0.5, 0.8, 1.0, 1.3}) {
    double error[2], slopeError[2];
    for (int i = 0; i < 2; ++i) {
      const double h = 0.02 / (1 << i);
      const Upwind at{0, 1, 0.5 * h * (1.0 + ratio), 0.5 * h * (1.0 + 1.0 / ratio), 0.5 * h};
      const Line line{std::exp(-at.behind), 1.0, std::exp(at.ahead), at};
      error[i] = line.faceValue() - std::exp(at.toFace);
      slopeError[i] = (line.faceValue() - 1.0) / at.toFace - 1.0;
    }
    EXPECT_NEAR(error[0] / error[1], 4.0, 0.2) << ratio;
    EXPECT_NEAR(slopeError[0] / slopeError[1], 4.0, 0.4) << ratio;
  }
}

TEST(LimitedFaceValue, LiesBetweenTheNeighboursForAnyDataAndDistances) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::uniform_real_distribution<double> share(0.02, 0.98), ratio(-3.0, 3.0);
  int sloped = 0;
  for (int i = 0; i < 100000; ++i) {
    const Line line{value(random), value(random), value(random), {0, 1, 1.0, std::exp(ratio(random)), share(random)}};
    const double face = line.faceValue();
    ASSERT_GE(face, std::min(line.up, line.down) - epsilon);
    ASSERT_LE(face, std::max(line.up, line.down) + epsilon);
    // What leaves is no further from the cell's value than what may come in.
    ASSERT_LE(std::abs(face - line.up), std::abs(line.up - line.behind) + 1e-12);
    sloped += face != line.up;
  }
  EXPECT_GT(sloped, 10000);  // it is not the upwind scheme
}

// A pulse carried along a line whose cells grow or shrink: nothing above one or below zero, whatever the grading.
TEST(LimitedFaceValue, KeepsAPulseBoundedOnAnyGrading) {
  for (const double ratio : {0.5, 0.8, 1.25, 2.0}) {
    constexpr int n = 24;
    std::vector<double> width(n), value(n, 0.0);
    for (int i = 0; i < n; ++i) width[at(i)] = std::pow(ratio, ratio > 1.0 ? i - n : i);
    for (int i = 2; i < 9; ++i) value[at(i)] = 1.0;
    const double dt = 0.5 * *std::min_element(width.begin(), width.end());
    const auto distance = [&](int i) { return 0.5 * (width[at(i)] + width[at(i + 1)]); };
    double lowest = 0.0, highest = 1.0;
    for (int step = 0; step < 400; ++step) {
      std::vector<double> flux(n + 1, 0.0);
      flux[n] = value[n - 1];
      for (int i = 1; i + 1 < n; ++i)
        flux[at(i + 1)] = Line{value[at(i - 1)],
                               value[at(i)],
                               value[at(i + 1)],
                               {0, 1, distance(i), distance(i - 1), 0.5 * width[at(i)]}}
                              .faceValue();
      flux[1] = value[0];
      for (int i = 0; i < n; ++i) value[at(i)] += dt / width[at(i)] * (flux[at(i)] - flux[at(i + 1)]);
      for (const double v : value) {
        lowest = std::min(lowest, v);
        highest = std::max(highest, v);
      }
    }
    EXPECT_GT(lowest, -1e-12) << ratio;
    EXPECT_LT(highest, 1.0 + 1e-12) << ratio;
  }
}

TEST(LimitedFaceValue, IsUpwindAtExtrema) {
  const Upwind uniform{0, 1, 1.0, 1.0, 0.5};
  EXPECT_EQ((Line{0.2, 1.0, 0.4, uniform}.faceValue()), 1.0);
  EXPECT_EQ((Line{0.2, -1.0, 0.4, uniform}.faceValue()), -1.0);
  EXPECT_EQ((Line{0.4, 1.0, 1.0, uniform}.faceValue()), 1.0);
}

// Four places on a line: `Line` and the value beyond the one ahead.
struct LongLine {
  Line line;
  double beyond, ahead;  // value, and its distance from the downwind place
  [[nodiscard]] double faceValue() const {
    const double here = (line.down - line.up) / line.at.ahead, next = (beyond - line.down) / ahead;
    const double gradientBeyond = (here * ahead + next * line.at.ahead) / (ahead + line.at.ahead);
    return smoothFaceValue(line.up, line.down, line.gradient(), gradientBeyond, line.at);
  }
};

// The values of `f` on cells of which each is `ratio` times as wide as the one before; the upwind cell is about x.
template <class F>
LongLine sampled(const F& f, double x, double width, double ratio) {
  const double behind = 0.5 * width * (1.0 + 1.0 / ratio), ahead = 0.5 * width * (1.0 + ratio);
  return {{f(x - behind), f(x), f(x + ahead), {0, 1, ahead, behind, 0.5 * width}},
          f(x + ahead * (1.0 + ratio)),
          ahead * ratio};
}

// Parabolas are followed along their own slope wherever their crest is, which the bounded limiter cuts.
TEST(SmoothFaceValue, FollowsAParabolaAcrossItsCrest) {
  for (const double ratio : {0.8, 1.0, 1.3})
    for (double x = -2.0; x < 2.0; x += 0.23) {
      const LongLine line = sampled([](double place) { return 3.0 - place * place; }, x, 1.0, ratio);
      EXPECT_NEAR(line.faceValue(), 3.0 - x * x - 2.0 * x * 0.5, 1e-13) << ratio << ' ' << x;
    }
}

// Of the second order where the bounded one has lost it: half a cell from a crest.
TEST(SmoothFaceValue, IsOfSecondOrderAtACrest) {
  for (const double ratio : {0.8, 1.0, 1.25}) {
    double slopeError[2], bounded[2];
    for (int i = 0; i < 2; ++i) {
      const double h = 0.02 / (1 << i);
      const LongLine line =
          sampled([](double x) { return std::cos(x) + 0.1 * std::sin(3.0 * x); }, 0.3 + 0.1 * h, h, ratio);
      const double slope = -std::sin(0.3 + 0.1 * h) + 0.3 * std::cos(3.0 * (0.3 + 0.1 * h));
      slopeError[i] = (line.faceValue() - line.line.up) / line.line.at.toFace - slope;
      const LongLine crest = sampled([](double x) { return std::cos(x + x * x); }, 0.1 * h, h, ratio);
      const double at = 0.1 * h, there = -std::sin(at + at * at) * (1.0 + 2.0 * at);
      bounded[i] = (crest.line.faceValue() - crest.line.up) / crest.line.at.toFace - there;
      const double found = (crest.faceValue() - crest.line.up) / crest.line.at.toFace - there;
      EXPECT_LT(std::abs(found), 10.0 * h * h) << ratio;
    }
    EXPECT_NEAR(slopeError[0] / slopeError[1], 4.0, 0.4) << ratio;
    EXPECT_NEAR(bounded[0] / bounded[1], 2.0, 0.4) << ratio;
  }
}

// Beside a jump, and where the curvature turns round, the bounded value is taken.
TEST(SmoothFaceValue, IsBoundedAtJumps) {
  const Upwind uniform{0, 1, 1.0, 1.0, 0.5};
  EXPECT_EQ((LongLine{{0.0, 0.0, 1.0, uniform}, 1.0, 1.0}.faceValue()), 0.0);
  EXPECT_EQ((LongLine{{0.0, 1.0, 1.0, uniform}, 1.0, 1.0}.faceValue()), 1.0);
  EXPECT_EQ((LongLine{{0.0, 1.0, 0.0, uniform}, 1.0, 1.0}.faceValue()), 1.0);  // zigzag
  const LongLine turning{{0.0, 1.0, 3.0, uniform}, 4.0, 1.0};
  EXPECT_EQ(turning.faceValue(), turning.line.faceValue());
}

// Where the next cell has less curvature, only a quarter more than that is believed.
TEST(SmoothFaceValue, BelievesTheSmallerCurvature) {
  const Upwind uniform{0, 1, 1.0, 1.0, 0.5};
  // Slopes -3, 1, 2 in turn: curvatures 4 and 1, an own slope of -1 and a bounded one of none.
  EXPECT_NEAR((LongLine{{3.0, 0.0, 1.0, uniform}, 3.0, 1.0}.faceValue()), -0.5 * 1.25 * 0.25, 1e-15);
  // Slopes -1, 1, 5: the upwind cell's curvature is the smaller.
  EXPECT_NEAR((LongLine{{1.0, 0.0, 1.0, uniform}, 6.0, 1.0}.faceValue()), 0.0, 1e-15);
  EXPECT_NEAR((LongLine{{2.0, 0.0, 1.0, uniform}, 6.0, 1.0}.faceValue()), -0.25, 1e-15);
}

TEST(SmoothFaceValue, IsTheSameUpsideDown) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> value(-1.0, 1.0), share(0.02, 0.98), distance(0.3, 3.0);
  int smooth = 0;
  for (int i = 0; i < 10000; ++i) {
    const LongLine line{{value(random), value(random), value(random), {0, 1, 1.0, distance(random), share(random)}},
                        value(random),
                        distance(random)};
    LongLine turned = line;
    for (double* v : {&turned.line.behind, &turned.line.up, &turned.line.down, &turned.beyond}) *v = 2.0 - *v;
    EXPECT_NEAR(turned.faceValue(), 2.0 - line.faceValue(), 1e-12);
    smooth += line.faceValue() != line.line.faceValue();
  }
  EXPECT_GT(smooth, 2000);
}

}  // namespace
}  // namespace lampblack::test
