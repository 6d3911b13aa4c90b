import math

import pytest
from geometry_msgs.msg import Point, Pose, Quaternion

from singulate_ros.failure import Failure
from singulate_ros.footprint import Footprint, Placement, box, cylinder, sphere


def turned(axis: str, angle: float) -> Quaternion:
    parts = {"x": 0.0, "y": 0.0, "z": 0.0, axis: math.sin(angle / 2)}
    return Quaternion(x=parts["x"], y=parts["y"], z=parts["z"], w=math.cos(angle / 2))


def placed(orientation: Quaternion, x: float = 0.3, y: float = 0.2, z: float = 0.8) -> Placement:
    return Placement.of(Pose(position=Point(x=x, y=y, z=z), orientation=orientation), "it")


def check(footprint: Footprint, radius: float, top: float) -> None:
    assert (footprint.x, footprint.y) == (0.3, 0.2)
    assert footprint.radius == pytest.approx(radius, abs=1e-12)
    assert footprint.top == pytest.approx(top, abs=1e-12)


@pytest.mark.parametrize("yaw", [0.0, 0.4, math.pi / 2, -2.0])
def test_an_upright_box_covers_the_circle_of_its_corners_whatever_its_yaw(yaw: float) -> None:
    check(box(placed(turned("z", yaw)), (0.06, 0.08, 0.1), "it"), 0.05, 0.85)


def test_a_box_on_its_side_covers_the_circle_of_the_corners_that_lie_now() -> None:
    check(box(placed(turned("x", math.pi / 2)), (0.06, 0.1, 0.08), "it"), 0.05, 0.85)


def test_a_box_on_its_edge_is_as_high_as_its_diagonal() -> None:
    check(box(placed(turned("x", math.pi / 4)), (0.06, 0.1, 0.1), "it"), math.hypot(0.03, 0.05 * 2**0.5), 0.8 + 0.05 * 2**0.5)


@pytest.mark.parametrize("orientation", [turned("z", 0.7), turned("x", math.pi)])
def test_a_cylinder_that_stands_or_is_upside_down_covers_its_own_circle(orientation: Quaternion) -> None:
    check(cylinder(placed(orientation), 0.04, 0.1, "it"), 0.04, 0.85)


def test_a_cylinder_that_lies_covers_at_least_both_its_ends() -> None:
    footprint = cylinder(placed(turned("y", math.pi / 2)), 0.04, 0.1, "it")
    assert footprint.radius >= math.hypot(0.04, 0.05)
    assert footprint.top == pytest.approx(0.84)


def test_a_cylinder_that_leans_covers_its_rims() -> None:
    placement = placed(turned("y", 0.3), x=0.0, y=0.0, z=0.0)
    footprint = cylinder(placement, 0.04, 0.1, "it")
    for step in range(100):
        angle = step * math.tau / 100
        for end in (-0.05, 0.05):
            rim = Placement(((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0.04 * math.cos(angle), 0.04 * math.sin(angle), end))
            x, y, z = placement.then(rim).position
            assert math.hypot(x, y) <= footprint.radius and z <= footprint.top + 1e-12


def test_a_sphere_covers_its_own_circle() -> None:
    check(sphere(placed(turned("x", 1.0)), 0.04, "it"), 0.04, 0.84)


def test_a_placement_within_another_is_turned_and_moved_by_it() -> None:
    outer = placed(turned("z", math.pi / 2), x=1.0, y=2.0, z=0.5)
    inner = placed(turned("x", math.pi / 2), x=0.3, y=0.1, z=0.2)
    both = outer.then(inner)
    assert both.position == pytest.approx((0.9, 2.3, 0.7))
    # The inner z axis points at -y before the outer turn, and so at +x after it.
    assert [row[2] for row in both.rotation] == pytest.approx([1.0, 0.0, 0.0])


@pytest.mark.parametrize("w", [0.0, 0.99, 1.01, math.nan])
def test_a_turn_that_is_no_unit_quaternion_is_refused(w: float) -> None:
    with pytest.raises(Failure, match="no unit quaternion"):
        placed(Quaternion(w=w))


def test_a_place_that_is_no_number_is_refused() -> None:
    with pytest.raises(Failure, match="at no place"):
        placed(Quaternion(), x=math.nan)


@pytest.mark.parametrize("length", [0.0, -0.1, math.nan, math.inf])
def test_a_solid_without_a_size_is_refused(length: float) -> None:
    placement = placed(Quaternion())
    with pytest.raises(Failure, match="no size"):
        box(placement, (0.1, 0.1, length), "it")
    with pytest.raises(Failure, match="no size"):
        cylinder(placement, length, 0.1, "it")
    with pytest.raises(Failure, match="no size"):
        sphere(placement, length, "it")
