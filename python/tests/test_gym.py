"""The environments against Gymnasium's contract: its checker, its own vectorization, seeds, modes, randomization, refusals."""

import importlib.util
import warnings
from pathlib import Path

import numpy as np
import pytest

import hamilcar

gymnasium = pytest.importorskip("gymnasium")

import hamilcar.gym as driving  # noqa: E402
from gymnasium.vector import AutoresetMode, SyncVectorEnv  # noqa: E402

ALL = list(driving.TASKS)
MODES = list(AutoresetMode)


def actions_of(env, random, rows):
    return random.uniform(-1, 1, (rows, *env.action_space.shape)).astype(np.float32)


@pytest.mark.parametrize("name", ALL)
def test_the_checker_of_gymnasium_is_content(name):
    from gymnasium.utils.env_checker import check_env

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(gymnasium.make(f"hamilcar/{name}-v0", bank=4).unwrapped)


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.value)
def test_is_what_gymnasium_makes_of_single_cars(name, mode, random):
    """Bits, flags and infos of SyncVectorEnv over four CarEnv."""
    settings = {"max_episode_steps": 17, "bank": 5}
    ours = driving.make_vec(name, 4, autoreset_mode=mode, **settings)
    theirs = SyncVectorEnv([lambda: driving.CarEnv(name, **settings)] * 4, autoreset_mode=mode)
    assert ours.observation_space == theirs.observation_space and ours.action_space == theirs.action_space
    # From there on one car is behind the others.
    delayed = {"reset_mask": np.array([False, True, False, False])}
    calls = [lambda env: env.reset(seed=7)]
    calls += [lambda env, a=a: env.step(a) for a in actions_of(ours, random, 6)]
    calls += [lambda env: env.reset(options=dict(delayed))]
    over = np.zeros(4, dtype=bool)
    for call in [*calls, *(lambda env, a=a: env.step(a) for a in actions_of(ours, random, 34))]:
        if mode == AutoresetMode.DISABLED and over.any():
            mask = {"reset_mask": over}
            same(ours.reset(options=dict(mask)), theirs.reset(options=dict(mask)))
        one, other = call(ours), call(theirs)
        same(one, other)
        over = one[2] | one[3] if len(one) == 5 else np.zeros(4, dtype=bool)


def same(one, other):
    for ours, theirs in zip(one[:-1], other[:-1]):
        assert ours.dtype == theirs.dtype and np.array_equal(ours, theirs)
    assert_infos(one[-1], other[-1])


def assert_infos(ours, theirs):
    assert ours.keys() == theirs.keys()
    for key in ours:
        if isinstance(ours[key], dict):
            assert_infos(ours[key], theirs[key])
        else:
            assert all(np.array_equal(a, b) for a, b in zip(ours[key], theirs[key])), key


def test_a_seed_is_the_same_episode_whatever_the_neighbours(random):
    actions = random.uniform(-1, 1, (40, 2)).astype(np.float32)
    alone = gymnasium.make("hamilcar/RacingLine-v0").unwrapped
    expected = [alone.reset(seed=31)[0]] + [alone.step(action)[0] for action in actions]
    for count, place, threads in ((1, 0, 1), (3, 1, 2), (13, 12, 1)):
        env = driving.make_vec("RacingLine", count, threads=threads)
        others = actions_of(env, random, 40)
        others[:, place] = actions
        rows = [env.reset(seed=31 - place)[0]] + [env.step(row)[0] for row in others]
        assert np.array_equal([row[place] for row in rows], expected)


def test_seeds_may_be_listed_and_without_one_episodes_go_on():
    env = driving.make_vec("LaneKeeping", 3)
    first = env.reset(seed=[4, None, 6])[0]
    assert np.array_equal(first[[0, 2]], env.reset(seed=4)[0][[0, 2]])
    again = env.reset()[0]
    assert not np.array_equal(again, env.reset()[0])
    env.reset(seed=4)
    assert np.array_equal(again, env.reset()[0])
    assert env.np_random_seed == (4, 5, 6)


def test_registered_vectors_have_the_time_limit_of_the_task():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name, task in driving.TASKS.items():
            env = gymnasium.make_vec(f"hamilcar/{name}-v0", num_envs=2, bank=1)
            assert isinstance(env, driving.CarVectorEnv) and env.max_episode_steps == task.max_episode_steps
            assert env.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
            env.close()
        assert gymnasium.make_vec("hamilcar/Drift-v0", num_envs=2, bank=1, max_episode_steps=9).max_episode_steps == 9


def test_wrappers_of_gymnasium_take_it(random):
    from gymnasium.wrappers.vector import NormalizeObservation, RecordEpisodeStatistics, RescaleObservation

    env = RecordEpisodeStatistics(driving.make_vec("LaneKeeping", 4, max_episode_steps=25))
    low, high = np.float32(-1), np.float32(1)
    env = NormalizeObservation(RescaleObservation(env, low, high))
    env.reset(seed=1)
    for _ in range(25):
        *_, infos = env.step(np.zeros((4, 1), dtype=np.float32))
    assert infos["_episode"].all() and (infos["episode"]["l"] == 25).all()
    assert list(infos["reason"]) == ["time limit"] * 4 and infos["is_success"].all()


def test_cars_that_the_engine_ends_terminate_with_the_penalty():
    class Careful(driving.LaneKeeping):
        tilt_limit = 0.02

    env = driving.make_vec(Careful(), 6)
    env.reset(seed=3)
    weights = np.zeros((6, 1), dtype=np.float32)
    weights[2] = 1.0
    for _ in range(60):
        _, rewards, terminations, _, infos = env.step(weights)
        if terminations.any():
            break
    assert list(terminations) == [False, False, True, False, False, False]
    assert rewards[2] < -8 and (rewards[[0, 1, 3]] > 0).all()
    assert "tilt" in infos["reason"][2] and not infos["is_success"][2]
    _, rewards, terminations, _, _ = env.step(weights)
    assert rewards[2] == 0 and not terminations.any() and not env.batch.ended.any()


def test_randomized_cars_have_their_numbers_and_drive_as_simulations_with_them():
    spreads = {"chassis.mass_kg": (0.8, 1.2), "road.friction": lambda random: random.normal(0.7, 0.05)}
    env = driving.make_vec("LaneChange", 12, randomize=spreads)
    env.reset(seed=2)
    nominal = hamilcar.Vehicle("bmw_323i")["chassis.mass_kg"]
    mass, friction = env.numbers["chassis.mass_kg"], env.numbers["road.friction"]
    assert len(set(mass)) > 8 and (mass >= 0.8 * nominal).all() and (mass <= 1.2 * nominal).all()
    assert np.std(friction) > 0.01 and abs(friction.mean() - 0.7) < 0.1
    speed = env.batch["chassis.speed"]
    for _ in range(30):
        assert not env.step(np.full((12, 1), 0.2))[2].any()
    for i in (0, 5):
        car = hamilcar.Vehicle("bmw_323i", {"chassis.mass_kg": mass[i]})
        alone = hamilcar.Simulation(car, speed=speed[i], friction=friction[i], powered=False, energy_balance=False)
        for row in range(30):
            held = np.clip(600 * (speed[i] - alone["chassis.speed"]), -900, 900)
            alone.step(20, steering_wheel=min(0.24 * (row + 1), 0.3), drive_torque=held)
        assert alone["chassis.yaw_rate"] == pytest.approx(env.batch["chassis.yaw_rate"][i], rel=1e-4)
        assert alone["chassis.lateral_acceleration"] == pytest.approx(env.batch["chassis.lateral_acceleration"][i], rel=1e-4)


def test_observations_are_within_bounds_and_named():
    for name in ALL:
        env = driving.make_vec(name, 3, bank=3)
        names = env.observation_names
        assert len(set(names)) == len(names) == len(env.observation_units) == env.single_observation_space.shape[0]
        assert len(env.action_names) == env.single_action_space.shape[0]
        env.reset(seed=1)
        for _ in range(60):
            observed, *_ = env.step(env.action_space.sample())
            assert env.observation_space.contains(observed), name


@pytest.mark.parametrize("wrong, error, said", [
    (lambda: driving.make_vec("LaneKeping"), ValueError, "did you mean 'LaneKeeping'"),
    (lambda: driving.make_vec(3), TypeError, "expected a name or a Task"),
    (lambda: driving.make_vec("Drift", 0), ValueError, "at least one car"),
    (lambda: driving.make_vec("Drift", bank=0), ValueError, "at least one start"),
    (lambda: driving.make_vec("Drift", steps=0), ValueError, "at least one step"),
    (lambda: driving.make_vec("Drift", render_mode="human"), ValueError, "render_mode"),
    (lambda: driving.make_vec("Drift", autoreset_mode="Never"), ValueError, "Never"),
    (lambda: driving.make_vec("Drift", max_episode_steps=0), ValueError, "at least one control period"),
    (lambda: driving.make_vec("Drift", randomize={"chassis.mass_kg": 1.1}), ValueError, "expected .low, high. factors"),
    (lambda: driving.make_vec("Drift", randomize={"chassis.mass_kg": (1.1, 0.9)}), ValueError, "0 < low <= high"),
    (lambda: driving.make_vec("Drift", randomize={"road.friction": lambda random: np.nan}), ValueError, "finite"),
    (lambda: driving.make_vec("Drift", randomize={"chassis.mas_kg": (0.9, 1.1)}), KeyError, "did you mean 'chassis.mass_kg'"),
    (lambda: driving.make_vec("Drift", randomize={"road.frictoin": (0.9, 1.1)}), KeyError, "did you mean 'road.friction'"),
    (lambda: driving.make_vec("Drift").step(np.zeros((1, 2))), gymnasium.error.ResetNeeded, "reset"),
    (lambda: driving.make_vec("Drift").reset(options={"reset_mask": np.array([True])}), gymnasium.error.ResetNeeded, "first"),
])
def test_what_is_wrong_is_refused(wrong, error, said):
    with pytest.raises(error, match=said):
        wrong()


def test_wrong_calls_are_refused_and_change_nothing():
    env = driving.make_vec("LaneKeeping", 3, autoreset_mode=AutoresetMode.DISABLED, max_episode_steps=2)
    env.reset(seed=1)
    before = env.batch.states
    for actions in (np.zeros(3), np.zeros((2, 1)), np.full((3, 1), np.nan)):
        with pytest.raises(ValueError, match="actions"):
            env.step(actions)
    for mask in (np.zeros(3, dtype=bool), np.ones(2, dtype=bool), np.ones(3), [True] * 3):
        with pytest.raises(ValueError, match="reset_mask"):
            env.reset(options={"reset_mask": mask})
    with pytest.raises(ValueError, match="2 seeds"):
        env.reset(seed=[1, 2])
    assert np.array_equal(env.batch.states, before)
    env.step(np.zeros((3, 1))), env.step(np.zeros((3, 1)))
    with pytest.raises(gymnasium.error.ResetNeeded, match="have ended"):
        env.step(np.zeros((3, 1)))


def test_stable_baselines_has_its_own_interface():
    vec_env = pytest.importorskip("stable_baselines3.common.vec_env")
    env = driving.stable_baselines(driving.make_vec("LaneKeeping", 3, autoreset_mode="SameStep", max_episode_steps=5))
    assert isinstance(env, vec_env.VecEnv)
    env.seed(4)
    first = env.reset()
    assert np.array_equal(first, driving.make_vec("LaneKeeping", 3).reset(seed=4)[0])
    for _ in range(5):
        observed, rewards, over, infos = env.step(np.zeros((3, 1), dtype=np.float32))
    assert over.all() and rewards.shape == (3,)
    for i, info in enumerate(infos):
        assert info["TimeLimit.truncated"] and not np.array_equal(info["terminal_observation"], observed[i])


def test_the_example_learns_to_keep_the_lane():
    path = Path(__file__).parents[2] / "examples" / "python" / "learn_lane_keeping.py"
    if not path.is_file():
        pytest.skip("the examples are not beside the tests")
    spec = importlib.util.spec_from_file_location("learn_lane_keeping", path)
    example = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    weights = example.learn(iterations=5, directions=24, cars=6, steps=200)
    untrained, left_before = example.held_out(np.zeros_like(weights), 32)
    trained, left_after = example.held_out(weights, 32)
    assert left_before > 0.9 and untrained < 150
    assert left_after < 0.2 and trained > 350
