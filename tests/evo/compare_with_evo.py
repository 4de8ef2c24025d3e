# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Compares every metric of regolith with evo_ape and evo_rpe on random trajectories.

usage: compare_with_evo.py REGOLITH_EVO_METRICS [--cases N] [--seed N]
Without --cases it makes 8 pairs of trajectories, or 20 where REGOLITH_LONG_TESTS is set.

The trajectories have gaps, jittered, repeated and missing stamps, different rates and lengths.
evo's programs are run, not imported. Exit codes: 0 all agree, 1 they differ, 77 evo is not
installed.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import zipfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy

# Absolute and relative: sums of squares grow past the digits of a small absolute bound.
TOLERANCE = 1e-6
STATISTICS = ("rmse", "mean", "median", "std", "min", "max", "sse")
TEN_METRES = ("--delta", "10", "--delta_unit", "m", "--all_pairs")
ALIGN_ARGUMENTS = {"se3": ("-a",), "sim3": ("-a", "-s"), "origin": ("--align_origin",), "none": ()}


def quaternion_product(first, second):
    """Hamilton product of arrays (n, 4) in the order x y z w."""
    vector_1, scalar_1 = first[:, :3], first[:, 3:]
    vector_2, scalar_2 = second[:, :3], second[:, 3:]
    vector = scalar_1 * vector_2 + scalar_2 * vector_1 + numpy.cross(vector_1, vector_2)
    scalar = scalar_1 * scalar_2 - numpy.sum(vector_1 * vector_2, axis=1, keepdims=True)
    return numpy.hstack([vector, scalar])


def rotation_to_quaternion(vectors):
    """Rotation vectors (n, 3) in radians to quaternions (n, 4), x y z w."""
    angle = numpy.linalg.norm(vectors, axis=1, keepdims=True)
    return numpy.hstack([0.5 * vectors * numpy.sinc(angle / (2 * numpy.pi)), numpy.cos(angle / 2)])


def path(times):
    """Positions (m) and attitudes of a rover that winds over hills."""
    heading = 0.8 * numpy.sin(0.11 * times) + 0.05 * times
    position = numpy.stack(
        [
            9.0 * numpy.sin(0.1 * times) + 0.3 * times,
            7.0 * numpy.cos(0.13 * times),
            0.4 * numpy.sin(0.5 * times),
        ],
        axis=1,
    )
    tilt = numpy.stack([0.1 * numpy.sin(times), 0.1 * numpy.cos(times), heading], axis=1)
    return position, rotation_to_quaternion(tilt)


def stamps(random, rate, duration, start):
    """Jittered stamps with missing and repeated ones and now and then a gap."""
    times = start + numpy.arange(0.0, duration, 1.0 / rate)
    times = times + random.normal(0.0, 0.1 / rate, len(times))
    times = times[random.random(len(times)) > 0.1]
    if random.random() < 0.5:
        hole = start + random.uniform(0.2, 0.7) * duration
        times = times[(times < hole) | (times > hole + 2.0)]
    repeated = times[random.random(len(times)) < 0.03]
    return numpy.round(numpy.sort(numpy.concatenate([times, repeated])), 9)


def write_tum(name, times, epoch, position, attitude):
    with open(name, "w", encoding="ascii") as file:
        for time, point, quaternion in zip(times, position, attitude):
            columns = [f"{epoch + int(time)}{f'{time % 1:.9f}'[1:]}"]
            columns += [f"{value:.15g}" for value in (*point, *quaternion)]
            file.write(" ".join(columns) + "\n")


def make_case(folder, seed):
    """Writes a reference and an estimate with drift, noise, scale and a frame of its own."""
    random = numpy.random.default_rng(seed)
    epoch = int(random.choice([0, 1_700_000_000]))
    duration = random.uniform(40.0, 90.0)
    reference_times = stamps(random, random.choice([20.0, 50.0, 100.0]), duration, 1.0)
    estimate_times = stamps(random, random.choice([5.0, 10.0, 30.0]), duration, random.uniform(1, 4))
    write_tum(folder / "reference.tum", reference_times, epoch, *path(reference_times))

    position, attitude = path(estimate_times)
    count = len(estimate_times)
    drift = numpy.cumsum(random.normal(0.0, 0.01, (count, 3)), axis=0)
    position = random.uniform(0.9, 1.1) * (position + drift + random.normal(0.0, 0.02, (count, 3)))
    wobble = numpy.cumsum(random.normal(0.0, 0.003, (count, 3)), axis=0)
    attitude = quaternion_product(attitude, rotation_to_quaternion(wobble))
    turn = rotation_to_quaternion(random.normal(0.0, 1.0, (1, 3))).repeat(count, axis=0)
    points = quaternion_product(
        quaternion_product(turn, numpy.hstack([position, numpy.zeros((count, 1))])),
        turn * [-1.0, -1.0, -1.0, 1.0],
    )[:, :3]
    write_tum(
        folder / "estimate.tum",
        estimate_times,
        epoch,
        points + random.normal(0.0, 20.0, 3),
        quaternion_product(turn, attitude),
    )


def run_evo(folder, program, name, *arguments):
    """Statistics and number of errors that an evo program finds."""
    result = folder / f"{name}.zip"
    command = [str(Path(sys.executable).parent / program), "tum"]
    command += [str(folder / "reference.tum"), str(folder / "estimate.tum")]
    command += ["--save_results", str(result), "--no_warnings", *arguments]
    # evo writes its settings into the home folder when it runs first, and two at once collide.
    home = {**os.environ, "HOME": str(folder)}
    output = subprocess.run(command, capture_output=True, text=True, check=False, env=home)
    if not result.exists():
        raise RuntimeError(f"{' '.join(command)}: {output.stdout[-500:]}{output.stderr[-500:]}")
    with zipfile.ZipFile(result) as archive:
        statistics = json.loads(archive.read("stats.json"))
        errors = numpy.load(archive.open("error_array.npy"))
    return statistics, len(errors)


def evo_metrics(folder, mode, max_difference):
    common = ("--t_max_diff", str(max_difference), *ALIGN_ARGUMENTS[mode])
    metrics = {}
    for name, program, arguments in (
        ("ape", "evo_ape", ()),
        ("rpe", "evo_rpe", ("--delta", "1", "--delta_unit", "f")),
        ("rpe_10m", "evo_rpe", TEN_METRES),
    ):
        statistics, count = run_evo(folder, program, name, *common, *arguments)
        metrics.update({f"{name}.{key}": statistics[key] for key in STATISTICS})
        if name == "ape":
            metrics["matched"] = count
    metrics["drift_percent"] = 100.0 * metrics["rpe_10m.mean"] / 10.0
    angle = ("-r", "angle_deg")
    metrics["rotation_deg"] = run_evo(folder, "evo_ape", "angle", *common, *angle)[0]["mean"]
    turn = run_evo(folder, "evo_rpe", "turn", *common, *TEN_METRES, *angle)[0]["mean"]
    metrics["rotation_deg_per_m"] = turn / 10.0
    return metrics


def regolith_metrics(program, folder, mode, max_difference):
    command = [program, str(folder / "reference.tum"), str(folder / "estimate.tum"), mode]
    output = subprocess.run(
        [*command, str(max_difference)], capture_output=True, text=True, check=True
    )
    return {name: float(value) for name, value in map(str.split, output.stdout.splitlines())}


def compare(program, case, seed):
    """The largest difference of a case and a line for every metric that differs."""
    mode = tuple(ALIGN_ARGUMENTS)[case % 4]
    max_difference = (0.02, 0.02, 0.005)[case // 4 % 3]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        make_case(folder, seed + case)
        ours = regolith_metrics(program, folder, mode, max_difference)
        theirs = evo_metrics(folder, mode, max_difference)
    worst, lines = 0.0, []
    for key, value in theirs.items():
        difference = abs(ours.get(key, numpy.inf) - value) / max(1.0, abs(value))
        worst = max(worst, difference)
        if not difference <= TOLERANCE:
            lines.append(f"case {case} ({mode}): {key}: evo {value!r}, regolith {ours.get(key)!r}")
    return worst, lines, theirs["matched"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    cases = 20 if os.environ.get("REGOLITH_LONG_TESTS") else 8
    parser.add_argument("--cases", type=int, default=cases)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    if not (Path(sys.executable).parent / "evo_ape").exists():
        print("SKIPPED: evo is not installed in .venv; scripts/setup.sh test installs it")
        return 77
    with ThreadPoolExecutor(2) as pool:
        results = list(
            pool.map(
                lambda case: compare(arguments.program, case, arguments.seed),
                range(arguments.cases),
            )
        )
    lines = [line for _, found, _ in results for line in found]
    print("\n".join(lines))
    print(
        f"{len(results)} pairs of trajectories, {sum(matched for *_, matched in results)} poses, "
        f"{len(lines)} differences, largest {max(worst for worst, *_ in results):.3g}"
    )
    return 1 if lines or len(results) < arguments.cases else 0


if __name__ == "__main__":
    sys.exit(main())
