"""Reactors: duplicates, ends at once, extremes, streams that go nowhere."""

from deck_text import REMOVE, Raw

IGNITION, STIRRED, PLUG, NETWORK = ("ignition_hydrogen", "stirred_methane", "plug_flow_ethylene",
                                    "network_combustor")

SCENARIOS = [
    ("ignition species twice", IGNITION, {"ignition.species": ["OH", "OH"]}, "refused"),
    ("sensitivity to a reaction twice", IGNITION, {"sensitivity.reactions": [Raw("1"), Raw("1")]}, "refused"),
    ("sensitivity to reaction 4294967297", IGNITION, {"sensitivity.reactions": [Raw("4294967297")]}, "refused"),
    ("nothing ignites", IGNITION, {"initial.composition": "N2: 1", "sensitivity": REMOVE}, "accepted refused"),
    ("sensitivity of what does not ignite", IGNITION, {"initial.composition": "N2: 1"}, "accepted refused"),
    ("start at 150 K", IGNITION, {"initial.temperature": "150 K"}, "refused"),
    ("start at 200 K", IGNITION, {"initial.temperature": "200 K", "sensitivity": REMOVE}, "accepted"),
    ("start at 6000 K", IGNITION, {"initial.temperature": "6000 K"}, "refused"),
    ("an end of 1e300 s", IGNITION, {"time.end": "1e300 s", "sensitivity": REMOVE}, ""),
    ("an end of 1e-300 s", IGNITION, {"time.end": "1e-300 s", "sensitivity": REMOVE}, ""),
    ("1e300 Pa", IGNITION, {"pressure": "1e300 Pa"}, "refused numerics"),
    ("1e-300 Pa", IGNITION, {"pressure": "1e-300 Pa"}, ""),
    ("amounts that overflow", IGNITION, {"initial.composition": "H2: 1e308, O2: 1e308"}, "accepted"),
    ("amounts that vanish", IGNITION, {"initial.composition": "H2: 1e-320, O2: 1e-320"}, ""),
    ("negative amount", IGNITION, {"initial.composition": "H2: -1, O2: 1"}, "refused"),
    ("a residence time of 1e-300 s", STIRRED, {"reactor.residence_time": "1e-300 s"}, ""),
    ("a residence time of 1e300 s", STIRRED, {"reactor.residence_time": "1e300 s"}, ""),
    ("a stirred reactor without fuel", STIRRED, {"inlet": {"temperature": "300 K", "composition": "N2: 1"}}, "accepted"),
    ("an inlet at 100 K", STIRRED, {"inlet.temperature": "100 K"}, "refused"),
    ("positions backwards", PLUG, {"temperature_profile.position": ["0 cm", "50 cm", "45 cm", "50 cm"]}, "refused"),
    ("positions too short", PLUG, {"temperature_profile.position": ["0 cm", "1 cm"], "temperature_profile.temperature": ["900 K", "900 K"]},
     "accepted refused"),
    ("a length of 1e300 m", PLUG, {"reactor.length": "1e300 m"}, ""),
    ("supersonic plug flow", PLUG, {"inlet.velocity": "1e6 m/s"}, ""),
    ("a profile of one point", PLUG, {"temperature_profile.position": ["0 cm"], "temperature_profile.temperature": ["900 K"]}, "accepted refused"),
    ("profile against the inlet", PLUG, {"inlet.temperature": "500 K"}, "accepted refused"),
    ("a connection to itself", NETWORK, {"network.connections[0]": {"from": "flame", "to": "flame", "fraction": Raw("0.3")}}, "accepted refused"),
    ("fractions beyond one", NETWORK, {"network.connections[0].fraction": Raw("0.9")}, "refused"),
    ("a reactor nobody feeds", NETWORK, {"network.reactors.island": {"volume": "1 cm^3"}}, "refused"),
    ("a loop without an outlet", NETWORK, {"network.connections[6]": {"from": "burnout_3", "to": "flame"}}, "refused"),
    ("a flow of 1e300 kg/s", NETWORK, {"network.inlets.air.mass_flow": "1e300 kg/s"}, ""),
    ("a mechanism that never ends", IGNITION, {"mechanism": "/dev/urandom"}, "refused"),
]
