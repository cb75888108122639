"""A copy of this tree whose sources are changed, built and tested."""

import contextlib
import os
import pathlib
import signal
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
COMPILE_SECONDS = 7200


class Late(Exception):
    """A command that did not end in time, which proves nothing."""


def ended(command, seconds, **environment):
    """The status of a command, and what it printed. If it does not end in time, ends it and all that it started, and
    raises Late."""
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as output, \
            subprocess.Popen(command, stdout=output, stderr=subprocess.DEVNULL, start_new_session=True,
                             env={**os.environ, "GTEST_FAIL_FAST": "1", **environment}) as process:
        try:
            status = process.wait(seconds)
            output.seek(0)
            return status, output.read()
        except subprocess.TimeoutExpired as error:
            raise Late from error
        finally:
            if process.returncode is None:
                os.killpg(process.pid, signal.SIGKILL)


def ends_well(command, seconds):
    """Whether a command ends with status 0; else as above."""
    return ended(command, seconds)[0] == 0


def listed_files():
    """Those of git, and new ones that it does not ignore."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=SOURCE,
                            check=True, capture_output=True, text=True).stdout
    return [path for path in listed.split("\0") if (SOURCE / path).is_file()]


class ChangedTree:
    def __init__(self, work, options, targets):
        """Copies into the folder `work`, and builds the targets (none: all) with these options of cmake."""
        # Inside of the tree, so that paths relative to it are those of other builds, for the compiler's cache.
        self.tree, self.build, self.targets = work / "tree", work / "tree/build", targets
        self.tree.mkdir(parents=True, exist_ok=True)
        wanted = set(listed_files())
        for old in self.tree.rglob("*"):
            if old.is_file() and self.build not in old.parents and str(old.relative_to(self.tree)) not in wanted:
                old.unlink()
        for path in wanted:
            # Only what differs, and with a new time: an earlier change may have been built from it.
            content, file = (SOURCE / path).read_bytes(), self.tree / path
            if not file.is_file() or file.read_bytes() != content:
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(content)
                file.chmod((SOURCE / path).stat().st_mode)
        subprocess.run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", *options], check=True,
                       stdout=subprocess.DEVNULL)
        try:
            if not self.compiles():
                sys.exit("the tree does not compile as it is")
        except Late:
            sys.exit(f"the tree does not compile in {COMPILE_SECONDS // 3600} hours")

    def compiles(self, targets=None):
        chosen = targets or self.targets
        return ends_well(["cmake", "--build", self.build, *(["--target", *chosen] if chosen else [])], COMPILE_SECONDS)

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
