"""Display encodings against the standard and a second program."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import ParameterError
from airlight.image.encoding import (
    ENCODINGS,
    encoded,
    encoding_named,
    gamma_encode,
    srgb_decode,
    srgb_encode,
)

RAMP = np.concatenate([np.linspace(0.0, 0.01, 101), np.linspace(0.0, 4.0, 401)])


@pytest.mark.filterwarnings("ignore::Warning")  # of colour-science, about its own extras
def test_srgb_is_that_of_colour_science():
    with np.printoptions():  # colour-science changes how NumPy prints, for everyone
        colour = pytest.importorskip("colour")
    assert_allclose(srgb_encode(RAMP), colour.models.eotf_inverse_sRGB(RAMP), rtol=1e-12)
    assert_allclose(srgb_decode(RAMP), colour.models.eotf_sRGB(RAMP), rtol=1e-12)


def test_srgb_pieces_meet():
    # IEC 61966-2-1: 12.92 * 0.0031308 = 0.04045; the printed numbers meet to 3e-8.
    joint = srgb_encode(np.array([0.0031308, np.nextafter(0.0031308, 1.0)]))
    assert_allclose(joint, 0.04045, rtol=0, atol=5e-7)
    assert_allclose(np.diff(joint), 0.0, atol=4e-8)


def test_gamma_is_the_power():
    assert_allclose(gamma_encode(RAMP), RAMP ** (1.0 / 2.2), rtol=1e-12)


@pytest.mark.parametrize("name", ENCODINGS)
def test_decoding_undoes_encoding(name):
    encoding = encoding_named(name)
    assert_allclose(encoding.decode(encoding.encode(RAMP)), RAMP, rtol=1e-6, atol=1e-15)
    assert_allclose(encoding.encode(encoding.decode(RAMP)), RAMP, rtol=1e-6, atol=1e-15)


@pytest.mark.parametrize("name", ENCODINGS)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_every_input_gives_a_number_of_its_own_type(name, dtype):
    encoding = encoding_named(name)
    values = np.array([-np.inf, -1.0, -0.0, 0.0, 1e-38, 1.0, 1e30, np.nan], dtype=dtype)
    for function in (encoding.encode, encoding.decode):
        with np.errstate(over="ignore"):
            out = function(values)
        assert out.dtype == dtype
        assert not np.isnan(out).any()
        assert_array_equal(out[[0, 1, 2, 3, 7]], 0.0)
        assert np.all(np.diff(out[2:7]) >= 0.0)
    assert np.isposinf(encoding.encode(np.array([np.inf], dtype=dtype)))


def test_an_unknown_encoding_is_refused():
    with pytest.raises(ParameterError, match="allowed: srgb, gamma"):
        encoding_named("rec2020")


@pytest.mark.parametrize("which", range(len(ENCODINGS)), ids=list(ENCODINGS))
def test_an_encoding_s_number_is_its_place(which):
    # The same formula by another way: to rounding.
    encode = list(ENCODINGS.values())[which].encode
    assert_allclose([encoded(which, x) for x in RAMP.tolist()], encode(RAMP), rtol=1e-14)
