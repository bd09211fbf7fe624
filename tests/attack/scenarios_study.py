"""Studies: more runs than there can be, methods and keys that are not there, decks that contain themselves."""

FREE = "CASES/flame1d/free_hydrogen/deck.yaml"
POPULATION = "CASES/population_balance/chapter5_03_coagulation_exponential.yaml"
CONVERGENCE = f"study: c\nconvergence: {{deck: {POPULATION}, set: [time.end=0.1 s, 'distribution.times=[0 s]'], METHODS particles: [16, 32], product: 64}}\n"
VARY = "- {key: inlet.equivalence_ratio, values: [" + ", ".join(str(1 + i / 1000) for i in range(1000)) + "]}"

SCENARIOS = [
    ("two flames", f"study: s\ndeck: {FREE}\nvary:\n- {{key: inlet.equivalence_ratio, values: [1, 1.2]}}\n", "accepted"),
    ("1e9 runs", f"study: s\ndeck: {FREE}\nvary:\n{VARY}\n" + VARY.replace("inlet.equivalence_ratio", "grid.slope") + "\n"
     + VARY.replace("inlet.equivalence_ratio", "grid.curve") + "\n", "refused"),
    ("1e6 runs", f"study: s\ndeck: {FREE}\nvary:\n{VARY}\n" + VARY.replace("inlet.equivalence_ratio", "grid.slope") + "\n", ""),
    ("a value twice", f"study: s\ndeck: {FREE}\nvary:\n- {{key: inlet.equivalence_ratio, values: [1, 1]}}\n", "refused"),
    ("an unknown key", f"study: s\ndeck: {FREE}\nvary:\n- {{key: inlet.ratio, values: [1]}}\n", "refused"),
    ("a key varied twice", f"study: s\ndeck: {FREE}\nvary:\n- {{key: grid.slope, values: [0.1]}}\n- {{key: grid.slope, values: [0.2]}}\n", ""),
    ("a run that fails in check", f"study: s\ndeck: {FREE}\nvary:\n- {{key: inlet.temperature, values: [300 K, 50 K]}}\n", "refused"),
    ("no decks", "study: s\n", "refused"),
    ("no values", f"study: s\ndeck: {FREE}\nvary:\n- {{key: grid.slope, values: []}}\n", "refused"),
    ("a deck that is a study", "study: s\ndeck: CASES/flame1d/free_hydrogen/study.yaml\n", "refused"),
    ("a deck that is itself", "study: s\ndeck: deck.yaml\n", "refused"),
    ("a deck that is not there", "study: s\ndeck: nowhere.yaml\n", "refused"),
    ("a deck that never ends", "study: s\ndeck: /dev/urandom\n", "refused"),
    ("a deck that is a folder", "study: s\ndeck: /\n", "refused"),
    ("the same deck twice", f"study: s\ndecks: [{FREE}, {FREE}]\n", "refused"),
    ("4294967297 ranks a run", f"study: s\ndeck: {FREE}\nranks_per_run: 4294967297\n", "refused"),
    ("a chain of 4294967297", f"study: s\ndeck: {FREE}\nchain: 4294967297\n", "accepted refused"),
    ("a name that is a path", f"study: s\ndeck: {FREE}\nvariants:\n- {{name: ../../x, set: []}}\n", "accepted refused"),
    ("a variant twice", f"study: s\ndeck: {FREE}\nvariants:\n- {{name: a, set: []}}\n- {{name: a, set: []}}\n", "refused"),
    ("columns that are not there", f"study: s\ndeck: {FREE}\ncollect: {{results: [nothing]}}\n", ""),
    ("convergence", CONVERGENCE.replace("METHODS", "methods: [sammc_relative],"), "accepted"),
    ("convergence of unknown methods", CONVERGENCE.replace("METHODS", "methods: [nothing],"), "refused"),
    ("convergence of a method twice", CONVERGENCE.replace("METHODS", "methods: [sammc_relative, sammc_relative],"), "refused"),
    ("convergence of 4294967298 particles", CONVERGENCE.replace("METHODS", "").replace("[16, 32]", "[4294967298]"), "refused"),
    ("convergence with a product too small", CONVERGENCE.replace("METHODS", "").replace("product: 64", "product: 4"), "refused"),
    ("convergence of a flame", f"study: c\nconvergence: {{deck: {FREE}, particles: [16]}}\n", "refused"),
    ("convergence against an unknown method", CONVERGENCE.replace("METHODS", "reference: {type: run, method: nothing, particles: 100, repeats: 2},"),
     "refused"),
]
