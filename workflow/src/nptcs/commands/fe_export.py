"""``nptcs fe-export``: solve one tyre and its spoke and write them for ParaView."""

from __future__ import annotations

import argparse
from pathlib import Path

from nptcs.commands.fe_picture import add_design, solvable, solved

PRESSED_STEPS, PULLED_STEPS = 10, 8


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "fe-export",
        help="write a finite element tyre and its spoke for ParaView",
        description="Solve one tyre with fe_tyre and the published ply constants, and its spoke "
        "pressed by 20 mm and pulled by 4 mm. Writes tyre.vtu, spoke_0000.vtu and so on, and "
        "spoke.pvd, whose time is the band's radial displacement in mm. Needs the extra "
        "nptcs[paraview]. The defaults are the published fiducial design.",
    )
    parser.add_argument(
        "folder", metavar="FOLDER", type=Path, help="output folder, created if needed"
    )
    add_design(parser)
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Solve and write."""
    from nptcs.fe.output.bricks import spoke_bricks, tyre_bricks
    from nptcs.fe.output.vtu import require_vtk, write_pvd, write_vtu
    from nptcs.fe.spoke.pull import COMPRESSION_MM, TENSION_MM, walk

    require_vtk()
    with solvable():
        case = solved(arguments)
        bricks = tyre_bricks(case.tyre, case.dimensions, case.state, case.spoke)
        pressed = walk(case.spoke, -COMPRESSION_MM, PRESSED_STEPS)
        pulled = walk(case.spoke, TENSION_MM, PULLED_STEPS)
    periods = float(case.spoke.design.plates)
    write_vtu(
        arguments.folder / "tyre.vtu",
        bricks,
        {"load_n": arguments.load, "rise_mm": case.state.rise_mm, "periods": periods},
    )
    times, files = [], []
    for number, state in enumerate([*pressed[:0:-1], *pulled]):
        times.append(float(state.motion[0]))
        files.append(f"spoke_{number:04d}.vtu")
        write_vtu(
            arguments.folder / files[-1],
            spoke_bricks(case.spoke, state),
            {"u_r_mm": times[-1], "force_n": float(state.force[0]), "periods": periods},
        )
    write_pvd(arguments.folder / "spoke.pvd", times, files)
    print(
        f"{arguments.folder}: tyre.vtu ({len(bricks.position)} bricks), spoke.pvd with "
        f"{len(files)} states"
    )
    return 0
