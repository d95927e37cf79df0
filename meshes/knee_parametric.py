#!/usr/bin/env python3
"""Mesh of an idealized right knee: cartilage and menisci, hexahedra.

For tests, and for users without an image; regions, surfaces, axes and rules are
those of knee_from_segmentation.py. In millimeters; the condyles would touch the
tibial cartilage at (-22, 0, 0) and (22, 0, 0) if the femur were not lifted.

                 posterior                  seen from above, the femur left off
          ____               ____
        /  __  \\          /  __  \\
       / /     ''|        |''     \\ \\       medial meniscus: C-shaped
      | |                 .        | |      lateral meniscus: nearly circular
      | |      ..|        |..      | |
       \\ \\___/   |         \\ \\___/ /
        \\_______/            \\____/
    medial       anterior         lateral

Femur: in sagittal planes an arc of radius 22 behind, and one of 32 in front of
the lowest point (Iwaki, Pinskerova & Freeman 2000, J Bone Joint Surg Br
82-B:1189-95, medial condyle); in the frontal plane each condyle has a radius of
17, and the groove between them is 2.9 deep. The cartilage is 2.0 thick, tibial
cartilage 2.5, less towards its rim: mean thicknesses of plates lie between 1.6
and 2.4 (Eckstein et al. 2001, Osteoarthritis Cartilage 9:101-11). The medial
plateau is concave, the lateral one convex from front to back (Hashemi et al.
2008, J Bone Joint Surg Am 90-A:2724-34, and the cartilage of the lateral one,
whose bone is flat). Menisci: medial one 42 long and 32 wide, lateral one 33
long and 33 wide (Gupta, Bhavsar & Ambiye 2015, Int J Anat Res 3:1073-78); their
surfaces are those of their neighbors.

Sample runs:
  scripts/run_python meshes/knee_parametric.py -o knee.msh          # 35,000 hexes
  scripts/run_python meshes/knee_parametric.py -o small.msh --size 2      # 5,000
"""

from __future__ import annotations

import argparse
import sys

import mesh_script

import numpy as np

import knee_joint
import knee_mesh_file
from cartilage_layer import Cylinder, Layer, Vertical
from cartilage_outline import FemoralOutline
from meniscus_wedge import Meniscus

CONDYLE = 22.0          # x of the condyles' lowest points
BEHIND, IN_FRONT = 22.0, 32.0   # sagittal radii of the femur
FRONTAL = 17.0          # frontal radius of a condyle
FEMORAL_THICKNESS = 2.0
TIBIAL_THICKNESS = 2.5

# The femoral cartilage reaches from END behind to FRONT (degrees, -90 is the
# lowest point), and in x from the notch to the outer sides.
END, SHOULDER, FRONT = -195.0, -75.0, -5.0
NOTCH, ARCH, OUTER = 9.0, 4.5, 36.0

# Tibia: center, half width, half length, and 1/radius in x and in y of what
# touches the femur at y = 0.
PLATEAUS = {"medial": (-CONDYLE, 3.0, 14.0, 21.5, 1 / 80, 1 / 50),
            "lateral": (CONDYLE, 1.5, 15.0, 18.0, 1 / 60, -1 / 120)}
# Menisci: center, half width and half length of the outer side, angles of the
# anterior and the posterior horn (degrees), width of the wedge.
MENISCI = {"medial": (-19.0, 3.5, 17.0, 21.0, 70.0, 290.0, 8.5),
           "lateral": (22.0, 1.5, 16.5, 16.5, 145.0, -145.0, 9.0)}

CHART = Cylinder(0.0, BEHIND, BEHIND)


def femoral_radius(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Distance of the contact side from the axis, over x and arc length."""
    beyond = np.abs(u) - CONDYLE
    across = np.where(beyond > 0, beyond**2,
                      ((u**2 - CONDYLE**2) / (2 * CONDYLE))**2)
    offset = IN_FRONT - BEHIND
    sine = np.sin(v / BEHIND)
    front = offset * sine + np.sqrt((offset * sine)**2
                                    + IN_FRONT**2 - offset**2)
    radius = np.where(v > -0.5 * np.pi * BEHIND, front, BEHIND)
    return radius - across / (2 * FRONTAL)


def femoral_height(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """z of the femur's lower side, by damped iteration."""
    z = np.zeros_like(x)
    for _ in range(60):
        _, v, _ = CHART.coordinates(np.stack([x, y, z], axis=-1))
        below = np.maximum(femoral_radius(x, v)**2 - y**2, 1.0)
        z = 0.5 * (z + CHART.z - np.sqrt(below))
    return z


def plateau(side: str):
    """z of the contact side of the tibial cartilage, and of its bone side."""
    x0, y0, width, length, bend_x, bend_y = PLATEAUS[side]

    def contact(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return 0.5 * (bend_x * (x - x0)**2 + bend_y * y**2)

    def bone(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        outward = ((x - x0) / width)**2 + ((y - y0) / length)**2
        return contact(x, y) - TIBIAL_THICKNESS / (1 + 0.7 * outward)

    return contact, bone


def anatomy() -> tuple[knee_joint.Anatomy, list[str]]:
    v = np.linspace(np.radians(END) * BEHIND, np.radians(FRONT) * BEHIND, 400)
    shoulder = float(np.radians(SHOULDER) * BEHIND)
    share = np.linspace(0, 1, 101)
    notch = np.column_stack([NOTCH * (2 * share - 1),
                             shoulder + 4 * ARCH * share * (1 - share)])
    outline = FemoralOutline(
        v, [np.full_like(v, x) for x in (-OUTER, -NOTCH, NOTCH, OUTER)],
        (v[0], v[0]), shoulder, notch, v[-1])
    femur = Layer(CHART, lambda u, v: femoral_radius(u, v) - FEMORAL_THICKNESS,
                  femoral_radius, 0.5)
    tibia, outlines, menisci = {}, {}, {}
    turn = np.radians(np.arange(360))
    for side in knee_joint.SIDES:
        contact, bone = plateau(side)
        tibia[side] = Layer(Vertical(), bone, contact, 0.5)
        x0, y0, width, length, *_ = PLATEAUS[side]
        outlines[side] = np.column_stack([x0 + width * np.cos(turn),
                                          y0 + length * np.sin(turn)])
        x0, y0, width, length, anterior, posterior, wedge = MENISCI[side]
        angles = np.radians(np.linspace(anterior, posterior, 240))
        outer = width * length / np.hypot(length * np.cos(angles),
                                          width * np.sin(angles))
        menisci[side] = Meniscus(np.array([x0, y0]), angles,
                                 outer - wedge, outer, contact,
                                 femoral_height)
    return (knee_joint.Anatomy(femur, outline, tibia, outlines, menisci),
            ["an idealized right knee"])


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    knee_joint.add_options(parser, "knee_parametric.msh")
    args = parser.parse_args(argv)
    mesh_script.check_output(parser, args.output)
    return knee_mesh_file.write("knee_parametric.py", args, anatomy)


if __name__ == "__main__":
    sys.exit(main())
