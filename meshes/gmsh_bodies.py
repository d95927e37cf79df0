"""Puts bodies that were meshed in gmsh models of their own into one model.

In one model gmsh takes coinciding curves and surfaces of two bodies for the
same ones sooner or later. Apart, each body also has a size field of its own.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import gmsh
import numpy as np

# gmsh's types of first order.
TRIANGLE, PRISM = 2, 6


@dataclass
class Body:
    """Elements by type, and by surface name and type; nodes count from 1."""

    points: np.ndarray
    volume: list[tuple[int, np.ndarray]]
    surfaces: dict[str, list[tuple[int, np.ndarray]]] = \
        field(default_factory=dict)


def extract(volumes: list[int], surfaces: dict[str, list[int]]) -> Body:
    """Copies entities of the current model, and the nodes which they use."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    tags = np.asarray(tags, dtype=np.int64)

    def elements(dim: int, entities: list[int]) -> list:
        found: dict[int, list[np.ndarray]] = {}
        for entity in entities:
            types, _, nodes = gmsh.model.mesh.getElements(dim, entity)
            for element_type, corners in zip(types, nodes):
                found.setdefault(int(element_type), []).append(
                    np.asarray(corners, dtype=np.int64))
        return [(t, np.concatenate(parts)) for t, parts in found.items()]

    volume = elements(3, volumes)
    boundary = {name: elements(2, these) for name, these in surfaces.items()}
    used = np.unique(np.concatenate([nodes for _, nodes in volume]))
    new = np.zeros(tags.max() + 1, dtype=np.int64)
    new[used] = np.arange(1, len(used) + 1)
    row = np.empty(tags.max() + 1, dtype=np.int64)
    row[tags] = np.arange(len(tags))
    return Body(np.asarray(coordinates).reshape(-1, 3)[row[used]],
                [(t, new[nodes]) for t, nodes in volume],
                {name: [(t, new[nodes]) for t, nodes in parts]
                 for name, parts in boundary.items()})


def assemble(name: str, bodies: dict[str, Body], regions: dict[str, int],
             surfaces: dict[str, int]) -> None:
    """Makes a model with these physical groups, a volume for each body."""
    gmsh.model.add(name)
    entity = node = element = 0
    members: dict[str, list[int]] = {surface: [] for surface in surfaces}

    def add(dim: int, tag: int, parts: list) -> None:
        nonlocal element
        for element_type, nodes in parts:
            count = len(nodes) // gmsh.model.mesh.getElementProperties(
                element_type)[3]
            gmsh.model.mesh.addElementsByType(
                tag, element_type,
                np.arange(element + 1, element + count + 1), nodes + node)
            element += count

    for region, body in bodies.items():
        volume = gmsh.model.addDiscreteEntity(3, regions[region])
        gmsh.model.mesh.addNodes(
            3, volume, np.arange(node + 1, node + len(body.points) + 1),
            body.points.ravel())
        for surface, parts in body.surfaces.items():
            entity += 1
            gmsh.model.addDiscreteEntity(2, entity)
            add(2, entity, parts)
            members[surface].append(entity)
        add(3, volume, body.volume)
        gmsh.model.addPhysicalGroup(3, [volume], regions[region])
        gmsh.model.setPhysicalName(3, regions[region], region)
        node += len(body.points)
    for surface, entities in members.items():
        gmsh.model.addPhysicalGroup(2, entities, surfaces[surface])
        gmsh.model.setPhysicalName(2, surfaces[surface], surface)
