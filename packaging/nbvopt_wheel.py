"""Builds the wheel of the Python module: CMake builds and installs it, and this packs what it put
in place. PEP 517 says which functions pip calls, PEP 427 what a wheel is, PEP 621 what pyproject.toml
holds. The standard library of Python 3.11 is all that it needs."""

import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "pip"
# What the module does without; its build finds all else among Debian's packages.
WITHOUT = ("CLI", "STUDY", "TESTS", "BENCHMARKS")
TARGETS = ("nbvopt_python", "nbvopt_bindings", "nbvopt_sim_bindings")


def get_requires_for_build_wheel(config_settings=None):
    return []


def run(*command):
    subprocess.run([str(part) for part in command], cwd=ROOT, check=True)


def build_into(prefix):
    """Builds the module for the Python that runs this, and installs it into `prefix`."""
    try:
        run("cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            "-DNBVOPT_UNITY=ON", f"-DPython_EXECUTABLE={sys.executable}", "-DNBVOPT_PYTHON_DIR=site",
            "-DNBVOPT_PYTHON_EXAMPLES_DIR=examples",
            *(f"-DNBVOPT_BUILD_{part}=OFF" for part in WITHOUT))  # fmt: skip
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", "2")  # some files take a gigabyte
        run("cmake", "--build", BUILD, "-j", jobs, "--target", *TARGETS)
        run("cmake", "--install", BUILD, "--prefix", prefix, "--component", "python", "--strip")
    except (OSError, subprocess.CalledProcessError) as error:
        raise SystemExit(
            f"nbvopt cannot be built: {error}. It needs the Debian packages of packages-planner.txt "
            "and packages.txt, which `make packages` installs"
        ) from error


def project():
    return tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


def version():
    found = re.search(r"project\(nbvopt VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())
    return found.group(1)


def metadata():
    about = project()
    lines = [
        "Metadata-Version: 2.1",
        f"Name: {about['name']}",
        f"Version: {version()}",
        f"Summary: {about['description']}",
        f"Requires-Python: {about['requires-python']}",
        *(f"Requires-Dist: {needed}" for needed in about["dependencies"]),
    ]
    for extra, needs in about["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f'Requires-Dist: {needed}; extra == "{extra}"' for needed in needs]
    return "\n".join([*lines, ""])


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def info_folder():
    return f"nbvopt-{version()}.dist-info"


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = Path(metadata_directory) / info_folder()
    folder.mkdir()
    (folder / "METADATA").write_text(metadata())
    return info_folder()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    info = info_folder()
    name = f"nbvopt-{version()}-{tag()}.whl"
    with tempfile.TemporaryDirectory() as prefix:
        build_into(prefix)
        site = Path(prefix) / "site"
        files = {
            path.relative_to(site).as_posix(): path.read_bytes()
            for path in sorted(site.rglob("*"))
            if path.is_file()
        }
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: nbvopt_wheel\nRoot-Is-Purelib: false\nTag: {tag()}\n"
    ).encode()
    record = ""
    for path, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{path},sha256={digest},{len(content)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            entry = zipfile.ZipInfo(path)  # 1980: the same files make the same wheel
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, content)
    return name
