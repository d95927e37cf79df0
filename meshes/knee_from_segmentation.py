#!/usr/bin/env python3
"""Mesh of a knee from a labeled image: cartilage and menisci, hexahedra.

The image (NRRD or NIfTI) has a number in each voxel that says which tissue is
there. In millimeters, z up, y to the front, x to the right (so that x points
to the lateral side of a right knee); the origin is midway between the tibial
cartilages.

    regions   femoral_cartilage, tibial_cartilage_medial, ..._lateral,
              meniscus_medial, meniscus_lateral
    surfaces  of cartilage: _bone, _contact (towards the joint), _rim
              of menisci:   _superior (towards the femur), _inferior,
                            _periphery, _inner (the blunt edge of the wedge),
                            _horn_anterior, _horn_posterior

How: each side of a tissue is the smoothest surface that follows its voxels, as
a height over the plane or, for the femur, over a cylinder along x; details
shorter than --smoothing are left out, the voxels' stairs with them. The layers
are swept from plane meshes along their normals. The femur is then lifted until
it is clear of the tibial cartilage, and the menisci are fitted between the two:
gaps of less than a voxel are closed, larger ones stay. The posterior ends of
the condyles and the front of the trochlea are cut off straight.

Without IMAGE it is that of a real knee: see scripts/get_knee_image --help.

Sample runs:
  image=$(scripts/get_knee_image)
  scripts/run_python meshes/knee_from_segmentation.py "$image" -o knee.msh
  scripts/run_python meshes/knee_from_segmentation.py "$image" --size 1.65
  scripts/run_python meshes/knee_from_segmentation.py "$image" --size 0.52

These have 37,000, 9,000 and 270,000 hexahedra.
"""

from __future__ import annotations

import argparse
import pathlib
import subprocess
import sys

import mesh_script

import numpy as np

import knee_joint
import knee_mesh_file
import label_image
from label_femur import femoral_axis, femoral_layer
from label_meniscus import meniscus
from label_tibia import tibial_layer

# Label numbers of the option's default.
LABELS = {knee_joint.FEMUR: 1, knee_joint.TIBIA["medial"]: 2,
          knee_joint.TIBIA["lateral"]: 3, knee_joint.MENISCUS["lateral"]: 9,
          knee_joint.MENISCUS["medial"]: 10}

# Menisci are steeper than cartilage, and so need to follow their voxels closer.
MENISCAL_SHARE = 0.7


def labels(text: str) -> dict[str, int]:
    found = dict(LABELS)
    for part in text.split(","):
        name, equals, number = part.partition("=")
        if name not in LABELS or not equals:
            raise argparse.ArgumentTypeError(
                f"'{part}' is not REGION=NUMBER with a region of "
                f"{', '.join(LABELS)}")
        try:
            found[name] = int(number)
        except ValueError:
            raise argparse.ArgumentTypeError(
                f"'{number}' is not a whole number") from None
    return found


def image_of_a_real_knee() -> str:
    """Its file, which is downloaded the first time."""
    script = pathlib.Path(__file__).resolve().parents[1] \
        / "scripts" / "get_knee_image"
    found = subprocess.run([script], stdout=subprocess.PIPE, text=True)
    if found.returncode != 0:
        raise RuntimeError(f"{script} gets no image (see above); name one")
    return found.stdout.strip()


def anatomy(args: argparse.Namespace
            ) -> tuple[knee_joint.Anatomy, list[str]]:
    args.image = args.image or image_of_a_real_knee()
    image = label_image.read(args.image)
    voxel = " x ".join(f"{edge:.3f}" for edge in image.voxel())
    centers = [label_image.Tissue(image, args.labels[name], name).points
               .mean(axis=0) for name in knee_joint.TIBIA.values()]
    shift = 0.5 * (centers[0] + centers[1])
    image.affine[:3, 3] -= shift
    place = ", ".join(f"{c:.3f}" for c in shift)
    lines = [f"{args.image}: voxels of {voxel} mm; the origin is at ({place}) "
             "in its right-anterior-superior coordinates"]
    tissues = {}
    for name, label in args.labels.items():
        tissues[name] = label_image.Tissue(image, label, name)
        lines.append(f"{name}: label {label}, {tissues[name].volume:.0f} mm^3, "
                     f"{tissues[name].dropped} stray voxels left out")
    chart = femoral_axis(tissues[knee_joint.FEMUR])
    femur, outline = femoral_layer(tissues[knee_joint.FEMUR], chart,
                                   args.smoothing, args.thinnest)
    tibia = {side: tibial_layer(tissues[name], args.smoothing, args.thinnest)
             for side, name in knee_joint.TIBIA.items()}
    for name, layer in ((knee_joint.FEMUR, femur),
                        *((knee_joint.TIBIA[side], layer)
                          for side, (layer, _) in tibia.items())):
        lines.append(f"{name}: smooth surfaces deviate from the voxels' by "
                     f"{layer.contact.residual:.2f} (contact) and "
                     f"{layer.bone.residual:.2f} mm (bone), root mean square")
    menisci = {side: meniscus(tissues[name], MENISCAL_SHARE * args.smoothing)
               for side, name in knee_joint.MENISCUS.items()}
    return knee_joint.Anatomy(
        femur, outline, {side: layer for side, (layer, _) in tibia.items()},
        {side: curve for side, (_, curve) in tibia.items()}, menisci), lines


def parse(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("image", nargs="?",
                        help="labeled image: .nrrd, .nii or .nii.gz; left "
                             "out, that of scripts/get_knee_image")
    knee_joint.add_options(parser, "knee.msh")
    parser.add_argument("--labels", type=labels, default=dict(LABELS),
                        metavar="REGION=NUMBER,...",
                        help="default: " + ",".join(
                            f"{name}={label}" for name, label in
                            LABELS.items()))
    parser.add_argument("--smoothing", type=mesh_script.positive, default=7.0,
                        help="waves shorter than this are left out (mm, "
                             "default %(default)s)")
    parser.add_argument("--thinnest", type=mesh_script.positive, default=0.7,
                        help="cartilage that is thinner is cut off at the "
                             "rim (mm, default %(default)s)")
    args = parser.parse_args(argv)
    mesh_script.check_output(parser, args.output)
    return args


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)
    return knee_mesh_file.write("knee_from_segmentation.py", args,
                                lambda: anatomy(args))


if __name__ == "__main__":
    sys.exit(main())
