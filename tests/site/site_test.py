#!/usr/bin/env python3
"""The documentation as a site: no dead link or anchor; search and gallery in a real headless Chromium, without error and without network.

usage: site_test.py PROGRAM REPOSITORY [PICTURES]
Exit code 77: this machine lacks python3-markdown or Chromium.
"""

import html.parser
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, REPOSITORY = sys.argv[1], pathlib.Path(sys.argv[2])
PICTURES = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
sys.path += [str(REPOSITORY / "tests" / "report"), "/usr/lib/python3/dist-packages"]
import browser


def missing():
    if browser.program() is None:
        return "chromium-headless-shell is not installed"
    try:
        import markdown  # noqa: F401
    except ImportError:
        return "python3-markdown is not installed"
    return ""


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.links, self.names = [], set()
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.names.update(given[key] for key in ("id", "name") if given.get(key))
        self.links += [given[key] for key in ("href", "src") if given.get(key)]


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="tegument-site-"))
        ran = subprocess.run([sys.executable, REPOSITORY / "docs" / "site" / "build.py", cls.folder, "--program", PROGRAM, "--rows", "1"], capture_output=True, text=True)
        assert ran.returncode == 0, ran.stdout + ran.stderr
        cls.pages = {path: Page(path) for path in cls.folder.rglob("*.html")}
        cls.browser = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        shutil.rmtree(cls.folder)

    def keep(self, name):
        if PICTURES:
            PICTURES.mkdir(parents=True, exist_ok=True)
            self.browser.screenshot(PICTURES / f"{name}.png")

    def test_every_link_and_anchor_leads_somewhere(self):
        dead = []
        for path, page in self.pages.items():
            for link in page.links:
                if "://" in link or link.startswith(("mailto:", "data:")):
                    continue
                file, _, anchor = link.partition("#")
                to = (path.parent / file).resolve() if file else path.resolve()
                if not to.exists() or (anchor and to.suffix == ".html" and anchor not in self.pages[to].names):
                    dead.append(f"{path.relative_to(self.folder)}: {link}")
        self.assertEqual(dead, [])

    def test_every_user_page_is_there(self):
        for page in REPOSITORY.glob("docs/*.md"):
            self.assertIn(self.folder / "docs" / f"{page.stem}.html", self.pages)

    def test_pages_open_without_error_and_without_network(self):
        for name in ("README", "view", "choose-a-technique", "your-engine", "your-scan-in-fur", "gallery", "design/viewer"):
            self.browser.open(self.folder / "docs" / f"{name}.html")
            self.keep("site_" + name.replace("/", "_"))
            self.assertEqual(self.browser.problems, [], name)
            self.assertTrue(self.browser.evaluate("[...document.images].every(image => image.complete && image.naturalWidth > 0)"), name)

    def test_the_search_finds_a_page_by_its_words(self):
        self.browser.open(self.folder / "docs" / "design" / "README.html")
        self.browser.evaluate("document.getElementById('search').focus()")
        self.browser.type("snakemake slurm")
        self.keep("site_search")
        first = self.browser.evaluate("document.querySelector('#found a').href")
        self.assertTrue(first.startswith("file://") and pathlib.Path(first[7:]).exists(), first)
        self.assertIn("command-line.html", self.browser.evaluate("[...document.querySelectorAll('#found a')].map(a => a.href).join()"))
        self.browser.type(" nowordlikethis")
        self.assertEqual(self.browser.evaluate("document.getElementById('found').textContent"), "nothing found")

    def test_the_slider_of_the_gallery_moves_by_keys(self):
        self.browser.open(self.folder / "docs" / "gallery.html")
        border = "document.querySelector('.beside .over').style.clipPath"
        self.browser.evaluate("document.querySelector('.beside input').focus()")
        for _ in range(3):
            self.browser.press("ArrowRight")
        self.assertIn("47%", self.browser.evaluate(border))
        self.keep("site_gallery_moved")


if __name__ == "__main__":
    if missing():
        print("skipped: " + missing())
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
