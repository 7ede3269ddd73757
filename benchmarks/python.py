#!/usr/bin/env python3
"""What a learner or a sampling controller gets from Python: control steps a second of a batch, beside the batch engine alone and, where they are
installed, MuJoCo's batch, highway-env and JSBSim; and how long it takes from `import` to the first step.

Environment steps of hamilcar.gym, with their resets, and the price of a gradient beside that of its run.

A control step is 20 ms: 20 steps of 1 ms with new controls for every car before and twelve channels of every car after. One thread.
Usage: PYTHONPATH=build/release/python benchmarks/python.py [CARS]
"""

import subprocess
import sys
import time

import numpy as np

import hamilcar

CHANNELS = [
    "chassis.speed", "chassis.lateral_speed", "chassis.yaw_rate", "chassis.position.x", "chassis.position.y", "chassis.angle.yaw",
    "chassis.angle.roll", "chassis.longitudinal_acceleration", "chassis.lateral_acceleration", "input.rack",
    "front_left.tire.slip_angle", "rear_left.tire.slip_angle",
]


def seconds(work, rounds=5, times=5):
    """Of one call, the best of several rounds."""
    work()
    best = float("inf")
    for _ in range(rounds):
        begin = time.perf_counter()
        for _ in range(times):
            work()
        best = min(best, (time.perf_counter() - begin) / times)
    return best


def of_hamilcar(name, precision, count):
    batch = hamilcar.Batch(
        name, count, speed=20.0, powered=False, threads=1, precision=precision, energy_balance=False
    )
    controls = np.zeros((count, len(batch.control_names)))
    nothing = np.full_like(controls, np.nan)

    def control_step():
        batch.step(20, controls)
        batch.read(CHANNELS)

    alone, whole = seconds(lambda: batch.step(20, nothing)), seconds(control_step)
    print(
        f"hamilcar {name:16} {precision:7} {count / whole:10.0f} control steps/s"
        f"  {alone / whole:.2f} of the engine alone ({batch.engine})"
    )


def of_environment(count, precision):
    import hamilcar.gym

    env = hamilcar.gym.make_vec("LaneKeeping", count, precision=precision)
    env.reset(seed=1)
    actions = np.random.default_rng(1).uniform(-1, 1, (16, count, 1)).astype(np.float32)
    nothing = np.full((count, len(env.batch.control_names)), np.nan)
    turn = iter(range(10**9))
    whole = seconds(lambda: env.step(actions[next(turn) % 16]), 5, 25)
    alone = seconds(lambda: env.batch.step(20, nothing), 5, 25)
    print(f"hamilcar.gym LaneKeeping {precision:8} {count / whole:10.0f} environment steps/s  {alone / whole:.2f} of the engine alone")


def of_derivatives(name):
    rollout = hamilcar.Rollout(name, record=CHANNELS[:6], speed=20.0, threads=1)
    rows, runs, weights = 10, 32, {"y_weights": np.ones((32, 10, 6))}
    controls = np.zeros((runs, rows, len(rollout.control_names)))
    controls[..., 0] = np.linspace(-0.005, 0.005, rows)
    once = seconds(lambda: rollout(controls, state=rollout.start))
    gradient = seconds(lambda: rollout.gradient(controls, state=rollout.start, **weights))
    print(f"hamilcar.Rollout {name:18} a run {1e6 * once / runs / rows / 20:5.2f} us a step, its gradient {gradient / once:.1f} runs")


MUJOCO_CAR = """<mujoco><option timestep="0.001"/><worldbody><geom type="plane" size="0 0 1"/>
<body name="car" pos="0 0 .35"><freejoint/><geom type="box" size="1.2 .7 .2" mass="1000"/>
{wheels}</body></worldbody><actuator>{motors}</actuator></mujoco>"""


def mujoco_car():
    wheels = motors = ""
    for i, (x, y) in enumerate([(1.2, 0.7), (1.2, -0.7), (-1.2, 0.7), (-1.2, -0.7)]):
        steer = f'<joint name="s{i}" type="hinge" axis="0 0 1" range="-35 35" damping="50"/>' if x > 0 else ""
        wheels += (
            f'<body pos="{x} {y} -.05"><joint type="slide" axis="0 0 1" stiffness="20000" damping="1500"/>{steer}'
            f'<joint name="w{i}" type="hinge" axis="0 1 0"/><geom type="cylinder" size=".3 .1" zaxis="0 1 0" mass="20"/></body>'
        )
        motors += f'<motor joint="w{i}" gear="1"/>' + (f'<position joint="s{i}" kp="500"/>' if x > 0 else "")
    return MUJOCO_CAR.format(wheels=wheels, motors=motors)


def of_mujoco(count):
    import mujoco
    import mujoco.batch

    batch = mujoco.batch.Batch(mujoco.MjModel.from_xml_string(mujoco_car()), count, nthread=1)
    positions = batch.bind("qpos")

    def control_step():
        batch.step(nstep=20)
        np.array(positions)

    print(f"mujoco {mujoco.__version__}, a box on four sprung wheels   {count / seconds(control_step, 3, 1):10.0f} control steps/s")


def of_highway():
    import gymnasium
    import highway_env  # noqa: F401

    env = gymnasium.make("racetrack-v0")
    env.reset(seed=1)

    def control_step():
        if any(env.step(env.action_space.sample())[2:4]):
            env.reset()

    print(f"highway-env racetrack-v0, a kinematic bicycle    {1 / seconds(control_step, 2, 20):10.0f} control steps/s")


def of_jsbsim():
    import jsbsim

    plane = jsbsim.FGFDMExec(None)
    plane.set_debug_level(0)
    plane.load_model("c172p")
    plane.set_dt(0.001)
    plane.run_ic()
    print(f"jsbsim c172p, an aircraft alone                  {1 / seconds(lambda: [plane.run() for _ in range(20)], 3, 50):10.0f} control steps/s")


def first_step():
    code = (
        "import time; t0 = time.perf_counter(); import hamilcar; t1 = time.perf_counter();"
        "s = hamilcar.Simulation('bmw_323i', speed=20.0); s.step(1); t2 = time.perf_counter();"
        "print(f'import {1e3 * (t1 - t0):.0f} ms, from there to the first step {1e3 * (t2 - t1):.0f} ms')"
    )
    print(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip())


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1024
    first_step()
    for name in ("bmw_323i", "bmw_323i_paper"):
        for precision in ("double", "single"):
            of_hamilcar(name, precision, count)
    for name in ("bmw_323i", "bmw_e90_330i", "truck_semitrailer"):
        of_derivatives(name)
    learn = [lambda precision=precision: of_environment(count, precision) for precision in ("double", "single")]
    for peer in (*learn, lambda: of_mujoco(count), of_highway, of_jsbsim):
        try:
            peer()
        except (ImportError, AttributeError) as missing:
            print(f"left out: {missing}")


if __name__ == "__main__":
    main()
