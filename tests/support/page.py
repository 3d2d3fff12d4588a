"""Parse the page of the results."""

import re
import shutil
import subprocess
from html.parser import HTMLParser

VOID = {"meta", "img", "br", "link", "input", "hr"}
# Formulas, names and explanations, which state no results.
QUOTED = {"var", "i", "code", "cite", "details", "dl", "math", "figcaption"}
BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


def opened(path, *options):
    """Return a page after its scripts have run in a browser without an error message."""
    options += (
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        f"--user-data-dir={path.parent}",
        "--enable-logging=stderr",
    )
    command = [BROWSER, *options, "--dump-dom", path.as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, timeout=3000, check=True)
    assert "CONSOLE" not in done.stderr
    return done.stdout


class Page(HTMLParser):
    """Collect the contents of a page.

    elements : [(tag, attributes)]; numbers : [(section, attributes, text)]; texts : {section: text outside of numbers},
        without the contents of the elements `QUOTED`; text : the whole text without styles and scripts
    """

    def __init__(self, html):
        super().__init__()
        self.elements, self.numbers, self.texts, self.text, self.open = [], [], {}, "", []
        self.feed(html)
        self.close()
        assert not self.open, "elements that are not closed"
        self.ids = [attributes["id"] for _, attributes in self.elements if "id" in attributes]

    @property
    def section(self):
        return next((attributes.get("id") for tag, attributes in self.open if tag == "section"), None)

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.elements.append((tag, attributes))
        if tag == "data":
            self.numbers.append([self.section, attributes, ""])
        if tag not in VOID:
            self.open.append((tag, attributes))

    def handle_endtag(self, tag):
        assert self.open.pop()[0] == tag, f"{tag} closes something else"

    def handle_data(self, data):
        tags = [tag for tag, _ in self.open]
        if "style" in tags or "script" in tags:
            return
        self.text += data
        if "data" in tags:
            self.numbers[-1][2] += data
        elif not QUOTED & set(tags):
            self.texts[self.section] = self.texts.get(self.section, "") + data

    def attributes(self, tag):
        return [attributes for name, attributes in self.elements if name == tag]


def number_in(text):
    """Return the number in a text such as 0.397, 1.2×10⁻⁵ or 1.3 %, and half a unit of its last digit."""
    text = text.replace("−", "-")
    scale = 0.01 if text.endswith(" %") else 1.0
    text = text.removesuffix(" %")
    if match := re.fullmatch(r"(-?[\d.]+)×10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", text):
        exponent = int(match[2].translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")))
        text, scale = match[1], scale * 10.0**exponent
    decimals = len(text.partition(".")[2])
    return float(text) * scale, 0.5 * 10.0**-decimals * scale
