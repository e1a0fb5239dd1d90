"""The ramp over the lattice: symmetry, exact alignment, and what springs repair."""

import numpy as np
import pytest

from meshlib import MeshError, problems
from meshlib.thesis.studies import section_7_3_alignment as alignment


def test_the_ramp_is_that_of_the_thesis():
    x, y = problems.nodes("33").T
    assert np.allclose(alignment.Ramp(135)(x, y), 1 - problems.SR2(x, y))


@pytest.mark.parametrize("slope", [(0, 1), (1, 1)])
def test_swapping_can_do_nothing_where_contours_follow_edges(slope):
    angle = alignment.angle_of(*slope)
    assert alignment.measures("swapped", angle) == alignment.measures("start", angle)


def test_shapes_are_better_and_errors_larger_in_line_than_beside():
    for slope in ((0, 1), (1, 2), (1, 1), (2, 1), (1, 0)):
        angle = alignment.angle_of(*slope)
        error, skewness = alignment.measures("swapped", angle)
        beside = [
            alignment.measures("swapped", angle + step) for step in (-alignment.BESIDE, alignment.BESIDE)
        ]
        assert all(skewness < s - 0.2 and error > e for e, s in beside)


def test_the_error_is_that_between_lines_of_nodes():
    for slope in ((0, 1), (1, 1)):
        error, _ = alignment.measures("swapped", alignment.angle_of(*slope))
        assert error == pytest.approx(alignment.error_between_lines(*slope), rel=0.01)


def test_springs_repair_every_angle():
    angles = range(0, 91, 15)
    swapped, repaired = (alignment.curve(name, angles)[0] for name in ("swapped", "springs, swapped"))
    assert (repaired < swapped).all() and repaired.max() < swapped.max() / 6


def test_a_shaken_lattice_is_seeded_and_keeps_its_sides():
    one, other = alignment.lattice(0.5, 1), alignment.lattice(0.5, 2)
    assert np.array_equal(one.nodes, alignment.lattice(0.5, 1).nodes) and not one.equals(other)
    steps = np.abs(one.nodes - problems.nodes("81"))
    assert 0.9 / 16 < steps.max() <= 1 / 16 and one.validate().domain_area == pytest.approx(1)
    with pytest.raises(MeshError) as error:
        alignment.lattice(0.6)
    assert str(error.value) == "range: jitter is 0.6; give a share from 0 to 0.5"


def test_springs_that_find_no_rest_have_no_error():
    """DD1's hill draws the nodes to and fro, unless its curvature counts little."""
    *known, little, more, most = alignment.elsewhere("DD1", "33-refined")
    assert np.isfinite([*known, little]).all() and np.isnan([more, most]).all()
    assert np.isfinite(alignment.elsewhere("SR1", "33")).all()
