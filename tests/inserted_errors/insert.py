#!/usr/bin/python3
"""Draws one-line errors with a seed and puts all of them into a checkout at once, each switched on by a number.

Usage: insert.py draw --seed N --count K LIST.json     draws K errors from the sources of this checkout
       insert.py apply LIST.json CHECKOUT              puts them into the sources of CHECKOUT (a clone that may be spoilt)

An error is a line of a source and the same line with an operator, a sign, a constant, an index or a condition changed, or
with its call left out. `apply` writes both, so that one build holds all errors: LAMPBLACK_INSERTED_ERROR=7 in the environment
switches error 7 on. Lines are found again by their text, so that a list drawn from one commit fits another.
"""

import argparse
import json
import pathlib
import random
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODULES = {"core": 8, "numerics": 4, "chemistry": 13, "particles": 15, "flow": 13, "coupling": 9, "io": 7, "app": 13}  # weights
SWAPS = {" + ": " - ", " - ": " + ", " * ": " / ", " / ": " * ", " += ": " -= ", " -= ": " += ", " *= ": " /= ", " < ": " <= ",
         " <= ": " < ", " > ": " >= ", " >= ": " > ", " == ": " != ", " != ": " == ", " && ": " || ", " || ": " && ",
         "std::max": "std::min", "std::min": "std::max", "true": "false", "false": "true"}
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*(?:[eE][-+]?\d+)?|\d+)(?![\w.])")
HEADER = """#pragma once
// Written by tests/inserted_errors/insert.py: which error is switched on, and which places were reached.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <unistd.h>
namespace lampblack_inserted {
struct Switch {
  int chosen = 0;
  bool reached[1000] = {};
  Switch() { if (const char* number = std::getenv("LAMPBLACK_INSERTED_ERROR")) chosen = std::atoi(number); }
  ~Switch() {
    const char* folder = std::getenv("LAMPBLACK_INSERTED_REACHED");
    if (folder == nullptr) return;
    std::FILE* file = std::fopen((std::string(folder) + "/" + std::to_string(getpid())).c_str(), "a");
    if (file == nullptr) return;
    for (int k = 0; k < 1000; ++k) if (reached[k]) std::fprintf(file, "%d\\n", k);
    std::fclose(file);
  }
};
inline Switch theSwitch;
inline bool on(int k) { theSwitch.reached[k] = true; return theSwitch.chosen == k; }
}  // namespace lampblack_inserted
"""


def without_texts(line: str) -> str:
    """The line with its texts and characters between quotes blanked, of the same length."""
    return re.sub(r'"(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)*\'', lambda m: '"' + "_" * (len(m[0]) - 2) + '"', line)


def parts(line: str):
    """Where a line may be changed: (kind, begin, end of the expression), or None where it is no whole statement."""
    code = without_texts(line)
    if "//" in code or re.search(r"\b(virtual|reserve|constexpr|static|using|template|throw|case|typedef|operator|delete|goto|requires|concept)\b", code):
        return None
    if re.search(r"\[[&=][^\]]*\]|\[\]\s*\(|\[this", code) or code.count("(") != code.count(")"):
        return None
    for kind, pattern in (("return", r"^\s*return (.+);$"), ("inline return", r"\{ return (.+); \}$"),
                          ("declaration", r"^\s*(?:const )?[\w:<>,]+[&*]? \w+ = ([^{]+);$"),
                          ("condition", r"^\s*(?:\} )?(?:else )?(?:if|while) \(([^;]+)\)(?: \{| [^()]*;| (?:return|continue|break)\b.*;)?$"),
                          ("loop", r"^\s*for \([^;]*; ([^;]+); [^;]*\)[^;]*;?$"),
                          ("statement", r"^\s*([\w.\->:\[\]()* +]+ [-+*/]?= [^{]+;)$"),
                          ("call", r"^\s*([\w.\->:\[\]]+\(.*\);)$")):
        match = re.search(pattern, code)
        if not match:
            continue
        begin, end = match.span(1)
        if kind == "condition":  # up to the bracket that closes it
            depth, end = 0, None
            for i in range(begin - 1, len(code)):
                depth += {"(": 1, ")": -1}.get(code[i], 0)
                if depth == 0:
                    end = i
                    break
            if end is None:
                return None
        return kind, begin, end
    return None


def changes(line: str, kind: str, begin: int, end: int):
    """Every way to spoil the expression: (what, the spoilt expression)."""
    text, code = line[begin:end], without_texts(line)[begin:end]
    if re.fullmatch(r"[\w.]*", code) and kind == "declaration":  # a first value, which the next lines replace
        return
    for old, new in SWAPS.items():
        if old == " + " and '"' in code:  # of texts
            continue
        for match in re.finditer(re.escape(old) if old.startswith(" ") else rf"\b{old}\b", code):
            yield f"{old.strip()} -> {new.strip()}", text[:match.start()] + new + text[match.end():]
    for match in NUMBER.finditer(code):
        number = match[1]
        new = repr(2 * float(number)) if "." in number else str(int(number) + 1)
        if number in ("0.0",):
            new = "1.0"
        yield f"{number} -> {new}", text[:match.start()] + new + text[match.end():]
    if kind == "call":
        yield "call left out", ";"


def candidates():
    for module in MODULES:
        for path in sorted((ROOT / module).rglob("*.?pp")):
            lines = path.read_text(encoding="utf-8").split("\n")
            for number, line in enumerate(lines):
                found = parts(line)
                # The other branch of a statement that is cut off here stands on the next line.
                if not found or (number and re.search(r"[-+*/,(=&|?:]$", lines[number - 1])):
                    continue
                for what, spoilt in changes(line, *found):
                    yield module, str(path.relative_to(ROOT)), number + 1, line, found, what, spoilt


def draw(seed: int, count: int, headers: float = 0.15) -> list:
    by_module = {}
    for candidate in candidates():
        by_module.setdefault(candidate[0], {}).setdefault(candidate[1:3], []).append(candidate)
    rng = random.Random(seed)
    chosen = []
    total = sum(MODULES.values())
    for module, lines in by_module.items():
        places = sorted(lines)
        number = round(count * MODULES[module] / total)
        wanted = {".hpp": round(headers * number)}
        wanted[".cpp"] = number - wanted[".hpp"]
        for ending, some in wanted.items():
            of_kind = [place for place in places if place[0].endswith(ending)]
            for place in rng.sample(of_kind, some):
                chosen.append(rng.choice(lines[place]))
    return [{"number": k, "file": c[1], "line": c[2], "text": c[3].strip(), "what": c[5], "spoilt": c[6]}
            for k, c in enumerate(chosen, start=1)]


def switched(line: str, number: int, spoilt: str) -> str:
    """The line that is itself or spoilt, by the switch. A spoilt text that begins with @line is the whole line, with ON for the switch."""
    if spoilt.startswith("@line "):
        return spoilt[6:].replace("ON", f"lampblack_inserted::on({number})")
    kind, begin, end = parts(line)
    before, text, after = line[:begin], line[begin:end], line[end:]
    on = f"lampblack_inserted::on({number})"
    if kind in ("condition", "loop"):
        return f"{before}{on} ? static_cast<bool>({spoilt}) : static_cast<bool>({text}){after}"
    if kind in ("return", "inline return", "declaration"):
        return f"{before}{on} ? ({spoilt}) : ({text}){after}"
    return f"{before}{{ if ({on}) {{ {spoilt} }} else {{ {text} }} }}"


def apply(errors: list, checkout: pathlib.Path) -> int:
    missing = 0
    (checkout / "core/inserted_errors.hpp").write_text(HEADER, encoding="utf-8")
    by_file = {}
    for error in errors:
        by_file.setdefault(error["file"], []).append(error)
    for file, of_file in by_file.items():
        path = checkout / file
        lines = path.read_text(encoding="utf-8").split("\n") if path.exists() else []
        for error in of_file:
            near = [i for i, line in enumerate(lines) if line.strip() == error["text"]]
            if not near:
                print(f"not found: {error['number']} {file}:{error['line']}: {error['text']}")
                missing += 1
                continue
            i = min(near, key=lambda place: abs(place + 1 - error["line"]))
            lines[i] = switched(lines[i], error["number"], error["spoilt"])
        at = next((i for i, line in enumerate(lines) if line.startswith("#include") or line.startswith("#pragma once")), 0)
        lines.insert(at + (1 if lines and lines[at].startswith("#pragma") else 0), '#include "core/inserted_errors.hpp"')
        if path.exists():
            path.write_text("\n".join(lines), encoding="utf-8")
    return missing


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    drawing = commands.add_parser("draw")
    drawing.add_argument("--seed", type=int, required=True)
    drawing.add_argument("--count", type=int, default=70)
    drawing.add_argument("list", type=pathlib.Path)
    applying = commands.add_parser("apply")
    applying.add_argument("list", type=pathlib.Path)
    applying.add_argument("checkout", type=pathlib.Path)
    arguments = parser.parse_args()
    if arguments.command == "draw":
        errors = draw(arguments.seed, arguments.count)
        arguments.list.write_text(json.dumps(errors, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        print(f"{len(errors)} errors in {arguments.list}")
        return 0
    return 1 if apply(json.loads(arguments.list.read_text(encoding="utf-8")), arguments.checkout) else 0


sys.exit(main())
