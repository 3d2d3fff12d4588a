"""The page of the results is one complete file, and every number on it is in a table."""

import base64
import re
from html import unescape

import numpy as np
import pytest
import yaml

from support.code_blocks import run_python, run_shell
from support.page import BROWSER, Page, number_in, opened
from support.workflow import ROOT, TABLES, merged, read_settings
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.page.content import as_yaml
from viscorough_study.run.settings import changed_settings, check_settings
from viscorough_study.run.tables import read_table
from viscorough_study.verdicts.claims import counted_verdicts, verdicts_of

LARGEST = 3e6  # bytes


@pytest.fixture(scope="module")
def html(finished_once):
    return (finished_once / "results/index.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def page(html):
    return Page(html)


@pytest.fixture(scope="module")
def tables(finished_once):
    texts = {"keep_default_na": False, "na_values": [""]}
    return {path.stem: read_table(path, **texts) for path in (finished_once / "results/tables").glob("*.csv")}


def test_every_image_is_embedded_and_described(finished_once, page):
    described = set(yaml.safe_load((ROOT / "workflow/page/figures.yaml").read_text(encoding="utf-8")))
    made = described & {path.stem for path in (finished_once / "results/figures").glob("*.png")}
    images = page.attributes("img")
    published = {"interface", "reduction", "media", "histories", "local_exponent"}
    assert len({image["src"] for image in images}) == len(made | published) + 1 > 15, "and the picture of the rules"
    for image in images:
        kind, content = image["src"].split(",", 1)
        assert kind == "data:image/png;base64"
        assert base64.b64decode(content, validate=True).startswith(b"\x89PNG")
        assert len(image["alt"]) > 40
        assert int(image["width"]) > 100


def test_code_on_the_page_runs(html, tmp_path, monkeypatch):
    """The blocks are Python or command lines, on the heights that they name."""
    monkeypatch.chdir(tmp_path)
    np.save("heights.npy", self_affine_disc(0.7, 33, rms=1e-7, diameter=33e-6, seed=1).heights)
    blocks = [unescape(text) for text in re.findall(r"<pre[^>]*><code>(.*?)</code></pre>", html, re.DOTALL)]
    assert len(blocks) == html.count("<pre") == 2
    for text in blocks:
        if text.startswith("import "):
            run_python(text, "results/index.html", 0, {})
        else:
            run_shell(text)
    lines = [unescape(line) for line in re.findall(r"<code>(viscorough \w+ [^<]*)</code>(?!</pre>)", html)]
    assert len(lines) >= 1
    for line in lines:
        run_shell(line)


def test_page_names_the_settings_file_and_every_setting_that_it_changes(html):
    assert "<code>.venv/bin/snakemake --cores 2 --configfile config/test.yaml</code>" in html
    default = read_settings("config")
    settings = check_settings(merged(default, read_settings("test")))
    for name, values in changed_settings(check_settings(default), settings).items():
        row = html.split(f"<code>{name}</code></th>")[1].split("</tr>")[0]
        assert [unescape(cell)[:50] for cell in re.findall("<td>(.*?)</td>", row)] == [
            as_yaml(value)[:50] for value in values
        ]


def test_page_loads_nothing_from_elsewhere(html, page):
    assert len(html.encode()) < LARGEST
    assert not {"link", "iframe", "base"} & {tag for tag, _ in page.elements}
    scripts = [set(attributes) for attributes in page.attributes("script")]
    assert scripts == [{"id", "type"}, set(), {"id", "type"}, set(), set(), set()], (
        "law, calculator; data, uPlot, chart; origin"
    )
    assert set(re.findall(r"url\(.", html)) == {"url(#"}
    assert "@import" not in html
    links = [attributes["href"] for _, attributes in page.elements if "href" in attributes]
    assert len(links) > 8
    outside = {link for link in links if not link.startswith("#")}
    assert {link for link in outside if not link.startswith("..")} == {"https://doi.org/10.1103/PhysRevE.87.042802"}
    assert all((ROOT / "results" / link).resolve().is_file() for link in outside if link.startswith(".."))
    assert set(links) - outside <= {f"#{name}" for name in page.ids}
    assert len(page.ids) == len(set(page.ids))
    sources = [attributes["src"] for _, attributes in page.elements if "src" in attributes]
    assert all(source.startswith("data:") for source in sources)


def test_every_number_is_in_a_table(page, tables):
    assert len(page.numbers) > 100
    for _, place, text in page.numbers:
        number, half_a_digit = number_in(text)
        table = tables[place["data-table"]]
        if "data-row" in place:
            value = float(table.at[int(place["data-row"]), place["data-column"]])
        elif place["data-column"] in table:
            value = (table[place["data-column"]] == place["data-counted"]).sum()
        else:
            kind = re.search("own|quoted", place["data-column"])[0]
            value = dict(counted_verdicts(table, kind))[place["data-counted"]]
        assert value == float(place["value"]), place
        assert abs(number - value) <= 1.001 * half_a_digit, (place, text)


def test_tooltip_of_every_number_names_its_rule_whose_script_has_the_same_name(page):
    for _, place, _ in page.numbers:
        table, rule = re.fullmatch(r"results/tables/(\w+)\.csv, .+; rule (\w+)", place["title"]).groups()
        assert table == place["data-table"]
        assert rule == TABLES[table]
        assert (ROOT / f"workflow/scripts/{rule}.py").is_file()


def test_page_marks_a_trial_run_and_shows_no_raw_values(page):
    assert "trial: its verdicts mean nothing." in page.text
    assert not re.search(r"\{['\"]|spawn_key|None|nan\b|dtype|<[a-z]", page.text.replace("nan marks points", ""))


def test_every_claim_has_an_entry_with_its_verdict_and_links_lead_to_it(html, page, tables):
    verdicts = verdicts_of(tables["claims"])
    assert len(verdicts) > 20
    assert set(verdicts) <= set(page.ids)
    for name, verdict in verdicts.items():
        entry = html.split(f'id="{name}"')[1]
        shown = re.search(r'<span class="verdict \w+">(.*?)</span>', entry)[1]
        assert unescape(re.sub("</?var>", "", shown)) == verdict.text
    linked = {attributes["href"].removeprefix("#") for attributes in page.attributes("a") if "href" in attributes}
    assert set(verdicts) - {"identities"} <= linked


@pytest.mark.skipif(BROWSER is None, reason="no Chromium is installed")
def test_narrow_screen_needs_no_horizontal_scrolling(html, tmp_path):
    """The page is in a frame, since the windows of Chromium are at least 500 pixels wide."""
    (tmp_path / "page.html").write_text(html, encoding="utf-8")
    width = "document.title = this.contentDocument.documentElement.scrollWidth"
    path, size = tmp_path / "frame.html", 'width="400" height="900"'
    path.write_text(f'<!DOCTYPE html><title>-</title><iframe src="page.html" {size} onload="{width}"></iframe>')
    assert "<title>400</title>" in opened(path, "--hide-scrollbars", "--allow-file-access-from-files")


READOUT = (
    r"H = [\d.]+, F = \S+ N, η = \S+ Pa s, L = \S+ mm, h = \S+ µm: after \S+ s, \S+ µm/s, "
    r"\S+ elements in contact \(median\); X = \S+, vt/h = \S+"
)
POINT = """
<script>
addEventListener("load", () => setTimeout(() => {
  document.querySelector("#chart-switches button").click();
  const over = document.querySelector("#chart .u-over"), { left, top, width, height } = over.getBoundingClientRect();
  for (const type of ["mouseenter", "mousemove"]) for (let y = 0; y < height; y += 10) {
    over.dispatchEvent(new MouseEvent(type, { clientX: left + 0.8 * width, clientY: top + y, bubbles: true }));
    const text = document.getElementById("chart-readout").textContent;
    if (text.startsWith("H")) { document.title = text; return; }
  }
}, 500));
</script>
"""


@pytest.mark.skipif(BROWSER is None, reason="no Chromium is installed")
def test_chart_shows_the_curve_under_the_pointer_and_hides_curves(html, tmp_path):
    """The first button hides the curves of the smallest Hurst exponent."""
    (tmp_path / "page.html").write_text(html.replace("</body>", f"{POINT}</body>"), encoding="utf-8")
    shown = opened(tmp_path / "page.html", "--virtual-time-budget=5000")
    assert re.search(r'<div id="interactive" class="ready">', shown)
    title = re.search("<title>(.*?)</title>", shown)[1]
    assert re.fullmatch(READOUT, title)
    hidden = re.search(r'<button[^>]*aria-pressed="false"[^>]*>([\d.]+)</button>', shown)[1]
    assert not title.startswith(f"H = {hidden},")


TRACE = """
<script>
addEventListener("load", () => {
  const popover = document.getElementById("origin"), seen = [];
  const [first, second] = document.querySelectorAll("#answer table data");
  const press = (key) => document.activeElement.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  const look = () => seen.push(popover.matches(":popover-open") ? popover.textContent : "closed");
  first.click();
  look();
  popover.hidePopover();
  press("ArrowRight");
  look();
  press(" ");
  look();
  const places = [first, second].map((number) => `value ${number.value}${number.title.split("; ").join("")}`);
  const wanted = [places[0], "closed", places[1]];
  document.title = `${seen.every((text, i) => text === wanted[i])} ${[first, second].map((number) => number.tabIndex)}`;
});
</script>
"""


@pytest.mark.skipif(BROWSER is None, reason="no Chromium is installed")
def test_numbers_show_their_origin_by_click_and_keyboard(html, tmp_path):
    """The tab key reaches one number of a table."""
    (tmp_path / "page.html").write_text(html.replace("</body>", f"{TRACE}</body>"), encoding="utf-8")
    shown = opened(tmp_path / "page.html", "--virtual-time-budget=3000")
    assert re.search("<title>(.*?)</title>", shown)[1] == "true -1,0"
    assert not re.search(r"<(a|summary)\b[^>]*>[^<]*<data[^>]* role=", shown), "no control in another control"


@pytest.mark.skipif(BROWSER is None, reason="no Chromium is installed")
def test_calculator_estimates_and_details_unfold(html, tmp_path):
    (tmp_path / "page.html").write_text(html, encoding="utf-8")
    shown = opened(tmp_path / "page.html", "--virtual-time-budget=3000")
    assert re.search(r'<output id="estimate-output"[^>]*>Depth [\d.]+ \[', shown)
    assert "Without scripts there is no estimate here." not in shown
