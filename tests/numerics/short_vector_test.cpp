#include "numerics/short_vector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace lampblack::numerics::sundials;

// Every operation against SUNDIALS' own vector, also with the result stored in an argument.
class ShortVector : public ::testing::TestWithParam<std::size_t> {
 protected:
  ShortVector() {
    const auto n = static_cast<sunindextype>(GetParam());
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.5, 2);
    for (auto& pair : vectors_) {
      Vector first = makeShortVector(GetParam(), context_.get());
      pair[0].reset(N_VClone(first.get()));
      pair[1].reset(N_VNew_Serial(n, context_.get()));
      for (std::size_t i = 0; i < GetParam(); ++i)
        data(pair[0])[i] = data(pair[1])[i] = uniform(random) * (random() % 2 == 0 ? -1 : 1);
    }
  }
  static double* data(const Vector& v) { return N_VGetArrayPointer(v.get()); }

  template <class Operation>
  void compare(const char* name, Operation&& operation) {
    for (int which : {0, 1}) operation(vectors_[0][which].get(), vectors_[1][which].get(), vectors_[2][which].get());
    for (const auto& pair : vectors_)
      for (std::size_t i = 0; i < GetParam(); ++i)
        EXPECT_NEAR(data(pair[0])[i], data(pair[1])[i], 4e-16 * (1 + 8 * std::abs(data(pair[1])[i]))) << name;
  }

  Context context_ = makeContext();
  Vector vectors_[3][2];
};

TEST_P(ShortVector, DoesWhatTheSerialVectorDoes) {
  compare("linear sum", [](N_Vector x, N_Vector y, N_Vector z) { N_VLinearSum(0.3, x, -1.7, y, z); });
  compare("linear sum in place", [](N_Vector x, N_Vector y, N_Vector) { N_VLinearSum(1.0, x, 0.5, y, x); });
  compare("product", [](N_Vector x, N_Vector y, N_Vector z) { N_VProd(x, y, z); });
  compare("quotient", [](N_Vector x, N_Vector y, N_Vector z) { N_VDiv(x, y, z); });
  compare("scale in place", [](N_Vector x, N_Vector, N_Vector) { N_VScale(1.1, x, x); });
  compare("magnitude", [](N_Vector x, N_Vector, N_Vector z) { N_VAbs(x, z); });
  compare("inverse", [](N_Vector x, N_Vector, N_Vector z) { N_VInv(x, z); });
  compare("add constant", [](N_Vector x, N_Vector, N_Vector z) { N_VAddConst(x, -0.2, z); });
  compare("sums of many", [](N_Vector x, N_Vector y, N_Vector z) {
    double factors[] = {0.5, -2.0};
    N_Vector from[] = {y, z};
    N_VScaleAddMulti(2, factors, x, from, from);
  });
  compare("linear combination", [](N_Vector x, N_Vector y, N_Vector z) {
    double factors[] = {0.5, -2.0, 0.7};
    N_Vector from[] = {z, x, y};
    N_VLinearCombination(3, factors, from, z);
    N_VLinearCombination(1, factors, from, y);
  });
  compare("scales of many", [](N_Vector x, N_Vector y, N_Vector z) {
    double factors[] = {0.5, -2.0};
    N_Vector from[] = {x, y}, to[] = {x, z};
    N_VScaleVectorArray(2, factors, from, to);
  });
  const auto x = [&](int which) { return vectors_[0][which].get(); };
  const auto y = [&](int which) { return vectors_[1][which].get(); };
  EXPECT_NEAR(N_VWrmsNorm(x(0), y(0)), N_VWrmsNorm(x(1), y(1)), 1e-14 * N_VWrmsNorm(x(1), y(1)));
  EXPECT_EQ(N_VMin(x(0)), N_VMin(x(1)));
  compare("constant", [](N_Vector a, N_Vector, N_Vector) { N_VConst(7.0, a); });
}

INSTANTIATE_TEST_SUITE_P(Lengths, ShortVector, ::testing::Values(1, 2, 7, 8, 9, 16, 54, 203));

}  // namespace
