// The adiabatic flame temperature of methane and air, by the chemistry of Lampblack in a program of one's own.
#include <cstdio>
#include <exception>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/equilibrium.hpp"
#include "chemistry/thermo/thermo.hpp"

int main(int argc, char** argv) try {
  using namespace lampblack::chemistry;
  if (argc != 2) return std::fprintf(stderr, "usage: flame_temperature MECHANISM.yaml\n"), 2;
  const Mechanism mechanism = Mechanism::fromFile(argv[1]);
  const Thermo thermo(mechanism);

  std::vector<double> X(mechanism.numSpecies(), 0.0), Y(X.size());
  X[mechanism.speciesIndex("CH4")] = 1.0;
  X[mechanism.speciesIndex("O2")] = 2.0;
  X[mechanism.speciesIndex("N2")] = 7.52;
  thermo.moleToMass(X, Y);

  const double T = 300.0, p = 101325.0;  // K, Pa
  Equilibrium equilibrium(mechanism);
  const double burnt = equilibrium.atEnthalpyAndPressure(thermo.enthalpyMass(T, Y), p, Y);
  std::printf("%.6f K, mass fraction of CO %.6e\n", burnt, Y[mechanism.speciesIndex("CO")]);
  return 0;
} catch (const std::exception& error) {  // lampblack::InputError and others say what is wrong
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
