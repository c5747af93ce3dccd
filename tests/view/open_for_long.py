#!/usr/bin/env python3
"""A viewer that stays open: open_for_long.py PROGRAM REPOSITORY MINUTES. Each second its effect changes on disk and is read again, every tenth time to one
that does not compile; between, keys, drags, the wheel and new sizes of the window. What the process holds is written down each minute, at one size of the
window: memory, and the part of it that no file backs (the rest is code of drivers and compilers, read as it is needed), open files, threads. Exit code 1
where it ended, stopped to answer, said what it should not, or holds more at the end than after its first tenth.
"""

import os
import pathlib
import random
import shutil
import sys
import time

MINUTES = float(sys.argv[3])
sys.argv[1:] = [str(pathlib.Path(argument).resolve()) for argument in sys.argv[1:3]]
import session  # noqa: E402, reads the same arguments
import screen as screens  # noqa: E402

MORE_MEMORY = 24  # MiB, as Load.* allows: shaders that are read again stay in the driver's own cache
EFFECT = """float4 tint = { %.3f, %.3f, 0.5, 1 };
float4x4 wvp : WORLDVIEWPROJECTION;
struct V { float4 p : SV_Position; float3 n : TEXCOORD0; };
V VS(float4 p : POSITION, float3 n : NORMAL) { V v; v.p = mul(p, wvp); v.n = n; return v; }
float4 PS(V v) : SV_Target { return tint * (0.4 + 0.6 * saturate(v.n.%s))%s; }
technique T { pass P { VertexShader = compile vs_4_0 VS(); PixelShader = compile ps_4_0 PS(); } }
"""


def effect(dice, broken):
    """One of forty texts, so that most of them were compiled before, as when somebody edits."""
    return EFFECT % (dice.randrange(5) / 4, dice.randrange(4) / 3, dice.choice("xy"), " * nowhere" if broken else "")


def put(view, text):
    """Whole at once: of a file that is cut and then written, a viewer may see the part that is there."""
    (view.folder / "new.fx").write_text(text)
    os.replace(view.folder / "new.fx", view.folder / "long.fx")


def held(view):
    """At one size of the window: what larger ones take is no growth."""
    view.screen.resize(session.SIZE, session.SIZE)
    time.sleep(1)
    process = view.process
    status = dict(line.split(":", 1) for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines() if ":" in line)
    return {"MiB": int(status["VmRSS"].split()[0]) / 1024, "own": int(status["RssAnon"].split()[0]) / 1024,
            "files": len(os.listdir(f"/proc/{process.pid}/fd")), "threads": int(status["Threads"])}


def act(view, dice):
    """What a hand does within a second. Not: q, Escape, s, w, c, which end, write or take the clipboard."""
    screen = view.screen
    kind = dice.randrange(6)
    if kind < 2:
        screen.drag((160, 160), (dice.randrange(40, 280), dice.randrange(40, 280)), button=dice.choice((1, 3)))
    elif kind == 2:
        screen.wheel(up=dice.random() < 0.5)
    elif kind == 3:
        screen.press(dice.choice(("Right", "Down", "i", "r", "t")))
    elif kind == 4:
        screen.resize(dice.randrange(200, 600), dice.randrange(200, 320))
    else:
        screen.press("r")


def stay(view):
    dice, began, rows, rounds = random.Random(23), time.monotonic(), [], 0
    next_row, end = began, began + 60 * MINUTES
    print("| minutes | reloads | memory, MiB | of it no file's | open files | threads |\n|---|---|---|---|---|---|", flush=True)
    while (now := time.monotonic()) < end:
        put(view, effect(dice, rounds % 10 == 9))
        act(view, dice)
        rounds += 1
        if now >= next_row:
            rows.append(held(view))
            row = rows[-1]
            print(f"| {(now - began) / 60:.1f} | {rounds} | {row['MiB']:.1f} | {row['own']:.1f} | {row['files']} | {row['threads']} |", flush=True)
            next_row += min(60, 6 * MINUTES)
        if view.process.poll() is not None:
            raise SystemExit(f"the viewer ended with {view.process.returncode}:\n{view.said()[-3000:]}")
        time.sleep(max(0, 1 - (time.monotonic() - now)))
    put(view, effect(dice, False))
    view.screen.press("Escape")
    view.title("long.fx T [")
    rows.append(held(view))
    return rows, rounds


def main():
    if screens.missing():
        print("skipped: " + screens.missing())
        return 77
    view = session.View(("long.fx", "--mesh", "ball.obj"), (("long.fx", effect(random.Random(1), False)),))
    try:
        view.title("long.fx T [")
        rows, rounds = stay(view)
        said = view.said()
    finally:
        view.end()
        shutil.rmtree(view.folder)
    first, last = rows[max(1, len(rows) // 10)], rows[-1]
    other = [line for line in said.splitlines() if ("error TG" in line and "TG3001" not in line) or "validation:" in line]
    print(f"{rounds} reloads; {said.count('error TG3001')} times an effect that does not compile was said; "
          f"memory {first['MiB']:.1f} to {last['MiB']:.1f} MiB, of it no file's {first['own']:.1f} to {last['own']:.1f}, "
          f"open files {first['files']} to {last['files']}; exit code {view.process.returncode}")
    print("\n".join(other[:5]), end="")
    grew = last["MiB"] > first["MiB"] + MORE_MEMORY or last["files"] > first["files"] or last["threads"] > first["threads"]
    return 1 if grew or other or view.process.returncode != 0 else 0


if __name__ == "__main__":
    sys.exit(main())
