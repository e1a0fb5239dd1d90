"""Pictures: what they show can be counted, and wrong numbers are named."""

import dataclasses

import matplotlib
import numpy as np
import pytest

from meshlib import Interpolant, InvalidInputError, Mesh, plotting, problems

matplotlib.use("Agg")
SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]


@pytest.fixture
def mesh():
    """A unit square of two elements: five edges, four of them on the boundary."""
    return Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]])


@pytest.fixture
def ax():
    """Axes of a figure that is closed at the end."""
    figure, (one,) = plotting.panels()
    yield one
    plotting.look.pyplot().close(figure)


def test_the_names_of_colours_and_sizes_are_those_of_the_look():
    look = plotting.LOOK
    assert (look.colours.ink, look.colours.faint) == (plotting.INK, plotting.FAINT)
    assert (look.page.width, look.surface.view, look.surface.levels) == (9.0, (32, -60), 10)
    with pytest.raises(dataclasses.FrozenInstanceError):
        look.lines.edge = 2.0


def test_matplotlib_knows_all_settings_and_has_its_old_ones_afterwards():
    before = dict(matplotlib.rcParams)
    with plotting.style():
        assert all(matplotlib.rcParams[name] is not None for name in plotting.LOOK.settings())
        assert matplotlib.rcParams["axes.edgecolor"] == plotting.INK
    assert dict(matplotlib.rcParams) == before


def test_numbers_masks_and_true_choose_alike(ax, mesh):
    diagonal = np.flatnonzero((mesh.edges == [0, 2]).all(axis=1))
    for edges, count in (
        (diagonal, 1),
        (mesh.boundary, 4),
        (np.arange(5) == diagonal, 1),
        (True, 5),
        ([], 0),
    ):
        assert len(plotting.highlight_edges(ax, mesh, edges).get_segments()) == count
    assert len(plotting.mark_nodes(ax, mesh, False).get_xdata()) == 0
    assert len(plotting.shade_elements(ax, mesh, True).get_paths()) == 2


@pytest.mark.parametrize(
    "draw, message, items",
    [
        (plotting.highlight_edges, "range: there is no edge 7; give whole numbers from 0 to 4", (7, -1)),
        (plotting.shade_elements, "range: there is no element 7; give whole numbers from 0 to 1", (7, -1)),
        (plotting.mark_nodes, "range: there is no node 7; give whole numbers from 0 to 3", (7, -1)),
        (plotting.number_nodes, "range: there is no node 7; give whole numbers from 0 to 3", (7, -1)),
    ],
)
def test_all_numbers_that_a_mesh_lacks_are_named(ax, mesh, draw, message, items):
    with pytest.raises(InvalidInputError) as error:
        draw(ax, mesh, [0, 7, 1, -1])
    assert str(error.value) == f"{message} (2 in all, see .items)" and error.value.items == items


def test_a_mask_has_one_value_for_each_element(ax, mesh):
    with pytest.raises(InvalidInputError) as error:
        plotting.plot_mesh(ax, mesh, elements=[True, False, True])
    assert str(error.value) == "shape: the mask has shape (3,); give (2,), one for each element"


def test_numbers_stand_in_the_widest_angle(ax, mesh):
    """At node 1 = (1, 0) edges lead west and north: the middle of the 270 degrees outside is south-east."""
    (text,) = plotting.number_nodes(ax, mesh, [1], distance=2.0)
    assert text.get_position() == pytest.approx((np.sqrt(2), -np.sqrt(2)))


def test_options_have_names(ax, mesh):
    with pytest.raises(TypeError, match="takes 2 positional arguments but 3 were given"):
        plotting.plot_mesh(ax, mesh, [0])


def test_a_linear_function_has_straight_lines_at_half_steps(ax, mesh):
    lines = plotting.plot_contours(ax, Interpolant(mesh, [0, 1, 1, 0]), levels=4)
    assert lines.levels.tolist() == [0.125, 0.375, 0.625, 0.875]
    for level, path in zip(lines.levels, lines.get_paths(), strict=True):
        assert path.vertices[:, 0] == pytest.approx(level)
    assert plotting.plot_contours(ax, Interpolant(mesh, [0, 1, 1, 0]), levels=[2.0]) is None


@pytest.mark.parametrize("slope, azimuth", [(-1, 60), (1, -60)])
def test_a_surface_rises_away_from_the_eye(mesh, slope, azimuth):
    """From azimuth -60 the eye stands at negative y, from where u = y rises and u = -y falls away."""
    axes = plotting.look.pyplot().figure().add_subplot(projection="3d")
    plotting.plot_surface(axes, Interpolant(mesh, [0, 0, slope, slope]))
    assert axes.azim == azimuth
    plotting.look.pyplot().close(axes.figure)


def test_two_interpolants_share_their_limits():
    one, two = (Interpolant(problems.mesh("33"), problems.functions[name]) for name in ("SR1", "SR2"))
    figure = plotting.representation(two, before=one, labels=("first", "second"))
    assert [ax.get_ylabel() for ax in figure.axes[::3]] == ["first", "second"]
    assert figure.axes[1].get_zlim() == figure.axes[4].get_zlim() == plotting.value_limits(one, two)
    plotting.look.pyplot().close(figure)
