#include "chemistry/mechanism/elements.hpp"

#include <array>
#include <cctype>
#include <utility>

namespace lampblack {

namespace {

// g/mol. D is deuterium as mechanisms name it.
constexpr std::array<std::pair<std::string_view, double>, 47> kWeights{{
    {"H", 1.008},        {"D", 2.0141017781}, {"He", 4.002602},     {"Li", 6.94},       {"Be", 9.0121831},
    {"B", 10.81},        {"C", 12.011},       {"N", 14.007},        {"O", 15.999},      {"F", 18.998403162},
    {"Ne", 20.1797},     {"Na", 22.98976928}, {"Mg", 24.305},       {"Al", 26.9815384}, {"Si", 28.085},
    {"P", 30.973761998}, {"S", 32.06},        {"Cl", 35.45},        {"Ar", 39.95},      {"K", 39.0983},
    {"Ca", 40.078},      {"Sc", 44.955907},   {"Ti", 47.867},       {"V", 50.9415},     {"Cr", 51.9961},
    {"Mn", 54.938043},   {"Fe", 55.845},      {"Co", 58.933194},    {"Ni", 58.6934},    {"Cu", 63.546},
    {"Zn", 65.38},       {"Ga", 69.723},      {"Ge", 72.630},       {"Se", 78.971},     {"Br", 79.904},
    {"Kr", 83.798},      {"Zr", 91.224},      {"Mo", 95.95},        {"Ag", 107.8682},   {"Sn", 118.710},
    {"I", 126.90447},    {"Xe", 131.293},     {"Cs", 132.90545196}, {"W", 183.84},      {"Pt", 195.084},
    {"Au", 196.966570},  {"Pb", 207.2},
}};

bool sameName(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::toupper(static_cast<unsigned char>(a[i])) != std::toupper(static_cast<unsigned char>(b[i]))) return false;
  return true;
}

}  // namespace

std::optional<double> standardAtomicWeight(std::string_view element) {
  for (const auto& [name, weight] : kWeights)
    if (sameName(name, element)) return weight * 1e-3;
  return std::nullopt;
}

}  // namespace lampblack
