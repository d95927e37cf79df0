"""Nodes of a model of FEBio, format 4.0, that its conditions name."""

from __future__ import annotations

import pathlib
import xml.etree.ElementTree as ElementTree

Element = ElementTree.Element


def numbers(text: str | None) -> list[int]:
    return [int(word) for word in (text or "").replace(",", " ").split()]


def nodes_below(element: Element) -> set[int]:
    """Of a set of nodes, or of the facets of a surface."""
    found = set(numbers(element.text))
    for child in element:
        found |= nodes_below(child)
    return found


def displacement_nodes(model: pathlib.Path) -> dict[str, set[int]]:
    """The nodes that each condition of the displacement holds, by its name."""
    root = ElementTree.parse(model).getroot()
    sets = {}
    for kind, prefix in ("NodeSet", ""), ("Surface", "@surface:"):
        for entry in root.iterfind(f"Mesh/{kind}"):
            sets[prefix + entry.get("name", "")] = nodes_below(entry)
    return {bc.get("name", ""): sets[bc.get("node_set", "")]
            for bc in root.iterfind("Boundary/bc")
            if bc.get("type", "").endswith("displacement")}
