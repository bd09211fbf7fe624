"""Decks whose text is strange: depth, length, encodings, what YAML can do and a deck cannot use. Those that grow have to be
refused within seconds.
"""


def after(text: str):
    """Adds lines to the deck."""
    return lambda deck: deck + text


def instead(old: str, new: str):
    """Replaces a part of the deck."""
    def spoil(deck: str) -> str:
        assert old in deck, old
        return deck.replace(old, new)
    return spoil


def lines_between(text: str):
    return lambda deck: deck.replace("\n", text)


LAUGHS = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]\n" for i in range(1, 10))
PRESSURE = 'pressure: "1 atm"'

SCENARIOS = [
    ("100 000 unknown keys", after("".join(f"key{i}: 1\n" for i in range(100_000))), "refused"),
    ("an unknown key of a million letters", after("k" * 1_000_000 + ": 1\n"), "refused"),
    ("100 000 lists in each other", after("title2: " + "[" * 100_000 + "\n"), "refused"),
    ("100 000 lists in each other, closed", instead(PRESSURE, "pressure: " + "[" * 100_000 + "]" * 100_000), "refused"),
    ("100 000 maps in each other", instead(PRESSURE, "pressure: " + "{a: " * 100_000 + "1" + "}" * 100_000), "refused"),
    ("2000 sections in each other", after("".join(f"{' ' * i}a:\n" for i in range(2000))), "refused"),
    ("aliases that grow", after(LAUGHS), "refused"),
    ("an alias of itself", instead(PRESSURE, "pressure: &a [*a]"), "refused"),
    ("an alias of nothing", instead(PRESSURE, "pressure: *nothing"), "refused"),
    ("an anchor used well", instead(PRESSURE, "pressure: &p 1 atm"), "accepted refused"),
    ("a key merged", after("<<: {pressure: 2 atm}\n"), "refused"),
    ("two documents", after("---\nproblem: flow\n"), "refused"),
    ("a document's end", after("...\n"), "accepted"),
    ("a tag of Python", instead(PRESSURE, "pressure: !!python/object:os.system 1 atm"), "accepted refused"),
    ("binary", instead(PRESSURE, "pressure: !!binary MSBhdG0="), "refused"),
    ("nothing", lambda deck: "", "refused"),
    ("a remark", lambda deck: "# nothing\n", "refused"),
    ("a list", lambda deck: "- 1\n- 2\n", "refused"),
    ("a word", lambda deck: "reactor\n", "refused"),
    ("a null", lambda deck: "~\n", "refused"),
    ("a key's text of ten million letters", instead("title:", "title2: " + "x" * 10_000_000 + "\ntitle:"), "refused"),
    ("a remark of ten million letters", after("# " + "x" * 10_000_000 + "\n"), "accepted refused"),
    ("a million empty lines", after("\n" * 1_000_000), "accepted refused"),
    ("line ends of Windows", lines_between("\r\n"), "accepted"),
    ("line ends of old Macintoshes", lines_between("\r"), "accepted refused"),
    ("a byte-order mark", lambda deck: "\ufeff" + deck, "accepted refused"),
    ("UTF-16", lambda deck: deck.encode("utf-16"), "refused accepted"),
    ("Latin 1", lambda deck: deck.replace("title: \"", "title: \"\xe9").encode("latin-1"), "refused accepted"),
    ("a zero byte", instead(PRESSURE, "pressure: 1\0atm"), "refused"),
    ("a tab", instead(PRESSURE, "pressure:\t1 atm"), "accepted refused"),
    ("an indentation of tabs", after("time:\n\tend: 1 s\n"), "refused"),
    ("a space that does not break", instead(PRESSURE, "pressure: 1\u00a0atm"), "accepted refused"),
    ("digits of another script", instead(PRESSURE, "pressure: \u0661 atm"), "refused"),
    ("a number of 100 000 digits", instead(PRESSURE, "pressure: " + "1" * 100_000 + " Pa"), "refused"),
    ("a number of 100 000 zeros", instead(PRESSURE, "pressure: 0." + "0" * 100_000 + "1 Pa"), "refused"),
    ("an exponent of 100 digits", instead(PRESSURE, "pressure: 1e" + "9" * 100 + " Pa"), "refused"),
    ("a unit of 100 000 factors", instead(PRESSURE, "pressure: 1 Pa" + " m/m" * 100_000), "refused accepted"),
    ("a composition of 100 000 species", instead('fuel: "CH4: 1"', 'fuel: "' + ", ".join(f"X{i}: 1" for i in range(100_000)) + '"'), "refused"),
    ("a composition of 100 000 times one", instead('fuel: "CH4: 1"', 'fuel: "' + ", ".join(["CH4: 1"] * 100_000) + '"'), "refused"),
    ("a mechanism's name of 100 000 letters", instead("mechanism: \"", "mechanism: \"" + "x" * 100_000), "refused"),
    ("a key that is a list", after("[1, 2]: 3\n"), "refused"),
    ("a key that is empty", after("\"\": 3\n"), "refused"),
    ("a key with a line's end", after("\"a\\nb\": 3\n"), "refused"),
    ("letters that move the cursor", after("\"\\e[2J\\e[31m\": 3\n"), "refused"),
]
