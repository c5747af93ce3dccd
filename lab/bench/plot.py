#!/usr/bin/env python3
"""Plots of `tegument bench`: time against error, and how cost grows. PNG and SVG.

    plot.py pareto RESULTS.json FOLDER     one plot for each scene and size of maps
    plot.py growth GROWTH.json FOLDER
"""

import itertools
import json
import pathlib
import re
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib import ticker
except ImportError:
    print("matplotlib is not installed", file=sys.stderr)
    sys.exit(3)

# Okabe and Ito: told apart by people with any kind of colour vision. Yellow is too light for points on white.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000", "#999999"]
MARKERS = {"corrected": "o", "deon2007": "D", "seed": "s", "paper": "^"}
OTHER_MARKERS = ["v", "P", "X", "*", "h"]
INK = "#333333"
DPI = 150  # of figures and files alike: labels are placed in pixels

plt.rcParams.update({
    "font.size": 10, "font.family": "DejaVu Sans", "axes.edgecolor": INK, "axes.labelcolor": INK, "text.color": INK, "xtick.color": INK,
    "ytick.color": INK, "axes.spines.top": False, "axes.spines.right": False, "axes.axisbelow": True, "grid.color": "#E4E4E4",
    "grid.linewidth": 0.6, "svg.fonttype": "path", "svg.hashsalt": "tegument", "figure.dpi": DPI,
})


def save(figure, folder, name):
    for ending in ("png", "svg"):
        path = folder / f"{name}.{ending}"
        figure.savefig(path, dpi=DPI, bbox_inches="tight", pad_inches=0.12, metadata={"Date": None} if ending == "svg" else None)
        print(path)
    plt.close(figure)


def darker(colour):
    """For text: light blue and orange do for points, but are too pale to read on white."""
    return tuple(0.72 * part for part in matplotlib.colors.to_rgb(colour))


def plain(value, _=None):
    return f"{value:g}"


def log_axis(axis, low, high):
    """Ticks at 1, 2, 5 of each decade, written out: an axis of less than a decade has labels too."""
    axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5), numticks=30))
    axis.set_major_formatter(ticker.FuncFormatter(plain))
    axis.set_minor_locator(ticker.LogLocator(subs=range(1, 10), numticks=60))
    axis.set_minor_formatter(ticker.NullFormatter())
    (axis.axes.set_xlim if axis.axis_name == "x" else axis.axes.set_ylim)(low, high)


class Labels:
    """Places each label where it hides neither a point nor another label nor the front, as near to its point as it can be."""

    def __init__(self, figure, axes, points):
        self.figure, self.axes = figure, axes
        figure.canvas.draw()
        self.renderer = figure.canvas.get_renderer()
        self.points = [axes.transData.transform(p) for p in points]
        self.area = axes.get_window_extent(self.renderer)
        self.taken = []
        self.lines = []

    def avoid(self, xs, ys):
        corners = [self.axes.transData.transform(p) for p in zip(xs, ys)]
        for (x0, y0), (x1, y1) in zip(corners, corners[1:]):
            steps = max(2, int(max(abs(x1 - x0), abs(y1 - y0)) / 9))
            self.lines += [(x0 + (x1 - x0) * i / steps, y0 + (y1 - y0) * i / steps) for i in range(steps + 1)]

    def cost(self, box, distance):
        x0, y0, x1, y1 = box
        cost = distance * 0.02
        for a0, b0, a1, b1 in self.taken:
            width, height = min(x1, a1) - max(x0, a0), min(y1, b1) - max(y0, b0)
            if width > 0 and height > 0:
                cost += 300 + width * height
        cost += 60 * sum(x0 - 9 < x < x1 + 9 and y0 - 9 < y < y1 + 9 for x, y in self.points)
        cost += 2.5 * sum(x0 < x < x1 and y0 < y < y1 for x, y in self.lines)
        outside = max(0, self.area.x0 - x0) + max(0, x1 - self.area.x1) + max(0, self.area.y0 - y0) + max(0, y1 - self.area.y1)
        return cost + 10 * outside

    def place(self, index, text, colour):
        label = self.axes.text(0, 0, text, fontsize=8.5, color=darker(colour), transform=self.axes.transAxes)
        extent = label.get_window_extent(self.renderer)
        width, height = extent.width, extent.height
        px, py = self.points[index]
        best = None
        for distance, (dx, dy) in itertools.product((11, 18, 28, 42, 60, 82, 110, 145, 190, 240),
                                                    ((1, 0), (1, .6), (1, -.6), (0, 1), (0, -1), (-1, 0), (-1, .6), (-1, -.6))):
            x = px + dx * distance - (width if dx < 0 else width / 2 if dx == 0 else 0)
            y = py + dy * distance - (height / 2 if dy == 0 else height if dy < 0 else 0)
            cost = self.cost((x - 2, y - 1, x + width + 2, y + height + 1), distance)
            if best is None or cost < best[0]:
                best = (cost, x, y)
        _, x, y = best
        label.set_position(((x - self.area.x0) / self.area.width, (y - self.area.y0) / self.area.height))
        label.set_verticalalignment("bottom")
        self.taken.append((x - 2, y - 1, x + width + 2, y + height + 1))
        self.lead(px, py, x, y, width, height, colour)

    def lead(self, px, py, x, y, width, height, colour):
        tip = (min(max(px, x), x + width), min(max(py, y), y + height))
        if (tip[0] - px) ** 2 + (tip[1] - py) ** 2 < 20 ** 2:
            return
        start, end = (self.axes.transData.inverted().transform(p) for p in ((px, py), tip))
        self.axes.plot([start[0], end[0]], [start[1], end[1]], color=colour, linewidth=0.5, alpha=0.6, zorder=1)


def front(rows):
    best, chosen = float("inf"), []
    for row in sorted(rows, key=lambda r: (r["ms"]["median"], r["error"]["rel_l2"])):
        if row["error"]["rel_l2"] < best:
            best = row["error"]["rel_l2"]
            chosen.append(row)
    return chosen


def draw_front(axes, rows, labels_avoid):
    steps = front(rows)
    xs, ys = [], []
    for before, after in itertools.pairwise(steps):
        xs += [before["ms"]["median"], after["ms"]["median"]]
        ys += [before["error"]["rel_l2"]] * 2
    xs.append(steps[-1]["ms"]["median"])
    ys.append(steps[-1]["error"]["rel_l2"])
    xs.append(axes.get_xlim()[1])
    ys.append(ys[-1])
    axes.plot(xs, ys, color="#BBBBBB", linewidth=6, alpha=0.45, solid_capstyle="butt", zorder=0)
    labels_avoid(xs, ys)


def legend(axes, colours, markers):
    entries = [plt.Line2D([], [], marker="o", linestyle="", color=colour, label=name) for name, colour in colours.items()]
    entries += [plt.Line2D([], [], marker=marker, linestyle="", color=INK, markerfacecolor="none", label=name)
                for name, marker in markers.items()]
    entries.append(plt.Line2D([], [], color="#BBBBBB", linewidth=6, alpha=0.6, label="nothing is faster and nearer"))
    axes.legend(handles=entries, loc="upper left", bbox_to_anchor=(1.01, 1), frameon=False, fontsize=8, borderaxespad=0)


def pareto(rows, folder):
    rows = [r for r in rows if "ms" in r and r["ms"]["median"] > 0 and r["error"]["rel_l2"]]
    if not rows:
        return
    sources = list(dict.fromkeys(r["source"] for r in rows))
    colours = {name: COLOURS[i % len(COLOURS)] for i, name in enumerate(sources)}
    settings = list(dict.fromkeys(r["setting"] for r in rows))
    others = iter(OTHER_MARKERS * 9)
    markers = {name: MARKERS.get(name) or next(others) for name in settings}
    figure, axes = plt.subplots(figsize=(10.5, 6.4))
    figure.subplots_adjust(left=0.075, right=0.80, top=0.90, bottom=0.10)
    xs = [r["ms"]["median"] for r in rows]
    ys = [r["error"]["rel_l2"] for r in rows]
    axes.set_xscale("log")
    axes.set_yscale("log")
    log_axis(axes.xaxis, min(xs) / 1.4, max(xs) * 1.6)
    log_axis(axes.yaxis, min(ys) / 1.4, max(ys) * 1.5)
    axes.grid(True, which="major")
    for row in rows:
        ms = row["ms"]
        colour = colours[row["source"]]
        axes.plot([ms["p5"], ms["p95"]], [row["error"]["rel_l2"]] * 2, color=colour, linewidth=1, alpha=0.5, zorder=2)
        axes.plot(ms["median"], row["error"]["rel_l2"], marker=markers[row["setting"]], color=colour, markersize=6.5,
                  markeredgecolor="white", markeredgewidth=0.6, zorder=3)
    labels = Labels(figure, axes, list(zip(xs, ys)))
    draw_front(axes, rows, labels.avoid)
    for row in rows:
        labels.avoid([row["ms"]["p5"], row["ms"]["p95"]], [row["error"]["rel_l2"]] * 2)
    for index in sorted(range(len(rows)), key=lambda i: (xs[i], ys[i])):
        labels.place(index, rows[index]["technique"].replace(",", ""), colours[rows[index]["source"]])
    first = rows[0]
    width, height = first["resolution"]
    axes.set_xlabel("milliseconds on the device, median; bar: 5th to 95th percentile")
    axes.set_ylabel("relative L2 error against light by brute force")
    figure.text(0.075, 0.955, f"{first['scene']}, {width} × {height}, maps of {first['map_size']} × {first['map_size']}", fontsize=12)
    note = "  (software: times are ratios only)" if first.get("cpu") else ""
    figure.text(0.075, 0.925, f"{first['device']}, {first['driver']}, {first['date']}{note}", fontsize=8, alpha=0.8)
    legend(axes, colours, markers)
    save(figure, folder, "pareto-" + re.sub(r"[^A-Za-z0-9@+-]+", "_", first["scene"]) + f"-{width}x{height}-{first['map_size']}")


def growth(series, machine, folder):
    columns = 3
    lines = -(-len(series) // columns)
    figure, grid = plt.subplots(lines, columns, figsize=(10.5, 3.3 * lines + 0.6), squeeze=False)
    figure.subplots_adjust(left=0.07, right=0.98, top=1 - 0.72 / (3.3 * lines + 0.6), bottom=0.16 / lines + 0.02, wspace=0.28, hspace=0.55)
    for axes, one, colour in zip(grid.flat, series, itertools.cycle(COLOURS)):
        x, ms = one["x"], one["ms"]
        axes.set_xscale("log")
        axes.set_yscale("log")
        log_axis(axes.xaxis, min(x) / 1.3, max(x) * 1.3)
        axes.xaxis.set_major_locator(ticker.FixedLocator(x))
        axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda v, _: f"{v:,.0f}".replace(",", " ")))
        axes.xaxis.set_minor_locator(ticker.NullLocator())
        log_axis(axes.yaxis, min(ms) / 1.5, max(ms) * 1.5)
        axes.grid(True, which="major")
        fit = [one["factor"] * v ** one["exponent"] for v in x]
        axes.plot(x, fit, color=colour, linewidth=1.2, alpha=0.7)
        # Through the last point: what the time would be if it grew in proportion.
        axes.plot(x, [ms[-1] * v / x[-1] for v in x], color=INK, linewidth=0.9, linestyle=(0, (2, 3)), alpha=0.6)
        axes.plot(x, ms, marker="o", linestyle="", color=colour, markersize=6, markeredgecolor="white")
        axes.set_title(f"{one['what']}", fontsize=10, loc="left")
        axes.text(0.04, 0.94, f"exponent {one['exponent']:.2f}", transform=axes.transAxes, va="top", fontsize=11, color=darker(colour))
        if one.get("fixed_ms", 0) > 0:
            share = one["fixed_ms"] / (one["fixed_ms"] + one["ms_per_unit"] * x[0])
            axes.text(0.04, 0.83, f"fixed {one['fixed_ms']:.2g} ms, {100 * share:.0f} % of the first", transform=axes.transAxes, va="top",
                      fontsize=8.5, alpha=0.85)
        axes.set_xlabel(one["quantity"])
        axes.set_ylabel("ms")
        for tick in axes.get_xticklabels():
            tick.set_rotation(20)
            tick.set_horizontalalignment("right")
            tick.set_fontsize(8)
    for axes in list(grid.flat)[len(series):]:
        axes.set_visible(False)
    height = 3.3 * lines + 0.6
    figure.text(0.07, 1 - 0.20 / height, "How cost grows", fontsize=13)
    figure.text(0.07, 1 - 0.42 / height, f"{machine['device']}, {machine['driver']}, {machine['date']}; dotted: in proportion", fontsize=9,
                alpha=0.8)
    save(figure, folder, "growth")


def main(arguments):
    if len(arguments) != 3 or arguments[0] not in ("pareto", "growth"):
        print(__doc__, file=sys.stderr)
        return 2
    data = json.loads(pathlib.Path(arguments[1]).read_text())
    folder = pathlib.Path(arguments[2])
    folder.mkdir(parents=True, exist_ok=True)
    if arguments[0] == "growth":
        growth(data["series"], data["machine"], folder)
        return 0
    def key(row):
        return row["scene"], tuple(row["resolution"]), row["map_size"]
    for _, group in itertools.groupby(sorted(data, key=key), key=key):
        pareto(list(group), folder)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
