"""Other programs read what pillowmesh writes: meshio and, where they are installed, Gmsh and Medit.

Run with: /usr/bin/python3 -m unittest discover -s tests/io -p '*_test.py' -v
The command is build/release/bin/pillowmesh, or $PILLOWMESH_BIN.
"""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COMMAND = os.environ.get("PILLOWMESH_BIN", str(ROOT / "build" / "release" / "bin" / "pillowmesh"))

try:
    import meshio
    import numpy as np
except ImportError:
    meshio = None

# Name of the file and the options that choose its variant.
VARIANTS = [
    ("a.mesh", []),
    ("a.meshb", []),
    ("a.msh", []),
    ("b.msh", ["--binary"]),
    ("c.msh", ["--gmsh-version", "2.2"]),
    ("d.msh", ["--gmsh-version", "2.2", "--binary"]),
    ("a.vtk", []),
    ("b.vtk", ["--binary"]),
    ("a.vtu", []),
    ("b.vtu", ["--binary"]),
]
# The groups of a grid's sides, in the order of xmin, xmax, ymin, ...
QUADS, HEXES = "grid:3,2:0,3,-1,0.1", "grid:3,2,2:0,3,-1,0.1,0,1"


def read(path):
    # meshio takes .mesh by its ending, .meshb only by name.
    return meshio.read(path, file_format="medit" if path.suffix in (".mesh", ".meshb") else None)


def cells(mesh, kind):
    found = [block.data for block in mesh.cells if block.type == kind]
    return np.concatenate(found) if found else np.empty((0, 0), int)


def groups(mesh, kind):
    names = [n for n in ("group", "medit:ref", "gmsh:physical") if n in mesh.cell_data]
    found = [data for block, data in zip(mesh.cells, mesh.cell_data[names[0]]) if block.type == kind]
    return np.concatenate(found) if found else np.empty(0, int)


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="pillowmesh_io_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def convert(self, source, name, options=()):
        path = self.folder / name
        subprocess.run([COMMAND, "convert", str(source), str(path), *options], check=True)
        return path


@unittest.skipIf(meshio is None, "meshio is not installed")
class MeshioReads(Case):
    def test_quads_of_every_variant_with_groups_and_exact_coordinates(self):
        for name, options in VARIANTS:
            with self.subTest(name=name, options=options):
                mesh = read(self.convert(QUADS, name, options))
                self.assertEqual(len(cells(mesh, "quad")), 6)
                self.assertEqual(len(cells(mesh, "line")), 10)
                self.assertEqual(sorted(groups(mesh, "line")), [1, 1, 2, 2, 3, 3, 3, 4, 4, 4])
                x, y = mesh.points[:, 0], mesh.points[:, 1]
                self.assertEqual(sorted(set(x)), [0, 1, 2, 3])
                self.assertEqual(sorted(set(y))[0], -1)
                self.assertEqual(sorted(set(y))[-1], 0.1)
                # Counter-clockwise quads of area 0.55: our corner order was turned into theirs.
                quads = mesh.points[cells(mesh, "quad")][:, :, :2]
                a, b = quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1]
                np.testing.assert_allclose((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2, 0.55)
                # Each side's group lies on that side.
                for tag, axis, value in ((1, 0, 0), (2, 0, 3), (3, 1, -1), (4, 1, 0.1)):
                    ends = cells(mesh, "line")[groups(mesh, "line") == tag]
                    self.assertTrue(np.all(mesh.points[ends][:, :, axis] == value))

    def test_hexahedra_of_every_variant_with_groups_and_positive_volumes(self):
        for name, options in VARIANTS:
            with self.subTest(name=name, options=options):
                mesh = read(self.convert(HEXES, name, options))
                self.assertEqual(len(mesh.points), 4 * 3 * 3)
                self.assertEqual(len(cells(mesh, "hexahedron")), 12)
                self.assertEqual(len(cells(mesh, "quad")), 32)
                self.assertEqual([list(groups(mesh, "quad")).count(t) for t in range(1, 7)], [4, 4, 6, 6, 6, 6])
                p = mesh.points[cells(mesh, "hexahedron")]
                volume = np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 3] - p[:, 0]), p[:, 4] - p[:, 0])
                np.testing.assert_allclose(volume, 1 * 0.55 * 0.5)
                np.testing.assert_allclose(p[:, 6] - p[:, 0], [[1, 0.55, 0.5]] * 12)

    def test_a_mesh_and_its_metric_are_a_pair(self):
        # meshio has no reader for .sol: the numbers are read as libmeshb says, mmg's order in space being Medit's.
        for spec, formula, size in ((QUADS, "h1 = 0.1 + x; h2 = 0.3; theta = y", 3),
                                    (HEXES, "h1 = 0.1 + x; h2 = 0.3; h3 = 1; theta = y", 6)):
            with self.subTest(spec=spec):
                points = read(self.convert(spec, "pair.mesh")).points
                path = self.folder / "pair.sol"
                subprocess.run([COMMAND, "metric", spec, "--metric", formula, "-o", str(path)], check=True)
                words = path.read_text().split()
                start = words.index("SolAtVertices") + 1
                self.assertEqual(words[:4], ["MeshVersionFormatted", "2", "Dimension", str(2 if size == 3 else 3)])
                self.assertEqual(words[start:start + 3], [str(len(points)), "1", "3"])
                m = np.array(words[start + 3:-1], float).reshape(len(points), size)
                c, s = np.cos(points[:, 1]), np.sin(points[:, 1])
                a, b = 1 / (0.1 + points[:, 0]) ** 2, 1 / 0.09
                np.testing.assert_allclose(m[:, 0], a * c * c + b * s * s)  # m11
                np.testing.assert_allclose(m[:, 2], a * s * s + b * c * c)  # m22
                if size == 6:
                    np.testing.assert_allclose(m[:, 3:], [[0, 0, 1]] * len(points))  # m13 m23 m33

    def test_the_names_of_groups_in_gmsh_and_vtu_files(self):
        source = ROOT / "tests" / "data" / "lshape_v4.msh"
        for name, options in VARIANTS:
            if not name.endswith((".msh", ".vtu")):
                continue
            with self.subTest(name=name, options=options):
                fields = read(self.convert(source, name, options)).field_data
                found = {k: list(np.asarray(v).reshape(-1)) for k, v in fields.items()}
                self.assertEqual(found, {"domain": [1, 2], "inflow": [2, 1], "walls": [3, 1]})

    def test_an_adapted_mesh_with_all_its_boundary_in_groups(self):
        for name in ("out.vtu", "out.msh", "out.mesh"):
            with self.subTest(name=name):
                path = self.folder / name
                source = str(ROOT / "tests" / "data" / "lshape_v2.msh")
                command = [COMMAND, "adapt", source, "--metric", "h = 0.06", "-o", str(path), "--quiet"]
                subprocess.run(command, check=True)
                mesh = read(path)
                self.assertGreater(len(cells(mesh, "quad")), 108)
                self.assertEqual(set(groups(mesh, "line")), {2, 3})
                # Every edge of exactly one quad, and no other, is listed as boundary.
                quads = cells(mesh, "quad")
                edges = np.sort(np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)]), axis=1)
                unique, count = np.unique(edges, axis=0, return_counts=True)
                lines = np.unique(np.sort(cells(mesh, "line"), axis=1), axis=0)
                np.testing.assert_array_equal(lines, unique[count == 1])


@unittest.skipIf(meshio is None, "meshio is not installed")
class PillowmeshReads(Case):
    """What meshio writes, in its default and in its other variants."""

    def test_meshio_files_of_every_format(self):
        variants = [
            ("a.mesh", "medit", {}),
            ("a.msh", "gmsh", {"binary": True}),
            ("b.msh", "gmsh", {"binary": False}),
            ("c.msh", "gmsh22", {"binary": True}),
            ("d.msh", "gmsh22", {"binary": False}),
            ("a.vtk", "vtk", {"binary": True}),
            ("b.vtk", "vtk", {"binary": False}),
            ("c.vtk", "vtk42", {"binary": True}),
            ("d.vtk", "vtk42", {"binary": False}),
            ("a.vtu", "vtu", {"binary": True, "compression": "zlib"}),
            ("b.vtu", "vtu", {"binary": True, "compression": None}),
            ("c.vtu", "vtu", {"binary": False}),
        ]
        for grid, kind, facet, count in ((QUADS, "quad", "line", 6), (HEXES, "hexahedron", "quad", 12)):
            ours = read(self.convert(grid, "source.vtu"))
            for name, file_format, options in variants:
                with self.subTest(kind=kind, name=name, options=options):
                    path = self.folder / name
                    name_of_groups = {"medit": "medit:ref", "gmsh": "gmsh:physical", "gmsh22": "gmsh:physical"}
                    blocks, tags = ours.cells, ours.cell_data["group"]
                    if file_format == "gmsh":  # it writes no entities to 4.1 files: one kind of cell, no groups
                        pairs = [(b, t) for b, t in zip(blocks, tags) if b.type == kind]
                        blocks, tags = [b for b, _ in pairs], [np.maximum(t, 1) for _, t in pairs]
                    data = {name_of_groups.get(file_format, "group"): tags}
                    if "gmsh" in file_format:  # it wants both
                        data["gmsh:geometrical"] = tags
                    mesh = meshio.Mesh(ours.points, blocks, cell_data=data)
                    meshio.write(path, mesh, file_format=file_format, **options)
                    back = read(self.convert(path, "back.vtk"))
                    self.assertEqual(len(cells(back, kind)), count)
                    # As text, meshio writes fewer digits than a double has.
                    np.testing.assert_allclose(back.points, ours.points, rtol=0 if options.get("binary") else 1e-15)
                    np.testing.assert_array_equal(cells(back, kind), cells(ours, kind))
                    if file_format != "gmsh":
                        self.assertEqual(sorted(groups(back, facet)), sorted(groups(ours, facet)))


@unittest.skipIf(shutil.which("gmsh") is None, "gmsh is not installed")
class GmshReads(Case):
    def gmsh(self, *arguments):
        done = subprocess.run(["gmsh", *map(str, arguments)], capture_output=True, text=True, timeout=60)
        text = done.stdout + done.stderr
        self.assertEqual(done.returncode, 0, text)
        for word in ("Error", "Warning"):
            self.assertNotIn(word, text)
        return text

    def test_files_without_complaint(self):
        for grid in (QUADS, HEXES):
            for name, options in VARIANTS:
                if name.endswith((".meshb", ".vtu")):  # formats that Gmsh does not know
                    continue
                with self.subTest(grid=grid, name=name, options=options):
                    path = self.convert(grid, name, options)
                    self.gmsh(path, "-check")
                    again = self.folder / "again.msh"
                    self.gmsh(path, "-0", "-save_all", "-format", "msh41", "-o", again)
                    mesh = read(self.convert(again, "back.vtk"))
                    kind, count = ("quad", 6) if grid == QUADS else ("hexahedron", 12)
                    self.assertEqual(len(cells(mesh, kind)), count)

    def test_physical_groups_survive_a_visit_to_gmsh(self):
        source = ROOT / "tests" / "data" / "lshape_v2.msh"
        for options in ([], ["--binary"], ["--gmsh-version", "2.2"], ["--gmsh-version", "2.2", "--binary"]):
            for version in ("msh41", "msh22"):
                for binary in ([], ["-bin"]):
                    with self.subTest(options=options, version=version, binary=binary):
                        path = self.convert(source, "a.msh", options)
                        again = self.folder / "again.msh"
                        self.gmsh(path, "-0", "-format", version, *binary, "-o", again)
                        mesh = read(self.convert(again, "back.vtk"))
                        self.assertEqual(len(cells(mesh, "quad")), 108)
                        self.assertEqual([list(groups(mesh, "line")).count(t) for t in (2, 3)], [10, 34])


@unittest.skipIf(shutil.which("ffmedit") is None or shutil.which("xvfb-run") is None, "ffmedit or xvfb is not installed")
class MeditReads(Case):
    """Medit itself (Debian: freefem++), whose format .sol is; it shows a window, for which there is a virtual screen."""

    def told(self, name):
        # It stays open until it is ended.
        screen = ["xvfb-run", "-a", "-s", "-screen 0 640x480x24", "timeout", "4", "ffmedit", "-d", "-v", name]
        done = subprocess.run(screen, cwd=self.folder, capture_output=True, text=True, timeout=60)
        return done.stdout + done.stderr

    def test_meshes_and_metrics_as_pairs_in_plane_and_space_text_and_binary(self):
        for spec, formula, size, count in ((QUADS, "h1 = 0.1 + x; h2 = 0.3; theta = y", 3, 12),
                                           (HEXES, "h1 = 0.1 + x; h2 = 0.3; h3 = 1; theta = y", 6, 36)):
            for mesh, sol in (("pair.mesh", "pair.sol"), ("binary.meshb", "binary.solb")):
                with self.subTest(spec=spec, mesh=mesh):
                    self.convert(spec, mesh)
                    path = self.folder / sol
                    subprocess.run([COMMAND, "metric", spec, "--metric", formula, "-o", str(path)], check=True)
                    text = self.told(mesh)
                    self.assertIn(f"Reading {sol}", text)
                    self.assertRegex(text, rf"Solutions\s+{count}\n")
                    self.assertRegex(text, rf"type=1, size={size}\n")  # one field, of so many numbers
                    self.assertIn("typtab[0]=3", text)  # a symmetric tensor
                    path.unlink()


if __name__ == "__main__":
    unittest.main()
