#!/usr/bin/env python3
"""tests/long/mutants.py [--count N] [--seed S] [--work FOLDER] [FILE...]

Changes one comparison, sign or constant of the core at a time, in a copy of the tree, and runs the core's tests: each
mutant must be killed, that is, fail a test, end in a crash or run for ever. FILEs default to all of src/sweep, src/index,
src/world and src/motion. Tries N (all) of the mutants, drawn by the seed S. Results are kept in FOLDER (build-mutants),
so that the same command goes on where it was stopped. Prints a table, and each mutant that survived.
About a minute a mutant: all of them take days. Status 1 if one survives that tests/long/mutants.txt does not list as
harmless."""

import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import time

from changed_tree import SOURCE, ChangedTree, Late, ends_well

ROOMS = ("sweep", "index", "world", "motion")
TOKEN = re.compile(r"""
    (?P<skip>//.*|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')
  | (?P<compare>(?<=\ )(?:<=|>=|==|!=|<|>)(?=\ ))
  | (?P<logic>(?<=\ )(?:&&|\|\|)(?=\ ))
  | (?P<binary>(?<=\ )[-+*/](?=\ ))
  | (?P<unary>(?<=[(,=?:]\ )-(?=[\w(])|(?<=[(\[{])-(?=[\w(])|(?<=return\ )-(?=[\w(]))
  | (?P<compound>(?<=\ )[-+]=(?=\ ))
  | (?P<number>(?<![\w.])(?:0x[0-9a-fA-F.]+p[-+]?\d+|0x[0-9a-fA-F]+|\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+|\d+)[fFuUlL]*(?![\w.']))
""", re.VERBOSE)
OTHER = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&", "+": "-", "-": "+",
         "*": "/", "/": "*", "+=": "-=", "-=": "+="}


def changed(kind, text):
    """What takes the place of a token."""
    if kind == "unary":
        return ""
    if kind != "number":
        return OTHER[text]
    bare = text.rstrip("uUlL" if text.startswith("0x") and "p" not in text else "fFuUlL")
    suffix = text[len(bare):]
    if bare.isdigit() or (bare.startswith("0x") and "p" not in bare):
        return str(int(bare, 0) + 1) + suffix
    value = float.fromhex(bare) if bare.startswith("0x") else float(bare)
    return repr(1.0 if value == 0.0 else 2.0 * value) + suffix


def mutants_of(path):
    """(line, column, token, replacement) of each mutant of a file."""
    for number, line in enumerate((SOURCE / path).read_text(encoding="utf-8").splitlines(), 1):
        if line.lstrip().startswith(("#", "///", "//", "static_assert", "template", "using ", "namespace ")):
            continue
        for match in TOKEN.finditer(line):
            if match.lastgroup != "skip":
                yield number, match.start(), match.group(), changed(match.lastgroup, match.group())


class Bench(ChangedTree):
    """Builds and runs the core's tests."""

    def __init__(self, work):
        super().__init__(work, ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DROAM_TOOLS=OFF",
                                "-DROAM_UNITY=OFF"], [])
        self.programs = sorted(p for p in self.build.glob("test_*") if os.access(p, os.X_OK) and p.is_file())
        self.seconds = {}
        for program in self.programs:
            begin = time.monotonic()
            try:
                if not ends_well([program], 3600):
                    sys.exit(f"{program.name} fails as it is")
            except Late:
                sys.exit(f"{program.name} does not end in an hour as it is")
            self.seconds[program] = time.monotonic() - begin

    def judge(self, path, line, column, token, replacement):
        """Killed by which test program, 'compiler', or None."""
        def change(text):
            lines = text.splitlines(keepends=True)
            old = lines[line - 1]
            lines[line - 1] = old[:column] + replacement + old[column + len(token):]
            return "".join(lines)

        with self.changed(path, change):
            try:
                if not self.compiles():
                    return "compiler"
            except Late:
                return "compiler"  # which computes a constant for ever
            room = pathlib.Path(path).parts[1]
            # The room's own tests first, then from the quickest.
            for program in sorted(self.programs, key=lambda p: (not p.name.startswith(f"test_{room}"), self.seconds[p])):
                try:
                    if not ends_well([program], 20 * self.seconds[program] + 60):
                        return program.name
                except Late:
                    return f"{program.name}, which did not end"
            return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", metavar="FILE", nargs="*")
    parser.add_argument("--count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--work", type=pathlib.Path, default=SOURCE / "build-mutants")
    options = parser.parse_args()
    files = options.files or [str(p.relative_to(SOURCE)) for room in ROOMS
                              for p in sorted((SOURCE / "src" / room).iterdir()) if p.suffix in (".h", ".cpp")]
    every = [(path, *mutant) for path in files for mutant in mutants_of(path)]
    chosen = every if options.count is None else random.Random(options.seed).sample(every, min(options.count, len(every)))
    kept = options.work / "results.jsonl"
    known = {}
    if kept.exists():
        for row in map(json.loads, kept.read_text(encoding="utf-8").splitlines()):
            known[tuple(row["mutant"])] = row["killed_by"]
    # A result holds as long as the mutant's line, and the core's tests.
    listed = subprocess.run(["git", "ls-tree", "HEAD:tests", "math", *ROOMS, "made", "support"], cwd=SOURCE, check=True,
                            capture_output=True).stdout
    tests = hashlib.sha256(listed).hexdigest()[:16]
    lines = {path: (SOURCE / path).read_text(encoding="utf-8").splitlines() for path in files}
    # A line of it is one mutant: another in an equal line of the file may do harm.
    harmless = (SOURCE / "tests/long/mutants.txt").read_text(encoding="utf-8").splitlines()
    bench, table, survived, endless = None, {}, [], 0
    for path, line, column, token, replacement in chosen:
        key = (path, tests, line, lines[path][line - 1], column, token, replacement)
        if key not in known:
            bench = bench or Bench(options.work)
            known[key] = bench.judge(path, line, column, token, replacement)
            with kept.open("a", encoding="utf-8") as out:
                out.write(json.dumps({"mutant": key, "killed_by": known[key]}) + "\n")
        killed_by = known[key]
        if killed_by == "compiler":
            continue
        counts = table.setdefault(path, [0, 0])
        counts[0] += 1
        endless += bool(killed_by) and killed_by.endswith("did not end")
        if killed_by is None:
            counts[1] += 1
            survivor = f"{path}: {token} -> {replacement or 'nothing'}: {lines[path][line - 1].strip()}"
            if survivor in harmless:
                harmless.remove(survivor)
            else:
                survived.append(survivor)
    for path, (tried, alive) in sorted(table.items()):
        print(f"{path}: {tried} mutants, {alive} survived")
    for survivor in survived:
        print(survivor)
    tried, alive = sum(t for t, _ in table.values()), sum(a for _, a in table.values())
    print(f"{len(every)} mutants, {tried} tried: {tried - alive} killed ({endless} by tests that did not end), "
          f"{alive - len(survived)} harmless, {len(survived)} survived")
    return 1 if survived else 0


if __name__ == "__main__":
    sys.exit(main())
