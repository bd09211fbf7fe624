// Physical constants (SI; exact since the 2019 revision of the SI, BIPM 2019) and the reference pressure of NASA data.
#pragma once

namespace lampblack::constants {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double avogadro = 6.02214076e23;               // 1/mol
inline constexpr double boltzmann = 1.380649e-23;               // J/K
inline constexpr double gasConstant = avogadro * boltzmann;     // J/mol/K, 8.31446261815324
inline constexpr double oneAtmosphere = 101325.0;               // Pa, standard state of NASA-7 data
inline constexpr double stefanBoltzmann = 5.670374419e-8;       // W/m2/K4 (2 pi^5 k^4/(15 h^3 c^2))
inline constexpr double standardGravity = 9.80665;              // m/s2 (CGPM 1901)
inline constexpr double vacuumPermittivity = 8.8541878128e-12;  // F/m (CODATA 2018)
inline constexpr double debye = 3.33564095198e-30;              // C m
inline constexpr double thermochemicalCalorie = 4.184;          // J

}  // namespace lampblack::constants
