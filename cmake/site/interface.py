"""Pages of the public interface, from the comments of the headers and the docstrings of the Python module.

A topic is a page with its C++ headers, its parts of roam.h and its Python classes. A table shows the three languages
side by side. Every public header and class must belong to a topic, and every name of the table must exist.
"""

import ast
import re

# Topic: headers of C++, sections of roam.h, classes of Python.
TOPICS = {
    "Spaces": (
        "roam/math roam/mesh roam/scene_frame roam/error roam/version roam/space roam/world roam/filtered "
        "roam/instances roam/patchwork roam/import roam/store roam/store_build roam/pager roam/generate",
        "versions and errors; spaces", "Space World Store"),
    "Queries": ("roam/sweep roam/collector", "queries; batches", "Sweep Clearance Contacts"),
    "Walking": (
        "roam/walker roam/walker_settings roam/step_report roam/stance roam/standing roam/opening "
        "roam/route roam/path_file roam/wander roam/move_instances", "walkers; routes", "Walker Step Route"),
    "Sizes": (
        "roam/survey roam/probe roam/passage roam/trial roam/train roam/crack roam/profile roam/size_learner",
        "probes, training, profiles", "Survey Probe Training Profile"),
    "OpenSceneGraph": (
        "osgRoam/Manipulator osgRoam/Controls osgRoam/StatusHandler osgRoam/BoxIntersector osgRoam/Harvester "
        "osgRoam/Triangles", "", ""),
}

# What: names of C++, C and Python.
TABLE = [
    ("a world of arrays", "World::build", "roam_world_build", "World.from_arrays"),
    ("a world of files", "import_scene", "roam_world_open", "World.open"),
    ("a scene larger than memory", "Pager", "roam_store_open", "Store.open"),
    ("loads around a body", "Pager::update", "roam_space_load", ""),
    ("without some objects", "Filtered", "roam_filtered_create", "Space.without"),
    ("worlds that come and go", "Patchwork", "", ""),
    ("doors and lifts that move", "Instances", "", ""),
    ("box, counts", "SpaceFacts", "roam_space_get_facts", "Space.bounds"),
    ("name of a triangle's object", "Space::object", "roam_object_name", "Space.object_name"),
    ("first impact of a motion", "Space::sweep", "roam_sweep", "Space.sweep"),
    ("first triangle on a segment", "Space::ray", "roam_ray", "Space.ray"),
    ("gap to the nearest triangle", "Space::clearance", "roam_clearance", "Space.clearance"),
    ("triangles near a body", "Space::contacts", "roam_contacts", "Space.contacts"),
    ("whether a body is free", "Space::fits", "roam_fits", "Space.fits"),
    ("many queries on all cores", "Space::sweep", "roam_sweep_batch", "Space.sweep"),
    ("a body", "Walker", "roam_walker_create", "Walker"),
    ("its size and abilities", "WalkerSettings::person", "roam_walker_person", "Walker.settings"),
    ("one step", "Walker::step", "roam_walker_step", "Walker.step"),
    ("puts a body elsewhere", "Walker::place", "roam_walker_place", "Walker.place"),
    ("walks, flies, passes through walls", "Walker::set_mode", "roam_walker_set_mode", "Walker.mode"),
    ("follows waypoints", "Route", "roam_route_follow", "Walker.follow"),
    ("walks without a path", "Wander", "", ""),
    ("whether a body gets there", "probe", "roam_probe", "Survey.probe"),
    ("sizes that suit a scene", "train", "roam_train", "Survey.train"),
    ("keeps these sizes", "Profile", "roam_profile_load", "Profile.load"),
    ("a camera of OpenSceneGraph", "Manipulator", "", ""),
    ("errors", "Error", "roam_error", ""),
]


def slug(text):
    """The anchor of a heading."""
    return re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")


def prose(lines):
    """Text of a comment as Markdown: lines with four blanks more are code, and signs are no markup."""
    result, code = [], False
    for line in lines:
        if re.match(r"    +\S", line) and (code or not result or not result[-1].strip()):
            code = True
        elif line.strip():
            code = False
        result.append(line if code else re.sub(r"([<>*\\])", r"\\\1", line).rstrip())
        if not code and re.match(r"\s*- ", line) and len(result) > 1 and not re.match(r"\s*- |\s*$", result[-2]):
            result.insert(-1, "")
    return "\n".join(result).strip("\n")


def comment_text(lines):
    """The text of `///` lines or of a `/** */` comment."""
    text = [re.sub(r"^\s*(///? ?|/\*\*? ?| \* ?)", "", line) for line in lines]
    return prose([re.sub(r"\s*\*/$", "", line) for line in text if not line.strip().startswith(r"\file")])


def chunks(lines):
    """The declarations at the left margin, each with the comment above: (comment lines, code lines)."""
    comment, code, depth = [], [], 0
    for line in [*lines, ""]:
        if depth == 0 and not line.strip():
            if code:
                yield comment, code
            comment, code = [], []
        elif depth == 0 and not code and re.match(r"//|/\*| \*", line):
            comment.append(line)
        else:
            if depth == 0 and code and re.match(r"///|/\*\*", line):  # the next one follows without a blank line
                yield comment, code
                comment, code = [line], []
                continue
            code.append(line)
            bare = re.sub(r"//.*|/\*.*?\*/|'[^']*'|\"[^\"]*\"", "", line)
            depth += bare.count("{") + bare.count("(") - bare.count("}") - bare.count(")")


def names_of(code):
    """Names that a chunk declares."""
    names = []
    for line in code:
        found = (re.match(r"(?:typedef )?(?:class|struct|enum(?: class)?|union) (?:\w+\()?(\w+)\b(?!;)", line) or
                 re.match(r"using (\w+)|#define (\w+)", line) or re.match(r"inline constexpr [\w:<>]+ (\w+)", line) or
                 re.match(r"(?:\[\[\w+\]\] )?[A-Za-z][\w:<>&*,\s]*?[\s&*](\w+)\(", line) or
                 re.match(r"enum \{ *(\w+)|  (ROAM_\w+),", line) or re.match(r"typedef .*?(\w+);", line))
        if found and line[0] != " " or (found and not names):
            names.append(next(name for name in found.groups() if name))
    return list(dict.fromkeys(name for name in names if name != "ROAM_API"))


def declarations(lines, language):
    """Sections of Markdown, one a chunk, and the text of the code under each heading."""
    text, seen = [], {}
    for comment, code in chunks(lines):
        if all(re.match(r"(class|struct) [\w:]+;|#|namespace|extern|\}|template <>|$", line) for line in code) \
                and not any(line.startswith("#define ROAM_") and len(line.split()) > 2 for line in code):
            continue
        private = next((i for i, line in enumerate(code) if line.strip() in ("private:", "protected:")), None)
        if private is not None:
            code = [*code[:private], "};"]
        code = [line.replace("ROAM_API ", "") for line in code]
        names = names_of(code)
        if not names:
            continue
        heading = ", ".join(names[:3]) + (", ..." if len(names) > 3 else "")
        text += [f"#### {heading} {{#{language}-{slug(heading)}}}", "", comment_text(comment), "",
                 f"```{language}", *code, "```", ""]
        seen[heading] = "\n".join([*code, " ".join(names)])
    return text, seen


def cpp_header(source, name):
    lines = (source / "include" / f"{name}.h").read_text(encoding="utf-8").splitlines()
    start = next(i for i, line in enumerate(lines) if r"\file" in line)
    end = next(i for i in range(start, len(lines)) if not lines[i].startswith("///"))
    begin = next((i for i, line in enumerate(lines) if line.startswith("namespace")), end)
    text, seen = declarations(lines[begin + 1:], "cpp")
    return [f"### {name}.h {{#{slug(name)}}}", "", comment_text(lines[start:end]), "", *text], seen


def c_sections(source):
    """Of roam.h: what comes first, and the lines of each section."""
    lines = (source / "include/roam/roam.h").read_text(encoding="utf-8").splitlines()
    end = next(i for i, line in enumerate(lines) if line == " */")
    sections, name = {}, None
    for line in lines[end + 1:]:
        rule = re.match(r"/\* -+ ([^-]+) --- \*/", line)
        if rule:
            name = rule[1]
            sections[name] = []
        elif name and not line.startswith(("#ifdef", "#endif", "}  ")):
            sections[name].append(line)
    return comment_text(lines[2:end]), sections


def python_classes(source):
    """Class: its page's text, and the names of its members."""
    result = {}
    for path in sorted((source / "python/roam").glob("*.py")):
        code = path.read_text(encoding="utf-8")
        lines = code.splitlines()
        for node in ast.parse(code).body:
            if not isinstance(node, ast.ClassDef):
                continue
            members, shown = [node.name], []
            for item in node.body:
                if isinstance(item, ast.AnnAssign):
                    members.append(item.target.id)
                    shown.append(lines[item.lineno - 1][4:])
                elif isinstance(item, ast.FunctionDef) and (item.name == "__init__" or item.name[0] != "_"):
                    members.append(item.name)
                    first = min([item.lineno, *(each.lineno for each in item.decorator_list)]) - 1
                    string = ast.get_docstring(item) is not None
                    last = item.body[0].end_lineno if string else item.body[0].lineno - 1
                    shown += ["", *(line[4:] for line in lines[first:last])]
            bases = f"({', '.join(ast.unparse(base) for base in node.bases)})" if node.bases else ""
            text = [f"### {node.name}{bases} {{#python-{slug(node.name)}}}", "",
                    prose((ast.get_docstring(node) or "").splitlines()), "",
                    "```python", "\n".join(shown).strip("\n"), "```", ""]
            result[node.name] = text, members
    return result


def pages(source):
    """Pages by name, their names and titles in order, and (page, anchor) of each header."""
    introduction, sections = c_sections(source)
    check(source, sections)
    classes = python_classes(source)
    texts, titles, headers, places = {}, [], {}, {"cpp": [], "c": [], "python": []}
    for topic, (cpp, c, python) in TOPICS.items():
        page = f"api/{slug(topic)}.md"
        text = [f"# {topic}", ""]
        if c:
            text += ["In [C++](#cpp), [C](#c) and [Python](#python).", ""]
        text += ["## In C++ {#cpp}", ""]
        for name in cpp.split():
            part, seen = cpp_header(source, name)
            text += part
            headers[f"include/{name}.h"] = page, slug(name)
            places["cpp"] += [(page, heading, code) for heading, code in seen.items()]
        if c:
            text += ["## In C {#c}", ""]
            if topic == "Spaces":
                text += ["### roam/roam.h {#roam-h}", "", introduction, ""]
                headers["include/roam/roam.h"] = page, "roam-h"
            for name in c.split("; "):
                part, seen = declarations(sections[name], "c")
                text += [f"### {name.capitalize()}", "", *part]
                places["c"] += [(page, heading, code) for heading, code in seen.items()]
            text += ["## In Python {#python}", ""]
            for name in python.split():
                part, members = classes[name]
                text += part
                places["python"] += [(page, name, member) for member in [name, *(f"{name}.{m}" for m in members)]]
        texts[page] = "\n".join(text)
        titles.append((page, topic))
    texts["api/index.md"] = side_by_side(places)
    return texts, titles, headers


def check(source, sections):
    """Whether the topics have all headers, sections and classes, and no others."""
    public = {f"{path.parent.name}/{path.stem}" for path in (source / "include").glob("*/*.h")} - {"roam/roam"}
    module = (source / "python/roam/__init__.py").read_text(encoding="utf-8")
    named = re.findall(r'"(\w+)"', module.split("__all__")[1])
    cpp, c, python = zip(*TOPICS.values())
    for what, there, listed in (("headers", public, " ".join(cpp).split()),
                                ("classes", named, " ".join(python).split()),
                                ("sections of roam.h", sections, "; ".join(filter(None, c)).split("; "))):
        if set(there) != set(listed):
            raise SystemExit(f"{__file__}: TOPICS and the {what} differ in {', '.join(set(there) ^ set(listed))}")


def side_by_side(places):
    """The table: each name leads to its declaration."""
    def cell(language, name):
        if not name:
            return ""
        owner, _, member = name.partition("::")
        for page, heading, code in places[language]:
            if language == "python":
                found = code == name
            elif language == "c":
                found = re.search(rf"\b{name}\(", code)
            else:
                found = owner in heading.split(", ") and (not member or re.search(rf"\b{member}\(", code))
            if found:
                return f"[`{name}`]({page.removeprefix('api/')}#{language}-{slug(heading)})"
        raise SystemExit(f"{__file__}: TABLE has {name}, which is not declared")

    rows = [f"| {what} | {cell('cpp', cpp)} | {cell('c', c)} | {cell('python', python)} |"
            for what, cpp, c, python in TABLE]
    return "\n".join(["# C++, C and Python side by side", "", "| | C++ | C | Python |", "|---|---|---|---|", *rows, ""])
