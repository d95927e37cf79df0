#!/usr/bin/env python3
"""The notebook of the Python package, from a mesh to a figure.

Requirements: every cell runs in a kernel of Jupyter; progress, pictures,
plots and tables are shown where they are; no output is kept in the file.
"""

from __future__ import annotations

import os
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

import nbclient  # noqa: E402
import nbformat  # noqa: E402

from program_checks import SOURCE, check, finish  # noqa: E402

PACKAGE = SOURCE / "scripts" / "python"
NOTEBOOK = PACKAGE / "examples" / "indentation.ipynb"
PATIENCE = 300  # seconds a cell


def outputs(notebook: nbformat.NotebookNode, begin: str) -> set[str]:
    """The types of what the cell shows that begins with a text."""
    cell, = [cell for cell in notebook.cells if cell.cell_type == "code"
             and cell.source.startswith(begin)]
    return {kind for output in cell.outputs
            for kind in output.get("data", {output.output_type: ""})}


def main() -> None:
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    check(not any(cell.outputs or cell.execution_count for cell in code),
          "the file has no outputs")
    check(len(notebook.cells) >= 15, f"{len(notebook.cells)} cells")
    os.environ["PYTHONPATH"] = str(PACKAGE)
    # The plots of this test's environment would not be shown.
    os.environ.pop("MPLBACKEND", None)
    with tempfile.TemporaryDirectory(prefix="synovia notebook ") as name:
        client = nbclient.NotebookClient(
            notebook, timeout=PATIENCE, kernel_name="python3",
            resources={"metadata": {"path": name}})
        client.execute()
        check(all(cell.execution_count for cell in code), "all cells ran")
        for begin, kind in (("case.check()", "text/plain"),
                            ("result = case.run", "text/html"),
                            ("result.picture", "image/png"),
                            ("result.plot_line", "image/png"),
                            ("table =", "text/html"),
                            ("noise = ", "text/html"),
                            ("fit.plot()", "image/png"),
                            ("figure, ", "image/png")):
            found = outputs(notebook, begin)
            check(kind in found, f"{begin} shows {kind}")
        check("stream" not in outputs(notebook, "result = case.run"),
              "progress is not written line by line")
        size = (pathlib.Path(name) / "indentation.png").stat().st_size
        check(size > 20_000, f"the figure has {size} bytes")
        keep = os.environ.get("SYNOVIA_KEEP_NOTEBOOK")
        if keep:
            nbformat.write(notebook, keep)
    finish()


if __name__ == "__main__":
    main()
