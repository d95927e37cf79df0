"""Models of FEBio for tests: columns of hexahedra along z."""

from __future__ import annotations

from dataclasses import dataclass, field


def block(first: int, bottom: float, top: float, layers: int):
    """Nodes and elements of a column of unit section, numbered from first."""
    nodes, elements = [], []
    for i in range(layers + 1):
        z = bottom + (top - bottom) * i / layers
        for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
            nodes.append((first + len(nodes), (x, y, z)))
    for i in range(layers):
        a = first + 4 * i
        elements.append([a, a + 1, a + 2, a + 3, a + 4, a + 5, a + 6, a + 7])
    return nodes, elements


def text_of(numbers) -> str:
    return ",".join(map(str, numbers))


@dataclass
class FebColumn:
    """A column of height 1 on a support, drained at its top unless said."""

    layers: int = 10
    steps: int = 10
    step: float = 1.0
    stepper: str = ""
    solid: str = ('<solid type="neo-Hookean"><density>1</density><E>1</E>'
                  "<v>0</v></solid>")
    permeability: str = ('<permeability type="perm-const-iso">'
                         "<perm>0.001</perm></permeability>")
    materials: str = ""
    drained: str = "top_nodes"
    boundary: str = ""
    sections: str = ""
    curves: list[str] = field(default_factory=list)

    def top(self) -> list[int]:
        return [4 * self.layers + i for i in (1, 2, 3, 4)]

    def text(self) -> str:
        nodes, elements = block(1, 0.0, 1.0, self.layers)
        node_lines = "\n".join(
            f'<node id="{n}">{text_of(x)}</node>' for n, x in nodes)
        element_lines = "\n".join(
            f'<elem id="{i}">{text_of(e)}</elem>'
            for i, e in enumerate(elements, 1))
        controllers = "\n".join(
            f'<load_controller id="{i}" type="loadcurve">{curve}'
            "</load_controller>" for i, curve in enumerate(self.curves, 1))
        return f"""<?xml version="1.0" encoding="ISO-8859-1"?>
<febio_spec version="4.0">
<Module type="biphasic"/>
<Control>
<analysis>TRANSIENT</analysis>
<time_steps>{self.steps}</time_steps>
<step_size>{self.step}</step_size>
{self.stepper}
</Control>
<Material>
<material id="1" name="tissue" type="biphasic">
<phi0>0.2</phi0>
{self.solid}
{self.permeability}
</material>
{self.materials}
</Material>
<Mesh>
<Nodes name="column">
{node_lines}
</Nodes>
<Elements type="hex8" name="body">
{element_lines}
</Elements>
<NodeSet name="all">{text_of(n for n, _ in nodes)}</NodeSet>
<NodeSet name="bottom">1,2,3,4</NodeSet>
<NodeSet name="top_nodes">{text_of(self.top())}</NodeSet>
<Surface name="top"><quad4 id="1">{text_of(self.top())}</quad4></Surface>
</Mesh>
<MeshDomains><SolidDomain name="body" mat="tissue"/></MeshDomains>
<Boundary>
<bc name="sides" node_set="all" type="zero displacement">
<x_dof>1</x_dof><y_dof>1</y_dof></bc>
<bc name="support" node_set="bottom" type="zero displacement">
<z_dof>1</z_dof></bc>
<bc name="drained" node_set="{self.drained}" type="zero fluid pressure"/>
{self.boundary}
</Boundary>
{self.sections}
<LoadData>
{controllers}
</LoadData>
</febio_spec>
"""
