#!/usr/bin/env python3
# processors: 1
"""Tests of the knee's mesh generators."""

import pathlib
import sys
import tempfile
import tomllib
import unittest

import nibabel
import nrrd
import numpy as np

ROOT = pathlib.Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "meshes"), str(ROOT / "tests" / "support")]
import knee_from_segmentation  # noqa: E402
import knee_joint  # noqa: E402
import knee_parametric  # noqa: E402
import meniscus_ring  # noqa: E402
import surface_gap  # noqa: E402
from hex_mesh import HexMesh, check_hexahedra  # noqa: E402
from run_main import run_main  # noqa: E402
from synthetic_knee import synthetic_labels, write_nrrd  # noqa: E402

FOLDER = tempfile.TemporaryDirectory()
NAMES = (["femoral_cartilage", "tibial_cartilage_medial",
          "tibial_cartilage_lateral"], ["meniscus_medial", "meniscus_lateral"])
SURFACES = {f"{body}_{side}" for body in NAMES[0]
            for side in ("bone", "contact", "rim")} \
    | {f"{body}_{side}" for body in NAMES[1]
       for side in ("superior", "inferior", "periphery", "inner",
                    "horn_anterior", "horn_posterior")}
LABELS = {"femoral_cartilage": 1, "tibial_cartilage_medial": 2,
          "tibial_cartilage_lateral": 3, "meniscus_lateral": 9,
          "meniscus_medial": 10}


def path(name: str) -> str:
    return str(pathlib.Path(FOLDER.name) / name)


def generate(main, name: str, *options: str) -> tuple[HexMesh, str]:
    status, out, err = run_main(main, *options, "-o", path(name))
    assert status == 0, err
    return HexMesh(pathlib.Path(path(name))), out


def angles_between(x: np.ndarray, one: np.ndarray, other: np.ndarray
                   ) -> np.ndarray:
    """Of a body, in degrees, where quadrangles of two surfaces share an edge.
    """
    def normals(quads: np.ndarray) -> np.ndarray:
        found = np.cross(x[quads[:, 2]] - x[quads[:, 0]],
                         x[quads[:, 3]] - x[quads[:, 1]])
        return found / np.linalg.norm(found, axis=1)[:, None]

    def edges(quads: np.ndarray) -> dict[tuple[int, int], int]:
        return {tuple(sorted((quad[k], quad[k - 1]))): number
                for number, quad in enumerate(quads.tolist())
                for k in range(4)}

    found, neighbors = edges(one), edges(other)
    pairs = [(found[edge], neighbors[edge])
             for edge in found.keys() & neighbors.keys()]
    mine, theirs = np.array(pairs).T
    cosine = np.einsum("ij,ij->i", normals(one)[mine], normals(other)[theirs])
    return 180.0 - np.degrees(np.arccos(np.clip(cosine, -1, 1)))


class Knees(unittest.TestCase):
    """What holds whatever the knee is made from."""

    @classmethod
    def setUpClass(cls):
        cls.labels, cls.affine = synthetic_labels()
        image = write_nrrd(path("knee.nrrd"), cls.labels, cls.affine)
        cls.knees = {
            "parametric": generate(knee_parametric.main, "parametric.msh",
                                   "--size", "2.2", "--geometry-order", "2"),
            "image": generate(knee_from_segmentation.main, "image.msh", image,
                              "--size", "2", "--inner-face", "normal"),
            "round": generate(knee_from_segmentation.main, "round.msh", image,
                              "--size", "2", "--inner-edge", "1",
                              "--inner-face", "round"),
            "curved": generate(knee_parametric.main, "curved.msh",
                               "--size", "2.2", "--geometry-order", "2",
                               "--inner-face", "round")}

    def test_hexahedra_are_good_and_outer_faces_have_one_name(self):
        for name, (mesh, _) in self.knees.items():
            with self.subTest(name):
                self.assertEqual(list(mesh.regions), NAMES[0] + NAMES[1])
                self.assertEqual(set(mesh.surfaces), SURFACES)
                check_hexahedra(self, mesh, 0.2)

    def test_small_ones_are_small(self):
        for name, (mesh, out) in self.knees.items():
            with self.subTest(name):
                self.assertGreater(mesh.count(), 3000)
                self.assertLess(mesh.count(), 9000)
                self.assertIn(f"{mesh.count()} hexahedra", out)

    def test_femur_touches_menisci_which_rest_on_the_tibia(self):
        for name, (mesh, _) in self.knees.items():
            quads = {n: mesh.x[q] for n, q in mesh.surfaces.items()}
            for side in ("medial", "lateral"):
                tibia = quads[f"tibial_cartilage_{side}_contact"]
                femur = quads["femoral_cartilage_contact"]
                meniscus = {n: quads[f"meniscus_{side}_{n}"]
                            for n in ("superior", "inferior")}
                with self.subTest(f"{name}, {side}"):
                    for lower, upper, closest, near in (
                            (tibia, femur, (0.149, 0.4), 3.0),
                            (tibia, meniscus["inferior"], (0.0005, 0.002), 0.1),
                            (meniscus["superior"], femur, (0.0005, 0.002),
                             0.3)):
                        gaps = surface_gap.vertical_gaps(lower, upper)
                        self.assertGreater(gaps.min(), closest[0])
                        self.assertLess(gaps.min(), closest[1])
                        self.assertLess(np.median(gaps), near)

    def test_inner_faces_meet_both_surfaces_at_right_angles(self):
        mesh, _ = self.knees["image"]
        for meniscus in NAMES[1]:
            inner = mesh.surfaces[f"{meniscus}_inner"]
            for side in ("inferior", "superior"):
                with self.subTest(f"{meniscus}, {side}"):
                    angles = angles_between(
                        mesh.x, inner, mesh.surfaces[f"{meniscus}_{side}"])
                    self.assertGreater(len(angles), 20)
                    self.assertGreater(angles.min(), 80.0)
                    self.assertLess(angles.max(), 102.0)

    def test_rounded_edges_go_on_from_both_surfaces(self):
        for name in ("round", "curved"):
            mesh, _ = self.knees[name]
            for meniscus in NAMES[1]:
                inner = mesh.surfaces[f"{meniscus}_inner"][:, :4]
                turns = surface_gap.normal_turns(mesh.x[inner])
                for side in ("inferior", "superior"):
                    with self.subTest(f"{name}, {meniscus}, {side}"):
                        angles = angles_between(
                            mesh.x, inner,
                            mesh.surfaces[f"{meniscus}_{side}"][:, :4])
                        self.assertGreater(len(angles), 15)
                        self.assertGreater(angles.min(), 135.0)
                self.assertGreater(turns.max(), 30.0)
                self.assertLess(turns.max(), 70.0)

    def test_no_body_is_inside_another(self):
        for name, (mesh, _) in self.knees.items():
            for region, cells in mesh.regions.items():
                corners = mesh.x[np.unique(cells)]
                for other, hexahedra in mesh.regions.items():
                    if other != region:
                        inside = surface_gap.points_inside(
                            corners, mesh.x[hexahedra])
                        self.assertEqual(inside.sum(), 0,
                                         f"{name}: {region} in {other}")

    def test_frames_are_where_the_menisci_turn_about(self):
        for name, (mesh, out) in self.knees.items():
            with self.subTest(name), open(path(f"{name}.frames.toml"),
                                          "rb") as file:
                frames = tomllib.load(file)
                for region in NAMES[1]:
                    frame = frames[region]["frame"]
                    self.assertEqual(frame["type"], "cylindrical")
                    self.assertEqual(frame["axis"], [0, 0, 1])
                    cells = mesh.x[np.unique(mesh.regions[region])]
                    radius = np.hypot(*(cells - frame["origin"])[:, :2].T)
                    self.assertGreater(radius.min(), 3.0)
                horns = [mesh.x[mesh.surfaces[f"meniscus_medial_horn_{end}"]
                                [:, :4]].mean(axis=(0, 1))
                         for end in ("anterior", "posterior")]
                self.assertGreater(horns[0][1], horns[1][1] + 20)
                np.testing.assert_allclose(
                    frames["meniscus_medial"]["frame"]["origin"],
                    0.5 * (horns[0] + horns[1]), atol=1e-3)
                origin = frames["meniscus_lateral"]["frame"]["origin"]
                rim = mesh.x[mesh.surfaces["meniscus_lateral_periphery"]]
                radius = np.hypot(*(rim.mean(axis=1) - origin)[:, :2].T)
                self.assertLess(np.ptp(radius), 1.0)

    def test_image_gives_the_shapes_that_are_in_it(self):
        # The parametric knee again, from its voxels.
        mesh, _ = self.knees["image"]
        shift = 0.5 * sum(
            (np.argwhere(self.labels == label) @ self.affine[:3, :3].T
             + self.affine[:3, 3]).mean(axis=0) for label in (2, 3))
        body, _ = knee_parametric.anatomy()
        for side in ("medial", "lateral"):
            for face, height in (("contact", body.tibia[side].contact),
                                 ("bone", body.tibia[side].bone)):
                name = f"tibial_cartilage_{side}_{face}"
                x, y, z = (mesh.x[np.unique(mesh.surfaces[name])] + shift).T
                self.assertLess(np.abs(z - height(x, y)).max(), 0.25, name)
        name = "femoral_cartilage_contact"
        x = mesh.x[np.unique(mesh.surfaces[name])] + shift
        u, v, h = body.femur.chart.coordinates(x)
        error = h - body.femur.contact(u, v)
        # It was lifted, by 0.3 mm in the image.
        self.assertLess(np.abs(error).max(), 0.6)
        for region, label in LABELS.items():
            voxels = (self.labels == label).sum() \
                * abs(np.linalg.det(self.affine[:3, :3]))
            self.assertLess(abs(mesh.volume(region) / voxels - 1), 0.12,
                            region)

    def test_stairs_of_voxels_are_not_in_the_contact_surfaces(self):
        # As smooth as what was made without voxels, but for the size.
        for name in sorted(SURFACES):
            if not name.endswith(("contact", "superior", "inferior")):
                continue
            turns = [np.percentile(surface_gap.normal_turns(
                mesh.x[mesh.surfaces[name]]), 95)
                for mesh, _ in self.knees.values()]
            self.assertLess(turns[1], max(1.3 * turns[0], 5.0), name)

    def test_nifti_gives_the_same_as_nrrd(self):
        nibabel.save(nibabel.Nifti1Image(self.labels, self.affine),
                     path("knee.nii.gz"))
        other, _ = generate(knee_from_segmentation.main, "nifti.msh",
                            path("knee.nii.gz"), "--size", "2",
                            "--inner-face", "normal")
        mesh, _ = self.knees["image"]
        np.testing.assert_allclose(other.x[1:], mesh.x[1:], atol=1e-3)

    def test_left_knee_and_other_labels(self):
        labels, affine = synthetic_labels(mirrored=True)
        image = write_nrrd(path("left.nrrd"), labels + 20 * (labels > 0), affine)
        mesh, _ = generate(
            knee_from_segmentation.main, "left.msh", image, "--size", "2",
            "--labels", ",".join(f"{k}={v + 20}" for k, v in LABELS.items()))
        check_hexahedra(self, mesh, 0.2)
        self.assertGreater(mesh.x[mesh.regions["meniscus_medial"]][..., 0]
                           .min(), 0.0)

    def test_default_has_as_many_elements_as_the_paper(self):
        mesh, _ = generate(knee_parametric.main, "default.msh")
        self.assertGreater(mesh.count(), 30000)
        self.assertLess(mesh.count(), 40000)


class WrongInput(unittest.TestCase):

    def check(self, arguments: list[str], *words: str, status: int = 1):
        got, _, err = run_main(knee_from_segmentation.main, *arguments,
                               "-o", path("wrong.msh"))
        self.assertEqual(got, status, err)
        last = err.strip().splitlines()[-1]
        self.assertIn(".py: error: ", last)
        if status == 1:
            self.assertEqual(len(err.strip().splitlines()), 1, err)
        for word in words:
            self.assertIn(word, last)
        self.assertFalse(pathlib.Path(path("wrong.msh")).exists())

    def block(self, name: str, **boxes: int) -> str:
        labels = np.zeros((40, 40, 30), dtype=np.uint8)
        for k, label in enumerate(boxes.values()):
            labels[5:35, 5:35, 2 + 5 * k:6 + 5 * k] = label
        return write_nrrd(path(name), labels, np.eye(4))

    def test_no_file(self):
        self.check([path("none.nrrd")], "there is no file", "none.nrrd")

    def test_unknown_format(self):
        file = path("image.dcm")
        pathlib.Path(file).write_text("")
        self.check([file], "image.dcm", ".nrrd", ".nii.gz")

    def test_damaged_files(self):
        for name in ("bad.nrrd", "bad.nii", "bad.nii.gz"):
            with self.subTest(name):
                pathlib.Path(path(name)).write_bytes(b"NRRD0004\nno\n\n" * 9)
                self.check([path(name)], "cannot read", name)

    def test_missing_label(self):
        self.check([self.block("few.nrrd", femur=1, tibia=2)],
                   "label 3", "tibial_cartilage_lateral", "0, 1, 2")

    def test_image_that_is_no_knee(self):
        self.check([self.block("blocks.nrrd", a=2, b=3, c=9, d=10, e=1)],
                   "condyles")

    def test_numbers_that_are_no_labels(self):
        nrrd.write(path("grey.nrrd"), np.random.default_rng(1).random(
            (4, 4, 4)), {"space": "left-posterior-superior",
                         "space directions": np.eye(3)})
        self.check([path("grey.nrrd")], "not whole")

    def test_voxels_without_a_size(self):
        nrrd.write(path("size.nrrd"), np.ones((4, 4, 4), dtype=np.uint8))
        self.check([path("size.nrrd")], "voxels")

    def test_options(self):
        image = path("none.nrrd")
        for option, value, word in (("--size", "0", "positive"),
                                    ("--labels", "bone=3", "bone=3"),
                                    ("--labels", "meniscus_medial=x", "'x'"),
                                    ("--clearance", "-1", "positive")):
            with self.subTest(option):
                self.check([image, f"{option}={value}"], word, status=2)


class MeniscusRing(unittest.TestCase):

    COMMON = {f"{body}_{side}" for body in ("femoral_cartilage",
                                            "tibial_cartilage")
              for side in ("bone", "contact", "rim")} \
        | {f"meniscus_{side}" for side in ("superior", "inferior",
                                           "periphery", "inner")}

    def test_parts_of_the_turn(self):
        for angle, size, more in (
                ("360", "1.5", set()),
                ("90", "1", {"symmetry_x", "symmetry_y"}),
                ("5", "0.6", {"symmetry_y", "symmetry_turned", "axis"})):
            with self.subTest(angle):
                mesh, _ = generate(meniscus_ring.main, f"ring{angle}.msh",
                                   "--angle", angle, "--size", size,
                                   "--geometry-order", "2")
                self.assertEqual(set(mesh.surfaces), self.COMMON | more)
                check_hexahedra(self, mesh, 0.2)
                share = float(angle) / 360
                disc = 2.5 * np.pi * 18**2 * share
                self.assertAlmostEqual(mesh.volume("tibial_cartilage") / disc,
                                       1, delta=1e-4)
                for plane, normal in (("symmetry_x", [1, 0, 0]),
                                      ("symmetry_y", [0, 1, 0]),
                                      ("symmetry_turned",
                                       [-np.sin(np.radians(5)),
                                        np.cos(np.radians(5)), 0])):
                    if plane in more:
                        x = mesh.x[mesh.surfaces[plane]]
                        self.assertLess(np.abs(x @ normal).max(), 1e-9)
                quads = {n: mesh.x[q] for n, q in mesh.surfaces.items()}
                for lower, upper, least in (
                        ("tibial_cartilage_contact", "meniscus_inferior",
                         0.001),
                        ("meniscus_superior", "femoral_cartilage_contact",
                         0.001),
                        ("tibial_cartilage_contact",
                         "femoral_cartilage_contact", 0.15)):
                    gap = surface_gap.vertical_gaps(quads[lower],
                                                    quads[upper]).min()
                    self.assertAlmostEqual(gap, least, delta=0.002)

    def test_all_nodes_are_on_the_surfaces(self):
        mesh, _ = generate(meniscus_ring.main, "curved.msh", "--angle", "90",
                           "--size", "2", "--geometry-order", "2")

        def radius(surface: str, *middle: float) -> np.ndarray:
            return np.linalg.norm(mesh.x[np.unique(mesh.surfaces[surface])]
                                  - middle, axis=1)

        for side, expected in (("contact", 25.0), ("bone", 23.0)):
            np.testing.assert_allclose(
                radius(f"femoral_cartilage_{side}", 0, 0, 25.15), expected,
                rtol=1e-12)
        rim = mesh.x[np.unique(mesh.surfaces["meniscus_periphery"])]
        np.testing.assert_allclose(np.hypot(*rim[:, :2].T), 15.0, rtol=1e-12)

    def test_straight_edges(self):
        curved, straight = (
            generate(meniscus_ring.main, f"order{order}.msh", "--angle", "90",
                     "--size", "2", "--geometry-order", order)[0]
            for order in "21")
        self.assertEqual(curved.count(), straight.count())
        self.assertEqual(straight.regions["meniscus"].shape[1], 8)
        check_hexahedra(self, straight, 0.2)
        # The outline is a polygon then.
        lost = 1 - straight.volume("tibial_cartilage") \
            / curved.volume("tibial_cartilage")
        self.assertGreater(lost, 1e-3)
        self.assertLess(lost, 2e-2)

    def test_wrong_options(self):
        for options, word in ((["--angle", "60"], "--angle"),
                              (["--geometry-order", "3"], "--geometry-order"),
                              (["--inner-edge", "0.1"], "--inner-edge"),
                              (["--width", "25"], "--width"),
                              (["--meniscal-radius", "20"], "--meniscal"),
                              (["--hole", "5"], "--hole")):
            status, _, err = run_main(meniscus_ring.main, *options)
            self.assertEqual(status, 2)
            self.assertIn(word, err.splitlines()[-1])


class Gaps(unittest.TestCase):

    SQUARE = np.array([[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]],
                      dtype=float)

    def test_vertical_gap_of_inclined_faces(self):
        upper = self.SQUARE + [0.3, 0.2, 1.0]
        upper[..., 2] -= 0.5 * upper[..., 0]
        gaps = surface_gap.vertical_gaps(self.SQUARE, upper)
        # Over what both cover, sampled at the lower face's corner x = 1.
        self.assertAlmostEqual(gaps.min(), 0.5)
        self.assertLess(gaps.max(), 0.85 + 1e-9)
        self.assertEqual(len(surface_gap.vertical_gaps(
            self.SQUARE, self.SQUARE + [3, 0, 0])), 0)

    def test_overlap_is_negative(self):
        gaps = surface_gap.vertical_gaps(self.SQUARE, self.SQUARE - [0, 0, .1])
        np.testing.assert_allclose(gaps, -0.1)

    def test_points_inside_hexahedra(self):
        cube = np.concatenate([self.SQUARE, self.SQUARE + [0, 0, 1]], axis=1)
        sheared = cube + 0.5 * cube[..., 2:] * [1, 0, 0]
        points = np.array([(0.5, 0.5, 0.5), (1.2, 0.5, 0.9), (0.1, 0.5, 0.9),
                           (5, 5, 5)])
        self.assertEqual(surface_gap.points_inside(points, cube).tolist(),
                         [True, False, True, False])
        self.assertEqual(surface_gap.points_inside(points, sheared).tolist(),
                         [True, True, False, False])

    def test_normals_of_a_fold(self):
        folded = np.concatenate([self.SQUARE, np.array(
            [[(1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0)]], dtype=float)])
        np.testing.assert_allclose(surface_gap.normal_turns(folded), [90])


class Names(unittest.TestCase):

    def test_names_are_those_of_the_documentation(self):
        self.assertEqual(set(knee_joint.SURFACES), SURFACES)
        self.assertEqual(list(knee_joint.REGIONS), NAMES[0] + NAMES[1])


if __name__ == "__main__":
    unittest.main()
