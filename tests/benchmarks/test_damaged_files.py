"""No damaged file loads with different content, and the campaign notices a reader that loads one."""

import os
import time
from collections import Counter

import damaged_files as campaign
import pytest

from viscorough.io import netcdf

KINDS = ("curve", "batch", "pool", "surfaces", "table", "NetCDF of the table")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("files")


@pytest.fixture(scope="module")
def kinds(folder):
    return campaign.write_files(folder)


@pytest.mark.parametrize("kind", KINDS)
def test_no_damaged_file_loads_with_different_content(folder, kinds, kind, monkeypatch):
    monkeypatch.setattr(campaign, "TIME_LIMIT", 5)
    read, names = kinds[kind]
    words = Counter(word for _, word, *_ in campaign.outcomes(read, [folder / name for name in names], 7, range(40)))
    assert words[campaign.REFUSED] >= 30
    assert set(words) <= {campaign.REFUSED, campaign.SAME, campaign.CRASHED, campaign.UNENDING}


def test_campaign_distinguishes_different_content_errors_crashes_and_hangs(folder, kinds, monkeypatch):
    """The readers here behave as the real ones could on a damaged file."""
    read, (name,) = kinds["curve"]
    whole = (folder / name).read_bytes()
    monkeypatch.setattr(campaign, "TIME_LIMIT", 1)

    def outcome(reader, content=whole):
        with campaign.ReadingProcess(read) as process:
            _, expected = process.answer(folder)
        with campaign.ReadingProcess(reader) as process:
            first, again = (campaign.outcome(process, [folder / name], content, expected)[0] for _ in range(2))
        assert first == again
        return first

    def unnamed(folder):
        raise ValueError("depth is negative")

    def another_error(folder):
        raise KeyError(folder / name)

    assert outcome(read) == campaign.SAME
    assert outcome(lambda folder: read(folder).force) == campaign.ANOTHER
    assert outcome(unnamed) == outcome(another_error) == campaign.WRONG
    assert outcome(lambda folder: os._exit(3)) == campaign.CRASHED
    assert outcome(lambda folder: time.sleep(60)) == campaign.UNENDING
    place = whole.index(read(folder).residual.tobytes())
    changed = whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :]
    assert outcome(read, changed) == campaign.REFUSED
    monkeypatch.setattr(netcdf, "check_digest", lambda file: None)
    assert outcome(read, changed) == campaign.ANOTHER
