"""No #include goes against the arrows of docs/architecture.md: from module to module, nor between the folders of a module.

A template or an inline function of a forbidden module needs no library, so that linking alone does not find it. What a module
may know is what its CMakeLists.txt links; the page's column "knows" has to say the same. The order of the folders of
chemistry, particles, flow and app is that of the page, and folders beside each other never include each other in a circle.

Usage: arrows_test.py [ROOT]
"""
import re
import sys
import tempfile
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.M)


def modules_linked(root):
    """Module -> modules it links, from lampblack_module(...) of each folder."""
    linked = {}
    for file in sorted(root.glob("*/CMakeLists.txt")):
        call = re.search(r"lampblack_module\((\w+)(.*?)\)", re.sub(r"#.*", "", file.read_text()), re.S)
        if call:
            linked[call[1]] = set(re.findall(r"\blampblack_(\w+)", call[2]))
    return linked


def modules_on_page(page, modules):
    """Module -> modules it knows, from the first table of the page."""
    known = {}
    for name, knows in re.findall(r"^\| `(\w+)/` \| ([^|]*) \|", page, re.M):
        if name in modules:
            known[name] = modules - {name} if knows.strip() == "all" else set(re.findall(r"`(\w+)`", knows))
    return known


# Modules with folders that the page lists, each building on those before it.
ORDERED = ("chemistry", "particles", "flow", "app")


def folders_on_page(page, module):
    return re.findall(rf"^\| `{module}/(\w+)/` \|", page, re.M)


def includes(root, folder):
    for file in sorted((root / folder).rglob("*")):
        if file.suffix in (".hpp", ".cpp", ".h", ".inc"):
            for _, target in INCLUDE.findall(file.read_text()):
                yield file.relative_to(root), target


def wrong_arrows(root):
    page = (root / "docs/architecture.md").read_text()
    linked = modules_linked(root)
    known = modules_on_page(page, set(linked))
    wrong = []
    for module in linked:
        if known.get(module) != linked[module]:
            wrong.append(f"docs/architecture.md says that {module} knows {sorted(known.get(module, []))}, "
                         f"{module}/CMakeLists.txt that it links {sorted(linked[module])}")
        for file, target in includes(root, module):
            other = target.split("/")[0]
            if ".." in target or (other in linked and other != module and other not in linked[module]):
                wrong.append(f"{file}: {module} may not know {target}")
    for module in (module for module in ORDERED if module in linked):
        order = folders_on_page(page, module)
        for place, folder in enumerate(order):
            for file, target in includes(root, f"{module}/{folder}"):
                later = [f for f in order[place + 1:] if target.startswith(f"{module}/{f}/")]
                if later:
                    wrong.append(f"{file}: {target} builds on {module}/{folder}, not the other way round")
        present = {path.name for path in (root / module).iterdir() if path.is_dir()}
        if present != set(order):
            wrong.append(f"docs/architecture.md has the folders {sorted(order)} of {module}, there are {sorted(present)}")
    return wrong


def circles(root, module):
    """Circles of folders that stand beside each other in one folder, each as the names in it."""
    leads_to = {}  # (folder, one inside) -> others inside that it includes from
    for file, target in includes(root, module):
        a, b = file.parent.parts, tuple(target.split("/")[:-1])
        depth = next((i for i, (x, y) in enumerate(zip(a, b)) if x != y), None)
        if depth:  # they part below a common folder
            leads_to.setdefault((a[:depth], a[depth]), set()).add(b[depth])
    found = set()
    for (parent, start) in leads_to:
        reached, open_ = set(), [start]
        while open_:
            new = leads_to.get((parent, open_.pop()), set()) - reached
            reached |= new
            open_ += new
        if start in reached:
            found.add(("/".join(parent), start))
    return sorted(found)


def toy(root):
    """A source tree of two modules with one include against each kind of arrow, and some that may be."""
    files = {
        "core/CMakeLists.txt": "lampblack_module(core SOURCES a.cpp PUBLIC MPI::MPI_CXX)",
        "chemistry/CMakeLists.txt": "lampblack_module(chemistry SOURCES b.cpp PUBLIC lampblack_core)",
        "core/a.hpp": '#include <vector>\n#include "chemistry/thermo/b.hpp"\ntemplate <class T> T twice(T x);',
        "core/c.hpp": '#include "../chemistry/thermo/b.hpp"',
        "core/d.hpp": '  #  include <chemistry/thermo/b.hpp>',
        "chemistry/thermo/b.hpp": '#include "core/a.hpp"\n#include "chemistry/mechanism/n.hpp"',
        "chemistry/mechanism/n.hpp": '#include "chemistry/thermo/b.hpp"',
        "core/one/a.hpp": '#include "core/two/a.hpp"',
        "core/two/a.hpp": '#include "core/three/a.hpp"\n#include "core/a.hpp"',
        "core/three/a.hpp": '#include "core/one/a.hpp"\n#include "core/four/a.hpp"',
        "core/four/a.hpp": "",
        "docs/architecture.md": "| `core/` | MPI | errors |\n| `chemistry/` | `core` | gas |\n\n"
                                "| `chemistry/mechanism/` | x |\n| `chemistry/thermo/` | y |\n",
    }
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)


def check_the_checker():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        toy(root)
        found = [line.split(":")[0] for line in wrong_arrows(root)]
        assert sorted(found) == ["chemistry/mechanism/n.hpp", "core/a.hpp", "core/c.hpp", "core/d.hpp"], found
        assert circles(root, "core") == [("core", "one"), ("core", "three"), ("core", "two")], circles(root, "core")
        page = root / "docs/architecture.md"
        page.write_text(page.read_text().replace("| MPI |", "| MPI, `chemistry` |"))
        assert any("says that core knows ['chemistry']" in line for line in wrong_arrows(root))


def main():
    check_the_checker()
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[1]
    assert len(modules_linked(root)) >= 6, "the modules are not where this test looks for them"
    wrong = wrong_arrows(root)
    for module in modules_linked(root):
        wrong += [f"{parent}/{folder} is in a circle of folders that include each other" for parent, folder in circles(root, module)]
    for line in wrong:
        print(line)
    if wrong:
        sys.exit(f"{len(wrong)} against the arrows of docs/architecture.md")
    print("Every #include follows the arrows of docs/architecture.md.")


if __name__ == "__main__":
    main()
