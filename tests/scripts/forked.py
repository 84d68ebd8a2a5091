"""Runs a script in Python as a command in a copy of this process, which has loaded what all pictures need already."""
import os
import runpy
import subprocess
import sys
import tempfile
import traceback

import matplotlib.pyplot  # noqa: F401


def status_of(script):
    try:
        runpy.run_path(str(script), run_name="__main__")
    except SystemExit as ended:
        return ended.code or 0
    except BaseException:  # as an interpreter does
        traceback.print_exc()
        return 1
    return 0


def run(script, *arguments):
    """What subprocess.run(..., capture_output=True, text=True) gives; the script ends by sys.exit with a number."""
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        sys.stdout.flush()
        sys.stderr.flush()
        child = os.fork()
        if child == 0:
            os.dup2(out.fileno(), 1)
            os.dup2(err.fileno(), 2)
            sys.argv = [str(script), *map(str, arguments)]
            status = status_of(script)
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(status)
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        out.seek(0)
        err.seek(0)
        return subprocess.CompletedProcess(sys.argv, status, out.read(), err.read())
