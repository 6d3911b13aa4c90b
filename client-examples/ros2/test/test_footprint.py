import math

import pytest
from geometry_msgs.msg import Point, Pose, Quaternion

from singulate_ros.failure import Failure
from singulate_ros.footprint import MOST_CORNERS, Footprint, Placement, box, cylinder, mesh, sphere
from singulate_ros.hull import area, hull


def turned(axis: str, angle: float) -> Quaternion:
    parts = {"x": 0.0, "y": 0.0, "z": 0.0, axis: math.sin(angle / 2)}
    return Quaternion(x=parts["x"], y=parts["y"], z=parts["z"], w=math.cos(angle / 2))


def placed(orientation: Quaternion, x: float = 0.3, y: float = 0.2, z: float = 0.8) -> Placement:
    return Placement.of(Pose(position=Point(x=x, y=y, z=z), orientation=orientation), "it")


def check(footprint: Footprint, radius: float, top: float) -> None:
    assert (footprint.x, footprint.y) == (0.3, 0.2)
    assert footprint.radius == pytest.approx(radius, abs=1e-12)
    assert footprint.top == pytest.approx(top, abs=1e-12)


def check_rectangle(footprint: Footprint, yaw: float, length: float, width: float) -> None:
    assert (footprint.x, footprint.y, footprint.top) == pytest.approx((0.3, 0.2, 0.85))
    assert math.sin(footprint.yaw - yaw) == pytest.approx(0.0), "a rectangle is the same after half a turn"
    assert footprint.shape == {"kind": "rectangle", "length": pytest.approx(length), "width": pytest.approx(width)}
    assert area(footprint.corners) == pytest.approx(length * width)


@pytest.mark.parametrize("yaw", [0.0, 0.4, math.pi / 2, -2.0])
def test_an_upright_box_covers_its_rectangle_whatever_its_yaw(yaw: float) -> None:
    check_rectangle(box(placed(turned("z", yaw)), (0.06, 0.08, 0.1), "it"), yaw, 0.06, 0.08)


def test_a_box_on_its_side_covers_the_rectangle_that_lies_now() -> None:
    check_rectangle(box(placed(turned("x", math.pi / 2)), (0.06, 0.1, 0.08), "it"), math.pi / 2, 0.08, 0.06)
    check_rectangle(box(placed(turned("y", math.pi / 2)), (0.1, 0.06, 0.08), "it"), math.pi / 2, 0.06, 0.08)


def test_a_box_that_leans_by_no_more_than_noise_has_the_rectangle_of_its_corners() -> None:
    footprint = box(placed(turned("y", 0.005)), (0.06, 0.08, 0.1), "it")
    assert footprint.shape is not None and footprint.shape["kind"] == "rectangle"
    assert footprint.shape["length"] == pytest.approx(0.06 * math.cos(0.005) + 0.1 * math.sin(0.005))


def test_a_box_on_its_edge_covers_the_polygon_of_its_corners_and_is_as_high_as_its_diagonal() -> None:
    footprint = box(placed(turned("x", math.pi / 4)), (0.06, 0.1, 0.1), "it")
    assert footprint.shape is not None and footprint.shape["kind"] == "polygon"
    assert area(footprint.corners) == pytest.approx(0.06 * 0.1 * 2**0.5)
    assert footprint.top == pytest.approx(0.8 + 0.05 * 2**0.5)


def test_a_mesh_of_many_corners_covers_a_polygon_of_few_that_holds_them() -> None:
    around = [(0.1 * math.cos(angle), 0.05 * math.sin(angle), 0.02) for angle in (math.tau * i / 90 for i in range(90))]
    footprint = mesh(placed(turned("z", 0.4)), around, "it")
    assert footprint.shape is not None and len(footprint.shape["points"]) == MOST_CORNERS
    exact = hull(placed(turned("z", 0.4)).at(vertex)[:2] for vertex in around)
    assert len(exact) == 90 and area(exact) < area(footprint.corners) < 1.02 * area(exact)
    assert area(hull([*footprint.corners, *exact])) == pytest.approx(area(footprint.corners), rel=1e-12)
    assert footprint.assumed.startswith("is a mesh, planned as the convex hull of its footprint with 32 of its 90 corners: ")
    assert (footprint.x, footprint.y, footprint.top) == pytest.approx((0.3, 0.2, 0.82), abs=1e-4)


def test_a_mesh_that_covers_nothing_or_is_nowhere_is_refused() -> None:
    for flat in ([], [(0.0, 0.0, 0.0), (0.1, 0.1, 0.0), (0.1, 0.1, 0.3)]):
        with pytest.raises(Failure, match="it has no size"):
            mesh(placed(Quaternion()), flat, "it")
    with pytest.raises(Failure, match="a vertex at no place"):
        mesh(placed(Quaternion()), [(0.0, 0.0, math.nan)], "it")


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
