#!/usr/bin/env python3
"""Learns to keep a lane, with NumPy alone: augmented random search (Mania, Guy and Recht, NeurIPS 2018) for a linear policy.

A direction in the space of weights is tried both ways; all tries are cars of one batch, so an iteration is one episode. The weights
go where the better of each two tries was, for the best directions, in units of the spread of the returns.
Usage: examples/python/learn_lane_keeping.py [ITERATIONS]
"""

import sys

import numpy as np

import hamilcar.gym


def drive(env, weights, seeds):
    """Returns (n,) of the first episodes of cars that each have their ``weights`` (n, k, o), begun with ``seeds``; and which of
    them (n,) ended before their time."""
    scale = env.single_observation_space.high
    observed, _ = env.reset(seed=seeds)
    returns, over, failed = (np.zeros(env.num_envs, dtype=kind) for kind in (float, bool, bool))
    for _ in range(env.max_episode_steps):
        actions = np.einsum("nko,no->nk", weights, observed / scale)
        observed, rewards, terminations, truncations, _ = env.step(actions)
        returns += np.where(over, 0.0, rewards)
        failed |= terminations & ~over
        over |= terminations | truncations
        if over.all():
            break
    return returns, failed


def learn(iterations=12, directions=32, best=8, cars=8, steps=300, noise=0.6, rate=0.6, seed=0, report=None):
    """Weights (k, o) after so many iterations. Each of ``directions`` is driven both ways by ``cars`` cars."""
    random = np.random.default_rng(seed)
    env = hamilcar.gym.make_vec("LaneKeeping", 2 * directions * cars, max_episode_steps=steps)
    weights = np.zeros((env.single_action_space.shape[0], env.single_observation_space.shape[0]))
    for iteration in range(iterations):
        ways = random.normal(size=(directions, *weights.shape))
        tried = weights + noise * np.stack([ways, -ways])
        # The same starts for every try, new ones each iteration.
        starts = [1000 * (1 + iteration) + car for car in range(cars)] * (2 * directions)
        returns, _ = drive(env, np.repeat(tried.reshape(-1, *weights.shape), cars, axis=0), starts)
        there, back = returns.reshape(2, directions, cars).mean(axis=2)
        chosen = np.argsort(-np.maximum(there, back))[:best]
        spread = np.std([there[chosen], back[chosen]]) + 1e-9
        weights = weights + rate / (best * spread) * np.tensordot(there[chosen] - back[chosen], ways[chosen], axes=1)
        if report:
            best_try = max(there.max(), back.max())
            report(f"iteration {iteration + 1:3}: returns of the tries {returns.mean():7.1f}, of the best {best_try:7.1f}")
    return weights


def held_out(weights, cars=64):
    """Mean return of whole episodes and the share that left the lane, with seeds that ``learn`` has not used."""
    env = hamilcar.gym.make_vec("LaneKeeping", cars)
    returns, failed = drive(env, np.repeat(weights[None], cars, axis=0), [10**6 + car for car in range(cars)])
    return returns.mean(), failed.mean()


def main():
    weights = learn(int(sys.argv[1]) if len(sys.argv) > 1 else 12, report=print)
    for name, some in (("untrained", np.zeros_like(weights)), ("trained", weights)):
        score, left = held_out(some)
        print(f"{name:9} return {score:6.1f} of at most 500, {left:.0%} left the lane")


if __name__ == "__main__":
    main()
