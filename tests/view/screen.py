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
    from Xlib import X, XK, display as xdisplay, protocol
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


def read_png(path):
    """Of ours: eight bits, red, green and blue, with an alpha that is left out or without, nothing interlaced."""
    data, at, packed, size = path.read_bytes(), 8, b"", (0, 0)
    each = 4 if data[25] == 6 else 3
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        size = struct.unpack(">II", body[:8]) if kind == b"IHDR" else size
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    width, height = size
    raw, rows, above = zlib.decompress(packed), [], bytes(width * each)
    for y in range(height):
        way, row = raw[y * (width * each + 1)], bytearray(raw[y * (width * each + 1) + 1:(y + 1) * (width * each + 1)])
        for x in range(width * each):
            left, up, corner = (row[x - each], above[x], above[x - each]) if x >= each else (0, above[x], 0)
            if way == 1:
                row[x] = (row[x] + left) & 255
            elif way == 2:
                row[x] = (row[x] + up) & 255
            elif way == 3:
                row[x] = (row[x] + (left + up) // 2) & 255
            elif way == 4:
                guess = left + up - corner
                near = min((left, up, corner), key=lambda v: abs(guess - v))
                row[x] = (row[x] + near) & 255
        above = bytes(row)
        if each == 4:
            del row[3::4]
        rows.append(bytes(row))
    return Picture(width, height, b"".join(rows))


def begin(command, **how):
    """A process that ends with this one, however that ends, and keeps none of its pipes open."""
    return subprocess.Popen(["setpriv", "--pdeathsig", "KILL", *command], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, **how)


class Screen:
    def __init__(self, width, height, scale=1):
        """`scale` 2: of a screen with twice the usual number of pixels to the inch."""
        self.width, self.height = width, height
        reader, writer = os.pipe()
        command = ["Xvfb", "-displayfd", str(writer), "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp", "-noreset"]
        self.server = begin(command, pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as numbers:
            self.name = ":" + numbers.readline().strip()
        self.display = xdisplay.Display(self.name)
        self.root = self.display.screen().root
        if scale != 1:  # where desktops write it, and GLFW reads it
            resources = f"Xft.dpi:\t{96 * scale:g}\n".encode()
            self.root.change_property(self.display.intern_atom("RESOURCE_MANAGER"), self.display.intern_atom("STRING"), 8, resources)
            self.display.sync()

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

    def drag(self, start, end, button=1, held=()):
        self.move(*start)
        codes = [self.display.keysym_to_keycode(XK.string_to_keysym(key)) for key in held]
        for code in codes:
            xtest.fake_input(self.display, X.KeyPress, code)
        xtest.fake_input(self.display, X.ButtonPress, button)
        for step in range(1, 5):
            self.move(start[0] + (end[0] - start[0]) * step // 4, start[1] + (end[1] - start[1]) * step // 4)
            time.sleep(0.05)
        xtest.fake_input(self.display, X.ButtonRelease, button)
        for code in reversed(codes):
            xtest.fake_input(self.display, X.KeyRelease, code)
        self.display.sync()

    def click(self, x, y, button=1):
        """Slow enough for a program that looks at the mouse once a frame."""
        self.move(x, y)
        time.sleep(0.1)
        xtest.fake_input(self.display, X.ButtonPress, button)
        self.display.sync()
        time.sleep(0.1)
        xtest.fake_input(self.display, X.ButtonRelease, button)
        self.display.sync()

    KEYS = {"_": "underscore", " ": "space", "/": "slash", ".": "period", "-": "minus", ":": "colon", "~": "asciitilde", "=": "equal", "[": "bracketleft", "]": "bracketright"}

    def type(self, text):
        for letter in text:
            shifted = letter.isupper() or letter in "_:~"
            self.press(self.KEYS.get(letter, letter), *(("Shift_L",) if shifted else ()))

    def wheel(self, up):
        for kind in (X.ButtonPress, X.ButtonRelease):
            xtest.fake_input(self.display, kind, 4 if up else 5)
        self.display.sync()

    def press(self, name, *held):
        """A key, with others held."""
        codes = [self.display.keysym_to_keycode(XK.string_to_keysym(key)) for key in (*held, name)]
        for code in codes:
            xtest.fake_input(self.display, X.KeyPress, code)
        for code in reversed(codes):
            xtest.fake_input(self.display, X.KeyRelease, code)
        self.display.sync()
        time.sleep(0.03)  # GLFW takes a key that comes again within 20 ms for one that is held

    def answer(self, kind, seconds):
        """The next event of this kind that is for a window of ours."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            while self.display.pending_events():
                event = self.display.next_event()
                if event.type == kind:
                    return event
            time.sleep(0.02)
        raise AssertionError("the program does not answer")

    def _own_window(self):
        return self.root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)

    def clipboard(self, seconds=10):
        """The text that the program has copied."""
        window, atom = self._own_window(), self.display.intern_atom
        window.convert_selection(atom("CLIPBOARD"), atom("UTF8_STRING"), atom("TEGUMENT_TEXT"), X.CurrentTime)
        self.display.flush()
        event = self.answer(X.SelectionNotify, seconds)
        value = window.get_full_property(atom("TEGUMENT_TEXT"), X.AnyPropertyType) if event.property else None
        window.destroy()
        return value.value.decode() if value else ""

    def drop(self, *paths, seconds=10):
        """Files from a file manager, by the XDND protocol, version 5."""
        window, target, atom = self._own_window(), self.window(), self.display.intern_atom
        kind, selection = atom("text/uri-list"), atom("XdndSelection")
        window.set_selection_owner(selection, X.CurrentTime)

        def send(name, *data):
            values = ([window.id] + list(data) + [0] * 5)[:5]
            event = protocol.event.ClientMessage(window=target, client_type=atom(name), data=(32, values))
            target.send_event(event)
            self.display.flush()

        send("XdndEnter", 5 << 24, kind)
        send("XdndPosition", 0, (40 << 16) | 40, X.CurrentTime, atom("XdndActionCopy"))
        send("XdndDrop", 0, X.CurrentTime)
        asked = self.answer(X.SelectionRequest, seconds)
        text = "".join(f"file://{path}\r\n" for path in paths)
        asked.requestor.change_property(asked.property, kind, 8, text.encode())
        given = protocol.event.SelectionNotify(time=asked.time, requestor=asked.requestor, selection=selection, target=asked.target,
                                               property=asked.property)
        asked.requestor.send_event(given)
        self.display.flush()
        time.sleep(0.5)  # the program says that it has finished; nobody listens
        window.destroy()
        self.display.flush()

    def resize(self, width, height):
        self.window().configure(width=width, height=height)
        self.display.sync()

    def grab(self):
        raw = self.root.get_image(0, 0, self.width, self.height, X.ZPixmap, 0xFFFFFFFF).data
        pixels = bytearray(self.width * self.height * 3)
        pixels[0::3], pixels[1::3], pixels[2::3] = raw[2::4], raw[1::4], raw[0::4]  # bytes are blue, green, red, unused
        return Picture(self.width, self.height, bytes(pixels))
