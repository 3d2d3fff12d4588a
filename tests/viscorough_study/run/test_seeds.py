"""Streams of random numbers have different keys, and published keys do not change."""

import zlib

import numpy as np

from viscorough_study.run import seeds

KEYS = {
    seeds.disc_key(0.4, 3): (1, 400000, 3),
    seeds.variant_key(0.4, "corners"): (2, 400000, zlib.crc32(b"corners")),
    seeds.line_key(0.4): (3, 400000),
    seeds.method_problem_key(0.4, 65): (4, 400000, 65),
    seeds.solver_race_key(3, 0.4): (5, 3, 400000),
    seeds.failure_map_key(): (6,),
    seeds.grid_disc_key(0.4, 65): (8, 400000, 65),
    seeds.large_disc_key(65): (10, 65),
    seeds.gamma_factor_key(0.4): (11, 400000),
    seeds.mdr_comparison_key(0.4, 3): (12, 400000, 3),
    seeds.local_slope_key(0.4, "base"): (14, 400000, zlib.crc32(b"base")),
    seeds.periodic_key(0.4, 3): (15, 400000, 3),
    seeds.law_disc_key(0.4, 65, 3): (16, 400000, 65, 3),
    seeds.one_surface_key(0.4, 3): (18, 400000, 3),
    seeds.nested_disc_key(0.4, 4097): (19, 400000, 4097),
}


def test_published_keys_do_not_change():
    assert all(key == published for key, published in KEYS.items())
    assert [key[0] for key in KEYS] == [number for number in range(1, 20) if number not in (7, 9, 13, 17)], (
        "each has its own number"
    )
    assert {type(number) for key in KEYS for number in key} == {int}
    assert seeds.random_indenter_key(np.int64(7)) == (7,)
