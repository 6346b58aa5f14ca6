"""The wheel that `pip install .` packs of what CMake built: whole, and as pip wants it."""

import base64
import csv
import hashlib
import importlib.util
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

import nbvopt

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILT = pathlib.Path(nbvopt.__file__).parents[1]


def backend():
    spec = importlib.util.spec_from_file_location(
        "nbvopt_wheel", ROOT / "packaging" / "nbvopt_wheel.py"
    )
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def install_built(prefix) -> None:
    """What CMake would, from the build that is tested."""
    site = pathlib.Path(prefix) / "site"
    shutil.copytree(BUILT / "nbvopt", site / "nbvopt", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(BUILT / "nbvopt_client.py", site)


class WheelTest(unittest.TestCase):
    def test_holds_all_with_its_digests(self):
        wheel = backend()
        wheel.build_into = install_built
        with tempfile.TemporaryDirectory() as folder:
            name = wheel.build_wheel(folder)
            version = nbvopt.__version__
            self.assertEqual(name, f"nbvopt-{version}-{wheel.tag()}.whl")
            with zipfile.ZipFile(pathlib.Path(folder) / name) as archive:
                info = f"nbvopt-{version}.dist-info"
                names = archive.namelist()
                self.assertLess({"nbvopt/__init__.py", "nbvopt/_core.pyi", "nbvopt/py.typed",
                                 "nbvopt/v1/planner_pb2.pyi", "nbvopt_client.py",
                                 f"{info}/METADATA", f"{info}/LICENSE"}, set(names))  # fmt: skip
                self.assertIn("Requires-Dist: numpy\n", archive.read(f"{info}/METADATA").decode())
                record = archive.read(f"{info}/RECORD").decode().splitlines()
                self.assertEqual([path for path, *_ in csv.reader(record)], names)
                for path, digest, size in csv.reader(record[:-1]):
                    content = archive.read(path)
                    hashed = base64.urlsafe_b64encode(hashlib.sha256(content).digest())
                    self.assertEqual(digest, "sha256=" + hashed.rstrip(b"=").decode(), path)
                    self.assertEqual(int(size), len(content))
                archive.extractall(pathlib.Path(folder) / "site")
            found = subprocess.run(
                [sys.executable, "-c", "import nbvopt; print(nbvopt.Robot(), nbvopt.__file__)"],
                env={"PYTHONPATH": f"{folder}/site"}, capture_output=True, text=True, check=True,
            )  # fmt: skip
            self.assertEqual(found.stdout, f"Robot() {folder}/site/nbvopt/__init__.py\n")


if __name__ == "__main__":
    unittest.main()
