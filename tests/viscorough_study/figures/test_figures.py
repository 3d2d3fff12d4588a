"""Figures show the numbers of their tables, lie whole on their page, and refuse tables without rows."""

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from support import figures as tables
from support.figures import HURST, X, coordinates, dashed, legend_texts, markers, plot, whole_on_page, without_region
from support.study import SHOWN
from viscorough import reference
from viscorough.surfaces import self_affine_disc
from viscorough_study.figures.collapse import SHIFT
from viscorough_study.fits.conventions import fits, select

pytestmark = pytest.mark.filterwarnings("error")


def close(line, expected):
    np.testing.assert_allclose(line, expected, rtol=1e-9)


def test_figures_are_whole(drawn, scaling):
    figures = drawn | {"no region": plot("conventions", without_region(scaling, 0.4), SHOWN)}
    assert [name for name, figure in figures.items() if not whole_on_page(figure)] == []


@pytest.mark.parametrize("name", [name for name in tables.FROM_TABLES if name != "validation"])
def test_figure_of_no_rows_is_refused(name):
    first, *others = tables.FROM_TABLES[name]
    with pytest.raises(ValueError, match=f"plot_{tables.MODULES[name]}: .*(no rows|two sizes)"):
        plot(tables.MODULES[name], first[:0], *others)


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


@pytest.mark.parametrize("average", ["geometric", "arithmetic"])
def test_master_curve_shows_both_sides_of_the_law(pooled, lines, scaling, average):
    conventions = SHOWN | {"average": average}
    law, ratio = plot("master_curve", pooled, lines, scaling, conventions, fraction_min=0.95).axes
    (identity,) = dashed(law)
    np.testing.assert_array_equal(identity.get_xdata(), identity.get_ydata())
    np.testing.assert_array_equal(dashed(ratio)[0].get_ydata(), 1)
    windows = fits(scaling, conventions, source="discs", case_group="base").set_index("hurst")
    for rank, ensemble in enumerate(pooled):
        hurst, discs = ensemble["hurst"].item(), ensemble.sel(rms_convention="disc")
        right, left = reference.rate_law(X, hurst, gamma=True), discs[f"velocity_{average}"].values
        window = (windows.x_low[hurst] * 0.999 < X) & (windows.x_high[hurst] * 1.001 > X)
        for (marks, _, bars), inside in zip(law.containers[2 * rank : 2 * rank + 2], (True, False), strict=True):
            x, y = marks.get_data()
            at = np.searchsorted(right, x * (1 - 1e-9))
            close([x, y], [right[at], left[at]])
            assert (window[at] == inside).all()
            assert x.size >= 3
            assert (to_rgb(marks.get_markerfacecolor()) != (1, 1, 1)) == inside
            error = 2 * discs["velocity_spread"].values[at] / np.sqrt(discs["realizations_defined"].values[at])
            ends = np.array([segment[:, 1] for segment in bars[0].get_segments()])
            np.testing.assert_allclose(np.log(ends / y[:, None]), np.transpose([-error, error]), atol=1e-9)
    for ensemble, line in zip(lines, [line for line in law.lines if line.get_zorder() == 3], strict=True):
        kept = (ensemble["contact_count_median"].values[0] > 1) & (ensemble["fraction_defined"].values[0] == 1)
        close(line.get_ydata(), ensemble[f"velocity_{average}"].values[0][kept])


def test_master_curve_of_one_realization_without_region(discs, lines, scaling):
    single = [ds.isel(realization=[0]) for ds in discs[::2]]
    for ds in single:  # as the ensemble of one realization has it
        ds["velocity_spread"] = ds["velocity_spread"] * np.nan
        ds["realizations_defined"] = ds["realizations_defined"] * 0 + 1
    figure = plot("master_curve", single, lines[:1], without_region(scaling, 0.4), SHOWN, fraction_min=0.95)
    inside, outside = figure.axes[0].containers[:2]
    assert inside[0].get_xdata().size == 0
    assert outside[0].get_xdata().size > 3


def drawn_points(axes):
    """Every point of the lines, intervals and bands of an axes."""
    paths = [path for collection in axes.collections for path in collection.get_paths()]
    return np.concatenate([*coordinates(axes), *(path.vertices for path in paths), np.full((1, 2), np.inf)])


def shown_columns(scaling):
    """{figure: (panel, rows of a table, column along x, columns along y)}"""
    lambdas, _ = tables.mdr_lambda_tables()
    media, validation, direct = tables.media_table(), tables.validation_table(), tables.direct_table()
    interface, curves = tables.interface_tables_drawn()
    interval = ["beta", "beta_low", "beta_high"]
    yield "fig4_exponent", 0, fits(scaling, SHOWN, source="lines", rms_convention="line"), "hurst", interval
    yield "fig4_exponent", 0, fits(scaling, SHOWN, source="discs", case_group="base"), "hurst", interval
    for panel, name in enumerate(("stiffness", None, "area", "gap")):
        if name:
            columns = [f"{name}_ratio{end}" for end in ("", "_low", "_high")]
            yield "reduction", panel, tables.mdr_table(), "x", columns
    yield "reduction", 4, tables.mdr_table(), "x", ["correlation"]
    yield "reduction", 5, tables.mdr_table(), "x", ["force_ratio"]
    yield "mdr_lambda", 0, lambdas, "x", ["lambda", "lambda_low", "lambda_high"]
    yield "mdr_lambda", 1, lambdas, "x", ["velocity_ratio"]
    for panel, name in enumerate(("newtonian", "standard_linear_solid")):
        rows = media[media["medium"] == name]
        yield "media", panel, rows, "time", ["velocity"]
        yield "media_exponents", panel, rows, "time", ["exponent", "expected"]
    yield "media", 2, media, "x", ["depth"]
    for panel, name in enumerate(("force", "depth")):
        yield "validation", panel, validation[validation["quantity"] == name], "elements", ["error"]
    for panel, name in enumerate(("sphere", "rough disc, H = 0.4")):
        yield "direct", panel, direct[direct["case"] == name], "contact_count", ["depth_ratio"]
    base = curves[curves["across"] == 257]
    yield "interface", 0, base[base["hurst"] == 0.9], "x", ["interface", "interface_low", "interface_high"]
    yield "interface", 3, interface[(interface["case_group"] == "base")], "hurst", ["u0", "u0_low", "u0_high"]


def test_figures_show_the_numbers_of_their_tables(drawn, scaling):
    for figure, panel, rows, x, columns in shown_columns(scaling):
        points = drawn_points(drawn[figure].axes[panel])
        for column in columns:
            expected = rows[[x, column]].dropna().to_numpy()[:, None]
            assert len(expected) > 1
            near = np.isclose(points, expected, rtol=1e-9, atol=0).all(axis=2).any(axis=1)
            assert near.all(), (figure, panel, column, expected[~near])


def test_what_fails_or_is_not_known_looks_different(drawn):
    assert {text.get_text() for text in drawn["validation"].axes[0].texts} == {"2.0 failed", "2.0"}
    coarse = plot("validation", tables.validation_table([33])).axes[0]
    assert [text.get_text() for text in coarse.texts] == ["failed"]
    (bars,) = drawn["level_placement"].axes
    assert [(bar.get_width(), bool(bar.get_hatch())) for bar in bars.patches] == [(1, False), (0.8, False), (20, True)]
    differences = [line for line in drawn["mdr_lambda"].axes[2].lines if line.get_marker() in "oDs"]
    assert [line.get_ydata().item() for line in differences] == [-0.1, 0.0, -0.1, 0.0]  # a third one is nan


def test_laws_of_others_stand_beside_the_interface(drawn):
    _, _, law, plateaus = drawn["interface"].axes
    x, ratio = (np.concatenate([getattr(line, f"get_{axis}data")() for line in law.lines[:3]]) for axis in "xy")
    close(ratio[~np.isnan(ratio)], 1.02)
    assert x[np.isnan(ratio)].min() > 1  # where g is too small a part of vt/h to be known
    (band,) = [collection for collection in plateaus.collections if len(collection.get_facecolor())]
    corners = {tuple(corner) for corner in band.get_paths()[0].vertices}
    assert corners == {(0.4, 0.5), (0.4, 0.56), (0.9, 0.41), (0.9, 0.46)}
    (stated,) = [line for line in dashed(plateaus) if line.get_marker() == "None"]
    assert set(stated.get_ydata()) == {0.4}


def test_exponent_of_what_has_no_region_and_intervals_beside_their_value(scaling):
    (kept,) = markers(plot("exponent", without_region(scaling, 0.4), SHOWN, (0.4, 1.0)).axes[0])
    assert kept.get_xdata().tolist() == [0.9]
    assert not markers(plot("exponent", scaling[scaling["source"] == "lines"], SHOWN, (0.4, 1.0)).axes[0])
    beside = scaling.assign(beta_low=scaling["beta"] + 0.1, beta_high=scaling["beta"] + 0.3)
    axes = plot("exponent", beside, SHOWN, (0.4, 1.0)).axes[0]
    close(axes.containers[0].lines[2][0].get_segments()[0][:, 1] - markers(axes)[0].get_ydata(), [0.1, 0.3])


def test_conventions_have_a_row_for_each_change(scaling):
    figure = plot("conventions", scaling, SHOWN)
    grid = np.reshape(figure.axes, (2, len(HURST)))
    labels = [text.get_text() for text in grid[0, 0].get_yticklabels()]
    assert (labels[0], labels[2], labels[7]) == ("as in other figures", "$h$ of the square", "roll-off (control)")
    changes = [{}, {"average": "arithmetic"}, {"rms_convention": "square"}]
    changes += [{"window_rule": rule} for rule in ("lower_half", "upper_half", "kappa")]
    changes += [{"gamma": "with"}, {"case_group": "roll_off"}]
    for axes, quantity in zip(grid, ("beta", "zeta"), strict=True):
        for panel, hurst in zip(axes, HURST, strict=True):
            rows = {int(line.get_ydata()[0]): line.get_xdata()[0] for line in markers(panel)}
            for y, change in enumerate(changes):
                wanted = SHOWN | {"source": "discs", "case_group": "base", "hurst": hurst} | change
                (value,) = select(scaling, wanted)[quantity]
                assert rows.get(y) == value if np.isfinite(value) else y not in rows
    upright = [line for line in grid[1, 1].lines if len(set(line.get_xdata())) == 1 and line.get_zorder() == 1]
    assert {line.get_xdata()[0] for line in upright} == {reference.zeta_viscous(0.9), reference.zeta_elastic(0.9)}
    empty, other = plot("conventions", without_region(scaling, 0.4), SHOWN).axes[:2]
    assert [text.get_text() for text in empty.texts] == ["no region (b)"] * 8
    assert len(markers(other)) + len(other.texts) == 8


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


def test_collapse_makes_curves_of_a_law_horizontal(drawn):
    whole, _, exponents = drawn["collapse"].axes
    for rank in range(2):
        for line in whole.lines[2 * rank : 2 * rank + 2]:
            close(line.get_ydata(), np.exp(0.5) * SHIFT**-rank)
    assert [line.get_xdata()[0] for line in whole.lines[:2]] == pytest.approx([1e-4 * 33**1.4, 1e-4 * 129**1.4])
    bars = [line for line in exponents.lines if line.get_linewidth() == 4]
    assert [tuple(np.round(bar.get_ydata(), 3)) for bar in bars] == [(-0.02, 0.02)] * 4
    values = [line for line in exponents.lines if line.get_marker() in "os" and len(line.get_xdata()) == 1]
    assert [line.get_ydata()[0] for line in values] == pytest.approx([0.03] * 8)


def test_sizes_have_a_marker_for_every_ensemble_with_a_fit(drawn):
    """In the window of region (b) of discs and lines, and in the fixed one."""
    figure, moving = drawn["sizes"], [0.3, 0.3, 0.31, 0.31]
    for axes, expected in zip(figure.axes, ([0.01, *moving], moving, [0.35] * 6, [0.35] * 6), strict=True):
        values = [line for line in axes.lines if line.get_marker() not in ("None", "", "_", "|")]
        assert sorted(line.get_ydata()[0] for line in values) == expected
    assert "4 to 8 discs" in figure.axes[0].get_title()
    table = tables.sizes_table()
    assert len(plot("sizes", table[table["window_rule"] == "default"], SHOWN).axes) == 2


def test_exponents_of_the_cost_of_one_disc_are_those_of_the_larger_half(drawn):
    table = tables.large_table()
    time, memory = (legend_texts(axes.get_legend()) for axes in drawn["large"].axes)
    slope = np.log(table["processor"].iloc[3] / table["processor"].iloc[2]) / np.log(10)
    assert time == ["measured (elements across)", "wall time on 2 threads", f"exponent {slope:.2f}"]
    assert memory == ["measured (elements across)", "exponent 1.00"]


def test_growth_under_light_loads_is_that_of_maps_of_all_sizes(drawn):
    growth, ratios = drawn["light_contact"].axes
    labels = legend_texts(growth.get_legend())
    assert labels == ["contact of 0.05 %, $N^{1.50}$", "contact of 0.5 %, $N^{1.50}$", "reading and ranking the map"]
    points = {tuple(line.get_ydata()) for line in ratios.lines if line.get_linestyle() == "None"}
    assert points == {(4.0, 4.0), (8.0, 8.0)}, "ratios of what meets the residual"


def test_ratios_of_other_solvers_on_two_threads_are_hollow(drawn):
    (axes,) = drawn["other_solvers"].axes
    lines = coordinates(axes)
    assert sorted(line[0, 0] for line in lines if len(line) == 1) == [1.0, 1.0, 2.5, 3.5]
    ranges = sorted(tuple(line[:, 0]) for line in lines if len(line) == 2)
    close(ranges, [(0.9 * ratio, 1.1 * ratio) for ratio in (1.0, 1.0, 2.5, 3.5)])
    hollow = [line for line in axes.lines if line.get_markerfacecolor() == "none"]
    assert [line.get_xdata()[0] for line in hollow] == [2.5]
