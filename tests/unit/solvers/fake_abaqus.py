"""A command that behaves as Abaqus does, for the tests: ``fake_abaqus.py MODE [FILE] job=…``.

Its texts are in the layout of Abaqus' own files; lines about the licence are quoted from jobs of
real users.
"""

import subprocess
import sys
import time
from pathlib import Path

QUEUED = '"standard" license request queued for the License Server on lic.example.\n'
DENIED = """Licensed number of users already reached.
FlexNet Licensing error:-4,132
Number of requested licenses: 5
This may be due to insufficient licenses.
Abaqus Error: Error checking out Abaqus license.
Abaqus/Analysis exited with errors
"""
GRANTED = """Abaqus License Manager checked out the following licenses:
Abaqus/Standard checked out 5 tokens from Flexnet server lic.example.
<55 out of 60 licenses remain available>.
Begin Analysis Input File Processor
"""
ADJUSTED = (
    " ***WARNING: For *tie pair (FEET), adjusted nodes with very small adjustments were \n"
    "             not printed. Specify *preprint,model=yes for complete printout.\n\n"
)
INACTIVE = (
    " ***WARNING: DEGREE OF FREEDOM 4 IS NOT ACTIVE IN THIS MODEL AND CAN NOT BE RESTRAINED\n\n"
)
IGNORED = (
    " ***WARNING: THE PARAMETER HOST ELSET IS NOT RELEVANT HERE AND WILL BE\n"
    "             IGNORED\n\n"
)
CUT_OFF = """
 ***ERROR: TIME INCREMENT REQUIRED IS LESS THAN THE MINIMUM SPECIFIED

 ***ERROR: THE ANALYSIS HAS BEEN TERMINATED DUE TO PREVIOUS ERRORS. ALL OUTPUT 
           REQUESTS HAVE BEEN WRITTEN FOR THE LAST CONVERGED INCREMENT.
"""  # noqa: W291 - as Abaqus writes it


def table(name, column, value):
    return f"""

                                       N O D E   O U T P U T


   THE FOLLOWING TABLE IS PRINTED FOR NODES BELONGING TO NODE SET TYRE_{name}

       NODE FOOT-   {column:<4}
            NOTE

     297844      {value: .4E}
"""


def increments(parts, load=5000.0):
    """Print U2 of the rim and RF2 of the road for parts of the load; a tyre that softens."""
    text = ""
    for number, part in enumerate(parts, 1):
        text += f"""
                                INCREMENT    {number:2d} SUMMARY


 TIME INCREMENT COMPLETED  5.000E-02,  FRACTION OF STEP COMPLETED  {part:.3E}
 STEP TIME COMPLETED       {part:.3E},  TOTAL TIME COMPLETED        {part:.3E}
"""
        text += table("RIM-REF", "U2", -(18.0 * part + 2.0 * part**2))
        text += table("GROUND-REF", "RF2", part * load)
    return text


def write(kind, text):
    (Path.cwd() / f"{job}.{kind}").write_text(text)


def finish(dat, load=5000.0):
    print(GRANTED)
    write("dat", dat + increments((0.02, 0.5, 1.0), load))
    write("msg", " NOTHING TO SAY\n")
    write("sta", " THE ANALYSIS HAS COMPLETED SUCCESSFULLY\n")


mode = sys.argv[1]
job = next(word.split("=")[1] for word in sys.argv if word.startswith("job="))
deck = Path(f"{job}.inp").read_text()
assert "*EMBEDDED ELEMENT" in deck
assert "interactive" in sys.argv

if mode == "ok":
    finish(ADJUSTED + INACTIVE)
elif mode == "denied":
    print(DENIED)
    sys.exit(1)
elif mode == "queued":
    while True:
        print(QUEUED, flush=True)
        time.sleep(0.2)
elif mode == "queued a little":
    print(QUEUED, flush=True)
    time.sleep(0.5)
    print(GRANTED, flush=True)
    time.sleep(0.2)
    finish("")
elif mode == "hangs with a child":
    write("dat", increments((0.02, 0.5)) + "   THE FOLLOWING TABLE IS PRI")
    child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
    Path(sys.argv[2]).write_text(str(child.pid))
    time.sleep(600)
elif mode == "leaves a child":
    child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
    Path(sys.argv[2]).write_text(str(child.pid))
    finish("")
elif mode == "ignores a parameter":
    finish(IGNORED)
elif mode == "ignores a parameter and goes on":
    write("dat", IGNORED)
    time.sleep(600)
elif mode == "does not converge":
    print(GRANTED)
    write("dat", INACTIVE + increments((0.02, 0.5)))
    write("msg", CUT_OFF)
    write("sta", " THE ANALYSIS HAS NOT BEEN COMPLETED\n")
elif mode == "syntax error":
    write("dat", " ***ERROR: UNKNOWN ELEMENT TYPE C3D8HH\n\n ***NOTE: DUE TO AN INPUT ERROR\n")
    print("Abaqus Error: Analysis Input File Processor exited with an error.")
    sys.exit(1)
elif mode == "wrong load":
    finish("", load=4000.0)
elif mode == "says nothing":
    sys.exit(9)
else:
    raise SystemExit(f"unknown mode {mode}")
