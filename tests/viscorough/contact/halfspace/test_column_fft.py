"""Convolution of columns against numpy's transforms."""

import numpy as np
import pytest

from viscorough.contact.halfspace.column_fft import ColumnConvolution, LibraryConvolution


@pytest.mark.parametrize("kind", [ColumnConvolution, LibraryConvolution])
@pytest.mark.parametrize("precision", [np.float32, np.float64])
@pytest.mark.parametrize("columns", [1, 72, 137])  # one block, one with extra columns, more than one
@pytest.mark.parametrize("length", [4, 8, 12, 32, 36, 64, 108, 384])
def test_convolution_agrees_with_transforms_of_numpy(length, columns, precision, kind):
    rng = np.random.default_rng(length)
    rows = length // 2 + 1
    spectrum = rng.standard_normal((rows, columns))  # of even kernels: frequency and −frequency alike
    all_frequencies = np.concatenate([spectrum, spectrum[-2:0:-1]])
    convolution = kind(rows, spectrum, precision)
    for _ in range(2):  # no data of the first application may remain in the second
        data = rng.standard_normal((rows, columns)) + 1j * rng.standard_normal((rows, columns))
        padded = np.fft.fft(data, n=length, axis=0)
        expected = np.fft.ifft(all_frequencies * length * padded, axis=0)[:rows]
        convolved = data.astype(np.result_type(precision, np.complex64))
        convolution.apply(convolved)
        np.testing.assert_allclose(convolved, expected, rtol=0, atol=5 * np.finfo(precision).eps * abs(expected).max())
