#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails on an #include between folders that the table of docs/architecture.md does not allow, and on any cycle of folders.

usage: check_layering.py ROOT
"""

import pathlib
import re
import sys

ALLOWED = {
    "core": set(),
    "registration": {"core"},
    "semantic": {"core"},
    "mapping": {"core", "registration"},
    "recognition": {"core", "registration"},
    "tracking": {"core", "semantic", "registration", "mapping", "recognition"},
    "navigation": {"core", "semantic", "mapping"},
    "tools": {"core", "registration", "semantic", "mapping", "recognition", "tracking", "navigation"},
}
EVERYTHING = {"tests", "bench", "fuzz"}  # may include all of the above and themselves
TOP_FOLDERS = set(ALLOWED) | EVERYTHING
SOURCE_SUFFIXES = {".h", ".cpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]')


def includes_of(source):
    """(line, path) of each include of one of our own files."""
    for number, line in enumerate(source.read_text(encoding="utf-8").splitlines(), start=1):
        match = INCLUDE.match(line)
        if match and match.group(1).split("/")[0] in TOP_FOLDERS:
            yield number, pathlib.PurePosixPath(match.group(1))


def sources_of(root):
    for folder in sorted(TOP_FOLDERS):
        for source in sorted((root / folder).rglob("*")):
            if source.suffix in SOURCE_SUFFIXES:
                yield source.relative_to(root)


def layer_problem(folder, included):
    if folder in EVERYTHING or included == folder or included in ALLOWED[folder]:
        return None
    return f"'{folder}' must not include '{included}'"


def find_cycle(edges):
    """The folders of one cycle, its first folder repeated at the end; None if there is none. Depth first, in order of names."""
    finished, path = set(), []

    def visit(folder):
        if folder in path:
            return path[path.index(folder) :] + [folder]
        if folder in finished:
            return None
        path.append(folder)
        for included in sorted(edges.get(folder, ())):
            cycle = visit(included)
            if cycle:
                return cycle
        path.pop()
        finished.add(folder)
        return None

    for folder in sorted(edges):
        cycle = visit(folder)
        if cycle:
            return cycle
    return None


def check(root):
    problems, edges, example = [], {}, {}
    for source in sources_of(root):
        for line, included in includes_of(root / source):
            problem = layer_problem(source.parts[0], included.parts[0])
            if problem:
                problems.append(f"{source}:{line}: {problem} ({included})")
            if not (root / included).is_file() and included.parts[0] not in EVERYTHING:
                problems.append(f"{source}:{line}: there is no file '{included}'; include from the repository's root")
            here, there = str(source.parent), str(included.parent)
            if here != there:
                edges.setdefault(here, set()).add(there)
                example.setdefault((here, there), f"{source}:{line}")
    cycle = find_cycle(edges)
    if cycle:
        steps = [f"{example[step]} includes {step[1]}" for step in zip(cycle, cycle[1:])]
        problems.append("folders include each other in a circle: " + "; ".join(steps))
    return problems


def main():
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1]).is_dir():
        print(__doc__, file=sys.stderr)
        return 2
    problems = check(pathlib.Path(sys.argv[1]))
    for problem in problems:
        print(problem)
    print(f"layering: {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
