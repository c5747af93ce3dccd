#!/usr/bin/env python3
"""How a batch grows: with the shards on this machine, with the inputs, and, by a stated model, with 10,000 inputs and 100 nodes.

    batch_growth.py measure TEGUMENT OUT.json [--inputs 96] [--cores 0,1]
    batch_growth.py plot OUT.json [OUT.json ...] FOLDER

`measure` prepares balls of 16,000 to 24,000 triangles, a shard to a core, and the same inputs with the command that does least, `info`, whose
time is what a batch adds. `plot` draws speed-up, overhead, and model beside measurement, and prints the tables of docs/design/batches.md.
"""

import argparse
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

SHARDS = (1, 2, 4, 8, 16)
EFFECT = "float gValue = 1;\n"


def write_ball(file, rings):
    lines, columns = [], 2 * rings
    for i in range(rings + 1):
        for j in range(columns):
            theta, phi = math.pi * i / rings, 2 * math.pi * j / columns
            lines.append(f"v {math.sin(theta) * math.cos(phi):.6f} {math.cos(theta):.6f} {math.sin(theta) * math.sin(phi):.6f}")
    for i in range(rings):
        for j in range(columns):
            a, b = i * columns + j + 1, i * columns + (j + 1) % columns + 1
            lines += [f"f {a} {a + columns} {b}", f"f {b} {a + columns} {b + columns}"]
    file.write_text("\n".join(lines) + "\n", encoding="ascii")


def run_shards(program, folder, results, shards, cores, command):
    """Seconds by the clock until the last shard has ended; each has one core."""
    inputs = "*.fx" if command[0] == "info" else "*.obj"
    begun = time.monotonic()
    running = [
        subprocess.Popen(["taskset", "-c", str(cores[i % len(cores)]), program, "batch", "-i", inputs, "--results", results, "--shard",
                          f"{i + 1}/{shards}", "--", *command], cwd=folder, stdout=subprocess.DEVNULL) for i in range(shards)
    ]
    if any(process.wait() != 0 for process in running):
        sys.exit(f"{' '.join(command)} in {shards} shards failed")
    return time.monotonic() - begun


def records(folder, results):
    return [json.loads(file.read_text()) for file in (folder / results / "records").glob("*.json")]


def measure(program, out, inputs, cores):
    program = str(pathlib.Path(program).resolve())
    rows = []
    with tempfile.TemporaryDirectory(prefix="tegument-growth-") as name:
        folder = pathlib.Path(name)
        for i in range(inputs):
            write_ball(folder / f"ball{i:04}.obj", 90 + i % 20)
            (folder / f"e{i:04}.fx").write_text(EFFECT, encoding="ascii")
        for what, command in (("prep", ("prep", "{}", "-o", "out/{name}.glb", "--json")), ("info", ("info", "{}", "--json"))):
            for shards in SHARDS:
                results = f"{what}{shards}"
                seconds = run_shards(program, folder, results, shards, cores, command)
                inside = [record["seconds"] for record in records(folder, results)]
                rows.append({"command": what, "shards": shards, "seconds": seconds, "inside": sum(inside), "inputs": inputs})
                print(f"{what}: {shards} shards, {seconds:.2f} s, {sum(inside):.2f} s in commands", flush=True)
                if what == "prep" and shards == 1:
                    each = inside
        again = run_shards(program, folder, "prep1", 1, cores, ("prep", "{}", "-o", "out/{name}.glb", "--json"))
        rows.append({"command": "prep again", "shards": 1, "seconds": again, "inside": 0, "inputs": inputs})
    pathlib.Path(out).write_text(json.dumps({"cores": len(cores), "rows": rows, "each": each}, indent=1) + "\n", encoding="ascii")


def overhead(rows):
    """Seconds that a batch adds to each input, and to a shard before its first input: least squares over the runs of `info` that have a core each."""
    runs = [(row["inputs"] / row["shards"], row["seconds"] - row["inside"] / row["shards"]) for row in rows]
    n, mx, my = len(runs), sum(x for x, _ in runs) / len(runs), sum(y for _, y in runs) / len(runs)
    slope = sum((x - mx) * (y - my) for x, y in runs) / max(sum((x - mx)**2 for x, _ in runs), 1e-9) if n > 1 else 0
    return slope, my - slope * mx


def simulate(each, inputs, nodes, per_input, per_shard, seed=1):
    """The model: a node does every nodes-th input, one after another; an input takes what one of the measured took, and the overhead.
    The batch ends with its slowest node."""
    draw = random.Random(seed)
    durations = [draw.choice(each) + per_input for _ in range(inputs)]
    return max(per_shard + sum(durations[node::nodes]) for node in range(nodes))


def bound(each, inputs, nodes, per_input, per_shard):
    """Without chance: the mean for all. What is above it in the simulation is the luck of the slowest node."""
    return per_shard + math.ceil(inputs / nodes) * (sum(each) / len(each) + per_input)


def plot(files, folder):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    measured = [json.loads(pathlib.Path(file).read_text()) for file in files]
    folder = pathlib.Path(folder)

    def finish(figure, axes, name, x, y, legend="best"):
        axes.set_xlabel(x)
        axes.set_ylabel(y)
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(color="#E4E4E4", linewidth=0.6)
        axes.legend(frameon=False, loc=legend)
        figure.savefig(folder / f"{name}.png", dpi=120, bbox_inches="tight")
        print(folder / f"{name}.png")

    colours = ["#0072B2", "#D55E00", "#009E73"]
    figure, axes = plt.subplots(figsize=(5, 3.4))
    for one, colour in zip(measured, colours):
        rows = [row for row in one["rows"] if row["command"] == "prep"]
        alone = rows[0]["seconds"]
        axes.plot([row["shards"] for row in rows], [alone / row["seconds"] for row in rows], "o-", color=colour, label=f"{one['cores']} cores")
        axes.axhline(one["cores"], color=colour, linewidth=0.6, linestyle=":")
    axes.plot([1, 16], [1, 16], color="#999999", linewidth=0.8, label="as many as shards")
    axes.set_xscale("log", base=2)
    axes.set_yscale("log", base=2)
    axes.set_xticks(SHARDS, SHARDS)
    axes.set_yticks(SHARDS, SHARDS)
    finish(figure, axes, "batch_speed_up", "shards", "times as fast as one")

    figure, axes = plt.subplots(figsize=(5, 3.4))
    for one, colour in zip(measured, colours):
        rows = [row for row in one["rows"] if row["command"] == "info" and row["shards"] <= one["cores"]]
        axes.plot([row["shards"] for row in rows], [1000 * (row["seconds"] * row["shards"] - row["inside"]) / row["inputs"] for row in rows], "o-",
                  color=colour, label=f"{one['cores']} cores, {rows[0]['inputs']} inputs")
    axes.set_ylim(bottom=0)
    axes.set_xticks(SHARDS, SHARDS)
    finish(figure, axes, "batch_overhead", "shards", "ms that the batch adds to an input")

    figure, axes = plt.subplots(figsize=(5, 3.4))
    for one, colour in zip(measured, colours):
        fair = [row for row in one["rows"] if row["command"] == "info" and row["shards"] <= one["cores"]]
        per_input, per_shard = overhead(fair)
        per_input, per_shard = max(per_input, 0), max(per_shard, 0)
        rows = [row for row in one["rows"] if row["command"] == "prep" and row["shards"] <= one["cores"]]
        print(f"\n{one['cores']} cores: {1000 * per_input:.1f} ms an input, {1000 * per_shard:.0f} ms a shard\n")
        print("| shards | measured, s | model, s | simulated, s |\n|---|---|---|---|")
        for row in rows:
            by_model = bound(one["each"], row["inputs"], row["shards"], per_input, per_shard)
            by_chance = simulate(one["each"], row["inputs"], row["shards"], per_input, per_shard)
            print(f"| {row['shards']} | {row['seconds']:.2f} | {by_model:.2f} | {by_chance:.2f} |")
        nodes = [1, 2, 4, 8, 16, 32, 64, 100, 200, 400, 1000]
        axes.plot([row["shards"] for row in rows], [10000 / row["inputs"] * row["seconds"] for row in rows], "o", color=colour,
                  label=f"measured on {one['cores']} cores, times {10000 / rows[0]['inputs']:.0f}")
        axes.plot(nodes, [simulate(one["each"], 10000, n, per_input, per_shard) for n in nodes], "-", color=colour, label="simulated")
        at = simulate(one["each"], 10000, 100, per_input, per_shard)
        ideal = 10000 * sum(one["each"]) / len(one["each"]) / 100
        print(f"\n10,000 inputs on 100 nodes: {at:.1f} s, {100 * ideal / at:.0f} % of it in commands")
    axes.set_xscale("log")
    axes.set_yscale("log")
    finish(figure, axes, "batch_model", "nodes", "s for 10,000 inputs", "lower left")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="what", required=True)
    one = commands.add_parser("measure")
    one.add_argument("program")
    one.add_argument("out")
    one.add_argument("--inputs", type=int, default=96)
    one.add_argument("--cores", default="")
    two = commands.add_parser("plot")
    two.add_argument("files", nargs="+")
    two.add_argument("folder")
    arguments = parser.parse_args()
    if arguments.what == "plot":
        return plot(arguments.files, arguments.folder)
    cores = [int(core) for core in arguments.cores.split(",")] if arguments.cores else sorted(os.sched_getaffinity(0))
    return measure(arguments.program, arguments.out, arguments.inputs, cores)


if __name__ == "__main__":
    main()
