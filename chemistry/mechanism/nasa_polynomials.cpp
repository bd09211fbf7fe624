#include "chemistry/mechanism/nasa_polynomials.hpp"

namespace lampblack::chemistry {

double cpOverR(const std::array<double, 7>& a, double T) {
  return a[0] + T * (a[1] + T * (a[2] + T * (a[3] + T * a[4])));
}

double enthalpyOverRT(const std::array<double, 7>& a, double T) {
  return a[0] + T * (a[1] / 2 + T * (a[2] / 3 + T * (a[3] / 4 + T * a[4] / 5))) + a[5] / T;
}

double entropyOverR(const std::array<double, 7>& a, double T, double lnT) {
  return a[0] * lnT + T * (a[1] + T * (a[2] / 2 + T * (a[3] / 3 + T * a[4] / 4))) + a[6];
}

double cpOverR(const std::array<double, 9>& a, double T) {
  return (a[0] / T + a[1]) / T + a[2] + T * (a[3] + T * (a[4] + T * (a[5] + T * a[6])));
}

double enthalpyOverRT(const std::array<double, 9>& a, double T, double lnT) {
  return (-a[0] / T + a[1] * lnT + a[7]) / T + a[2] + T * (a[3] / 2 + T * (a[4] / 3 + T * (a[5] / 4 + T * a[6] / 5)));
}

double entropyOverR(const std::array<double, 9>& a, double T, double lnT) {
  return (-a[0] / (2 * T) - a[1]) / T + a[2] * lnT + T * (a[3] + T * (a[4] / 2 + T * (a[5] / 3 + T * a[6] / 4))) + a[8];
}

}  // namespace lampblack::chemistry
