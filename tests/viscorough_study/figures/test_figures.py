"""Figures show the numbers of their tables, lie whole on their page, and say if their table has no rows."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.text import Text

from support import figures as tables
from support.figures import X, dashed, drawn_points, plot, published, whole_on_page, without_region
from support.study import SHOWN
from viscorough import reference
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.comparisons.histories import FORCE_CURVE, RECOVERY
from viscorough_study.figures.exponent import SHIFT
from viscorough_study.figures.failures import OUTCOMES
from viscorough_study.figures.style import SMALL
from viscorough_study.fits.conventions import READINGS, fits
from viscorough_study.robustness.outcomes import VERDICTS

pytestmark = pytest.mark.filterwarnings("error")


def close(line, expected):
    np.testing.assert_allclose(line, expected, rtol=1e-9)


@pytest.mark.long
def test_figures_are_whole_and_no_text_is_too_small(drawn):
    assert [name for name, figure in drawn.items() if not whole_on_page(figure)] == []
    for name, figure in drawn.items():
        texts = [text for text in figure.findobj(Text) if text.get_text()]
        assert min(text.get_fontsize() for text in texts) >= SMALL, name


@pytest.mark.parametrize("name", tables.FROM_TABLES)
def test_figure_of_no_rows_says_so(name):
    first, *others = tables.FROM_TABLES[name]
    (text,) = plot(tables.MODULES[name], first[:0], *others).texts
    assert text.get_text() == "no data with these settings"


# ---- numbers of tables


def points(rows, x, *columns):
    """Points (x, column) of the rows; nan for an x or column that is None, because its values are shifted."""
    rows = rows.assign(none=np.nan)
    return np.concatenate([rows[[x or "none", column or "none"]].to_numpy() for column in columns])


def expected_points(scaling):
    """(figure, panel, points that its axes have)"""
    reduction, lambdas = published("reduction"), published("mdr_lambda")
    media, curves, interface = tables.media_table(), tables.interface_curves(), published("interface")
    lines = fits(scaling, SHOWN, source="lines", rms_convention="line")
    interval = ("beta", "beta_low", "beta_high")
    yield "fig4_exponent", 0, points(lines, "hurst", *interval)
    for reading, columns in READINGS.items():
        rows = fits(scaling, SHOWN | columns, source="discs")
        yield "fig4_exponent", 0, points(rows.assign(place=rows["hurst"] + SHIFT[reading]), "place", *interval)
    for panel, name in ((0, "stiffness"), (2, "area"), (3, "gap")):
        columns = [f"{name}_ratio{end}" for end in ("", "_low", "_high")]
        yield "reduction", panel, points(reduction.dropna(subset=columns), "x", *columns)
    yield "reduction", 4, points(reduction, "x", "correlation")
    yield "reduction", 5, points(reduction, "x", "force_ratio")
    yield "mdr_lambda", 0, points(lambdas, "x", "lambda", "lambda_low", "lambda_high")
    yield "mdr_lambda", 1, points(lambdas, "x", "velocity_ratio")
    yield "mdr_lambda", 2, points(published("mdr_exponents"), None, "difference")
    for figure, table, key, x, y in (
        ("media", media, "medium", "time", "velocity"),
        ("validation", published("validation"), "quantity", "elements", "error"),
        ("direct", published("direct"), "case", "contact_count", "depth_ratio"),
    ):
        for panel, (_, rows) in enumerate(table.groupby(key, sort=False)):
            yield figure, panel, points(rows, x, y)
    yield "media", 2, points(media, "x", "depth")
    motions = dict(tuple(tables.histories_table().query("hurst == 0.9").groupby("motion")))
    yield "histories", 0, points(motions[FORCE_CURVE], "depth", "force", "direct")
    yield "histories", 1, points(motions[RECOVERY].query("time >= 0"), "time", "depth", "direct")
    yield (
        "interface",
        0,
        points(curves[curves["source"] == "discs"], "x", "interface", "interface_low", "interface_high"),
    )
    yield "interface", 0, points(published("periodic"), "x", "g")
    yield "interface", 3, points(interface.query("source == 'discs'"), None, "u0", "u0_low")
    fine = tables.FROM_TABLES["local_exponent"][0].query("finest == 1")
    fine = fine.assign(middle=fine["x_low"] * np.sqrt(10))
    for panel, quantity in enumerate(("whole", "interface")):
        yield "local_exponent", panel, points(fine[fine["quantity"] == quantity], "middle", "beta")
    yield "fig4_exponent", 0, points(pd.DataFrame(tables.FINE_GRIDS), "hurst", *interval)


def test_figures_show_the_numbers_of_their_tables(drawn, scaling):
    for figure, panel, expected in expected_points(scaling):
        shown = drawn_points(drawn[figure].axes[panel])
        expected = expected[~np.isnan(expected).all(axis=1)][:, None]
        assert len(expected) > 1
        near = (np.isclose(shown, expected, rtol=1e-9, atol=1e-12) | np.isnan(expected)).all(axis=2).any(axis=1)
        assert near.all(), (figure, panel, expected[~near])


def test_speed_has_a_labelled_curve_for_each_model_of_the_mean(drawn):
    means, axes = tables.FROM_TABLES["speed"][0], drawn["speed"].axes[0]
    rows = means.query("quantity == 'velocity' and hurst == 0.4").dropna(subset="error")
    curves = [line.get_xydata() for line in axes.lines if line.get_marker() in "ov^"]
    models = rows.query("model != 'law'").groupby(["model", "across"], dropna=False)
    for _, curve in models:
        assert any(np.allclose(curve[["processor_s", "error"]], shown) for shown in curves)
    labels = {text.get_text() for text in axes.texts}
    assert {"33 × 33", "discs, 257 × 257", "MDR, λ = π", "law, every $H$"} <= labels
    (law,) = [line for line in axes.lines if line.get_marker() == "D"]
    close(law.get_ydata(), means.query("model == 'law' and quantity == 'velocity'")["error"])
    assert axes.patches[0].get_bbox().y1 == rows["reference_error"].iloc[0]


def test_other_solvers_have_bars_of_their_published_times(drawn):
    others, axes = tables.FROM_TABLES["speed"][1], drawn["speed"].axes[1]
    ratios = {}
    for race in others:
        if (race["task"], race["hurst"]) == ("eight levels", 0.4):
            ratios.setdefault(race["solver"].split()[0], []).append(race["ratio"])
    assert sorted(bar.get_width() for bar in axes.patches) == sorted(min(found) for found in ratios.values())
    assert "8 depths of a disc, 257 × 257,\n$H$ = 0.4, one thread,\nresidual $10^{-6}$" in axes.get_title()


def test_speed_without_a_law_has_no_marker_of_the_law():
    means, others = tables.FROM_TABLES["speed"]
    means = means.assign(error=means["error"].mask(means["model"] == "law"))
    assert [line for line in plot("speed", means, others).axes[0].lines if line.get_marker() == "D"] == []


def test_failures_show_the_outcome_of_every_cell_and_count_what_is_wrong(drawn):
    (table,) = tables.FROM_TABLES["failures"]
    axes = drawn["failures"].axes[0]
    shown = axes.images[0].get_array().astype(int).ravel()
    assert [list(OUTCOMES)[place] for place in shown] == table["verdict"].tolist()
    assert len({color for _, color, _ in OUTCOMES.values()}) == len(OUTCOMES)
    stated = (table["verdict"] == "stated").sum()
    title = f"0 of {len(table)} results are silently wrong; {stated} are models outside their range"
    assert axes.get_title() == title
    silent = table.assign(verdict=table["verdict"].where(table.index > 1, "unnoticed"))
    assert plot("failures", silent).axes[0].get_title().startswith(f"2 of {len(table)}")
    assert set(OUTCOMES) == set(VERDICTS)


# ---- single figures


def test_surfaces_are_darker_where_higher():
    examples = [(h, self_affine_disc(h, 33, seed=1).heights, 1 / 33) for h in (0.1, 0.5, 0.9)]
    panels = [axes for axes in plot("surfaces", examples).axes if axes.images]
    ends = min(np.nanmin(heights) for _, heights, _ in examples), max(np.nanmax(heights) for _, heights, _ in examples)
    for axes, (hurst, heights, _) in zip(panels, examples, strict=True):
        (image,) = axes.images
        np.testing.assert_array_equal(image.get_array().filled(np.nan), heights)
        assert image.get_extent() == pytest.approx([-0.5, 0.5, -0.5, 0.5])
        assert image.get_clim() == ends
        assert axes.get_title() == f"$H={hurst:g}$"
    grey = image.to_rgba(np.linspace(*ends, 20))[:, :3] @ (0.3, 0.6, 0.1)
    assert (np.diff(grey) < 0).all()


def test_master_curve_is_bold_in_region_b_of_each_reading(pooled, lines, scaling):
    """The second reading has the ensemble of its square and the windows of its own rows."""
    law, *ratios = plot("master_curve", pooled, pooled[:1], lines, scaling, SHOWN, fraction_min=0.95).axes
    (identity,) = dashed(law)
    np.testing.assert_array_equal(identity.get_xdata(), identity.get_ydata())
    for axes, members, (group, rms) in zip(
        ratios, (pooled, pooled[:1]), (("base", "disc"), ("longer_period", "square")), strict=True
    ):
        np.testing.assert_array_equal(dashed(axes)[0].get_ydata(), 1)
        windows = fits(scaling, SHOWN, source="discs", case_group=group, rms_convention=rms).set_index("hurst")
        curves = [line for line in axes.lines if len(line.get_xdata()) > 2]
        for ensemble, thin, bold in zip(members, curves[::2], curves[1::2], strict=True):
            hurst, discs = ensemble["hurst"].item(), ensemble.sel(rms_convention=rms)
            expected = discs["velocity_geometric"].values / reference.rate_law(X, hurst, gamma=True)
            kept = (discs["contact_count_median"].values > 1) & (discs["fraction_defined"].values >= 0.95)
            close(thin.get_xydata(), np.transpose([X, expected])[kept])
            inside = kept & (windows.x_low[hurst] * 0.999 < X) & (windows.x_high[hurst] * 1.001 > X)
            close(bold.get_xydata(), np.transpose([X, expected])[inside])
            assert bold.get_linewidth() > 2 * thin.get_linewidth()
    dotted = [line for line in law.lines if line.get_linestyle() == ":"]
    for ensemble, line in zip(lines, dotted, strict=True):
        kept = (ensemble["contact_count_median"].values[0] > 1) & (ensemble["fraction_defined"].values[0] == 1)
        close(line.get_ydata(), ensemble["velocity_geometric"].values[0][kept])


def test_master_curve_of_one_realization_without_region(discs, lines, scaling):
    single = [ds.isel(realization=[0]) for ds in discs[::2]]
    for ds in single:  # as the ensemble of one realization has it
        ds["velocity_spread"] = ds["velocity_spread"] * np.nan
        ds["realizations_defined"] = ds["realizations_defined"] * 0 + 1
    figure = plot("master_curve", single, [], lines[:1], without_region(scaling, 0.4), SHOWN, fraction_min=0.95)
    thin, bold = figure.axes[1].lines[:2]
    assert bold.get_xdata().size == 0
    assert thin.get_xdata().size > 3


def test_laws_of_others_stand_beside_the_interface(drawn):
    _, _, law, plateaus = drawn["interface"].axes
    ratio = np.concatenate([line.get_ydata() for line in law.lines if len(line.get_xdata()) > 2])
    close(ratio[~np.isnan(ratio)], 1.02)
    assert np.isnan(ratio).any(), "where g is too small a part of vt/h to be known"
    u0 = published("literature").query("quantity == 'u0'").dropna(subset=["hurst", "theirs_low"])
    (band,) = [collection for collection in plateaus.collections if len(collection.get_facecolor())]
    corners = u0.query("theirs_low != theirs_high")[["hurst", "theirs_low"]].to_numpy()
    assert set(map(tuple, corners)) < set(map(tuple, band.get_paths()[0].vertices))
    (stated,) = [line for line in dashed(plateaus) if line.get_marker() == "None"]
    assert set(stated.get_ydata()) == set(u0.query("theirs_low == theirs_high")["theirs_low"])


def test_law_has_the_band_and_the_number_of_discs_of_the_mean(drawn):
    """The interval of the mean is 10 % to either side, and the law 2 % above the mean."""
    law = drawn["interface"].axes[2]
    bands = [band for band in law.collections if len(band.get_paths()) and len(band.get_paths()[0].vertices) > 10]
    heights = np.concatenate([band.get_paths()[0].vertices[:, 1] for band in bands])
    close([heights.min(), heights.max()], [1.02 / 1.1, 1.02 / 0.9])
    discs = published("interface").query("source == 'discs' and across == 257 and hurst < 1")
    labels = [text.get_text() for text in law.get_legend().get_texts()]
    (number,) = set(discs["realizations"])
    hurst = ", ".join(f"{value:g}" for value in sorted(discs["hurst"]))
    assert labels[0] == f"{number:g} discs: $H$ = {hurst}"
    assert len(labels) == 1 + (len(bands) > len(discs))


def test_axes_of_lambda_show_its_change_within_region_b(drawn):
    """The values of region (b), and little else, between the ends of the axes."""
    table = published("mdr_lambda").query("in_region == 1")
    for axes, name in zip(drawn["mdr_lambda"].axes, ("lambda", "velocity_ratio"), strict=False):
        low, high = table[f"{name}_low"].min(), table[f"{name}_high"].max()
        bottom, top = axes.get_ylim()
        assert 0.6 * low < bottom < low
        assert high < top < high / 0.6


def test_exponent_of_what_has_no_region_and_intervals_beside_their_value(scaling):
    def symbols(table):
        axes = plot("exponent", table, SHOWN, (0.4, 1.0), []).axes[0]
        values = [line for line in axes.lines if line.get_linestyle() == "None" and line.get_marker() not in "_|"]
        return axes, [line.get_xydata()[0] for line in values]

    in_a = scaling[scaling["reading"] == "A"]
    assert [round(hurst, 1) for hurst, _ in symbols(without_region(in_a, 0.4))[1]] == [0.1, 0.6, 0.9]
    assert not symbols(scaling[scaling["source"] == "lines"])[1]
    beside = in_a.assign(beta_low=in_a["beta"] + 0.1, beta_high=in_a["beta"] + 0.3)
    axes, drawn = symbols(beside)
    close(axes.containers[0].lines[2][0].get_segments()[0][:, 1] - drawn[0][1], [0.1, 0.3])


def test_measured_scans_stand_beside_the_generated_discs(drawn, pooled, scaling):
    law, motion = drawn["measured"].axes
    for line in (line for line in law.lines if line.get_linewidth() == 3):  # over region (b), at the slope of the fit
        (x0, y0), (x1, y1) = line.get_xydata()
        rows = scaling[np.isclose(scaling["x_low"], x0) & np.isclose(scaling["x_high"], x1)]
        assert np.isclose(np.log(y1 / y0) / np.log(x1 / x0), rows["beta"]).any()
    assert len(motion.lines) == 8
    close(motion.lines[0].get_ydata(), tables.measured_kinetics()["depth"][:13] * 1e6)
    assert motion.get_title() == "(b) depth under 0.1, 1 N"
    none = tables.measured_kinetics()[:0]
    motion = plot("measured", {"polished": pooled[0]}, pooled, scaling, none, SHOWN, fraction_min=0.95).axes[1]
    assert motion.get_title() == "(b) depth: no forces were given"
