"""Tables of samples: names, spawn keys, batches, memory."""

import pytest

from support.workflow import merged, read_settings
from viscorough_study.run import samples
from viscorough_study.run.settings import check_settings


@pytest.fixture
def settings():
    return check_settings(merged(read_settings("config"), read_settings("fine_grids")))


def test_every_ensemble_has_a_spawn_key_of_its_own(settings):
    discs, lines = samples.disc_samples(settings), samples.line_samples(settings)
    all_samples = [*discs.values(), *lines.values()]
    keys = [ensemble["spawn_key"] for sample in all_samples for ensemble in sample["ensembles"]]
    assert len(set(keys)) == len(keys) == 4 * (9 + 2 + 6) + 4 * 3 + 1 + 21
    assert samples.combined_ensembles(settings)["h01000_c3"]["spawn_key"] == (1, 100000, 3)
    assert discs["h01000_roll_off"]["ensembles"][0]["spawn_key"][:2] == (2, 100000)
    assert discs["coarse"]["ensembles"][2]["spawn_key"] == (8, 100000, 129)
    assert discs["law"]["ensembles"][0]["spawn_key"] == (8, 1000000, 257)


def test_every_sample_is_in_one_pool(settings):
    tables = {"discs": samples.disc_samples(settings), "lines": samples.line_samples(settings), "measured": {}}
    pooled = [
        (samples.POOL_KINDS[pool], sample) for pool in samples.POOLS for sample, _ in samples.pool_batches(tables, pool)
    ]
    assert set(pooled) == {(kind, sample) for kind, table in tables.items() for sample in table}
    assert samples.pool_batches(tables, "discs")[:2] == [("h01000", "0000-0039"), ("h01000", "0040-0079")]
    assert len(samples.pool_batches(tables, "discs")) == 4 * (2 + 1 + 1)
    assert samples.pool_batches(tables, "law") == [("law", "0000-0011")]


def test_curves_of_a_pool_are_in_the_folder_of_their_kind(settings):
    tables = {"discs": samples.disc_samples(settings), "lines": samples.line_samples(settings), "measured": {}}
    assert samples.pool_curves(tables, "lines")[0] == "results/curves/lines/h00000/0000-0499.nc"
    assert samples.pool_groups(tables, "coarse") == ["coarse", "coarse"]
    combinations = samples.combination_curves(tables["discs"])
    assert combinations[0] == "results/curves/discs/h01000/0000-0039.nc"
    assert len(combinations) == 4 * 2
    assert set(combinations) < set(samples.pool_curves(tables, "discs"))


def test_batches_of_several_ensembles_hold_each_realization_once(settings):
    """Batches do not end where ensembles end. The test lists [ensemble, number] of all batches, in order."""
    settings["hurst"] = [0.1, 0.9]
    settings["discs"] |= {"single_batch": 7, "coarse": {"elements": [33, 65], "realizations": 9}}
    sample = samples.disc_samples(settings)["coarse"]
    members = [
        (*ensemble["spawn_key"], number)
        for batch in samples.batches(sample)
        for ensemble in samples.batch_ensembles(sample, batch)
        for number in range(*ensemble["numbers"])
    ]
    grids = [(100000, 33), (100000, 65), (900000, 33), (900000, 65)]
    assert members == [(8, *grid, number) for grid in grids for number in range(9)]
    assert samples.batch_ensembles(sample, "0007-0013")[1]["surface"]["hurst"] == 0.1
    curves = settings["curves"]
    assert sample["indentation"]["until_x"] == curves["short_until_x"] != curves["until_x"]


def test_batch_has_the_same_realizations_of_all_combinations(settings):
    """More realizations therefore add batches and change none."""
    batch = samples.batch_ensembles(samples.disc_samples(settings)["h04000"], "0002-0005")
    assert [ensemble["spawn_key"] for ensemble in batch] == [(1, 400000, number) for number in range(1, 10)]
    assert {(*ensemble["numbers"], ensemble["elements"]) for ensemble in batch} == {(2, 6, 257)}


def test_discs_of_the_second_reading_are_cut_from_a_square_of_their_own_period(settings):
    settings["surface"]["period"] = 1.5
    sample = samples.disc_samples(settings)["h06000_longer_period"]
    (ensemble,) = sample["ensembles"]
    assert (ensemble["surface"]["period"], ensemble["surface"]["rms_over"]) == (2.0, "square")
    assert (sample["group"], ensemble["realizations"], samples.batches(sample)) == ("longer_period", 240, ["0000-0239"])
    assert sample["indentation"] == {"tolerance": 0.01, "until_x": 0.3}


def test_tenth_combination_is_a_separate_sample(settings):
    """The batches of the nine combinations stay as they are."""
    nine = samples.disc_samples(settings)
    combinations = settings["discs"]["combinations"]
    combinations.append(combinations[0] | {"number": 10})
    ten = samples.disc_samples(settings)
    assert {name: ten[name] for name in nine} == nine
    assert set(ten) - set(nine) == {f"{samples.hurst_id(hurst)}_10" for hurst in settings["hurst"]}
    assert [ensemble["name"] for ensemble in ten["h01000_10"]["ensembles"]] == ["h01000_c10"]


@pytest.mark.parametrize("name", ["config", "paper"])
def test_memory_of_every_job_is_below_two_gigabytes(settings, name):
    settings = merged(settings, read_settings(name))
    discs, lines = samples.disc_samples(settings), samples.line_samples(settings)
    needed = [samples.disc_memory(sample) for sample in discs.values()] + [
        samples.line_memory(sample) for sample in lines.values()
    ]
    needed += [samples.generation_memory(sample["ensembles"]) for sample in discs.values()]
    tables = {"discs": discs, "lines": lines, "measured": {}}
    needed += [samples.pool_memory(tables, pool, settings["curves"]) for pool in samples.POOLS]
    assert min(needed) >= samples.BASE_MEMORY
    assert max(needed) < 2000


def test_nested_discs_have_all_coarser_grids_and_a_key_of_their_exponent_and_grid(settings):
    nested = samples.nested_samples(settings)
    assert nested["h04000_00257"]["elements"] == [257]
    assert nested["h04000_01025"]["elements"] == [1025, 513, 257]
    assert nested["h04000_01025"]["spawn_key"] == (19, 400000, 1025)
    assert len({sample["spawn_key"] for sample in nested.values()}) == len(nested) == 5 * 5


def test_lines_have_the_exponents_of_discs_and_the_multiples_of_a_step(settings):
    settings = merged(settings, {"hurst": [0.33, 0.6], "lines": {"hurst_step": 0.3}})
    grouped = {
        name: [line["name"] for line in sample["ensembles"]] for name, sample in samples.line_samples(settings).items()
    }
    alone = {name: [name] for name in ("h00000", "h06000", "h09000")}
    assert grouped == alone | {"h03000": ["h03000", "h03300"]}
    settings["lines"]["hurst_step"] = None
    assert list(samples.line_samples(settings)) == ["h03000", "h06000"]


def test_jobs_of_nested_discs_cover_all_numbers_once(settings):
    nested = samples.nested_samples(settings)
    sample = nested["h04000_04097"]
    numbers = [samples.nested_arguments(sample, batch)["numbers"] for batch in samples.batches(sample)]
    assert [n for first, end in numbers for n in range(first, end)] == list(range(sample["realizations"]))
    assert "results/curves/nested/h04000_04097/0000-0019.nc" in samples.nested_files(nested)
