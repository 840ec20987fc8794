"""A page as a browser shows it: Debian's chromium without a window."""
import html.parser
import os
import pathlib
import re
import shutil
import subprocess
import tempfile


def chromium():
    """The program, or nothing where it is not installed."""
    return os.environ.get("PDPLATE_CHROMIUM") or shutil.which("chromium")


def run(page, *options, seconds=60, budget=4000):
    with tempfile.TemporaryDirectory(prefix="pdplate_browser_") as profile:
        command = [chromium(), "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--disable-extensions",
                   "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
                   f"--user-data-dir={profile}", "--enable-logging=stderr", f"--virtual-time-budget={budget}", *options, page]
        return subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=True)


class Element:
    def __init__(self, name, attributes):
        self.name, self.attributes, self.text = name, attributes, ""

    def __getitem__(self, name):
        return self.attributes.get(name)


class Reader(html.parser.HTMLParser):
    """All elements with their text, which is that of those inside too."""
    VOID = {"meta", "input", "br", "link", "img", "hr", "path", "line", "circle"}

    def __init__(self, text):
        super().__init__()
        self.elements, self.open = [], []
        self.feed(text)

    def handle_starttag(self, name, attributes):
        self.elements.append(Element(name, dict(attributes)))
        if name not in self.VOID:
            self.open.append(self.elements[-1])

    def handle_startendtag(self, name, attributes):
        self.elements.append(Element(name, dict(attributes)))

    def handle_endtag(self, name):
        while name not in self.VOID and self.open and self.open.pop().name != name:
            pass

    def handle_data(self, text):
        if not any(one.name in ("script", "style") for one in self.open):
            for one in self.open:
                one.text += text


class Page:
    """What is left of a page once its scripts have run. `#check` has it count the colours on each canvas. All of it happens while the
    page loads: pictures of animations, which a busy machine withholds, are not waited for."""
    def __init__(self, path):
        self.path = path
        ran = run(f"file://{path}#check", "--dump-dom")
        self.elements = Reader(ran.stdout).elements
        self.complaints = [line for line in ran.stderr.splitlines() if re.search(r":(ERROR|WARNING|INFO):CONSOLE", line)]
        self.text = next(one.text for one in self.elements if one.name == "body")

    def root(self):
        return next(one for one in self.elements if one.name == "html")

    def lone_headings(self):
        """Headings that end a sheet of A4 or letter paper, while what they head is on the next one."""
        headings = {"".join(one.text.split()) for one in self.elements if one.name in ("h2", "h3", "figcaption", "summary")}
        printed = [sheet.strip() for size in ("A4", "letter") for sheet in sheets(self.path, size)]
        ends = ["".join(sheet.splitlines()[-1].split()) for sheet in printed if sheet]
        return [end for end in ends if end in headings]

    def having(self, attribute):
        return [one for one in self.elements if one[attribute] is not None]


def sheets(path, size):
    """The text on each sheet of paper of the page: A4 or letter."""
    with tempfile.TemporaryDirectory(prefix="pdplate_paper_") as folder:
        page, pdf = pathlib.Path(folder, "page.html"), pathlib.Path(folder, "page.pdf")
        page.write_text(f"{pathlib.Path(path).read_text()}<style>@page {{ size: {size}; }}</style>")
        run(f"file://{page}", "--no-pdf-header-footer", f"--print-to-pdf={pdf}", budget=16000)
        return subprocess.run(["pdftotext", "-layout", pdf, "-"], capture_output=True, text=True, check=True).stdout.split("\f")


def screenshot(path, picture, width, height, scheme="light"):
    """A picture of the page, for people to look at."""
    run(f"file://{path}#{scheme}", f"--screenshot={picture}", f"--window-size={width},{height}", "--hide-scrollbars")
