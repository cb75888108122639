"""A copy of this tree whose sources are changed, built and tested."""

import contextlib
import os
import pathlib
import shutil
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def ends_well(command, seconds):
    """Whether a command ends with status 0 in time."""
    try:
        return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=seconds, check=False,
                              env={**os.environ, "GTEST_FAIL_FAST": "1"}).returncode == 0
    except subprocess.TimeoutExpired:
        return False


class ChangedTree:
    def __init__(self, work, options, targets):
        """Copies into the folder `work`, and builds the targets (none: all) with these options of cmake."""
        # Inside of the tree, so that paths relative to it are those of other builds, for the compiler's cache.
        self.tree, self.build, self.targets = work / "tree", work / "tree/build", targets
        self.tree.mkdir(parents=True, exist_ok=True)
        for old in self.tree.iterdir():
            if old.is_dir() and old != self.build:
                shutil.rmtree(old)
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=SOURCE, check=True, capture_output=True, text=True).stdout
        for path in filter(None, listed.split("\0")):
            (self.tree / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(SOURCE / path, self.tree / path)
        subprocess.run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", *options], check=True,
                       stdout=subprocess.DEVNULL)
        if not self.compiles():
            sys.exit("the tree does not compile as it is")

    def compiles(self, targets=None):
        chosen = targets or self.targets
        return ends_well(["cmake", "--build", self.build, *(["--target", *chosen] if chosen else [])], 7200)

    @contextlib.contextmanager
    def changed(self, path, change):
        """The file with another text, until the end of the block."""
        file = self.tree / path
        original = file.read_text(encoding="utf-8")
        file.write_text(change(original), encoding="utf-8")
        try:
            yield
        finally:
            file.write_text(original, encoding="utf-8")
