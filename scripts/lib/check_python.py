"""Do the packages load, and can VTK draw on this machine?"""

import gmsh
import h5py  # noqa: F401
import matplotlib  # noqa: F401
import nibabel  # noqa: F401
import nrrd  # noqa: F401
import numpy
import pyvista
import scipy.sparse.linalg  # noqa: F401

gmsh.initialize()
gmsh.finalize()

plotter = pyvista.Plotter(off_screen=True, window_size=(64, 64))
plotter.add_mesh(pyvista.Sphere())
picture = plotter.screenshot(return_img=True)
if numpy.ptp(picture) == 0:
    raise SystemExit("check_python.py: error: VTK drew an empty picture")
