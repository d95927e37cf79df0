"""Outputs of runs that never were, for tests of the scripts that read them."""

import pathlib

import numpy as np
import pyvista


def write_csv(file: pathlib.Path, columns: dict) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    np.savetxt(file, np.transpose(list(columns.values())), delimiter=",",
               header=",".join(columns), comments="")


def box(low: tuple, high: tuple, region: int) -> pyvista.UnstructuredGrid:
    """A body of hexahedra with a displacement and a stress."""
    axes = [np.linspace(a, b, 7) for a, b in zip(low, high)]
    grid = pyvista.StructuredGrid(*np.meshgrid(*axes, indexing="ij"))
    grid = grid.cast_to_unstructured_grid()
    grid["displacement"] = grid.points * (0.0, 0.0, -0.05)
    grid["total_stress"] = np.outer(grid.points[:, 2] - 2.0,
                                    (0, 0, 0.01, 0, 0, 0))
    grid.cell_data["attribute"] = np.full(grid.n_cells, region)
    return grid


def write_collection(folder: pathlib.Path, name: str,
                     times: dict[float, list]) -> pathlib.Path:
    """A ParaView collection: for each time, the grid of each rank.

    Gives its directory, in which the files are Cycle<n>/proc<rank>.vtu.
    """
    root = folder / "fields" / name
    entries = []
    for cycle, (time, pieces) in enumerate(times.items()):
        at = root / f"Cycle{cycle}"
        at.mkdir(parents=True)
        for rank, piece in enumerate(pieces):
            piece.save(at / f"proc{rank}.vtu")
        (at / "data.pvtu").write_text(parallel_file(pieces))
        entries.append(f'<DataSet timestep="{time:g}" part="0" '
                       f'file="Cycle{cycle}/data.pvtu"/>')
    (root / f"{name}.pvd").write_text(
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n'
        f"<Collection>{''.join(entries)}</Collection>\n</VTKFile>\n")
    return root


def parallel_file(pieces: list) -> str:
    """What says how the pieces of the ranks belong together."""
    def arrays(data) -> str:
        return "".join(
            f'<PDataArray type="{vtk_type(values)}" Name="{name}" '
            f'NumberOfComponents="{values[0].size}"/>'
            for name, values in data.items())

    first = pieces[0]
    files = "".join(f'<Piece Source="proc{rank}.vtu"/>'
                    for rank in range(len(pieces)))
    return ('<?xml version="1.0"?>\n'
            '<VTKFile type="PUnstructuredGrid" version="0.1">\n'
            '<PUnstructuredGrid GhostLevel="0">'
            f'<PPointData>{arrays(first.point_data)}</PPointData>'
            f'<PCellData>{arrays(first.cell_data)}</PCellData>'
            '<PPoints><PDataArray '
            f'type="{vtk_type(first.points)}" NumberOfComponents="3"/>'
            f'</PPoints>{files}</PUnstructuredGrid>\n</VTKFile>\n')


def vtk_type(values: np.ndarray) -> str:
    return {"f": "Float", "i": "Int", "u": "UInt"}[values.dtype.kind] \
        + str(8 * values.dtype.itemsize)
