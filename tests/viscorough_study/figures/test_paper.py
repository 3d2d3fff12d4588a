"""Figures: what they draw is what they are given, in the units on their axes; files are whole and reproducible."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from support.study import SHOWN
from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.mdr import reduce
from viscorough.surfaces import self_affine_disc, self_affine_line
from viscorough.viscous.correspondence import kinetics
from viscorough_study.ensembles import abscissa, aggregate, combine
from viscorough_study.figures.conventions import plot_conventions
from viscorough_study.figures.exponent import plot_exponent
from viscorough_study.figures.kinetics import plot_kinetics
from viscorough_study.figures.master_curve import plot_master_curve
from viscorough_study.figures.style import hurst_looks, save_figure
from viscorough_study.figures.surfaces import plot_surfaces
from viscorough_study.figures.validation import plot_validation
from viscorough_study.power_law import COLUMNS, scaling_rows
from viscorough_study.tables import fits

pytestmark = pytest.mark.filterwarnings("error")

HURST = (0.4, 0.9)
COMBINATIONS = {
    "c1": {"force": 1.0, "viscosity": 1e6, "diameter": 1e-2, "rms": 1e-6},
    "c9": {"force": 300.0, "viscosity": 3e7, "diameter": 3e-2, "rms": 3e-7},
}
X = abscissa(1e-4, 30, 20)
ELEMENTS = 33
SCALING = {"elements_min": 3, "stiffness_max": 0.2, "slope_max": 0.8, "stiffness_range": (0.03, 0.3)}


def case_of(hurst, name):
    return f"h{round(hurst * 1e4):05d}_{name}"


@pytest.fixture(scope="module")
def curves():
    """{(H, combination): two loading curves}; the surfaces of a Hurst exponent are the same but for their units."""
    result = {}
    for hurst in HURST:
        for name, at in COMBINATIONS.items():
            lengths = {"rms": at["rms"], "diameter": at["diameter"]}
            discs = [self_affine_disc(hurst, ELEMENTS, **lengths, seed=seed) for seed in (1, 2)]
            limit = 4 * at["rms"] * at["diameter"] * 31
            result[hurst, name] = [indent(disc, until_force=limit) for disc in discs]
    return result


@pytest.fixture(scope="module")
def discs(curves):
    """Ensemble of every case, all of two realizations."""
    return [
        aggregate(
            pair,
            {"disc": COMBINATIONS[name]["rms"], "square": 1.1 * COMBINATIONS[name]["rms"]},
            COMBINATIONS[name]["diameter"],
            X,
            hurst=hurst,
            case=case_of(hurst, name),
        )
        for (hurst, name), pair in curves.items()
    ]


@pytest.fixture(scope="module")
def pooled(discs):
    return [combine([ds for ds in discs if ds["hurst"] == hurst]) for hurst in HURST]


@pytest.fixture(scope="module")
def lines():
    result = []
    for hurst in HURST:
        reduced = [reduce(self_affine_line(hurst, 1024, seed=seed)) for seed in (1, 2)]
        result.append(aggregate(reduced, {"line": 1.0}, 1.0, X, hurst=hurst, case="lines"))
    return result


@pytest.fixture(scope="module")
def table(pooled, lines):
    rows = []
    for ensemble, line in zip(pooled, lines, strict=True):
        how = {"resamples": 20, "seed": 1, **SCALING}
        rows += scaling_rows(ensemble, source="discs", case_group="base", lines=line, **how)
        rows += scaling_rows(ensemble, source="discs", case_group="roll_off", **how)
        rows += scaling_rows(line, source="lines", case_group="base", **how)
    return pd.DataFrame(rows, columns=list(COLUMNS))


@pytest.fixture
def combinations():
    return {case_of(hurst, name): at for hurst in HURST for name, at in COMBINATIONS.items()}


def without_region(table, hurst):
    """The table with no region (b) for one Hurst exponent, as the workflow writes it."""
    numbers = [name for name, (_, units) in COLUMNS.items() if units and name not in ("hurst", "realizations")]
    return table.mask((table["hurst"] == hurst).to_numpy()[:, None] & np.isin(table.columns, numbers))


def whole_on_page(figure):
    """Whether nothing that is drawn reaches beyond the page, once laid out."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    box, (width, height) = figure.get_tightbbox(canvas.get_renderer()), figure.get_size_inches()
    return box.x0 > -0.01 and box.y0 > -0.01 and box.x1 < width + 0.01 and box.y1 < height + 0.01


def dashed(axes):
    return [line for line in axes.lines if line.get_linestyle() == "--"]


def marked(axes):
    """Markers without a line."""
    return [line for line in axes.lines if line.get_marker() in "os^D" and line.get_linestyle() == "None"]


def legend_texts(legend):
    return [text.get_text() for text in legend.get_texts()]


# ---- style and files


def test_looks_of_a_hurst_exponent_do_not_depend_on_how_exponents_are_listed():
    looks = hurst_looks([0.9, 0.1, 0.6, 0.4, 0.9])
    assert list(looks) == [0.1, 0.4, 0.6, 0.9]
    assert looks == hurst_looks([0.1, 0.4, 0.6, 0.9])
    assert hurst_looks([0.6])[0.6]["color"] == looks[0.6]["color"]
    for name in ("color", "marker", "linestyle"):
        assert len({str(look[name]) for look in looks.values()}) == 4
    grey = [np.dot(to_rgb(look["color"]), (0.3, 0.6, 0.1)) for look in looks.values()]
    assert (np.diff(grey) > 0.07).all()  # told apart when printed in grey
    assert grey[-1] < 0.7  # and from the paper


def test_fits_are_the_rows_under_the_conventions_shown(table):
    rows = fits(table.iloc[::-1], SHOWN, source="discs", case_group="base")
    assert rows["hurst"].tolist() == [0.4, 0.9]
    assert (rows[list(SHOWN)] == list(SHOWN.values())).all(axis=None)
    assert fits(table, SHOWN, window_rule="kappa", source="discs", case_group="base")["window_rule"].eq("kappa").all()
    assert fits(without_region(table, 0.4), SHOWN, source="discs", case_group="base")["hurst"].tolist() == [0.9]


@pytest.mark.parametrize("suffix", ["png", "pdf"])
def test_saved_files_are_reproducible(table, tmp_path, suffix):
    paths = [tmp_path / f"{name}.{suffix}" for name in "ab"]
    for path in paths:
        save_figure(plot_exponent(table, SHOWN), path)
    first, second = (path.read_bytes() for path in paths)
    assert first == second
    assert first.startswith({"png": b"\x89PNG", "pdf": b"%PDF"}[suffix])
    assert sorted(tmp_path.iterdir()) == paths
    if suffix == "pdf":
        assert b"CreationDate" not in first
        assert b"/FontFile2" in first  # TrueType fonts are in the file
    else:
        width = int.from_bytes(first[16:20], "big")
        assert width == pytest.approx(120 / 25.4 * 200, abs=1)


def test_one_figure_goes_to_all_paths(tmp_path):
    save_figure(Figure(), tmp_path / "a.png", tmp_path / "a.pdf")
    assert {path.name for path in tmp_path.iterdir()} == {"a.png", "a.pdf"}


def test_a_file_that_cannot_be_drawn_leaves_the_old_one(tmp_path):
    path = tmp_path / "a.png"
    path.write_bytes(b"old")
    figure = Figure()
    figure.text(0.5, 0.5, r"$\no_such_symbol$")
    with pytest.raises(ValueError, match="no_such_symbol"):
        save_figure(figure, path)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(("name", "message"), [("no/a.png", "no folder"), ("a.what", "what")])
def test_save_refuses(tmp_path, name, message):
    with pytest.raises(ValueError, match=message):
        save_figure(Figure(), tmp_path / name)
    assert list(tmp_path.iterdir()) == []


# ---- the paper's figures


@pytest.mark.parametrize("number", [1, 2, 5])
def test_surfaces_are_shown_darker_where_higher(number):
    exponents = np.linspace(0.1, 0.9, number)
    examples = [(h, self_affine_disc(h, ELEMENTS, seed=1).heights, 1 / ELEMENTS) for h in exponents]
    figure = plot_surfaces(examples)
    shown = [axes for axes in figure.axes if axes.images]
    assert len(shown) == number
    assert len(figure.axes) == 2 * number  # each with its own scale
    for axes, (hurst, heights, _) in zip(shown, examples, strict=True):
        (image,) = axes.images
        np.testing.assert_array_equal(image.get_array().filled(np.nan), heights)
        assert image.get_extent() == pytest.approx([-0.5, 0.5, -0.5, 0.5])
        assert image.get_clim() == (np.nanmin(heights), np.nanmax(heights))
        assert sum(image.to_rgba(np.nanmax(heights))[:3]) < 0.1 < 2.9 < sum(image.to_rgba(np.nanmin(heights))[:3])
        assert axes.get_title() == f"$H={hurst:g}$"
    assert whole_on_page(figure)


def test_kinetics_are_those_of_the_curves_in_real_units(curves, discs, combinations, table):
    """Against viscorough.viscous.correspondence, which does not know of X: geometric mean of v at the times drawn."""
    raw, collapsed = plot_kinetics(discs, combinations, table, SHOWN).axes
    for axes in (raw, collapsed):
        drawn = {line.get_label() for line in axes.lines} & set(combinations)
        assert drawn == set(combinations)
    scaled = {line.get_label(): line.get_xydata() for line in collapsed.lines}
    for line in raw.lines:
        if line.get_label() not in combinations:
            continue
        hurst, name = next(key for key in curves if case_of(*key) == line.get_label())
        at = combinations[line.get_label()]
        time, velocity = line.get_data()
        each = [kinetics(curve, at["force"], at["viscosity"], time).velocity for curve in curves[hurst, name]]
        np.testing.assert_allclose(velocity, np.sqrt(each[0] * each[1]), rtol=1e-9)
        abscissa_, ordinate = scaled[line.get_label()].T
        unit = at["rms"] * at["viscosity"] * at["diameter"]
        np.testing.assert_allclose(abscissa_, at["force"] * time / unit, rtol=1e-12)
        np.testing.assert_allclose(ordinate, velocity * time / at["rms"], rtol=1e-12)


def test_kinetics_collapse_from_decades_apart(discs, combinations, table):
    raw, collapsed = plot_kinetics(discs, combinations, table, SHOWN).axes
    for hurst in HURST:
        pairs = []
        for axes in (raw, collapsed):
            of_label = {line.get_label(): line.get_xydata() for line in axes.lines}
            pairs.append([of_label[case_of(hurst, name)] for name in COMBINATIONS])
        (raw_one, raw_other), (one, other) = pairs
        assert abs(np.log10(raw_one[0] / raw_other[0])).max() > 0.9
        both = min(len(one), len(other))  # rounding may take the last abscissa off one of them
        assert both > 50
        np.testing.assert_allclose(one[:both], other[:both], rtol=0.02)  # rounding can move levels of a curve


@pytest.mark.parametrize(("convention", "length"), [("diameter", 1.0), ("radius", 0.5)])
def test_kinetics_mark_the_regions(discs, combinations, table, convention, length):
    shown = SHOWN | {"diameter_convention": convention}
    figure = plot_kinetics(discs, combinations, table, shown)
    axes = figure.axes[1]
    bars = [line.get_xdata() for line in axes.lines if line.get_transform() == axes.get_xaxis_transform()]
    fitted = fits(table, shown, source="discs", case_group="base")
    np.testing.assert_allclose(sorted(map(tuple, bars)), sorted(zip(4 * fitted.x_low, 4 * fitted.x_high, strict=True)))
    first, last = (line.get_xydata() for line in axes.lines if line.get_linestyle() == ":")
    kappa = reference.one_element_stiffness(ELEMENTS)
    np.testing.assert_allclose(first[:, 1], first[:, 0] * length / 4 / kappa)
    np.testing.assert_allclose(last[:, 1], last[:, 0] * length / 4)
    one = [line.get_xydata() for line in axes.lines if line.get_color() == "0.8"]
    assert len(one) == len(discs)
    for begin in (data[0] for data in one):  # region (a) lies on the limit (a), region (c) comes close to (c)
        assert begin[1] == pytest.approx(begin[0] * length / 4 / kappa, rel=1e-6)
    end = next(line.get_xydata()[-1] for line in axes.lines if line.get_label() in combinations)
    assert end[1] == pytest.approx(end[0] * length / 4, rel=0.1)
    assert whole_on_page(figure)


def test_kinetics_of_one_case_without_region(discs, combinations, table):
    figure = plot_kinetics(discs[:1], combinations, without_region(table, 0.4), SHOWN)
    assert whole_on_page(figure)
    assert not any(line.get_linewidth() == 2.5 for line in figure.axes[1].lines[:-1])


@pytest.mark.parametrize("average", ["geometric", "arithmetic"])
def test_master_curve_draws_both_sides_of_the_law(pooled, lines, table, average):
    shown = SHOWN | {"average": average}
    figure = plot_master_curve(pooled, lines, table, shown)
    law, ratio = figure.axes
    (identity,) = dashed(law)
    np.testing.assert_array_equal(identity.get_xdata(), identity.get_ydata())
    np.testing.assert_array_equal(dashed(ratio)[0].get_ydata(), 1)
    windows = fits(table, shown, source="discs", case_group="base").set_index("hurst")
    for ensemble, (inside, outside) in zip(
        pooled, zip(law.containers[::2], law.containers[1::2], strict=True), strict=True
    ):
        hurst = ensemble["hurst"].item()
        right = reference.rate_law(X, hurst, gamma=True)
        left = ensemble[f"velocity_{average}"].sel(rms_convention="disc").values
        window = (windows.x_low[hurst] * 0.999 < X) & (windows.x_high[hurst] * 1.001 > X)
        for (marks, _, bars), drawn_inside in ((inside, True), (outside, False)):
            x, y = marks.get_data()
            at = np.searchsorted(right, x * (1 - 1e-9))
            np.testing.assert_allclose(x, right[at], rtol=1e-12)
            np.testing.assert_allclose(y, left[at], rtol=1e-12)
            assert (window[at] == drawn_inside).all()
            assert x.size >= 3
            assert (to_rgb(marks.get_markerfacecolor()) == (1, 1, 1)) != drawn_inside
            spread = ensemble["velocity_spread"].sel(rms_convention="disc").values[at]
            error = 2 * spread / np.sqrt(ensemble["realizations_defined"].sel(rms_convention="disc").values[at])
            ends = np.array([segment[:, 1] for segment in bars[0].get_segments()])
            np.testing.assert_allclose(np.log(ends / y[:, None]), np.transpose([-error, error]), atol=1e-9)
    for ensemble, line in zip(lines, [each for each in law.lines if each.get_zorder() == 3], strict=True):
        kept = (ensemble["contact_count_median"].values[0] > 1) & (ensemble["fraction_defined"].values[0] == 1)
        np.testing.assert_allclose(line.get_ydata(), ensemble[f"velocity_{average}"].values[0][kept], rtol=1e-12)
    assert whole_on_page(figure)


def test_master_curve_of_one_realization_without_region(discs, lines, table):
    single = [ds.isel(realization=[0]) for ds in discs[::2]]
    for ds in single:  # as the ensemble of one realization has it
        ds["velocity_spread"] = ds["velocity_spread"] * np.nan
        ds["realizations_defined"] = ds["realizations_defined"] * 0 + 1
    figure = plot_master_curve(single, lines[:1], without_region(table, 0.4), SHOWN)
    inside, outside = figure.axes[0].containers[:2]
    assert inside[0].get_xdata().size == 0
    assert outside[0].get_xdata().size > 3
    assert whole_on_page(figure)


def test_exponent_draws_lines_discs_and_law(table):
    figure = plot_exponent(table, SHOWN)
    (axes,) = figure.axes
    solid = next(line for line in axes.lines if line.get_color() == "black")
    rows = fits(table, SHOWN, source="lines", case_group="base", rms_convention="line")
    np.testing.assert_array_equal(solid.get_xydata(), rows[["hurst", "beta"]])
    band = axes.collections[0].get_paths()[0].vertices
    assert {*rows["beta_low"], *rows["beta_high"]} <= set(band[:, 1])
    marks = [line.get_xydata()[0] for line in marked(axes)]
    discs = fits(table, SHOWN, source="discs", case_group="base")
    np.testing.assert_array_equal(marks, discs[["hurst", "beta"]])
    ends = [container.lines[2][0].get_segments()[0][:, 1] for container in axes.containers]
    np.testing.assert_allclose(ends, discs[["beta_low", "beta_high"]], rtol=1e-12)
    (law,) = dashed(axes)
    np.testing.assert_allclose(law.get_ydata(), law.get_xdata() / (1 + law.get_xdata()))
    assert whole_on_page(figure)


def test_exponent_leaves_out_what_has_no_region(table):
    partial = plot_exponent(without_region(table, 0.4), SHOWN).axes[0]
    whole = plot_exponent(table, SHOWN).axes[0]
    (kept,) = marked(partial)
    assert kept.get_xdata().tolist() == [0.9]
    assert kept.get_marker() == marked(whole)[1].get_marker()  # as in the other figures
    assert not marked(plot_exponent(table[table["source"] == "lines"], SHOWN).axes[0])


def test_an_interval_need_not_hold_its_value(table):
    """A bootstrap interval may not, and is drawn where it is."""
    table = table.assign(beta_low=table["beta"] + 0.1, beta_high=table["beta"] + 0.3)
    axes = plot_exponent(table, SHOWN).axes[0]
    ends = axes.containers[0].lines[2][0].get_segments()[0][:, 1]
    np.testing.assert_allclose(ends - marked(axes)[0].get_ydata(), [0.1, 0.3])
    assert marked(plot_conventions(table, SHOWN).axes[0])


# ---- beyond the paper


def test_conventions_has_a_row_for_each_change(table):
    figure = plot_conventions(table, SHOWN)
    grid = np.reshape(figure.axes, (2, len(HURST)))
    labels = [text.get_text() for text in grid[0, 0].get_yticklabels()]
    assert labels[0] == "as in other figures"
    assert labels[1:5] == ["arithmetic mean", "$h$ of the square", "lower half of window", "upper half of window"]
    assert labels[5:] == ["window of given κ", "law with Γ (Eq. 9)", "$L$ the radius", "roll-off (control)"]
    changes = [{}, {"average": "arithmetic"}, {"rms_convention": "square"}]
    changes += [{"window_rule": rule} for rule in ("lower_half", "upper_half", "kappa")]
    changes += [{"gamma": "with"}, {"diameter_convention": "radius"}, {"case_group": "roll_off"}]
    for axes, quantity in zip(grid, ("beta", "zeta"), strict=True):
        for panel, hurst in zip(axes, HURST, strict=True):
            rows = {int(line.get_ydata()[0]): line.get_xdata()[0] for line in marked(panel)}
            for y, change in enumerate(changes):
                wanted = SHOWN | {"source": "discs", "case_group": "base", "hurst": hurst} | change
                (row,) = (table[list(wanted)] == list(wanted.values())).all(axis=1).to_numpy().nonzero()[0]
                value = table[quantity][row]
                assert rows.get(y) == value if np.isfinite(value) else y not in rows
    laws = {
        line.get_xdata()[0] for line in grid[1, 1].lines if len(set(line.get_xdata())) == 1 and line.get_zorder() == 1
    }
    assert laws == {reference.zeta_viscous(0.9), reference.zeta_elastic(0.9)}
    lengths = [np.diff(panel.get_xlim())[0] for panel in grid[0]]
    assert lengths[0] == pytest.approx(lengths[1])
    ratios = [np.divide(*panel.get_xlim()) for panel in grid[1]]
    assert ratios[0] == pytest.approx(ratios[1])
    assert whole_on_page(figure)


def test_conventions_say_where_there_is_no_region(table):
    figure = plot_conventions(without_region(table, 0.4), SHOWN)
    empty, other = figure.axes[:2]
    assert [text.get_text() for text in empty.texts] == ["no region (b)"] * 9
    assert not marked(empty)
    assert len(marked(other)) + len(other.texts) == 9
    assert whole_on_page(figure)


def test_conventions_go_on_in_further_rows(table):
    five = pd.concat([table.assign(hurst=table["hurst"] + shift) for shift in (0, 0.02, 0.04)])
    five = five[five["hurst"] < 0.93]
    figure = plot_conventions(five, SHOWN)
    titles = [axes.get_title() for axes in figure.axes]
    assert [title for title in titles if title] == [f"$H={h}$" for h in (0.4, 0.42, 0.44, 0.9, 0.92)]
    assert len(figure.axes) == 10
    with pytest.raises(ValueError, match="no discs"):
        plot_conventions(table[table["source"] == "lines"], SHOWN)


def validation(grids, quantities=("force", "depth")):
    rows = [
        (case, quantity, n, scale / n**2, 2.04 if len(grids) > 2 else np.nan, 2, 1e-3, int(case != "cone"))
        for quantity in quantities
        for case, scale in (("sphere", 0.5), ("sphere_reduction", 0.7), ("cone", 0.2))
        for n in grids
    ]
    columns = ["case", "quantity", "elements", "error", "order", "expected_order", "limit", "passed"]
    return pd.DataFrame(rows, columns=columns)


def test_validation_draws_errors_orders_and_limits():
    figure = plot_validation(validation([33, 65, 129]))
    titles = [axes.get_title() for axes in figure.axes]
    assert titles == [name + "\nexpected " + r"$\propto n^{-2}$" for name in ("force", "depth")]
    for axes in figure.axes:
        *cases, limit = axes.lines
        for line, scale in zip(cases, (0.5, 0.7, 0.2), strict=True):
            np.testing.assert_allclose(line.get_xydata(), [(n, scale / n**2) for n in (33, 65, 129)])
        assert len({(line.get_color(), line.get_marker()) for line in cases}) == 3
        assert cases[0].get_color() == cases[1].get_color() != cases[2].get_color()
        assert (limit.get_ydata() == 1e-3).all()
        assert limit.get_xdata()[0] < 129 < limit.get_xdata()[1]
        assert legend_texts(axes.get_legend()) == ["2.0", "2.0", "2.0, failed"]
        assert axes.get_ylim() == pytest.approx((1e-6, 1e-1))  # whole decades around all that is drawn
    assert legend_texts(figure.legends[0]) == ["sphere", "sphere reduction", "cone", "limit on the finest grid"]
    assert whole_on_page(figure)


@pytest.mark.parametrize("grids", [[33], [17, 33]])
def test_validation_without_orders(grids):
    figure = plot_validation(validation(grids, ("force", "stiffness", "area", "punch_stiffness")))
    assert len(figure.axes) == 4
    assert all(legend_texts(axes.get_legend()) == ["failed"] for axes in figure.axes)
    assert whole_on_page(figure)
