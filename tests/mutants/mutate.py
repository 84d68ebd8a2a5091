#!/usr/bin/python3
"""A copy of core/ with every mutant of mutants.toml in it, each asleep until TOUCHMARK_MUTANT names it.

Files appear only when they change, so that a rebuild compiles what it must.
"""
import argparse
import pathlib
import sys
import tomllib

KINDS = {
    "expression": "({on} ? ({new}) : ({old}))",
    "statement": "if ({on}) {{ {new} }} else {{ {old} }}",
    "before": "if ({on}) {{ {new} }}\n{old}",  # `old` stays, `new` comes first and may return
}

# A switch is declared in the files that ask for it alone, so that a new mutant recompiles no more than those.
DECLARATIONS = "namespace touchmark::mutants {{ extern bool {names}; }}\n#line 1 \"{file}\"\n"

SWITCHES = """#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace touchmark::mutants {{
bool {switches};
namespace {{
struct Mutant {{
  const char* name;
  bool* awake;
}};
constexpr Mutant mutants[] = {{{table}}};

// Before any other initialisation.
[[gnu::constructor(101)]] void wake() {{
  const char* const wanted = std::getenv("TOUCHMARK_MUTANT");
  if (wanted == nullptr) return;
  for (const Mutant& mutant : mutants)
    if (std::strcmp(mutant.name, wanted) == 0) {{
      *mutant.awake = true;
      return;
    }}
  std::fprintf(stderr, "no mutant is called '%s'\\n", wanted);
  std::_Exit(2);
}}
}}  // namespace
}}  // namespace touchmark::mutants
"""


class BadList(Exception):
    """One line: which mutant, what is wrong with it."""


def read_list(path):
    """The mutants in order: name, sentence, whatever else the driver wants, and edits."""
    with open(path, "rb") as file:
        mutants = tomllib.load(file)["mutant"]
    names = [mutant["name"] for mutant in mutants]
    for name in names:
        if names.count(name) > 1:
            raise BadList(f"two mutants are called {name}")
    for mutant in mutants:
        for member in ("bug", "seen", "edits"):
            if not mutant.get(member):
                raise BadList(f"mutant {mutant['name']} has no {member}")
        for edit in mutant["edits"]:
            if edit["file"].endswith(".inl"):  # which stands inside a namespace of what includes it
                raise BadList(f"mutant {mutant['name']} edits {edit['file']}: a header or a source is wanted")
            if edit.setdefault("kind", "expression") not in KINDS:
                raise BadList(f"mutant {mutant['name']} has an edit of unknown kind {edit['kind']}")
    return mutants


def switch(name):
    return name.replace("-", "_")


def edits_by_file(mutants):
    files = {}
    for mutant in mutants:
        for edit in mutant["edits"]:
            files.setdefault(edit["file"], []).append((mutant["name"], edit))
    return files


def mutated(path, text, edits):
    places = []
    for name, edit in edits:
        found = text.count(edit["old"])
        if found != 1:
            raise BadList(f"mutant {name}: {path} holds {edit['old'].splitlines()[0]!r} {found} times, not once")
        at = text.index(edit["old"])
        on = f"::touchmark::mutants::{switch(name)}"
        places.append((at, at + len(edit["old"]), name, KINDS[edit["kind"]].format(on=on, **edit)))
    places.sort()
    for (_, end, name, _), (begin, _, other, _) in zip(places, places[1:]):
        if begin < end:
            raise BadList(f"mutants {name} and {other} change the same text of {path}")
    for begin, end, _, replacement in reversed(places):
        text = text[:begin] + replacement + text[end:]
    if not places:
        return text
    names = sorted({switch(name) for name, _ in edits})
    return DECLARATIONS.format(names=", ".join(names), file=path) + text


def write(path, text):
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def generate(root, listing, folder):
    mutants = read_list(listing)
    files = edits_by_file(mutants)
    for source in sorted((root / "core").rglob("*")):
        if source.suffix not in (".h", ".cpp", ".inl"):
            continue
        name = source.relative_to(root).as_posix()
        text = mutated(name, source.read_text(encoding="utf-8"), files.pop(name, []))
        write(folder / name, text)
    for name in files:
        raise BadList(f"{name} is not there to be mutated")
    names = [mutant["name"] for mutant in mutants]
    write(folder / "core/mutant.cpp", SWITCHES.format(
        switches=", ".join(map(switch, names)),
        table=", ".join(f'{{"{name}", &{switch(name)}}}' for name in names)))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("root", type=pathlib.Path, help="where core/ is")
    parser.add_argument("listing", type=pathlib.Path, help="mutants.toml")
    parser.add_argument("folder", type=pathlib.Path, help="where the copy goes")
    arguments = parser.parse_args()
    try:
        generate(arguments.root, arguments.listing, arguments.folder)
    except (BadList, KeyError, OSError, tomllib.TOMLDecodeError) as fault:
        print(f"mutate.py: {arguments.listing.name}: {fault}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
