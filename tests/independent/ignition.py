#!/usr/bin/env python3
"""Ignition in a given volume, by scipy alone: what cases/reactor/rapid_compression, shock_tube_dpdt and ignition_heptane compute.

Reads the mechanism's data and the table of volumes; rates, thermodynamics and the equations of the reactor are written here.
Delays are those of the largest dp/dt and dT/dt, counted from the smallest volume (a table) or from the start.

Usage: ignition.py rapid_compression | shock_tube [PERCENT_PER_MS] | heptane KELVIN BAR
"""
import re
import sys
from pathlib import Path

import numpy as np
import yaml
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline, CubicSpline

CASES = Path(__file__).resolve().parents[2] / "cases"
R, CALORIE, ATMOSPHERE = 8.31446261815324, 4.184, 101325.0
WEIGHTS = {"H": 1.008, "C": 12.011, "O": 15.999, "N": 14.007, "Ar": 39.95}


class Gas:
    def __init__(self, file):
        data = yaml.safe_load(file.read_text())
        self.names = data["phases"][0]["species"]
        species = {one["name"]: one for one in data["species"]}
        self.W = np.array([sum(WEIGHTS[e] * n for e, n in species[s]["composition"].items()) for s in self.names]) * 1e-3
        self.middle = np.array([species[s]["thermo"]["temperature-ranges"][1] for s in self.names])
        self.nasa = np.array([species[s]["thermo"]["data"] for s in self.names])
        self.read(data["reactions"])

    def read(self, reactions):
        """Each side as up to three species by number, the number behind the last standing for none."""
        none, count = len(self.names), len(reactions)
        self.sides = np.full((2, count, 3), none)
        self.bodies, self.high, self.low = np.zeros((count, none)), np.zeros((count, 3)), np.zeros((count, 3))
        self.troe = np.tile([0.0, 1.0, 1.0, 0.0], (count, 1))
        self.is_reversible, self.has_body, self.is_falloff, self.has_troe = (np.zeros(count, bool) for _ in range(4))
        for r, one in enumerate(reactions):
            left, right = one["equation"].replace("(+M)", "").split("=>")
            self.is_reversible[r] = left.endswith("<")
            for side, text in enumerate((left.rstrip("<"), right)):
                found = []
                for term in text.split(" + "):
                    number, name = re.fullmatch(r"\s*(?:(\d+) )?([\w()-]+)\s*", term).groups()
                    found += [self.names.index(name)] * int(number or 1) if name != "M" else []
                self.sides[side, r, :len(found)] = found
            constant = lambda key: [one[key]["A"], one[key]["b"], one[key]["Ea"] * CALORIE / R]
            self.is_falloff[r] = one.get("type") == "falloff"
            self.has_body[r] = one.get("type") in ("three-body", "falloff")
            self.bodies[r] = [one.get("efficiencies", {}).get(s, 1.0) for s in self.names]
            self.high[r] = constant("high-P-rate-constant" if self.is_falloff[r] else "rate-constant")
            self.low[r] = constant("low-P-rate-constant") if self.is_falloff[r] else [1.0, 0.0, 0.0]
            if troe := one.get("Troe"):
                self.has_troe[r] = True
                self.troe[r] = [troe["A"], troe["T3"], troe["T1"], troe["T2"]]
        self.net = np.zeros((count, none + 1))
        for side, sign in ((0, -1), (1, 1)):
            np.add.at(self.net, (np.arange(count)[:, None], self.sides[side]), sign)
        self.net = self.net[:, :none]

    def thermo(self, T):
        a = np.where((T < self.middle)[:, None], self.nasa[:, 0], self.nasa[:, 1])
        cp = a[:, :5] @ T ** np.arange(5)
        h = a[:, :5] @ (T ** np.arange(5) / np.arange(1, 6)) + a[:, 5] / T
        s = a[:, 0] * np.log(T) + a[:, 1:5] @ (T ** np.arange(1, 5) / np.arange(1, 5)) + a[:, 6]
        return cp, h, s  # over R, RT, R

    def rates(self, T, c):
        """mol/cm3/s of concentrations in mol/cm3"""
        _, h, s = self.thermo(T)
        standard = ATMOSPHERE / (R * T) * 1e-6
        constant = lambda k: k[:, 0] * T ** k[:, 1] * np.exp(-k[:, 2] / T)
        third = np.where(self.has_body, self.bodies @ c, 1.0)
        high = constant(self.high)
        reduced = np.maximum(constant(self.low) * third / high, 1e-300)
        A, T3, T1, T2 = self.troe.T
        with np.errstate(divide="ignore"):
            log = np.log10(np.where(self.has_troe, (1 - A) * np.exp(-T / T3) + A * np.exp(-T / T1) + np.exp(-T2 / T), 1.0))
        x = np.log10(reduced) - 0.4 - 0.67 * log
        falling = high * reduced / (1 + reduced) * 10 ** (log / (1 + (x / (0.75 - 1.27 * log - 0.14 * x)) ** 2))
        k = np.where(self.is_falloff, falling, high * third)
        ahead, back = (np.append(c, 1.0)[side].prod(1) for side in self.sides)
        equilibrium = np.exp(np.minimum(self.net @ (s - h), 600.0)) * standard ** self.net.sum(1)
        return (k * (ahead - np.where(self.is_reversible, back / equilibrium, 0.0))) @ self.net


def table(file):
    """ln of the volume is not interpolated: the cubic of Fritsch and Carlson through the volumes over the first."""
    data = np.loadtxt(file, delimiter=",", skiprows=2)
    x, v = data[:, 0] * 1e-3, data[:, 1] / data[0, 1]
    h = np.diff(x)
    secant = np.diff(v) / h
    slope = np.empty_like(x)
    slope[1:-1] = (h[1:] * secant[:-1] + h[:-1] * secant[1:]) / (h[1:] + h[:-1])
    slope[0] = ((2 * h[0] + h[1]) * secant[0] - h[0] * secant[1]) / (h[0] + h[1])
    slope[-1] = ((2 * h[-1] + h[-2]) * secant[-1] - h[-1] * secant[-2]) / (h[-1] + h[-2])
    for i, s in enumerate(secant):
        slope[i:i + 2][slope[i:i + 2] * s <= 0] = 0
        if s != 0 and (length := np.hypot(*slope[i:i + 2]) / abs(s)) > 3:
            slope[i:i + 2] *= 3 / length
    return CubicHermiteSpline(x, v, slope), x[np.argmin(v)]


def rising(gas, T, X, rate, end):
    """Volume of the gas as it is when its pressure is 1 + rate t times the first."""
    times = np.linspace(0, end, 2001)
    slope = lambda logp, logT: 1 / (X @ gas.thermo(np.exp(logT[0]))[0])
    logp = np.log1p(rate * times)
    logT = solve_ivp(slope, (0, logp[-1]), [np.log(T)], t_eval=logp, rtol=1e-12, atol=1e-14).y[0] if rate else np.log(T) + 0 * times
    return CubicSpline(times, np.exp(logT - logp) / T)


def ignite(gas, T, p, moles, volume, end, origin):
    X = np.array([moles.get(s, 0.0) for s in gas.names])
    X /= X.sum()
    Y = X * gas.W / (X @ gas.W)
    density = p / (R * T) * (X @ gas.W)
    slope = volume.derivative()

    def system(t, y):
        ratio = float(volume(t))
        rho, T = density / ratio, y[-1]
        cp, h, _ = gas.thermo(T)
        dY = gas.rates(T, rho * y[:-1] / gas.W * 1e-6) * 1e6 * gas.W / rho
        moles = y[:-1] / gas.W
        dT = (-(R * T * (h - 1)) @ (dY / gas.W) - float(slope(t)) / ratio * R * T * moles.sum()) / (R * ((cp - 1) @ moles))
        return np.append(dY, dT)

    y = np.append(Y, T)
    pressure = lambda t, y: density / volume(t) * R * y[-1] * (y[:-1] / gas.W[:, None]).sum(0)
    start = 0.0
    for stop in [origin, end] if origin else [end]:
        run = solve_ivp(system, (start, stop), y, method="BDF", rtol=1e-8, atol=1e-14, dense_output=True, max_step=(end - origin) / 200)
        y, start = run.y[:, -1], stop
        if stop == origin:
            print(f"compressed to {y[-1]:.2f} K and {float(pressure(stop, run.y)[-1]):.6g} Pa at {stop:.6g} s")
    # The spline's maximum between fine points.
    middle = run.t[np.argmax(np.gradient(run.y[-1], run.t))]
    times = np.clip(np.linspace(middle - 2e-5, middle + 2e-5, 4001), run.t[0], run.t[-1])
    values = run.sol(times)
    for name, q in (("dp/dt", pressure(times, values)), ("dT/dt", values[-1])):
        print(f"largest {name} {(times[np.argmax(np.gradient(q, times[1] - times[0]))] - origin) * 1e3:.4f} ms after {origin:g} s")
    print(f"at the end {y[-1]:.2f} K, {float(pressure(run.t, run.y)[-1]):.6g} Pa")


def main():
    if sys.argv[1] == "heptane":
        gas, T, end = Gas(CASES / "mechanisms/heptane_yoo2011_88.yaml"), float(sys.argv[2]), 25e-3
        moles = {"NC7H16": 1.0, "O2": 11.0, "N2": 11.0 * 79 / 21}
        ignite(gas, T, float(sys.argv[3]) * 1e5, moles, rising(gas, T, np.array([moles.get(s, 0.0) for s in gas.names]), 0.0, end), end, 0.0)
        return
    gas = Gas(CASES / "mechanisms/hydrogen_h2o2_10.yaml")
    if sys.argv[1] == "rapid_compression":
        volume, smallest = table(CASES / "reactor/rapid_compression/volume.csv")
        moles = {"H2": 0.125, "O2": 0.0625, "N2": 0.18125, "AR": 0.63125}
        ignite(gas, 297.4, 958 / 760 * ATMOSPHERE, moles, volume, 0.04, smallest)
    else:
        moles, T, end = {"H2": 0.04, "O2": 0.02, "AR": 0.94}, 1050.0, 4e-3
        X = np.array([moles.get(s, 0.0) for s in gas.names])
        rate = float(sys.argv[2]) * 10 if len(sys.argv) > 2 else 50.0
        ignite(gas, T, 3.5 * ATMOSPHERE, moles, rising(gas, T, X, rate, end), end, 0.0)


if __name__ == "__main__":
    main()
