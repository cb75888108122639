#!/usr/bin/env python3
"""make.py SOURCE STAGE SITE: makes the web site SITE of a source tree, with MkDocs, from files staged in STAGE.

Pages are the documents as they are in the tree, the examples, and the interface of C++, C and Python (interface.py).
Links between them stay, and links to headers and examples lead to their pages. Fails for every warning of MkDocs.
"""

import os
import pathlib
import posixpath
import re
import shutil
import subprocess
import sys

import interface

# The documents in the order of reading: README.md, "What to read next".
NAVIGATION = {
    "Look around": ["viewing", "importing", "stores", "cluster", "serving", "pictures", "installing"],
    "What fits": ["probing", "training", "cracks", "profile"],
    "Write a program": ["python", "coming_from", "walking", "json", "architecture", "dependencies", "compatibility"],
    "Trust it": ["guarantees", "algorithm", "proofs", "benchmarks", "format", "paper"],
}
# Documents beside README.md, and the sections that they end.
OTHERS = {"SECURITY.md": "Trust it", "tests/long/results.md": "Trust it", "CONTRIBUTING.md": "Change it",
          "CHANGELOG.md": "Change it"}

CONFIGURATION = """
site_name: roam
docs_dir: {stage}
site_dir: {site}
use_directory_urls: false  # pages also open as files
theme:
  name: material
  font: false  # nothing is fetched from other sites
  features: [navigation.sections, navigation.top]
plugins: [search]
extra_css: [site.css]
markdown_extensions:
  - tables
  - fenced_code
  - sane_lists
  - attr_list
  - pymdownx.highlight
  - pymdownx.superfences
  - toc: {{permalink: true, slugify: !!python/object/apply:pymdownx.slugs.slugify {{kwds: {{case: lower}}}}}}
nav:
{nav}
"""

# Room for the headers' lines of 120 columns.
STYLE = """
.md-grid { max-width: 82rem; }
.md-typeset pre > code { font-size: 0.6rem; }
.md-typeset table:not([class]) code { white-space: nowrap; }
"""

LANGUAGES = {".cpp": "cpp", ".h": "cpp", ".c": "c", ".cs": "csharp", ".py": "python", ".txt": "cmake"}


def title(path):
    return re.search(r"^# (.*)", path.read_text(encoding="utf-8"), re.M).group(1).replace("`", "")


class Site:
    def __init__(self, source, stage):
        self.source, self.stage = source, stage
        self.headers = {}  # include/roam/world.h: page and anchor

    def write(self, name, text):
        path = self.stage / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def target(self, page, link):
        """Where a link of a document leads on the site."""
        path, _, anchor = link.partition("#")
        if not path or re.match(r"[a-z]+:", path):
            return link
        wanted = posixpath.normpath(posixpath.join(posixpath.dirname(page), path))
        if wanted in self.headers:
            wanted, anchor = self.headers[wanted]
        elif wanted == "include/roam":
            wanted = "api/index.md"
        elif wanted == "examples":
            wanted = "examples/index.md"
        elif wanted.startswith("examples/python/"):
            wanted, anchor = "examples/python.md", interface.slug(posixpath.basename(wanted))
        elif wanted.startswith("examples/"):
            wanted += ".md"
        elif not wanted.endswith(".md"):
            # A picture, or a file that is not a page: as it is.
            (self.stage / wanted).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(self.source / wanted, self.stage / wanted)
        return posixpath.relpath(wanted, posixpath.dirname(page) or ".") + ("#" + anchor if anchor else "")

    def document(self, name):
        """Stages a document. GitHub needs no empty line before a list or table, and less indentation in lists."""
        lines, fence, before = [], False, ""
        for line in (self.source / name).read_text(encoding="utf-8").splitlines():
            fence ^= line.lstrip().startswith("```")
            if not fence and not line.startswith("    "):
                kind = re.match(r"\s*([-*]|\d+\.) |\|", line)
                if kind and before.strip() and not re.match(r"\s*([-*]|\d+\.) |\||\s", before):
                    lines.append("")
                line = re.sub(r"(\]\()([^) ]+)", lambda m: m[1] + self.target(name, m[2]), line)
                line = re.sub(r'((?:src|href)=")([^"]+)', lambda m: m[1] + self.target(name, m[2]), line)
                line = re.sub(r"^( {2,3})(?=\S)", "    ", line)
            lines.append(line)
            before = line
        self.write(name, "\n".join(lines) + "\n")

    def examples(self):
        """A page for each example, with its files."""
        folders = sorted(path for path in (self.source / "examples").iterdir() if path.is_dir())
        index = ["# Examples", ""]
        for folder in folders:
            text = [f"# {folder.name}", ""]
            for file in sorted(folder.iterdir(), key=lambda file: (file.suffix == ".txt", file.name)):
                code = file.read_text(encoding="utf-8")
                text += [f"## {file.name}", "", f"```{LANGUAGES[file.suffix]}", code.rstrip(), "```", ""]
            self.write(f"examples/{folder.name}.md", "\n".join(text))
            index.append(f"- [{folder.name}]({folder.name}.md)")
        self.write("examples/index.md", "\n".join(index) + "\n")
        return [folder.name for folder in folders]


def navigation(site, topics, examples):
    lines = ["  - roam: README.md"]
    for section in [*NAVIGATION, "Change it"]:
        lines.append(f"  - {section}:")
        names = [f"docs/{name}.md" for name in NAVIGATION.get(section, [])]
        names += [name for name, ends in OTHERS.items() if ends == section]
        lines += [f"    - \"{title(site.source / name)}\": {name}" for name in names]
        if section == "Write a program":
            lines += ["    - Examples:", "      - All: examples/index.md"]
            lines += [f"      - {name}: examples/{name}.md" for name in examples]
            lines += ["  - C++, C and Python:", "    - Side by side: api/index.md"]
            lines += [f"    - '{name}': {page}" for page, name in topics]
    return "\n".join(lines)


def main():
    source, stage, target = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    if not shutil.which("mkdocs"):
        sys.exit("The site needs Debian's mkdocs and mkdocs-material: apt-get install mkdocs mkdocs-material")
    shutil.rmtree(stage, ignore_errors=True)
    stage.mkdir(parents=True)
    site = Site(source, stage)
    pages, topics, site.headers = interface.pages(source)
    for name, text in pages.items():
        site.write(name, text)
    examples = site.examples()

    documents = {f"docs/{path.name}" for path in (source / "docs").glob("*.md")}
    listed = {f"docs/{name}.md" for names in NAVIGATION.values() for name in names}
    if documents != listed:
        sys.exit(f"{__file__}: NAVIGATION and docs differ in {', '.join(sorted(documents ^ listed))}")
    for name in ["README.md", *OTHERS, *sorted(documents)]:
        site.document(name)

    site.write("site.css", STYLE)
    configuration = stage.with_suffix(".yml")
    configuration.write_text(CONFIGURATION.format(stage=stage, site=target, nav=navigation(site, topics, examples)),
                             encoding="utf-8")
    sys.exit(subprocess.run(["mkdocs", "build", "--strict", "--quiet", "--clean", "--config-file", configuration],
                            check=False).returncode)


main()
