"""Synovia from Python: cases, runs, results, sweeps and fits.

    import synovia
    case = synovia.Case("indentation.toml")
    case.material["cartilage"].solid.E = 0.6
    result = case.run(ranks=2)
    result.plot_forces()

SYNOVIA_PROGRAM names the program, unless it is in PATH. README.md beside this
package shows all of it.
"""

from synovia.case import Case, Check
from synovia.errors import (CaseError, KeyNameError, RunError, Stopped,
                            SynoviaError)
from synovia.fit import fit
from synovia.fitted import Fit
from synovia.measured import Curve, Parameter
from synovia.output import OutputError, Table
from synovia.program import use_program
from synovia.results import Result
from synovia.runs import Run
from synovia.sweep import sweep
from synovia.sweep_table import SweepTable

__all__ = ["Case", "CaseError", "Check", "Curve", "Fit", "KeyNameError",
           "OutputError", "Parameter", "Result", "Run", "RunError", "Stopped",
           "SweepTable", "SynoviaError", "Table", "fit", "sweep",
           "use_program"]
__version__ = "0.1.0"
