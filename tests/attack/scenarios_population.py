"""Population balances: burn-out in all Monte Carlo methods, memory, sections too few, numbers beyond all bounds."""

from deck_text import REMOVE, Raw

FAMILIES, MONO, INCEPTION = "soot_families", "chapter5_02_coagulation_monodisperse", "soot_inception"
MONTE_CARLO = ("dsmc", "constant_volume", "constant_number_mass", "constant_number_number", "mmc", "wfmc", "samwfmc", "sammc",
               "swa", "hybrid")


def burn_out(method: str, rate: str = "1e-7 m/s", treatment: dict | None = None) -> dict:
    changes = {"initial": {"distribution": "monodisperse", "number": "1e16 1/m^3", "diameter": "20 nm"},
               "processes": {"coagulation": {"kernel": "constant", "rate": "1e-15 m^3/s"}, "oxidation": {"rate": rate}},
               "methods": {"one": {"type": method, "particles": Raw("200")}},
               "time": {"end": "0.2 s"}, "repeats": Raw("2"), "distribution": REMOVE}
    if method == "hybrid":
        changes["methods"]["one"]["threshold"] = Raw("10")
    if treatment:
        changes["processes"]["growth"] = treatment
    return changes


SCENARIOS = [
    *[(f"burn-out by {method}", MONO, burn_out(method), "refused" if method == "hybrid" else "accepted") for method in MONTE_CARLO],
    *[(f"burn-out by {method}, slowly", MONO, burn_out(method, "6e-8 m/s"), "accepted") for method in ("dsmc", "sammc", "swa")],
    *[(f"burn-out by {method}, at once", MONO, burn_out(method, "1 m/s"), "accepted") for method in ("dsmc", "mmc", "swa")],
    ("burn-out by dsmc, deferred", MONO, burn_out("dsmc", treatment={"treatment": "deferred"}), ""),
    ("burn-out by sections", MONO, {**burn_out("sectional"), "methods": {"one": {"type": "sectional", "sections": Raw("60"),
     "smallest": "1e-28 m^3", "spacing": Raw("1.5"), "unbiased_moments": []}}}, ""),
    ("burn-out by qmom", MONO, {**burn_out("qmom"), "methods": {"one": {"type": "qmom", "moments": Raw("6"), "unbiased_moments": []}}}, ""),
    ("1e9 particles", FAMILIES, {"methods.dsmc.particles": Raw("1000000000")}, "refused"),
    ("4294967298 particles", FAMILIES, {"methods.dsmc.particles": Raw("4294967298")}, "refused"),
    ("1e8 repeats of 1e5 rows", FAMILIES, {"repeats": Raw("100000000"), "time.outputs": Raw("100000")}, ""),
    ("1e5 bins at 1e5 times", FAMILIES, {"distribution.bins": Raw("100000"), "distribution.times": [f"{t} us" for t in range(1, 2000)]}, ""),
    ("two particles", FAMILIES, {"methods.dsmc.particles": Raw("2"), "methods.sammc.particles": Raw("2")}, "accepted"),
    ("sections too few", FAMILIES, {"methods.sections.sections": Raw("20"), "methods.sections.spacing": Raw("1.1")}, "refused numerics"),
    ("sections of spacing 1e300", FAMILIES, {"methods.sections.spacing": Raw("1e300")}, "refused numerics"),
    ("largest below smallest", FAMILIES, {"methods.sections.spacing": REMOVE, "methods.sections.largest": "1e-30 m^3"}, "refused"),
    ("claims twice", FAMILIES, {"methods.qmom.unbiased_moments": ["M0", "M0"]}, "refused"),
    ("times twice", FAMILIES, {"distribution.times": ["2 ms", "2 ms"]}, "refused"),
    ("nuclei of 1e300 m", FAMILIES, {"processes.nucleation.diameter": "1e300 m"}, "refused"),
    ("nuclei of 1e-300 m", FAMILIES, {"processes.nucleation.diameter": "1e-300 m"}, "refused"),
    ("a coagulation of 1e300", MONO, {"processes.coagulation.rate": "1e300 m^3/s"}, ""),
    ("a kernel's rate of another dimension", MONO, {"processes.coagulation.rate": "1 1/s"}, "refused"),
    ("growth that overflows", FAMILIES, {"processes.surface_growth.rate": "1e300 m/s"}, ""),
    ("gas at 1e-300 K", FAMILIES, {"gas.temperature": "1e-300 K"}, ""),
    ("gas without a temperature", FAMILIES, {"gas": REMOVE}, "refused"),
    ("no methods", FAMILIES, {"methods": {}}, "refused"),
    ("no processes", FAMILIES, {"processes": REMOVE}, "accepted refused"),
    ("a method's name that is a path", FAMILIES, {"methods": {"../x": {"type": "dsmc", "expected_number": "2e10 1/cm^3"}}}, "refused accepted"),
    ("a method's name with a comma", FAMILIES, {"methods": {"a,b\"c": {"type": "dsmc", "particles": Raw("100"), "expected_number": "2e10 1/cm^3"}}},
     "refused accepted"),
    ("an end of 1e-300 s", MONO, {"time.end": "1e-300 s"}, ""),
    ("an end of 1e300 s", MONO, {"time.end": "1e300 s"}, ""),
    ("breakage at 1e9 1/s", "chapter5_05_breakage_equal", {"processes.breakage.rate": "1e9 1/s"}, ""),
    ("breakage into 1000", "chapter5_05_breakage_equal", {"processes.breakage.fragments": Raw("1000")}, ""),
    ("dilution at 1e9 1/s", MONO, {"processes.dilution": {"rate": "1e9 1/s"}}, ""),
    ("deposition of everything", "chapter5_16_deposition", {"processes.deposition.rate": "1e6 1/s"}, ""),
    ("threshold of 4294967297", INCEPTION, {"methods.hybrid.threshold": Raw("4294967297")}, "refused"),
    ("threshold of 1e9", INCEPTION, {"methods.hybrid.threshold": Raw("1000000000")}, ""),
    ("condensation backwards", "chapter5_17_condensation", {"processes.condensation.rate": "-1 1/s"}, ""),
]
