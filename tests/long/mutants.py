#!/usr/bin/env python3
"""tests/long/mutants.py [--count N] [--seed S] [--seconds T] [--rebuild] [--work FOLDER] [FILE...]

Changes one comparison, sign or constant of the core at a time, in a copy of the tree, and runs the core's tests: each
mutant must be killed, that is, fail a test, end in a crash or run for ever. FILEs, or folders of them, default to
src/sweep, src/index, src/world and src/motion. Tries N (all) of the mutants, drawn by the seed S. Results are kept in
FOLDER (build-mutants), so that the same command goes on where it was stopped. Prints a table, and each mutant that
survived. Status 1 if one survives that tests/long/mutants.txt does not list as harmless.

All mutants are in one build, with mutants.h: a variable of the environment says which one acts. Only those tests run in
which it would change a value, the quickest first, until they have taken T seconds (all: a few minutes for a mutant that
survives). Mutants of constant expressions, and of tokens that no test computes, need a build of their own, a minute
each: only with --rebuild."""

import argparse
import concurrent.futures
import functools
import hashlib
import json
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

from changed_tree import SOURCE, ChangedTree, Late, ended, ends_well

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
OTHER = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "&& false &&", "||": "|| true ||",
         "+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+="}
NAMES = {"<": "Less", "<=": "LessEqual", ">": "Greater", ">=": "GreaterEqual", "==": "Equal", "!=": "Unequal",
         "+": "Plus", "-": "Minus", "*": "Times", "/": "Over", "+=": "Add", "-=": "Subtract"}
MEMORY = 8 << 30  # bytes of addresses, against mutants that take all
ENDLESS = "did not end"


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


def switch(mutant, token, replacement):
    """What takes the place of the token in the build of all mutants."""
    if replacement == "":
        return f"roam_mutant::Negative{{{mutant}}}->*"
    if token in ("&&", "||"):
        return f"{token} roam_mutant::{'always' if token == '&&' else 'never'}({mutant}) {token}"
    if token in NAMES:
        return f"{token} roam_mutant::{NAMES[token]}{{{mutant}}} {token}"
    return f"roam_mutant::number({mutant}, {token}, {replacement})"




def replace(lines, line, column, token, by):
    """Puts something else in place of a token."""
    old = lines[line - 1]
    lines[line - 1] = old[:column] + by + old[column + len(token):]


def test_programs(build):
    return sorted(p for p in build.glob("test_*") if os.access(p, os.X_OK) and p.is_file())


class Switched(ChangedTree):
    """The build of all mutants, which have the numbers from 1."""

    def __init__(self, work, every):
        self.every, self.left_out = every, set()
        super().__init__(work / "all", ["-DCMAKE_BUILD_TYPE=Release", "-DROAM_TOOLS=OFF",
                                        "-DCMAKE_CXX_FLAGS_RELEASE=-O2",
                                        f"-DCMAKE_CXX_FLAGS=-std=c++20 -w -include {SOURCE}/tests/long/mutants.h"], [])
        self.tests = self.measured(work / "tests.json")

    def compiles(self):
        """Leaves out what does not compile: each line that the compiler names."""
        while True:
            self.write()
            built = subprocess.run(["cmake", "--build", self.build, "--", "-k", "0"], env={**os.environ, "LC_ALL": "C"},
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
            if built.returncode == 0:
                return True
            named = {(path, int(line)) for path, line in re.findall(r"(src/\w+/[\w.-]+):(\d+)", built.stdout)}
            worse = {n for n, m in enumerate(self.every, 1) if m[:2] in named} - self.left_out
            (self.build / "mutants.log").write_text(built.stdout, encoding="utf-8")
            print(f"{len(worse)} mutants are left out: their lines do not compile", flush=True)
            if not worse:
                return False
            self.left_out |= worse

    def write(self):
        """The sources with all mutants that are not left out."""
        texts = {}
        for number, (path, line, column, token, replacement) in reversed(list(enumerate(self.every, 1))):
            if number in self.left_out:
                continue
            text = texts.setdefault(path, (SOURCE / path).read_text(encoding="utf-8").splitlines(keepends=True))
            replace(text, line, column, token, switch(number, token, replacement))
        for path, lines in texts.items():
            if (self.tree / path).read_text(encoding="utf-8") != "".join(lines):
                (self.tree / path).write_text("".join(lines), encoding="utf-8")

    def measured(self, kept):
        """(seconds, program, name, mutants) of each test, with no mutant acting; the mutants are those that would
        change a value. self.same are those that would change none in any test, self.ill those that do not compile."""
        programs = test_programs(self.build)
        digest = hashlib.sha256(b"".join(p.read_bytes() for p in programs)).hexdigest()
        if kept.exists() and (known := json.loads(kept.read_text(encoding="utf-8")))["digest"] == digest:
            self.same, self.ill = set(known["same"]), set(known["ill"])
            return [(seconds, program, name, set(mutants)) for seconds, program, name, mutants in known["tests"]]
        tests, self.same, self.ill = [], set(), set()
        for program in programs:
            suite = ""
            listed = subprocess.run([program, "--gtest_list_tests"], check=True, capture_output=True, text=True).stdout
            for line in (line.split("#")[0].rstrip() for line in listed.splitlines()):
                if not line.startswith(" "):
                    suite = line
                else:
                    with tempfile.NamedTemporaryFile() as file:
                        file.write(bytes(len(self.every) + 1))
                        file.flush()
                        name, begin = suite + line.strip(), time.monotonic()
                        if self.fails(str(program), [name], 3600, ROAM_MUTANTS_SEEN=file.name):
                            sys.exit(f"{program.name}: {name} fails as it is")
                        seen = pathlib.Path(file.name).read_bytes()
                    same, different, ill = ({n for n, s in enumerate(seen) if s == what} for what in (1, 2, 3))
                    self.same |= same
                    self.ill |= ill
                    tests.append((time.monotonic() - begin, str(program), name, different))
        tests.sort(key=lambda t: t[:3])
        self.same.difference_update(*(t[3] for t in tests))
        kept.write_text(json.dumps({"digest": digest, "same": sorted(self.same), "ill": sorted(self.ill),
                                    "tests": [(*t[:3], sorted(t[3])) for t in tests]}), encoding="utf-8")
        return tests

    @staticmethod
    def fails(program, names, seconds, **environment):
        """How a program with these tests fails: its first test that does, or in another way. Nothing if all pass."""
        command = ["prlimit", f"--as={MEMORY}", program, "--gtest_brief=1", f"--gtest_filter={':'.join(names)}"]
        try:
            status, said = ended(command, seconds, **environment)
        except Late:
            return ENDLESS
        failed = re.search(r"^\[  FAILED  \] (\S+)", said, re.MULTILINE)
        return "" if status == 0 else failed[1].rstrip(",") if failed else f"status {status}"

    def judge(self, number, seconds):
        """What kills the mutant: "compiler", a test, or how a program ended. Nothing if it survives. None if no test
        computes it outside of a constant expression."""
        if number in self.ill:
            return "compiler"
        tests = [t for t in self.tests if number in t[3]]
        begin, limit, spent = 0, 1.0, 0.0
        while begin < len(tests) and spent + tests[begin][0] <= seconds:
            # Each time those that take thrice as long in all, one process for each program.
            end, total = begin, 0.0
            while end < len(tests) and (end == begin or total + tests[end][0] <= min(limit, seconds - spent)):
                total += tests[end][0]
                end += 1
            for program in sorted({t[1] for t in tests[begin:end]}):
                own = [t for t in tests[begin:end] if t[1] == program]
                longest = 20 * sum(t[0] for t in own) + 10
                if killed_by := self.fails(program, [t[2] for t in own], longest, ROAM_MUTANT=str(number)):
                    return killed_by
            begin, limit, spent = end, 3.0 * limit, spent + total
        return "" if tests or number in self.same else None


class Rebuilt(ChangedTree):
    """Builds a mutant, and runs all tests."""

    def __init__(self, work):
        super().__init__(work / "one", ["-DCMAKE_BUILD_TYPE=Release", "-DROAM_TOOLS=OFF", "-DROAM_UNITY=OFF",
                                        "-DCMAKE_CXX_FLAGS_RELEASE=-O1"], [])
        self.programs = test_programs(self.build)
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
        """What kills the mutant: "compiler", a test program, or that none ends. Nothing if it survives."""
        def change(text):
            lines = text.splitlines(keepends=True)
            replace(lines, line, column, token, replacement)
            return "".join(lines)

        with self.changed(path, change):
            try:
                if not self.compiles():
                    return "compiler"
            except Late:
                return "compiler"  # which computes a constant for ever
            room = pathlib.Path(path).parts[1]
            # The room's own tests first, then from the quickest.
            for program in sorted(self.programs, key=lambda p: (f"test_{room}" not in p.name, self.seconds[p])):
                try:
                    if not ends_well([program], 20 * self.seconds[program] + 60):
                        return program.name
                except Late:
                    return ENDLESS
            return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", metavar="FILE", nargs="*")
    parser.add_argument("--count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=math.inf)
    parser.add_argument("--work", type=pathlib.Path, default=SOURCE / "build-mutants")
    parser.add_argument("--rebuild", action="store_true")
    options = parser.parse_args()
    core = [str(p.relative_to(SOURCE)) for room in ROOMS for p in sorted((SOURCE / "src" / room).iterdir())
            if p.suffix in (".h", ".cpp")]
    # All of them are in the build, whichever are chosen: it stays the same.
    every = [(path, *mutant) for path in core for mutant in mutants_of(path)]
    lines = {path: (SOURCE / path).read_text(encoding="utf-8").splitlines() for path in core}
    named = tuple(f.rstrip("/") + "/" for f in options.files)
    chosen = [n for n, m in enumerate(every, 1) if not named or (m[0] + "/").startswith(named)]
    if options.count is not None:
        chosen = random.Random(options.seed).sample(chosen, min(options.count, len(chosen)))
    # A result holds as long as the mutant's line, and the core's tests.
    listed = subprocess.run(["git", "ls-tree", "HEAD:tests", "math", *ROOMS, "made", "support"], cwd=SOURCE, check=True,
                            capture_output=True).stdout
    digest = hashlib.sha256(listed).hexdigest()[:16]
    key = {n: (path, digest, line, lines[path][line - 1], *rest) for n, (path, line, *rest) in enumerate(every, 1)}
    options.work.mkdir(parents=True, exist_ok=True)
    kept, known = options.work / "results.jsonl", {}
    if kept.exists():
        for row in map(json.loads, kept.read_text(encoding="utf-8").splitlines()):
            if row["killed_by"] != "" or row["seconds"] >= options.seconds:
                known[tuple(row["mutant"])] = row["killed_by"]

    def keep(number, killed_by):
        known[key[number]] = killed_by
        with kept.open("a", encoding="utf-8") as out:
            out.write(json.dumps({"mutant": key[number], "killed_by": killed_by, "seconds": options.seconds}) + "\n")

    # None: it needs a build of its own.
    if coming := [n for n in chosen if key[n] not in known]:
        switched = Switched(options.work, every)
        judge = functools.partial(switched.judge, seconds=options.seconds)
        # In order, so that a stop leaves whole files.
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for done, (number, killed_by) in enumerate(zip(coming, pool.map(judge, coming)), 1):
                keep(number, killed_by)
                if done % 100 == 0:
                    print(f"{done} of {len(coming)} tried", flush=True)
    if options.rebuild and (coming := [n for n in chosen if known[key[n]] is None]):
        rebuilt = Rebuilt(options.work)
        for number in coming:
            keep(number, rebuilt.judge(*every[number - 1]))

    # A line of it is one mutant: another in an equal line of the file may do harm.
    harmless = (SOURCE / "tests/long/mutants.txt").read_text(encoding="utf-8").splitlines()
    table, survived, endless, untried = {}, [], 0, 0
    for number in chosen:
        (path, line, _, token, replacement), killed_by = every[number - 1], known[key[number]]
        untried += killed_by is None
        if killed_by is None or killed_by == "compiler":
            continue
        counts = table.setdefault(path, [0, 0])
        counts[0] += 1
        endless += killed_by == ENDLESS
        if not killed_by:
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
          f"{alive - len(survived)} harmless, {len(survived)} survived; {untried} need a build of their own")
    return 1 if survived else 0


if __name__ == "__main__":
    sys.exit(main())
