# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""The training loop: resumes from its last checkpoint, writes its curves as CSV. Under `torchrun` each process takes `batch` samples
of a step (DistributedDataParallel)."""

import collections
import csv
import ctypes
import dataclasses
import json
import math
import os
import pathlib
import time
import types

import torch
from torch import distributed, nn
from torch.nn.parallel import DistributedDataParallel
from torch.utils.data import DataLoader

from regolith_train.data import Mixture, SimulatedPairs, SingleImages, validation
from regolith_train.losses import LOSSES
from regolith_train.networks import build, inputs


class WrongInput(ValueError):
    """What a user named does not fit together; the text says what to do."""


@dataclasses.dataclass
class TrainingOptions:
    network: str = "ghost"  # a key of NETWORKS
    shape: dict = dataclasses.field(default_factory=dict)  # arguments of its class
    loss: str = "ghost"  # a key of LOSSES
    steps: int = 10000
    batch: int = 8  # samples (pairs of views) a step
    rate: float = 2e-3
    schedule: str = "cosine"  # or "constant", the paper's
    warm_up: int = 200  # steps
    weight_decay: float = 1e-4
    gradient_limit: float = 5.0  # norm; 0: none
    full_rotation_share: float = 0.45  # of the homographies that turn by up to 180 degrees
    shift_share: float = 0.0  # of the homographies that are shifts by whole pixels
    pairs_share: float = 0.3  # of the samples that come from the simulator
    average_decay: float = 0.995  # a step, of the averaged weights
    seed: int = 1
    threads: int = 2
    workers: int = 1
    bf16: bool = True  # autocast, where the processor has bf16 (see has_bf16)
    checkpoint_every: int = 250  # steps; the loss of images kept out of training is found then too
    validation_samples: int = 32


def cache_folder():
    root = os.environ.get("REGOLITH_CACHE") or os.path.expanduser("~/.cache/regolith")
    return pathlib.Path(root) / "training"


def learning_rate(options, step):
    """Factor of the rate at a step: linear warm-up, then constant or half a cosine down to a hundredth."""
    if step < options.warm_up:
        return (step + 1) / options.warm_up
    if options.schedule == "constant":
        return 1.0
    progress = (step - options.warm_up) / max(1, options.steps - options.warm_up)
    return 0.01 + 0.99 * 0.5 * (1 + math.cos(math.pi * min(progress, 1.0)))


class Run:
    """Network, optimiser and step of one training run, and the folder that they are kept in."""

    def __init__(self, options, folder):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        torch.manual_seed(options.seed)
        self.device = torch.device("cuda", local_rank()) if torch.cuda.is_available() else torch.device("cpu")
        self.options = dataclasses.replace(options, bf16=options.bf16 and has_bf16(self.device))
        self.network = build(options.network, options.shape).to(self.device, memory_format=torch.channels_last)
        if self.device.type == "cpu":
            strided_depthwise_in_f32(self.network)
        self.parallel = DistributedDataParallel(self.network) if distributed.is_initialized() else self.network
        self.processes = distributed.get_world_size() if distributed.is_initialized() else 1
        self.optimiser = torch.optim.AdamW(self.network.parameters(), lr=options.rate, weight_decay=options.weight_decay)
        # The mean of the weights over the last few hundred steps is better than any of them, and good at any time of the schedule.
        self.average = {name: value.clone() for name, value in self.network.state_dict().items()}
        self.step = 0
        self.samples = 0  # seen, of all processes together
        self.data = {}  # what it was trained on: pictures by the first part of their names, pairs by scenario
        if self.checkpoint.exists():
            self.load(self.checkpoint)

    @property
    def checkpoint(self):
        return self.folder / "checkpoint.pt"

    def load(self, path):
        state = torch.load(path, map_location=self.device, weights_only=False)
        if state["network_name"] != self.options.network:
            raise WrongInput(f"{path}: holds {state['network_name']}, not {self.options.network}; name another --name")
        if (state["options"].get("shape") or {}) != self.options.shape:
            raise WrongInput(f"{path}: was begun with another --shape ({state['options'].get('shape')}); name another --name")
        self.network.load_state_dict(state["network"])
        self.optimiser.load_state_dict(state["optimiser"])
        self.average = state["average"]
        self.step, self.samples = state["step"], state["samples"]

    def begin_with(self, weights):
        state = self.network.state_dict()
        # ONNX has no count of the batches that a normalisation has seen.
        unfit = [name for name, value in state.items() if not name.endswith("num_batches_tracked")
                 and (name not in weights or weights[name].shape != value.shape)]  # fmt: skip
        if unfit:
            raise WrongInput(f"the weights to start with lack {unfit[0]} in this network's shape, and {len(unfit) - 1} more: "
                             "those of another network, or of another --shape?")  # fmt: skip
        self.network.load_state_dict({**state, **{name: weights[name] for name in state if name in weights}})
        self.average = {name: value.clone() for name, value in self.network.state_dict().items()}

    def save(self):
        partial = self.folder / "checkpoint.partial.pt"
        torch.save({"network_name": self.options.network, "network": self.network.state_dict(),
                    "average": self.average, "optimiser": self.optimiser.state_dict(), "step": self.step,
                    "samples": self.samples, "data": self.data, "options": dataclasses.asdict(self.options)}, partial)  # fmt: skip
        partial.replace(self.checkpoint)

    def advance(self, sample):
        for group in self.optimiser.param_groups:
            group["lr"] = self.options.rate * learning_rate(self.options, self.step)
        terms = self.terms(self.parallel, sample)
        self.optimiser.zero_grad(set_to_none=True)
        terms["loss"].backward()
        if self.options.gradient_limit > 0:
            torch.nn.utils.clip_grad_norm_(self.network.parameters(), self.options.gradient_limit)
        self.optimiser.step()
        self.update_average()
        self.step += 1
        self.samples += self.options.batch * self.processes
        return {name: float(value.detach()) for name, value in terms.items()}

    def terms(self, network, sample):
        sample = {name: values.to(self.device) for name, values in sample.items()}
        sample["inputs"] = inputs(self.network, sample["images"].flatten(0, 1))
        with torch.autocast(self.device.type, torch.bfloat16, enabled=self.options.bf16):
            return LOSSES[self.options.loss](network, sample)

    @torch.no_grad()
    def validate(self, batches):
        """Mean terms of the loss over batches that are not trained on."""
        self.network.eval()
        terms = [self.terms(self.network, sample) for sample in batches]
        self.network.train()
        return {name: float(sum(term[name] for term in terms)) / len(terms) for name in terms[0]}

    def update_average(self):
        # Early steps would otherwise carry the random start along.
        weight = max(1 - self.options.average_decay, 1 / (self.step + 1))
        for name, value in self.network.state_dict().items():
            if value.is_floating_point():
                self.average[name].lerp_(value, weight)
            else:
                self.average[name].copy_(value)


def strided_depthwise_in_f32(network):
    """On a CPU, lets strided depthwise convolutions run in f32: oneDNN's backward pass of them takes six times as long in bf16."""

    def forward(module, features):
        with torch.autocast(features.device.type, enabled=False):
            return nn.Conv2d.forward(module, features.float()).to(features.dtype)

    for module in network.modules():
        if isinstance(module, nn.Conv2d) and module.groups > 1 and module.stride != (1, 1):
            module.forward = types.MethodType(forward, module)


def has_bf16(device, cpu_information="/proc/cpuinfo"):
    """Whether the processor computes in bf16 itself. A CPU without it does so by f32 and conversions: 10.8 s a step of 4 pairs for
    `superpoint` on one core of a Xeon, 3.3 s in f32."""
    if device.type == "cuda":
        return torch.cuda.get_device_capability(device)[0] >= 8  # is_bf16_supported() counts emulation in
    try:
        words = pathlib.Path(cpu_information).read_text(encoding="utf-8").split()
    except OSError:
        return False
    return not {"amx_bf16", "avx512_bf16", "bf16"}.isdisjoint(words)


def local_rank():
    return int(os.environ.get("LOCAL_RANK", 0))


def keep_freed_memory():
    """Lets glibc keep what is freed. On a CPU tensors of hundreds of megabytes come and go with every layer, and a quarter of a step
    went into page faults where they were given back to the system each time."""
    try:
        mallopt = ctypes.CDLL(None).mallopt
    except (AttributeError, OSError, TypeError):
        return  # another C library
    trim_threshold, mmap_max = -1, -4  # M_TRIM_THRESHOLD and M_MMAP_MAX of malloc.h
    mallopt(trim_threshold, 2**31 - 1)
    mallopt(mmap_max, 0)


def join_processes():
    """Under torchrun, this process's number and how many there are; without it 0 and 1."""
    if "WORLD_SIZE" not in os.environ:
        return 0, 1
    if not distributed.is_initialized():
        distributed.init_process_group("nccl" if torch.cuda.is_available() else "gloo")
    return distributed.get_rank(), distributed.get_world_size()


def mixture(options, images, pairs, labels, length, kept_out=False):
    """`length` samples of what is trained on, or of what is kept out of it."""
    single = SingleImages([path for path in images if validation(path) == kept_out], labels, shift_share=options.shift_share)
    single.limits.full_rotation_share = options.full_rotation_share
    simulated = SimulatedPairs(pairs, labels, kept_out=kept_out)
    return Mixture([single, simulated], [1 - options.pairs_share, options.pairs_share], length, options.seed)


def sources(mixed):
    """How many pictures (by the first part of their names) and pairs (by scenario) samples are drawn from."""
    counts = collections.Counter()
    for dataset in mixed.datasets:
        if isinstance(dataset, SingleImages):
            counts.update(f"pictures {pathlib.Path(path).name.split('_')[0]}" for path in dataset.images)
        else:
            counts.update(f"simulated pairs {path.parent.parent.name}" for path in dataset.pairs)
    return dict(sorted(counts.items()))


class Curve:
    """A CSV file of the terms of the loss, a row at a time."""

    def __init__(self, path):
        self.path = path

    def add(self, step, terms):
        new = not self.path.exists()
        with open(self.path, "a", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            if new:
                writer.writerow(["step", *sorted(terms)])
            writer.writerow([step, *(f"{terms[name]:.5f}" for name in sorted(terms))])


def train(options, images, pairs, labels, folder, progress=print, start=None):
    """Trains to options.steps; what was reached is in `folder`, also where it was stopped. A run without a checkpoint begins with
    the weights `start` (name → tensor), where they are given."""
    torch.set_num_threads(options.threads)
    keep_freed_memory()
    rank, processes = join_processes()
    run = Run(options, folder)
    if run.options.bf16 != options.bf16 and rank == 0:
        progress("this processor has no bf16: training in f32")
    if start and run.step == 0:
        run.begin_with(start)
    (run.folder / "options.json").write_text(json.dumps(dataclasses.asdict(run.options), indent=2) + "\n")
    samples = mixture(options, images, pairs, labels, options.steps * options.batch * processes)
    samples.share(run.step * options.batch, options.batch, rank, processes)
    run.data = sources(samples)
    kept_out = mixture(options, images, pairs, labels, options.validation_samples, kept_out=True)
    validation_batches = list(DataLoader(kept_out, options.batch, drop_last=True)) if kept_out.datasets else []
    loader = DataLoader(samples, batch_size=options.batch, num_workers=options.workers, drop_last=True)
    curve, validation_curve = Curve(run.folder / "curve.csv"), Curve(run.folder / "validation.csv")
    started, first = time.monotonic(), run.step
    run.network.train()
    for sample in loader:
        terms = run.advance(sample)
        if rank > 0:
            continue
        if run.step % 10 == 0:
            curve.add(run.step, terms)
        if run.step % 50 == 0:
            pace = (time.monotonic() - started) / (run.step - first)
            left = pace * (options.steps - run.step) / 60
            progress(f"step {run.step}/{options.steps}  " + "  ".join(f"{n} {v:.3f}" for n, v in terms.items())
                     + f"  {pace:.2f} s a step, {left:.0f} min left")  # fmt: skip
        if run.step % options.checkpoint_every == 0:
            run.save()
            if validation_batches:
                validation_curve.add(run.step, run.validate(validation_batches))
    if rank == 0:
        run.save()
    return run
