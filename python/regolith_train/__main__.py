# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""python -m regolith_train label|train|curves|export|vocabulary|evaluate"""

import argparse
import dataclasses
import os
import pathlib
import shlex
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODELS = ROOT / "models"
CONFIGS = ROOT / "python" / "configs"
DATA = pathlib.Path(os.environ.get("REGOLITH_DATA") or ROOT.parent / "shared" / "data")
EXAMPLES = """\
a whole training, from pictures to a network in models/:
  build/release/regolith simulate --scenario lunar --pairs 200 --pairs-only --out pairs/lunar
  python -m regolith_train label --images ../shared/data/train_images --pairs pairs
  python -m regolith_train train --network ghost --images ../shared/data/train_images --pairs pairs
  python -m regolith_train export --network ghost
  python -m regolith_train vocabulary --network ghost --images ../shared/data/train_images
  python -m regolith_train evaluate --methods ghost xfeat orb --homographies ../shared/data/homography
"""


def images_of(folder):
    folder = pathlib.Path(folder)
    paths = sorted(path for kind in ("jpg", "jpeg", "png") for path in folder.rglob(f"*.{kind}"))
    if not paths:
        fail(f"{folder}: holds no pictures (jpg, png)")
    return paths


def pair_folders(folder):
    """Every `pairs` folder below; none where no folder was named."""
    return sorted(path.parent for path in pathlib.Path(folder).rglob("index.csv")) if folder else []


def fail(message):
    print(f"regolith_train: {message}", file=sys.stderr)
    raise SystemExit(2)


def run_folder(arguments):
    from regolith_train.training import cache_folder

    return cache_folder() / (arguments.name or arguments.network)


def trained(arguments):
    """The averaged weights of the run's last checkpoint, and what they were trained by."""
    import torch

    path = run_folder(arguments) / "checkpoint.pt"
    if not path.exists():
        fail(f"{path}: is missing; train first, or name another run by --name")
    state = torch.load(path, map_location="cpu", weights_only=False)
    if state["network_name"] != arguments.network:
        fail(f"{path}: holds {state['network_name']}, not {arguments.network}")
    return state


def label(arguments):
    import torch

    from regolith_train.labels import label_images

    torch.set_num_threads(arguments.threads)
    folder = arguments.labels or default_labels()
    if arguments.images:
        label_images(images_of(arguments.images), folder, views=arguments.views)
    pairs = [path for pair in pair_folders(arguments.pairs) for path in sorted(pair.glob("*_[12].png"))]
    label_images(pairs, folder, views=0)


def default_labels():
    from regolith_train.training import cache_folder

    return cache_folder() / "labels"


def train(arguments):
    import yaml

    from regolith_train.labels import label_path
    from regolith_train.networks import build
    from regolith_train.training import TrainingOptions, WrongInput, train as run_training

    config = pathlib.Path(arguments.config or CONFIGS / f"{arguments.network}.yaml")
    options = TrainingOptions(network=arguments.network, **yaml.safe_load(config.read_text(encoding="utf-8")))
    for field in dataclasses.fields(TrainingOptions):
        value = getattr(arguments, field.name, None)
        if value is not None:
            options = dataclasses.replace(options, **{field.name: dict(value) if field.name == "shape" else value})
    if arguments.pairs and options.pairs_share == 0.0:
        fail(f"--pairs: {config} draws no simulated pairs (pairs_share: 0); leave them out, or ask for some by --pairs-share 0.3")
    try:
        build(options.network, options.shape)
    except ValueError as error:
        fail(error)
    labels = arguments.labels or default_labels()
    images = [path for path in images_of(arguments.images) if label_path(labels, path).exists()]
    if not images:
        fail(f"{labels}: holds no labels of these pictures; run `label` first")
    folder = run_folder(arguments)
    folder.mkdir(parents=True, exist_ok=True)
    processes = os.environ.get("WORLD_SIZE")
    program = f"torchrun --nproc-per-node {processes}" if processes else "python"
    (folder / "command.txt").write_text(f"{program} -m regolith_train {shlex.join(sys.argv[1:])}\n", encoding="utf-8")
    from regolith_train.export import read_weights

    start = read_weights(arguments.start) if arguments.start else None
    try:
        run_training(options, images, pair_folders(arguments.pairs), labels, folder, lambda line: print(line, flush=True), start)
    except WrongInput as error:
        fail(error)


def export(arguments):
    from regolith_train import provenance
    from regolith_train.export import export as write

    state = trained(arguments)
    print(write(arguments.network, state["average"], arguments.out, provenance.describe(state, run_folder(arguments))))


def vocabulary(arguments):
    from regolith_train.networks import restored
    from regolith_train.vocabulary import write_vocabulary

    path = pathlib.Path(arguments.out) / f"{arguments.network}_vocabulary.npy"
    write_vocabulary(restored(arguments.network, trained(arguments)), images_of(arguments.images), path)
    print(path)


def evaluate(arguments):
    import torch

    from regolith_train.methods import method
    from regolith_train.report import report, simulated_groups
    from regolith_train.training import cache_folder

    torch.set_num_threads(arguments.threads)
    homographies = pathlib.Path(arguments.homographies)
    if not (homographies / "oxford_graf").is_dir():
        fail(f"{homographies}: has no folder oxford_graf; name the folder of Oxford's sequences by --homographies")
    def load(name):
        try:
            return method(name, MODELS, cache_folder())
        except (ValueError, FileNotFoundError) as error:
            return fail(error)

    simulated = simulated_groups(pair_folders(arguments.pairs), arguments.pairs_a_group)
    if arguments.pairs and not simulated:
        fail(f"{arguments.pairs}: holds no PLANET/SEED/pairs with pairs 0.1 to 2 m apart; make some by `regolith simulate --pairs`")
    print(report(arguments.methods, load, homographies, simulated, arguments.out, arguments.second_look))


def curves(arguments):
    from regolith_train.report import plot_curves

    path = run_folder(arguments) / "curve.svg"
    plot_curves(run_folder(arguments), path)
    print(path)


def size(text):
    """NAME=NUMBER as a pair."""
    name, _, number = text.partition("=")
    return name, int(number)


def parser():
    from regolith_train.networks import NETWORKS

    top = argparse.ArgumentParser(prog="python -m regolith_train", epilog=EXAMPLES, description=__doc__,
                                  formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    commands = top.add_subparsers(dest="command", required=True)

    def command(name, function, help_text):
        added = commands.add_parser(name, help=help_text)
        added.set_defaults(function=function)
        added.add_argument("--threads", type=int, default=2)
        if name not in ("label", "evaluate"):
            added.add_argument("--network", choices=sorted(NETWORKS), default="ghost")
            added.add_argument("--name", help="of the run in REGOLITH_CACHE/training; default: the network's")
        return added

    added = command("label", label, "keypoints and descriptors of a teacher for pictures and simulated pairs")
    added.add_argument("--images", help="folder of pictures")
    added.add_argument("--pairs", help="folder below which `simulate --pairs` wrote")
    added.add_argument("--labels", help="folder they go to; default REGOLITH_CACHE/training/labels")
    added.add_argument("--views", type=int, default=1, help="homographic views that scores are averaged over")
    added = command("train", train, "train a network; goes on where the run of that name stopped")
    added.add_argument("--shape", nargs="+", type=size, metavar="NAME=NUMBER",
                       help="arguments of the network's class, such as depth=2 dimension=64")  # fmt: skip
    added.add_argument("--start", help="ONNX file of the same network whose weights a new run begins with")
    for name in ("images", "pairs", "labels", "config"):
        added.add_argument(f"--{name}", required=name == "images")
    for name, kind in (("loss", str), ("steps", int), ("batch", int), ("rate", float), ("schedule", str), ("seed", int),
                       ("workers", int), ("pairs_share", float), ("full_rotation_share", float), ("shift_share", float)):  # fmt: skip
        added.add_argument(f"--{name.replace('_', '-')}", type=kind)
    added = command("export", export, "write models/NAME.onnx, its manifest and parity tensors")
    added.add_argument("--out", default=MODELS)
    added = command("vocabulary", vocabulary, "write the words of the global descriptor")
    added.add_argument("--images", required=True)
    added.add_argument("--out", default=MODELS)
    added = command("evaluate", evaluate, "put methods side by side: homographies, shifts, turns, scales, simulated pairs")
    added.add_argument("--methods", nargs="+", default=["ghost"], metavar="METHOD",
                       help="ghost (as in models/), ghost@RUN (a run's checkpoint), xfeat, aliked-n16, disk, sift, orb")  # fmt: skip
    added.add_argument("--homographies", default=DATA / "homography")
    added.add_argument("--pairs", help="folder below which `simulate --pairs` wrote PLANET/SEED/pairs")
    added.add_argument("--pairs-a-group", type=int, default=100, metavar="N", help="of simulated pairs of one planet, sun and baseline")
    added.add_argument("--second-look", action="store_true", help="at the farther image of a simulated pair, as `regolith match` does")
    added.add_argument("--out", default="features", help="folder of tables and plots")
    command("curves", curves, "plot the losses of a run")
    return top


def main():
    arguments = parser().parse_args()
    arguments.function(arguments)


if __name__ == "__main__":
    main()
