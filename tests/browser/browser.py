"""A page as a browser shows it: Debian's chromium without a window."""
import collections
import html.parser
import itertools
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import xml.etree.ElementTree


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

    def having(self, attribute):
        return [one for one in self.elements if one[attribute] is not None]

    def wrong_on_paper(self, size):
        """What does not stand as it should on paper, A4 or letter: words beyond the margins or over each other, numbers that lack,
        headings that end a sheet while what they head is on the next one."""
        sheets, room = printed(self.path, size), [MARGIN - 0.5, MARGIN - 0.5]
        wrong, there = [], collections.Counter()
        words_of = lambda *names: {word for one in self.elements if one.name in names for word in one.text.split()}
        cells = words_of("td", "th") - words_of("text", "figure")  # drawings may write over their own words
        headings = {"".join(one.text.split()) for one in self.elements if one.name in ("h2", "h3", "figcaption", "summary")}
        for count, sheet in enumerate(sheets, 1):
            words = [word for line in sheet.lines for word in line]
            there.update(word.text.strip("(),;:") for word in words)
            far = [word for word in words if min(word.left, word.top) < room[0] or word.right > sheet.width - room[0] or word.bottom > sheet.height - room[1]]
            wrong += [f"{size}, sheet {count}: {word.text} lies beyond the margin" for word in far]
            wrong += [f"{size}, sheet {count}: {a.text} and {b.text} overlap" for a, b in itertools.combinations(words, 2)
                      if a.covers(b) and {a.text, b.text} <= cells]
            ends = ["".join(word.text for line in sheet.lines[-most:] for word in line) for most in (1, 2, 3)]  # headings of so many lines
            wrong += [f"{size}: the heading {end} ends sheet {count}" for end in ends if end in headings]
        shown = [one for one in self.elements if (one["data-from"] and not one["data-from"].startswith("scene[")) or one["data-cell"]]
        numbers = collections.Counter(word.strip("(),;:") for one in shown for word in one.text.split() if re.search(r"\d", word))  # scene is of screens
        wrong += [f"{size}: {word} stands {there[word]} times on paper, {count} times on the page" for word, count in numbers.items()
                  if there[word] < count]
        return wrong


MARGIN = 14 / 25.4 * 72  # of @page in report.css, in points


class Word:
    """A word on paper with its box in points from the upper left corner."""
    def __init__(self, element):
        self.text = element.text
        self.left, self.top, self.right, self.bottom = (float(element.get(name)) for name in ("xMin", "yMin", "xMax", "yMax"))

    def covers(self, other):
        """True where more of two boxes is in common than the room that fonts leave above and below letters. Letters with a rim are
        drawn twice."""
        if self.text == other.text and abs(self.left - other.left) + abs(self.top - other.top) < 1:
            return False
        high = min(self.bottom, other.bottom) - max(self.top, other.top)
        return min(self.right, other.right) - max(self.left, other.left) > 1 and high > 0.5 * min(self.bottom - self.top, other.bottom - other.top)


class Sheet:
    """A sheet of paper: its size in points and its lines of words, the lowest last."""
    def __init__(self, page):
        name = "{http://www.w3.org/1999/xhtml}%s"
        self.width, self.height = float(page.get("width")), float(page.get("height"))
        self.lines = sorted(([Word(word) for word in line.iter(name % "word")] for line in page.iter(name % "line")),
                            key=lambda line: max(word.bottom for word in line))


def paper(path, size, *options):
    """What pdftotext says of the page on paper: A4 or letter."""
    with tempfile.TemporaryDirectory(prefix="pdplate_paper_") as folder:
        page, pdf = pathlib.Path(folder, "page.html"), pathlib.Path(folder, "page.pdf")
        page.write_text(f"{pathlib.Path(path).read_text()}<style>@page {{ size: {size}; }}</style>")
        run(f"file://{page}", "--no-pdf-header-footer", f"--print-to-pdf={pdf}", budget=16000)
        return subprocess.run(["pdftotext", *options, pdf, "-"], capture_output=True, text=True, check=True).stdout


def sheets(path, size):
    """The text on each sheet of paper of the page: A4 or letter."""
    return paper(path, size, "-layout").removesuffix("\f").split("\f")


def printed(path, size):
    """The sheets of paper of the page, with the boxes of words."""
    tree = xml.etree.ElementTree.fromstring(re.sub(r"[\x00-\x08\x0b\x0c\x0e-\x1f]", "", paper(path, size, "-bbox-layout")))
    return [Sheet(page) for page in tree.iter("{http://www.w3.org/1999/xhtml}page")]


# What reaches beyond the frame of a page (cells of tables, which scroll, apart), how small tables are made at least, and the least
# contrast of letters with what is behind them.
MEASURE = """<script>addEventListener("load", () => {
  const root = document.documentElement, wide = root.clientWidth, shown = one => one.getClientRects().length > 0;
  const luminance = colour => { const [r, g, b] = colour.match(/[\\d.]+/g).map(x => (x / 255 <= 0.04045 ? x / 255 / 12.92 : ((x / 255 + 0.055) / 1.055) ** 2.4)); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const behind = one => { for (; one; one = one.parentElement) { const colour = getComputedStyle(one).backgroundColor; if (!/, 0\\)$/.test(colour)) return colour; } return "rgb(255, 255, 255)"; };
  const contrast = one => { const [high, low] = [luminance(getComputedStyle(one).color), luminance(behind(one))].sort((a, b) => b - a); return (high + 0.05) / (low + 0.05); };
  const letters = [...document.querySelectorAll("main *:not(svg *)")].filter(one => shown(one) && [...one.childNodes].some(child => child.nodeType === 3 && child.data.trim()));
  const faint = letters.map(one => [contrast(one), one]).sort((a, b) => a[0] - b[0])[0];
  const beyond = [...document.querySelectorAll("main *:not(svg *):not(pre)")].filter(one => shown(one) && one.getBoundingClientRect().right > wide + 1);
  const cells = beyond.filter(one => one.closest(".scroll > table"));
  parent.postMessage(JSON.stringify({ state: root.dataset.state, scheme: root.dataset.scheme, paper: luminance(behind(document.body)), page: root.scrollWidth, wide, letters: letters.length,
    cells: cells.length, beyond: beyond.filter(one => !cells.includes(one)).slice(0, 5).map(one => `${one.tagName} ${one.textContent.slice(0, 40)}`), zoom: Math.min(1, ...[...document.querySelectorAll("table")].map(one => one.style.zoom || 1)),
    contrast: faint[0], faint: `${faint[1].tagName} ${faint[1].className} ${faint[1].textContent.slice(0, 40)}` }), "*");
})</script>"""


def measured(path, width, scheme="light"):
    """What MEASURE finds in the page in a frame of so many pixels: windows are no narrower than 500."""
    with tempfile.TemporaryDirectory(prefix="pdplate_frame_") as folder:
        page, frame = pathlib.Path(folder, "page.html"), pathlib.Path(folder, "frame.html")
        page.write_text(pathlib.Path(path).read_text() + MEASURE)
        frame.write_text(f'<pre id="found"></pre><iframe style="border: 0; width: {width}px; height: 4000px" src="page.html#{scheme}"></iframe>'
                         '<script>onmessage = e => (document.getElementById("found").textContent = e.data)</script>')
        ran = run(f"file://{frame}", "--dump-dom", "--allow-file-access-from-files", "--window-size=1700,4300")
        return json.loads(next(one.text for one in Reader(ran.stdout).elements if one["id"] == "found"))


def screenshot(path, picture, width, height, scheme="light"):
    """A picture of the page, for people to look at."""
    run(f"file://{path}#{scheme}", f"--screenshot={picture}", f"--window-size={width},{height}", "--hide-scrollbars")
