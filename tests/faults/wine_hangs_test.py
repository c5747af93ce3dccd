#!/usr/bin/env python3
"""A Wine that never answers: wine_hangs_test.py TEGUMENT REPOSITORY. A minute passes before it is given up, so this is not in the suite."""

import os
import subprocess
import time

from harness import Faults, MACHINE, main


class Wine(Faults):
    def test_that_hangs_is_given_up_after_a_minute_and_ended(self):
        programs = self.folder / "programs"
        programs.mkdir()
        wine = programs / "wine"
        seconds = 100_000 + os.getpid()  # by which its process is found
        wine.write_text(f"#!/bin/sh\nexec sleep {seconds}\n", encoding="ascii")
        wine.chmod(0o755)
        library = self.folder / "d3dcompiler_47.dll"
        library.write_bytes(b"MZ")
        prefix = self.folder / "cache/wine"
        prefix.mkdir(parents=True, exist_ok=True)
        (prefix / "system.reg").write_text("", encoding="ascii")
        began = time.monotonic()
        ran = self.checked("Beckmann", "--target", "fx_5_0", environment={"PATH": f"{programs}:{os.environ['PATH']}", "DISPLAY": ":none",
                                                                         "TEGUMENT_D3DCOMPILER": str(library)})
        self.assertIn(ran.returncode, (1, MACHINE), ran.stderr)
        self.assertIn("TG3104", ran.stdout + ran.stderr)
        self.assertIn("no answer", ran.stdout + ran.stderr)
        self.assertGreater(time.monotonic() - began, 55, "Wine that makes its folder takes half a minute")
        self.assertLess(time.monotonic() - began, 150)
        self.assertEqual(subprocess.run(["pgrep", "-f", f"^sleep {seconds}$"], capture_output=True, text=True, check=False).stdout, "", "it still runs")
        self.assertEqual(self.leftovers(), [])


if __name__ == "__main__":
    main()
