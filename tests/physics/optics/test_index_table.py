import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import AirlightError, FileError, ParameterError
from airlight.physics.optics.effective_medium import maxwell_garnett
from airlight.physics.optics.index_table import index_names, read_index


@pytest.mark.parametrize("name", index_names())
def test_every_table_is_cited_and_covers_the_visible(name):
    # The house rule for data: source in the header; 360 to 830 nm are drawn.
    table = read_index(name)
    assert "(19" in table.source or "(20" in table.source
    assert table.limits[0] <= 360
    assert table.limits[1] >= 830
    assert (table.real > 0.5).all()
    assert (table.imaginary >= 0).all()


@pytest.mark.parametrize(
    ("name", "nm", "expected"),
    [
        ("water", 500, 1.335 + 1.00e-9j),  # Hale & Querry (1973), Table I
        ("soot", 550, 1.75 + 0.44j),  # Hess et al. (1998)
        ("sulphuric-acid", 550, 1.43 + 1e-8j),  # Hess et al. (1998)
    ],
)
def test_tables_hold_the_published_values(name, nm, expected):
    # Typed from the publications; six digits are kept.
    assert_allclose(read_index(name).at(nm), expected, rtol=1e-6)


def test_imaginary_part_is_interpolated_in_the_logarithm(tmp_path):
    # A power law's geometric mean of 1e-8 and 1e-4 is 1e-6; half-way between 1.4 and 1.6 is 1.5.
    # Next to a row with 0 it is linear, and a power law elsewhere.
    file = tmp_path / "mine.csv"
    file.write_text(
        "# source: me\nwavelength_nm,real,imaginary\n400,1.4,1e-8\n900,1.6,1e-4\n1000,1.6,0\n"
    )
    index = read_index(str(file)).at([600.0, 650.0, 950.0])
    assert_allclose(index.imag[[0, 2]], [1e-6, 5e-5], rtol=1e-12)
    assert_allclose(index.real[1], 1.5, rtol=1e-12)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("400,1.4,0\n", "has no header"),
        ("wavelength_nm,real,imaginary\n400,1.4\n", "line 2 is '2 cells'; allowed: 3"),
        ("wavelength_nm,real,imaginary\n400,1.4,x\n", "line 2, imaginary is 'x'"),
        ("wavelength_nm,real,imaginary\n500,1.4,0\n400,1.4,0\n", "wavelengths must ascend"),
        ("wavelength_nm,real,imaginary\n500,1.4,-0.1\n", "line 2, imaginary is '-0.1'; allowed: 0"),
        ("wavelength_nm,real,imaginary\n", "wavelengths must ascend"),
    ],
)
def test_a_file_of_another_form_is_refused(tmp_path, text, message):
    # One clear line each.
    file = tmp_path / "bad.csv"
    file.write_text(text)
    with pytest.raises(AirlightError, match=message):
        read_index(str(file))


def test_a_table_that_does_not_exist_is_refused(tmp_path):
    # A name gets the list of names, a path the system's reason.
    with pytest.raises(ParameterError, match=r"^index is 'watre'; allowed: .*water"):
        read_index("watre")
    with pytest.raises(FileError, match="No such file"):
        read_index(str(tmp_path / "none.csv"))


def test_mixture_tends_to_what_it_is_mixed_of():
    # Exact limits at 0 and 1, and for two equal substances.
    m, i = 1.5 + 0.001j, 3.0 + 0.5j
    assert_allclose(maxwell_garnett(m, i, 0.0), m, rtol=1e-14)
    assert_allclose(maxwell_garnett(m, i, 1.0), i, rtol=1e-13)
    assert_allclose(maxwell_garnett(m, m, 0.3), m, rtol=1e-14)


def test_mixture_of_little_follows_its_first_order():
    # Bohren & Huffman, expansion of eq. 8.50: ε = ε_m (1 + 3 f β).
    m, i, f = 1.5 + 0j, 3.0 + 0.5j, 1e-6
    beta = (i**2 - m**2) / (i**2 + 2 * m**2)
    change = np.asarray(maxwell_garnett(m, i, f)) ** 2 - m**2
    assert_allclose(change, 3 * f * beta * m**2, rtol=1e-5)


def test_a_fraction_above_one_is_refused():
    # A share of a whole.
    with pytest.raises(ParameterError, match=r"^fraction is 1\.1; allowed: 0 to 1"):
        maxwell_garnett(1.5, 2.0, 1.1)
