"""The tasks: paths against closed forms, rewards against their formulas, geometry against samples, controllers against chance."""

import numpy as np
import pytest

pytest.importorskip("gymnasium")

import hamilcar.gym as driving  # noqa: E402


# Paths


def circle(radius, points=60):
    angle = np.linspace(0, 2 * np.pi, points, endpoint=False)
    return driving.Path(radius * np.column_stack([np.cos(angle), np.sin(angle)]))


def test_a_path_through_points_of_a_circle_is_the_circle(random):
    path = circle(40.0)
    assert path.length == pytest.approx(2 * np.pi * 40, rel=1e-5)
    assert path.curvature == pytest.approx(np.full(len(path), 1 / 40), rel=5e-3)
    assert np.hypot(path.x, path.y) == pytest.approx(np.full(len(path), 40.0), abs=1e-3)
    angle, radius = random.uniform(0, 2 * np.pi, 200), random.uniform(33, 47, 200)
    piece = np.rint((angle * 40 + random.uniform(-3, 3, 200)) / path.spacing).astype(np.int64)
    distance, offset, heading, _, _ = path.locate(radius * np.cos(angle), radius * np.sin(angle), piece)
    assert offset == pytest.approx(40 - radius, abs=2e-3)
    assert distance == pytest.approx(40 * angle, abs=5e-3)
    assert np.cos(heading - angle) == pytest.approx(np.zeros(200), abs=2e-3) and (np.sin(heading - angle) > 0).all()


def test_a_point_beside_a_path_is_found_where_it_was_put(random):
    path = driving.winding_road()
    assert path.curvature.max() > 0.006 and path.curvature.min() < -0.005
    distance, offset = random.uniform(0, path.length, 500), random.uniform(-3, 3, 500)
    x, y, heading, piece = path.at(distance, offset)
    off = piece + random.integers(-3, 4, 500)
    found, beside, direction, *_ = path.locate(x, y, off)
    assert beside == pytest.approx(offset, abs=1e-3) and np.abs(direction - heading).max() < 1e-3
    assert np.abs((found - distance + 0.5 * path.length) % path.length - 0.5 * path.length).max() < 0.01


def test_distance_counts_on_over_laps():
    path = circle(20.0)
    piece = np.zeros(1, dtype=np.int64)
    for angle in np.arange(0, 4.5 * np.pi, 0.03):
        distance, *_, piece = path.locate(np.array([20 * np.cos(angle)]), np.array([20 * np.sin(angle)]), piece)
    assert distance[0] == pytest.approx(20 * angle, abs=0.02)


@pytest.mark.parametrize("points", [[[0, 0], [1, 0]], [[0, 0, 0]] * 4, [[0, 0], [1, 0], [1, np.nan]], [[0, 0], [0, 0], [1, 1]]])
def test_points_that_are_no_path_are_refused(points):
    with pytest.raises(ValueError, match="points"):
        driving.Path(points)


# Rewards


def test_the_reward_of_lane_keeping_is_its_formula(random):
    env = driving.make_vec("LaneKeeping", 20)
    before = env.reset(seed=1)[0].astype(float)
    for _ in range(20):
        after, rewards, terminations, *_ = env.step(random.uniform(-1, 1, (20, 1)))
        after = after.astype(float)
        offset, heading, wheel = after[:, 0], after[:, 1], after[:, 5]
        assert np.abs(wheel - before[:, 5]).max() <= 0.2401  # 12 rad/s for 20 ms
        expected = 1 - (offset / 1.75) ** 2 - (heading / 0.5) ** 2 - 0.05 * ((wheel - before[:, 5]) / 0.24) ** 2
        assert rewards == pytest.approx(expected, abs=1e-5) and not terminations.any()
        before = after


def test_the_offset_moves_as_speed_and_course_say(random):
    """Kinematics along the road: the offset's rate is speed times the sine of the course against the road's direction."""
    env = driving.make_vec("LaneKeeping", 40)
    rows = [env.reset(seed=5)[0]] + [env.step(np.zeros((40, 1)))[0] for _ in range(20)]
    rows = np.array(rows, dtype=float)
    rate = rows[:, :, 2] * np.sin(rows[:, :, 1]) + rows[:, :, 3] * np.cos(rows[:, :, 1])
    moved = 0.02 * np.trapezoid(rate, axis=0) if hasattr(np, "trapezoid") else 0.02 * np.trapz(rate, axis=0)
    assert rows[-1, :, 0] - rows[0, :, 0] == pytest.approx(moved, abs=2e-3)


def test_the_reward_of_a_circuit_adds_up_to_the_distance():
    env = driving.make_vec("RacingLine", 5)
    observed = env.reset(seed=1)[0]
    total, driven = np.zeros(5), np.zeros(5)
    for _ in range(50):
        observed, rewards, *_ = env.step(np.tile([0.0, 0.3], (5, 1)))
        total += rewards
        driven += 0.02 * observed[:, 2]
    assert 20 * 0.02 * total == pytest.approx(driven, rel=0.03)


def test_pieces_of_the_slot_that_a_car_covers_are_touched(random):
    """Against points spread over the car."""
    env = driving.make_vec("Parking", 600)
    env.reset(seed=1)
    task = env.task
    task.x, task.y = random.uniform(-6, 4, 600), random.uniform(-3, 3, 600)
    task.heading = random.uniform(-np.pi, np.pi, 600)
    task.cos, task.sin = np.cos(task.heading), np.sin(task.heading)
    ahead, left = (grid.ravel() for grid in np.meshgrid(np.linspace(-2.15, 2.15, 130), np.linspace(-0.8, 0.8, 50)))
    x = task.x[:, None] + np.outer(task.cos, ahead) - np.outer(task.sin, left)
    y = task.y[:, None] + np.outer(task.sin, ahead) + np.outer(task.cos, left)
    depth = np.where(x < 0, np.maximum(np.minimum(-x, np.abs(y) - 1.5), -x - 5.2), -1).max(axis=1)  # in a wall, at most
    clear = np.abs(depth) > 0.08  # the grid misses what is less
    expected = (depth > 0)[clear]
    assert 100 < expected.sum() < clear.sum() - 20 and np.array_equal(task.touches()[clear], expected)


def test_braking_begins_with_ice_under_either_side():
    env = driving.make_vec("SplitFrictionBraking", 16)
    env.reset(seed=1)
    for _ in range(40):
        env.step(np.tile([0.0, -0.6], (16, 1)))
    left, right = (env.batch[f"front_{side}.tire.friction"] for side in ("left", "right"))
    assert ((left < 0.31) != (right < 0.31)).all() and (left < 0.31).any() and (right < 0.31).any()
    assert (np.sign(env.batch["chassis.angle.yaw"]) == np.where(left > right, 1, -1)).all()  # it turns to where the grip is


# Controllers


def keep_lane(o):
    offset, heading, speed, _, rate, _ = o[:, :6].T
    here, ahead = o[:, 6:8].T
    return [((45 + 0.09 * speed**2) * ahead - 0.6 * offset - 8 * heading + 0.3 * (speed * here - rate)) / 1.5]


def change_lane(o):
    offset, heading, speed = o[:, :3].T
    return [6 * (np.clip(-offset / speed, -3.3 / speed, 3.3 / speed) - heading)]


def race(o):
    offset, heading, speed = o[:, :3].T
    curvature = o[:, 8:].T
    ahead = np.array(driving.RacingLine.preview)[:, None]
    possible = np.sqrt((5 / np.maximum(np.abs(curvature), 1e-3) + 8 * ahead).min(axis=0))
    steer = (45 + 0.095 * speed**2) * curvature[1] - 0.3 * offset - 7.5 * heading
    return [steer / 4, np.clip(0.45 * (possible - speed), -0.6, 0.85)]


def drift(o):
    offset, course, slip, speed, rate, _, left, right, curvature = o.T
    side = np.sign(curvature)
    steer = 17 * (0.83 * slip - 0.34 * course) + 11 * (speed * curvature - rate) + 4.9 * (slip + 0.5 * side) + 0.34 * side * offset
    sliding = np.minimum(0.5 * (left + right), 1) - 0.3
    return [steer / 9, 0.42 + 1.4 * (0.5 - np.abs(slip)) - 0.07 * (9 - speed) - 0.37 * sliding]


def park(o):
    """Straight back, then the arc that ends on the slot's axis, then along it; looking at the rear axle."""
    x, y, heading, speed, _, _ = o.T
    y = y - 1.3 * np.sin(heading)
    bend = (1 - np.cos(heading)) / np.maximum(np.abs(y), 1e-3)
    bend = np.where(bend > 1 / 6.6, np.minimum(bend, 1 / 4.5), 0.0) * np.sign(heading)
    bend = np.where(np.abs(heading) < 0.25, 1.2 * heading - 0.35 * y, bend)
    to_go = x + 2.6
    push = 1.2 * (-np.clip(0.6 * to_go, 0, 1.5) - speed)
    return [4.6 * bend, np.where(to_go < 0.1, 0.0, push), np.where(to_go < 0.1, 1.0, -1.0)]


def brake(o):
    offset, heading, _, _, rate = o[:, :5].T
    return [-(2.3 * offset + 34 * heading + rate) / 4, 0.4 - 8 * np.abs(heading)]


def first_episodes(name, controller, count=12):
    """Returns (n,) and successes (n,)."""
    env = driving.make_vec(name, count)
    random = np.random.default_rng(2)
    observed, _ = env.reset(seed=500)
    returns, succeeded, over = np.zeros(count), np.zeros(count, dtype=bool), np.zeros(count, dtype=bool)
    while not over.all():
        by_chance = random.uniform(-1, 1, env.action_space.shape)
        actions = np.clip(np.transpose(controller(observed)), -1, 1) if controller else by_chance
        observed, rewards, terminations, truncations, infos = env.step(actions)
        returns += np.where(over, 0.0, rewards)
        succeeded |= infos.get("is_success", False) & ~over
        over |= terminations | truncations
    return returns, succeeded


@pytest.mark.parametrize("name, controller, least, successes", [
    ("LaneKeeping", keep_lane, 450, 1.0), ("LaneChange", change_lane, 190, 1.0), ("RacingLine", race, 2300, 0.9),
    ("Drift", drift, 250, 0.5), ("Parking", park, 25, 1.0), ("SplitFrictionBraking", brake, -5, 1.0),
])
def test_a_sensible_controller_is_far_better_than_chance(name, controller, least, successes):
    returns, succeeded = first_episodes(name, controller)
    chance, lucky = first_episodes(name, None)
    assert returns.mean() > least > chance.mean() + 20 and np.median(returns) > chance.max()
    assert succeeded.mean() >= successes and not lucky.all()
