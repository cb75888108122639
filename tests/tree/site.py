#!/usr/bin/env python3
"""site.py SOURCE WORK         builds the web site of SOURCE in WORK and fails for each link that leads nowhere
site.py SOURCE WORK FAULTS  plants such links and fails where they are not found
"""

import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """The links and anchors of a page."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        named = dict(attrs)
        self.links += [named[name] for name in ("href", "src") if named.get(name)]
        self.anchors |= {named[name] for name in ("id", "name") if named.get(name)}


def faults(site):
    """Links to files and anchors that are not there, and files from other hosts that a page would load."""
    pages = {path.resolve(): Page(path) for path in sorted(site.rglob("*.html")) if path.name != "404.html"}
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if not target.is_file():
                yield f"{path.relative_to(site)}: {link}: there is no such file"
            elif parts.fragment and target in pages and parts.fragment not in pages[target].anchors:
                yield f"{path.relative_to(site)}: {link}: there is no such anchor"
    if not pages:
        yield "there are no pages"


def planted(work):
    good = '<h1 id="top">x</h1> <a href="#top"></a> <a href="deep/b.html#b"></a> <a href="https://a.b/c"></a>'
    (work / "deep").mkdir(parents=True)
    (work / "deep/b.html").write_text('<p id="b"><a href="../a.html"></a><img src="../c.png"></p>', encoding="utf-8")
    (work / "c.png").touch()
    (work / "a.html").write_text(good, encoding="utf-8")
    assert list(faults(work)) == []
    for wrong in ('<a href="#gone">', '<a href="deep/b.html#gone">', '<a href="gone.html">', '<img src="gone.png">',
                  '<script src="gone.js">'):
        (work / "a.html").write_text(good + wrong, encoding="utf-8")
        assert len(list(faults(work))) == 1, wrong
    print("finds links that lead nowhere")


def has_mkdocs():
    try:
        from mkdocs.utils import get_theme_names
    except ImportError:
        return False
    return "material" in get_theme_names()


def main():
    source, work = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    shutil.rmtree(work, ignore_errors=True)
    if len(sys.argv) > 3:
        return planted(work)
    if not has_mkdocs():
        print("there is no mkdocs or mkdocs-material: not run")
        sys.exit(77)
    subprocess.run([sys.executable, "-B", source / "cmake/site/make.py", source, work / "stage", work / "site"],
                   check=True)
    site = work / "site"
    found = list(faults(site))
    print(*found, sep="\n")
    # It is a site, and not only files: its first page, a picture, what the search finds, all three languages.
    text = (site / "index.html").read_text(encoding="utf-8")
    assert 'name="query"' in text and 'src="docs/' in text
    index = (site / "search/search_index.json").read_text(encoding="utf-8")
    for words in ("roam_sweep_batch", "first_impact", "Where nothing is found, the gap is the reach", "certified"):
        assert words in index, words
    # Names that are said to be ours are in a header.
    headers = " ".join(path.read_text(encoding="utf-8") for path in source.glob("include/*/*.h"))
    for row in (source / "docs/coming_from.md").read_text(encoding="utf-8").splitlines():
        for name in re.findall(r"\w+(?=[`:])", row.split("|")[2] if row.startswith("| ") else ""):
            assert re.search(rf"\b{name}\b", headers), f"docs/coming_from.md: no header has {name}"
    sys.exit(1 if found else 0)


main()
