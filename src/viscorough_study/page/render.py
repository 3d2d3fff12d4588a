"""Render the page as one HTML file with embedded figures, captions, and numbers linked to their table cells."""

import base64
import re
import struct
from pathlib import Path

import jinja2
from docutils.core import publish_parts
from docutils.utils.math.latex2mathml import tex2mathml
from markupsafe import Markup

from viscorough_study.run.readable import readable

SCALE = 0.675  # ratio of the width of a figure on the page to its width in the PNG file, both in pixels
# {formula in texts of the page: the same in LaTeX}; a formula precedes its parts
TYPESET = {
    "β = H/(1 + H)": r"\beta = H/(1+H)",
    "H/(1 + H)": r"H/(1+H)",
    "H > 0.4": "H > 0.4",
    "ζ ≈ π(3 − H)/10": r"\zeta \approx \pi(3-H)/10",
    "ζ ≈ 2 − H": r"\zeta \approx 2-H",
    "1/Γ(2 − α)": r"1/\Gamma(2-\alpha)",
    "vt/h": "vt/h",
}
# Letters that stand for quantities, alone or as products such as ηhL; not the initials of an author.
QUANTITIES = re.compile(r"(?<![^\W\d])(?<![&;'])(?:[FGHLXhtuvαβζηκλτ]+₀?|ηs|FJ)(?![\w'])(?!\. Popov)")
# Parts of HTML whose text is not set again: tags, and elements that typeset or run their text.
FINISHED = re.compile(r"(<(script|style|svg|math|code|title)\b.*?</\2>|<[^>]*>)", re.DOTALL)
WIDE = 600  # on a phone, images that are wider than this number of pixels can be scrolled


def render(template, style, figures, captions, *, conventions, **content):
    """Return the HTML of the page.

    template, style : text of the template and of the style sheet
    figures : {name of a figure: path of its PNG file}
    captions : {name of a figure: path of its caption, as written for Snakemake's report}
    conventions : settings for choices that the paper leaves open. Captions state the settings of their figures
    content : variables of the template
    """
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined, lstrip_blocks=True)
    environment.filters |= {"number": number, "percent": percent, "tex": tex, "formulas": formulas, "begun": begun}
    environment.globals |= {
        "image": {name: embedded_png(Path(path).read_bytes()) for name, path in figures.items()},
        "caption": {name: caption(Path(path).read_text("utf-8"), conventions) for name, path in captions.items()},
        "style": Markup(style),
    }
    return symbols(environment.from_string(template).render(content, conventions=conventions))


def symbols(html):
    """Return HTML in which the letters of quantities are marked as variables, which browsers set in italics."""
    parts, start = [], 0
    for finished in FINISHED.finditer(html):
        parts += [QUANTITIES.sub(r"<var>\g<0></var>", html[start : finished.start()]), finished[0]]
        start = finished.end()
    return "".join([*parts, QUANTITIES.sub(r"<var>\g<0></var>", html[start:])])


def tex(text):
    """Return a formula in LaTeX as MathML, which browsers typeset."""
    return Markup(tex2mathml(text, as_block=False).replace("\n", ""))


def formulas(text):
    """Return plain text as HTML with the formulas of `TYPESET` typeset, `code` marked, and no line breaks at " = "."""
    parts = re.split("(" + "|".join(map(re.escape, TYPESET)) + ")", text)
    typeset = Markup("").join(
        tex(TYPESET[part]) if part in TYPESET else part.replace(" = ", "\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}")
        for part in parts
    )
    # A Markup, whose `join` re.sub uses, would escape what replaces a match.
    return Markup(re.sub("`(.*?)`", r"<code>\1</code>", str(typeset)))


def begun(text):
    """Return a text that begins a sentence, with a capital letter unless it begins with a quantity such as vt/h."""
    return text if QUANTITIES.match(text) else text[0].upper() + text[1:]


def number(value, scale=1, unit=""):
    """Return a Number as an HTML element whose attributes name its place in a table, or a dash for None or nan.

    scale : factor by which the value is multiplied before it is displayed
    unit : text after the displayed value
    """
    if value is None or (text := readable(scale * value.value)) == "–":
        return "–"
    attributes = Markup(" ").join(Markup('{}="{}"').format(*attribute) for attribute in value.attributes.items())
    return Markup("<data {}>{}</data>").format(attributes, text + unit)


def percent(value):
    """Return a Number in percent as an HTML element, like `number`."""
    return number(value, scale=100, unit=" %")


def embedded_png(content):
    """Return the attributes of an HTML image with an embedded PNG file: {"src", "width", "height", "wide"}.

    The width is chosen so that the smallest text of the figures, 7 points, becomes 13 pixels high. `wide` is True if
    the image is too wide for a phone and must be scrolled.

    content : bytes of the PNG file
    """
    width, height = struct.unpack(">II", content[16:24])
    source = "data:image/png;base64," + base64.b64encode(content).decode("ascii")
    size = {"width": round(width * SCALE), "height": round(height * SCALE)}
    return {"src": Markup(source), "wide": size["width"] > WIDE, **size}


def caption(text, conventions):
    """Return a caption of Snakemake's report as HTML: (its first paragraph, the others).

    The first paragraph says what a reader sees in the figure, and the others how the figure was made.

    text : reStructuredText of the caption, with placeholders for conventions
    conventions : settings for choices that the paper leaves open; they replace the placeholders
    """
    snakemake = {"params": {"conventions": conventions}}
    text = jinja2.Template(text, undefined=jinja2.StrictUndefined).render(snakemake=snakemake)
    seen, _, details = text.partition("\n\n")
    return _html(seen), _html(details)


def _html(text):
    """Return reStructuredText as HTML."""
    # Files docutils.conf of the user, which would change captions unseen, are ignored.
    options = {"report_level": 2, "halt_level": 2, "_disable_config": True}
    parts = publish_parts(text, writer="html5", settings_overrides=options)
    body = re.sub(r'<span class="pre">(.*?)</span>', r"\1", parts["body"])  # the words of a text in ``
    return Markup(re.sub(r'<(tt|span) class="docutils literal">(.*?)</\1>', r"<code>\2</code>", body))
