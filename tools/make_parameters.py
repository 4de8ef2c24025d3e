#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/parameters.md: every parameter with its default, and what its option struct says of it.

usage: make_parameters.py [--check] [--program build/release/src/regolith/config/regolith_print_defaults]

Defaults come from the program; units and meaning from the comments of the structs; which key is which member from the
`Fields` functions of src/regolith/config. With --check it writes nothing and fails where the page is not current.
"""

import argparse
import pathlib
import re
import subprocess
import sys

import yaml

ROOT = pathlib.Path(__file__).parent.parent
PAGE = ROOT / "docs" / "parameters.md"
STRUCT = re.compile(r"^struct (\w+) \{$(.*?)^\};$", re.MULTILINE | re.DOTALL)
FIELDS = re.compile(r"^void Fields\(Archive& archive, (\w+)& (\w+)\) \{$(.*?)^\}$", re.MULTILINE | re.DOTALL)
ENTRY = re.compile(r'archive\("(\w+)",\s*(\w+)\.(\w+)\)')
MEMBER = re.compile(r"^  ((?:const )?[\w:<>, ]+?) (\w+)(?:\s*=\s*[^;]*|\{[^;]*\})?;\s*(?:///<\s*(.*))?$")
SECTIONS = (
    ("SlamNodeOptions", "regolith_node", "/",
     "Private parameters of the node, and `settings`: a map laid over the pipeline's settings (below)."),
    ("SimNodeOptions", "regolith_sim_node", "/",
     "Private parameters of the node, and `settings`: a map laid over the scenario's settings (below)."),
    ("PipelineOptions", "Settings of a pipeline", ".",
     "For `regolith run --set KEY=VALUE`, `--config FILE`, files in `config/pipelines`, and the node's `settings`. "
     "Those files change some of these defaults."),
    ("ScenarioOptions", "Settings of a scenario", ".",
     "For `regolith simulate --config FILE`, files in `config/scenarios`, and the simulator node's `settings`. Those "
     "files change many of these defaults."),
)


class Member:
    def __init__(self, kind, text):
        self.kind = kind.split("::")[-1]
        self.text = text


def parse_struct(body):
    """Members by name: type and comment, in front (///) or behind (///<), over several lines."""
    members = {}
    before = []  # lines of a comment in front
    group = ""  # what stands in front of several members
    last = None
    lines = re.sub(r"=\n\s+", "= ", body).splitlines()
    for line in lines:
        stripped = line.strip()
        match = MEMBER.match(line)
        if match:
            group = " ".join(before) if before else group
            own = match.group(3) or ""
            last = Member(match.group(1), " ".join(before + [own]).strip() or group)
            members[match.group(2)] = last
            before = []
        elif stripped.startswith("///<") and last:
            last.text = (last.text + " " + stripped[4:].strip()).strip()
        elif stripped.startswith("///"):
            before.append(stripped[3:].strip())
        elif not stripped:
            before, group = [], ""
    return members


def read_sources():
    structs, keys = {}, {}
    for path in sorted((ROOT / "src" / "regolith").rglob("*.h")):
        for name, body in STRUCT.findall(path.read_text(encoding="utf-8")):
            structs.setdefault(name, parse_struct(body))
    for path in sorted((ROOT / "src" / "regolith" / "config").iterdir()):
        if path.suffix in (".h", ".cc") and not path.stem.endswith("_test"):
            for name, _, body in FIELDS.findall(path.read_text(encoding="utf-8")):
                keys.setdefault(name, {}).update({key: member for key, _, member in ENTRY.findall(body)})
    return structs, keys


def shown(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"' if value else "empty"
    if isinstance(value, float):
        return f"{value:g}"
    return str(value)


def rows(struct, values, separator, sources, prefix=""):
    structs, keys = sources
    members = structs.get(struct, {})
    for key, value in values.items():
        member = members.get(keys.get(struct, {}).get(key, key))
        path = prefix + key
        if isinstance(value, dict) and member and member.kind in structs:
            yield from rows(member.kind, value, separator, sources, path + separator)
        else:
            yield path, shown(value), (member.text if member else "").replace("|", "\\|")


def make_page(program):
    output = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    documents = list(yaml.safe_load_all(output))
    sources = read_sources()
    lines = ["# Parameters", "", "Made by `tools/make_parameters.py` from the option structs; a test keeps it current. "
             "Units stand in the text; what has none is a plain number, a switch or a name.", ""]
    for (struct, title, separator, text), document in zip(SECTIONS, documents, strict=True):
        lines += [f"## {title}", "", text, "", "| parameter | default | meaning |", "|---|---|---|"]
        lines += [f"| `{path}` | {value} | {meaning} |" for path, value, meaning in
                  rows(struct, document, separator, sources)]
        lines.append("")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--program", default=ROOT / "build/release/src/regolith/config/regolith_print_defaults")
    arguments = parser.parse_args()
    page = make_page(arguments.program)
    if not arguments.check:
        PAGE.write_text(page, encoding="utf-8")
        print(f"{PAGE} written")
        return 0
    if PAGE.exists() and PAGE.read_text(encoding="utf-8") == page:
        return 0
    print(f"{PAGE} is not current; run tools/make_parameters.py")
    return 1


if __name__ == "__main__":
    sys.exit(main())
