#!/usr/bin/env python3
"""Steady states of flames from their decks alone, with all defaults of `time: {mode: steady}`: nobody has tuned them. Twenty are
made up; the others are burners of the literature, on coarse meshes.

Usage: untuned_flames.py PROGRAM FOLDER [--seconds N] [NAME...]

Writes the decks into the folder, runs those that are named (all without names), each for N seconds at most, and prints a row of
docs/verification.md each: what came of it, steps in time, iterations, largest residual, processor seconds of both, peak in K.
"""

import argparse
import json
import pathlib
import re
import subprocess

MECHANISMS = pathlib.Path(__file__).resolve().parents[2] / "cases/mechanisms"
M = {"H2": "hydrogen_h2o2_10", "H2 San Diego": "hydrogen_sandiego_9", "CH4": "methane_drm19_21", "C2H4": "ethylene_bisetti2012_47",
     "C3H8": "methane_gri30_53"}
AIR = "O2: 0.21, N2: 0.79"

def axisymmetric_burner(name, mechanism, pressure, gravity, r, z, solids, fuel, walls, air_from, ua, air, top, ring, width, more=""):
    """Fuel from a tube in a coflow of air, lit by a hot ring: `ring` is its place (r, z) in mm, `width` its width; `fuel` what the
    inlet of fuel has, `walls` the boundaries beside the inlets."""
    return name, f"""problem: flow
mechanism: {MECHANISMS}/{M[mechanism]}.yaml
pressure: {pressure}
{'gravity: {z: -9.81 m/s^2}' if gravity else ''}
mesh:
  geometry: axisymmetric
  r: [{r}]
  z: [{z}]
{solids}boundaries:
  fuel: {{type: inlet, side: z-min, {fuel}}}
  air: {{type: inlet, side: z-min, from: {air_from} mm, velocity: {ua} m/s, temperature: 298 K, composition: "{air}"}}
{walls}  axis: {{type: symmetry, side: r-min}}
  shroud: {{type: wall, side: r-max, slip: true}}
  top: {{type: outlet, side: z-max, temperature: 298 K, composition: "{top}"}}
initial:
  layer: none
  composition: "{top}"
  temperature: 298 K
  formula: {{temperature: "298 + 1700*exp(-((r-{ring[0] / 1000})^2 + (z-{ring[1] / 1000})^2)/{width / 1000}^2)"}}
{more}time: {{mode: steady}}
"""


def coflow(name, fuel, mix=None, p=1, uf=0.06, ua=0.12, rf=5, tube=False, gravity=True):
    """Plug flows; the tube may reach into the mesh."""
    mix = mix or f"{fuel}: 1"
    rim = 0.6 if tube else 0
    r = ", ".join([f"{{to: {rf} mm, cells: 10}}"] + ([f"{{to: {rf + rim} mm, cells: 2}}"] if tube else []) +
                  [f"{{to: {2 * rf} mm, cells: 7, ratio: 2}}", f"{{to: {3 * rf} mm, cells: 4, ratio: 2}}"])
    z0 = 3 if tube else 0
    z = ", ".join(([f"{{to: {z0} mm, cells: 4}}"] if tube else []) +
                  [f"{{to: {z0 + 4 * rf} mm, cells: 24}}", f"{{to: {z0 + 9 * rf} mm, cells: 14, ratio: 2}}"])
    solids = f"  solids: {{tube: {{r: [{rf} mm, {rf + rim} mm], z: [0 mm, {z0} mm]}}}}\n" if tube else ""
    walls = "  tube: {type: wall, solid: tube, temperature: 400 K}\n" if tube else ""
    stream = f'to: {rf} mm, velocity: {uf} m/s, temperature: 298 K, composition: "{mix}"'
    return axisymmetric_burner(name, fuel, f"{p} bar", gravity, r, z, solids, stream, walls, rf + rim, ua, AIR, AIR,
                               (rf + rim / 2, z0 + 0.6 * rf), 0.6 * rf)


def burner(name, fuel, mix, tube, wall, uf, ua, r, z, radiation=True, gravity=True, air=AIR):
    """A tube of an inner radius and a wall (mm) whose flow is fully developed; r and z: the mesh."""
    stream = f'to: {tube} mm, temperature: 298 K, composition: "{mix}", formula: {{velocity: "2*{uf}*(1 - (r/{tube / 1000})^2)"}}'
    rim = f"  rim: {{type: wall, side: z-min, from: {tube} mm, to: {tube + wall} mm, temperature: 298 K}}\n"
    return axisymmetric_burner(name, fuel, "1 atm", gravity, r, z, "", stream, rim, tube + wall, ua, air, AIR,
                               (tube + wall / 2, tube / 2), tube / 2, "radiation: {model: optically_thin}\n" if radiation else "")


def counterflow(name, fuel, mix=None, p=1, u=0.3, gap=10, air=AIR):
    mix = mix or f"{fuel}: 1"
    return name, f"""problem: flow
mechanism: {MECHANISMS}/{M[fuel]}.yaml
pressure: {p} bar
mesh:
  geometry: axisymmetric
  r: [{{to: 8 mm, cells: 10}}, {{to: 12 mm, cells: 5}}]
  z: [{{to: {gap} mm, cells: 50}}]
boundaries:
  fuel: {{type: inlet, side: z-min, to: 8 mm, velocity: {u} m/s, temperature: 298 K, composition: "{mix}"}}
  air: {{type: inlet, side: z-max, to: 8 mm, velocity: {u} m/s, temperature: 298 K, composition: "{air}"}}
  fuel_flange: {{type: wall, side: z-min, from: 8 mm}}
  air_flange: {{type: wall, side: z-max, from: 8 mm}}
  axis: {{type: symmetry, side: r-min}}
  outflow: {{type: outlet, side: r-max, temperature: 298 K, composition: "N2: 1"}}
initial: {{low: fuel, high: air, position: {gap / 2} mm, width: {gap / 4} mm}}
time: {{mode: steady}}
"""

def premixed(name, fuel, mix, p=1, u=0.4, T=298):
    return name, f"""problem: flow
mechanism: {MECHANISMS}/{M[fuel]}.yaml
pressure: {p} bar
mesh:
  geometry: axisymmetric
  r: [{{to: 8 mm, cells: 8}}, {{to: 12 mm, cells: 4}}]
  z: [{{to: 8 mm, cells: 64}}]
boundaries:
  fresh: {{type: inlet, side: z-min, to: 8 mm, velocity: {u} m/s, temperature: {T} K, composition: "{mix}"}}
  rim: {{type: wall, side: z-min, from: 8 mm}}
  plate: {{type: wall, side: z-max, temperature: 600 K}}
  axis: {{type: symmetry, side: r-min}}
  outflow: {{type: outlet, side: r-max, temperature: 298 K, composition: "N2: 1"}}
initial: {{layer: none, composition: "N2: 1", temperature: 1900 K}}
time: {{mode: steady}}
"""


YALE = (2, 0.38, 0.35, 0.35, "{to: 2 mm, cells: 5}, {to: 2.38 mm, cells: 1}, {to: 6 mm, cells: 8}, {to: 37 mm, cells: 10, ratio: 12}",
        "{to: 10 mm, cells: 16}, {to: 60 mm, cells: 26, ratio: 4}, {to: 120 mm, cells: 8, ratio: 2}")
TORO = ("{to: 4.5 mm, cells: 9}, {to: 5.5 mm, cells: 2}, {to: 12 mm, cells: 10}, {to: 47.5 mm, cells: 10, ratio: 12}",
        "{to: 10 mm, cells: 16}, {to: 60 mm, cells: 30, ratio: 4}, {to: 120 mm, cells: 8, ratio: 2}")

FLAMES = dict([
    coflow("01_coflow_methane", "CH4"),
    coflow("02_coflow_methane_tube", "CH4", tube=True),
    coflow("03_coflow_methane_fast_air", "CH4", ua=0.4),
    coflow("04_coflow_methane_half_bar", "CH4", p=0.5),
    coflow("05_coflow_methane_3_bar", "CH4", p=3, uf=0.03, ua=0.06),
    coflow("06_coflow_methane_no_gravity", "CH4", uf=0.2, ua=0.2, gravity=False),
    coflow("07_coflow_methane_partially_premixed", "CH4", mix="CH4: 0.4, O2: 0.126, N2: 0.474", uf=0.1),
    coflow("08_coflow_ethylene", "C2H4", uf=0.04, ua=0.1),
    coflow("09_coflow_hydrogen", "H2", mix="H2: 0.5, N2: 0.5", uf=0.3, ua=0.3),
    coflow("10_coflow_hydrogen_tube", "H2", mix="H2: 0.5, N2: 0.5", uf=0.3, ua=0.3, tube=True),
    coflow("11_coflow_hydrogen_10_bar", "H2", mix="H2: 0.3, N2: 0.7", uf=0.1, ua=0.1, p=10, rf=2),
    counterflow("12_counterflow_hydrogen", "H2", mix="H2: 0.5, N2: 0.5"),
    counterflow("13_counterflow_hydrogen_strained", "H2", mix="H2: 0.5, N2: 0.5", u=2),
    counterflow("14_counterflow_hydrogen_5_bar", "H2", mix="H2: 0.5, N2: 0.5", p=5),
    counterflow("15_counterflow_methane", "CH4"),
    counterflow("16_counterflow_methane_strained", "CH4", u=0.8),
    counterflow("17_counterflow_ethylene", "C2H4", u=0.2),
    premixed("18_plate_methane", "CH4", "CH4: 0.095, O2: 0.19, N2: 0.715", u=0.5),
    premixed("19_plate_hydrogen", "H2", "H2: 0.25, O2: 0.157, N2: 0.593", u=1.5),
    premixed("20_plate_methane_2_bar", "CH4", "CH4: 0.085, O2: 0.192, N2: 0.723", u=0.4, p=2),
    # Walsh, Long, Tanoff, Smooke (1998); the same without gravity. Ethylene: Smooke, Long, Connelly, Colket, Hall (2005).
    burner("21_yale_methane", "CH4", "CH4: 0.65, N2: 0.35", *YALE),
    burner("22_yale_methane_no_gravity", "CH4", "CH4: 0.65, N2: 0.35", *YALE, gravity=False),
    burner("23_yale_ethylene_32", "C2H4", "C2H4: 0.32, N2: 0.68", *YALE),
    burner("24_yale_ethylene_80", "C2H4", "C2H4: 0.8, N2: 0.2", *YALE),
    # Toro, Mokhov, Levinsky, Smooke (2005).
    burner("25_toro_hydrogen_18", "H2 San Diego", "H2: 0.5, N2: 0.5", 4.5, 1, 0.18, 0.18, *TORO, radiation=False),
    burner("26_toro_hydrogen_50", "H2 San Diego", "H2: 0.5, N2: 0.5", 4.5, 1, 0.5, 0.5, *TORO, radiation=False),
    # McEnally and Pfefferle (1999), their flame without air in the fuel.
    burner("27_mcenally_methane", "CH4", "CH4: 1", 5.55, 0.8, 0.0568, 0.1049,
           "{to: 5.55 mm, cells: 10}, {to: 6.35 mm, cells: 1}, {to: 13 mm, cells: 10}, {to: 47.6 mm, cells: 10, ratio: 12}",
           "{to: 12 mm, cells: 16}, {to: 90 mm, cells: 30, ratio: 4}, {to: 150 mm, cells: 8, ratio: 2}"),
    # Snelling, Thomson, Smallwood, Guelder, Weckman, Fraser (2002).
    burner("28_guelder_ethylene", "C2H4", "C2H4: 1", 5.45, 0.95, 0.03465, 0.74,
           "{to: 5.45 mm, cells: 8}, {to: 6.4 mm, cells: 1}, {to: 13 mm, cells: 10}, {to: 45 mm, cells: 8, ratio: 12}",
           "{to: 12 mm, cells: 16}, {to: 80 mm, cells: 28, ratio: 4}, {to: 120 mm, cells: 6, ratio: 2}"),
    burner("29_inverse_methane", "CH4", AIR, 5, 0.5, 0.1, 0.1,
           "{to: 5 mm, cells: 9}, {to: 5.5 mm, cells: 1}, {to: 10 mm, cells: 8}, {to: 20 mm, cells: 6, ratio: 3}",
           "{to: 12 mm, cells: 18}, {to: 60 mm, cells: 24, ratio: 4}", radiation=False, air="CH4: 0.5, N2: 0.5"),
    # GRI-Mech 3.0 knows how propane comes apart, but was made for methane.
    coflow("30_coflow_propane", "C3H8", uf=0.03, ua=0.1),
    counterflow("31_counterflow_propane", "C3H8", u=0.2),
])


def row(folder: pathlib.Path, name: str, code: int) -> str:
    """What came of a run, from its record."""
    record = json.loads((folder / name / "run.json").read_text(encoding="utf-8"))
    if code != 0:
        return f"| {name} | {'stopped by the limit' if code < 0 else f'exit {code}'} | {record['message'][:200]} |"
    results = record["results"]
    search = results["search"]
    how = "at once" if search["returns_to_steps"] == 0 else f"after going back {search['returns_to_steps']} times"
    if search["found_early"]:
        how = "early"
    if search["times_lit"] > 0:
        how += ", lit"
    peak = re.search(r"peak temperature (\S+) K", (folder / f"{name}.log").read_text(encoding="utf-8")).group(1)
    return (f"| {name} | {how} | {search['steps_in_time']} | {search['iterations']} | {search['last_residual']:.1e} | "
            f"{search['processor_time_of_steps_s']:.1f} + {search['processor_time_of_iterations_s']:.1f} | {peak} |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=300)
    parser.add_argument("names", nargs="*", choices=[[], *FLAMES])
    options = parser.parse_intermixed_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    for name, deck in FLAMES.items():
        (options.folder / f"{name}.yaml").write_text(deck, encoding="utf-8")
    for name in options.names or FLAMES:
        command = [options.program, "run", options.folder / f"{name}.yaml", "--out", options.folder / name, "--force"]
        with open(options.folder / f"{name}.log", "w", encoding="utf-8") as log, \
                subprocess.Popen(command, stdout=log, stderr=log) as run:
            try:
                code = run.wait(options.seconds)
            except subprocess.TimeoutExpired:
                run.terminate()
                run.wait()
                code = -1
        print(row(options.folder, name, code), flush=True)


if __name__ == "__main__":
    main()
