"""`python -m tegument ARGUMENTS`: the program that the wheel brings, with its exit code."""

import os
import subprocess
import sys

from . import _PROGRAM

sys.exit(subprocess.run([_PROGRAM, *sys.argv[1:]], env={**os.environ, "TEGUMENT_PYTHON": sys.executable}, check=False).returncode)
