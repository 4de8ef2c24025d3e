# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tables and plots that put feature methods side by side, all by the same images and rules."""

import csv
import itertools
import json
import pathlib

import numpy

from regolith_train import evaluation

# Baselines of simulated pairs, m: from, to.
BASELINES = [(0.1, 0.5), (0.5, 1.0), (1.0, 2.0)]
ROTATIONS = range(0, 181, 20)  # degrees
SCALES = [0.5, 0.7, 0.85, 1.2, 1.4, 2.0]


def score_method(extract, homographies, simulated, second_look=False):
    """All figures of one method. `simulated`: name → paths of their first images, with a second look at those where it is asked
    for."""
    result = {"oxford": evaluation.score_oxford(extract, homographies)}
    image, _ = evaluation.fitted(next((pathlib.Path(homographies) / "oxford_graf").glob("img1.*")))
    result["shifts"] = evaluation.score_shifts(extract, image)
    extract = remember(extract, image)
    result["rotation"] = {angle: evaluation.score_turn(extract, image, angle=angle)["correct"] for angle in ROTATIONS}
    result["scale"] = {scale: evaluation.score_turn(extract, image, scale=scale)["correct"] for scale in SCALES}
    result["simulated"] = {name: evaluation.score_simulated(extract, pairs, second_look) for name, pairs in simulated.items()}
    return result


def remember(extract, image):
    """`extract` that need not look at `image` twice."""
    known = extract(image)
    return lambda other: known if other is image else extract(other)


def simulated_groups(folders, most):
    """Pairs of `regolith simulate` by planet (PLANET/SEED/pairs), sun and baseline, `most` of a group at most and of each folder as
    many: name → paths of the first images. The name is `planet, same sun|other sun, FROM–TO m`."""
    groups = {}
    for folder in folders:
        with open(folder / "index.csv", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                sun = "same sun" if row["same_sun"] == "1" else "other sun"
                for low, high in BASELINES:
                    if low <= float(row["baseline_m"]) < high:
                        name = f"{folder.parents[1].name}, {sun}, {low:g}–{high:g} m"
                        groups.setdefault(name, {}).setdefault(folder, []).append(folder / f"{row['id']}_1.png")
    return {name: evenly(list(groups[name].values()), most) for name in sorted(groups)}


def evenly(lists, most):
    """The first of each list, the second of each, ..., `most` in all."""
    rounds = itertools.zip_longest(*lists)
    return [value for values in rounds for value in values if value is not None][:most]


def table(results):
    """Markdown: homographies and shifts."""
    lines = ["| | graf: correct / precision / repeatable 1 px | boat | lowest repeatability at 1 px under shifts |", "|---|---|---|---|"]
    for name, result in results.items():
        cells = [f"{row['correct']:.0f} / {row['correct'] / max(row['matches'], 1):.2f} / {row['repeatability_1']:.2f}"
                 for row in result["oxford"].values()]  # fmt: skip
        lines.append(f"| `{name}` | " + " | ".join(cells) + f" | {min(result['shifts'].values()):.2f} |")
    return "\n".join(lines) + "\n"


def simulated_table(results):
    """Markdown: a row for each group of simulated pairs, a column for each method."""
    lines = ["| pairs, kept / correct / precision | number | " + " | ".join(f"`{name}`" for name in results) + " |",
             "|---|---|" + "---|" * len(results)]  # fmt: skip
    for group, example in next(iter(results.values()))["simulated"].items():
        rows = [result["simulated"][group] for result in results.values()]
        cells = [f"{row['kept']:.0f} / {row['correct']:.0f} / {100 * row['precision']:.0f} %" for row in rows]
        lines.append(f"| {group} | {example['pairs']} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def figure_of(*arguments, **options):
    """pyplot.subplots for SVG, without a screen."""
    import matplotlib

    matplotlib.use("svg")
    from matplotlib import pyplot

    return pyplot.subplots(*arguments, **options)


def plot(results, path):
    """Curves over rotation, scale and shift, one line a method."""
    figure, axes = figure_of(1, 3, figsize=(13, 4))
    for name, result in results.items():
        axes[0].plot(list(result["rotation"]), list(result["rotation"].values()), label=name)
        axes[1].plot(list(result["scale"]), list(result["scale"].values()), label=name)
        axes[2].plot(list(result["shifts"]), list(result["shifts"].values()), label=name)
    for axis, label in zip(axes, ("rotation in the image, degrees", "scale", "shift dx,dy, pixels")):
        axis.set_xlabel(label)
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("correct matches of 500 keypoints, 3 px")
    axes[1].set_xscale("log", base=2)
    axes[2].set_ylabel("repeatability at 1 px")
    axes[2].tick_params(axis="x", rotation=60)
    axes[0].legend(fontsize=8)
    save(figure, path)


def plot_simulated(results, path):
    """Correct matches of simulated pairs over their baseline, an axis a planet; dashed under another sun."""
    groups = [name.split(", ") for name in next(iter(results.values()))["simulated"]]
    planets = sorted({planet for planet, _, _ in groups})
    figure, axes = figure_of(1, len(planets), figsize=(6 * len(planets), 4), squeeze=False)
    for axis, planet in zip(axes[0], planets):
        for index, (method, result) in enumerate(results.items()):
            for sun, style in (("same sun", "-o"), ("other sun", "--o")):
                ranges = [baseline for one, other, baseline in groups if (one, other) == (planet, sun)]
                correct = [result["simulated"][f"{planet}, {sun}, {baseline}"]["correct"] for baseline in ranges]
                axis.plot(ranges, correct, style, color=f"C{index}", label=method if sun == "same sun" else None, markersize=4)
        axis.set_title(f"{planet} (dashed: another sun)")
        axis.set_xlabel("between the cameras")
        axis.set_ylabel("correct matches of 500 keypoints, 3 px")
        axis.grid(alpha=0.3)
    axes[0][0].legend(fontsize=8)
    save(figure, path)


def plot_curves(folder, path):
    """The losses of a training, smoothed over 20 rows, and those of the images kept out of it."""
    figure, axis = figure_of(figsize=(7, 4))
    for name, style in (("curve.csv", "-"), ("validation.csv", "o")):
        if not (pathlib.Path(folder) / name).exists():
            continue
        with open(pathlib.Path(folder) / name, encoding="utf-8") as file:
            header, *rows = list(csv.reader(file))
        values = numpy.array(rows, dtype=float)
        window = min(20, len(values)) if style == "-" else 1
        steps = numpy.convolve(values[:, 0], numpy.ones(window) / window, "valid")
        for column in range(1, values.shape[1]):
            smooth = numpy.convolve(values[:, column], numpy.ones(window) / window, "valid")
            axis.plot(steps, smooth, style, label=f"{header[column]}{' (kept out)' if style == 'o' else ''}", markersize=3)
    axis.set_xlabel("step")
    axis.set_ylabel("loss")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    save(figure, path)


def save(figure, path):
    figure.tight_layout()
    # Neither date nor random identifiers, so that the same figures give the same file.
    from matplotlib import rcParams

    rcParams["svg.hashsalt"] = "regolith"
    figure.savefig(path, metadata={"Date": None})


def report(names, load, homographies, simulated, out, second_look=False, progress=print):
    """Scores the methods of `names` (`load` makes extracts of them) and writes tables, plots and figures into the folder `out`.
    `simulated`: see simulated_groups; `second_look`: see match_pair."""
    results = {}
    for name in names:
        results[name] = score_method(load(name), homographies, simulated, second_look)
        progress(f"{name}: {json.dumps(results[name]['oxford'])}, shifts {min(results[name]['shifts'].values()):.2f}")
    out = pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    (out / "features.json").write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    text = table(results) + ("\n" + simulated_table(results) if simulated else "")
    (out / "features_table.md").write_text(text, encoding="utf-8")
    plot(results, out / "features_curves.svg")
    if simulated:
        plot_simulated(results, out / "features_pairs.svg")
    return text
