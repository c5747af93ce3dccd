#!/usr/bin/env python3
"""Tables of skin over views: `skin_table.py FOLDER|views.tar [--write]` reads what `tegument bench --json` wrote, VIEW-*.json, and prints what
leads in each view, where a peer is both faster and more accurate, and growth fitted from growth-texels.json, growth-pixels-*.json and
growth-links-*.json where they are. With --write views.md and the CSV files beside it get it, and speed-error.md a line that leads there."""

import argparse
import csv
import io
import json
import math
import pathlib
import re
import sys
import tarfile
import tempfile

DESIGN = pathlib.Path(__file__).resolve().parents[2] / "docs/design"
PAGE = DESIGN / "tables/views.md"
SETTINGS = DESIGN / "tables/views.csv"
LEADERS = DESIGN / "tables/views-leaders.csv"
GROWTH = DESIGN / "tables/views-growth.csv"
MADE_BY = ("command", "device", "driver", "commit", "date")
COMMAND = "tegument bench --scene effects/workspaces/VIEW.json --map-size 512 1024 2048 --shadow-size 2048 --setting paper corrected"
MARK = "<!-- views -->"
OURS = ("Pyramid", "PyramidLinked", "PyramidCompute")
VIEWS = ("human", "human_side", "human_closeup", "human_half", "human_backlit",
         "lps_head", "lps_head_side", "lps_head_closeup", "lps_head_half", "lps_head_backlit")
PER_PIXEL = ("Place", "Final")  # of a pyramid's passes; all others but ShadowMap are per texel


def is_ours(row):
    return row["technique"].split(",")[0] in OURS


def milliseconds(row):
    return row["ms"]["median"]


def error(row):
    return row["error"]["rel_l2"]


def beats(one, other):
    """Faster and more accurate, both by more than what repeats of the same measurement differ by."""
    noise = max(one["ms"]["noise"], other["ms"]["noise"])
    return milliseconds(one) < milliseconds(other) - noise and error(one) < error(other)


def dominated(rows):
    """(ours, peer) where the peer is both faster and more accurate."""
    return [(ours, peer) for ours in rows if is_ours(ours) for peer in rows if not is_ours(peer) and beats(peer, ours)]


def undominated_peers(rows):
    """Peers than which nothing of ours is both faster and more accurate."""
    return [peer for peer in rows if not is_ours(peer) and not any(beats(ours, peer) for ours in rows if is_ours(ours))]


def name(row):
    setting = "" if row["setting"] == "corrected" else f", {row['setting']}"
    return f"`{row['technique']}`{setting} {row['map_size']}/{row['shadow_size']}"


def load(file):
    """Nothing where a measurement was cut off."""
    try:
        return json.loads(file.read_text())
    except json.JSONDecodeError:
        print(f"{file.name} is no whole JSON: left out", file=sys.stderr)
        return []


def read(folder):
    """Rows of each view that was measured; of a row that was drawn twice, the first."""
    views = {}
    for view in VIEWS:
        rows = {}
        for file in sorted(folder.glob(f"{view}-*.json")):
            for row in load(file):
                if row.get("failure"):
                    print(f"{file.name}: {row['technique']} was not drawn: {row['failure']}", file=sys.stderr)
                    continue
                rows.setdefault((row["technique"], row["setting"], row["map_size"], row["shadow_size"]), row)
        if rows:
            views[view] = sorted(rows.values(), key=milliseconds)
    return views


def as_csv(rows):
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def made_by(row):
    """The last columns of a table of measurements."""
    return COMMAND, row["device"], row["driver"].replace("NVIDIA ", ""), "", row["date"]


def settings_of(views):
    """Every setting of every view, one a row."""
    header = ("view", "skin, % of the picture", "technique", "setting", "maps", "shadow map", "ms", "ms, gross", "rel L2", "bias", "MiB of targets", *MADE_BY)
    return [header] + [(view, f"{100 * row['coverage']:.0f}", row["technique"], row["setting"], row["map_size"], row["shadow_size"],
                        f"{milliseconds(row):.2f}", f"{row['ms_gross']['median']:.2f}", f"{error(row):.4f}", f"{row['error']['bias']:+.4f}",
                        f"{row['target_bytes'] / 2**20:.0f}", *made_by(row)) for view, rows in views.items() for row in rows]


def best(rows):
    """The most accurate of ours, and the most accurate peer, with the fastest of ours that is no less accurate than it."""
    ours = min(filter(is_ours, rows), key=error)
    peer = min((row for row in rows if not is_ours(row)), key=error)
    as_good = [row for row in rows if is_ours(row) and error(row) <= error(peer)]
    return ours, peer, min(as_good, key=milliseconds) if as_good else None


def figures(row):
    return f"{name(row)}: {error(row):.4f}, {milliseconds(row):.2f} ms"


def leaders(views):
    """For each view what leads, and what leads of the peers."""
    rows = [("view", "most accurate of ours", "most accurate peer", "fastest of ours that is as accurate", "dominated", "peers that nothing of ours dominates", *MADE_BY)]
    for view, of in views.items():
        ours, peer, as_good = best(of)
        rows.append((view, figures(ours), figures(peer), figures(as_good) if as_good else "none",
                     str(len(dominated(of))), ", ".join(name(row) for row in undominated_peers(of)) or "none", *made_by(of[0])))
    return rows


def cases(views):
    lines = []
    for view, rows in views.items():
        for ours, peer in dominated(rows):
            lines.append(f"* {view}: {figures(ours)}; {figures(peer)}\n")
    return "".join(lines) or "None: no setting of a peer is both faster and more accurate than some setting of ours.\n"


def exponent(points):
    """Of time in the quantity: a power law by least squares in logarithms."""
    x = [math.log(quantity) for quantity, _ in points]
    y = [math.log(time) for _, time in points]
    middle = sum(x) / len(x), sum(y) / len(y)
    return sum((a - middle[0]) * (b - middle[1]) for a, b in zip(x, y)) / sum((a - middle[0]) ** 2 for a in x)


def passes_time(row, counts):
    return sum(done["ms"] for done in row["passes"] if counts(done["name"]))


def texel_points(folder):
    file = folder / "growth-texels.json"
    points = {}
    for row in load(file) if file.is_file() else []:
        per_texel = passes_time(row, lambda made: made not in ("ShadowMap", "TSM", *PER_PIXEL))
        points.setdefault(row["technique"], []).append((row["map_size"] ** 2, per_texel, row))
    return points


def pixel_points(folder):
    points = {}
    for file in folder.glob("growth-pixels-*.json"):
        for row in load(file):
            screen = row["technique"].startswith("Separable")
            per_pixel = passes_time(row, (lambda made: made != "ShadowMap") if screen else (lambda made: made in PER_PIXEL))
            points.setdefault(row["technique"], []).append((row["resolution"][0] * row["resolution"][1], per_pixel, row))
    return {technique: sorted(of, key=lambda point: point[0]) for technique, of in points.items()}


def link_points(folder):
    points = {}
    for sheet in folder.glob("growth-links-*-sheet.json"):
        made = load(sheet)
        for technique in ("PyramidLinked", "PyramidCompute"):
            drawn = load(sheet.with_name(sheet.name.replace("sheet", technique)))
            if not made or not drawn:
                continue
            links = made["links"]
            points.setdefault(technique, []).append((links, passes_time(drawn, lambda made: made == "FineTop"), drawn))
    return {technique: sorted(of, key=lambda point: point[0]) for technique, of in points.items()}


def grown(quantity, points):
    return [(quantity, technique, ", ".join(f"{size:,}" for size, _, _ in of), ", ".join(f"{time:.3f}" for _, time, _ in of),
             f"{exponent([(size, time) for size, time, _ in of]):.2f}") for technique, of in points.items() if len(of) > 1]


def growth(folder):
    """Quantity, technique, sizes, ms of the passes that grow with it, exponent of a power law through all sizes."""
    return grown("texels of the base", texel_points(folder)) + grown("pixels", pixel_points(folder)) + grown("links", link_points(folder))


def memory(folder):
    """MiB of render targets, by the size of maps; shadow map and picture as measured."""
    return [(f"MiB of targets, maps of {row['map_size']}", technique, f"{row['target_bytes'] / 2**20:.0f}")
            for technique, of in texel_points(folder).items() for _, _, row in sorted(of, key=lambda point: point[0])]


def page(folder):
    """The page, the views, and the tables beside the page by their files."""
    views = read(folder)
    if not views:
        raise SystemExit(f"{folder} holds no table of a view")
    first = next(iter(views.values()))[0]
    width, height = first["resolution"]
    text = f"""# Both heads, five views, three sizes of maps, with peers

    tegument bench --scene effects/workspaces/human.json --map-size 512 1024 2048 --shadow-size 2048 --setting paper corrected --json RESULTS/human-all.json

What [speed-error.md](../speed-error.md) says of views. {first['device']}, driver {first['driver'].replace('NVIDIA ', '')}, {first['compiler']},
{first['date']}; {width} x {height}; 1,024 pixels of reference, from behind means of 4 x 4 samples in 512. Milliseconds are net of clears; *maps/shadow* in
texels. Every setting: [{SETTINGS.name}]({SETTINGS.name}); what leads in each view: [{LEADERS.name}]({LEADERS.name}); columns: [bench.md](../../bench.md). Written by
`python3 tests/tools/skin_table.py RESULTS --write`.

## Growth

[{GROWTH.name}]({GROWTH.name}): the default head, shadow map 1024, pixels and links at maps of 1024; MiB of render targets. Beside targets: links 33.6 MB a mesh,
the maps of Atlas 48 bytes a texel of the base, made once.

## Where a peer is both faster and more accurate

By more than the time's noise:

{cases(views)}"""
    grows = [("quantity", "technique", "sizes", "ms of the passes that grow with it", "exponent", *MADE_BY)]
    grows += [(*row, "", *made_by(first)[1:]) for row in growth(folder) + [(*row, "", "") for row in memory(folder)]]
    return text, views, {SETTINGS: settings_of(views), LEADERS: leaders(views), GROWTH: grows}


def sentence(views):
    count = sum(len(dominated(rows)) for rows in views.values())
    settings = sum(len(rows) for rows in views.values())
    outcome = "in none of them a peer is both faster and more accurate than a setting of the pyramid" if count == 0 else \
        f"pairs in which a peer is both faster and more accurate than a setting of the pyramid: {count}, all named"
    return (f"{len(views)} views of both heads, {settings} settings: [tables/views.md](tables/views.md);\n{outcome}. Growth in texels,"
            " pixels and links, and memory, stand there too.\n")


def write(text, views, tables):
    PAGE.write_text(text)
    for file, rows in tables.items():
        file.write_text(as_csv(rows))
    lead = DESIGN / "speed-error.md"
    told = re.sub(re.escape(MARK) + r"\n.*?" + re.escape(MARK) + r"\n", lambda _: f"{MARK}\n{sentence(views)}{MARK}\n", lead.read_text(), flags=re.S)
    lead.write_text(told)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("--write", action="store_true", help=f"into {PAGE.name} and the tables beside it")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = given.results
        if folder.is_file():
            with tarfile.open(folder) as packed:
                packed.extractall(scratch, filter="data") if hasattr(tarfile, "data_filter") else packed.extractall(scratch)
            folder = pathlib.Path(scratch)
        text, views, tables = page(folder)
    if given.write:
        write(text, views, tables)
    else:
        print(text, *(as_csv(rows) for rows in tables.values()), sep="\n", end="")


if __name__ == "__main__":
    main()
