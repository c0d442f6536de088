"""``nptcs fe-export``: solve one tyre and its spoke and write them for ParaView."""

from __future__ import annotations

import argparse
import json

from nptcs.arguments import add_command, output_folder
from nptcs.commands.fe_picture import SolvedTyre, add_design, solvable, solved

PRESSED_STEPS, PULLED_STEPS = 10, 8


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "fe-export",
        "write a finite element tyre and its spoke for ParaView",
        "Solve one tyre with fe_tyre, and its spoke compressed by 20 mm and pulled by 4 mm. Writes "
        "tyre.vtu; spoke_0000.vtu and so on; spoke.pvd, whose time is the band's radial "
        "displacement in mm; and design.json, which names design and materials. Needs the "
        "extra nptcs[paraview]. The defaults are the published fiducial design; the ply is "
        "that of your card.",
        "nptcs fe-export paraview --thickness 2.4 --angle 30",
    )
    parser.add_argument(
        "folder", metavar="FOLDER", type=output_folder, help="output folder, created if needed"
    )
    add_design(parser)
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Solve and write."""
    from nptcs.fe.output.bricks import spoke_bricks, tyre_bricks
    from nptcs.fe.output.vtu import require_vtk, write_pvd, write_vtu
    from nptcs.fe.spoke.pull import COMPRESSION_MM, TENSION_MM, walk
    from nptcs.files import write_text

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
    write_text(arguments.folder / "design.json", _design(arguments, case))
    write_pvd(arguments.folder / "spoke.pvd", times, files)
    print(
        f"{arguments.folder}: tyre.vtu ({len(bricks.position)} bricks), spoke.pvd with "
        f"{len(files)} states"
    )
    return 0


def _design(arguments: argparse.Namespace, case: SolvedTyre) -> str:
    """Write what the files show: the design, its stiffness and its materials."""
    content = {
        "spacing_mm": arguments.spacing,
        "thickness_mm": arguments.thickness,
        "angle_deg": arguments.angle,
        "spoke_c10_mpa": arguments.spoke_c10,
        "shear_band_c10_mpa": arguments.band_c10,
        "load_n": arguments.load,
        "displacement_mm": case.state.rise_mm,
        "materials": case.materials,
        "ply": case.spoke.design.ply,
    }
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"
