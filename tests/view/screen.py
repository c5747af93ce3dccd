"""A display of its own with real input events, and what is seen on it. Needs Xvfb and python3-xlib."""

import os
import shutil
import struct
import subprocess
import sys
import time
import zlib

sys.path.append("/usr/lib/python3/dist-packages")  # where Debian has it, whichever Python runs this

try:
    from Xlib import X, XK, display as xdisplay
    from Xlib.ext import xtest
except ImportError:
    xdisplay = None


def missing():
    """What this machine lacks; empty: nothing."""
    if shutil.which("Xvfb") is None:
        return "Xvfb is not installed (Debian package xvfb)"
    if xdisplay is None:
        return "python3-xlib is not installed (Debian package python3-xlib)"
    return ""


class Picture:
    """Red, green and blue of the whole screen."""

    def __init__(self, width, height, pixels):
        self.width, self.height, self.pixels = width, height, pixels

    def __eq__(self, other):
        return self.pixels == other.pixels

    def mean(self):
        return sum(self.pixels) / len(self.pixels)

    def share_apart(self, other, limit=8):
        """Share of values that differ by more than `limit` of 255."""
        apart = sum(abs(a - b) > limit for a, b in zip(self.pixels, other.pixels))
        return apart / len(self.pixels)

    def save(self, path):
        rows = b"".join(b"\0" + self.pixels[y * self.width * 3:(y + 1) * self.width * 3] for y in range(self.height))
        chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        header = struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)
        with open(path, "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Screen:
    def __init__(self, width, height):
        self.width, self.height = width, height
        reader, writer = os.pipe()
        command = ["Xvfb", "-displayfd", str(writer), "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp", "-noreset"]
        self.server = subprocess.Popen(command, pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as numbers:
            self.name = ":" + numbers.readline().strip()
        self.display = xdisplay.Display(self.name)
        self.root = self.display.screen().root

    def close(self):
        self.display.close()
        self.server.terminate()
        self.server.wait()

    def window(self):
        """The only top-level window with a name, if it is there."""
        for window in self.root.query_tree().children:
            if window.get_wm_name() is not None or self._utf8_name(window):
                return window
        return None

    def _utf8_name(self, window):
        value = window.get_full_property(self.display.intern_atom("_NET_WM_NAME"), self.display.intern_atom("UTF8_STRING"))
        return value.value.decode() if value else ""

    def title(self):
        window = self.window()
        return self._utf8_name(window) if window else ""

    def move(self, x, y):
        xtest.fake_input(self.display, X.MotionNotify, x=x, y=y)
        self.display.sync()

    def drag(self, start, end, button=1):
        self.move(*start)
        xtest.fake_input(self.display, X.ButtonPress, button)
        for step in range(1, 5):
            self.move(start[0] + (end[0] - start[0]) * step // 4, start[1] + (end[1] - start[1]) * step // 4)
            time.sleep(0.05)
        xtest.fake_input(self.display, X.ButtonRelease, button)
        self.display.sync()

    def wheel(self, up):
        for kind in (X.ButtonPress, X.ButtonRelease):
            xtest.fake_input(self.display, kind, 4 if up else 5)
        self.display.sync()

    def press(self, name):
        code = self.display.keysym_to_keycode(XK.string_to_keysym(name))
        xtest.fake_input(self.display, X.KeyPress, code)
        xtest.fake_input(self.display, X.KeyRelease, code)
        self.display.sync()

    def resize(self, width, height):
        self.window().configure(width=width, height=height)
        self.display.sync()

    def grab(self):
        raw = self.root.get_image(0, 0, self.width, self.height, X.ZPixmap, 0xFFFFFFFF).data
        pixels = bytearray(self.width * self.height * 3)
        pixels[0::3], pixels[1::3], pixels[2::3] = raw[2::4], raw[1::4], raw[0::4]  # bytes are blue, green, red, unused
        return Picture(self.width, self.height, bytes(pixels))
