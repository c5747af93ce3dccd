#!/usr/bin/env python3
"""The documentation as a site: docs/site/build.py FOLDER [--program build/release/tegument]

Every page that can be reached from docs/README.md, with a search, and a gallery whose pictures the program draws. Opens from the disk, asks no network. Needs python3-markdown.
"""

import argparse
import html
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.append("/usr/lib/python3/dist-packages")  # where Debian has it, whichever Python runs this
import markdown

ROOT = pathlib.Path(__file__).resolve().parents[2]
START = pathlib.PurePosixPath("docs/README.md")
LINK = re.compile(r'(<(?:a|img)\b[^>]*?\b(?:href|src)=")([^"]+)(")')
OWN = ("style.css", "site.js")
# name, what is seen, the left and the right picture as words for `tegument render`
GALLERY = (
    ("Skin", "Lambert, and light that has travelled under the skin", ["Main", "-t", "Lambert"], ["Pyramid", "-t", "Pyramid"]),
    ("Two techniques", "d'Eon and Luebke's ten blurs, and the pyramid in a third of their time", ["Main", "-t", "DEonLuebke"], ["Pyramid", "-t", "Pyramid"]),
    ("Fur", "shells by a map of fur, and by roots", ["Fur", "-w", "bunny"], ["FurRoots", "-w", "bunny"]),
    ("A coat", "shells, and strands as ribbons", ["FurRoots", "-w", "bunny"], ["FurCoat", "-w", "bunny"]),
)
PICTURE_SIZE = 420


def slug(text, _separator="-"):
    """As GitHub makes anchors."""
    return re.sub(r"[^\w\- ]", "", html.unescape(text).strip().lower()).replace(" ", "-")


def with_room_for_lists(text):
    """A list may begin right under its paragraph, as on GitHub."""
    lines, fenced = [], False
    for line in text.split("\n"):
        fenced ^= line.lstrip().startswith("```")
        begins = not fenced and re.match(r"([*-]|\d+\.) ", line)
        if begins and lines and lines[-1].strip() and not re.match(r"([*-]|\d+\.) |\s", lines[-1]):
            lines.append("")
        lines.append(line)
    return "\n".join(lines)


class Site:
    def __init__(self, out):
        self.out, self.pages, self.todo, self.dead = out, {}, [START], []

    def target(self, page, link):
        """The address that a link of a page has on the site; what it names becomes part of the site."""
        if re.match(r"[a-z]+:|#", link):
            return link
        path, _, anchor = link.partition("#")
        file = pathlib.PurePosixPath(os.path.normpath(page.parent / path))
        source = ROOT / file
        if source.is_dir() and (source / "README.md").exists():
            file, source = file / "README.md", source / "README.md"
        if file.parts[:1] == ("..",) or not source.exists():
            self.dead.append(f"{page}: {link}")
            return link
        if file.suffix == ".md":
            self.todo.append(file)
            file = file.with_suffix(".html")
        elif source.is_dir():
            self.list_folder(file)
            file /= "index.html"
        else:
            (self.out / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, self.out / file)
        return os.path.relpath(file, page.parent) + ("#" + anchor if anchor else "")

    def list_folder(self, folder):
        names = sorted(path.name for path in (ROOT / folder).iterdir() if not path.name.startswith("."))
        body = f"<h1>{html.escape(str(folder))}</h1><ul>" + "".join(f"<li>{html.escape(name)}</li>" for name in names) + "</ul>"
        self.write(folder / "index.md", str(folder), body)

    def write(self, page, title, body):
        up = os.path.relpath(".", page.parent)
        to = lambda name: os.path.normpath(f"{up}/{name}")
        text = f"""<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>{html.escape(title)} - Tegument</title>
<link rel="stylesheet" href="{to('style.css')}"></head><body data-up="{up}"><header><a href="{to('docs/README.html')}">Tegument</a> <a href="{to('docs/gallery.html')}">Gallery</a>
<label>Search <input id="search" type="search" autocomplete="off"></label></header><ul id="found" hidden></ul><main>{body}</main>
<script src="{to('index.js')}"></script><script src="{to('site.js')}"></script></body></html>
"""
        file = self.out / page.with_suffix(".html")
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def build_page(self, page):
        source = (ROOT / page).read_text(encoding="utf-8")
        maker = markdown.Markdown(extensions=["tables", "fenced_code", "toc", "sane_lists"], extension_configs={"toc": {"slugify": slug}})
        body = maker.convert(with_room_for_lists(source))
        body = LINK.sub(lambda found: found[1] + html.escape(self.target(page, html.unescape(found[2]))) + found[3], body)
        title = next((line[2:].strip() for line in source.split("\n") if line.startswith("# ")), str(page))
        self.write(page, title, body)
        self.pages[page] = {"title": title, "url": str(page.with_suffix(".html")), "text": re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", " ", body)))}

    def build(self):
        while self.todo:
            page = self.todo.pop()
            if page not in self.pages:
                self.build_page(page)
        (self.out / "index.js").write_text("const INDEX = " + json.dumps(list(self.pages.values())) + ";\n")
        for name in OWN:
            shutil.copyfile(pathlib.Path(__file__).parent / name, self.out / name)
        (self.out / "index.html").write_text('<!DOCTYPE html><html lang="en"><title>Tegument</title><meta http-equiv="refresh" content="0; url=docs/README.html"><body data-ready="yes"><a href="docs/README.html">Tegument</a></body></html>\n')


def draw(program, words, file):
    ran = subprocess.run([program, "render", *words, "--size", str(PICTURE_SIZE), "-o", str(file)], cwd=ROOT, capture_output=True, text=True)
    if ran.returncode != 0:
        sys.exit(f"{' '.join(words)}: {ran.stderr}")


def gallery(site, program, rows):
    body = "<h1>Gallery</h1><p>Drag the border, or move it by the arrow keys.</p>"
    folder = site.out / "docs" / "gallery"
    if program:
        folder.mkdir(parents=True, exist_ok=True)
    else:
        body += "<p>Without pictures: the site was built without <code>--program</code>.</p>"
    for number, (name, text, left, right) in enumerate(GALLERY[:rows] if program else ()):
        for side, words in (("left", left), ("right", right)):
            draw(program, words, folder / f"{number}-{side}.jpg")
        lines = " | ".join("tegument render " + " ".join(words) for words in (left, right))
        body += f"""<h2 id="{slug(name)}">{name}</h2><div class="beside"><img src="gallery/{number}-right.jpg" alt="{html.escape(' '.join(right))}"><img class="over" src="gallery/{number}-left.jpg" alt="{html.escape(' '.join(left))}">
<input type="range" min="0" max="100" value="50" aria-label="border: {html.escape(name)}"></div><p>{html.escape(text)}</p><pre><code>{html.escape(lines)}</code></pre>"""
    site.write(pathlib.PurePosixPath("docs/gallery.md"), "Gallery", body)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path, help="draws the gallery")
    parser.add_argument("--rows", type=int, default=len(GALLERY), help="of the gallery, from the first")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    site = Site(options.folder)
    gallery(site, options.program.resolve() if options.program else None, options.rows)
    site.build()
    for link in site.dead:
        print(f"dead link: {link}", file=sys.stderr)
    print(f"{len(site.pages)} pages: {options.folder / 'index.html'}")
    sys.exit(1 if site.dead else 0)


if __name__ == "__main__":
    main()
